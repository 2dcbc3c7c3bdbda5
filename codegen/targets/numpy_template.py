"""The fixed text of a NumPy module: everything that does not depend on a formula.

Fields in ``$name`` form are filled in by `numpy_target`.
"""

from __future__ import annotations

from string import Template

IMPORTS = """\
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
$cached_import
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
Pair = tuple[Array, Array]
Rows = Sequence[Array]
Inputs = dict[str, ArrayLike]
Heads = dict[str, tuple[int, ...]]  # the leading shape of each result

BLOCK = 8192  # points worked on at a time, so that temporaries stay in cache
TINY = {np.dtype(t): float(np.finfo(t).tiny) for t in (np.float32, np.float64)}
LOG_MAX = {t: -0.99 * math.log(TINY[t]) for t in TINY}  # exp of it is near the largest number
"""

CONSTANTS = Template('''\
@dataclass(frozen=True)
class Constants:
    """The seven constants of the rod, checked on construction (ValueError).

    alpha, beta, iota are lengths, gamma is a force, zeta, eta and p are plain numbers; all but
    iota are positive and beta^2 eta^2 - iota^2 > 0.
    """

    alpha: float
    beta: float
    zeta: float
    eta: float
    iota: float
    gamma: float
    p: float
$derived_fields

    def __post_init__(self) -> None:
        for name in ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p"):
            value = float(getattr(self, name))
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")
            object.__setattr__(self, name, value)
        exact = (Fraction(v) for v in ($given))
        $exact = exact
        if not beta**2 * eta**2 - iota**2 > 0:
            raise ValueError(
                "Constants: beta^2 eta^2 - iota^2 > 0 fails: |iota| must be smaller than beta*eta,"
                f" not beta={self.beta}, eta={self.eta}, iota={self.iota}"
            )
        derived = {
$derived_values
        }
        for name, ratio in derived.items():  # exact, then rounded once
            if abs(ratio) >= 2**1023:
                raise ValueError(f"Constants: {name} leaves the range of floating point numbers")
            object.__setattr__(self, name, float(ratio))
''')

WORK_SHARE_TABLES = '''
    @cached_property
    def work_share(self) -> tuple[list[float], list[float], float, float, float]:
        """Coefficients for `_work_share`: fraction, powers, their sum, and the nearest power."""
        a = 1 / self.p
        fraction = [a / (1 + 2 * a)]
        for k in range(1, 30):
            below = (2 * a + 2 * k) * (2 * a + 2 * k - 1)
            fraction += [k * (a + k) / below]
            below = (2 * a + 2 * k) * (2 * a + 2 * k + 1)
            fraction += [(a + k) * (2 * a + k) / below]
        at_split = 1.0
        for term in reversed(fraction):
            at_split = 1 + term * 8 / at_split
        nearest = min(max(round(a) - 1, 0), 23)
        powers, term = [], a / 9
        for k in range(24):
            exponent = ((k + 1) * self.p - 1) / self.p  # k + 1 - 1/p, small where p = 1/(k + 1)
            powers += [term / exponent if k != nearest else 0.0]
            if k == nearest:
                slope, single = exponent, term
            term *= (k + 1 - 2 * a) / (k + 1) / 9
        start = math.exp(2 * a * math.log(8 / 9)) * 0.5 / at_split + math.fsum(powers)
        return fraction, powers, start, slope, single
'''

WORK_SHARE = '''\
def _work_share(depth: Array, c: Constants) -> Array:
    """Stored energy over work, 1/2 2F1(1, 1/p; 1 + 2/p; 1 - exp(depth)), depth = -log(1 - x^p).

    Up to exp(depth) = 9 by the continued fraction of Gauss, whose terms are all positive; from
    there by its integral over t = 1 - s^p, with (1 - t)^(2/p - 1) expanded. The power of t nearest
    to -1 is integrated through expm1, which makes the sum smooth at p = 1, 1/2, 1/3, ...
    """
    fraction, powers, start, slope, single = c.work_share
    split = math.log(9)
    growth = np.expm1(np.minimum(depth, split))
    value = np.ones_like(growth)
    for term in reversed(fraction):
        np.divide(growth, value, out=value)
        value *= term
        value += 1
    share: Array = 0.5 / value
    far = depth > split
    if far.any():
        beyond = depth[far] - split
        left = np.exp(-beyond)
        rest = np.zeros_like(left)
        for coefficient in reversed(powers):
            rest *= left
            rest += coefficient
        turns = -np.expm1(np.minimum(-slope * beyond, 80)) / slope if slope else beyond
        inner = np.exp(-beyond / c.p) * (start + single * turns) - left * rest
        share[far] = inner * np.exp(-2 / c.p * np.log1p(-left / 9))
    return share
'''

