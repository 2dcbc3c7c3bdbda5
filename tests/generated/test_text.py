"""The emitted text is the derivation: the module itself, run on 50-digit numbers.

NumPy's functions work on object arrays through the methods of the objects, so the generated
module runs unchanged on `Exact` numbers. Its energy primitive alone is replaced, by the function
that it approximates; `test_accuracy` holds the primitive.
"""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable
from fractions import Fraction as F
from functools import cache
from types import FunctionType, ModuleType, SimpleNamespace
from typing import Any

import mpmath
import numpy as np
import pytest
import sympy as sp

from rodproof.codegen import generate, lower, scene
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import groups, live, substitution
from rodproof.codegen.targets.mpmath_target import Evaluator
from rodproof.codegen.texts import function_text

MP = mpmath.mp.clone()
MP.dps = 60
SCENES = {name: scene.committed(name) for name in scene.committed_names()}
FULL = SCENES["full_rod"]
TEXT = generate.render(FULL)
NAIVE = {kernel.name: kernel for kernel in lower.lower(FULL)}
CALLS = [(name, f) for name, s in SCENES.items() for f in s.functions]
CONSTANTS = {"alpha": F(7, 10), "beta": F(11, 10), "zeta": F(9, 10), "eta": F(8, 5)}
CONSTANTS |= {"iota": F(-2, 5), "gamma": F(23, 10), "p": F(33, 10)}
LOADS = ((F(3, 10), F(-7, 11), F(13, 10), F(-2, 7), F(17, 9), F(5, 13)), (1, 2, 3, 4, -5, 6))
STRAINS = (
    (F(1, 10), F(-2, 11), F(3, 17), F(-1, 7), F(2, 9), F(14, 13)),
    (0, F(1, 3), F(-1, 9), F(1, 99), 0, F(4, 5)),
)


def _binary(operation: Callable[[Any, Any], Any]) -> tuple[Callable, Callable]:
    def forward(a: Exact, b: Any) -> Any:
        if isinstance(b, np.ndarray):
            return NotImplemented
        return Exact(operation(a.value, Exact(b).value))

    def backward(a: Exact, b: Any) -> Any:
        return Exact(operation(Exact(b).value, a.value))

    return forward, backward


def _compare(operation: Callable[[Any, Any], bool]) -> Callable:
    def compared(a: Exact, b: Any) -> Any:
        if isinstance(b, np.ndarray):
            return NotImplemented
        return operation(a.value, Exact(b).value)

    return compared


class Exact:
    """A 60-digit number with the methods that NumPy's functions look for in object arrays."""

    def __init__(self, value: Any) -> None:
        if isinstance(value, Exact):
            value = value.value
        elif isinstance(value, F):
            value = MP.mpf(value.numerator) / value.denominator
        self.value = MP.mpf(value)

    __add__, __radd__ = _binary(operator.add)
    __sub__, __rsub__ = _binary(operator.sub)
    __mul__, __rmul__ = _binary(operator.mul)
    __truediv__, __rtruediv__ = _binary(operator.truediv)

    __lt__, __le__, __gt__, __ge__ = (
        _compare(c) for c in (operator.lt, operator.le, operator.gt, operator.ge)
    )

    def __pow__(self, power: int) -> Exact:
        return Exact(self.value**power)

    def __neg__(self) -> Exact:
        return Exact(-self.value)

    def __abs__(self) -> Exact:
        return Exact(abs(self.value))

    def __float__(self) -> float:
        return float(self.value)


for _name in ("sqrt", "exp", "log", "log1p", "expm1"):
    setattr(Exact, _name, lambda self, _name=_name: Exact(getattr(MP, _name)(self.value)))


def load(text: str) -> ModuleType:
    """The module of the text, for exact numbers."""
    module = ModuleType("exact_rod")
    # dataclass looks its module up by name; the record is not needed here
    exec(compile(text.replace("@dataclass(frozen=True)\n", ""), "rod", "exec"), module.__dict__)
    tiny, kind = Exact("1e-100000"), np.dtype(object)
    module.TINY[kind] = tiny
    vars(module).get("LOG_MAX", {})[kind] = Exact("1e9")
    module._scratch = lambda count, like: np.empty((count, like.shape[-1]), like.dtype)
    module._work_share = np.vectorize(_share, otypes=[object])
    return module


def _share(depth: Exact, c: Any) -> Exact:
    p = c.p.value
    return Exact(MP.hyp2f1(1, 1 / p, 1 + 2 / p, -MP.expm1(depth.value)) / 2)


