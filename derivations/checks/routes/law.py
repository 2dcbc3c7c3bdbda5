"""The law as numbers, from its definition: what second routes measure on a rod.

Moduli come from the strains under loads of size 1e-200, extremes over the strains
within the limit from numerical linear solves, derivatives from central differences with digits
to spare. No derived formula is used.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw

Values = Mapping[sp.Symbol, Any]

#: Digits for central differences with steps of 1e-40: 50 are left of a second difference.
SPARE = 130


def strains(values: Values, load: Sequence[Any], ctx: Any) -> list[Any]:
    """Strains from rest under a load: (gamma^p + y^p)^{-1/p} K^{-1} sigma, K solved numerically."""
    return NumericLaw(values, ctx).under(load)


def stiffness_at_rest(values: Values, ctx: Any) -> Any:
    """D^2 W at rest, as the inverse of D^2 W*: the strains under loads of size 1e-200."""
    h, measured = ctx.mpf(10) ** -200, NumericLaw(values, ctx)
    columns = [measured.under(unit(j, h)) for j in range(6)]
    return ctx.inverse(ctx.matrix([[columns[j][i] / h for j in range(6)] for i in range(6)]))


def reach(values: Values, slope: Sequence[Any], ctx: Any) -> Any:
    """The least upper bound of an affine function of the strains from rest over Q < 1."""
    return ctx.sqrt(NumericLaw(values, ctx).dual(slope))


def unit(index: int, size: Any = 1) -> list[Any]:
    """Six numbers of which one is not zero."""
    return [size if i == index else 0 for i in range(6)]


def slope(function: Callable[[Any], Sequence[Any]], at: Any, ctx: Any) -> list[Any]:
    """The derivative of several numbers by a central difference with a relative step of 1e-40."""
    step = at * ctx.mpf(10) ** -40
    ahead, behind = function(at + step), function(at - step)
    return [(a - b) / (2 * step) for a, b in zip(ahead, behind, strict=True)]


def logarithmic_jacobian(
    function: Callable[[Values], Sequence[Any]], values: Values, by: Sequence[sp.Symbol], ctx: Any
) -> Any:
    """d function_i/d log x_j."""

    def column(x: sp.Symbol) -> list[Any]:
        moved = slope(lambda at: function({**values, x: at}), values[x], ctx)
        return [values[x] * e for e in moved]

    columns = [column(x) for x in by]
    return ctx.matrix([list(row) for row in zip(*columns, strict=True)])


def singular_values(matrix: Any, ctx: Any) -> list[Any]:
    """The singular values, the largest first; as many as there are rows."""
    squares = ctx.eigsy(matrix * matrix.T, eigvals_only=True)
    return sorted((ctx.sqrt(abs(x)) for x in squares), reverse=True)


def outside(rows: Any, span: Any, ctx: Any) -> Any:
    """How far the rows of one matrix are from the span of those of another, relative to them."""
    gram, worst = span * span.T, ctx.mpf(0)
    for i in range(rows.rows):
        row = rows[i, :]
        rest = row - ctx.lu_solve(gram, span * row.T).T * span
        worst = max(worst, ctx.norm(rest) / ctx.norm(row))
    return worst


def border(
    measure: Callable[[Values], Any],
    values: Values,
    symbol: sp.Symbol,
    ctx: Any,
    among: tuple[float, float],
) -> tuple[dict[sp.Symbol, Any], ...]:
    """The point with one constant just below and just above the zero of a measured quantity.

    Raises ValueError where the quantity has no change of sign between the two values `among`.
    """  # fmt: skip
    low, high = (ctx.mpf(x) for x in among)
    ends = [measure({**values, symbol: x}) for x in (low, high)]
    if not ends[0] * ends[1] < 0:
        raise ValueError(f"no border in {symbol} between {low} and {high}")
    at = ctx.findroot(lambda x: measure({**values, symbol: x}), (low, high), solver="anderson",
                      tol=ctx.mpf(10) ** -20)  # fmt: skip
    return tuple({**values, symbol: at * (1 + side * ctx.mpf(10) ** -12)} for side in (-1, 1))
