"""Exact limits with symbolic exponents, by leading terms.

As h -> 0+ every expression of the theory behaves like c h^e with an exponent e that may contain
p. Leading terms multiply, take real powers (of a positive coefficient) and add, where the terms
of smallest exponent win; p > 0 decides which exponent is smaller. Nothing is guessed: a leading
coefficient that cancels, or two exponents that cannot be compared, is an error.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from rodproof.derivations.exact.field import Field, OutOfReach

_h = sp.Symbol("h", positive=True)


@dataclass(frozen=True)
class LeadingTerm:
    """`coefficient * h**exponent (1 + o(1))` as h -> 0+; coefficient 0 means identically zero."""

    coefficient: sp.Expr
    exponent: sp.Expr


def limit(
    expr: sp.Expr, variable: sp.Symbol, target: sp.Expr, positive: tuple[sp.Expr, ...] = ()
) -> sp.Expr:
    """The limit of `expr` as `variable` tends to `target` (a number, or +oo or -oo).

    A finite target is approached from above, and from below too if the variable may have either
    sign. positive: quantities known to be positive, which decide signs under real powers. Raises
    OutOfReach where leading terms do not decide.
    """
    field = Field(positive)
    if target in (sp.oo, -sp.oo):
        return _value(expr.subs(variable, 1 / _h if target == sp.oo else -1 / _h), field)
    above = _value(expr.subs(variable, target + _h), field)
    if not variable.is_nonnegative:
        below = _value(expr.subs(variable, target - _h), field)
        if above != below and not field.equal(above, below):
            raise OutOfReach(f"{expr} tends to {above} from above and to {below} from below")
    return above


def _value(expr: sp.Expr, field: Field) -> sp.Expr:
    if isinstance(expr, sp.acos | sp.asin | sp.atan | sp.cos | sp.sin):
        inner = _value(expr.args[0], field)
        if inner.is_infinite and not isinstance(expr, sp.atan):
            raise OutOfReach(f"{expr} has no limit where its argument grows without bound")
        return expr.func(inner)  # continuous: the limit goes inside
    term = leading_term(expr, field)
    if term.coefficient == 0 or term.exponent.is_positive:
        return sp.Integer(0)
    if term.exponent == 0:
        return term.coefficient
    if term.exponent.is_negative:
        sign = field.sign(term.coefficient)
        if sign:
            return sign * sp.oo
    raise OutOfReach(f"the limit of {expr} is not decided by its leading term {term}")


def leading_term(expr: sp.Expr, field: Field) -> LeadingTerm:
    """The leading term of `expr` in h."""
    if not expr.has(_h):
        return LeadingTerm(expr, sp.Integer(0))
    if expr == _h:
        return LeadingTerm(sp.Integer(1), sp.Integer(1))
    if isinstance(expr, sp.Mul):
        parts = [leading_term(a, field) for a in expr.args]
        return LeadingTerm(
            sp.Mul(*(t.coefficient for t in parts)),
            sp.expand(sp.Add(*(t.exponent for t in parts))),
        )
    if isinstance(expr, sp.Pow):
        return _power(leading_term(expr.base, field), expr.exp, field)
    if isinstance(expr, sp.Abs):
        inner = leading_term(expr.args[0], field)
        return LeadingTerm(sp.Abs(inner.coefficient), inner.exponent)
    if isinstance(expr, sp.Add):
        return _sum([leading_term(a, field) for a in expr.args], field)
    if isinstance(expr, sp.cos | sp.sin):
        value = _value(expr.args[0], field)
        if expr.func(value) != 0:
            return LeadingTerm(expr.func(value), sp.Integer(0))
        if isinstance(expr, sp.sin) and value == 0:
            return leading_term(expr.args[0], field)
    raise OutOfReach(f"no leading term for {expr}")


def _power(base: LeadingTerm, exponent: sp.Expr, field: Field) -> LeadingTerm:
    if exponent.has(_h):
        raise OutOfReach("the variable of the limit stands in an exponent")
    if not exponent.is_Integer and field.sign(base.coefficient) != 1:
        raise OutOfReach(f"a real power of {base.coefficient}, which is not known to be positive")
    if not exponent.is_nonnegative and not field.sign(base.coefficient):
        raise OutOfReach(f"a quotient by {base.coefficient}, which is not known to be nonzero")
    return LeadingTerm(base.coefficient**exponent, sp.expand(base.exponent * exponent))


def _sum(terms: list[LeadingTerm], field: Field) -> LeadingTerm:
    terms = [t for t in terms if t.coefficient != 0]
    best = terms[0].exponent
    for term in terms[1:]:
        difference = sp.expand(term.exponent - best)
        if difference.is_negative:
            best = term.exponent
        elif difference != 0 and not difference.is_positive:
            raise OutOfReach(f"exponents {term.exponent} and {best} cannot be compared")
    total = sp.Add(*(t.coefficient for t in terms if sp.expand(t.exponent - best) == 0))
    if field.is_zero(total):
        raise OutOfReach("leading terms cancel")
    return LeadingTerm(total, best)
