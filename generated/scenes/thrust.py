"""Strains under an isolated force, without a couple.

Scene thrust, made by: rodproof generate thrust

Without the loads m1, m2, m3; so u1 = 0, u2 = 0; u3 follows by the coupling.

Statements it rests on (paper label, verdict; as corrected if refuted): qstar-form Section 3.1
refuted; const-u-3 eq:u3const proved; const-v-mu eq:vconst proved; const-v-3 eq:v3const proved;
wstar-definition eq:compenergy proved; wstar-gradient Section 3.1 proved; strain-limit
eq:strainlimiting proved.

Domain: loads with finite Q*^(1/2).

One point: tuples of numbers (a float for a single component) are answered with tuples of floats,
in plain Python, where nothing is extreme. They agree with the arrays' answers within 8 ulps of
the largest component, or as far as the inputs determine what grows near the limit.

Operations a point where nothing is extreme: arithmetic, transcendental, energy shares, temporaries
    strains                20    4    0    7
    complementary_energy   29    6    1   10
    compliance             67    4    0   23
    strains_and_gap        22    4    0    7
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
LEAST = 2.0**-1022  # the smallest normal number, for one point
LOW, HIGH = 2.0**-962, 2.0**962  # between them sums of squares lose nothing
DOUBLE = np.dtype(np.float64)
HEADS = {"n": (3,), "u3": (), "v": (3,), "w_star": (), "soft": (3, 3), "limit_gap": ()}


@dataclass(frozen=True)
class Constants:
    """The six constants of the rod, checked on construction (ValueError).

    beta and iota are lengths, gamma is a force, zeta, eta and p are plain numbers; all but iota are
    positive and beta^2 eta^2 - iota^2 > 0.
    """

    beta: float
    zeta: float
    eta: float
    iota: float
    gamma: float
    p: float
    chirality: float = field(init=False, repr=False, compare=False)
    gap: float = field(init=False, repr=False, compare=False)
    n3_dilates: float = field(init=False, repr=False, compare=False)
    per_beta: float = field(init=False, repr=False, compare=False)
    per_zeta: float = field(init=False, repr=False, compare=False)
    per_eta: float = field(init=False, repr=False, compare=False)
    per_p: float = field(init=False, repr=False, compare=False)
    per_gap: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("beta", "zeta", "eta", "iota", "gamma", "p"):
            value = float(getattr(self, name))
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")
            object.__setattr__(self, name, value)
        exact = (Fraction(v) for v in (self.beta, self.zeta, self.eta, self.iota, self.p))
        beta, zeta, eta, iota, p = exact
        if not beta**2 * eta**2 - iota**2 > 0:
            raise ValueError(
                "Constants: beta^2 eta^2 - iota^2 > 0 fails: |iota| must be smaller than beta*eta,"
                f" not beta={self.beta}, eta={self.eta}, iota={self.iota}"
            )
        derived = {
            "chirality": iota / beta / eta,
            "gap": (beta**2 * eta**2 - iota**2) / beta**2 / eta**2,
            "n3_dilates": beta**2 * eta / (beta**2 * eta**2 - iota**2),
            "per_beta": 1 / beta,
            "per_zeta": 1 / zeta,
            "per_eta": 1 / eta,
            "per_p": 1 / p,
            "per_gap": beta**2 * eta**2 / (beta**2 * eta**2 - iota**2),
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
        return (self.per_zeta, self.n3_dilates, self.gap, self.gamma, self.p, -self.per_p)

    @cached_property
    def of_compliance(self) -> tuple[float, ...]:
        """What `compliance` of one point takes."""
        return (
            self.per_zeta, self.n3_dilates, self.gap, self.gamma, self.p, -self.per_p, self.per_eta,
            self.per_zeta**2, self.per_eta**2, self.per_gap,
        )


class Plain:
    """What the plain bodies take, each number rounded once, and the squares where they hold."""

    def __init__(self, c: Constants) -> None:
        beta, gamma, zeta, eta, iota, p = (
            Fraction(v) for v in (c.beta, c.gamma, c.zeta, c.eta, c.iota, c.p)
        )
        self.shear_soft = _rounded(1 / gamma / zeta**2)
        self.n3_extends = _rounded(beta**2 / gamma / (beta**2 * eta**2 - iota**2))
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
            self.shear_soft, self.n3_extends, self.per_gamma, -self.untwist, 0.5 * c.p, -self.per_p,
            *self.room[DOUBLE],
        )
        self.of_strains_and_gap = self.of_strains


def _rounded(ratio: Fraction) -> float:
    """The nearest float; nan far from the ordinary."""
    return float(ratio) if not ratio or 2**-900 < abs(ratio) < 2**900 else math.nan


def _reduce_loads(loads: Rows, c: Constants) -> Rows:
    """Loads over their moduli, the linear rod's strains, and Q* in squares."""
    n1, n2, n3 = loads
    nu_1, nu_2, dilatation = c.per_zeta * n1, c.per_zeta * n2, c.n3_dilates * n3
    twist = -c.chirality * dilatation
    q_star = c.gap * dilatation**2 + nu_1**2 + nu_2**2
    return nu_1, nu_2, dilatation, twist, q_star


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


