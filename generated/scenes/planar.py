"""Bending, shear and stretch in the plane of d1 and d3.

Scene planar, made by: rodproof generate planar

Constraints: planar; u1 = 0, u3 = 0, v2 = 0; m1, m3, n2 must be zero; iota = 0.

Statements it rests on (paper label, verdict; as corrected if refuted): qstar-form Section 3.1
refuted; const-u-mu eq:uconst proved; const-v-mu eq:vconst proved; const-v-3 eq:v3const proved;
q-form eq:quadraticform definition; strain-limit eq:strainlimiting proved; const-m-mu eq:mconst
proved; const-n-mu eq:nconst proved; const-n-3 eq:n3const proved; w-definition eq:stenergy proved;
wstar-definition eq:compenergy proved; hess-m-u reading; hess-m-v reading; hess-m-v3 reading;
hess-n-v reading; hess-n-v3 reading; hess-n3-v3 reading; wstar-gradient Section 3.1 proved.

Domain: loads with finite Q*^(1/2); strains with Q < 1, else an error.

One point: tuples of numbers (a float for a single component) are answered with tuples of floats,
in plain Python, where nothing is extreme. They agree with the arrays' answers within 8 ulps of
the largest component, or as far as the inputs determine what grows near the limit.

Operations a point where nothing is extreme: arithmetic, transcendental, energy shares, temporaries
    strains                17    4    0    6
    loads                  18    4    0    7
    stored_energy          20    4    1    9
    complementary_energy   28    6    1   10
    stiffness              40    4    0   10
    loads_and_stiffness    43    4    0   10
    compliance             64    4    0   22
    strains_and_gap        19    4    0    6
    stiffness_at_loads     37    4    0   12
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import exp, expm1, log, log1p, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
Pair = tuple[Array, Array]
Triple = tuple[Array, Array, Array]
Rows = Sequence[Array]
Given = ArrayLike | tuple[Any, ...]  # arrays and their like; one point
Inputs = dict[str, Given]

BLOCK = 16384  # at most so many points are worked on at a time, so that rows stay in cache
LINE = 64  # bytes of a cache line
KEPT = threading.local()  # scratch, from call to call
TINY = {np.dtype(t): float(np.finfo(t).tiny) for t in (np.float32, np.float64)}
LOG_MAX = {t: -0.99 * math.log(TINY[t]) for t in TINY}  # exp of it is near the largest number
LEAST = 2.0**-1022  # the smallest normal number, for one point
LOG_MOST = 0.99 * 1022 * math.log(2)  # its exponential is near the largest number
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
NOUGHT = 2.0**-700  # stands for a square at rest: its inverse is a number
DOUBLE = np.dtype(np.float64)
HEADS = {
    "m2": (), "n": (2,), "u2": (), "v": (2,), "w": (), "w_star": (), "stiff": (3, 3),
    "soft": (3, 3), "limit_gap": (),
}


@dataclass(frozen=True)
class Constants:
    """The five constants of the rod, checked on construction (ValueError).

    alpha is a length, gamma is a force, zeta, eta and p are plain numbers; all are positive.
    """

    alpha: float
    zeta: float
    eta: float
    gamma: float
    p: float
    per_alpha: float = field(init=False, repr=False, compare=False)
    per_zeta: float = field(init=False, repr=False, compare=False)
    per_eta: float = field(init=False, repr=False, compare=False)
    per_p: float = field(init=False, repr=False, compare=False)
    per_gamma: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("alpha", "zeta", "eta", "gamma", "p"):
            value = float(getattr(self, name))
            if not 0 < value < math.inf:
                raise ValueError(f"Constants: {name} must be positive and finite, not {value}")
            object.__setattr__(self, name, value)
        exact = (Fraction(v) for v in (self.alpha, self.zeta, self.eta, self.gamma, self.p))
        alpha, zeta, eta, gamma, p = exact
        derived = {
            "per_alpha": 1 / alpha,
            "per_zeta": 1 / zeta,
            "per_eta": 1 / eta,
            "per_p": 1 / p,
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
    def of_stored_energy(self) -> tuple[float, ...]:
        """What `stored_energy` of one point takes."""
        return (self.alpha, self.zeta, self.eta, -0.5 * self.p, self.gamma, self.per_p)

    @cached_property
    def of_complementary_energy(self) -> tuple[float, ...]:
        """What `complementary_energy` of one point takes."""
        return (self.per_alpha, self.per_zeta, self.per_eta, self.gamma, self.p, -self.per_p)

    @cached_property
    def of_compliance(self) -> tuple[float, ...]:
        """What `compliance` of one point takes."""
        return (
            self.per_alpha, self.per_zeta, self.per_eta, self.gamma, self.p, -self.per_p,
            self.per_alpha**2, self.per_zeta**2, self.per_eta**2,
        )


class Plain:
    """What the plain bodies take, each number rounded once, and the squares where they hold."""

    def __init__(self, c: Constants) -> None:
        alpha, gamma, zeta, eta, p = (Fraction(v) for v in (c.alpha, c.gamma, c.zeta, c.eta, c.p))
        self.bend_soft = _rounded(1 / alpha**2 / gamma)
        self.shear_soft = _rounded(1 / gamma / zeta**2)
        self.n3_extends = _rounded(1 / eta**2 / gamma)
        self.per_gamma = _rounded(1 / gamma)
        self.per_p = _rounded(1 / p)
        self.bending = _rounded(alpha**2)
        self.shearing = _rounded(zeta**2)
        self.slack = _rounded(eta**2)
        self.stretching = _rounded(eta**2)
        used = [v for v in (c.gamma, *vars(self).values()) if v]
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
        self.of_strains = (
            self.bend_soft, self.shear_soft, self.n3_extends, self.per_gamma, 0.5 * c.p,
            -self.per_p, *self.room[DOUBLE],
        )
        self.of_loads = (
            self.bending, self.shearing, self.slack, 0.5 * c.p, c.gamma, -self.per_p,
            *self.room[DOUBLE],
        )
        self.of_loads_and_stiffness = (
            self.bending, self.shearing, self.slack, 0.5 * c.p, c.gamma, -self.per_p,
            self.stretching, *self.room[DOUBLE],
        )
        self.of_strains_and_gap = self.of_strains
        self.of_stiffness_at_loads = (
            self.bend_soft, self.shear_soft, self.n3_extends, self.per_gamma, 0.5 * c.p, c.gamma,
            self.per_p, self.bending, self.shearing, self.stretching, *self.room[DOUBLE],
        )


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan


def _reduce_loads(loads: Rows, c: Constants) -> Rows:
    """Loads over their moduli, and Q* in squares."""
    m2, n1, n3 = loads
    mu_2, nu_1, nu_3 = c.per_alpha * m2, c.per_zeta * n1, c.per_eta * n3
    q_star = mu_2**2 + nu_1**2 + nu_3**2
    return mu_2, nu_1, nu_3, q_star


def _soften(y: Array, c: Constants) -> Rows:
    """Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."""
    tiny = TINY[y.dtype]
    larger = np.maximum(y, c.gamma)
    ratio = np.maximum(np.minimum(y, c.gamma) / larger, tiny)
    power = np.exp(c.p * np.log(ratio))
    factor = np.exp(-c.per_p * np.log1p(power)) / larger
    return ratio, power, factor


def _reduce_strains(rest: Rows, c: Constants) -> Rows:
    """Strains times their moduli, and Q in squares."""
    u2, v1, stretch = rest
    kappa_2, lam_1, lam_3 = c.alpha * u2, c.zeta * v1, c.eta * stretch
    q = kappa_2**2 + lam_1**2 + lam_3**2
    return kappa_2, lam_1, lam_3, q


def _stiffen(q: Array, c: Constants) -> Rows:
    """Load over strain, gamma (1 - x^p)^(-1/p), by the growth x^p/(1 - x^p), x^2 = Q."""
    log_max = LOG_MAX[q.dtype]
    tiny = TINY[q.dtype]
    growth = 1 / np.expm1(np.minimum(-0.5 * c.p * np.log(np.maximum(q, tiny)), log_max))
    depth = np.log1p(growth)
    factor = c.gamma * np.exp(c.per_p * depth)
    return growth, depth, factor


def _harden(y: Array, c: Constants) -> Rows:
    """Load over strain, (gamma^p + y^p)^(1/p), after its rise (y/gamma)^(p/2)."""
    tiny = TINY[y.dtype]
    rise = np.exp(0.5 * c.p * np.log(np.maximum(c.per_gamma * y, tiny)))
    half = np.minimum(rise, 1 / np.maximum(rise, tiny))
    power = half**2
    factor = np.exp(c.per_p * np.log1p(power)) * np.maximum(y, c.gamma)
    return rise, factor


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


def _work_share_at(depth: float, c: Constants) -> float:
    """`_work_share` of one point."""
    fraction, powers, start, slope, single = c.work_share
    beyond = depth - log(9)
    if beyond <= 0:
        growth, value = expm1(depth), 1.0
        for term in reversed(fraction):
            value = growth / value * term + 1
        return 0.5 / value
    left, rest = exp(-beyond), 0.0
    for coefficient in reversed(powers):
        rest = rest * left + coefficient
    turns = -expm1(min(-slope * beyond, 80)) / slope if slope else beyond
    inner = exp(-beyond / c.p) * (start + single * turns) - left * rest
    return inner * exp(-2 / c.p * log1p(-left / 9))


class _PastLimit(Exception):
    """Some strains have Q >= 1."""


def _within_limit(q: Array) -> Array:
    """Q where all of it is below the limit."""
    if not q.max() < 1:
        raise _PastLimit
    return q


def _past_limit(strains: Rows, c: Constants, shape: tuple[int, ...]) -> ValueError:
    """The error for strains at or past the limit: how many points, the first and its Q."""
    rest = [*strains[:2], strains[2] - 1]
    with np.errstate(over="ignore", invalid="ignore"):
        *_, q = _reduce_strains(rest, c)
    bad = np.flatnonzero(~(q < 1))
    index = tuple(map(int, np.unravel_index(bad[0], shape)))
    first = f"the first at index {index} with Q = {float(q[bad[0]])!r}"
    return ValueError(f"strains must satisfy Q(u, v) < 1: {bad.size} of {q.size} do not, {first}")


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
    body: Callable[..., None], inputs: Inputs, c: Constants, names: Sequence[str], out: Any
) -> list[Array]:
    """Runs ``body`` over blocks of points, straight into the results where that is safe."""
    if out is not None and all(type(value) is tuple for value in inputs.values()):
        raise ValueError("out is for arrays; tuples of numbers are answered with new tuples")
    arrays, shape = _arguments(inputs)
    results = _results(names, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    direct = out is None or all(
        r.flags.c_contiguous and not any(np.may_share_memory(r, a) for a in arrays) for r in results
    )
    given = arrays
    flat = results if direct else [_fresh(r.shape, r.dtype) for r in results]
    if len(shape) != 1:
        given = [a.reshape(*HEADS[name], points) for name, a in zip(inputs, given, strict=True)]
        flat = [r.reshape(*HEADS[name], points) for name, r in zip(names, flat, strict=True)]
    blocks = max(1, -(-points // BLOCK))
    size = max(1, -(-points // blocks // LINE)) * LINE  # blocks of one length, whole cache lines
    with np.errstate(under="ignore"):
        for start in range(0, points, size):
            part = slice(start, min(start + size, points))
            block = [a[..., part] for a in given]
            try:
                body(*block, c, *(array[..., part] for array in flat))
            except _PastLimit:
                rows = [row for a in given for row in np.atleast_2d(a)]
                raise _past_limit(rows, c, shape) from None
    if not direct:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results


class _Extreme(ArithmeticError):
    """A point that plain Python leaves to arrays."""


def _one(law: Callable[..., Any], inputs: Inputs, c: Constants) -> Any:
    """``law`` of one point by way of arrays, or again in floats if it was given other numbers."""
    try:
        arrays, shape = _arguments(inputs)
    except ValueError as wrong:
        raise wrong from None
    if shape:  # tuples of arrays
        return law(*map(np.asarray, inputs.values()), c)
    floats = [a.astype(float).tolist() for a in arrays]
    again = tuple(tuple(f) if isinstance(f, list) else f for f in floats)
    if repr(again) != repr((*inputs.values(),)):
        return law(*again, c)
    answer = law(*map(np.array, floats), c)
    if not isinstance(answer, tuple):
        return _numbers(answer)
    return tuple(_numbers(array) for array in answer)


def _numbers(array: Array) -> Any:
    """The array as a float, a tuple of floats, or a tuple of rows."""
    values = array.astype(float).tolist()
    if array.ndim == 2:
        return tuple(map(tuple, values))
    return tuple(values) if array.ndim else values


def _scratch(count: int, like: Array) -> Array:
    """Rows of scratch, kept by each thread: fresh memory costs more than the work on it.

    Short ones follow each other, to be worked on as one; of long ones NumPy would make copies.
    """
    points = like.shape[-1]
    length = points if points < 512 else (points // LINE + 1) * LINE
    needed = count * length * like.itemsize
    memory = getattr(KEPT, "memory", None)
    if memory is None or len(memory) < needed:
        memory = KEPT.memory = _fresh((needed,), np.uint8)
    rows: Array = memory[:needed].view(like.dtype).reshape(count, length)
    return rows[:, :points]


def _inside(square: Array, within: dict[Any, tuple[float, float]]) -> bool:
    """Whether all of it lies between the bounds for its type; nan does not."""
    low, high = within[square.dtype]
    return bool(low < square[square.argmin()] and square[square.argmax()] < high)


def _overload(m2: Array, n: Array, c: Constants, u2: Array, v: Array, s: Array) -> Array:
    """Q*/gamma^2 as a sum of squares; the linear rod's strains over gamma in u2 and v."""
    k = c.plain
    x = s[:2]
    np.multiply(k.bend_soft, m2, out=u2)
    np.multiply(k.shear_soft, n[0], out=v[0])
    np.multiply(k.n3_extends, n[1], out=v[1])
    overload: Array = np.multiply(m2, u2, out=s[2])
    np.multiply(n, v, out=x)
    overload += x[0]
    overload += x[1]
    overload *= k.per_gamma
    return overload


