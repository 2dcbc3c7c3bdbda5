"""Kirchhoff's rod with limited strains: it bends and twists only.

Scene kirchhoff, made by: rodproof generate kirchhoff

Constraints: unshearable, inextensible; v1 = 0, v2 = 0, v3 = 1; n1, n2, n3 are reactions, which
the law does not determine.

Statements it rests on (paper label, verdict; as corrected if refuted): qstar-form Section 3.1
refuted; const-u-mu eq:uconst proved; const-u-3 eq:u3const proved; q-form eq:quadraticform
definition; strain-limit eq:strainlimiting proved; const-m-mu eq:mconst proved; const-m-3
eq:m3const proved; w-definition eq:stenergy proved; wstar-definition eq:compenergy proved;
hess-m-u reading; hess-m-u3 reading; hess-m3-u3 refuted; wstar-gradient Section 3.1 proved.

Domain: loads with finite Q*^(1/2); strains with Q < 1, else an error.

One point: tuples of numbers (a float for a single component) are answered with tuples of floats,
in plain Python, where nothing is extreme. They agree with the arrays' answers within 8 ulps of
the largest component, or as far as the inputs determine what grows near the limit.

Operations a point where nothing is extreme: arithmetic, transcendental, energy shares, temporaries
    strains                16    4    0    6
    loads                  17    4    0    6
    stored_energy          19    4    1    8
    complementary_energy   28    6    1   10
    stiffness              38    4    0    8
    loads_and_stiffness    41    4    0    8
    compliance             64    4    0   22
    strains_and_gap        18    4    0    6
    stiffness_at_loads     36    4    0   11
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
    "m": (3,), "u": (3,), "w": (), "w_star": (), "stiff": (3, 3), "soft": (3, 3), "limit_gap": (),
}


@dataclass(frozen=True)
class Constants:
    """The four constants of the rod, checked on construction (ValueError).

    alpha and beta are lengths, gamma is a force, p is a plain number; all are positive.
    """

    alpha: float
    beta: float
    gamma: float
    p: float
    per_alpha: float = field(init=False, repr=False, compare=False)
    per_beta: float = field(init=False, repr=False, compare=False)
    per_p: float = field(init=False, repr=False, compare=False)
    per_gamma: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("alpha", "beta", "gamma", "p"):
            value = float(getattr(self, name))
            if not 0 < value < math.inf:
                raise ValueError(f"Constants: {name} must be positive and finite, not {value}")
            object.__setattr__(self, name, value)
        alpha, beta, gamma, p = (Fraction(v) for v in (self.alpha, self.beta, self.gamma, self.p))
        derived = {
            "per_alpha": 1 / alpha,
            "per_beta": 1 / beta,
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
        return (self.alpha, self.beta, -0.5 * self.p, self.gamma, self.per_p)

    @cached_property
    def of_complementary_energy(self) -> tuple[float, ...]:
        """What `complementary_energy` of one point takes."""
        return (self.per_alpha, self.per_beta, self.gamma, self.p, -self.per_p)

    @cached_property
    def of_compliance(self) -> tuple[float, ...]:
        """What `compliance` of one point takes."""
        return (
            self.per_alpha, self.per_beta, self.gamma, self.p, -self.per_p, self.per_alpha**2,
            self.per_beta**2,
        )


class Plain:
    """What the plain bodies take, each number rounded once, and the squares where they hold."""

    def __init__(self, c: Constants) -> None:
        alpha, beta, gamma, p = (Fraction(v) for v in (c.alpha, c.beta, c.gamma, c.p))
        self.bend_soft = _rounded(1 / alpha**2 / gamma)
        self.turn_soft = _rounded(1 / beta**2 / gamma)
        self.per_gamma = _rounded(1 / gamma)
        self.per_p = _rounded(1 / p)
        self.bending = _rounded(alpha**2)
        self.turning = _rounded(beta**2)
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
            self.bend_soft, self.turn_soft, self.per_gamma, 0.5 * c.p, -self.per_p,
            *self.room[DOUBLE],
        )
        self.of_loads = (
            self.bending, self.turning, 0.5 * c.p, c.gamma, -self.per_p, *self.room[DOUBLE],
        )
        self.of_loads_and_stiffness = self.of_loads
        self.of_strains_and_gap = self.of_strains
        self.of_stiffness_at_loads = (
            self.bend_soft, self.turn_soft, self.per_gamma, 0.5 * c.p, c.gamma, self.per_p,
            self.bending, self.turning, *self.room[DOUBLE],
        )


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan


def _reduce_loads(loads: Rows, c: Constants) -> Rows:
    """Loads over their moduli, and Q* in squares."""
    m1, m2, m3 = loads
    mu_1, mu_2, mu_3 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3
    q_star = mu_1**2 + mu_2**2 + mu_3**2
    return mu_1, mu_2, mu_3, q_star


def _soften(y: Array, c: Constants) -> Rows:
    """Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."""
    tiny = TINY[y.dtype]
    larger = np.maximum(y, c.gamma)
    ratio = np.maximum(np.minimum(y, c.gamma) / larger, tiny)
    power = np.exp(c.p * np.log(ratio))
    factor = np.exp(-c.per_p * np.log1p(power)) / larger
    return ratio, power, factor


def _reduce_strains(strains: Rows, c: Constants) -> Rows:
    """Strains times their moduli, and Q in squares."""
    u1, u2, u3 = strains
    kappa_1, kappa_2, kappa_3 = c.alpha * u1, c.alpha * u2, c.beta * u3
    q = kappa_1**2 + kappa_2**2 + kappa_3**2
    return kappa_1, kappa_2, kappa_3, q


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
    with np.errstate(over="ignore", invalid="ignore"):
        *_, q = _reduce_strains(strains, c)
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


def _overload(m: Array, c: Constants, u: Array, s: Array) -> Array:
    """Q*/gamma^2 as a sum of squares; the linear rod's strains over gamma in u."""
    k = c.plain
    x = s[:3]
    np.multiply(k.bend_soft, m[:2], out=u[:2])
    np.multiply(k.turn_soft, m[2], out=u[2])
    np.multiply(m, u, out=x)
    overload: Array = np.add(x[0], x[1], out=s[3])
    overload += x[2]
    overload *= k.per_gamma
    return overload


