"""The fixed text of a numba module; fields in ``$name`` form are filled in by `numba_target`."""

from __future__ import annotations

from string import Template

IMPORTS = Template("""\
from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass$field_import
$standard_imports
from math import $functions
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
$tuples
Inputs = dict[str, ArrayLike]

BLOCK = 256  # points that are done again with care if one of them needs it
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
LEAST = 2.0**-1022  # the smallest normal number
LOG_MOST = 0.99 * 1022 * math.log(2)  # its exponential is near the largest number
DOUBLE = np.dtype(np.float64)
EXP_40 = 4.248354255291589e-18  # exp(-40)
LN2, LN2_REST = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # log 2, in two parts
PER_LN2 = 1 / math.log(2)
SQRT_HALF = 0x3FE6A09E667F3BCD  # the bits of 2^(-1/2)
$heads

over_points = njit(cache=True, error_model="numpy", fastmath={"contract"})
at_point = njit(cache=True, error_model="numpy", fastmath={"contract"}, forceinline=True)
""")

#: Functions of the math module without branches, so that the compiler can vectorise them, by their
#: names. Each is within an ulp of the truth (tests/generated/test_numba.py).
FUNCTIONS = {
    "_reduced": '''\
@at_point
def _reduced(x: float) -> tuple[float, float]:
    """exp r - 1 by Taylor's series, |r| <= log(2)/2, and 2^k, with exp x = exp r 2^k, |x| < 710."""
    k = np.rint(x * PER_LN2)
    r = (x - k * LN2) - k * LN2_REST
    rr = r * r
    low = (1 / 2 + r * (1 / 6)) + rr * (1 / 24 + r * (1 / 120))
    middle = (1 / 720 + r * (1 / 5040)) + rr * (1 / 40320 + r * (1 / 362880))
    high = (1 / 3628800 + r * (1 / 39916800)) + rr * (1 / 479001600 + r * (1 / 6227020800))
    series = low + rr * rr * (middle + rr * rr * high)
    return r + rr * series, np.int64((np.int64(k) + 1023) << 52).view(np.float64)
''',
    "_exp": '''\
@at_point
def _exp(x: float) -> float:
    """exp x; below the normal numbers in two steps."""
    far = x < -668.0
    high = 709.5 if x > 709.5 else x + 40.0 if far else x
    rest, power = _reduced(-708.0 if high < -708.0 else high)
    value = power + power * rest
    return math.inf if x > 709.5 else value * EXP_40 if far else value
''',
    "_expm1": '''\
@at_point
def _expm1(x: float) -> float:
    """exp x - 1, without cancellation at small x."""
    high = 709.5 if x > 709.5 else x
    rest, power = _reduced(-708.0 if high < -708.0 else high)
    return math.inf if x > 709.5 else (power - 1) + power * rest
''',
    "_log": '''\
@at_point
def _log(x: float) -> float:
    """log x of a normal number, as k log 2 + log(1 + f) by the series of artanh(f/(2 + f))."""
    bits = np.float64(x).view(np.int64)
    exponent = (bits - SQRT_HALF) >> 52
    f = np.int64(bits - (exponent << 52)).view(np.float64) - 1
    k, s = np.float64(exponent), f / (2 + f)
    z = s * s
    zz = z * z
    low = (1 / 3 + z * (1 / 5)) + zz * (1 / 7 + z * (1 / 9))
    high = (1 / 11 + z * (1 / 13)) + zz * (1 / 15 + z * (1 / 17))
    series = low + zz * zz * (high + zz * zz * (1 / 19 + z * (1 / 21)))
    half = 0.5 * f * f
    known = k * LN2 - ((half - (s * (half + 2 * z * series) + k * LN2_REST)) - f)
    return known + (x - x)  # not a number where x is none
''',
    "_log1p": '''\
@at_point
def _log1p(x: float) -> float:
    """log(1 + x), with what rounds off in the sum added again."""
    u = 1 + x
    return _log(u) + (x - (u - 1)) / u
''',
}

VALUES = Template('''

class Values(NamedTuple):
    """The constants as compiled code takes them; `Constants.values` makes them."""

$fields
''')

VALUES_PROPERTY = Template('''
    @cached_property
    def values(self) -> Values:
        """What compiled code takes."""
        return Values(
$values
        )
''')

WORK_SHARE_VALUES = """\
            (
                np.array(self.work_share[0][::-1]),
                np.array(self.work_share[1][::-1]),
                *self.work_share[2:],
            ),"""