def _q(u2: Array, v: Array, c: Constants, m2: Array, n: Array, s: Array) -> Array:
    """Q as a sum of squares; the linear rod's loads over gamma in m2 and n."""
    k = c.plain
    stretch = np.subtract(v[1], 1, out=s[0])
    np.multiply(k.bending, u2, out=m2)
    np.multiply(k.shearing, v[0], out=n[0])
    np.multiply(k.slack, stretch, out=n[1])
    q: Array = np.multiply(m2, u2, out=s[1])
    q += np.multiply(n[0], v[0], out=s[2])
    q += np.multiply(stretch, n[1], out=s[0])
    return q


def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, a row and its mirror image at a time."""
    for i, row in enumerate(vector):
        np.multiply(weight * row, vector[i:], out=matrix[i, i:])
        matrix[i + 1 :, i] = matrix[i, i + 1 :]


def _strains_plain(m2: Array, n: Array, c: Constants, u2: Array, v: Array) -> bool:
    """`_strains` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(3, m2)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m2, n, c, u2, v, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[2])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[2])
    root *= -k.per_p
    np.exp(root, out=root)
    u2 *= root
    v *= root
    v[1] += 1
    return True


def _strains(m2: Array, n: Array, c: Constants, u2: Array, v: Array) -> None:
    """(u2, v1, v3 - 1) = (gamma^p + Q*^(p/2))^(-1/p) K^-1 (m2, n1, n3)."""
    if _strains_plain(m2, n, c, u2, v):
        return
    loads = [m2, *n]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    mu_2, nu_1, nu_3 = values
    *_, factor = _soften(y, c)
    reach = factor * unscale
    bend, shear, extend = c.per_alpha * reach, c.per_zeta * reach, c.per_eta * reach
    u2[...] = bend * mu_2
    v[0] = nu_1 * shear
    v[1] = extend * nu_3 + 1


