"""The strain-limiting special Cosserat rod: every strain, every load, any p.

Scene full_rod for numba, made by: rodproof generate full_rod

Statements it rests on (paper label, verdict; as corrected if refuted): qstar-form Section 3.1
refuted; const-u-mu eq:uconst proved; const-u-3 eq:u3const proved; const-v-mu eq:vconst proved;
const-v-3 eq:v3const proved; q-form eq:quadraticform definition; strain-limit eq:strainlimiting
proved; const-m-mu eq:mconst proved; const-m-3 eq:m3const proved; const-n-mu eq:nconst proved;
const-n-3 eq:n3const proved; w-definition eq:stenergy proved; wstar-definition eq:compenergy
proved; hess-m-u reading; hess-m-u3 reading; hess-m-v reading; hess-m-v3 reading; hess-m3-u3
refuted; hess-m3-v reading; hess-m3-v3 refuted; hess-n-v reading; hess-n-v3 reading; hess-n3-v3
reading; wstar-gradient Section 3.1 proved.

Domain: loads with finite Q*^(1/2); strains with Q < 1, else an error.

Operations a point where nothing is extreme: arithmetic, transcendental, energy shares, temporaries
    strains                36    4    0   10
    loads                  35    4    0   11
    stored_energy          32    4    1   13
    complementary_energy   41    6    1   13
    stiffness              90    4    0   14
    loads_and_stiffness    96    4    0   14
    compliance            160    4    0   39
    strains_and_gap        38    4    0   10
    stiffness_at_loads     92    4    0   19
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import frexp, ldexp, sqrt
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
STREAMS = 42  # rows that a loop writes, at most
DOUBLE = np.dtype(np.float64)
TINY = {DOUBLE: LEAST}
EXP_40 = 4.248354255291589e-18  # exp(-40)
LN2, LN2_REST = 6.93147180369123816490e-01, 1.90821492927058770002e-10  # log 2, in two parts
PER_LN2 = 1 / math.log(2)
SQRT_HALF = 0x3FE6A09E667F3BCD  # the bits of 2^(-1/2)
HEADS: dict[str, tuple[int, ...]] = {
    "m": (3,),
    "n": (3,),
    "u": (3,),
    "v": (3,),
    "w": (),
    "w_star": (),
    "stiff": (6, 6),
    "soft": (6, 6),
    "limit_gap": (),
}

over_points = njit(cache=True, error_model="numpy", fastmath={"contract"})
at_point = njit(cache=True, error_model="numpy", fastmath={"contract"}, forceinline=True)


class Values(NamedTuple):
    """The constants as compiled code takes them; `Constants.values` makes them."""

    alpha: float
    beta: float
    zeta: float
    eta: float
    iota: float
    gamma: float
    p: float
    chirality: float
    gap: float
    n3_dilates: float
    m3_contracts: float
    per_alpha: float
    per_beta: float
    per_zeta: float
    per_eta: float
    per_p: float
    per_gap: float
    per_gamma: float
    work_share: tuple[Array, Array, float, float, float]


class Ordinary(NamedTuple):
    """Constants for points where nothing is extreme, and the squares between which they hold."""

    bend_soft: float
    turn_soft: float
    shear_soft: float
    n3_extends: float
    m3_extends: float
    slack_load: float
    untwist: float
    per_gamma: float
    per_p: float
    bending: float
    turning: float
    shearing: float
    slack: float
    per_turning: float
    stretching: float
    least_overload: float
    most_overload: float
    least_q: float
    most_q: float


class Plain:
    """What the plain bodies take, each number rounded once, and the squares where they hold."""

    def __init__(self, c: Constants) -> None:
        alpha, beta, gamma, zeta, eta, iota, p = (
            Fraction(v) for v in (c.alpha, c.beta, c.gamma, c.zeta, c.eta, c.iota, c.p)
        )
        self.bend_soft = _rounded(1 / alpha**2 / gamma)
        self.turn_soft = _rounded(1 / beta**2 / gamma)
        self.shear_soft = _rounded(1 / gamma / zeta**2)
        self.n3_extends = _rounded(beta**2 / gamma / (beta**2 * eta**2 - iota**2))
        self.m3_extends = _rounded(iota / gamma / (beta**2 * eta**2 - iota**2))
        self.slack_load = _rounded(gamma * (beta**2 * eta**2 - iota**2) / beta**2)
        self.untwist = _rounded(iota / beta**2)
        self.per_gamma = _rounded(1 / gamma)
        self.per_p = _rounded(1 / p)
        self.bending = _rounded(alpha**2)
        self.turning = _rounded(beta**2)
        self.shearing = _rounded(zeta**2)
        self.slack = _rounded((beta**2 * eta**2 - iota**2) / beta**2)
        self.per_turning = _rounded(1 / beta**2)
        self.stretching = _rounded(eta**2)
        used = [v for v in (c.gamma, c.iota, *vars(self).values()) if v]
        self.within_overload: dict[Any, tuple[float, float]] = {}
        self.within_q: dict[Any, tuple[float, float]] = {}
        self.room: dict[Any, tuple[float, float]] = {}
        for kind, tiny in TINY.items():
            span = tiny**-0.25
            even = all(1 < abs(v) * span < span**2 for v in used)
            self.room[kind] = (1 / span, span) if even else (1.0, 0.0)
            overload = (1 / span, math.exp(min(2 * math.log(span) / c.p, math.log(1024))))
            self.within_overload[kind] = overload if even else (1.0, 0.0)
            q = (math.exp(max(-2 * math.log(span) / c.p, -math.log(span))), 0.9990234375)
            self.within_q[kind] = q if even else (1.0, 0.0)


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan


@dataclass(frozen=True)
class Constants:
    """The seven constants of the rod, checked on construction (ValueError).

    alpha, beta and iota are lengths, gamma is a force, zeta, eta and p are plain numbers; all but
    iota are positive and beta^2 eta^2 - iota^2 > 0.
    """

    alpha: float
    beta: float
    zeta: float
    eta: float
    iota: float
    gamma: float
    p: float
    chirality: float = field(init=False, repr=False, compare=False)
    gap: float = field(init=False, repr=False, compare=False)
    n3_dilates: float = field(init=False, repr=False, compare=False)
    m3_contracts: float = field(init=False, repr=False, compare=False)
    per_alpha: float = field(init=False, repr=False, compare=False)
    per_beta: float = field(init=False, repr=False, compare=False)
    per_zeta: float = field(init=False, repr=False, compare=False)
    per_eta: float = field(init=False, repr=False, compare=False)
    per_p: float = field(init=False, repr=False, compare=False)
    per_gap: float = field(init=False, repr=False, compare=False)
    per_gamma: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p"):
            value = float(getattr(self, name))
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")
            object.__setattr__(self, name, value)
        exact = (
            Fraction(v)
            for v in (self.alpha, self.beta, self.zeta, self.eta, self.iota, self.gamma, self.p)
        )
        alpha, beta, zeta, eta, iota, gamma, p = exact
        if not beta**2 * eta**2 - iota**2 > 0:
            raise ValueError(
                "Constants: beta^2 eta^2 - iota^2 > 0 fails: |iota| must be smaller than beta*eta,"
                f" not beta={self.beta}, eta={self.eta}, iota={self.iota}"
            )
        derived = {
            "chirality": iota / beta / eta,
            "gap": (beta**2 * eta**2 - iota**2) / beta**2 / eta**2,
            "n3_dilates": beta**2 * eta / (beta**2 * eta**2 - iota**2),
            "m3_contracts": eta * iota / (beta**2 * eta**2 - iota**2),
            "per_alpha": 1 / alpha,
            "per_beta": 1 / beta,
            "per_zeta": 1 / zeta,
            "per_eta": 1 / eta,
            "per_p": 1 / p,
            "per_gap": beta**2 * eta**2 / (beta**2 * eta**2 - iota**2),
            "per_gamma": 1 / gamma,
        }
        for name, ratio in derived.items():  # exact, then rounded once
            if abs(ratio) >= 2**1023:
                raise ValueError(f"Constants: {name} leaves the range of floating point numbers")
            object.__setattr__(self, name, float(ratio))

    @cached_property
    def plain(self) -> Plain:
        """What the plain bodies take."""
        return Plain(self)

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

    @cached_property
    def values(self) -> Values:
        """What compiled code takes."""
        return Values(
            self.alpha,
            self.beta,
            self.zeta,
            self.eta,
            self.iota,
            self.gamma,
            self.p,
            self.chirality,
            self.gap,
            self.n3_dilates,
            self.m3_contracts,
            self.per_alpha,
            self.per_beta,
            self.per_zeta,
            self.per_eta,
            self.per_p,
            self.per_gap,
            self.per_gamma,
            (
                np.array(self.work_share[0][::-1]),
                np.array(self.work_share[1][::-1]),
                *self.work_share[2:],
            ),
        )

    @cached_property
    def numbers(self) -> tuple[Any, ...]:
        """What loops take: plain tuples are handed over sooner."""
        k = self.plain
        return (
            *self.values, k.bend_soft, k.turn_soft, k.shear_soft, k.n3_extends, k.m3_extends,
            k.slack_load, k.untwist, k.per_gamma, k.per_p, k.bending, k.turning, k.shearing,
            k.slack, k.per_turning, k.stretching, *k.within_overload[DOUBLE], *k.within_q[DOUBLE],
        )


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


@at_point
def _exp(x: float) -> float:
    """exp x; below the normal numbers in two steps."""
    far = x < -668.0
    high = 709.5 if x > 709.5 else x + 40.0 if far else x
    rest, power = _reduced(-708.0 if high < -708.0 else high)
    value = power + power * rest
    return math.inf if x > 709.5 else value * EXP_40 if far else value


@at_point
def _expm1(x: float) -> float:
    """exp x - 1, without cancellation at small x."""
    high = 709.5 if x > 709.5 else x
    rest, power = _reduced(-708.0 if high < -708.0 else high)
    return math.inf if x > 709.5 else (power - 1) + power * rest


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


@at_point
def _log1p(x: float) -> float:
    """log(1 + x), with what rounds off in the sum added again."""
    u = 1 + x
    return _log(u) + (x - (u - 1)) / u


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


@at_point
def _scale(largest: float, shift: int) -> float:
    """A power of two that takes the largest input near one, a small one to 2^-400, by ``shift``."""
    power = frexp(largest)[1]
    return ldexp(1.0, min(max(shift - max(power, 0) - min(power + 400, 0), -1020), 1020))


@at_point
def _whole_6(k: Any) -> Any:
    """A symmetric matrix by rows, from its entries on and above the diagonal."""
    return (
        k[0], k[1], k[2], k[3], k[4], k[5],
        k[1], k[6], k[7], k[8], k[9], k[10],
        k[2], k[7], k[11], k[12], k[13], k[14],
        k[3], k[8], k[12], k[15], k[16], k[17],
        k[4], k[9], k[13], k[16], k[18], k[19],
        k[5], k[10], k[14], k[17], k[19], k[20],
    )


def _places(context: Any, builder: Any, kind: Any, array: Any, i: Any, count: int) -> list[Any]:
    """Where the numbers of point ``i`` are in an array."""
    made = context.make_array(kind)(context, builder, array)
    points = builder.extract_value(made.shape, kind.ndim - 1)
    index = [builder.add(builder.mul(points, points.type(k)), i) for k in range(count)]
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


@at_point
def _strains(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, scale: float
) -> Any:
    """(u, v - e3) = (gamma^p + Q*^(p/2))^(-1/p) K^-1 (m, n)."""
    m1, m2, m3 = scale * m1, scale * m2, scale * m3
    n1, n2, n3 = scale * n1, scale * n2, scale * n3
    mu_1, mu_2, mu_3, nu_1 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3, c.per_zeta * n1
    nu_2 = c.per_zeta * n2
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    square = (
        c.gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    size = sqrt(square)
    y = size / scale
    larger = c.gamma if c.gamma > y else y
    raw_1 = (c.gamma if c.gamma < y else y) / larger
    ratio = LEAST if LEAST > raw_1 else raw_1
    power = _exp(c.p * _log(ratio))
    factor = _exp(-c.per_p * _log1p(power)) / larger
    reach = factor / scale
    bend, turn, shear = c.per_alpha * reach, c.per_beta * reach, c.per_zeta * reach
    extend = c.per_eta * reach
    return (
        (
            bend * mu_1, bend * mu_2, turn * twist, nu_1 * shear, nu_2 * shear,
            dilatation * extend + 1,
        ),
        square,
    )


@at_point
def _strains_plain(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, k: Ordinary
) -> Any:
    """`_strains` where nothing is extreme."""
    w1, w2, turn, w4 = k.bend_soft * m1, k.bend_soft * m2, k.turn_soft * m3, k.shear_soft * n1
    w5 = k.shear_soft * n2
    extension = k.n3_extends * n3 - k.m3_extends * m3
    overload = (
        k.per_gamma
        * (k.slack_load * extension * extension + m1 * w1 + m2 * w2 + m3 * turn + n1 * w4 + n2 * w5)
    )
    twist = turn - k.untwist * extension
    excess = _exp(0.5 * c.p * _log(overload))
    root = _exp(-k.per_p * _log1p(excess))
    return (
        (
            root * w1, root * w2, root * twist, root * w4, root * w5, extension * root + 1,
        ),
        overload,
    )


@over_points
def _careful_strains(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`strains` where squares may leave their range, its inputs scaled."""
    values, square = _strains(m1, m2, m3, n1, n2, n3, c, 1.0)
    largest = max(abs(m1), abs(m2), abs(m3), abs(n1), abs(n2), abs(n3))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square = _strains(m1, m2, m3, n1, n2, n3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values


@over_points
def strains_at(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`strains` at one point: u (3,), v (3,); for compiled code."""
    values = _careful_strains(m1, m2, m3, n1, n2, n3, c)
    return values[0:3], values[3:6]


@over_points
def _strains_over(numbers: Any, m: Array, n: Array, u: Array, v: Array) -> tuple[int, Any, float]:
    """`strains` at every point."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = m.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(m), _span(n)), (_span(u), _span(v))):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, overload = _strains_plain(m1, m2, m3, n1, n2, n3, c, k)
            _put(u, 0, i, values[0:3])
            _put(v, 3, i, values[3:6])
            fine &= (overload > k.least_overload) & (overload < k.most_overload)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, square = _strains(m1, m2, m3, n1, n2, n3, c, 1.0)
            _put(u, 0, i, values[0:3])
            _put(v, 3, i, values[3:6])
            fine &= (square > LOW) & (square < HIGH)
        if not fine:
            for i in range(begin, end):
                m1, m2, m3 = _get(m, 3, i)
                n1, n2, n3 = _get(n, 3, i)
                values = _careful_strains(m1, m2, m3, n1, n2, n3, c)
                _put(u, 0, i, values[0:3])
                _put(v, 3, i, values[3:6])
    return past, first, worst


@at_point
def _loads(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, scale: float
) -> Any:
    """(m, n) = gamma (1 - Q^(p/2))^(-1/p) K (u, v - e3)."""
    stretch = v3 - 1
    u1, u2, u3 = scale * u1, scale * u2, scale * u3
    v1, v2, stretch = scale * v1, scale * v2, scale * stretch
    kappa_1, kappa_2, kappa_3, lam_1 = c.alpha * u1, c.alpha * u2, c.beta * u3, c.zeta * v1
    lam_2, lam_3 = c.zeta * v2, c.eta * stretch
    torque = c.chirality * lam_3 + kappa_3
    tension = c.chirality * torque + c.gap * lam_3
    square = (
        c.gap * lam_3 * lam_3 + kappa_1 * kappa_1 + kappa_2 * kappa_2 + lam_1 * lam_1
        + lam_2 * lam_2 + torque * torque
    )
    q = square / (scale * scale)
    raw_1 = -0.5 * c.p * _log(LEAST if LEAST > q else q)
    growth = 1 / _expm1(LOG_MOST if LOG_MOST < raw_1 else raw_1)
    depth = _log1p(growth)
    factor = c.gamma * _exp(c.per_p * depth)
    secant = factor / scale
    bend, turn, shear, extend = c.alpha * secant, c.beta * secant, c.zeta * secant, c.eta * secant
    return (
        (
            bend * kappa_1, bend * kappa_2, torque * turn, lam_1 * shear, lam_2 * shear,
            extend * tension,
        ),
        square, q,
    )


@at_point
def _loads_plain(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, k: Ordinary
) -> Any:
    """`_loads` where nothing is extreme."""
    stretch = v3 - 1
    r1, r2, r4, r5 = k.bending * u1, k.bending * u2, k.shearing * v1, k.shearing * v2
    torque = c.iota * stretch + k.turning * u3
    pull = k.slack * stretch
    tension = pull + k.untwist * torque
    q = k.per_turning * torque * torque + pull * stretch + r1 * u1 + r2 * u2 + r4 * v1 + r5 * v2
    left = -_expm1(0.5 * c.p * _log(q))
    hard = c.gamma * _exp(-k.per_p * _log(left))
    return (hard * r1, hard * r2, hard * torque, hard * r4, hard * r5, hard * tension), q


@over_points
def _careful_loads(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`loads` where squares may leave their range, its inputs scaled."""
    values, square, q = _loads(u1, u2, u3, v1, v2, v3, c, 1.0)
    largest = max(abs(u1), abs(u2), abs(u3), abs(v1), abs(v2), abs(v3 - 1))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square, q = _loads(u1, u2, u3, v1, v2, v3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values, q


@over_points
def loads_at(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`loads` at one point: m (3,), n (3,); for compiled code."""
    values, q = _careful_loads(u1, u2, u3, v1, v2, v3, c)
    if not q < 1:
        raise ValueError("strains must satisfy Q(u, v) < 1")
    return values[0:3], values[3:6]


@over_points
def _loads_over(numbers: Any, u: Array, v: Array, m: Array, n: Array) -> tuple[int, Any, float]:
    """`loads` at every point; points past the limit, the first, its Q."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = u.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(u), _span(v)), (_span(m), _span(n))):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, q = _loads_plain(u1, u2, u3, v1, v2, v3, c, k)
            _put(m, 0, i, values[0:3])
            _put(n, 3, i, values[3:6])
            fine &= (q > k.least_q) & (q < k.most_q)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, square, q = _loads(u1, u2, u3, v1, v2, v3, c, 1.0)
            _put(m, 0, i, values[0:3])
            _put(n, 3, i, values[3:6])
            fine &= (square > LOW) & (square < HIGH)
            fine &= q < 1
        if not fine:
            for i in range(begin, end):
                u1, u2, u3 = _get(u, 3, i)
                v1, v2, v3 = _get(v, 3, i)
                values, q = _careful_loads(u1, u2, u3, v1, v2, v3, c)
                _put(m, 0, i, values[0:3])
                _put(n, 3, i, values[3:6])
                if not q < 1:
                    first, worst = (np.int64(i), q) if past == 0 else (first, worst)
                    past += 1
    return past, first, worst


@at_point
def _stored_energy(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, scale: float
) -> Any:
    """W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of the work."""
    stretch = v3 - 1
    u1, u2, u3 = scale * u1, scale * u2, scale * u3
    v1, v2, stretch = scale * v1, scale * v2, scale * stretch
    kappa_1, kappa_2, kappa_3, lam_1 = c.alpha * u1, c.alpha * u2, c.beta * u3, c.zeta * v1
    lam_2, lam_3 = c.zeta * v2, c.eta * stretch
    torque = c.chirality * lam_3 + kappa_3
    square = (
        c.gap * lam_3 * lam_3 + kappa_1 * kappa_1 + kappa_2 * kappa_2 + lam_1 * lam_1
        + lam_2 * lam_2 + torque * torque
    )
    size = sqrt(square)
    x = size / scale
    q = x * x
    raw_1 = -0.5 * c.p * _log(LEAST if LEAST > q else q)
    growth = 1 / _expm1(LOG_MOST if LOG_MOST < raw_1 else raw_1)
    depth = _log1p(growth)
    factor = c.gamma * _exp(c.per_p * depth)
    load = factor * x
    return load * x * _work_share_at(depth, c), square, q


@over_points
def _careful_stored_energy(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`stored_energy` where squares may leave their range, its inputs scaled."""
    values, square, q = _stored_energy(u1, u2, u3, v1, v2, v3, c, 1.0)
    largest = max(abs(u1), abs(u2), abs(u3), abs(v1), abs(v2), abs(v3 - 1))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square, q = _stored_energy(u1, u2, u3, v1, v2, v3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values, q


@over_points
def stored_energy_at(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`stored_energy` at one point: w a number; for compiled code."""
    values, q = _careful_stored_energy(u1, u2, u3, v1, v2, v3, c)
    if not q < 1:
        raise ValueError("strains must satisfy Q(u, v) < 1")
    return values


@over_points
def _stored_energy_over(numbers: Any, u: Array, v: Array, w: Array) -> tuple[int, Any, float]:
    """`stored_energy` at every point; points past the limit, the first, its Q."""
    c = Values(*numbers[:19])
    points, past, first, worst = u.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(u), _span(v)), (_span(w),)):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, square, q = _stored_energy(u1, u2, u3, v1, v2, v3, c, 1.0)
            _put(w, 0, i, (values,))
            fine &= (square > LOW) & (square < HIGH)
            fine &= q < 1
        if not fine:
            for i in range(begin, end):
                u1, u2, u3 = _get(u, 3, i)
                v1, v2, v3 = _get(v, 3, i)
                values, q = _careful_stored_energy(u1, u2, u3, v1, v2, v3, c)
                _put(w, 0, i, (values,))
                if not q < 1:
                    first, worst = (np.int64(i), q) if past == 0 else (first, worst)
                    past += 1
    return past, first, worst


@at_point
def _complementary_energy(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, scale: float
) -> Any:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."""
    m1, m2, m3 = scale * m1, scale * m2, scale * m3
    n1, n2, n3 = scale * n1, scale * n2, scale * n3
    mu_1, mu_2, mu_3, nu_1 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3, c.per_zeta * n1
    nu_2 = c.per_zeta * n2
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    square = (
        c.gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    size = sqrt(square)
    y = size / scale
    larger = c.gamma if c.gamma > y else y
    raw_1 = (c.gamma if c.gamma < y else y) / larger
    ratio = LEAST if LEAST > raw_1 else raw_1
    power = _exp(c.p * _log(ratio))
    factor = _exp(-c.per_p * _log1p(power)) / larger
    strain = factor * y
    depth = _log1p(power) - c.p * (0.0 if y <= c.gamma else _log(ratio))
    return strain * y * (1 - _work_share_at(depth, c)), square


@over_points
def _careful_complementary_energy(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`complementary_energy` where squares may leave their range, its inputs scaled."""
    values, square = _complementary_energy(m1, m2, m3, n1, n2, n3, c, 1.0)
    largest = max(abs(m1), abs(m2), abs(m3), abs(n1), abs(n2), abs(n3))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square = _complementary_energy(
                m1, m2, m3, n1, n2, n3, c, _scale(largest, shift)
            )
            if LOW < square < HIGH:
                break
    return values


@over_points
def complementary_energy_at(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`complementary_energy` at one point: w_star a number; for compiled code."""
    return _careful_complementary_energy(m1, m2, m3, n1, n2, n3, c)


@over_points
def _complementary_energy_over(
    numbers: Any, m: Array, n: Array, w_star: Array
) -> tuple[int, Any, float]:
    """`complementary_energy` at every point."""
    c = Values(*numbers[:19])
    points, past, first, worst = m.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(m), _span(n)), (_span(w_star),)):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, square = _complementary_energy(m1, m2, m3, n1, n2, n3, c, 1.0)
            _put(w_star, 0, i, (values,))
            fine &= (square > LOW) & (square < HIGH)
        if not fine:
            for i in range(begin, end):
                m1, m2, m3 = _get(m, 3, i)
                n1, n2, n3 = _get(n, 3, i)
                values = _careful_complementary_energy(m1, m2, m3, n1, n2, n3, c)
                _put(w_star, 0, i, (values,))
    return past, first, worst


@at_point
def _stiffness(u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values) -> Any:
    """D^2 W = factor (K + growth t t^T), t = K (u, v - e3)/x."""
    stretch = v3 - 1
    kappa_1, kappa_2, kappa_3, lam_1 = c.alpha * u1, c.alpha * u2, c.beta * u3, c.zeta * v1
    lam_2, lam_3 = c.zeta * v2, c.eta * stretch
    torque = c.chirality * lam_3 + kappa_3
    tension = c.chirality * torque + c.gap * lam_3
    q = (
        c.gap * lam_3 * lam_3 + kappa_1 * kappa_1 + kappa_2 * kappa_2 + lam_1 * lam_1
        + lam_2 * lam_2 + torque * torque
    )
    raw_1 = -0.5 * c.p * _log(LEAST if LEAST > q else q)
    growth, x = 1 / _expm1(LOG_MOST if LOG_MOST < raw_1 else raw_1), sqrt(LEAST if LEAST > q else q)
    depth = _log1p(growth)
    factor = c.gamma * _exp(c.per_p * depth)
    steep = factor * growth
    per_x = 1 / x
    bend_per_x, turn_per_x, shear_per_x = c.alpha * per_x, c.beta * per_x, c.zeta * per_x
    extend_per_x, t1, t2 = c.eta * per_x, bend_per_x * kappa_1, bend_per_x * kappa_2
    t3, t4, t5 = torque * turn_per_x, lam_1 * shear_per_x, lam_2 * shear_per_x
    t6, steep_1, steep_2, steep_3 = extend_per_x * tension, steep * t1, steep * t2, steep * t3
    steep_4, steep_5, steep_6 = steep * t4, steep * t5, steep * t6
    k11, k12, k13 = c.alpha * c.alpha * factor + steep_1 * t1, steep_1 * t2, steep_1 * t3
    k14, k15, k16 = steep_1 * t4, steep_1 * t5, steep_1 * t6
    k22, k23, k24 = c.alpha * c.alpha * factor + steep_2 * t2, steep_2 * t3, steep_2 * t4
    k25, k26 = steep_2 * t5, steep_2 * t6
    k33, k34, k35 = c.beta * c.beta * factor + steep_3 * t3, steep_3 * t4, steep_3 * t5
    k36 = c.iota * factor + steep_3 * t6
    k44, k45, k46 = c.zeta * c.zeta * factor + steep_4 * t4, steep_4 * t5, steep_4 * t6
    k55, k56 = c.zeta * c.zeta * factor + steep_5 * t5, steep_5 * t6
    k66 = c.eta * c.eta * factor + steep_6 * t6
    return (
        (
            k11, k12, k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35, k36, k44, k45,
            k46, k55, k56, k66,
        ),
        q,
    )


@at_point
def _stiffness_plain(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, k: Ordinary
) -> Any:
    """`_stiffness` where nothing is extreme."""
    stretch = v3 - 1
    r1, r2, r4, r5 = k.bending * u1, k.bending * u2, k.shearing * v1, k.shearing * v2
    torque = c.iota * stretch + k.turning * u3
    pull = k.slack * stretch
    tension = pull + k.untwist * torque
    q = k.per_turning * torque * torque + pull * stretch + r1 * u1 + r2 * u2 + r4 * v1 + r5 * v2
    left = -_expm1(0.5 * c.p * _log(q))
    hard = c.gamma * _exp(-k.per_p * _log(left))
    steep = hard * (1 - left) / left / q
    bend, shear, steep_1, steep_2 = k.bending * hard, k.shearing * hard, r1 * steep, r2 * steep
    steep_3, steep_4, steep_5, steep_6 = steep * torque, r4 * steep, r5 * steep, steep * tension
    k11, k12, k13, k14 = bend + r1 * steep_1, r2 * steep_1, steep_1 * torque, r4 * steep_1
    k15, k16 = r5 * steep_1, steep_1 * tension
    k22, k23, k24, k25 = bend + r2 * steep_2, steep_2 * torque, r4 * steep_2, r5 * steep_2
    k26 = steep_2 * tension
    k33, k34, k35 = k.turning * hard + steep_3 * torque, r4 * steep_3, r5 * steep_3
    k36 = c.iota * hard + steep_3 * tension
    k44, k45, k46 = r4 * steep_4 + shear, r5 * steep_4, steep_4 * tension
    k55, k56 = r5 * steep_5 + shear, steep_5 * tension
    k66 = k.stretching * hard + steep_6 * tension
    return (
        (
            k11, k12, k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35, k36, k44, k45,
            k46, k55, k56, k66,
        ),
        q,
    )


@over_points
def stiffness_at(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`stiffness` at one point: stiff (6, 6); for compiled code."""
    values, q = _stiffness(u1, u2, u3, v1, v2, v3, c)
    if not q < 1:
        raise ValueError("strains must satisfy Q(u, v) < 1")
    return (
        (values[0], values[1], values[2], values[3], values[4], values[5]),
        (values[1], values[6], values[7], values[8], values[9], values[10]),
        (values[2], values[7], values[11], values[12], values[13], values[14]),
        (values[3], values[8], values[12], values[15], values[16], values[17]),
        (values[4], values[9], values[13], values[16], values[18], values[19]),
        (values[5], values[10], values[14], values[17], values[19], values[20]),
    )


@over_points
def _stiffness_over(numbers: Any, u: Array, v: Array, stiff: Array) -> tuple[int, Any, float]:
    """`stiffness` at every point; points past the limit, the first, its Q."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = u.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(u), _span(v)), (_span(stiff),)):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, q = _stiffness_plain(u1, u2, u3, v1, v2, v3, c, k)
            _put(stiff, 0, i, _whole_6(values))
            fine &= (q > k.least_q) & (q < k.most_q)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, q = _stiffness(u1, u2, u3, v1, v2, v3, c)
            _put(stiff, 0, i, _whole_6(values))
            fine &= q < 1
        if not fine:
            for i in range(begin, end):
                u1, u2, u3 = _get(u, 3, i)
                v1, v2, v3 = _get(v, 3, i)
                _, q = _stiffness(u1, u2, u3, v1, v2, v3, c)
                if not q < 1:
                    first, worst = (np.int64(i), q) if past == 0 else (first, worst)
                    past += 1
    return past, first, worst


@at_point
def _loads_and_stiffness(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, scale: float
) -> Any:
    """(m, n) = factor K (u, v - e3) and D^2 W = factor (K + growth t t^T), as apart."""
    stretch = v3 - 1
    u1, u2, u3 = scale * u1, scale * u2, scale * u3
    v1, v2, stretch = scale * v1, scale * v2, scale * stretch
    kappa_1, kappa_2, kappa_3, lam_1 = c.alpha * u1, c.alpha * u2, c.beta * u3, c.zeta * v1
    lam_2, lam_3 = c.zeta * v2, c.eta * stretch
    torque = c.chirality * lam_3 + kappa_3
    tension = c.chirality * torque + c.gap * lam_3
    square = (
        c.gap * lam_3 * lam_3 + kappa_1 * kappa_1 + kappa_2 * kappa_2 + lam_1 * lam_1
        + lam_2 * lam_2 + torque * torque
    )
    size, raw_2 = sqrt(square), sqrt(LEAST)
    x = size / scale
    q = x * x
    raw_1 = -0.5 * c.p * _log(LEAST if LEAST > q else q)
    growth = 1 / _expm1(LOG_MOST if LOG_MOST < raw_1 else raw_1)
    depth = _log1p(growth)
    factor = c.gamma * _exp(c.per_p * depth)
    steep = factor * growth
    per_size = 1 / (size if size > raw_2 else raw_2)
    bend_per_size, turn_per_size = c.alpha * per_size, c.beta * per_size
    shear_per_size, extend_per_size = c.zeta * per_size, c.eta * per_size
    secant = factor / scale
    bend, turn, shear, extend = c.alpha * secant, c.beta * secant, c.zeta * secant, c.eta * secant
    t1, t2, t3 = bend_per_size * kappa_1, bend_per_size * kappa_2, torque * turn_per_size
    t4, t5, t6 = lam_1 * shear_per_size, lam_2 * shear_per_size, extend_per_size * tension
    steep_1, steep_2, steep_3, steep_4 = steep * t1, steep * t2, steep * t3, steep * t4
    steep_5, steep_6 = steep * t5, steep * t6
    k11, k12, k13 = c.alpha * c.alpha * factor + steep_1 * t1, steep_1 * t2, steep_1 * t3
    k14, k15, k16 = steep_1 * t4, steep_1 * t5, steep_1 * t6
    k22, k23, k24 = c.alpha * c.alpha * factor + steep_2 * t2, steep_2 * t3, steep_2 * t4
    k25, k26 = steep_2 * t5, steep_2 * t6
    k33, k34, k35 = c.beta * c.beta * factor + steep_3 * t3, steep_3 * t4, steep_3 * t5
    k36 = c.iota * factor + steep_3 * t6
    k44, k45, k46 = c.zeta * c.zeta * factor + steep_4 * t4, steep_4 * t5, steep_4 * t6
    k55, k56 = c.zeta * c.zeta * factor + steep_5 * t5, steep_5 * t6
    k66 = c.eta * c.eta * factor + steep_6 * t6
    return (
        (
            bend * kappa_1, bend * kappa_2, torque * turn, lam_1 * shear, lam_2 * shear,
            extend * tension, k11, k12, k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35,
            k36, k44, k45, k46, k55, k56, k66,
        ),
        square, q,
    )


@at_point
def _loads_and_stiffness_plain(
    u1: float, u2: float, u3: float, v1: float, v2: float, v3: float, c: Values, k: Ordinary
) -> Any:
    """`_loads_and_stiffness` where nothing is extreme."""
    stretch = v3 - 1
    r1, r2, r4, r5 = k.bending * u1, k.bending * u2, k.shearing * v1, k.shearing * v2
    torque = c.iota * stretch + k.turning * u3
    pull = k.slack * stretch
    tension = pull + k.untwist * torque
    q = k.per_turning * torque * torque + pull * stretch + r1 * u1 + r2 * u2 + r4 * v1 + r5 * v2
    left = -_expm1(0.5 * c.p * _log(q))
    hard = c.gamma * _exp(-k.per_p * _log(left))
    steep = hard * (1 - left) / left / q
    bend, shear, steep_1, steep_2 = k.bending * hard, k.shearing * hard, r1 * steep, r2 * steep
    steep_3, steep_4, steep_5, steep_6 = steep * torque, r4 * steep, r5 * steep, steep * tension
    k11, k12, k13, k14 = bend + r1 * steep_1, r2 * steep_1, steep_1 * torque, r4 * steep_1
    k15, k16 = r5 * steep_1, steep_1 * tension
    k22, k23, k24, k25 = bend + r2 * steep_2, steep_2 * torque, r4 * steep_2, r5 * steep_2
    k26 = steep_2 * tension
    k33, k34, k35 = k.turning * hard + steep_3 * torque, r4 * steep_3, r5 * steep_3
    k36 = c.iota * hard + steep_3 * tension
    k44, k45, k46 = r4 * steep_4 + shear, r5 * steep_4, steep_4 * tension
    k55, k56 = r5 * steep_5 + shear, steep_5 * tension
    k66 = k.stretching * hard + steep_6 * tension
    return (
        (
            hard * r1, hard * r2, hard * torque, hard * r4, hard * r5, hard * tension, k11, k12,
            k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35, k36, k44, k45, k46, k55,
            k56, k66,
        ),
        q,
    )


@over_points
def _careful_loads_and_stiffness(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`loads_and_stiffness` where squares may leave their range, its inputs scaled."""
    values, square, q = _loads_and_stiffness(u1, u2, u3, v1, v2, v3, c, 1.0)
    largest = max(abs(u1), abs(u2), abs(u3), abs(v1), abs(v2), abs(v3 - 1))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square, q = _loads_and_stiffness(
                u1, u2, u3, v1, v2, v3, c, _scale(largest, shift)
            )
            if LOW < square < HIGH:
                break
    return values, q


@over_points
def loads_and_stiffness_at(u1, u2, u3, v1, v2, v3, c: Values) -> Any:
    """`loads_and_stiffness` at one point: m (3,), n (3,), stiff (6, 6); for compiled code."""
    values, q = _careful_loads_and_stiffness(u1, u2, u3, v1, v2, v3, c)
    if not q < 1:
        raise ValueError("strains must satisfy Q(u, v) < 1")
    stiff = (
        (values[6], values[7], values[8], values[9], values[10], values[11]),
        (values[7], values[12], values[13], values[14], values[15], values[16]),
        (values[8], values[13], values[17], values[18], values[19], values[20]),
        (values[9], values[14], values[18], values[21], values[22], values[23]),
        (values[10], values[15], values[19], values[22], values[24], values[25]),
        (values[11], values[16], values[20], values[23], values[25], values[26]),
    )
    return values[0:3], values[3:6], stiff


@over_points
def _loads_and_stiffness_over(
    numbers: Any, u: Array, v: Array, m: Array, n: Array, stiff: Array
) -> tuple[int, Any, float]:
    """`loads_and_stiffness` at every point; points past the limit, the first, its Q."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = u.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(u), _span(v)), (_span(m), _span(n), _span(stiff))):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, q = _loads_and_stiffness_plain(u1, u2, u3, v1, v2, v3, c, k)
            _put(m, 0, i, values[0:3])
            _put(n, 3, i, values[3:6])
            _put(stiff, 6, i, _whole_6(values[6:27]))
            fine &= (q > k.least_q) & (q < k.most_q)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            u1, u2, u3 = _get(u, 3, i)
            v1, v2, v3 = _get(v, 3, i)
            values, square, q = _loads_and_stiffness(u1, u2, u3, v1, v2, v3, c, 1.0)
            _put(m, 0, i, values[0:3])
            _put(n, 3, i, values[3:6])
            _put(stiff, 6, i, _whole_6(values[6:27]))
            fine &= (square > LOW) & (square < HIGH)
            fine &= q < 1
        if not fine:
            for i in range(begin, end):
                u1, u2, u3 = _get(u, 3, i)
                v1, v2, v3 = _get(v, 3, i)
                values, q = _careful_loads_and_stiffness(u1, u2, u3, v1, v2, v3, c)
                _put(m, 0, i, values[0:3])
                _put(n, 3, i, values[3:6])
                _put(stiff, 6, i, _whole_6(values[6:27]))
                if not q < 1:
                    first, worst = (np.int64(i), q) if past == 0 else (first, worst)
                    past += 1
    return past, first, worst


@at_point
def _compliance(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, scale: float
) -> Any:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 (m, n)/y.

    With (a, b) the reduced load as a unit vector and (c3, c6) the linear rod's reduced strains,
    the entries that would cancel are sums of squares.
    """
    m1, m2, m3 = scale * m1, scale * m2, scale * m3
    n1, n2, n3 = scale * n1, scale * n2, scale * n3
    mu_1, mu_2, mu_3, nu_1 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3, c.per_zeta * n1
    nu_2, nu_3 = c.per_zeta * n2, c.per_eta * n3
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    square = (
        c.gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    size = sqrt(square)
    y = size / scale
    larger = c.gamma if c.gamma > y else y
    raw_1 = (c.gamma if c.gamma < y else y) / larger
    ratio = LEAST if LEAST > raw_1 else raw_1
    power = _exp(c.p * _log(ratio))
    factor = _exp(-c.per_p * _log1p(power)) / larger
    remain = (1.0 if y <= c.gamma else power) / (power + 1)
    per_size = 1 / (LEAST if LEAST > size else size)
    a1, share = per_size * (mu_1 + LEAST), (power if y <= c.gamma else 1.0) / (power + 1)
    aa1 = a1 * a1
    a2, a3, b1, b2 = mu_2 * per_size, mu_3 * per_size, nu_1 * per_size, nu_2 * per_size
    aa2, aa3, bb1, bb2 = a2 * a2, a3 * a3, b1 * b1, b2 * b2
    b3, c3, c6, d1 = nu_3 * per_size, per_size * twist, dilatation * per_size, c.per_alpha * a1
    cc6 = c6 * c6
    across = aa1 + aa2 + bb1 + bb2
    coupled = aa3 + c.gap * cc6
    steep = -factor * share
    d2, d3, d4, d5 = c.per_alpha * a2, c.per_beta * c3, c.per_zeta * b1, c.per_zeta * b2
    d6, steep_1, steep_2, steep_3 = c.per_eta * c6, d1 * steep, d2 * steep, d3 * steep
    steep_4, steep_5 = d4 * steep, d5 * steep
    s11 = c.per_alpha * c.per_alpha * factor * (aa1 * remain + aa2 + bb1 + bb2 + coupled)
    s12, s13, s14, s15, s16 = d2 * steep_1, d3 * steep_1, d4 * steep_1, d5 * steep_1, d6 * steep_1
    s22 = c.per_alpha * c.per_alpha * factor * (aa1 + aa2 * remain + bb1 + bb2 + coupled)
    s23, s24, s25, s26 = d3 * steep_2, d4 * steep_2, d5 * steep_2, d6 * steep_2
    s33 = c.per_beta * c.per_beta * factor * (c3 * c3 * remain + c.per_gap * (across + b3 * b3))
    s34, s35 = d4 * steep_3, d5 * steep_3
    s36 = (
        c.per_beta * c.per_eta * factor
        * (c3 * c6 * remain - c.per_gap * (a3 * b3 + c.chirality * across))
    )
    s44 = c.per_zeta * c.per_zeta * factor * (aa1 + aa2 + bb1 * remain + bb2 + coupled)
    s45, s46 = d5 * steep_4, d6 * steep_4
    s55 = c.per_zeta * c.per_zeta * factor * (aa1 + aa2 + bb1 + bb2 * remain + coupled)
    s56 = d6 * steep_5
    s66 = c.per_eta * c.per_eta * factor * (cc6 * remain + c.per_gap * (aa3 + across))
    return (
        (
            s11, s12, s13, s14, s15, s16, s22, s23, s24, s25, s26, s33, s34, s35, s36, s44, s45,
            s46, s55, s56, s66,
        ),
        square,
    )


@over_points
def _careful_compliance(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`compliance` where squares may leave their range, its inputs scaled."""
    values, square = _compliance(m1, m2, m3, n1, n2, n3, c, 1.0)
    largest = max(abs(m1), abs(m2), abs(m3), abs(n1), abs(n2), abs(n3))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square = _compliance(m1, m2, m3, n1, n2, n3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values


@over_points
def compliance_at(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`compliance` at one point: soft (6, 6); for compiled code."""
    values = _careful_compliance(m1, m2, m3, n1, n2, n3, c)
    return (
        (values[0], values[1], values[2], values[3], values[4], values[5]),
        (values[1], values[6], values[7], values[8], values[9], values[10]),
        (values[2], values[7], values[11], values[12], values[13], values[14]),
        (values[3], values[8], values[12], values[15], values[16], values[17]),
        (values[4], values[9], values[13], values[16], values[18], values[19]),
        (values[5], values[10], values[14], values[17], values[19], values[20]),
    )


@over_points
def _compliance_over(numbers: Any, m: Array, n: Array, soft: Array) -> tuple[int, Any, float]:
    """`compliance` at every point."""
    c = Values(*numbers[:19])
    points, past, first, worst = m.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(m), _span(n)), (_span(soft),)):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, square = _compliance(m1, m2, m3, n1, n2, n3, c, 1.0)
            _put(soft, 0, i, _whole_6(values))
            fine &= (square > LOW) & (square < HIGH)
        if not fine:
            for i in range(begin, end):
                m1, m2, m3 = _get(m, 3, i)
                n1, n2, n3 = _get(n, 3, i)
                values = _careful_compliance(m1, m2, m3, n1, n2, n3, c)
                _put(soft, 0, i, _whole_6(values))
    return past, first, worst


@at_point
def _strains_and_gap(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, scale: float
) -> Any:
    """The strains, and 1 - Q^(p/2) = gamma^p/(gamma^p + Q*^(p/2))."""
    m1, m2, m3 = scale * m1, scale * m2, scale * m3
    n1, n2, n3 = scale * n1, scale * n2, scale * n3
    mu_1, mu_2, mu_3, nu_1 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3, c.per_zeta * n1
    nu_2 = c.per_zeta * n2
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    square = (
        c.gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    size = sqrt(square)
    y = size / scale
    larger = c.gamma if c.gamma > y else y
    raw_1 = (c.gamma if c.gamma < y else y) / larger
    ratio = LEAST if LEAST > raw_1 else raw_1
    power = _exp(c.p * _log(ratio))
    factor = _exp(-c.per_p * _log1p(power)) / larger
    reach, remain = factor / scale, (1.0 if y <= c.gamma else power) / (power + 1)
    bend, turn, shear = c.per_alpha * reach, c.per_beta * reach, c.per_zeta * reach
    extend = c.per_eta * reach
    return (
        (
            bend * mu_1, bend * mu_2, turn * twist, nu_1 * shear, nu_2 * shear,
            dilatation * extend + 1, remain,
        ),
        square,
    )


@at_point
def _strains_and_gap_plain(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, k: Ordinary
) -> Any:
    """`_strains_and_gap` where nothing is extreme."""
    w1, w2, turn, w4 = k.bend_soft * m1, k.bend_soft * m2, k.turn_soft * m3, k.shear_soft * n1
    w5 = k.shear_soft * n2
    extension = k.n3_extends * n3 - k.m3_extends * m3
    overload = (
        k.per_gamma
        * (k.slack_load * extension * extension + m1 * w1 + m2 * w2 + m3 * turn + n1 * w4 + n2 * w5)
    )
    twist = turn - k.untwist * extension
    excess = _exp(0.5 * c.p * _log(overload))
    root = _exp(-k.per_p * _log1p(excess))
    return (
        (
            root * w1, root * w2, root * twist, root * w4, root * w5, extension * root + 1,
            1 / (excess + 1),
        ),
        overload,
    )


@over_points
def _careful_strains_and_gap(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`strains_and_gap` where squares may leave their range, its inputs scaled."""
    values, square = _strains_and_gap(m1, m2, m3, n1, n2, n3, c, 1.0)
    largest = max(abs(m1), abs(m2), abs(m3), abs(n1), abs(n2), abs(n3))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square = _strains_and_gap(m1, m2, m3, n1, n2, n3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values


@over_points
def strains_and_gap_at(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`strains_and_gap` at one point: u (3,), v (3,), limit_gap a number; for compiled code."""
    values = _careful_strains_and_gap(m1, m2, m3, n1, n2, n3, c)
    return values[0:3], values[3:6], values[6]


@over_points
def _strains_and_gap_over(
    numbers: Any, m: Array, n: Array, u: Array, v: Array, limit_gap: Array
) -> tuple[int, Any, float]:
    """`strains_and_gap` at every point."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = m.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(m), _span(n)), (_span(u), _span(v), _span(limit_gap))):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, overload = _strains_and_gap_plain(m1, m2, m3, n1, n2, n3, c, k)
            _put(u, 0, i, values[0:3])
            _put(v, 3, i, values[3:6])
            _put(limit_gap, 6, i, values[6:7])
            fine &= (overload > k.least_overload) & (overload < k.most_overload)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, square = _strains_and_gap(m1, m2, m3, n1, n2, n3, c, 1.0)
            _put(u, 0, i, values[0:3])
            _put(v, 3, i, values[3:6])
            _put(limit_gap, 6, i, values[6:7])
            fine &= (square > LOW) & (square < HIGH)
        if not fine:
            for i in range(begin, end):
                m1, m2, m3 = _get(m, 3, i)
                n1, n2, n3 = _get(n, 3, i)
                values = _careful_strains_and_gap(m1, m2, m3, n1, n2, n3, c)
                _put(u, 0, i, values[0:3])
                _put(v, 3, i, values[3:6])
                _put(limit_gap, 6, i, values[6:7])
    return past, first, worst


@at_point
def _stiffness_at_loads(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, scale: float
) -> Any:
    """D^2 W = factor (K + h h^T), h = (y/gamma)^(p/2) (m, n)/y, y^2 = Q*."""
    m1, m2, m3 = scale * m1, scale * m2, scale * m3
    n1, n2, n3 = scale * n1, scale * n2, scale * n3
    mu_1, mu_2, mu_3, nu_1 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3, c.per_zeta * n1
    nu_2, nu_3 = c.per_zeta * n2, c.per_eta * n3
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    square = (
        c.gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    size, raw_3 = sqrt(square), sqrt(LEAST)
    y = size / scale
    raw_1 = c.per_gamma * y
    rise = _exp(0.5 * c.p * _log(LEAST if LEAST > raw_1 else raw_1))
    raw_2 = 1 / (LEAST if LEAST > rise else rise)
    half = rise if rise < raw_2 else raw_2
    power = half * half
    factor = _exp(c.per_p * _log1p(power)) * (c.gamma if c.gamma > y else y)
    rise_per_size = rise / (size if size > raw_3 else raw_3)
    bend_rise, turn_rise = c.alpha * rise_per_size, c.beta * rise_per_size
    shear_rise, extend_rise, h1 = c.zeta * rise_per_size, c.eta * rise_per_size, bend_rise * mu_1
    h2, h3, h4, h5 = bend_rise * mu_2, mu_3 * turn_rise, nu_1 * shear_rise, nu_2 * shear_rise
    h6, factor_1, factor_2, factor_3 = extend_rise * nu_3, factor * h1, factor * h2, factor * h3
    factor_4, factor_5, factor_6 = factor * h4, factor * h5, factor * h6
    k11, k12, k13 = c.alpha * c.alpha * factor + factor_1 * h1, factor_1 * h2, factor_1 * h3
    k14, k15, k16 = factor_1 * h4, factor_1 * h5, factor_1 * h6
    k22, k23, k24 = c.alpha * c.alpha * factor + factor_2 * h2, factor_2 * h3, factor_2 * h4
    k25, k26 = factor_2 * h5, factor_2 * h6
    k33, k34, k35 = c.beta * c.beta * factor + factor_3 * h3, factor_3 * h4, factor_3 * h5
    k36 = c.iota * factor + factor_3 * h6
    k44, k45, k46 = c.zeta * c.zeta * factor + factor_4 * h4, factor_4 * h5, factor_4 * h6
    k55, k56 = c.zeta * c.zeta * factor + factor_5 * h5, factor_5 * h6
    k66 = c.eta * c.eta * factor + factor_6 * h6
    return (
        (
            k11, k12, k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35, k36, k44, k45,
            k46, k55, k56, k66,
        ),
        square,
    )


@at_point
def _stiffness_at_loads_plain(
    m1: float, m2: float, m3: float, n1: float, n2: float, n3: float, c: Values, k: Ordinary
) -> Any:
    """`_stiffness_at_loads` where nothing is extreme."""
    w1, w2, turn, w4 = k.bend_soft * m1, k.bend_soft * m2, k.turn_soft * m3, k.shear_soft * n1
    w5, h1, h2, h3 = k.shear_soft * n2, k.per_gamma * m1, k.per_gamma * m2, k.per_gamma * m3
    extension = k.n3_extends * n3 - k.m3_extends * m3
    overload = (
        k.per_gamma
        * (k.slack_load * extension * extension + m1 * w1 + m2 * w2 + m3 * turn + n1 * w4 + n2 * w5)
    )
    excess = _exp(0.5 * c.p * _log(overload))
    hard = c.gamma * _exp(k.per_p * _log1p(excess))
    lift = excess * hard / overload
    h4, h5, h6, bend = k.per_gamma * n1, k.per_gamma * n2, k.per_gamma * n3, k.bending * hard
    shear, lift_1, lift_2, lift_3 = k.shearing * hard, h1 * lift, h2 * lift, h3 * lift
    lift_4, lift_5, lift_6 = h4 * lift, h5 * lift, h6 * lift
    k11, k12, k13, k14, k15 = bend + h1 * lift_1, h2 * lift_1, h3 * lift_1, h4 * lift_1, h5 * lift_1
    k16 = h6 * lift_1
    k22, k23, k24, k25, k26 = bend + h2 * lift_2, h3 * lift_2, h4 * lift_2, h5 * lift_2, h6 * lift_2
    k33, k34, k35 = h3 * lift_3 + k.turning * hard, h4 * lift_3, h5 * lift_3
    k36 = h6 * lift_3 + c.iota * hard
    k44, k45, k46 = h4 * lift_4 + shear, h5 * lift_4, h6 * lift_4
    k55, k56 = h5 * lift_5 + shear, h6 * lift_5
    k66 = h6 * lift_6 + k.stretching * hard
    return (
        (
            k11, k12, k13, k14, k15, k16, k22, k23, k24, k25, k26, k33, k34, k35, k36, k44, k45,
            k46, k55, k56, k66,
        ),
        overload,
    )


@over_points
def _careful_stiffness_at_loads(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`stiffness_at_loads` where squares may leave their range, its inputs scaled."""
    values, square = _stiffness_at_loads(m1, m2, m3, n1, n2, n3, c, 1.0)
    largest = max(abs(m1), abs(m2), abs(m3), abs(n1), abs(n2), abs(n3))
    if largest > 0 and not LOW < square < HIGH:  # at rest there is nothing to scale
        for shift in (0, 480, -480, 880):
            values, square = _stiffness_at_loads(m1, m2, m3, n1, n2, n3, c, _scale(largest, shift))
            if LOW < square < HIGH:
                break
    return values


@over_points
def stiffness_at_loads_at(m1, m2, m3, n1, n2, n3, c: Values) -> Any:
    """`stiffness_at_loads` at one point: stiff (6, 6); for compiled code."""
    values = _careful_stiffness_at_loads(m1, m2, m3, n1, n2, n3, c)
    return (
        (values[0], values[1], values[2], values[3], values[4], values[5]),
        (values[1], values[6], values[7], values[8], values[9], values[10]),
        (values[2], values[7], values[11], values[12], values[13], values[14]),
        (values[3], values[8], values[12], values[15], values[16], values[17]),
        (values[4], values[9], values[13], values[16], values[18], values[19]),
        (values[5], values[10], values[14], values[17], values[19], values[20]),
    )


@over_points
def _stiffness_at_loads_over(
    numbers: Any, m: Array, n: Array, stiff: Array
) -> tuple[int, Any, float]:
    """`stiffness_at_loads` at every point."""
    c = Values(*numbers[:19])
    k = Ordinary(*numbers[19:])
    points, past, first, worst = m.shape[-1], 0, np.int64(0), 0.0
    if _shared((_span(m), _span(n)), (_span(stiff),)):
        return -1, first, worst
    for start in range(0, points, BLOCK):
        begin, end = np.uint64(start), np.uint64(min(start + BLOCK, points))
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, overload = _stiffness_at_loads_plain(m1, m2, m3, n1, n2, n3, c, k)
            _put(stiff, 0, i, _whole_6(values))
            fine &= (overload > k.least_overload) & (overload < k.most_overload)
        if fine:
            continue
        fine = True
        for i in range(begin, end):
            m1, m2, m3 = _get(m, 3, i)
            n1, n2, n3 = _get(n, 3, i)
            values, square = _stiffness_at_loads(m1, m2, m3, n1, n2, n3, c, 1.0)
            _put(stiff, 0, i, _whole_6(values))
            fine &= (square > LOW) & (square < HIGH)
        if not fine:
            for i in range(begin, end):
                m1, m2, m3 = _get(m, 3, i)
                n1, n2, n3 = _get(n, 3, i)
                values = _careful_stiffness_at_loads(m1, m2, m3, n1, n2, n3, c)
                _put(stiff, 0, i, _whole_6(values))
    return past, first, worst


def _fresh(shape: tuple[int, ...], dtype: Any) -> Array:
    """A new array. A long one begins a cache line: stores across two of them take twice as long."""
    wanted = math.prod(shape) * np.dtype(dtype).itemsize
    if wanted < 2**15:
        return np.empty(shape, dtype)
    memory = np.empty(wanted + LINE, np.uint8)
    return np.ndarray(shape, dtype, memory, -memory.ctypes.data % LINE)


def _arguments(inputs: Inputs) -> tuple[list[Array], tuple[int, ...]]:
    """The inputs as float arrays of one type, components first, and the trailing shape."""
    ready = [*map(np.asarray, inputs.values())]
    common, shape = ready[0].dtype, ready[0].shape[len(HEADS[next(iter(inputs))]) :]
    if common in (np.float64, np.float32) and all(
        a.dtype == common and a.shape == (*HEADS[name], *shape)
        for name, a in zip(inputs, ready, strict=True)
    ):
        return ready, shape
    arrays = {name: np.asarray(value) for name, value in inputs.items()}
    for name, array in arrays.items():
        head = HEADS[name]
        if array.dtype.kind not in "iuf" or array.shape[: len(head)] != head:
            wanted = ", ".join([*map(str, head), "..."])
            kind = f"{array.dtype} of shape {array.shape}"
            raise ValueError(f"{name} must hold real numbers in the shape ({wanted}), not {kind}")
    dtype = np.float32 if np.result_type(*arrays.values()) == np.float32 else np.float64
    shapes = {a.shape[len(HEADS[name]) :] for name, a in arrays.items()}
    try:
        shape = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    except ValueError:
        given = " and ".join(f"{name} {a.shape}" for name, a in arrays.items())
        raise ValueError(f"{given} do not broadcast after their first axis") from None
    ready = []
    for name, array in arrays.items():
        head = HEADS[name]
        if array.shape != (*head, *shape):
            fill = (1,) * (len(head) + len(shape) - array.ndim)
            array = array.reshape((*head, *fill, *array.shape[len(head) :]))
            array = np.broadcast_to(array, (*head, *shape))
        ready.append(array.astype(dtype, copy=False))
    return ready, shape


def _results(names: Sequence[str], shape: tuple[int, ...], dtype: Any, out: Any) -> list[Array]:
    """The arrays to fill: new ones, or ``out`` after a check of its shapes and types."""
    shapes = [(*HEADS[name], *shape) for name in names]
    if out is None:
        return [_fresh(wanted, dtype) for wanted in shapes]
    given = out if isinstance(out, tuple) else (out,)
    if len(given) != len(names):
        raise ValueError(f"out must be {len(names)} arrays, for {' and '.join(names)}")
    for name, array, wanted in zip(names, given, shapes, strict=True):
        if not isinstance(array, np.ndarray) or (array.dtype, array.shape) != (dtype, wanted):
            kind = f"{getattr(array, 'dtype', type(array).__name__)} of shape {np.shape(array)}"
            raise ValueError(f"out for {name} must be {dtype} of shape {wanted}, not {kind}")
    return list(given)


def _apply(
    over: Callable[..., tuple[int, Any, float]],
    inputs: Inputs,
    c: Constants,
    names: Sequence[str],
    out: Any,
) -> Sequence[Array]:
    """Runs ``over`` on all points; at once where the arrays are as its loop wants them."""
    given: tuple[Any, ...] = tuple(inputs.values())
    shape = given[0].shape[-1:] if type(given[0]) is np.ndarray else ()
    if out is None:
        results = tuple([_fresh(HEADS[name] + shape, DOUBLE) for name in names])
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
        if type(a) is not np.ndarray or a.dtype is not DOUBLE or a.shape != HEADS[name] + shape:
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
        np.require(array.reshape(*HEADS[name], points), requirements=["C", "A"])
        for name, array in zip(inputs, arrays, strict=True)
    ]
    straight = all(r.flags.carray and r.dtype == DOUBLE for r in results)
    flat = [
        r.reshape(*HEADS[name], points) if straight else _fresh((*HEADS[name], points), DOUBLE)
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


def strains(m: ArrayLike, n: ArrayLike, constants: Constants, out: Pair | None = None) -> Pair:
    """Strains u, v under the loads m, n (eq:uconst to eq:v3const).

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Answers u (3, ...) in 1/length, v (3, ...) plain; at rest u = 0, v = (0, 0, 1).
    """
    u, v = _apply(_strains_over, {"m": m, "n": n}, constants, ("u", "v"), out)
    return u, v


def loads(u: ArrayLike, v: ArrayLike, constants: Constants, out: Pair | None = None) -> Pair:
    """Loads m, n at the strains u, v (eq:mconst to eq:n3const).

    u (3, ...) in 1/length, v (3, ...) plain, with Q < 1 (eq:strainlimiting).
    Answers m (3, ...) in force times length, n (3, ...) in force.
    Near the limit the strains hardly determine the loads.
    """
    m, n = _apply(_loads_over, {"u": u, "v": v}, constants, ("m", "n"), out)
    return m, n


def stored_energy(
    u: ArrayLike, v: ArrayLike, constants: Constants, out: Array | None = None
) -> Array:
    """Stored energy W per length, in force (eq:stenergy), with the trailing shape.

    u (3, ...) in 1/length, v (3, ...) plain, with Q < 1 (eq:strainlimiting).
    """
    (w,) = _apply(_stored_energy_over, {"u": u, "v": v}, constants, ("w",), out)
    return w


def complementary_energy(
    m: ArrayLike, n: ArrayLike, constants: Constants, out: Array | None = None
) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    """
    (w_star,) = _apply(_complementary_energy_over, {"m": m, "n": n}, constants, ("w_star",), out)
    return w_star


def stiffness(u: ArrayLike, v: ArrayLike, constants: Constants, out: Array | None = None) -> Array:
    """Stiffness d(m, n)/d(u, v), (6, 6, ...), symmetric positive definite (Section 3.4).

    u (3, ...) in 1/length, v (3, ...) plain, with Q < 1 (eq:strainlimiting).
    Rows and columns are ordered (m1, m2, m3, n1, n2, n3) and (u1, u2, u3, v1, v2, v3).
    """
    (stiff,) = _apply(_stiffness_over, {"u": u, "v": v}, constants, ("stiff",), out)
    return stiff


def loads_and_stiffness(
    u: ArrayLike, v: ArrayLike, constants: Constants, out: Triple | None = None
) -> Triple:
    """Loads m, n and stiffness d(m, n)/d(u, v) at the strains u, v.

    u (3, ...) in 1/length, v (3, ...) plain, with Q < 1 (eq:strainlimiting).
    Answers m (3, ...) in force times length, n (3, ...) in force,
    and the stiffness (6, 6, ...).
    Rows and columns are ordered (m1, m2, m3, n1, n2, n3) and (u1, u2, u3, v1, v2, v3).
    """
    m, n, stiff = _apply(
        _loads_and_stiffness_over, {"u": u, "v": v}, constants, ("m", "n", "stiff"), out
    )
    return m, n, stiff


def compliance(m: ArrayLike, n: ArrayLike, constants: Constants, out: Array | None = None) -> Array:
    """Compliance d(u, v)/d(m, n), (6, 6, ...), the inverse of the stiffness at these loads.

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Rows and columns are ordered (u1, u2, u3, v1, v2, v3) and (m1, m2, m3, n1, n2, n3).
    """
    (soft,) = _apply(_compliance_over, {"m": m, "n": n}, constants, ("soft",), out)
    return soft


def strains_and_gap(
    m: ArrayLike, n: ArrayLike, constants: Constants, out: Triple | None = None
) -> Triple:
    """Strains u, v under the loads m, n, and 1 - Q^(p/2).

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Answers u (3, ...) in 1/length, v (3, ...) plain, and the gap (...) plain:
    near the limit it says what the strains no longer can.
    """
    u, v, limit_gap = _apply(
        _strains_and_gap_over, {"m": m, "n": n}, constants, ("u", "v", "limit_gap"), out
    )
    return u, v, limit_gap


def stiffness_at_loads(
    m: ArrayLike, n: ArrayLike, constants: Constants, out: Array | None = None
) -> Array:
    """Stiffness d(m, n)/d(u, v), (6, 6, ...), at the strains of these loads.

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Rows and columns are ordered (m1, m2, m3, n1, n2, n3) and (u1, u2, u3, v1, v2, v3).
    The inverse of the compliance; it holds where strains no longer tell the loads.
    """
    (stiff,) = _apply(_stiffness_at_loads_over, {"m": m, "n": n}, constants, ("stiff",), out)
    return stiff
