"""The text of a NumPy module that takes inputs times a scale where squares leave their range."""

from __future__ import annotations

RESCALED = '''\
def _largest(rows: Rows) -> Array:
    """The largest magnitude in each column."""
    largest: Array = np.maximum.reduce([np.abs(row) for row in rows])
    return largest


def _rescaled(
    form: Callable[[Rows, Constants], Rows], inputs: Rows, c: Constants
) -> tuple[Rows, Array, Any, Array]:
    """Values of ``form``, the last of them, one over the scale, the square.

    Where squares would overflow or underflow the inputs are taken times a power of two, before
    anything rounds; elsewhere, and at rest, this scale is one. The square comes twice, with the
    scale that the other values have, and without.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        *values, square = form(inputs, c)
        low = TINY[square.dtype] * 2**60
        odd = ~((low < square) & (square < 1 / low))
        if odd.any():
            odd &= _largest(inputs) > 0
        if not odd.any():
            return values, square, 1.0, square
        power = np.frexp(_largest(inputs))[1]
        *values, _ = form([np.ldexp(row, -power) for row in inputs], c)
        power += np.frexp(_largest(values))[1] - 1
        deep = int(0.4 * math.log2(low))  # small values stay small, so that unscale does not
        power = np.where(odd, np.maximum(power, 0) + np.minimum(power - deep, 0), 0)
        *values, square = form([np.ldexp(row, -power) for row in inputs], c)
        unscale = np.ldexp(square.dtype.type(1), power)
        return values, square, unscale, square * unscale * unscale
'''

BALANCED = '''\
def _balanced(
    form: Callable[[Rows, Constants], Rows], inputs: Rows, c: Constants
) -> tuple[Rows, Array, Array, Any, Array]:
    """As `_rescaled`, with roots: values, norm, radius, one over the scale, square.

    The values and the norm share the scale; the radius and its square are free of it.
    """
    values, scaled, unscale, square = _rescaled(form, inputs, c)
    size = np.sqrt(scaled)
    with np.errstate(over="ignore"):
        radius = size * unscale
    return values, np.maximum(size, TINY[size.dtype]), radius, unscale, square
'''
