"""The kernels are the derivation: naive and stable forms agree to the last of 50 digits."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction as F

import mpmath
import pytest
import sympy as sp

from rodproof.codegen import generate, lower, scene
from rodproof.codegen.count import cost
from rodproof.codegen.kernel import (
    Assignment,
    Kernel,
    KernelError,
    Output,
    symbol,
    validate,
)
from rodproof.codegen.passes import plain as plain_rules
from rodproof.codegen.passes.order import order
from rodproof.codegen.passes.specialise import drop_dead
from rodproof.codegen.targets.mpmath_target import Evaluator, LimitError
from rodproof.derivations.symbols import CONSTANTS as CONSTANT_SYMBOLS
from rodproof.derivations.symbols import LOADS, STRAINS, p
from rodproof.derivations.theory import constitutive as theory

FULL = scene.committed("full_rod")
NAIVE = {kernel.name: kernel for kernel in lower.lower(FULL)}
STABLE = {kernel.name: kernel for kernel in generate.kernels(FULL)}
NAMES = tuple(NAIVE)
KNOWN = frozenset(s.name for s in CONSTANT_SYMBOLS)

# Generic: no p or 1/p an integer, gamma not 1, iota not 0, signs mixed.
ROD = {"alpha": F(7, 10), "beta": F(11, 10), "zeta": F(9, 10), "eta": F(8, 5), "iota": F(-2, 5)}
CONSTANTS = (
    {**ROD, "gamma": F(23, 10), "p": F(33, 10)},
    {**ROD, "gamma": F(1, 7), "p": F(17, 20), "iota": F(13, 10)},
)
POINTS = {
    "m1": (F(3, 10), F(-7, 11), F(13, 10), F(-2, 7), F(17, 9), F(5, 13)),
    "u1": (F(1, 10), F(-2, 11), F(3, 17), F(-1, 7), F(2, 9), F(14, 13)),
}


def values(kernel: Kernel, constants: dict, digits: int = 50, **how: object) -> dict:
    point = dict(zip(kernel.inputs, POINTS[kernel.inputs[0]], strict=True))
    scale = how.pop("scale", 1)
    return Evaluator(digits, **how).evaluate(kernel, point, constants, scale)


def distance(a: dict, b: dict) -> float:
    assert a.keys() == b.keys()
    size = max(abs(value) for value in a.values())
    return float(max(abs(a[key] - b[key]) for key in a) / size)


@pytest.mark.parametrize("constants", CONSTANTS, ids=["p=3.3", "p=0.85"])
@pytest.mark.parametrize("name", NAMES)
def test_stable_kernel_is_the_derivation(name: str, constants: dict) -> None:
    """Energies too: the naive kernel holds their defining integrals, by quadrature here."""
    naive = values(NAIVE[name], constants)
    assert distance(naive, values(STABLE[name], constants)) < 1e-46
    assert distance(naive, values(STABLE[name], constants, quadrature=True)) < 1e-46


@pytest.mark.parametrize("name", NAMES)
def test_lowered_kernel_is_the_derived_expression(name: str) -> None:
    """Against SymPy's own evaluation of the derivation, Hessians differentiated entry by entry."""
    derived = {
        "strains": lambda: [*theory.strains()],
        "loads": lambda: [*theory.loads()],
        "stored_energy": lambda: [theory.stored_energy()],
        "complementary_energy": lambda: [theory.complementary_energy()],
        "stiffness": lambda: _upper(theory.stiffness()),
        "loads_and_stiffness": lambda: [*theory.loads(), *_upper(theory.stiffness())],
        "compliance": lambda: _upper(theory.compliance()),
        "strains_and_gap": lambda: [*theory.strains(), 1 - sp.sqrt(theory.quadratic_form()) ** p],
        "stiffness_at_loads": lambda: _upper(theory.stiffness()),
    }[name]()
    constants = CONSTANTS[0]
    symbols = LOADS if NAIVE[name].inputs[0] == "m1" else STRAINS
    exact = dict(zip(symbols, POINTS[symbols[0].name], strict=True))
    exact |= {s: constants[s.name] for s in CONSTANT_SYMBOLS}
    numbers = {s: sp.Rational(v.numerator, v.denominator) for s, v in exact.items()}
    if name in ("strains_and_gap", "stiffness_at_loads"):  # also of the strains that loads cause
        caused = [sp.N(expr.subs(numbers), 60) for expr in theory.strains()]
        numbers |= dict(zip(STRAINS, [*caused[:5], caused[5] + 1], strict=True))
    got = list(values(NAIVE[name], constants).values())
    if name.startswith("strains"):
        got[5] -= 1
    for expr, value in zip(derived, got, strict=True):
        with mpmath.workdps(50):
            want = mpmath.mpf(sp.N(expr.subs(numbers), 40)._mpf_)
            assert abs(want - value) < abs(want) * mpmath.mpf(10) ** -37


def _upper(matrix: sp.Matrix) -> list[sp.Expr]:
    return [matrix[i, j] for i in range(6) for j in range(i, 6)]