def _q(u: Array, c: Constants, m: Array, s: Array) -> Array:
    """Q as a sum of squares; the linear rod's loads over gamma in m."""
    k = c.plain
    x = s[:3]
    np.multiply(k.bending, u[:2], out=m[:2])
    np.multiply(k.turning, u[2], out=m[2])
    np.multiply(m, u, out=x)
    q: Array = np.add(x[0], x[1], out=s[3])
    q += x[2]
    return q


def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, a row and its mirror image at a time."""
    for i, row in enumerate(vector):
        np.multiply(weight * row, vector[i:], out=matrix[i, i:])
        matrix[i + 1 :, i] = matrix[i, i + 1 :]


def _strains_plain(m: Array, c: Constants, u: Array) -> bool:
    """`_strains` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(4, m)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m, c, u, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[3])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[3])
    root *= -k.per_p
    np.exp(root, out=root)
    u *= root
    return True


def _strains(m: Array, c: Constants, u: Array) -> None:
    """u = (gamma^p + Q*^(p/2))^(-1/p) K^-1 m."""
    if _strains_plain(m, c, u):
        return
    loads = [*m]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, mu_3 = values
    *_, factor = _soften(y, c)
    reach = factor * unscale
    bend, turn = c.per_alpha * reach, c.per_beta * reach
    u[0], u[1], u[2] = bend * mu_1, bend * mu_2, mu_3 * turn


def _strains_at(m: Any, c: Constants) -> Any:
    """`strains` of floats, where nothing is extreme."""
    bend_soft, turn_soft, per_gamma, half_p, minus_per_p, low, high = c.plain.of_strains
    m1, m2, m3 = m
    w1, w2, twist = bend_soft * m1, bend_soft * m2, turn_soft * m3
    overload = per_gamma * (m1 * w1 + m2 * w2 + m3 * twist)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m1, m2, m3)))
    ):
        raise _Extreme
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return (root * w1, root * w2, root * twist)


def strains(m: Given, constants: Constants, out: Array | None = None) -> Array:
    """Strains u under the loads m (eq:uconst to eq:u3const).

    m (3, ...) in force times length, with Q*^(1/2) finite.
    Answers u (3, ...) in 1/length; at rest u = 0.
    """
    if out is None and type(m) is tuple:
        try:
            answer: Array = _strains_at(m, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains, {"m": m}, constants)
        return answer
    (u,) = _apply(_strains, {"m": m}, constants, ("u",), out)
    return u


