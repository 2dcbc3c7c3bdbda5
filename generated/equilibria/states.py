"""Rods in equilibrium in closed form: straight, sheared, twisted, helical and circular.

Made by: rodproof generate

Under a thrust N g_3 or a couple M g_3 these are the states whose strains do not change along the
rod: their angle, strains, directors and center line, the threshold of the sheared states and
their limit. `equilibria` lists what a thrust allows.

Statements it rests on (verdict; as corrected if refuted): moduli-condition-1 proved,
moduli-condition-2 definition, n-thresh definition, sheared-existence proved,
extra-threshold-sharp proved, extra-helix-axis proved, helix-phi refuted, helix-psi proved,
const-u-mu proved, const-u-3 proved, const-v-mu proved, const-v-3 proved, wstar-definition proved.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from decimal import MAX_EMAX, MIN_EMIN, Decimal, localcontext
from fractions import Fraction
from functools import cache, cached_property
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
LEAST = 2.0**-1022  # the smallest normal number, for one point
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
DOUBLE = np.dtype(np.float64)
HEADS = {"m": (3,), "n": (3,), "u": (3,), "v": (3,), "w_star": ()}


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

    def __post_init__(self) -> None:
        for name in ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p"):
            value = float(getattr(self, name))
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")
            object.__setattr__(self, name, value)
        exact = (
            Fraction(v) for v in (self.alpha, self.beta, self.zeta, self.eta, self.iota, self.p)
        )
        alpha, beta, zeta, eta, iota, p = exact
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
    def of_complementary_energy(self) -> tuple[float, ...]:
        """What `complementary_energy` of one point takes."""
        return (
            self.per_alpha, self.per_beta, self.per_zeta, self.m3_contracts, self.n3_dilates,
            self.gap, self.gamma, self.p, -self.per_p,
        )


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
        used = [v for v in vars(self).values() if v]
        self.within_overload: dict[Any, tuple[float, float]] = {}
        self.room: dict[Any, tuple[float, float]] = {}
        for kind, tiny in TINY.items():
            span = tiny**-0.25
            even = all(1 < abs(v) * span < span**2 for v in used)
            self.room[kind] = (1 / span, span) if even else (1.0, 0.0)
            overload = (1 / span, math.exp(min(2 * math.log(span) / c.p, math.log(1024))))
            self.within_overload[kind] = overload if even else (1.0, 0.0)
        self.of_strains = (
            self.bend_soft, self.turn_soft, self.shear_soft, self.m3_extends, self.n3_extends,
            self.per_gamma, self.slack_load, self.untwist, 0.5 * c.p, -self.per_p,
            *self.room[DOUBLE],
        )


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan


def _reduce_loads(loads: Rows, c: Constants) -> Rows:
    """Loads over their moduli, the linear rod's strains, and Q* in squares."""
    m1, m2, m3, n1, n2, n3 = loads
    mu_1, mu_2, mu_3 = c.per_alpha * m1, c.per_alpha * m2, c.per_beta * m3
    nu_1, nu_2 = c.per_zeta * n1, c.per_zeta * n2
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    q_star = c.gap * dilatation**2 + mu_1**2 + mu_2**2 + mu_3**2 + nu_1**2 + nu_2**2
    return mu_1, mu_2, nu_1, nu_2, dilatation, twist, q_star


def _soften(y: Array, c: Constants) -> Rows:
    """Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."""
    tiny = TINY[y.dtype]
    larger = np.maximum(y, c.gamma)
    ratio = np.maximum(np.minimum(y, c.gamma) / larger, tiny)
    power = np.exp(c.p * np.log(ratio))
    factor = np.exp(-c.per_p * np.log1p(power)) / larger
    return ratio, power, factor


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
            body(*block, c, *(array[..., part] for array in flat))
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