def _strains_at(m2: Any, n: Any, c: Constants) -> Any:
    """`strains` of floats, where nothing is extreme."""
    (
        bend_soft, shear_soft, n3_extends, per_gamma, half_p, minus_per_p, low, high,
    ) = c.plain.of_strains
    n1, n3 = n
    w2, w4, extension = bend_soft * m2, shear_soft * n1, n3_extends * n3
    overload = per_gamma * (extension * n3 + m2 * w2 + n1 * w4)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m2, n1, n3)))
    ):
        raise _Extreme
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return root * w2, (root * w4, extension * root + 1)


def strains(m2: Given | float, n: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Strains u2, v under the loads m2, n (eq:uconst to eq:v3const).

    m2 (...) in force times length, n (2, ...) in force (n1 and n3), with Q*^(1/2) finite.
    Answers u2 (...) in 1/length, v (2, ...) plain (v1 and v3); at rest u2 = 0, v = (0, 1).
    """
    if out is None and type(n) is tuple and type(m2) is float:
        try:
            answer: Pair = _strains_at(m2, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains, {"m2": m2, "n": n}, constants)
        return answer
    u2, v = _apply(_strains, {"m2": m2, "n": n}, constants, ("u2", "v"), out)
    return u2, v


def _loads_plain(u2: Array, v: Array, c: Constants, m2: Array, n: Array) -> bool:
    """`_loads` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(3, u2)
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u2, v, c, m2, n, s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[1])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[1])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    m2 *= hard
    n *= hard
    return True