def _loads_plain(u: Array, c: Constants, m: Array) -> bool:
    """`_loads` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(4, u)
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u, c, m, s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[3])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[3])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    m *= hard
    return True


def _loads(u: Array, c: Constants, m: Array) -> None:
    """m = gamma (1 - Q^(p/2))^(-1/p) K u."""
    if _loads_plain(u, c, m):
        return
    strains = [*u]
    values, _, unscale, q = _rescaled(_reduce_strains, strains, c)
    kappa_1, kappa_2, kappa_3 = values
    q = _within_limit(q)
    *_, factor = _stiffen(q, c)
    secant = factor * unscale
    bend, turn = c.alpha * secant, c.beta * secant
    m[0], m[1], m[2] = bend * kappa_1, bend * kappa_2, kappa_3 * turn


def _loads_at(u: Any, c: Constants) -> Any:
    """`loads` of floats, where nothing is extreme."""
    bending, turning, half_p, gamma, minus_per_p, low, high = c.plain.of_loads
    u1, u2, u3 = u
    r1, r2, torque = bending * u1, bending * u2, turning * u3
    q = r1 * u1 + r2 * u2 + torque * u3
    if type(q) is not float or (not low < q < 1 and (q or low > high or any((u1, u2, u3)))):
        raise _Extreme
    q = q or NOUGHT
    left = -expm1(half_p * log(q))
    hard = gamma * left**minus_per_p
    return (hard * r1, hard * r2, hard * torque)


def loads(u: Given, constants: Constants, out: Array | None = None) -> Array:
    """Loads m at the strains u (eq:mconst to eq:m3const).

    u (3, ...) in 1/length, with Q < 1 (eq:strainlimiting).
    Answers m (3, ...) in force times length.
    Near the limit the strains hardly determine the loads.
    """
    if out is None and type(u) is tuple:
        try:
            answer: Array = _loads_at(u, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(loads, {"u": u}, constants)
        return answer
    (m,) = _apply(_loads, {"u": u}, constants, ("m",), out)
    return m


def _stored_energy(u: Array, c: Constants, w: Array) -> None:
    """W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of the work."""
    strains = [*u]
    _, _, x, _, q = _balanced(_reduce_strains, strains, c)
    q = _within_limit(q)
    _, depth, factor = _stiffen(q, c)
    load = factor * x
    w[...] = load * x * _work_share(depth, c)


def _stored_energy_at(u: Any, c: Constants) -> Any:
    """`stored_energy` of floats, where nothing is extreme."""
    alpha, beta, minus_half_p, gamma, per_p = c.of_stored_energy
    u1, u2, u3 = u
    kappa_1, kappa_2, kappa_3 = alpha * u1, alpha * u2, beta * u3
    q = kappa_1 * kappa_1 + kappa_2 * kappa_2 + kappa_3 * kappa_3
    if type(q) is not float or (not LOW < q < 1 and any((u1, u2, u3))):
        raise _Extreme
    x = sqrt(q)
    raw_1 = minus_half_p * log(q if q > LEAST else LEAST)
    growth = 1 / expm1(raw_1 if raw_1 < LOG_MOST else LOG_MOST)
    depth = log1p(growth)
    factor = gamma * exp(per_p * depth)
    load = factor * x
    return load * x * _work_share_at(depth, c)


def stored_energy(u: Given, constants: Constants, out: Array | None = None) -> Array:
    """Stored energy W per length, in force (eq:stenergy), with the trailing shape.

    u (3, ...) in 1/length, with Q < 1 (eq:strainlimiting).
    """
    if out is None and type(u) is tuple:
        try:
            answer: Array = _stored_energy_at(u, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stored_energy, {"u": u}, constants)
        return answer
    (w,) = _apply(_stored_energy, {"u": u}, constants, ("w",), out)
    return w


def _complementary_energy(m: Array, c: Constants, w_star: Array) -> None:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."""
    loads = [*m]
    _, _, y, _, _ = _balanced(_reduce_loads, loads, c)
    ratio, power, factor = _soften(y, c)
    strain = factor * y
    depth = np.log1p(power) - c.p * np.where(y <= c.gamma, 0.0, np.log(ratio))
    w_star[...] = strain * y * (1 - _work_share(depth, c))


