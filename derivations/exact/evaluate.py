"""Numbers for expressions, at any precision, in an mpmath context of our own.

Unlike `sympy.evalf` this evaluates exactly what is written: an `Integral` by quadrature, a
`Derivative` by a numerical derivative. That makes it a second route, independent of SymPy's
differentiation and of the exact engine.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatchmethod
from typing import Any

import mpmath
import sympy as sp

Number = Any  # mpf or mpc of the context


def context(digits: int) -> Any:
    """A fresh mpmath context that carries `digits` digits; no global state is touched."""
    ctx = mpmath.mp.clone()
    ctx.dps = digits
    return ctx


class Evaluator:
    """Evaluates SymPy expressions at one point: `values` maps symbols to numbers."""

    def __init__(self, ctx: Any, values: Mapping[sp.Symbol, Any]) -> None:
        self.ctx = ctx
        self.values = numbers(ctx, values)
        self._cache: dict[sp.Basic, Number] = {}

    def __call__(self, expr: sp.Basic) -> Number:
        found = self._cache.get(expr)
        if found is None:
            found = self._cache[expr] = self._visit(expr)
        return found

    def moved(self, symbol: sp.Symbol, value: Number) -> Evaluator:
        """The same evaluator with one symbol moved to another value."""
        return Evaluator(self.ctx, {**self.values, symbol: value})

    @singledispatchmethod
    def _visit(self, expr: sp.Basic) -> Number:
        function = getattr(self.ctx, type(expr).__name__.lower(), None)
        if function is None:
            raise TypeError(f"no numerical rule for {type(expr).__name__}: {expr}")
        return function(*(self(a) for a in expr.args))

    @_visit.register
    def _(self, expr: sp.Symbol) -> Number:
        return self.values[expr]

    @_visit.register
    def _(self, expr: sp.Rational) -> Number:
        return self.ctx.mpf(int(expr.p)) / int(expr.q)

    @_visit.register
    def _(self, expr: sp.NumberSymbol) -> Number:
        return {sp.pi: +self.ctx.pi, sp.E: +self.ctx.e}[expr]

    @_visit.register
    def _(self, expr: sp.Add) -> Number:
        return self.ctx.fsum(self(a) for a in expr.args)

    @_visit.register
    def _(self, expr: sp.Mul) -> Number:
        return self.ctx.fprod(self(a) for a in expr.args)

    @_visit.register
    def _(self, expr: sp.Pow) -> Number:
        base, exponent = expr.args
        if isinstance(exponent, sp.Integer):
            return self(base) ** int(exponent)
        return self.ctx.power(self(base), self(exponent))

    @_visit.register
    def _(self, expr: sp.Abs) -> Number:
        return abs(self(expr.args[0]))

    @_visit.register
    def _(self, expr: sp.hyper) -> Number:
        return self.ctx.hyper(
            [self(a) for a in expr.ap], [self(b) for b in expr.bq], self(expr.argument)
        )

    @_visit.register
    def _(self, expr: sp.Integral) -> Number:
        integrand, (variable, lower, upper) = expr.args[0], expr.args[1].args

        def at(value: Number) -> Number:
            return self.moved(variable, value)(integrand)

        return self.ctx.quad(at, [self(lower), self(upper)])

    @_visit.register
    def _(self, expr: sp.Derivative) -> Number:
        function, (variable, order) = expr.args[0], expr.args[1].args
        return self.ctx.diff(
            lambda value: self.moved(variable, value)(function), self(variable), int(order)
        )


def number(ctx: Any, value: Any) -> Number:
    """A rational of SymPy, or a number of any kind, as one of the context."""
    if isinstance(value, sp.Rational):
        return ctx.mpf(int(value.p)) / int(value.q)
    return ctx.convert(value)


def numbers(ctx: Any, point: Mapping[sp.Symbol, Any]) -> dict[sp.Symbol, Number]:
    """A point in the numbers of the context."""
    return {symbol: number(ctx, value) for symbol, value in point.items()}