def _loads(u2: Array, v: Array, c: Constants, m2: Array, n: Array) -> None:
    """(m2, n1, n3) = gamma (1 - Q^(p/2))^(-1/p) K (u2, v1, v3 - 1)."""
    if _loads_plain(u2, v, c, m2, n):
        return
    strains = [u2, *v]
    rest = [*strains[:2], strains[2] - 1]
    values, _, unscale, q = _rescaled(_reduce_strains, rest, c)
    kappa_2, lam_1, lam_3 = values
    q = _within_limit(q)
    *_, factor = _stiffen(q, c)
    secant = factor * unscale
    bend, shear, extend = c.alpha * secant, c.zeta * secant, c.eta * secant
    m2[...] = bend * kappa_2
    n[0], n[1] = lam_1 * shear, extend * lam_3


def _loads_at(u2: Any, v: Any, c: Constants) -> Any:
    """`loads` of floats, where nothing is extreme."""
    bending, shearing, slack, half_p, gamma, minus_per_p, low, high = c.plain.of_loads
    v1, v3 = v
    stretch = v3 - 1
    r2, r4, tension = bending * u2, shearing * v1, slack * stretch
    q = r2 * u2 + r4 * v1 + stretch * tension
    if type(q) is not float or (not low < q < 1 and (q or low > high or any((u2, v1, stretch)))):
        raise _Extreme
    q = q or NOUGHT
    left = -expm1(half_p * log(q))
    hard = gamma * left**minus_per_p
    return hard * r2, (hard * r4, hard * tension)