def _complementary_energy_at(m: Any, c: Constants) -> Any:
    """`complementary_energy` of floats, where nothing is extreme."""
    per_alpha, per_beta, gamma, p, minus_per_p = c.of_complementary_energy
    m1, m2, m3 = m
    mu_1, mu_2, mu_3 = per_alpha * m1, per_alpha * m2, per_beta * m3
    q_star = mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((m1, m2, m3))):
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


def complementary_energy(m: Given, constants: Constants, out: Array | None = None) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    m (3, ...) in force times length, with Q*^(1/2) finite.
    """
    if out is None and type(m) is tuple:
        try:
            answer: Array = _complementary_energy_at(m, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(complementary_energy, {"m": m}, constants)
        return answer
    (w_star,) = _apply(_complementary_energy, {"m": m}, constants, ("w_star",), out)
    return w_star


def _stiffness_plain(u: Array, c: Constants, stiff: Array) -> bool:
    """`_stiffness` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(7, u)
    w, s = s[:3], s[3:]
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u, c, w, s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[0])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[1])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    steep = np.subtract(1, left, out=s[2])
    steep *= hard
    steep /= left
    steep /= q
    _spread(stiff, steep, w)
    bend = np.multiply(k.bending, hard, out=s[2])
    stiff[0, 0] += bend
    stiff[1, 1] += bend
    stiff[2, 2] += np.multiply(k.turning, hard, out=s[1])
    return True


def _stiffness(u: Array, c: Constants, stiff: Array) -> None:
    """D^2 W = factor (K + growth t t^T), t = K u/x."""
    if _stiffness_plain(u, c, stiff):
        return
    strains = [*u]
    with np.errstate(over="ignore", invalid="ignore"):
        kappa_1, kappa_2, kappa_3, q = _reduce_strains(strains, c)
    q = _within_limit(q)
    growth, _, factor = _stiffen(q, c)
    tiny = TINY[q.dtype]
    t = np.empty_like(stiff[0])
    steep = factor * growth
    x = np.sqrt(np.maximum(q, tiny))
    per_x = 1 / x
    bend_per_x, turn_per_x = c.alpha * per_x, c.beta * per_x
    t[0], t[1], t[2] = bend_per_x * kappa_1, bend_per_x * kappa_2, kappa_3 * turn_per_x
    _spread(stiff, steep, t)
    beside = c.alpha**2 * factor
    stiff[0, 0] += beside
    stiff[1, 1] += beside
    stiff[2, 2] += c.beta**2 * factor


def _stiffness_at(u: Any, c: Constants) -> Any:
    """`stiffness` of floats, where nothing is extreme."""
    return _loads_and_stiffness_at(u, c)[-1]


def stiffness(u: Given, constants: Constants, out: Array | None = None) -> Array:
    """Stiffness d m/d u, (3, 3, ...), symmetric positive definite (Section 3.4).

    u (3, ...) in 1/length, with Q < 1 (eq:strainlimiting).
    Rows and columns are ordered (m1, m2, m3) and (u1, u2, u3).
    """
    if out is None and type(u) is tuple:
        try:
            answer: Array = _stiffness_at(u, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stiffness, {"u": u}, constants)
        return answer
    (stiff,) = _apply(_stiffness, {"u": u}, constants, ("stiff",), out)
    return stiff