def _overload(n: Array, c: Constants, u3: Array, v: Array, s: Array) -> Array:
    """Q*/gamma^2 as a sum of squares; the linear rod's strains over gamma in u3 and v."""
    k = c.plain
    x = s[:3]
    np.multiply(k.shear_soft, n[:2], out=v[:2])
    np.multiply(k.n3_extends, n[2], out=v[2])
    np.multiply(n, v, out=x)
    overload: Array = np.add(x[0], x[1], out=s[3])
    overload += x[2]
    overload *= k.per_gamma
    np.multiply(-k.untwist, v[2], out=u3)
    return overload


def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, a row and its mirror image at a time."""
    for i, row in enumerate(vector):
        np.multiply(weight * row, vector[i:], out=matrix[i, i:])
        matrix[i + 1 :, i] = matrix[i, i + 1 :]


def _strains_plain(n: Array, c: Constants, u3: Array, v: Array) -> bool:
    """`_strains` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(4, n)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(n, c, u3, v, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[3])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[3])
    root *= -k.per_p
    np.exp(root, out=root)
    u3 *= root
    v *= root
    v[2] += 1
    return True


def _strains(n: Array, c: Constants, u3: Array, v: Array) -> None:
    """(u3, v - e3) = (gamma^p + Q*^(p/2))^(-1/p) K^-1 n."""
    if _strains_plain(n, c, u3, v):
        return
    loads = [*n]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    nu_1, nu_2, dilatation, twist = values
    *_, factor = _soften(y, c)
    reach = factor * unscale
    turn, shear, extend = c.per_beta * reach, c.per_zeta * reach, c.per_eta * reach
    u3[...] = turn * twist
    v[0], v[1] = nu_1 * shear, nu_2 * shear
    v[2] = dilatation * extend + 1


def _strains_at(n: Any, c: Constants) -> Any:
    """`strains` of floats, where nothing is extreme."""
    (
        shear_soft, n3_extends, per_gamma, minus_untwist, half_p, minus_per_p, low, high,
    ) = c.plain.of_strains
    n1, n2, n3 = n
    w4, w5, extension = shear_soft * n1, shear_soft * n2, n3_extends * n3
    overload = per_gamma * (extension * n3 + n1 * w4 + n2 * w5)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((n1, n2, n3)))
    ):
        raise _Extreme
    twist = minus_untwist * extension
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return root * twist, (root * w4, root * w5, extension * root + 1)


def strains(n: Given, constants: Constants, out: Pair | None = None) -> Pair:
    """Strains u3, v under the loads n (eq:u3const to eq:v3const).

    n (3, ...) in force, with Q*^(1/2) finite.
    Answers u3 (...) in 1/length, v (3, ...) plain; at rest u3 = 0, v = (0, 0, 1).
    """
    if out is None and type(n) is tuple:
        try:
            answer: Pair = _strains_at(n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains, {"n": n}, constants)
        return answer
    u3, v = _apply(_strains, {"n": n}, constants, ("u3", "v"), out)
    return u3, v


