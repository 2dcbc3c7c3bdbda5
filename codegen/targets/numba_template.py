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
from numba import njit, types
from numba.extending import intrinsic
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
Pair = tuple[Array, Array]
Triple = tuple[Array, Array, Array]
Inputs = dict[str, ArrayLike]

LINE = 64  # bytes of a cache line
BLOCK = 256  # points that are done again with care if one of them needs it
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
LEAST = 2.0**-1022  # the smallest normal number
LOG_MOST = 0.99 * 1022 * math.log(2)  # its exponential is near the largest number
STREAMS = $streams  # rows that a loop writes, at most
DOUBLE = np.dtype(np.float64)
TINY = {DOUBLE: LEAST}
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

NUMBERS = Template('''\
    @cached_property
    def numbers(self) -> tuple[Any, ...]:
        """What loops take: plain tuples are handed over sooner."""
$lines
''')

ORDINARY = Template('''\
class Ordinary(NamedTuple):
    """Constants for points where nothing is extreme, and the squares between which they hold."""

$fields
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
def _${name}_over(numbers: Any, $given, $taken) -> tuple[int, Any, float]:
    """`$name` at every point$about."""
    $constants
    points, past, first, worst = $points, 0, np.int64(0), 0.0
    if _shared($spans):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
$plainly        $fine
        for i in range(begin, end):
$quick
$careful    return past, first, worst
''')
CAREFULLY = Template("""\
        if not fine:
            for i in range(begin, end):
$lines
""")
ABOUT_PAST = "; points past the limit, the first, its Q"

WHOLE = Template('''\
@at_point
def _whole_$size(k: Any) -> Any:
    """A symmetric matrix by rows, from its entries on and above the diagonal."""
    return (
$entries
    )
''')

#: How a loop reads and writes. The rows of a result are as far apart as there are points, which a
#: compiler that has to prove them apart cannot know: it would compare the addresses of each two,
#: finds 42 too many for that, and makes no vectors.
ROWS = Template('''\
def _places(context: Any, builder: Any, kind: Any, array: Any, i: Any, count: int) -> list[Any]:
    """Where the numbers of point ``i`` are in an array."""
    made = context.make_array(kind)(context, builder, array)
    points = builder.extract_value(made.shape, $axis)
    index = [$index for k in range(count)]
    return [builder.gep(made.data, [at], inbounds=True) for at in index]


def _streams(builder: Any) -> tuple[list[Any], Any]:
    """Names of memory for the compiler: of each row of the results, and of all inputs.

    They hold for the arrays of one call, so the function may not become part of another.
    """
    builder.function.attributes.add("noinline")
    named, law = builder.module.add_metadata, builder.module.add_metadata(["law"])
    return [named([f"result {k}", law]) for k in range(STREAMS)], named(["inputs", law])


@intrinsic(prefer_literal=True)
def _get(_: Any, array: Any, count: Any, i: Any) -> Any:
    """The numbers of point ``i``, of an input that shares no memory with any result."""

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        _, inputs = _streams(builder)
        values = []
        for place in _places(context, builder, array, args[0], args[2], count.literal_value):
            value = builder.load(place)
            value.set_metadata("alias.scope", builder.module.add_metadata([inputs]))
            values.append(context.cast(builder, value, array.dtype, types.float64))
        return context.make_tuple(builder, signature.return_type, values)

    found = types.UniTuple(types.float64, count.literal_value)
    return found(array, count, types.uint64), code


@intrinsic(prefer_literal=True)
def _put(_: Any, array: Any, row: Any, i: Any, values: Any) -> Any:
    """Stores numbers of point ``i``, from the given row on of all results together."""

    def code(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        named, (rows, inputs) = builder.module.add_metadata, _streams(builder)
        places = _places(context, builder, array, args[0], args[2], len(values))
        for k, place in enumerate(places):
            value = builder.extract_value(args[3], k)
            store = builder.store(context.cast(builder, value, values[k], array.dtype), place)
            own = rows[row.literal_value + k]
            store.set_metadata("alias.scope", named([own]))
            store.set_metadata("noalias", named([r for r in (*rows, inputs) if r is not own]))
        return context.get_dummy_value()

    return types.void(array, row, types.uint64, values), code


@at_point
def _span(a: Array) -> tuple[int, int]:
    """Where the memory of an array begins and ends."""
    return a.ctypes.data, a.ctypes.data + a.nbytes


@at_point
def _shared(inputs: Any, results: Any) -> bool:
    """Whether a result's memory is that of an input or of another result."""
    met = 0
    for begin, end in results:
        for start, stop in inputs + results:
            met += start < end and begin < stop
    return met > len(results)  # each meets itself
''')

APPLY = Template('''\
def _apply(
    over: Callable[..., tuple[int, Any, float]],
    inputs: Inputs,
    c: Constants,
    names: Sequence[str],
    out: Any,
) -> Sequence[Array]:
    """Runs ``over`` on all points; at once where the arrays are as its loop wants them."""
    given: tuple[Any, ...] = tuple(inputs.values())
    shape = given[0].shape[$trailing] if type(given[0]) is np.ndarray else ()
    if out is None:
        results = tuple([_fresh($shape, DOUBLE) for name in names])
    else:
        results = out if type(out) is tuple else (out,)
    if shape and _plain((*inputs, *names), given + results, shape):
        past, _, _ = over(c.numbers, *given, *results)
        if not past:
            return results
    return _apply_to_any(over, inputs, c, names, out)


def _plain(names: Sequence[str], arrays: Sequence[Any], shape: tuple[int, ...]) -> bool:
    """Whether the arrays are as the loops want them: rows of doubles, of one length."""
    if len(arrays) != len(names):
        return False
    for name, a in zip(names, arrays):  # noqa: B905, strict takes longer than a test
        if type(a) is not np.ndarray or a.dtype is not DOUBLE or a.shape != $shape:
            return False
        if not a.flags.carray:
            return False
    return True


def _apply_to_any(
    over: Callable[..., tuple[int, Any, float]],
    inputs: Inputs,
    c: Constants,
    names: Sequence[str],
    out: Any,
) -> Sequence[Array]:
    """Runs ``over`` on all points, straight into the results where that is safe."""
    arrays, shape = _arguments(inputs)
    results = _results(names, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    given = [
        np.require(array.reshape(*HEADS[name], points)$turned, requirements=["C", "A"])
        for name, array in zip(inputs, arrays, strict=True)
    ]
    straight = all(r.flags.carray and r.dtype == DOUBLE for r in results)
    flat = [
        r.reshape($flat) if straight else _fresh(($flat), DOUBLE)
        for name, r in zip(names, results, strict=True)
    ]
    past, first, q = over(c.numbers, *given, *flat)
    if past < 0:  # something shares memory
        straight, flat = False, [np.empty_like(values) for values in flat]
        past, first, q = over(c.numbers, *given, *flat)
    if past:
        index = tuple(map(int, np.unravel_index(first, shape)))
        where = f"{past} of {math.prod(shape)} do not, the first at index {index} with Q = {q!r}"
        raise ValueError(f"strains must satisfy Q(u, v) < 1: {where}")
    if not straight:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results
''')