def _loads_and_stiffness_plain(u: Array, c: Constants, m: Array, stiff: Array) -> bool:
    """`_loads_and_stiffness` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(7, u)
    w, s = s[:3], s[3:]
    with np.errstate(over="ignore", invalid="ignore"):
        q = _q(u, c, w, s)
    if not _inside(q, k.within_q):
        return False
    left = np.log(q, out=s[0])
    left *= 0.5 * c.p
    np.expm1(left, out=left)
    np.negative(left, out=left)
    hard = np.log(left, out=s[1])
    hard *= -k.per_p
    np.exp(hard, out=hard)
    hard *= c.gamma
    np.multiply(hard, w, out=m)
    steep = np.subtract(1, left, out=s[2])
    steep *= hard
    steep /= left
    steep /= q
    _spread(stiff, steep, w)
    bend = np.multiply(k.bending, hard, out=s[2])
    stiff[0, 0] += bend
    stiff[1, 1] += bend
    stiff[2, 2] += np.multiply(k.turning, hard, out=s[1])
    return True


def _loads_and_stiffness(u: Array, c: Constants, m: Array, stiff: Array) -> None:
    """m = factor K u and D^2 W = factor (K + growth t t^T), as apart."""
    if _loads_and_stiffness_plain(u, c, m, stiff):
        return
    strains = [*u]
    values, size, _, unscale, q = _balanced(_reduce_strains, strains, c)
    kappa_1, kappa_2, kappa_3 = values
    q = _within_limit(q)
    growth, _, factor = _stiffen(q, c)
    tiny = TINY[q.dtype]
    t = np.empty_like(stiff[0])
    steep, secant = factor * growth, factor * unscale
    per_size = 1 / np.maximum(size, np.sqrt(tiny))
    bend_per_size, turn_per_size, bend = c.alpha * per_size, c.beta * per_size, c.alpha * secant
    turn = c.beta * secant
    t[0], t[1], t[2] = bend_per_size * kappa_1, bend_per_size * kappa_2, kappa_3 * turn_per_size
    m[0], m[1], m[2] = bend * kappa_1, bend * kappa_2, kappa_3 * turn
    _spread(stiff, steep, t)
    beside = c.alpha**2 * factor
    stiff[0, 0] += beside
    stiff[1, 1] += beside
    stiff[2, 2] += c.beta**2 * factor


def _loads_and_stiffness_at(u: Any, c: Constants) -> Any:
    """`loads_and_stiffness` of floats, where nothing is extreme."""
    bending, turning, half_p, gamma, minus_per_p, low, high = c.plain.of_loads_and_stiffness
    u1, u2, u3 = u
    r1, r2, torque = bending * u1, bending * u2, turning * u3
    q = r1 * u1 + r2 * u2 + torque * u3
    if type(q) is not float or (not low < q < 1 and (q or low > high or any((u1, u2, u3)))):
        raise _Extreme
    q = q or NOUGHT
    left = -expm1(half_p * log(q))
    hard = gamma * left**minus_per_p
    steep = hard * (1 - left) / left / q
    bend, steep_1, steep_2 = bending * hard, r1 * steep, r2 * steep
    steep_3 = steep * torque
    k11, k12, k13 = bend + r1 * steep_1, r2 * steep_1, steep_1 * torque
    k22, k23 = bend + r2 * steep_2, steep_2 * torque
    k33 = turning * hard + steep_3 * torque
    stiff = (
        (k11, k12, k13),
        (k12, k22, k23),
        (k13, k23, k33),
    )
    return (hard * r1, hard * r2, hard * torque), stiff


def loads_and_stiffness(u: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Loads m and stiffness d m/d u at the strains u.

    u (3, ...) in 1/length, with Q < 1 (eq:strainlimiting).
    Answers m (3, ...) in force times length,
    and the stiffness (3, 3, ...).
    Rows and columns are ordered (m1, m2, m3) and (u1, u2, u3).
    """
    if out is None and type(u) is tuple:
        try:
            answer: Pair = _loads_and_stiffness_at(u, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(loads_and_stiffness, {"u": u}, constants)
        return answer
    m, stiff = _apply(_loads_and_stiffness, {"u": u}, constants, ("m", "stiff"), out)
    return m, stiff


def _compliance(m: Array, c: Constants, soft: Array) -> None:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 m/y.

    With (a, b) the reduced load as a unit vector,
    the entries that would cancel are sums of squares.
    """
    loads = [*m]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, mu_3 = values
    _, power, factor = _soften(y, c)
    tiny = TINY[y.dtype]
    d = np.empty_like(soft[0])
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    per_size = 1 / size
    a1, share = per_size * (mu_1 + tiny), np.where(y <= c.gamma, power, 1.0) / (power + 1)
    aa1 = a1**2
    a2, a3 = mu_2 * per_size, mu_3 * per_size
    aa2, aa3 = a2**2, a3**2
    across = aa1 + aa2
    steep = -factor * share
    d[0], d[1], d[2] = c.per_alpha * a1, c.per_alpha * a2, c.per_beta * a3
    _spread(soft, steep, d)
    soft[0, 0] = c.per_alpha**2 * factor * (aa1 * remain + aa2 + aa3)
    soft[1, 1] = c.per_alpha**2 * factor * (aa1 + aa2 * remain + aa3)
    soft[2, 2] = c.per_beta**2 * factor * (aa3 * remain + across)


def _compliance_at(m: Any, c: Constants) -> Any:
    """`compliance` of floats, where nothing is extreme."""
    (
        per_alpha, per_beta, gamma, p, minus_per_p, per_alpha_squared, per_beta_squared,
    ) = c.of_compliance
    m1, m2, m3 = m
    mu_1, mu_2, mu_3 = per_alpha * m1, per_alpha * m2, per_beta * m3
    q_star = mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((m1, m2, m3))):
        raise _Extreme
    y = sqrt(q_star)
    larger = y if y > gamma else gamma
    raw_1 = (y if y < gamma else gamma) / larger
    ratio = raw_1 if raw_1 > LEAST else LEAST
    power = ratio**p
    factor = exp(minus_per_p * log1p(power)) / larger
    remain = (1.0 if y <= gamma else power) / (power + 1)
    per_size = 1 / (y if y > LEAST else LEAST)
    a1, share = per_size * (mu_1 + LEAST), (power if y <= gamma else 1.0) / (power + 1)
    aa1 = a1 * a1
    a2, a3, d1 = mu_2 * per_size, mu_3 * per_size, per_alpha * a1
    aa2, aa3 = a2 * a2, a3 * a3
    across = aa1 + aa2
    steep = -factor * share
    d2, d3, steep_1 = per_alpha * a2, per_beta * a3, d1 * steep
    steep_2 = d2 * steep
    s11, s12 = per_alpha_squared * factor * (aa1 * remain + aa2 + aa3), d2 * steep_1
    s13 = d3 * steep_1
    s22, s23 = per_alpha_squared * factor * (aa1 + aa2 * remain + aa3), d3 * steep_2
    s33 = per_beta_squared * factor * (aa3 * remain + across)
    return (
        (s11, s12, s13),
        (s12, s22, s23),
        (s13, s23, s33),
    )


def compliance(m: Given, constants: Constants, out: Array | None = None) -> Array:
    """Compliance d u/d m, (3, 3, ...), the inverse of the stiffness at these loads.

    m (3, ...) in force times length, with Q*^(1/2) finite.
    Rows and columns are ordered (u1, u2, u3) and (m1, m2, m3).
    """
    if out is None and type(m) is tuple:
        try:
            answer: Array = _compliance_at(m, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(compliance, {"m": m}, constants)
        return answer
    (soft,) = _apply(_compliance, {"m": m}, constants, ("soft",), out)
    return soft


def _strains_and_gap_plain(m: Array, c: Constants, u: Array, limit_gap: Array) -> bool:
    """`_strains_and_gap` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(4, m)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m, c, u, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[3])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[0])
    root *= -k.per_p
    np.exp(root, out=root)
    u *= root
    np.add(excess, 1, out=limit_gap)
    np.divide(1, limit_gap, out=limit_gap)
    return True