@pytest.mark.parametrize("name", [n for n in NAMES if STABLE[n].gauge])
@pytest.mark.parametrize("scale", [F(37, 5), F(1, 2**400), F(2**300)])
def test_gauge_does_not_matter(name: str, scale: F) -> None:
    one = values(STABLE[name], CONSTANTS[0])
    assert distance(one, values(STABLE[name], CONSTANTS[0], scale=scale)) < 1e-46


@pytest.mark.parametrize("name", NAMES)
def test_broken_twins_are_rejected(name: str) -> None:
    """A slip in any one assignment or output changes the value: the check can fail."""
    kernel = STABLE[name]
    right = values(kernel, CONSTANTS[0])
    survivors = []
    for what, twin in _twins(kernel):
        try:
            wrong = values(twin, CONSTANTS[0])
        except (LimitError, ZeroDivisionError, ValueError):
            continue
        if distance(right, wrong) < 1e-46:
            survivors.append(what)
    assert not survivors


def _twins(kernel: Kernel) -> list[tuple[str, Kernel]]:
    """The kernel with one assignment or output times 2 or 1/3 (the energies are even in signs)."""
    twins = []
    for factor in (2, sp.Rational(1, 3)):
        for k, a in enumerate(kernel.body):
            body = (*kernel.body[:k], replace(a, expr=factor * a.expr), *kernel.body[k + 1 :])
            twins.append((f"{factor}*{a.name}", replace(kernel, body=body)))
    for k, o in enumerate(kernel.outputs):
        outputs = (*kernel.outputs[:k], replace(o, expr=-o.expr), *kernel.outputs[k + 1 :])
        twins.append((f"-{o.array}{o.index}", replace(kernel, outputs=outputs)))
    return twins


def test_limit_is_refused() -> None:
    kernel = STABLE["loads"]
    point = dict(zip(kernel.inputs, (9, 0, 0, 0, 0, 1), strict=True))
    with pytest.raises(LimitError, match=r"Q\(u, v\) < 1"):
        Evaluator().evaluate(kernel, point, CONSTANTS[0])


@pytest.mark.parametrize("name", NAMES)
def test_kernels_are_valid_before_and_after(name: str) -> None:
    validate(order(NAIVE[name]), KNOWN)
    validate(STABLE[name], KNOWN)


def test_validate_and_order_refuse_nonsense() -> None:
    a, b = symbol("a"), symbol("b")
    loop = Kernel("k", (), (Assignment("a", b), Assignment("b", a)), (Output("w", (), a),))
    with pytest.raises(KernelError, match="depends on itself"):
        order(loop)
    with pytest.raises(KernelError, match="uses 'b' before it is set"):
        validate(loop, frozenset())
    twice = replace(loop, body=(Assignment("a", p), Assignment("a", p)))
    with pytest.raises(KernelError, match="'a' is set twice"):
        validate(twice, KNOWN)


PLAIN = [n for n in NAMES if n in plain_rules.PLAIN]
TWO = {"p": 2}


def plain_of(name: str, *, square: bool) -> Kernel:
    found = plain_rules.plain(NAIVE[name], square=square)
    assert found is not None
    return order(drop_dead(replace(found, form=None)))  # which keeps what no output needs


@pytest.mark.parametrize("constants", [*CONSTANTS, CONSTANTS[0] | TWO], ids=["3.3", "0.85", "2"])
@pytest.mark.parametrize("name", PLAIN)
def test_plain_kernel_is_an_identity(name: str, constants: dict) -> None:
    """Without gauge, limit, norm and radius it is the derivation; every assignment matters."""
    plain = plain_of(name, square=constants["p"] == 2)
    assert plain.gauge is None
    assert plain.limit is None
    assert not {"size", "x", "y"} & {s.name for e in plain.expressions() for s in e.free_symbols}
    assert distance(values(NAIVE[name], constants), values(plain, constants)) < 1e-46
    survivors = []
    for k, a in enumerate(plain.body):
        twin = replace(a, expr=2 * a.expr)
        wrong = replace(plain, body=(*plain.body[:k], twin, *plain.body[k + 1 :]))
        if distance(values(plain, constants), values(wrong, constants)) < 1e-46:
            survivors.append(a.name)
    assert not survivors


def test_plain_kernels_take_fewer_operations() -> None:
    """In every committed scene, and no plain kernel has a guard."""
    for own in map(scene.committed, scene.committed_names()):
        for kernel in generate.kernels(own):
            if kernel.plain is None:
                continue
            assert not any(
                e.has(sp.Max, sp.Min, sp.Piecewise) for e in kernel.plain.expressions()
            ), kernel.name
            guarded = replace(kernel, plain=None)
            assert calls_of(kernel.plain) < calls_of(guarded), (own.name, kernel.name)


def calls_of(kernel: Kernel) -> int:
    """How many operations a target that takes one at a time carries out."""
    found = cost(kernel)
    return found.arithmetic + found.transcendental


def test_functions_without_a_plain_kernel() -> None:
    """The energies' cost is their share; the compliance keeps its sums of squares everywhere."""
    assert set(NAMES) - set(PLAIN) == {"stored_energy", "complementary_energy", "compliance"}