WORK_SHARE = '''\
@at_point
def _work_share_at(depth: float, c: Values) -> float:
    """Stored energy over work, 1/2 2F1(1, 1/p; 1 + 2/p; 1 - exp(depth)), depth = -log(1 - x^p).

    Up to exp(depth) = 9 by the continued fraction of Gauss, whose terms are all positive; from
    there by its integral over t = 1 - s^p, with (1 - t)^(2/p - 1) expanded. The power of t nearest
    to -1 is integrated through expm1, which makes the sum smooth at p = 1, 1/2, 1/3, ...
    """
    fraction, powers, start, slope, single = c.work_share
    beyond = depth - math.log(9)
    if beyond <= 0:
        growth, value = _expm1(depth), 1.0
        for term in fraction:
            value = growth / value * term + 1
        return 0.5 / value
    left, rest = _exp(-beyond), 0.0
    for coefficient in powers:
        rest = rest * left + coefficient
    turn = -slope * beyond
    turns = -_expm1(turn if turn < 80.0 else 80.0) / slope if slope != 0 else beyond
    inner = _exp(-beyond / c.p) * (start + single * turns) - left * rest
    return inner * _exp(-2 / c.p * _log1p(-left / 9))
'''

SCALES = '''\
@at_point
def _scale(largest: float, shift: int) -> float:
    """A power of two that takes the largest input near one, a small one to 2^-400, by ``shift``."""
    power = frexp(largest)[1]
    return ldexp(1.0, min(max(shift - max(power, 0) - min(power + 400, 0), -1020), 1020))
'''

CAREFUL = Template('''\
@over_points
def _careful_$name($arguments, c: Values) -> Any:
    """`$name` where squares may leave their range, its inputs scaled."""
    $result = _$name($arguments, c, 1.0)
    largest = $largest
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            $result = _$name($arguments, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return $kept
''')

AT = Template('''\
@over_points
def ${name}_at($arguments, c: Values) -> Any:
    """$doc"""
$lines
''')

OVER = Template('''\
@over_points
def _${name}_over($given, c: Values, $taken) -> tuple[int, Any, float]:
    """`$name` at every point$about."""
    points, past, first, worst = $points, 0, np.int64(0), 0.0$rows
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        $fine
        for i in range(begin, end):
$quick
$careful$moves    return past, first, worst
''')
CAREFULLY = Template("""\
        if not fine:
            for i in range(begin, end):
$lines
""")
ABOUT_PAST = "; points past the limit, the first, its Q"

SPREAD = Template('''\
@at_point
def _spread_$name(rows: Array, begin: int, end: int, a: Array) -> None:
    """Copies the first rows, entries on and above the diagonal, to their places in a matrix."""
    first = 0
    for j in range($size):
        for k in range(j, $size):
            for i in range(end - begin):
$places
            first += BLOCK
''')

MOVE = Template('''\
@at_point
def _move_$length(rows: Array, first: int, begin: int, end: int, a: Array) -> None:
    """Copies rows from the first on."""
    for k in range($length):
        for i in range(end - begin):
            $place = rows[(first + k) * BLOCK + i]
''')

APPLY = Template('''\
def _apply(
    over: Callable[..., tuple[int, Any, float]],
    inputs: Inputs,
    c: Constants,
    names: Sequence[str],
    out: Any,
) -> list[Array]:
    """Runs ``over`` on all points, straight into the results where that is safe."""
    results = list(out) if isinstance(out, tuple) else [out]
    arrays: list[Any] = list(inputs.values())
    if not _plain([*inputs, *names], [*arrays, *results], len(arrays)):
        arrays, shape = _arguments(inputs)
        results = _results(names, shape, arrays[0].dtype, out)
        points = math.prod(shape)
        given = [
            np.ascontiguousarray(array.reshape(*HEADS[name], points))
            for name, array in zip(inputs, arrays, strict=True)
        ]
        flat = [np.empty(($flat)) for name in names]
    else:
        shape, given, flat = arrays[0].shape[$trailing], arrays, results
    past, first, q = over(*given, c.values, *flat)
    if past:
        index = tuple(map(int, np.unravel_index(first, shape)))
        where = f"{past} of {math.prod(shape)} do not, the first at index {index} with Q = {q!r}"
        raise ValueError(f"strains must satisfy Q(u, v) < 1: {where}")
    if flat is not results:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results


def _plain(names: Sequence[str], arrays: Sequence[Any], inputs: int) -> bool:
    """Whether the arrays are as the loops want them: rows of doubles of one length, none shared."""
    if any(type(a) is not np.ndarray or a.dtype is not DOUBLE for a in arrays):
        return False
    points = arrays[0].shape[$end]
    return all(
        a.shape == $shape and a.flags.c_contiguous
        for name, a in zip(names, arrays, strict=True)
    ) and not any(np.may_share_memory(r, a) for r in arrays[inputs:] for a in arrays[:inputs])
''')