def _strains_and_gap(m: Array, c: Constants, u: Array, limit_gap: Array) -> None:
    """The strains, and 1 - Q^(p/2) = gamma^p/(gamma^p + Q*^(p/2))."""
    if _strains_and_gap_plain(m, c, u, limit_gap):
        return
    loads = [*m]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, mu_3 = values
    _, power, factor = _soften(y, c)
    reach = factor * unscale
    bend, turn = c.per_alpha * reach, c.per_beta * reach
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    u[0], u[1], u[2] = bend * mu_1, bend * mu_2, mu_3 * turn
    limit_gap[...] = remain


def _strains_and_gap_at(m: Any, c: Constants) -> Any:
    """`strains_and_gap` of floats, where nothing is extreme."""
    bend_soft, turn_soft, per_gamma, half_p, minus_per_p, low, high = c.plain.of_strains_and_gap
    m1, m2, m3 = m
    w1, w2, twist = bend_soft * m1, bend_soft * m2, turn_soft * m3
    overload = per_gamma * (m1 * w1 + m2 * w2 + m3 * twist)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m1, m2, m3)))
    ):
        raise _Extreme
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return (root * w1, root * w2, root * twist), 1 / (excess + 1)


def strains_and_gap(m: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Strains u under the loads m, and 1 - Q^(p/2).

    m (3, ...) in force times length, with Q*^(1/2) finite.
    Answers u (3, ...) in 1/length, and the gap (...) plain:
    near the limit it says what the strains no longer can.
    """
    if out is None and type(m) is tuple:
        try:
            answer: Pair = _strains_and_gap_at(m, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains_and_gap, {"m": m}, constants)
        return answer
    u, limit_gap = _apply(_strains_and_gap, {"m": m}, constants, ("u", "limit_gap"), out)
    return u, limit_gap


def _stiffness_at_loads_plain(m: Array, c: Constants, stiff: Array) -> bool:
    """`_stiffness_at_loads` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(10, m)
    w, s = s[:3], s[3:]
    h = s[4:7]
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m, c, w, s)
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
    np.multiply(k.per_gamma, m, out=h)
    _spread(stiff, lift, h)
    bend = np.multiply(k.bending, hard, out=s[0])
    stiff[0, 0] += bend
    stiff[1, 1] += bend
    stiff[2, 2] += np.multiply(k.turning, hard, out=s[1])
    return True