def loads(u2: Given | float, v: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Loads m2, n at the strains u2, v (eq:mconst to eq:n3const).

    u2 (...) in 1/length, v (2, ...) plain (v1 and v3), with Q < 1 (eq:strainlimiting).
    Answers m2 (...) in force times length, n (2, ...) in force (n1 and n3).
    Near the limit the strains hardly determine the loads.
    """
    if out is None and type(v) is tuple and type(u2) is float:
        try:
            answer: Pair = _loads_at(u2, v, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(loads, {"u2": u2, "v": v}, constants)
        return answer
    m2, n = _apply(_loads, {"u2": u2, "v": v}, constants, ("m2", "n"), out)
    return m2, n


def _stored_energy(u2: Array, v: Array, c: Constants, w: Array) -> None:
    """W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of the work."""
    strains = [u2, *v]
    rest = [*strains[:2], strains[2] - 1]
    _, _, x, _, q = _balanced(_reduce_strains, rest, c)
    q = _within_limit(q)
    _, depth, factor = _stiffen(q, c)
    load = factor * x
    w[...] = load * x * _work_share(depth, c)


def _stored_energy_at(u2: Any, v: Any, c: Constants) -> Any:
    """`stored_energy` of floats, where nothing is extreme."""
    alpha, zeta, eta, minus_half_p, gamma, per_p = c.of_stored_energy
    v1, v3 = v
    stretch = v3 - 1
    kappa_2, lam_1, lam_3 = alpha * u2, zeta * v1, eta * stretch
    q = kappa_2 * kappa_2 + lam_1 * lam_1 + lam_3 * lam_3
    if type(q) is not float or (not LOW < q < 1 and any((u2, v1, stretch))):
        raise _Extreme
    x = sqrt(q)
    raw_1 = minus_half_p * log(q if q > LEAST else LEAST)
    growth = 1 / expm1(raw_1 if raw_1 < LOG_MOST else LOG_MOST)
    depth = log1p(growth)
    factor = gamma * exp(per_p * depth)
    load = factor * x
    return load * x * _work_share_at(depth, c)


def stored_energy(
    u2: Given | float, v: Given, constants: Constants, out: Array | None = None
) -> Array:
    """Stored energy W per length, in force (eq:stenergy), with the trailing shape.

    u2 (...) in 1/length, v (2, ...) plain (v1 and v3), with Q < 1 (eq:strainlimiting).
    """
    if out is None and type(v) is tuple and type(u2) is float:
        try:
            answer: Array = _stored_energy_at(u2, v, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stored_energy, {"u2": u2, "v": v}, constants)
        return answer
    (w,) = _apply(_stored_energy, {"u2": u2, "v": v}, constants, ("w",), out)
    return w


def _complementary_energy(m2: Array, n: Array, c: Constants, w_star: Array) -> None:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."""
    loads = [m2, *n]
    _, _, y, _, _ = _balanced(_reduce_loads, loads, c)
    ratio, power, factor = _soften(y, c)
    strain = factor * y
    depth = np.log1p(power) - c.p * np.where(y <= c.gamma, 0.0, np.log(ratio))
    w_star[...] = strain * y * (1 - _work_share(depth, c))


def _complementary_energy_at(m2: Any, n: Any, c: Constants) -> Any:
    """`complementary_energy` of floats, where nothing is extreme."""
    per_alpha, per_zeta, per_eta, gamma, p, minus_per_p = c.of_complementary_energy
    n1, n3 = n
    mu_2, nu_1, nu_3 = per_alpha * m2, per_zeta * n1, per_eta * n3
    q_star = mu_2 * mu_2 + nu_1 * nu_1 + nu_3 * nu_3
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((m2, n1, n3))):
        raise _Extreme
    y = sqrt(q_star)
    larger = y if y > gamma else gamma
    raw_1 = (y if y < gamma else gamma) / larger
    ratio = raw_1 if raw_1 > LEAST else LEAST
    power = ratio**p
    factor = exp(minus_per_p * log1p(power)) / larger
    strain = factor * y
    depth = log1p(power) - p * (0.0 if y <= gamma else log(ratio))
    return strain * y * (1 - _work_share_at(depth, c))


def complementary_energy(
    m2: Given | float, n: Given, constants: Constants, out: Array | None = None
) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    m2 (...) in force times length, n (2, ...) in force (n1 and n3), with Q*^(1/2) finite.
    """
    if out is None and type(n) is tuple and type(m2) is float:
        try:
            answer: Array = _complementary_energy_at(m2, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(complementary_energy, {"m2": m2, "n": n}, constants)
        return answer
    (w_star,) = _apply(_complementary_energy, {"m2": m2, "n": n}, constants, ("w_star",), out)
    return w_star


def _stiffness_plain(u2: Array, v: Array, c: Constants, stiff: Array) -> bool:
    """`_stiffness` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(7, u2)
    w, s = s[:3], s[3:]
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u2, v, c, w[0], w[1:], s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[0])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[2])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    steep = np.subtract(1, left, out=s[3])
    steep *= hard
    steep /= left
    steep /= q
    _spread(stiff, steep, w)
    bend = np.multiply(k.bending, hard, out=s[3])
    stiff[0, 0] += bend
    shear = np.multiply(k.shearing, hard, out=s[3])
    stiff[1, 1] += shear
    stiff[2, 2] += np.multiply(k.stretching, hard, out=s[2])
    return True


def _stiffness(u2: Array, v: Array, c: Constants, stiff: Array) -> None:
    """D^2 W = factor (K + growth t t^T), t = K (u2, v1, v3 - 1)/x."""
    if _stiffness_plain(u2, v, c, stiff):
        return
    strains = [u2, *v]
    rest = [*strains[:2], strains[2] - 1]
    with np.errstate(over="ignore", invalid="ignore"):
        kappa_2, lam_1, lam_3, q = _reduce_strains(rest, c)
    q = _within_limit(q)
    growth, _, factor = _stiffen(q, c)
    tiny = TINY[q.dtype]
    t = np.empty_like(stiff[0])
    steep = factor * growth
    x = np.sqrt(np.maximum(q, tiny))
    per_x = 1 / x
    bend_per_x, shear_per_x, extend_per_x = c.alpha * per_x, c.zeta * per_x, c.eta * per_x
    t[0], t[1], t[2] = bend_per_x * kappa_2, lam_1 * shear_per_x, extend_per_x * lam_3
    _spread(stiff, steep, t)
    stiff[0, 0] += c.alpha**2 * factor
    stiff[1, 1] += c.zeta**2 * factor
    stiff[2, 2] += c.eta**2 * factor


def _stiffness_at(u2: Any, v: Any, c: Constants) -> Any:
    """`stiffness` of floats, where nothing is extreme."""
    return _loads_and_stiffness_at(u2, v, c)[-1]