def _overload(m: Array, n: Array, c: Constants, u: Array, v: Array, s: Array) -> Array:
    """Q*/gamma^2 as a sum of squares; the linear rod's strains over gamma in u and v."""
    k = c.plain
    x = s[:2]
    np.multiply(k.bend_soft, m[:2], out=u[:2])
    turn = np.multiply(k.turn_soft, m[2], out=s[2])
    np.multiply(k.shear_soft, n[:2], out=v[:2])
    np.multiply(k.n3_extends, n[2], out=v[2])
    v[2] -= np.multiply(k.m3_extends, m[2], out=s[3])
    np.multiply(m[:2], u[:2], out=x)
    overload: Array = np.add(x[0], x[1], out=s[3])
    overload += np.multiply(m[2], turn, out=s[4])
    np.multiply(n[:2], v[:2], out=x)
    overload += x[0]
    overload += x[1]
    np.square(v[2], out=s[4])
    s[4] *= k.slack_load
    overload += s[4]
    overload *= k.per_gamma
    np.multiply(k.untwist, v[2], out=u[2])
    np.subtract(turn, u[2], out=u[2])
    return overload


def _strains_plain(m: Array, n: Array, c: Constants, u: Array, v: Array) -> bool:
    """`_strains` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(5, m)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(m, n, c, u, v, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[3])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[3])
    root *= -k.per_p
    np.exp(root, out=root)
    u *= root
    v *= root
    v[2] += 1
    return True


def _strains(m: Array, n: Array, c: Constants, u: Array, v: Array) -> None:
    """(u, v - e3) = (gamma^p + Q*^(p/2))^(-1/p) K^-1 (m, n)."""
    if _strains_plain(m, n, c, u, v):
        return
    loads = [*m, *n]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, nu_1, nu_2, dilatation, twist = values
    *_, factor = _soften(y, c)
    reach = factor * unscale
    bend, turn, shear = c.per_alpha * reach, c.per_beta * reach, c.per_zeta * reach
    extend = c.per_eta * reach
    u[0], u[1], u[2] = bend * mu_1, bend * mu_2, turn * twist
    v[0], v[1] = nu_1 * shear, nu_2 * shear
    v[2] = dilatation * extend + 1


def _strains_at(m: Any, n: Any, c: Constants) -> Any:
    """`strains` of floats, where nothing is extreme."""
    (
        bend_soft, turn_soft, shear_soft, m3_extends, n3_extends, per_gamma, slack_load, untwist,
        half_p, minus_per_p, low, high,
    ) = c.plain.of_strains
    m1, m2, m3 = m
    n1, n2, n3 = n
    w1, w2, turn = bend_soft * m1, bend_soft * m2, turn_soft * m3
    w4, w5 = shear_soft * n1, shear_soft * n2
    extension = n3_extends * n3 - m3_extends * m3
    overload = (
        per_gamma
        * (slack_load * extension * extension + m1 * w1 + m2 * w2 + m3 * turn + n1 * w4 + n2 * w5)
    )
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((m1, m2, m3, n1, n2, n3)))
    ):
        raise _Extreme
    twist = turn - untwist * extension
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return (root * w1, root * w2, root * twist), (root * w4, root * w5, extension * root + 1)


def strains(m: Given, n: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Strains u, v under the loads m, n (eq:uconst to eq:v3const).

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Answers u (3, ...) in 1/length, v (3, ...) plain; at rest u = 0, v = (0, 0, 1).
    """
    if out is None and type(m) is type(n) is tuple:
        try:
            answer: Pair = _strains_at(m, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains, {"m": m, "n": n}, constants)
        return answer
    u, v = _apply(_strains, {"m": m, "n": n}, constants, ("u", "v"), out)
    return u, v