@cache
def constants_of(name: str) -> dict[str, Any]:
    """Numbers for the constants; those of the scene where it fixes them."""
    known = {s.name: v for s, v in substitution(SCENES[name]).items() if s.name in CONSTANTS}
    return CONSTANTS | {key: F(int(value)) for key, value in known.items()}


@cache
def exact_constants(name: str, *, plainly: bool) -> SimpleNamespace:
    """The constants and what the kernels derive from them; ``plainly`` opens the plain bodies."""
    given = constants_of(name)

    def value(expr: sp.Expr) -> Exact:
        return Exact(expr.subs({s: given[s.name] for s in expr.free_symbols}).evalf(70)._mpf_)

    def derived(kernels: list[Kernel]) -> dict[str, Exact]:
        return {a.name: value(a.expr) for kernel in kernels for a in kernel.constants}

    kernels = generate.kernels(SCENES[name])
    plain = [k.plain for k in kernels if k.plain]
    bounds = (Exact(0), Exact("1e9")) if plainly else (Exact(1), Exact(0))
    within = {f"within_{k.region.quantity}": {np.dtype(object): bounds} for k in plain}
    return SimpleNamespace(
        **{key: Exact(value) for key, value in given.items()},
        **derived([*kernels]),
        plain=SimpleNamespace(**derived(plain), **within),
    )


@cache
def heads_of(own: str) -> dict[str, tuple[dict[str, tuple[int, ...]], ...]]:
    """The leading shapes of what each function takes, and of what it returns."""
    texts = {k.name: function_text(k, SCENES[own]) for k in generate.kernels(SCENES[own])}
    return {name: (text.inputs, text.outputs) for name, text in texts.items()}


def run(
    module: ModuleType, own: str, name: str, point: tuple, *, plainly: bool = False
) -> dict[tuple, Any]:
    """What the body of a function writes, by array and index."""
    at = live(SCENES[own]).loads
    taken, made = heads_of(own)[name]
    left = [Exact(point[i]) for i in at]
    blocks = []
    for head in taken.values():
        own_rows = [left.pop(0) for _ in range(head[0] if head else 1)]
        blocks.append(np.array(own_rows, dtype=object).reshape(*head, 1))
    outs = {array: np.empty((*head, 1), dtype=object) for array, head in made.items()}
    constants = exact_constants(own, plainly=plainly)
    body = getattr(module, f"_{name}_plain" if plainly else f"_{name}")
    assert body(*blocks, constants, *outs.values()) is (True if plainly else None)
    return {
        (array, index): out[(*index, 0)].value
        for array, out in outs.items()
        for index in np.ndindex(out.shape[:-1])
    }