def stiffness(u2: Given | float, v: Given, constants: Constants, out: Array | None = None) -> Array:
    """Stiffness d(m2, n)/d(u2, v), (3, 3, ...), symmetric positive definite (Section 3.4).

    u2 (...) in 1/length, v (2, ...) plain (v1 and v3), with Q < 1 (eq:strainlimiting).
    Rows and columns are ordered (m2, n1, n3) and (u2, v1, v3).
    """
    if out is None and type(v) is tuple and type(u2) is float:
        try:
            answer: Array = _stiffness_at(u2, v, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stiffness, {"u2": u2, "v": v}, constants)
        return answer
    (stiff,) = _apply(_stiffness, {"u2": u2, "v": v}, constants, ("stiff",), out)
    return stiff


def _loads_and_stiffness_plain(
    u2: Array, v: Array, c: Constants, m2: Array, n: Array, stiff: Array
) -> bool:
    """`_loads_and_stiffness` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(7, u2)
    w, s = s[:3], s[3:]
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u2, v, c, w[0], w[1:], s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[0])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[2])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    np.multiply(hard, w[0], out=m2)
    np.multiply(hard, w[1:], out=n)
    steep = np.subtract(1, left, out=s[3])
    steep *= hard
    steep /= left
    steep /= q
    _spread(stiff, steep, w)
    bend = np.multiply(k.bending, hard, out=s[3])
    stiff[0, 0] += bend
    shear = np.multiply(k.shearing, hard, out=s[3])
    stiff[1, 1] += shear
    stiff[2, 2] += np.multiply(k.stretching, hard, out=s[2])
    return True


def _loads_and_stiffness(
    u2: Array, v: Array, c: Constants, m2: Array, n: Array, stiff: Array
) -> None:
    """(m2, n1, n3) = factor K (u2, v1, v3 - 1) and D^2 W = factor (K + growth t t^T), as apart."""
    if _loads_and_stiffness_plain(u2, v, c, m2, n, stiff):
        return
    strains = [u2, *v]
    rest = [*strains[:2], strains[2] - 1]
    values, size, _, unscale, q = _balanced(_reduce_strains, rest, c)
    kappa_2, lam_1, lam_3 = values
    q = _within_limit(q)
    growth, _, factor = _stiffen(q, c)
    tiny = TINY[q.dtype]
    t = np.empty_like(stiff[0])
    steep, secant = factor * growth, factor * unscale
    per_size = 1 / np.maximum(size, np.sqrt(tiny))
    bend_per_size, shear_per_size = c.alpha * per_size, c.zeta * per_size
    extend_per_size, bend, shear = c.eta * per_size, c.alpha * secant, c.zeta * secant
    extend = c.eta * secant
    t[0], t[1], t[2] = bend_per_size * kappa_2, lam_1 * shear_per_size, extend_per_size * lam_3
    m2[...] = bend * kappa_2
    n[0], n[1] = lam_1 * shear, extend * lam_3
    _spread(stiff, steep, t)
    stiff[0, 0] += c.alpha**2 * factor
    stiff[1, 1] += c.zeta**2 * factor
    stiff[2, 2] += c.eta**2 * factor


def _loads_and_stiffness_at(u2: Any, v: Any, c: Constants) -> Any:
    """`loads_and_stiffness` of floats, where nothing is extreme."""
    (
        bending, shearing, slack, half_p, gamma, minus_per_p, stretching, low, high,
    ) = c.plain.of_loads_and_stiffness
    v1, v3 = v
    stretch = v3 - 1
    r2, r4, tension = bending * u2, shearing * v1, slack * stretch
    q = r2 * u2 + r4 * v1 + stretch * tension
    if type(q) is not float or (not low < q < 1 and (q or low > high or any((u2, v1, stretch)))):
        raise _Extreme
    q = q or NOUGHT
    left = -expm1(half_p * log(q))
    hard = gamma * left**minus_per_p
    steep = hard * (1 - left) / left / q
    bend, shear, steep_1 = bending * hard, shearing * hard, r2 * steep
    steep_2, steep_3 = r4 * steep, steep * tension
    k11, k12, k13 = bend + r2 * steep_1, r4 * steep_1, steep_1 * tension
    k22, k23 = r4 * steep_2 + shear, steep_2 * tension
    k33 = stretching * hard + steep_3 * tension
    stiff = (
        (k11, k12, k13),
        (k12, k22, k23),
        (k13, k23, k33),
    )
    return hard * r2, (hard * r4, hard * tension), stiff


def loads_and_stiffness(
    u2: Given | float, v: Given, constants: Constants, out: Triple | None = None
) -> Triple:
    """Loads m2, n and stiffness d(m2, n)/d(u2, v) at the strains u2, v.

    u2 (...) in 1/length, v (2, ...) plain (v1 and v3), with Q < 1 (eq:strainlimiting).
    Answers m2 (...) in force times length, n (2, ...) in force (n1 and n3),
    and the stiffness (3, 3, ...).
    Rows and columns are ordered (m2, n1, n3) and (u2, v1, v3).
    """
    if out is None and type(v) is tuple and type(u2) is float:
        try:
            answer: Triple = _loads_and_stiffness_at(u2, v, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(loads_and_stiffness, {"u2": u2, "v": v}, constants)
        return answer
    m2, n, stiff = _apply(
        _loads_and_stiffness, {"u2": u2, "v": v}, constants, ("m2", "n", "stiff"), out
    )
    return m2, n, stiff


def _compliance(m2: Array, n: Array, c: Constants, soft: Array) -> None:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 (m2, n1, n3)/y.

    With (a, b) the reduced load as a unit vector,
    the entries that would cancel are sums of squares.
    """
    loads = [m2, *n]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    mu_2, nu_1, nu_3 = values
    _, power, factor = _soften(y, c)
    tiny = TINY[y.dtype]
    d = np.empty_like(soft[0])
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    per_size = 1 / size
    a2, share = per_size * (mu_2 + tiny), np.where(y <= c.gamma, power, 1.0) / (power + 1)
    aa2 = a2**2
    b1, b3 = nu_1 * per_size, nu_3 * per_size
    bb1, bb3 = b1**2, b3**2
    across = aa2 + bb1
    steep = -factor * share
    d[0], d[1], d[2] = c.per_alpha * a2, c.per_zeta * b1, c.per_eta * b3
    _spread(soft, steep, d)
    soft[0, 0] = c.per_alpha**2 * factor * (aa2 * remain + bb1 + bb3)
    soft[1, 1] = c.per_zeta**2 * factor * (aa2 + bb1 * remain + bb3)
    soft[2, 2] = c.per_eta**2 * factor * (across + bb3 * remain)