def _stiffness_at_loads(m: Array, c: Constants, stiff: Array) -> None:
    """D^2 W = factor (K + h h^T), h = (y/gamma)^(p/2) m/y, y^2 = Q*."""
    if _stiffness_at_loads_plain(m, c, stiff):
        return
    loads = [*m]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, mu_3 = values
    rise, factor = _harden(y, c)
    tiny = TINY[y.dtype]
    h = np.empty_like(stiff[0])
    rise_per_size = rise / np.maximum(size, np.sqrt(tiny))
    bend_rise, turn_rise = c.alpha * rise_per_size, c.beta * rise_per_size
    h[0], h[1], h[2] = bend_rise * mu_1, bend_rise * mu_2, mu_3 * turn_rise
    _spread(stiff, factor, h)
    beside = c.alpha**2 * factor
    stiff[0, 0] += beside
    stiff[1, 1] += beside
    stiff[2, 2] += c.beta**2 * factor


def _stiffness_at_loads_at(m: Any, c: Constants) -> Any:
    """`stiffness_at_loads` of floats, where nothing is extreme."""
    (
        bend_soft, turn_soft, per_gamma, half_p, gamma, per_p, bending, turning, low, high,
    ) = c.plain.of_stiffness_at_loads
    m1, m2, m3 = m
    w1, w2, twist = bend_soft * m1, bend_soft * m2, turn_soft * m3
    overload = per_gamma * (m1 * w1 + m2 * w2 + m3 * twist)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m1, m2, m3)))
    ):
        raise _Extreme
    overload = overload or NOUGHT
    excess = overload**half_p
    hard = gamma * (excess + 1)**per_p
    lift = excess * hard / overload
    h1, h2, h3 = per_gamma * m1, per_gamma * m2, per_gamma * m3
    bend, lift_1, lift_2 = bending * hard, h1 * lift, h2 * lift
    lift_3 = h3 * lift
    k11, k12, k13 = bend + h1 * lift_1, h2 * lift_1, h3 * lift_1
    k22, k23 = bend + h2 * lift_2, h3 * lift_2
    k33 = h3 * lift_3 + turning * hard
    return (
        (k11, k12, k13),
        (k12, k22, k23),
        (k13, k23, k33),
    )


def stiffness_at_loads(m: Given, constants: Constants, out: Array | None = None) -> Array:
    """Stiffness d m/d u, (3, 3, ...), at the strains of these loads.

    m (3, ...) in force times length, with Q*^(1/2) finite.
    Rows and columns are ordered (m1, m2, m3) and (u1, u2, u3).
    The inverse of the compliance; it holds where strains no longer tell the loads.
    """
    if out is None and type(m) is tuple:
        try:
            answer: Array = _stiffness_at_loads_at(m, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(stiffness_at_loads, {"m": m}, constants)
        return answer
    (stiff,) = _apply(_stiffness_at_loads, {"m": m}, constants, ("stiff",), out)
    return stiff