@cache
def true_values(own: str, name: str, point: tuple) -> dict[tuple, Any]:
    """The naive full rod at the scene's loads or strains, at the places of the scene's arrays."""
    if name == "loads_and_stiffness":
        return true_values(own, "loads", point) | true_values(own, "stiffness", point)
    if name == "strains_and_gap":
        whole = [point[i] if i in live(SCENES[own]).loads else 0 for i in range(6)]
        full = Evaluator(60).evaluate(
            NAIVE[name], dict(zip(NAIVE[name].inputs, whole, strict=True)), constants_of(own)
        )
        gap = {("limit_gap", ()): full["limit_gap", ()]}
        return true_values(own, "strains", point) | gap
    kernel, at = NAIVE[name], live(SCENES[own])
    rest = (0, 0, 0, 0, 0, 0 if kernel.inputs[0] == "m1" else 1)
    whole = [point[i] if i in at.loads else rest[i] for i in range(6)]
    inputs = dict(zip(kernel.inputs, whole, strict=True))
    full = Evaluator(60).evaluate(kernel, inputs, constants_of(own))
    if name in ("stiffness", "compliance", "stiffness_at_loads"):
        array, n = kernel.outputs[0].array, len(at.loads)
        return {
            (array, (i, j)): full[array, tuple(sorted((at.loads[i], at.loads[j])))]
            for i in range(n)
            for j in range(n)
        }
    if name not in ("strains", "loads"):
        return full
    letters, kept = ("uv", at.strains) if name == "strains" else ("mn", at.loads)
    return {
        (g.array, g.place(i)): full[letters[i // 3], (i % 3,)]
        for g in groups(letters, kept)
        for i in g.components
    }


def scaled(module: ModuleType) -> ModuleType:
    """The module with its gauge at another scale, as where squares would overflow."""
    scale = Exact(F(37, 5))

    def rescaled(form: Callable, inputs: list, c: Any) -> tuple:
        *values, square = form([scale * row for row in inputs], c)
        return values, square, Exact(1) / scale, square / (scale * scale)

    def balanced(*args: Any) -> tuple:
        values, square, unscale, plain = rescaled(*args)
        size = np.sqrt(square)
        return values, size, size * unscale, unscale, plain

    return changed(module, _balanced=balanced, _rescaled=rescaled)


def changed(module: ModuleType, **functions: Callable) -> ModuleType:
    """A copy of the module with other functions under these names."""
    other = ModuleType("other_rod")
    vars(other).update({k: v for k, v in vars(module).items() if not isinstance(v, FunctionType)})
    for key, value in vars(module).items():
        if isinstance(value, FunctionType):
            vars(other)[key] = FunctionType(value.__code__, vars(other), key, value.__defaults__)
    vars(other).update(functions)
    return other


def distance(got: dict[tuple, Any], own: str, name: str, point: tuple) -> float:
    want = true_values(own, name, point)
    assert got.keys() == want.keys()
    return float(max(abs(got[k] - want[k]) for k in want) / max(map(abs, want.values())))


@cache
def exact(own: str) -> ModuleType:
    return load(generate.render(SCENES[own]))


@pytest.mark.parametrize("which", [0, 1])
@pytest.mark.parametrize(("own", "name"), CALLS)
def test_text_is_the_derivation(own: str, name: str, which: int) -> None:
    """Every scene is the full rod restricted to it: to fifty digits, and as printed."""
    point = (LOADS if NAIVE[name].inputs[0] == "m1" else STRAINS)[which]
    for module in (exact(own), scaled(exact(own))):
        assert distance(run(module, own, name, point), own, name, point) < 1e-50
    if hasattr(exact(own), f"_{name}_plain"):
        plainly = run(exact(own), own, name, point, plainly=True)
        assert distance(plainly, own, name, point) < 1e-50


#: An operator or a function, and another in its place.
TURNS = (
    (" * ", " / "),
    (" + ", " - "),
    (" - ", " + "),
    (" += ", " -= "),
    (" -= ", " += "),
    (" *= ", " /= "),
    (" /= ", " *= "),
    ("multiply", "add"),
    ("subtract", "add"),
    ("np.add", "np.subtract"),
    ("np.square", "np.sqrt"),
    ("**2", "**3"),
    ("np.divide", "np.multiply"),
)


def slips() -> list[tuple[str, str, str]]:
    """A body or a step with one operator turned, and the function to look at: every operator.

    The last entry is the way on which the line lies: plain, careful, or careful with a scale.
    """
    lines = TEXT.split("\n")
    users = {"_reduce_loads": "compliance", "_soften": "compliance"}
    users |= {"_reduce_strains": "stiffness", "_stiffen": "stiffness"}
    users |= {"_harden": "stiffness_at_loads"}
    plain = {"_overload": "strains", "_q": "loads_and_stiffness"}
    plain |= {f"_{name}_plain": name for name in NAIVE}
    users |= {"_spread": "compliance"}
    users |= plain | {f"_{name}": name for name in NAIVE}
    found = []
    for node in ast.parse(TEXT).body:
        if not isinstance(node, ast.FunctionDef) or node.name not in users:
            continue
        simple = (ast.Assign, ast.AugAssign, ast.Expr)
        for statement in (inner for inner in ast.walk(node) if isinstance(inner, simple)):
            place, end = statement.lineno - 1, statement.end_lineno
            text = "\n".join(lines[place:end])
            if '"""' in text or "tiny" in text:
                continue
            way = "plain" if node.name in plain else "careful"
            way = "scaled" if "unscale" in text else way
            for old, new in TURNS:
                for at in (m.start() for m in re.finditer(re.escape(old), text)):
                    turned = text[:at] + new + text[at + len(old) :]
                    wrong = [*lines[:place], turned, *lines[end:]]
                    found.append((users[node.name], "\n".join(wrong), way))
    return found


def test_broken_twins_of_the_text_are_rejected() -> None:
    """One operator turned in any line of the mathematics, and the comparison fails."""
    twins = slips()
    survivors = []
    for name, text, way in twins:
        point = (LOADS if NAIVE[name].inputs[0] == "m1" else STRAINS)[0]
        try:
            module = scaled(load(text)) if way == "scaled" else load(text)
            got = run(module, "full_rod", name, point, plainly=way == "plain")
            wrong = distance(got, "full_rod", name, point)
        except Exception:  # a twin may leave the domain in any way: rejected
            continue
        if wrong < 1e-50:
            changed = set(text.split("\n")) - set(TEXT.split("\n"))
            survivors.append((name, changed))
    assert len(twins) > 350
    assert not survivors
