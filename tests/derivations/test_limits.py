"""Exact limits with symbolic p, against numbers far out."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.exact.limits import limit

a, b, p = sp.symbols("a b p", positive=True)
N = sp.Symbol("N", real=True)

CASES = [
    ((1 + b**p * sp.Abs(N) ** p) ** (-1 / p) * a * N, sp.oo, a / b),
    ((1 + b**p * sp.Abs(N) ** p) ** (-1 / p) * a * N, -sp.oo, -a / b),
    ((a + b * N**2) / (1 + N**2), sp.oo, b),
    ((sp.Abs(N) ** p + 1) ** (1 / p), sp.oo, sp.oo),
    (a / (1 + sp.Abs(N) ** p), -sp.oo, sp.Integer(0)),
    (sp.acos(N / sp.sqrt(1 + 4 * N**2)), sp.oo, sp.pi / 3),
    ((1 + N) ** (1 / p), sp.Integer(0), sp.Integer(1)),
]


@pytest.mark.parametrize(("expr", "target", "wanted"), CASES)
def test_limits(expr: sp.Expr, target: sp.Expr, wanted: sp.Expr) -> None:
    found = limit(expr, N, target)
    assert found == wanted or Field().equal(found, wanted)


@pytest.mark.parametrize(("expr", "target", "wanted"), [c for c in CASES if c[2].is_finite])
def test_limits_are_approached(expr: sp.Expr, target: sp.Expr, wanted: sp.Expr) -> None:
    far = {sp.oo: 10**200, -sp.oo: -(10**200)}.get(target, sp.Rational(1, 10**200))
    point = {a: sp.Rational(3, 7), b: sp.Rational(9, 5), p: sp.Rational(11, 7)}
    near = Evaluator(context(50), {**point, N: sp.sympify(far)})(expr)
    exact = Evaluator(context(50), point)(wanted)
    assert abs(near - exact) < 10**-40


def test_undecided_limits_are_errors() -> None:
    with pytest.raises(OutOfReach, match="cancel"):
        limit(sp.sqrt(N**2 + 1) - N, N, sp.oo)
    q = sp.Symbol("q", positive=True)
    with pytest.raises(OutOfReach, match="compared"):
        limit(sp.Abs(N) ** p + sp.Abs(N) ** q, N, sp.oo)
    with pytest.raises(OutOfReach, match="not known to be positive"):
        limit(((a - b) * N) ** p, N, sp.oo)
