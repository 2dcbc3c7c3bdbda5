"""Prints SymPy expressions as NumPy text that a person would have written."""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp
from sympy.codegen.cfunctions import expm1, log1p

from rodproof.codegen.kernel import Assignment
from rodproof.codegen.primitives import WorkShare

FUNCTIONS: dict[type, str] = {
    sp.exp: "np.exp",
    sp.log: "np.log",
    log1p: "np.log1p",
    expm1: "np.expm1",
    sp.Max: "np.maximum",
    sp.Min: "np.minimum",
}
SUM, PRODUCT, POWER, ATOM = range(4)  # how tightly a piece of text binds


class Printer:
    """Text of an expression, with ``spelling`` for symbols that are not written as their name.

    Symbols in ``spelling`` are scalars; products are printed with them first, so that NumPy
    multiplies scalars before arrays. ``places`` are names of arrays that are written as entries
    of others. Expressions other than those of the kernels raise TypeError.
    """

    def __init__(
        self, spelling: Mapping[str, str], places: Mapping[str, str] | None = None
    ) -> None:
        self.spelling = spelling
        self.places = places or {}

    def name(self, a: Assignment) -> str:
        """What stands on the left of the assignment."""
        return self.places.get(a.name, a.name)

    def text(self, expr: sp.Expr, tight: int = SUM) -> str:
        """The expression, in parentheses if it binds less than ``tight``."""
        text, binding = self._print(expr)
        return f"({text})" if binding < tight else text

    def terms(self, expr: sp.Expr) -> list[str]:
        """The terms of a sum with their signs (the first without a plus), positive ones first."""
        ordered = sorted(expr.as_ordered_terms(), key=_is_negative)
        signed = [
            f"- {self.text(-term, PRODUCT)}" if _is_negative(term) else f"+ {self.text(term)}"
            for term in ordered
        ]
        first = signed[0].removeprefix("+ ").replace("- ", "-", 1)
        return [first if signed[0].startswith("- ") else signed[0][2:], *signed[1:]]

    def factors(self, expr: sp.Expr) -> tuple[list[sp.Expr], list[sp.Expr]]:
        """Numerator and denominator factors, scalars first."""
        above, below = [], []
        coefficient, rest = expr.as_coeff_Mul()
        for factor in rest.as_ordered_factors():
            base, exponent = factor.as_base_exp()
            if exponent.is_negative and not isinstance(factor, sp.exp):
                below.append(base ** (-exponent))
            else:
                above.append(factor)
        above.sort(key=lambda f: not self.scalar(f))
        return [coefficient, *above] if coefficient != 1 else above, below

    def scalar(self, expr: sp.Expr) -> bool:
        """Whether the expression holds no array."""
        return all(s.name in self.spelling for s in expr.free_symbols)

    def _print(self, expr: sp.Expr) -> tuple[str, int]:
        if expr.is_Symbol:
            known = self.places.get(expr.name, expr.name)
            return self.spelling.get(expr.name, known), ATOM
        if expr.is_Integer:
            return str(expr), ATOM if expr >= 0 else SUM
        if expr.is_Rational and expr.q & (expr.q - 1) == 0:
            return str(float(expr)), ATOM if expr >= 0 else SUM
        if expr.is_Add:
            return " ".join(self.terms(expr)), SUM
        if expr.is_Mul:
            return self._product(expr)
        if isinstance(expr, sp.Pow):
            return self._power(expr)
        if isinstance(expr, sp.Piecewise):
            return self._choice(expr)
        if isinstance(expr, WorkShare):
            return f"_work_share({self.text(expr.args[0])}, c)", ATOM
        if type(expr) in FUNCTIONS:
            return self._call(FUNCTIONS[type(expr)], expr), ATOM
        raise TypeError(f"the NumPy printer has no rule for {type(expr).__name__}: {expr}")

    def _product(self, expr: sp.Expr) -> tuple[str, int]:
        above, below = self.factors(expr)
        sign = "-" if above and above[0].is_negative else ""
        if sign:
            above = [-above[0], *above[1:]] if above[0] != -1 else above[1:]
        text = " * ".join(self.text(f, PRODUCT) for f in above) or "1"
        for f in below:
            text += f" / {self.text(f, POWER)}"
        return sign + text, SUM if sign else PRODUCT

    def _power(self, expr: sp.Pow) -> tuple[str, int]:
        base, exponent = expr.args
        if exponent == sp.Rational(1, 2):
            return f"np.sqrt({self.text(base)})", ATOM
        if exponent.is_Integer and exponent > 0:
            return f"{self.text(base, ATOM)}**{exponent}", POWER
        if exponent.is_negative:
            return f"1 / {self.text(base ** (-exponent), POWER)}", PRODUCT
        raise TypeError(f"the NumPy printer refuses the power {expr}; use exp and log")

    def _choice(self, expr: sp.Piecewise) -> tuple[str, int]:
        (value, condition), (other, last) = expr.args
        if last != sp.true:
            raise TypeError(f"the NumPy printer takes a choice of two, not {expr}")
        if self.scalar(condition.lhs):
            condition = condition.reversed
        test = f"{self.text(condition.lhs)} {condition.rel_op} {self.text(condition.rhs)}"
        return f"np.where({test}, {self._number(value)}, {self._number(other)})", ATOM

    def _number(self, expr: sp.Expr) -> str:
        return f"{expr}.0" if expr.is_Integer else self.text(expr)

    def _call(self, function: str, expr: sp.Expr) -> str:
        args = sorted(expr.args, key=lambda a: (self.scalar(a), sp.default_sort_key(a)))
        return f"{function}({', '.join(self.text(a) for a in args)})"


def _is_negative(term: sp.Expr) -> bool:
    return bool(term.as_coeff_Mul()[0].is_negative)
