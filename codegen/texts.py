"""The words of a generated module: docstrings, labels, and the arrays that they speak of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import Group, Live, groups, live, substitution
from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.derivations.symbols import STRAINS, iota, p

#: The paper's label of each statement that a kernel rests on, where it has one.
STATEMENT_LABELS = {
    "q-form": "eq:quadraticform",
    "qstar-form": "Section 3.1",
    "const-u-mu": "eq:uconst",
    "const-u-3": "eq:u3const",
    "const-v-mu": "eq:vconst",
    "const-v-3": "eq:v3const",
    "strain-limit": "eq:strainlimiting",
    "wstar-gradient": "Section 3.1",
    "wstar-definition": "eq:compenergy",
    "const-m-mu": "eq:mconst",
    "const-m-3": "eq:m3const",
    "const-n-mu": "eq:nconst",
    "const-n-3": "eq:n3const",
    "w-definition": "eq:stenergy",
}

STRAIN_NAMES = tuple(s.name for s in STRAINS)
UNITS = {"m": "in force times length", "n": "in force", "u": "in 1/length", "v": "plain"}
NUMBERS = ("no", "one", "two", "three", "four", "five", "six", "seven")


@dataclass(frozen=True)
class FunctionText:
    """Inputs and outputs of a function as arrays with leading shapes, and its two docstrings."""

    inputs: dict[str, tuple[int, ...]]
    outputs: dict[str, tuple[int, ...]]
    equation: str
    doc: str


def function_text(kernel: Kernel, scene: Scene) -> FunctionText:
    """The words for a function of a scene."""
    return _Words(scene, live(scene)).function(kernel)


def step_text(step: str, scene: Scene) -> str:
    """What a step computes."""
    chiral = iota not in substitution(scene)
    powers = p not in substitution(scene)
    return {
        "reduce_loads": "Loads over their moduli, the linear rod's strains, and Q* in squares."
        if chiral
        else "Loads over their moduli, and Q* in squares.",
        "reduce_strains": "Strains times their moduli, the linear rod's loads, and Q in squares."
        if chiral
        else "Strains times their moduli, and Q in squares.",
        "soften": "Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."
        if powers
        else "Strain over load, (gamma^2 + y^2)^(-1/2), by the ratio of gamma and y.",
        "stiffen": "Load over strain, gamma (1 - x^p)^(-1/p), by the growth x^p/(1 - x^p), x^2 = Q."
        if powers
        else "Load over strain, gamma (1 - Q)^(-1/2).",
        "harden": "Load over strain, (gamma^p + y^p)^(1/p), after its rise (y/gamma)^(p/2)."
        if powers
        else "Load over strain, (gamma^2 + y^2)^(1/2), after its rise y/gamma.",
    }[step]


def square_text(quantity: str, answer: Sequence[str]) -> str:
    """What the plain bodies start from."""
    square, what = ("Q*/gamma^2", "strains") if quantity == "overload" else ("Q", "loads")
    where = " and ".join(answer)
    return f"{square} as a sum of squares; the linear rod's {what} over gamma in {where}."


def shape_text(head: tuple[int, ...], layout: str) -> str:
    """A leading (or last) shape with the trailing one: ``(3, ...)``."""
    entries = [str(length) for length in head]
    return f"({', '.join([*entries, '...'] if layout == 'first' else ['...', *entries])})"


@dataclass(frozen=True)
class _Words:
    scene: Scene
    at: Live

    @property
    def load_groups(self) -> tuple[Group, ...]:
        return groups("mn", self.at.loads)

    @property
    def strain_groups(self) -> tuple[Group, ...]:
        """What the strains function returns; it may be more than the loads' own strains."""
        return groups("uv", self.at.strains)

    @property
    def own_strains(self) -> tuple[Group, ...]:
        """The strains on which the loads do work: the inputs of functions of strains."""
        return groups("uv", self.at.loads)

    @property
    def square(self) -> bool:
        return p in substitution(self.scene)

    def function(self, kernel: Kernel) -> FunctionText:
        """The words for one function."""
        of_loads = kernel.inputs[0] in LOAD_NAMES
        size = len(self.at.loads)
        matrix: tuple[int, ...] = (size, size) if size > 1 else ()
        if size > 1 and self.scene.matrix == "packed":
            matrix = (size * (size + 1) // 2,)
        inputs = self.load_groups if of_loads else self.own_strains
        outputs: dict[str, dict[str, tuple[int, ...]]] = {
            "strains": {g.array: g.head for g in self.strain_groups},
            "loads": {g.array: g.head for g in self.load_groups},
            "stored_energy": {"w": ()},
            "complementary_energy": {"w_star": ()},
            "stiffness": {"stiff": matrix},
            "loads_and_stiffness": {g.array: g.head for g in self.load_groups} | {"stiff": matrix},
            "compliance": {"soft": matrix},
            "strains_and_gap": {g.array: g.head for g in self.strain_groups} | {"limit_gap": ()},
            "stiffness_at_loads": {"stiff": matrix},
        }
        about, more = self._about(kernel, matrix)
        label = self._labels(kernel)
        taken = self._listed(inputs) + (
            ", with Q*^(1/2) finite." if of_loads else ", with Q < 1 (eq:strainlimiting)."
        )
        lines = [about.replace("$label", label), "", taken, *more]
        return FunctionText(
            {g.array: g.head for g in inputs},
            outputs[kernel.name],
            self._equation(kernel.name),
            "\n    ".join(lines).replace("\n    \n", "\n\n"),
        )

    def _about(self, kernel: Kernel, matrix: tuple[int, ...]) -> tuple[str, list[str]]:
        """The first line of a docstring, and what follows the inputs."""
        loads, strains = _names(self.load_groups), _names(self.own_strains)
        x_p = "Q" if self.square else "Q^(p/2)"
        one = shape_text((), self.scene.layout)
        shape = shape_text(matrix, self.scene.layout)
        trailing = "with the trailing shape"
        if kernel.name == "strains":
            made = self._listed(self.strain_groups)
            rest = ", ".join(_at_rest(g) for g in self.strain_groups)
            answer = f"Strains {_names(self.strain_groups)} under the loads {loads} ($label)."
            return answer, [f"Answers {made}; at rest {rest}."]
        if kernel.name == "strains_and_gap":
            made = self._listed(self.strain_groups)
            first = f"Strains {_names(self.strain_groups)} under the loads {loads}, and 1 - {x_p}."
            more = "plain:\n    near the limit it says what the strains no longer can."
            return first, [f"Answers {made}, and the gap {one} {more}"]
        if kernel.name == "loads":
            made = self._listed(self.load_groups)
            near = "Near the limit the strains hardly determine the loads."
            return f"Loads {loads} at the strains {strains} ($label).", [f"Answers {made}.", near]
        if kernel.name == "stored_energy":
            return f"Stored energy W per length, in force (eq:stenergy), {trailing}.", []
        if kernel.name == "complementary_energy":
            return f"Complementary energy W* per length, in force (eq:compenergy), {trailing}.", []
        of = [LOAD_NAMES, STRAIN_NAMES]
        if kernel.name == "compliance":
            of.reverse()
        rows, columns = (", ".join(names[i] for i in self.at.loads) for names in of)
        order = f"Rows and columns are ordered ({rows}) and ({columns})."
        if len(self.at.loads) == 1:
            order = f"That is d {rows}/d {columns}."
        if len(self.at.loads) > 1 and self.scene.matrix == "packed":
            order += "\n    Packed: the entries on and above the diagonal, row by row."
        if kernel.name == "loads_and_stiffness":
            made = self._listed(self.load_groups)
            first = f"Loads {loads} and stiffness {_per(loads, strains)} at the strains {strains}."
            return first, [f"Answers {made},", f"and the stiffness {shape}.", order]
        if kernel.name == "stiffness":
            kind = "symmetric positive definite (Section 3.4)"
            return f"Stiffness {_per(loads, strains)}, {shape}, {kind}.", [order]
        if kernel.name == "stiffness_at_loads":
            first = f"Stiffness {_per(loads, strains)}, {shape}, at the strains of these loads."
            more = "The inverse of the compliance; it holds where strains no longer tell the loads."
            return first, [order, more]
        kind = "the inverse of the stiffness at these loads"
        if self.scene.loads:
            kind = "symmetric positive definite (Section 3.4)"
        return f"Compliance {_per(strains, loads)}, {shape}, {kind}.", [order]

    def _equation(self, name: str) -> str:
        """The first line of the private function's docstring."""
        loads = _tuple(g.array if len(g.components) == 3 else c for g, c in self._load_parts())
        strains = _tuple(_from_rest(self.strain_groups))
        own = _tuple(_from_rest(self.own_strains))
        if name == "strains":
            f = "(gamma^2 + Q*)^(-1/2)" if self.square else "(gamma^p + Q*^(p/2))^(-1/p)"
            return f"{strains} = {f} K^-1 {loads}."
        if name == "loads":
            f = "(1 - Q)^(-1/2)" if self.square else "(1 - Q^(p/2))^(-1/p)"
            return f"{loads} = gamma {f} K {own}."
        if name == "strains_and_gap":
            power = "2" if self.square else "p"
            gap = f"gamma^{power}/(gamma^{power} + {'Q*' if self.square else 'Q*^(p/2)'})"
            return f"The strains, and 1 - {'Q' if self.square else 'Q^(p/2)'} = {gap}."
        if name == "stiffness_at_loads":
            rise = "y/gamma" if self.square else "(y/gamma)^(p/2)"
            return f"D^2 W = factor (K + h h^T), h = {rise} {loads}/y, y^2 = Q*."
        if name == "stored_energy" and self.square:
            return "W = gamma (1 - (1 - Q)^(1/2)), as gamma Q/(1 + (1 - Q)^(1/2))."
        if name == "stored_energy":
            return "W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of the work."
        if name == "complementary_energy" and self.square:
            return "W* = (gamma^2 + Q*)^(1/2) - gamma, as load times strain over 1 + gamma factor."
        if name == "complementary_energy":
            return "W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."
        if name == "loads_and_stiffness":
            return f"{loads} = factor K {own} and D^2 W = factor (K + growth t t^T), as apart."
        if name == "stiffness":
            return f"D^2 W = factor (K + growth t t^T), t = K {own}/x."
        linear = ""
        if iota not in substitution(self.scene):
            linear = " and (c3, c6) the linear rod's reduced strains"
        return f"""D^2 W* = factor (K^-1 - share d d^T), d = K^-1 {loads}/y.

    With (a, b) the reduced load as a unit vector{linear},
    the entries that would cancel are sums of squares.
    """

    def _load_parts(self) -> list[tuple[Group, str]]:
        return [
            (g, LOAD_NAMES[i])
            for g in self.load_groups
            for i in (g.components if len(g.components) < 3 else g.components[:1])
        ]

    def _labels(self, kernel: Kernel) -> str:
        cited = [STATEMENT_LABELS.get(s, "") for o in kernel.outputs for s in o.statements]
        found = list(dict.fromkeys(label for label in cited if label.startswith("eq:")))
        return found[0] if len(found) == 1 else f"{found[0]} to {found[-1]}" if found else ""

    def _listed(self, parts: tuple[Group, ...]) -> str:
        """``m (3, ...) in force times length, n (2, ...) in force, the components n1 and n3``."""
        said = []
        for g in parts:
            text = f"{g.array} {shape_text(g.head, self.scene.layout)} {UNITS[g.array[0]]}"
            names = LOAD_NAMES if g.array[0] in "mn" else STRAIN_NAMES
            if len(g.components) == 2:
                text += f" ({' and '.join(names[i] for i in g.components)})"
            said.append(text)
        return ", ".join(said)


def _names(parts: tuple[Group, ...]) -> str:
    return ", ".join(g.array for g in parts)


def _per(above: str, below: str) -> str:
    """A derivative, with tuples in parentheses."""
    sides = (f"({side})" if "," in side else f" {side}" for side in (above, below))
    return "/".join(f"d{side}" for side in sides)


def _from_rest(parts: tuple[Group, ...]) -> list[str]:
    """``u, v - e3`` and their like."""
    found = []
    for g in parts:
        if len(g.components) == 3:
            found.append("v - e3" if g.array == "v" else g.array)
        else:
            found += [STRAIN_NAMES[i] + (" - 1" if i == 5 else "") for i in g.components]
    return found


def _tuple(entries: Iterable[str]) -> str:
    listed = list(entries)
    single = len(listed) == 1 and " " not in listed[0]
    return listed[0] if single else f"({', '.join(listed)})"


def _at_rest(g: Group) -> str:
    if 5 not in g.components:
        return f"{g.array} = 0"
    values = ", ".join("1" if i == 5 else "0" for i in g.components)
    return f"{g.array} = ({values})" if g.head else f"{g.array} = 1"