def _compliance_at(m2: Any, n: Any, c: Constants) -> Any:
    """`compliance` of floats, where nothing is extreme."""
    (
        per_alpha, per_zeta, per_eta, gamma, p, minus_per_p, per_alpha_squared, per_zeta_squared,
        per_eta_squared,
    ) = c.of_compliance
    n1, n3 = n
    mu_2, nu_1, nu_3 = per_alpha * m2, per_zeta * n1, per_eta * n3
    q_star = mu_2 * mu_2 + nu_1 * nu_1 + nu_3 * nu_3
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((m2, n1, n3))):
        raise _Extreme
    y = sqrt(q_star)
    larger = y if y > gamma else gamma
    raw_1 = (y if y < gamma else gamma) / larger
    ratio = raw_1 if raw_1 > LEAST else LEAST
    power = ratio**p
    factor = exp(minus_per_p * log1p(power)) / larger
    remain = (1.0 if y <= gamma else power) / (power + 1)
    per_size = 1 / (y if y > LEAST else LEAST)
    a2, share = per_size * (mu_2 + LEAST), (power if y <= gamma else 1.0) / (power + 1)
    aa2 = a2 * a2
    b1, b3, d2 = nu_1 * per_size, nu_3 * per_size, per_alpha * a2
    bb1, bb3 = b1 * b1, b3 * b3
    across = aa2 + bb1
    steep = -factor * share
    d4, d6, steep_1 = per_zeta * b1, per_eta * b3, d2 * steep
    steep_2 = d4 * steep
    s11, s12 = per_alpha_squared * factor * (aa2 * remain + bb1 + bb3), d4 * steep_1
    s13 = d6 * steep_1
    s22, s23 = per_zeta_squared * factor * (aa2 + bb1 * remain + bb3), d6 * steep_2
    s33 = per_eta_squared * factor * (across + bb3 * remain)
    return (
        (s11, s12, s13),
        (s12, s22, s23),
        (s13, s23, s33),
    )


def compliance(
    m2: Given | float, n: Given, constants: Constants, out: Array | None = None
) -> Array:
    """Compliance d(u2, v)/d(m2, n), (3, 3, ...), the inverse of the stiffness at these loads.

    m2 (...) in force times length, n (2, ...) in force (n1 and n3), with Q*^(1/2) finite.
    Rows and columns are ordered (u2, v1, v3) and (m2, n1, n3).
    """
    if out is None and type(n) is tuple and type(m2) is float:
        try:
            answer: Array = _compliance_at(m2, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(compliance, {"m2": m2, "n": n}, constants)
        return answer
    (soft,) = _apply(_compliance, {"m2": m2, "n": n}, constants, ("soft",), out)
    return soft


def _strains_and_gap_plain(
    m2: Array, n: Array, c: Constants, u2: Array, v: Array, limit_gap: Array
) -> bool:
    """`_strains_and_gap` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(3, m2)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m2, n, c, u2, v, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[2])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[0])
    root *= -k.per_p
    np.exp(root, out=root)
    u2 *= root
    v *= root
    v[1] += 1
    np.add(excess, 1, out=limit_gap)
    np.divide(1, limit_gap, out=limit_gap)
    return True


def _strains_and_gap(
    m2: Array, n: Array, c: Constants, u2: Array, v: Array, limit_gap: Array
) -> None:
    """The strains, and 1 - Q^(p/2) = gamma^p/(gamma^p + Q*^(p/2))."""
    if _strains_and_gap_plain(m2, n, c, u2, v, limit_gap):
        return
    loads = [m2, *n]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    mu_2, nu_1, nu_3 = values
    _, power, factor = _soften(y, c)
    reach = factor * unscale
    bend, shear, extend = c.per_alpha * reach, c.per_zeta * reach, c.per_eta * reach
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    u2[...] = bend * mu_2
    v[0] = nu_1 * shear
    v[1] = extend * nu_3 + 1
    limit_gap[...] = remain


def _strains_and_gap_at(m2: Any, n: Any, c: Constants) -> Any:
    """`strains_and_gap` of floats, where nothing is extreme."""
    (
        bend_soft, shear_soft, n3_extends, per_gamma, half_p, minus_per_p, low, high,
    ) = c.plain.of_strains_and_gap
    n1, n3 = n
    w2, w4, extension = bend_soft * m2, shear_soft * n1, n3_extends * n3
    overload = per_gamma * (extension * n3 + m2 * w2 + n1 * w4)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m2, n1, n3)))
    ):
        raise _Extreme
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return root * w2, (root * w4, extension * root + 1), 1 / (excess + 1)


def strains_and_gap(
    m2: Given | float, n: Given, constants: Constants, out: Triple | None = None
) -> Triple:
    """Strains u2, v under the loads m2, n, and 1 - Q^(p/2).

    m2 (...) in force times length, n (2, ...) in force (n1 and n3), with Q*^(1/2) finite.
    Answers u2 (...) in 1/length, v (2, ...) plain (v1 and v3), and the gap (...) plain:
    near the limit it says what the strains no longer can.
    """
    if out is None and type(n) is tuple and type(m2) is float:
        try:
            answer: Triple = _strains_and_gap_at(m2, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains_and_gap, {"m2": m2, "n": n}, constants)
        return answer
    u2, v, limit_gap = _apply(
        _strains_and_gap, {"m2": m2, "n": n}, constants, ("u2", "v", "limit_gap"), out
    )
    return u2, v, limit_gap


def _stiffness_at_loads_plain(m2: Array, n: Array, c: Constants, stiff: Array) -> bool:
    """`_stiffness_at_loads` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(9, m2)
    w, s = s[:3], s[3:]
    h = s[3:6]
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m2, n, c, w[0], w[1:], s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[0])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    hard = np.log1p(excess, out=s[1])
    hard *= k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    lift = np.multiply(excess, hard, out=s[0])
    lift /= overload
    np.multiply(k.per_gamma, m2, out=h[0])
    np.multiply(k.per_gamma, n, out=h[1:])
    _spread(stiff, lift, h)
    bend = np.multiply(k.bending, hard, out=s[0])
    stiff[0, 0] += bend
    shear = np.multiply(k.shearing, hard, out=s[0])
    stiff[1, 1] += shear
    stiff[2, 2] += np.multiply(k.stretching, hard, out=s[1])
    return True