def _complementary_energy(n: Array, c: Constants, w_star: Array) -> None:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of the work."""
    loads = [*n]
    _, _, y, _, _ = _balanced(_reduce_loads, loads, c)
    ratio, power, factor = _soften(y, c)
    strain = factor * y
    depth = np.log1p(power) - c.p * np.where(y <= c.gamma, 0.0, np.log(ratio))
    w_star[...] = strain * y * (1 - _work_share(depth, c))


def _complementary_energy_at(n: Any, c: Constants) -> Any:
    """`complementary_energy` of floats, where nothing is extreme."""
    per_zeta, n3_dilates, gap, gamma, p, minus_per_p = c.of_complementary_energy
    n1, n2, n3 = n
    nu_1, nu_2, dilatation = per_zeta * n1, per_zeta * n2, n3_dilates * n3
    q_star = gap * dilatation * dilatation + nu_1 * nu_1 + nu_2 * nu_2
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((n1, n2, n3))):
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


def complementary_energy(n: Given, constants: Constants, out: Array | None = None) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    n (3, ...) in force, with Q*^(1/2) finite.
    """
    if out is None and type(n) is tuple:
        try:
            answer: Array = _complementary_energy_at(n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(complementary_energy, {"n": n}, constants)
        return answer
    (w_star,) = _apply(_complementary_energy, {"n": n}, constants, ("w_star",), out)
    return w_star


def _compliance(n: Array, c: Constants, soft: Array) -> None:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 n/y.

    With (a, b) the reduced load as a unit vector and (c3, c6) the linear rod's reduced strains,
    the entries that would cancel are sums of squares.
    """
    loads = [*n]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    nu_1, nu_2, dilatation, _ = values
    _, power, factor = _soften(y, c)
    tiny = TINY[y.dtype]
    d = np.empty_like(soft[0])
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    per_size = 1 / size
    b1, share = per_size * (nu_1 + tiny), np.where(y <= c.gamma, power, 1.0) / (power + 1)
    bb1 = b1**2
    b2, c6 = nu_2 * per_size, dilatation * per_size
    bb2, cc6 = b2**2, c6**2
    across = bb1 + bb2
    coupled = c.gap * cc6
    steep = -factor * share
    d[0], d[1], d[2] = c.per_zeta * b1, c.per_zeta * b2, c.per_eta * c6
    _spread(soft, steep, d)
    soft[0, 0] = c.per_zeta**2 * factor * (bb1 * remain + bb2 + coupled)
    soft[1, 1] = c.per_zeta**2 * factor * (bb1 + bb2 * remain + coupled)
    soft[2, 2] = c.per_eta**2 * factor * (c.per_gap * across + cc6 * remain)


def _compliance_at(n: Any, c: Constants) -> Any:
    """`compliance` of floats, where nothing is extreme."""
    (
        per_zeta, n3_dilates, gap, gamma, p, minus_per_p, per_eta, per_zeta_squared,
        per_eta_squared, per_gap,
    ) = c.of_compliance
    n1, n2, n3 = n
    nu_1, nu_2, dilatation = per_zeta * n1, per_zeta * n2, n3_dilates * n3
    q_star = gap * dilatation * dilatation + nu_1 * nu_1 + nu_2 * nu_2
    if type(q_star) is not float or (not LOW < q_star < HIGH and any((n1, n2, n3))):
        raise _Extreme
    y = sqrt(q_star)
    larger = y if y > gamma else gamma
    raw_1 = (y if y < gamma else gamma) / larger
    ratio = raw_1 if raw_1 > LEAST else LEAST
    power = ratio**p
    factor = exp(minus_per_p * log1p(power)) / larger
    remain = (1.0 if y <= gamma else power) / (power + 1)
    per_size = 1 / (y if y > LEAST else LEAST)
    b1, share = per_size * (nu_1 + LEAST), (power if y <= gamma else 1.0) / (power + 1)
    bb1 = b1 * b1
    b2, c6, d4 = nu_2 * per_size, dilatation * per_size, per_zeta * b1
    bb2, cc6 = b2 * b2, c6 * c6
    across = bb1 + bb2
    coupled, d5, d6 = gap * cc6, per_zeta * b2, per_eta * c6
    steep = -factor * share
    steep_1, steep_2 = d4 * steep, d5 * steep
    s11, s12 = per_zeta_squared * factor * (bb1 * remain + bb2 + coupled), d5 * steep_1
    s13 = d6 * steep_1
    s22, s23 = per_zeta_squared * factor * (bb1 + bb2 * remain + coupled), d6 * steep_2
    s33 = per_eta_squared * factor * (per_gap * across + cc6 * remain)
    return (
        (s11, s12, s13),
        (s12, s22, s23),
        (s13, s23, s33),
    )


def compliance(n: Given, constants: Constants, out: Array | None = None) -> Array:
    """Compliance d v/d n, (3, 3, ...), symmetric positive definite (Section 3.4).

    n (3, ...) in force, with Q*^(1/2) finite.
    Rows and columns are ordered (v1, v2, v3) and (n1, n2, n3).
    """
    if out is None and type(n) is tuple:
        try:
            answer: Array = _compliance_at(n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(compliance, {"n": n}, constants)
        return answer
    (soft,) = _apply(_compliance, {"n": n}, constants, ("soft",), out)
    return soft


def _strains_and_gap_plain(n: Array, c: Constants, u3: Array, v: Array, limit_gap: Array) -> bool:
    """`_strains_and_gap` where nothing is extreme; else False."""
    k = c.plain
    s = _scratch(4, n)
    with np.errstate(over="ignore", invalid="ignore"):
        overload = _overload(n, c, u3, v, s)
    if not _inside(overload, k.within_overload):
        return False
    excess = np.log(overload, out=s[3])
    excess *= 0.5 * c.p
    np.exp(excess, out=excess)
    root = np.log1p(excess, out=s[0])
    root *= -k.per_p
    np.exp(root, out=root)
    u3 *= root
    v *= root
    v[2] += 1
    np.add(excess, 1, out=limit_gap)
    np.divide(1, limit_gap, out=limit_gap)
    return True


def _strains_and_gap(n: Array, c: Constants, u3: Array, v: Array, limit_gap: Array) -> None:
    """The strains, and 1 - Q^(p/2) = gamma^p/(gamma^p + Q*^(p/2))."""
    if _strains_and_gap_plain(n, c, u3, v, limit_gap):
        return
    loads = [*n]
    values, _, y, unscale, _ = _balanced(_reduce_loads, loads, c)
    nu_1, nu_2, dilatation, twist = values
    _, power, factor = _soften(y, c)
    reach = factor * unscale
    turn, shear, extend = c.per_beta * reach, c.per_zeta * reach, c.per_eta * reach
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    u3[...] = turn * twist
    v[0], v[1] = nu_1 * shear, nu_2 * shear
    v[2] = dilatation * extend + 1
    limit_gap[...] = remain


def _strains_and_gap_at(n: Any, c: Constants) -> Any:
    """`strains_and_gap` of floats, where nothing is extreme."""
    (
        shear_soft, n3_extends, per_gamma, minus_untwist, half_p, minus_per_p, low, high,
    ) = c.plain.of_strains_and_gap
    n1, n2, n3 = n
    w4, w5, extension = shear_soft * n1, shear_soft * n2, n3_extends * n3
    overload = per_gamma * (extension * n3 + n1 * w4 + n2 * w5)
    if type(overload) is not float or (
        not low < overload < high and (overload or low > high or any((n1, n2, n3)))
    ):
        raise _Extreme
    twist = minus_untwist * extension
    excess = overload**half_p
    root = (excess + 1)**minus_per_p
    return root * twist, (root * w4, root * w5, extension * root + 1), 1 / (excess + 1)


def strains_and_gap(n: Given, constants: Constants, out: Triple | None = None) -> Triple:
    """Strains u3, v under the loads n, and 1 - Q^(p/2).

    n (3, ...) in force, with Q*^(1/2) finite.
    Answers u3 (...) in 1/length, v (3, ...) plain, and the gap (...) plain:
    near the limit it says what the strains no longer can.
    """
    if out is None and type(n) is tuple:
        try:
            answer: Triple = _strains_and_gap_at(n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(strains_and_gap, {"n": n}, constants)
        return answer
    u3, v, limit_gap = _apply(_strains_and_gap, {"n": n}, constants, ("u3", "v", "limit_gap"), out)
    return u3, v, limit_gap