BALANCED = '''\
def _exponent(rows: Rows) -> Array:
    """The power of two above the largest magnitude in each column."""
    largest: Array = np.maximum.reduce([np.abs(row) for row in rows])
    return np.frexp(largest)[1]


def _balanced(
    form: Callable[[Rows, Constants], Rows], inputs: Rows, c: Constants
) -> tuple[Rows, Array, Array, Array]:
    """Values of ``form``, the root of its last one, and the radius and its square.

    Where squares would overflow or underflow the inputs are taken times a power of two, a factor
    that the values and their root share and that later cancels; the radius is free of it.
    """
    with np.errstate(over="ignore", invalid="ignore"):
        *values, square = form(inputs, c)
        tiny = TINY[square.dtype]
        if square.min() > tiny * 2**60 and square.max() < 1 / tiny / 2**60:
            size = np.sqrt(square)
            return values, size, size, square
        power = _exponent(inputs)
        *values, _ = form([np.ldexp(row, -power) for row in inputs], c)
        power = power + _exponent(values)
        *values, square = form([np.ldexp(row, -power) for row in inputs], c)
        size = np.sqrt(square)
        radius = np.ldexp(size, power)
        return values, np.maximum(size, tiny), radius, radius * radius
'''

RAISE = '''\
class _PastLimit(Exception):
    """Some strains have Q >= 1."""


def _within_limit(q: Array) -> Array:
    """Q where all of it is below the limit."""
    if not (q < 1).all():
        raise _PastLimit
    return q
'''

NAN = '''\
def _within_limit(q: Array) -> Array:
    """Q below the limit, nan at and past it."""
    return np.where(q < 1, q, np.nan)
'''

PAST_LIMIT = Template('''\
def _past_limit(strains: Rows, c: Constants, shape: tuple[int, ...]) -> ValueError:
    """The error for strains at or past the limit: how many points, the first and its Q."""
$reduce
    bad = np.flatnonzero(~(q < 1))
    index = tuple(map(int, np.unravel_index(bad[0], shape)))
    first = f"the first at index {index} with Q = {float(q[bad[0]])!r}"
    return ValueError(f"$sentence: {bad.size} of {q.size} do not, {first}")
''')

APPLY = Template('''\
def _arguments(inputs: Inputs) -> tuple[list[Array], tuple[int, ...]]:
    """The inputs as float arrays of one type and shape (3, ...), and the trailing shape."""
    arrays = [np.asarray(value) for value in inputs.values()]
    for name, array in zip(inputs, arrays, strict=True):
        if array.dtype.kind not in "iuf" or array.shape[:1] != (3,):
            kind = f"{array.dtype} of shape {array.shape}"
            raise ValueError(f"{name} must hold real numbers in the shape (3, ...), not {kind}")
    dtype = np.float32 if np.result_type(*arrays) == np.float32 else np.float64
    try:
        shape = np.broadcast_shapes(*(array.shape[1:] for array in arrays))
    except ValueError:
        shapes = " and ".join(f"{n} {a.shape}" for n, a in zip(inputs, arrays, strict=True))
        raise ValueError(f"{shapes} do not broadcast after their first axis") from None
    aligned = (a.reshape(3, *(1,) * (len(shape) + 1 - a.ndim), *a.shape[1:]) for a in arrays)
    return [np.broadcast_to(a, (3, *shape)).astype(dtype, copy=False) for a in aligned], shape


def _results(heads: Heads, shape: tuple[int, ...], dtype: Any, out: Any) -> list[Array]:
    """The arrays to fill: new ones, or ``out`` after a check of its shapes and types."""
    shapes = [(*head, *shape) for head in heads.values()]
    if out is None:
        return [np.empty(wanted, dtype) for wanted in shapes]
    given = out if isinstance(out, tuple) else (out,)
    if len(given) != len(heads):
        raise ValueError(f"out must be {len(heads)} arrays, for {' and '.join(heads)}")
    for name, array, wanted in zip(heads, given, shapes, strict=True):
        kind = f"{getattr(array, 'dtype', type(array).__name__)} of shape {np.shape(array)}"
        if not isinstance(array, np.ndarray) or (array.dtype, array.shape) != (dtype, wanted):
            raise ValueError(f"out for {name} must be {dtype} of shape {wanted}, not {kind}")
    return list(given)


def _apply(
    body: Callable[..., None], inputs: Inputs, c: Constants, heads: Heads, out: Any
) -> list[Array]:
    """Runs ``body`` over blocks of points, straight into the results where that is safe."""
    arrays, shape = _arguments(inputs)
    results = _results(heads, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    rows = [row for array in arrays for row in array.reshape(3, points)]
    direct = all(
        r.flags.c_contiguous and not any(np.may_share_memory(r, a) for a in arrays) for r in results
    )
    flat = [
        (r if direct else np.empty(r.shape, r.dtype)).reshape(*head, points)
        for r, head in zip(results, heads.values(), strict=True)
    ]
    with np.errstate(under="ignore"):
        for start in range(0, points, BLOCK):
            part = slice(start, start + BLOCK)
$run
    if not direct:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results
''')

RUN_RAISE = """\
            try:
                body([row[part] for row in rows], c, *(array[..., part] for array in flat))
            except _PastLimit:
                raise _past_limit(rows, c, shape) from None"""
RUN = """\
            body([row[part] for row in rows], c, *(array[..., part] for array in flat))"""
