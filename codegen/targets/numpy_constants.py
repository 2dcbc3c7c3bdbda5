"""Prints the record of constants of a NumPy module: the ones that its kernels use, checked."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import sympy as sp

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.scene import CONSTANT_NAMES, MODULI, Scene
from rodproof.codegen.targets import numpy_template as template
from rodproof.codegen.targets.lines import wrapped
from rodproof.codegen.targets.printer import Printer
from rodproof.codegen.texts import NUMBERS

#: Units and what they are, in the order in which they are said.
KINDS = (
    (("alpha", "beta", "iota"), "a length", "lengths"),
    (("gamma",), "a force", "forces"),
    (("zeta", "eta", "p"), "a plain number", "plain numbers"),
)


def used_constants(kernels: tuple[Kernel, ...]) -> tuple[str, ...]:
    """The constants that the kernels need, in the record's order."""
    exprs = [expr for kernel in kernels for expr in kernel.expressions()]
    exprs += [a.expr for kernel in kernels for a in kernel.constants]
    used = {s.name for expr in exprs for s in expr.free_symbols}
    return tuple(name for name in CONSTANT_NAMES if name in used)


def derived_constants(kernels: tuple[Kernel, ...]) -> dict[str, sp.Expr]:
    """What the kernels compute from the constants, once a record."""
    return {a.name: a.expr for kernel in kernels for a in kernel.constants}


def needs_work_share(kernels: tuple[Kernel, ...]) -> bool:
    """Whether an energy has no closed form."""
    return any(expr.has(WorkShare) for kernel in kernels for expr in kernel.expressions())


def all_have_values(scene: Scene, kernels: tuple[Kernel, ...]) -> bool:
    """Whether ``Constants()`` needs no argument."""
    return set(used_constants(kernels)) <= {*scene.fixed, *scene.defaults}


def print_constants(
    scene: Scene, kernels: tuple[Kernel, ...], properties: Sequence[str] = ()
) -> str:
    """The record's text, with these properties at its end."""
    used, derived = used_constants(kernels), derived_constants(kernels)
    signed = "iota" in used
    coupled = [name for name in _COUPLED if name in used] if signed else []
    hidden = "field(init=False, repr=False, compare=False)"
    exact = [name for name in used if _in(name, derived) or name in coupled]
    values = [f'            "{name}": {Printer({}).text(e)},' for name, e in derived.items()]
    given = {*scene.fixed, *scene.defaults} & set(used)  # fields with a default may come early
    decorator = "frozen=True, kw_only=True" if given else "frozen=True"
    text = template.CONSTANTS.substitute(
        decorator=decorator,
        doc=_doc(used),
        fields="\n".join(_field(name, scene) for name in used),
        derived_fields="".join(f"\n    {name}: float = {hidden}" for name in derived),
        names=_tuple_text([f'"{name}"' for name in used]),
        value_check=template.SIGNED_CHECK if signed else template.POSITIVE_CHECK,
        ranges="".join(
            template.RANGE_CHECK.substitute(name=name, low=repr(low), high=repr(high))
            for name, (low, high) in scene.ranges.items()
            if name in used
        ),
        exact=_exact(exact),
        coupling=_coupling_check(coupled) if signed else "",
        derived=template.DERIVED.substitute(values="\n".join(values)) if derived else "",
    )
    text += template.PLAIN if any(kernel.plain for kernel in kernels) else ""
    text += template.WORK_SHARE_TABLES if needs_work_share(kernels) else ""
    text += _of_moduli(scene, used) if scene.moduli else ""
    text = "\n\n".join([text.rstrip("\n"), *properties])
    rod = "\n\n\nROD = Constants()\n" if all_have_values(scene, kernels) else ""
    return text.rstrip("\n") + "\n" + rod


_COUPLED = ("beta", "eta", "iota")


def _coupling_check(names: list[str]) -> str:
    """The test of the rod's one inequality, in the constants that the record has.

    A scene may have beta or eta fixed at one.
    """
    squares = [f"{name}**2" for name in names if name != "iota"] or ["1"]
    return template.COUPLING_CHECK.substitute(
        form=f"{' * '.join(squares)} - iota**2",
        given=", ".join(f"{name}={{self.{name}}}" for name in names),
    )


def _in(name: str, derived: dict[str, sp.Expr]) -> bool:
    return any(s.name == name for expr in derived.values() for s in expr.free_symbols)


def _field(name: str, scene: Scene) -> str:
    if name in scene.fixed:
        return f"    {name}: float = field(default={scene.fixed[name]!r}, init=False)"
    default = f" = {scene.defaults[name]!r}" if name in scene.defaults else ""
    return f"    {name}: float{default}"


def _exact(names: list[str]) -> str:
    """The constants as exact fractions, under their names."""
    if not names:
        return ""
    given = ", ".join(f"self.{name}" for name in names)
    if len(names) == 1:
        return f"        {names[0]} = Fraction({given})\n"
    line = f"        {', '.join(names)} = (Fraction(v) for v in ({given}))"
    if len(line) <= 100:
        return line + "\n"
    lines = wrapped("exact = (", ["Fraction(v)", f"for v in ({given})"], ")", " ", " " * 8)
    return "\n".join([*lines, f"        {', '.join(names)} = exact\n"])


def _doc(used: tuple[str, ...]) -> str:
    """How many constants, in which units, with which signs."""
    if not used:
        return "No constant of the rod is left: all are fixed."
    said = []
    for names, one, many in KINDS:
        found = [name for name in names if name in used]
        if found:
            said.append(f"{_listed(found)} {f'is {one}' if len(found) == 1 else f'are {many}'}")
    signs = "all are positive"
    if "iota" in used:
        signs = "all but iota are positive and beta^2 eta^2 - iota^2 > 0"
    words = textwrap.fill(f"{', '.join(said)}; {signs}.", 96, subsequent_indent="    ")
    plural = "s" if len(used) > 1 else ""
    count = f"{NUMBERS[len(used)]} constant{plural}"
    return f"The {count} of the rod, checked on construction (ValueError).\n\n    {words}"


def _listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"


def _tuple_text(entries: list[str]) -> str:
    return f"({entries[0]},)" if len(entries) == 1 else f"({', '.join(entries)})"


def _of_moduli(scene: Scene, used: tuple[str, ...]) -> str:
    """The constructor from the moduli of the linear rod."""
    given = [name for name in ("gamma", "p") if name in used and name not in scene.fixed]
    moduli = [name for name in MODULI if name in scene.moduli and MODULI[name] in used]
    arguments = [f"{name}: float" for name in given]
    defaults = [f"{name}: float = {scene.moduli[name]!r}" for name in moduli]
    gamma = "gamma" if "gamma" in given else repr(scene.fixed.get("gamma", 1.0))
    set_by = {
        MODULI[name]: f"{name} / {gamma}" if name == "coupling" else f"math.sqrt({name} / {gamma})"
        for name in moduli
    }
    lines = [
        f"            {name}={set_by.get(name, name)}," for name in used if name not in scene.fixed
    ]
    return template.OF_MODULI.substitute(
        arguments="".join(f"        {argument},\n" for argument in arguments),
        moduli="".join(f"        {default},\n" for default in defaults),
        meaning=_meaning(moduli),
        values="\n".join(lines),
    )


def _meaning(moduli: list[str]) -> str:
    """``bending = gamma alpha^2`` and its like."""
    terms = [
        f"{name} = gamma {MODULI[name]}{'' if name == 'coupling' else '^2'}" for name in moduli
    ]
    return textwrap.fill(f"{', '.join(terms)}.", 92, subsequent_indent="        ")