def _stiffness_at_loads(m2: Array, n: Array, c: Constants, stiff: Array) -> None:
    """D^2 W = factor (K + h h^T), h = (y/gamma)^(p/2) (m2, n1, n3)/y, y^2 = Q*."""
    if _stiffness_at_loads_plain(m2, n, c, stiff):
        return
    loads = [m2, *n]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    mu_2, nu_1, nu_3 = values
    rise, factor = _harden(y, c)
    tiny = TINY[y.dtype]
    h = np.empty_like(stiff[0])
    rise_per_size = rise / np.maximum(size, np.sqrt(tiny))
    bend_rise, shear_rise = c.alpha * rise_per_size, c.zeta * rise_per_size
    extend_rise = c.eta * rise_per_size
    h[0], h[1], h[2] = bend_rise * mu_2, nu_1 * shear_rise, extend_rise * nu_3
    _spread(stiff, factor, h)
    stiff[0, 0] += c.alpha**2 * factor
    stiff[1, 1] += c.zeta**2 * factor
    stiff[2, 2] += c.eta**2 * factor


def _stiffness_at_loads_at(m2: Any, n: Any, c: Constants) -> Any:
    """`stiffness_at_loads` of floats, where nothing is extreme."""
    (
        bend_soft, shear_soft, n3_extends, per_gamma, half_p, gamma, per_p, bending, shearing,
        stretching, low, high,
    ) = c.plain.of_stiffness_at_loads
    n1, n3 = n
    w2, w4, extension = bend_soft * m2, shear_soft * n1, n3_extends * n3
    overload = per_gamma * (extension * n3 + m2 * w2 + n1 * w4)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m2, n1, n3)))
    ):
        raise _Extreme
    overload = overload or NOUGHT
    excess = overload**half_p
    hard = gamma * (excess + 1)**per_p
    lift = excess * hard / overload
    h2, h4, h6 = per_gamma * m2, per_gamma * n1, per_gamma * n3
    bend, shear, lift_1 = bending * hard, shearing * hard, h2 * lift
    lift_2, lift_3 = h4 * lift, h6 * lift
    k11, k12, k13 = bend + h2 * lift_1, h4 * lift_1, h6 * lift_1
    k22, k23 = h4 * lift_2 + shear, h6 * lift_2
    k33 = h6 * lift_3 + stretching * hard
    return (
        (k11, k12, k13),
        (k12, k22, k23),
        (k13, k23, k33),
    )


def stiffness_at_loads(
    m2: Given | float, n: Given, constants: Constants, out: Array | None = None
) -> Array:
    """Stiffness d(m2, n)/d(u2, v), (3, 3, ...), at the strains of these loads.

    m2 (...) in force times length, n (2, ...) in force (n1 and n3), with Q*^(1/2) finite.
    Rows and columns are ordered (m2, n1, n3) and (u2, v1, v3).
    The inverse of the compliance; it holds where strains no longer tell the loads.
    """
    if out is None and type(n) is tuple and type(m2) is float:
        try:
            answer: Array = _stiffness_at_loads_at(m2, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stiffness_at_loads, {"m2": m2, "n": n}, constants)
        return answer
    (stiff,) = _apply(_stiffness_at_loads, {"m2": m2, "n": n}, constants, ("stiff",), out)
    return stiff