def _complementary_energy(m: Array, n: Array, c: Constants, w_star: Array) -> None:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."""
    loads = [*m, *n]
    _, _, y, _, _ = _balanced(_reduce_loads, loads, c)
    ratio, power, factor = _soften(y, c)
    strain = factor * y
    depth = np.log1p(power) - c.p * np.where(y <= c.gamma, 0.0, np.log(ratio))
    w_star[...] = strain * y * (1 - _work_share(depth, c))


def _complementary_energy_at(m: Any, n: Any, c: Constants) -> Any:
    """`complementary_energy` of floats, where nothing is extreme."""
    (
        per_alpha, per_beta, per_zeta, m3_contracts, n3_dilates, gap, gamma, p, minus_per_p,
    ) = c.of_complementary_energy
    m1, m2, m3 = m
    n1, n2, n3 = n
    mu_1, mu_2, mu_3 = per_alpha * m1, per_alpha * m2, per_beta * m3
    nu_1, nu_2 = per_zeta * n1, per_zeta * n2
    dilatation = n3_dilates * n3 - m3_contracts * m3
    q_star = (
        gap * dilatation * dilatation + mu_1 * mu_1 + mu_2 * mu_2 + mu_3 * mu_3 + nu_1 * nu_1
        + nu_2 * nu_2
    )
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((m1, m2, m3, n1, n2, n3))):
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
    m: Given, n: Given, constants: Constants, out: Array | None = None
) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    """
    if out is None and type(m) is type(n) is tuple:
        try:
            answer: Array = _complementary_energy_at(m, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(complementary_energy, {"m": m, "n": n}, constants)
        return answer
    (w_star,) = _apply(_complementary_energy, {"m": m, "n": n}, constants, ("w_star",), out)
    return w_star


Number = Any  # a float or an array
Numbers = Sequence[Any]  # one for each component


def _frame(sines: Numbers, cosines: Numbers) -> Numbers:
    """The directors' components g_i . d_k, all of g_1 first."""
    sin_phi, sin_theta, sin_psi = sines
    cos_phi, cos_theta, cos_psi = cosines
    return (
        cos_phi * cos_psi * cos_theta - sin_phi * sin_psi,
        -(cos_phi * cos_theta * sin_psi + cos_psi * sin_phi),
        cos_phi * sin_theta,
        cos_phi * sin_psi + cos_psi * cos_theta * sin_phi,
        cos_phi * cos_psi - cos_theta * sin_phi * sin_psi,
        sin_phi * sin_theta,
        -cos_psi * sin_theta,
        sin_psi * sin_theta,
        cos_theta,
    )


def _axis(sine: Number, cosine: Number) -> Numbers:
    """The components of g_3 in the intermediate frame."""
    sin_theta = sine
    cos_theta = cosine
    return (
        -sin_theta,
        0.0,
        cos_theta,
    )


def _stack(rows: Numbers) -> Array:
    """One array of components, floats spread over the arrays' shape."""
    shapes = [row.shape for row in rows if isinstance(row, np.ndarray)]
    if not shapes:
        return np.array(rows)
    out = np.empty((len(rows), *np.broadcast_shapes(*shapes)))
    for i, row in enumerate(rows):
        out[i] = row
    return out


@dataclass(frozen=True)
class State:
    """A rod in equilibrium whose strains are constant in a frame that turns at a constant rate.

    The force is thrust g_3, the couple is couple g_3 (force times length); theta, in radians, is
    the angle of d_3 and g_3, with sine and cosine. In the intermediate frame e_k = R_3(phi)
    R_2(theta), phi = precession s, psi = spin s (both rates in 1/length), the strains are
    u (3, ...), in 1/length, and v (3, ...). energy is the stored energy less the work of the loads,
    per length, a force: -W* - thrust cos(theta), by which states under one load are compared. kind
    is straight, sheared, twisted, helix or circle. Numbers, or arrays of one shape. The methods
    take s, the place along the rod, as a number or an array that fits that shape.
    """

    kind: str
    thrust: Number
    couple: Number
    theta: Number
    sine: Number
    cosine: Number
    precession: Number
    spin: Number
    u: Array
    v: Array
    energy: Number

    @property
    def across(self) -> Number:
        """The tangent's length across g_3; its length along g_3 is `along`."""
        return self.cosine * self.v[0] + self.sine * self.v[2]

    @property
    def along(self) -> Number:
        """The tangent's length along g_3: the height of the rod over its reference length."""
        return self.cosine * self.v[2] - self.sine * self.v[0]

    @property
    def curvature(self) -> Number:
        """Of the center line, 1/length."""
        return np.abs(self.across * self.precession) / (self.across**2 + self.along**2)

    @property
    def torsion(self) -> Number:
        """Of the center line, 1/length; positive where it is a right-handed helix."""
        return self.along * self.precession / (self.across**2 + self.along**2)

    def angles(self, s: Number) -> Array:
        """phi, theta, psi at s, (3, ...), in radians."""
        return _stack((self.precession * s, self.theta + 0 * s, self.spin * s))

    def directors(self, s: Number) -> Array:
        """(3, 3, ...): column k - 1 is d_k in the fixed basis."""
        turns = (self.precession * s, self.spin * s)
        sines = [np.sin(turns[0]), self.sine, np.sin(turns[1])]
        cosines = [np.cos(turns[0]), self.cosine, np.cos(turns[1])]
        entries = _stack(_frame(sines, cosines))
        return entries.reshape(3, 3, *entries.shape[1:])

    def center_line(self, s: Number) -> Array:
        """r(s) from r(0) = 0, (3, ...), in the fixed basis, in the unit of length of s."""
        half = self.precession * s / 2
        reach = self.across * s * np.sinc(half / np.pi)
        return _stack((reach * np.cos(half), reach * np.sin(half), self.along * s))

    def strains_at(self, s: Number) -> Pair:
        """u and v in the directors at s, (3, ...) each."""
        return self._in_directors(self.u, s), self._in_directors(self.v, s)

    def loads_at(self, s: Number) -> Pair:
        """m (force times length) and n (force) in the directors at s, (3, ...) each."""
        tilt = _stack(_axis(self.sine, self.cosine))
        return self._in_directors(self.couple * tilt, s), self._in_directors(self.thrust * tilt, s)

    def rows(self, s: Number) -> Array:
        """The state of `rodproof.generated.equilibria.directors`: q, m, r, (10, ...)."""
        first, second = self.precession * s, self.spin * s
        # half the angle from its sine and cosine, without losing small ones
        low = np.sqrt((1 + np.abs(self.cosine)) / 2)
        high = self.sine / (2 * low)
        up = self.cosine >= 0
        cosine, sine = np.where(up, low, high), np.where(up, high, low)
        plus, minus = (first + second) / 2, (first - second) / 2
        q = (cosine * np.cos(plus), -sine * np.sin(minus), sine * np.cos(minus),
             cosine * np.sin(plus))
        return _stack((*q, *self.loads_at(s)[0], *self.center_line(s)))

    def _in_directors(self, vector: Array, s: Number) -> Array:
        """Components in the directors from those in the intermediate frame, at s."""
        sine, cosine = np.sin(self.spin * s), np.cos(self.spin * s)
        x, y, z = vector
        return _stack((x * cosine + y * sine, y * cosine - x * sine, z + 0 * cosine))


@dataclass(frozen=True)
class Branch:
    """Where a rod shears under a thrust, once a set of constants; nothing of it depends on N.

    threshold + remainder is the thrust at which the sheared states begin, to twice a float's
    digits. ratio is b/c, quotient b/c^2, log_quotient -p/2 log(b/c^2) for a = 1/zeta^2,
    b = beta^2/(beta^2 eta^2 - iota^2), c = a - b. limit holds sin^2 and cos^2 of the last angle.
    """

    threshold: float
    remainder: float
    ratio: float
    quotient: float
    log_quotient: float
    limit: tuple[float, float]


@cache
def _branch(constants: Constants) -> Branch:
    """The branch in exact arithmetic, rounded at the end; ValueError names what fails."""
    exact = (Fraction(getattr(constants, name)) for name in ("beta", "zeta", "eta", "iota"))
    beta, zeta, eta, iota = exact
    a = 1 / zeta**2
    b = beta**2 / (beta**2 * eta**2 - iota**2)
    c = a - b
    if c <= 0:
        raise ValueError(
            "no sheared states: the rod must be softer in shear than in extension,"
            f" 1/zeta^2 - beta^2/(beta^2 eta^2 - iota^2) > 0, not {float(c)!r}"
        )
    if c**2 <= b:
        raise ValueError(
            "no sheared states: 1/zeta^2 - beta^2/(beta^2 eta^2 - iota^2) must exceed"
            f" beta (beta^2 eta^2 - iota^2)^(-1/2), not {float(c)!r} against {math.sqrt(b)!r}"
        )
    sharp = a / c / (c + 1)
    with localcontext() as context:
        context.prec = 100
        context.Emax, context.Emin = MAX_EMAX, MIN_EMIN
        p, gamma = Decimal(constants.p), Decimal(constants.gamma)
        log_quotient = p / 2 * (_decimal(c**2 / b)).ln()
        threshold = gamma / _decimal(c) * (-(1 - (-log_quotient).exp()).ln() / p).exp()
        if threshold.adjusted() > 307:
            raise ValueError(f"the threshold of the sheared states, {threshold:.3e}, is no float")
        start = float(threshold)
        remainder = float(threshold - Decimal(start))
    return Branch(
        start,
        remainder,
        float(b / c),
        float(b / c**2),
        float(log_quotient),
        (float(1 - sharp), float(sharp)),
    )


def _decimal(value: Fraction) -> Decimal:
    return Decimal(value.numerator) / Decimal(value.denominator)


def threshold(constants: Constants) -> float:
    """N_thresh, a force: sheared states exist for |N| > N_thresh (n-thresh, extra-threshold-sharp).

    N_thresh^-p = c^p - b^(p/2) in units of gamma, rounded once. Raises ValueError, with the
    condition on the moduli that fails and by how much.
    """
    return _branch(constants).threshold


def limiting_angle(constants: Constants) -> float:
    """The angle of the sheared states as N grows, in radians; raises as `threshold`."""
    sine, cosine = _branch(constants).limit
    return math.atan2(math.sqrt(sine), math.sqrt(cosine))


def sheared_angle(thrust: ArrayLike, constants: Constants) -> Array:
    """theta of the sheared state under N g_3, in (0, pi/2) for N > 0, in (pi/2, pi) for N < 0.

    thrust is N, a number or an array, whose shape the angle, in radians, has. With y the load
    radius over gamma and c N x = (1 + y^p)^(1/p)
    (x = cos theta, N over gamma) the equation is y^2 + (1 + y^p)^(2/p)/c = a N^2, its slope in y^2
    between 1 and 1 + 1/c for p >= 2; for p = 2 it is linear. It is solved less its value
    at the threshold, for t in sin^2 theta = b/c t (1 - (N_thresh/N)^2): monotonically by Newton,
    to the last digits from just above the threshold to infinity. Raises ValueError where
    |N| <= N_thresh, with the threshold, and as `threshold` does.
    """
    N = np.asarray(thrust, dtype=float)
    sine, cosine = _sheared(N, constants)
    return np.asarray(np.arctan2(sine, np.where(N > 0, cosine, -cosine)))


def _sheared(N: Array, constants: Constants) -> tuple[Array, Array]:
    """sin theta and |cos theta| of the sheared states."""
    branch, p = _branch(constants), constants.p
    size = np.abs(N)
    start, rest = branch.threshold, -math.expm1(-branch.log_quotient)
    over = (size - start) - branch.remainder  # exact near the threshold
    bad = np.flatnonzero(~((over > 0) & (size < math.inf)))
    if bad.size:
        first = float(np.ravel(N)[bad[0]])
        raise ValueError(
            f"no sheared state at N = {first!r}: |N| must be finite and exceed the threshold"
            f" {start!r}, which lies {start - abs(first)!r} above"
        )
    with np.errstate(over="ignore", under="ignore", divide="ignore", invalid="ignore"):
        over = over / size  # 1 - N_thresh/N
        under = start / size
        rise = over * (1 + under)  # 1 - (N_thresh/N)^2
        per = under**2 / rise  # the reciprocal of (N/N_thresh)^2 - 1
        log_rise = np.log(rise) + 2 * (np.log(size) - math.log(start))
        t = np.full(np.shape(N), 1 / branch.ratio if p >= 2 else 0.0)
        for _ in range(100):
            growth, slope = _growth(t, per, log_rise, rest, branch, p)
            step = (branch.ratio * t + growth - 1) / (branch.ratio + slope)
            t = t - step
            if not (np.abs(step) > 2**-52 * t).any():
                break
        growth, _ = _growth(t, per, log_rise, rest, branch, p)
        sine, cosine = branch.ratio * t * rise, under**2 + rise * growth
    return np.sqrt(sine), np.sqrt(cosine)


def _growth(
    t: Array, per: Array, log_rise: Array, rest: float, branch: Branch, p: float
) -> tuple[Array, Array]:
    """((1 + y^p)^(2/p) over its value at the threshold, less 1), times per; its slope by t.

    At (y/y_thresh)^2 = 1 + (1 + t)/per.
    """
    lean = 1 + t + per
    log_square = np.where(per < 1, np.log(lean) + log_rise, np.log1p((1 + t) / per))
    up = p / 2 * log_square - branch.log_quotient
    above = up > 0
    beside = np.exp(np.minimum(-up, 0)) * rest
    beneath = np.exp(np.minimum(up, 0))
    inside = beneath * -np.expm1(-p / 2 * log_square)
    power = 2 / p * np.where(above, up + np.log1p(beside), np.log1p(inside))
    whole = branch.quotient * lean * np.exp(2 / p * np.log1p(beside)) - per
    growth = np.where(above & (log_square > 1), whole, np.expm1(np.minimum(power, 700)) * per)
    weight = np.where(above, 1 / (1 + beside), beneath / (beneath + rest))
    return growth, (growth + per) / lean * weight


def straight(thrust: ArrayLike, constants: Constants, *, turned: bool = False) -> State:
    """The straight state under N g_3: theta = 0, or pi if turned (section 4.2).

    thrust is N, a force: a number or an array, whose shape the state has. It exists for every N,
    as long as v_3 > 0: a rod that compresses to nothing is refused
    (ValueError). Pulled where N cos(theta) > 0.
    """
    N = np.asarray(thrust, dtype=float)
    cosine = np.full(N.shape, -1.0 if turned else 1.0)
    state = _under_thrust("straight", N, np.zeros(N.shape), cosine, constants)
    return _not_flat(state, "thrust")


def sheared(thrust: ArrayLike, constants: Constants) -> State:
    """The sheared state under N g_3, thrust as of `straight`; raises as `sheared_angle`."""
    N = np.asarray(thrust, dtype=float)
    sine, cosine = _sheared(N, constants)
    return _under_thrust("sheared", N, sine, np.where(N > 0, cosine, -cosine), constants)


def twisted(couple: ArrayLike, constants: Constants) -> State:
    """The straight, twisted state under M g_3 (section 4.3); the helix at theta = 0."""
    return helix(couple, 0.0, constants)


def circle(couple: ArrayLike, constants: Constants) -> State:
    """The state bent into a circle under M g_3 (section 4.3); the helix at theta = pi/2."""
    return helix(couple, math.pi / 2, constants)


def helix(couple: ArrayLike, theta: ArrayLike, constants: Constants) -> State:
    """The helical state about g_3 under M g_3 with the angle theta in [0, pi] (section 4.3).

    couple is M, force times length, and theta in radians: numbers or arrays that broadcast. Every
    couple and angle give one. M and theta stay regular where the paper's M_1 = -M sin theta
    does not, at theta = 0. Raises ValueError for other angles and where v_3 > 0 fails.
    """
    M, angle = np.broadcast_arrays(np.asarray(couple, dtype=float), np.asarray(theta, dtype=float))
    if not ((angle >= 0) & (angle <= math.pi)).all():
        first = float(angle[~((angle >= 0) & (angle <= math.pi))][0])
        raise ValueError(f"theta, the angle of d_3 and g_3, must lie in [0, pi], not {first!r}")
    sine = np.sin(angle)
    cosine = np.where(angle == math.pi / 2, 0.0, np.cos(angle))
    sine = np.where(angle == math.pi, 0.0, sine)
    kind = "twisted" if not sine.any() else "helix" if np.abs(cosine).any() else "circle"
    loads = M * _stack(_axis(sine, cosine))
    u, v = strains(loads, np.zeros_like(loads), constants)
    ratio = float(_bend_over_twist(constants))
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.where(np.abs(sine) > np.abs(cosine), -u[0] / sine, ratio * u[2] / cosine)
    energy = -complementary_energy(loads, np.zeros_like(loads), constants)
    state = State(
        kind, np.zeros(M.shape), M, angle, sine, cosine, turn, u[2] - cosine * turn, u, v, energy
    )
    return _not_flat(state, "couple")


def _bend_over_twist(constants: Constants) -> Fraction:
    """The compliance to bending over that to twist, exactly."""
    exact = (Fraction(getattr(constants, n)) for n in ("alpha", "beta", "eta", "iota"))
    alpha, beta, eta, iota = exact
    return (beta**2 * eta**2 - iota**2) / alpha**2 / eta**2


def _under_thrust(kind: str, N: Array, sine: Array, cosine: Array, c: Constants) -> State:
    """The state under N g_3 at an angle."""
    loads = N * _stack(_axis(sine, cosine))
    none = np.zeros_like(loads)
    u, v = strains(none, loads, c)
    energy = -complementary_energy(none, loads, c) - loads[2]
    theta = np.arctan2(sine, cosine)
    return State(kind, N, np.zeros(N.shape), theta, sine, cosine, np.zeros(N.shape), u[2], u, v,
                 energy)


def _not_flat(state: State, load: str) -> State:
    """The state, if v_3 > 0 in all of it."""
    bad = np.flatnonzero(~(state.v[2] > 0))
    if bad.size:
        first = np.ravel(getattr(state, load))[bad[0]]
        raise ValueError(
            f"no {state.kind} state at {load} = {first}: v_3 > 0 fails, it is"
            f" {np.ravel(state.v[2])[bad[0]]}"
        )
    return state


def equilibria(thrust: float, constants: Constants) -> list[State]:
    """All equilibria under N g_3 without couples, but for turns about g_3; lowest energy first.

    Without a thrust there is one, the rod at rest. Else the straight state that is pulled; the
    straight state that is pushed, unless it would compress to nothing; and above the threshold the
    sheared state, which then has the lowest energy. Raises ValueError if thrust, a number, is not
    finite.
    """
    N = float(thrust)
    if not math.isfinite(N):
        raise ValueError(f"thrust must be finite, not {N}")
    if N == 0:
        return [straight(N, constants)]
    pulled, pushed = N < 0, N > 0
    candidates: Sequence[Callable[[], State]] = (
        lambda: sheared(N, constants),
        lambda: straight(N, constants, turned=pulled),
        lambda: straight(N, constants, turned=pushed),
    )
    found = []
    for state in candidates:
        with suppress(ValueError):
            found.append(state())
    return found
