"""The exact engine proves what is true and never what is false."""

from __future__ import annotations

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach

a, b, c, p = sp.symbols("a b c p", positive=True)
x, y = sp.symbols("x y", real=True)


TRUE = [
    ((a * b) ** p, a**p * b**p),
    ((a**p + b**p) ** (-1 / p) * a, (1 + (b / a) ** p) ** (-1 / p)),
    ((a**2 * b) ** (p / 2), a**p * b ** (p / 2)),
    (a ** (p / 2 - 1) * a, a ** (p / 2)),
    (sp.sqrt(8 * a) * sp.sqrt(2 * a), 4 * a),
    ((a + b) ** (1 / p + 1), (a + b) * (a + b) ** (1 / p)),
    (sp.sin(x) ** 4 - sp.cos(x) ** 4, 1 - 2 * sp.cos(x) ** 2),
    (sp.sin(x + y), sp.sin(x) * sp.cos(y) + sp.cos(x) * sp.sin(y)),
    (sp.tan(x) * sp.cot(x), sp.Integer(1)),
    (sp.Abs(x) ** 2, x**2),
    (1 / (a - x) - 1 / (a + x), 2 * x / (a**2 - x**2)),
]
FALSE = [
    ((a + b) ** p, a**p + b**p),
    ((a**p + b**p) ** (1 / p), a + b),
    (a ** (p / 2), a**p),
    (sp.Abs(x), x),
    (sp.sqrt(a**2 + b**2), a + b),
    (sp.sin(x) ** 2 - sp.cos(x) ** 2, sp.Integer(1)),
    (a ** (1 / p), a**p),
]


@pytest.mark.parametrize(("left", "right"), TRUE)
def test_identities_are_proved(left: sp.Expr, right: sp.Expr) -> None:
    assert Field().equal(left, right)


@pytest.mark.parametrize(("left", "right"), FALSE)
def test_false_identities_are_not_proved(left: sp.Expr, right: sp.Expr) -> None:
    assert not Field().equal(left, right)


@st.composite
def expressions(draw: st.DrawFn, depth: int = 3) -> sp.Expr:
    """Positive expressions: sums, products and real powers of positive symbols."""
    if depth == 0:
        return draw(st.sampled_from([a, b, c, sp.Integer(2), sp.Rational(1, 3)]))
    kind = draw(st.sampled_from(("sum", "product", "power")))
    first = draw(expressions(depth=depth - 1))
    if kind == "power":
        return first ** draw(st.sampled_from([p, p / 2, -1 / p, 1 / p, sp.Integer(2), -p / 2 - 1]))
    second = draw(expressions(depth=depth - 1))
    return first + second if kind == "sum" else first * second


@given(expressions())
def test_rewriting_keeps_the_value(expr: sp.Expr) -> None:
    """The quotient of polynomials has the value of the expression (40 digits, generic point)."""
    field = Field()
    try:
        fraction = field.fraction(expr)
    except OutOfReach:
        return
    back = field._expression(fraction.num) / field._expression(fraction.den)
    point = {s: sp.Rational(7 + 3 * k, 11) for k, s in enumerate((a, b, c))}
    evaluate = Evaluator(context(50), {**point, p: sp.Rational(37, 13)})
    wanted, found = evaluate(expr), evaluate(back)
    assert abs(wanted - found) <= abs(wanted) * 10**-40


@given(expressions())
def test_signs_of_positive_expressions(expr: sp.Expr) -> None:
    field = Field()
    try:
        assert field.sign(expr) == 1
        assert field.sign(-expr) == -1
    except OutOfReach:
        pass


def test_signs_need_a_reason() -> None:
    field = Field()
    assert field.sign(a - b) is None
    assert field.sign(x**2) is None  # x may be zero
    assert field.sign(x**2 + 1) == 1
    assert field.sign(x**3) is None
    assert field.sign(x - x) == 0
    assert field.sign(sp.Abs(x)) is None and field.sign(sp.Abs(x) ** p) is None  # may vanish
    assert field.sign(1 + sp.Abs(x) ** p) == 1


def test_a_product_known_positive_gives_both_factors() -> None:
    """(a b - x)(a b + x) > 0 with a b > 0: both factors are positive."""
    field = Field((a**2 * b**2 - x**2,))
    assert field.sign(a * b - x) == 1
    assert field.sign(a * b + x) == 1
    assert Field((x**2 - y**2,)).sign(x - y) is None  # the sum 2x has no sign


def test_what_stops_the_engine_is_said() -> None:
    with pytest.raises(OutOfReach, match="negative number"):
        Field().fraction((-a) ** p)
    with pytest.raises(OutOfReach, match="identically zero"):
        Field().fraction(1 / sp.Add(x, -x, evaluate=False))
    with pytest.raises(OutOfReach, match="not a finite"):
        Field().fraction(sp.Add(sp.oo, x, evaluate=False))
