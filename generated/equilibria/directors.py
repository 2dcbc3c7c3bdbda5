"""A rod in equilibrium, by its directors: rates and Jacobian for any integrator.

Made by: rodproof generate

The frame is a quaternion, the couple is in the directors, the center line and the force are in
the fixed basis; no angle, so no place where the equations are singular. The strains come from the
loads, so that no load is too large.

Statements it rests on (verdict; as corrected if refuted): darboux-formula proved,
darboux-components definition, force-balance proved, moment-balance proved,
extra-balance-in-directors proved, const-u-mu proved, const-u-3 proved, const-v-mu proved,
const-v-3 proved, wstar-gradient proved.
"""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from math import exp, log1p, sqrt
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
HEADS = {"m": (3,), "n": (3,), "u": (3,), "v": (3,), "soft": (6, 6)}


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
    def of_compliance(self) -> tuple[float, ...]:
        """What `compliance` of one point takes."""
        return (
            self.per_alpha, self.per_beta, self.per_zeta, self.per_eta, self.m3_contracts,
            self.n3_dilates, self.chirality, self.gap, self.gamma, self.p, -self.per_p,
            self.per_alpha**2, self.per_beta**2, self.per_gap, self.per_beta * self.per_eta,
            self.per_zeta**2, self.per_eta**2,
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
    nu_1, nu_2, nu_3 = c.per_zeta * n1, c.per_zeta * n2, c.per_eta * n3
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    q_star = c.gap * dilatation**2 + mu_1**2 + mu_2**2 + mu_3**2 + nu_1**2 + nu_2**2
    return mu_1, mu_2, mu_3, nu_1, nu_2, dilatation, twist, nu_3, q_star


def _soften(y: Array, c: Constants) -> Rows:
    """Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."""
    tiny = TINY[y.dtype]
    larger = np.maximum(y, c.gamma)
    ratio = np.maximum(np.minimum(y, c.gamma) / larger, tiny)
    power = np.exp(c.p * np.log(ratio))
    factor = np.exp(-c.per_p * np.log1p(power)) / larger
    return power, factor


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


def _spread(matrix: Array, weight: Array, vector: Array) -> None:
    """weight vector vector^T, a row and its mirror image at a time."""
    for i, row in enumerate(vector):
        np.multiply(weight * row, vector[i:], out=matrix[i, i:])
        matrix[i + 1 :, i] = matrix[i, i + 1 :]


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
    mu_1, mu_2, _, nu_1, nu_2, dilatation, twist, _ = values
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


def _compliance(m: Array, n: Array, c: Constants, soft: Array) -> None:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 (m, n)/y.

    With (a, b) the reduced load as a unit vector and (c3, c6) the linear rod's reduced strains,
    the entries that would cancel are sums of squares.
    """
    loads = [*m, *n]
    values, size, y, _, _ = _balanced(_reduce_loads, loads, c)
    mu_1, mu_2, mu_3, nu_1, nu_2, dilatation, twist, nu_3 = values
    power, factor = _soften(y, c)
    tiny = TINY[y.dtype]
    d = np.empty_like(soft[0])
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    per_size = 1 / size
    a1, share = per_size * (mu_1 + tiny), np.where(y <= c.gamma, power, 1.0) / (power + 1)
    aa1 = a1**2
    a2, a3, b1 = mu_2 * per_size, mu_3 * per_size, nu_1 * per_size
    aa2, aa3, bb1 = a2**2, a3**2, b1**2
    b2, b3, c3 = nu_2 * per_size, nu_3 * per_size, per_size * twist
    bb2 = b2**2
    c6 = dilatation * per_size
    cc6 = c6**2
    across = aa1 + aa2 + bb1 + bb2
    coupled = aa3 + c.gap * cc6
    steep = -factor * share
    d[0], d[1], d[2] = c.per_alpha * a1, c.per_alpha * a2, c.per_beta * c3
    d[3], d[4], d[5] = c.per_zeta * b1, c.per_zeta * b2, c.per_eta * c6
    _spread(soft, steep, d)
    soft[0, 0] = c.per_alpha**2 * factor * (aa1 * remain + aa2 + bb1 + bb2 + coupled)
    soft[1, 1] = c.per_alpha**2 * factor * (aa1 + aa2 * remain + bb1 + bb2 + coupled)
    soft[2, 2] = c.per_beta**2 * factor * (c3**2 * remain + c.per_gap * (across + b3**2))
    soft[2, 5] = (
        c.per_beta * c.per_eta * factor
        * (c3 * c6 * remain - c.per_gap * (a3 * b3 + c.chirality * across))
    )
    soft[3, 3] = c.per_zeta**2 * factor * (aa1 + aa2 + bb1 * remain + bb2 + coupled)
    soft[4, 4] = c.per_zeta**2 * factor * (aa1 + aa2 + bb1 + bb2 * remain + coupled)
    soft[5, 5] = c.per_eta**2 * factor * (cc6 * remain + c.per_gap * (aa3 + across))
    soft[5, 2] = soft[2, 5]


def _compliance_at(m: Any, n: Any, c: Constants) -> Any:
    """`compliance` of floats, where nothing is extreme."""
    (
        per_alpha, per_beta, per_zeta, per_eta, m3_contracts, n3_dilates, chirality, gap, gamma, p,
        minus_per_p, per_alpha_squared, per_beta_squared, per_gap, per_beta_per_eta,
        per_zeta_squared, per_eta_squared,
    ) = c.of_compliance
    m1, m2, m3 = m
    n1, n2, n3 = n
    mu_1, mu_2, mu_3 = per_alpha * m1, per_alpha * m2, per_beta * m3
    nu_1, nu_2, nu_3 = per_zeta * n1, per_zeta * n2, per_eta * n3
    dilatation = n3_dilates * n3 - m3_contracts * m3
    twist = mu_3 - chirality * dilatation
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
    remain = (1.0 if y <= gamma else power) / (power + 1)
    per_size = 1 / (y if y > LEAST else LEAST)
    a1, share = per_size * (mu_1 + LEAST), (power if y <= gamma else 1.0) / (power + 1)
    aa1 = a1 * a1
    a2, a3, b1 = mu_2 * per_size, mu_3 * per_size, nu_1 * per_size
    aa2, aa3, bb1 = a2 * a2, a3 * a3, b1 * b1
    b2, b3, c3 = nu_2 * per_size, nu_3 * per_size, per_size * twist
    bb2 = b2 * b2
    c6, d1, d2 = dilatation * per_size, per_alpha * a1, per_alpha * a2
    cc6 = c6 * c6
    across = aa1 + aa2 + bb1 + bb2
    coupled = aa3 + gap * cc6
    steep = -factor * share
    d3, d4, d5 = per_beta * c3, per_zeta * b1, per_zeta * b2
    d6, steep_1, steep_2 = per_eta * c6, d1 * steep, d2 * steep
    steep_3, steep_4, steep_5 = d3 * steep, d4 * steep, d5 * steep
    s11, s12 = per_alpha_squared * factor * (aa1 * remain + aa2 + bb1 + bb2 + coupled), d2 * steep_1
    s13, s14, s15 = d3 * steep_1, d4 * steep_1, d5 * steep_1
    s16 = d6 * steep_1
    s22, s23 = per_alpha_squared * factor * (aa1 + aa2 * remain + bb1 + bb2 + coupled), d3 * steep_2
    s24, s25, s26 = d4 * steep_2, d5 * steep_2, d6 * steep_2
    s33 = per_beta_squared * factor * (c3 * c3 * remain + per_gap * (across + b3 * b3))
    s34, s35 = d4 * steep_3, d5 * steep_3
    s36 = per_beta_per_eta * factor * (c3 * c6 * remain - per_gap * (a3 * b3 + chirality * across))
    s44, s45 = per_zeta_squared * factor * (aa1 + aa2 + bb1 * remain + bb2 + coupled), d5 * steep_4
    s46 = d6 * steep_4
    s55, s56 = per_zeta_squared * factor * (aa1 + aa2 + bb1 + bb2 * remain + coupled), d6 * steep_5
    s66 = per_eta_squared * factor * (cc6 * remain + per_gap * (aa3 + across))
    return (
        (s11, s12, s13, s14, s15, s16),
        (s12, s22, s23, s24, s25, s26),
        (s13, s23, s33, s34, s35, s36),
        (s14, s24, s34, s44, s45, s46),
        (s15, s25, s35, s45, s55, s56),
        (s16, s26, s36, s46, s56, s66),
    )


def compliance(m: Given, n: Given, constants: Constants, out: Array | None = None) -> Array:
    """Compliance d(u, v)/d(m, n), (6, 6, ...), the inverse of the stiffness at these loads.

    m (3, ...) in force times length, n (3, ...) in force, with Q*^(1/2) finite.
    Rows and columns are ordered (u1, u2, u3, v1, v2, v3) and (m1, m2, m3, n1, n2, n3).
    """
    if out is None and type(m) is type(n) is tuple:
        try:
            answer: Array = _compliance_at(m, n, constants)
        except (ArithmeticError, TypeError, ValueError):
            answer = _one(compliance, {"m": m, "n": n}, constants)
        return answer
    (soft,) = _apply(_compliance, {"m": m, "n": n}, constants, ("soft",), out)
    return soft


Number = Any  # a float or an array
Numbers = Sequence[Any]  # one for each component
Field = ArrayLike | Callable[[Any], ArrayLike]  # constant, at every s, or of s


def _linear_strains(loads: Numbers, c: Constants) -> Numbers:
    """(u, v) = K^-1 (m, n)/gamma + (0, e3): the law at rest, for every load."""
    m1, m2, m3, n1, n2, n3 = loads
    mu_1 = c.per_alpha * m1
    mu_2 = c.per_alpha * m2
    mu_3 = c.per_beta * m3
    nu_1 = c.per_zeta * n1
    nu_2 = c.per_zeta * n2
    dilatation = c.n3_dilates * n3 - c.m3_contracts * m3
    twist = mu_3 - c.chirality * dilatation
    return (
        c.per_alpha * mu_1 / c.gamma,
        c.per_alpha * mu_2 / c.gamma,
        c.per_beta * twist / c.gamma,
        c.per_zeta * nu_1 / c.gamma,
        c.per_zeta * nu_2 / c.gamma,
        c.per_eta * dilatation / c.gamma + 1,
    )


def _linear_compliance(c: Constants) -> Numbers:
    """K^-1/gamma, the entries on and above the diagonal, row by row."""
    return (
        c.per_alpha**2 / c.gamma,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        c.per_alpha**2 / c.gamma,
        0.0,
        0.0,
        0.0,
        0.0,
        c.per_beta**2 * c.per_gap / c.gamma,
        0.0,
        0.0,
        -c.chirality * c.per_beta * c.per_eta * c.per_gap / c.gamma,
        c.per_zeta**2 / c.gamma,
        0.0,
        0.0,
        c.per_zeta**2 / c.gamma,
        0.0,
        c.per_eta**2 * c.per_gap / c.gamma,
    )


def _frame(q: Numbers) -> Numbers:
    """The directors' components d_k . g_i, all of d_1 first: the columns of R(q), any |q| > 0."""
    q0, q1, q2, q3 = q
    q00 = q0**2
    q11 = q1**2
    q22 = q2**2
    q33 = q3**2
    per_norm = 1 / (q00 + q11 + q22 + q33)
    return (
        per_norm * (q00 + q11 - q22 - q33),
        2 * per_norm * (q0 * q3 + q1 * q2),
        2 * per_norm * (q1 * q3 - q0 * q2),
        2 * per_norm * (q1 * q2 - q0 * q3),
        per_norm * (q00 + q22 - q11 - q33),
        2 * per_norm * (q0 * q1 + q2 * q3),
        2 * per_norm * (q0 * q2 + q1 * q3),
        2 * per_norm * (q2 * q3 - q0 * q1),
        per_norm * (q00 + q33 - q11 - q22),
    )


def _in_directors(d: Numbers, a: Numbers) -> Numbers:
    """The components in the directors of a vector given in the fixed basis."""
    d1_1, d1_2, d1_3, d2_1, d2_2, d2_3, d3_1, d3_2, d3_3 = d
    a1, a2, a3 = a
    return (
        a1 * d1_1 + a2 * d1_2 + a3 * d1_3,
        a1 * d2_1 + a2 * d2_2 + a3 * d2_3,
        a1 * d3_1 + a2 * d3_2 + a3 * d3_3,
    )


def _rates(
    q: Numbers, m: Numbers, d: Numbers, n: Numbers, b: Numbers, u: Numbers, v: Numbers
) -> Numbers:
    """q', m', r'; n and b are the force and the body couple in the directors."""
    q0, q1, q2, q3 = q
    m1, m2, m3 = m
    d1_1, d1_2, d1_3, d2_1, d2_2, d2_3, d3_1, d3_2, d3_3 = d
    n1, n2, n3 = n
    b1, b2, b3 = b
    u1, u2, u3 = u
    v1, v2, v3 = v
    return (
        -0.5 * (q1 * u1 + q2 * u2 + q3 * u3),
        0.5 * (q0 * u1 + q2 * u3 - q3 * u2),
        0.5 * (q0 * u2 + q3 * u1 - q1 * u3),
        0.5 * (q0 * u3 + q1 * u2 - q2 * u1),
        m2 * u3 + n2 * v3 - b1 - m3 * u2 - n3 * v2,
        m3 * u1 + n3 * v1 - b2 - m1 * u3 - n1 * v3,
        m1 * u2 + n1 * v2 - b3 - m2 * u1 - n2 * v1,
        d1_1 * v1 + d2_1 * v2 + d3_1 * v3,
        d1_2 * v1 + d2_2 * v2 + d3_2 * v3,
        d1_3 * v1 + d2_3 * v2 + d3_3 * v3,
    )


BY_STATE = (
    (0, 0), (1, 0), (2, 0), (3, 0), (4, 0), (5, 0), (6, 0), (7, 0), (8, 0), (9, 0), (0, 1), (1, 1),
    (2, 1), (3, 1), (4, 1), (5, 1), (6, 1), (7, 1), (8, 1), (9, 1), (0, 2), (1, 2), (2, 2), (3, 2),
    (4, 2), (5, 2), (6, 2), (7, 2), (8, 2), (9, 2), (0, 3), (1, 3), (2, 3), (3, 3), (4, 3), (5, 3),
    (6, 3), (7, 3), (8, 3), (9, 3), (0, 4), (1, 4), (2, 4), (3, 4), (4, 4), (5, 4), (6, 4), (7, 4),
    (8, 4), (9, 4), (0, 5), (1, 5), (2, 5), (3, 5), (4, 5), (5, 5), (6, 5), (7, 5), (8, 5), (9, 5),
    (0, 6), (1, 6), (2, 6), (3, 6), (4, 6), (5, 6), (6, 6), (7, 6), (8, 6), (9, 6),
)


def _by_state(
    q: Numbers,
    m: Numbers,
    d: Numbers,
    n: Numbers,
    b: Numbers,
    u: Numbers,
    v: Numbers,
    soft: Numbers,
) -> Numbers:
    """Entries of the derivative of q', m', r' by q and m."""
    q0, q1, q2, q3 = q
    m1, m2, m3 = m
    d1_1, d1_2, d1_3, d2_1, d2_2, d2_3, d3_1, d3_2, d3_3 = d
    n1, n2, n3 = n
    b1, b2, b3 = b
    u1, u2, u3 = u
    v1, v2, v3 = v
    (
        soft11, soft12, soft13, soft14, soft15, soft16, soft22, soft23, soft24, soft25, soft26,
        soft33, soft34, soft35, soft36, soft44, soft45, soft46, soft55, soft56, soft66,
    ) = soft
    per_norm = 1 / (q0**2 + q1**2 + q2**2 + q3**2)
    w0 = 2 * per_norm * q0
    w1 = 2 * per_norm * q1
    w2 = 2 * per_norm * q2
    w3 = 2 * per_norm * q3
    n1_q0 = n3 * w2 - n2 * w3
    n1_q1 = n2 * w2 + n3 * w3
    n1_q2 = -(n2 * w1 + n3 * w0)
    n1_q3 = n2 * w0 - n3 * w1
    n2_q0 = n1 * w3 - n3 * w1
    n2_q1 = n3 * w0 - n1 * w2
    n2_q2 = n1 * w1 + n3 * w3
    n2_q3 = -(n1 * w0 + n3 * w2)
    n3_q0 = n2 * w1 - n1 * w2
    n3_q1 = -(n1 * w3 + n2 * w0)
    n3_q2 = n1 * w0 - n2 * w3
    n3_q3 = n1 * w1 + n2 * w2
    b1_q0 = b3 * w2 - b2 * w3
    b1_q1 = b2 * w2 + b3 * w3
    b1_q2 = -(b2 * w1 + b3 * w0)
    b1_q3 = b2 * w0 - b3 * w1
    b2_q0 = b1 * w3 - b3 * w1
    b2_q1 = b3 * w0 - b1 * w2
    b2_q2 = b1 * w1 + b3 * w3
    b2_q3 = -(b1 * w0 + b3 * w2)
    b3_q0 = b2 * w1 - b1 * w2
    b3_q1 = -(b1 * w3 + b2 * w0)
    b3_q2 = b1 * w0 - b2 * w3
    b3_q3 = b1 * w1 + b2 * w2
    u1_q0 = n1_q0 * soft14 + n2_q0 * soft15 + n3_q0 * soft16
    u1_q1 = n1_q1 * soft14 + n2_q1 * soft15 + n3_q1 * soft16
    u1_q2 = n1_q2 * soft14 + n2_q2 * soft15 + n3_q2 * soft16
    u1_q3 = n1_q3 * soft14 + n2_q3 * soft15 + n3_q3 * soft16
    u2_q0 = n1_q0 * soft24 + n2_q0 * soft25 + n3_q0 * soft26
    u2_q1 = n1_q1 * soft24 + n2_q1 * soft25 + n3_q1 * soft26
    u2_q2 = n1_q2 * soft24 + n2_q2 * soft25 + n3_q2 * soft26
    u2_q3 = n1_q3 * soft24 + n2_q3 * soft25 + n3_q3 * soft26
    u3_q0 = n1_q0 * soft34 + n2_q0 * soft35 + n3_q0 * soft36
    u3_q1 = n1_q1 * soft34 + n2_q1 * soft35 + n3_q1 * soft36
    u3_q2 = n1_q2 * soft34 + n2_q2 * soft35 + n3_q2 * soft36
    u3_q3 = n1_q3 * soft34 + n2_q3 * soft35 + n3_q3 * soft36
    v1_q0 = n1_q0 * soft44 + n2_q0 * soft45 + n3_q0 * soft46
    v1_q1 = n1_q1 * soft44 + n2_q1 * soft45 + n3_q1 * soft46
    v1_q2 = n1_q2 * soft44 + n2_q2 * soft45 + n3_q2 * soft46
    v1_q3 = n1_q3 * soft44 + n2_q3 * soft45 + n3_q3 * soft46
    v2_q0 = n1_q0 * soft45 + n2_q0 * soft55 + n3_q0 * soft56
    v2_q1 = n1_q1 * soft45 + n2_q1 * soft55 + n3_q1 * soft56
    v2_q2 = n1_q2 * soft45 + n2_q2 * soft55 + n3_q2 * soft56
    v2_q3 = n1_q3 * soft45 + n2_q3 * soft55 + n3_q3 * soft56
    v3_q0 = n1_q0 * soft46 + n2_q0 * soft56 + n3_q0 * soft66
    v3_q1 = n1_q1 * soft46 + n2_q1 * soft56 + n3_q1 * soft66
    v3_q2 = n1_q2 * soft46 + n2_q2 * soft56 + n3_q2 * soft66
    v3_q3 = n1_q3 * soft46 + n2_q3 * soft56 + n3_q3 * soft66
    return (
        -0.5 * (q1 * u1_q0 + q2 * u2_q0 + q3 * u3_q0),
        0.5 * (q0 * u1_q0 + q2 * u3_q0 + u1 - q3 * u2_q0),
        0.5 * (q0 * u2_q0 + q3 * u1_q0 + u2 - q1 * u3_q0),
        0.5 * (q0 * u3_q0 + q1 * u2_q0 + u3 - q2 * u1_q0),
        m2 * u3_q0 + n2 * v3_q0 + n2_q0 * v3 - b1_q0 - m3 * u2_q0 - n3 * v2_q0 - n3_q0 * v2,
        m3 * u1_q0 + n3 * v1_q0 + n3_q0 * v1 - b2_q0 - m1 * u3_q0 - n1 * v3_q0 - n1_q0 * v3,
        m1 * u2_q0 + n1 * v2_q0 + n1_q0 * v2 - b3_q0 - m2 * u1_q0 - n2 * v1_q0 - n2_q0 * v1,
        (
            d1_1 * v1_q0
            + d2_1 * v2_q0
            + d3_1 * v3_q0
            - w1 * (d3_1 * v2 - d2_1 * v3)
            - w2 * (d1_1 * v3 - d3_1 * v1)
            - w3 * (d2_1 * v1 - d1_1 * v2)
        ),
        (
            d1_2 * v1_q0
            + d2_2 * v2_q0
            + d3_2 * v3_q0
            - w1 * (d3_2 * v2 - d2_2 * v3)
            - w2 * (d1_2 * v3 - d3_2 * v1)
            - w3 * (d2_2 * v1 - d1_2 * v2)
        ),
        (
            d1_3 * v1_q0
            + d2_3 * v2_q0
            + d3_3 * v3_q0
            - w1 * (d3_3 * v2 - d2_3 * v3)
            - w2 * (d1_3 * v3 - d3_3 * v1)
            - w3 * (d2_3 * v1 - d1_3 * v2)
        ),
        -0.5 * (q1 * u1_q1 + q2 * u2_q1 + q3 * u3_q1 + u1),
        0.5 * (q0 * u1_q1 + q2 * u3_q1 - q3 * u2_q1),
        0.5 * (q0 * u2_q1 + q3 * u1_q1 - q1 * u3_q1 - u3),
        0.5 * (q0 * u3_q1 + q1 * u2_q1 + u2 - q2 * u1_q1),
        m2 * u3_q1 + n2 * v3_q1 + n2_q1 * v3 - b1_q1 - m3 * u2_q1 - n3 * v2_q1 - n3_q1 * v2,
        m3 * u1_q1 + n3 * v1_q1 + n3_q1 * v1 - b2_q1 - m1 * u3_q1 - n1 * v3_q1 - n1_q1 * v3,
        m1 * u2_q1 + n1 * v2_q1 + n1_q1 * v2 - b3_q1 - m2 * u1_q1 - n2 * v1_q1 - n2_q1 * v1,
        (
            d1_1 * v1_q1
            + d2_1 * v2_q1
            + d3_1 * v3_q1
            + w0 * (d3_1 * v2 - d2_1 * v3)
            + w2 * (d2_1 * v1 - d1_1 * v2)
            - w3 * (d1_1 * v3 - d3_1 * v1)
        ),
        (
            d1_2 * v1_q1
            + d2_2 * v2_q1
            + d3_2 * v3_q1
            + w0 * (d3_2 * v2 - d2_2 * v3)
            + w2 * (d2_2 * v1 - d1_2 * v2)
            - w3 * (d1_2 * v3 - d3_2 * v1)
        ),
        (
            d1_3 * v1_q1
            + d2_3 * v2_q1
            + d3_3 * v3_q1
            + w0 * (d3_3 * v2 - d2_3 * v3)
            + w2 * (d2_3 * v1 - d1_3 * v2)
            - w3 * (d1_3 * v3 - d3_3 * v1)
        ),
        -0.5 * (q1 * u1_q2 + q2 * u2_q2 + q3 * u3_q2 + u2),
        0.5 * (q0 * u1_q2 + q2 * u3_q2 + u3 - q3 * u2_q2),
        0.5 * (q0 * u2_q2 + q3 * u1_q2 - q1 * u3_q2),
        0.5 * (q0 * u3_q2 + q1 * u2_q2 - q2 * u1_q2 - u1),
        m2 * u3_q2 + n2 * v3_q2 + n2_q2 * v3 - b1_q2 - m3 * u2_q2 - n3 * v2_q2 - n3_q2 * v2,
        m3 * u1_q2 + n3 * v1_q2 + n3_q2 * v1 - b2_q2 - m1 * u3_q2 - n1 * v3_q2 - n1_q2 * v3,
        m1 * u2_q2 + n1 * v2_q2 + n1_q2 * v2 - b3_q2 - m2 * u1_q2 - n2 * v1_q2 - n2_q2 * v1,
        (
            d1_1 * v1_q2
            + d2_1 * v2_q2
            + d3_1 * v3_q2
            + w0 * (d1_1 * v3 - d3_1 * v1)
            + w3 * (d3_1 * v2 - d2_1 * v3)
            - w1 * (d2_1 * v1 - d1_1 * v2)
        ),
        (
            d1_2 * v1_q2
            + d2_2 * v2_q2
            + d3_2 * v3_q2
            + w0 * (d1_2 * v3 - d3_2 * v1)
            + w3 * (d3_2 * v2 - d2_2 * v3)
            - w1 * (d2_2 * v1 - d1_2 * v2)
        ),
        (
            d1_3 * v1_q2
            + d2_3 * v2_q2
            + d3_3 * v3_q2
            + w0 * (d1_3 * v3 - d3_3 * v1)
            + w3 * (d3_3 * v2 - d2_3 * v3)
            - w1 * (d2_3 * v1 - d1_3 * v2)
        ),
        -0.5 * (q1 * u1_q3 + q2 * u2_q3 + q3 * u3_q3 + u3),
        0.5 * (q0 * u1_q3 + q2 * u3_q3 - q3 * u2_q3 - u2),
        0.5 * (q0 * u2_q3 + q3 * u1_q3 + u1 - q1 * u3_q3),
        0.5 * (q0 * u3_q3 + q1 * u2_q3 - q2 * u1_q3),
        m2 * u3_q3 + n2 * v3_q3 + n2_q3 * v3 - b1_q3 - m3 * u2_q3 - n3 * v2_q3 - n3_q3 * v2,
        m3 * u1_q3 + n3 * v1_q3 + n3_q3 * v1 - b2_q3 - m1 * u3_q3 - n1 * v3_q3 - n1_q3 * v3,
        m1 * u2_q3 + n1 * v2_q3 + n1_q3 * v2 - b3_q3 - m2 * u1_q3 - n2 * v1_q3 - n2_q3 * v1,
        (
            d1_1 * v1_q3
            + d2_1 * v2_q3
            + d3_1 * v3_q3
            + w0 * (d2_1 * v1 - d1_1 * v2)
            + w1 * (d1_1 * v3 - d3_1 * v1)
            - w2 * (d3_1 * v2 - d2_1 * v3)
        ),
        (
            d1_2 * v1_q3
            + d2_2 * v2_q3
            + d3_2 * v3_q3
            + w0 * (d2_2 * v1 - d1_2 * v2)
            + w1 * (d1_2 * v3 - d3_2 * v1)
            - w2 * (d3_2 * v2 - d2_2 * v3)
        ),
        (
            d1_3 * v1_q3
            + d2_3 * v2_q3
            + d3_3 * v3_q3
            + w0 * (d2_3 * v1 - d1_3 * v2)
            + w1 * (d1_3 * v3 - d3_3 * v1)
            - w2 * (d3_3 * v2 - d2_3 * v3)
        ),
        -0.5 * (q1 * soft11 + q2 * soft12 + q3 * soft13),
        0.5 * (q0 * soft11 + q2 * soft13 - q3 * soft12),
        0.5 * (q0 * soft12 + q3 * soft11 - q1 * soft13),
        0.5 * (q0 * soft13 + q1 * soft12 - q2 * soft11),
        m2 * soft13 + n2 * soft16 - m3 * soft12 - n3 * soft15,
        m3 * soft11 + n3 * soft14 - m1 * soft13 - n1 * soft16 - u3,
        m1 * soft12 + n1 * soft15 + u2 - m2 * soft11 - n2 * soft14,
        d1_1 * soft14 + d2_1 * soft15 + d3_1 * soft16,
        d1_2 * soft14 + d2_2 * soft15 + d3_2 * soft16,
        d1_3 * soft14 + d2_3 * soft15 + d3_3 * soft16,
        -0.5 * (q1 * soft12 + q2 * soft22 + q3 * soft23),
        0.5 * (q0 * soft12 + q2 * soft23 - q3 * soft22),
        0.5 * (q0 * soft22 + q3 * soft12 - q1 * soft23),
        0.5 * (q0 * soft23 + q1 * soft22 - q2 * soft12),
        m2 * soft23 + n2 * soft26 + u3 - m3 * soft22 - n3 * soft25,
        m3 * soft12 + n3 * soft24 - m1 * soft23 - n1 * soft26,
        m1 * soft22 + n1 * soft25 - m2 * soft12 - n2 * soft24 - u1,
        d1_1 * soft24 + d2_1 * soft25 + d3_1 * soft26,
        d1_2 * soft24 + d2_2 * soft25 + d3_2 * soft26,
        d1_3 * soft24 + d2_3 * soft25 + d3_3 * soft26,
        -0.5 * (q1 * soft13 + q2 * soft23 + q3 * soft33),
        0.5 * (q0 * soft13 + q2 * soft33 - q3 * soft23),
        0.5 * (q0 * soft23 + q3 * soft13 - q1 * soft33),
        0.5 * (q0 * soft33 + q1 * soft23 - q2 * soft13),
        m2 * soft33 + n2 * soft36 - m3 * soft23 - n3 * soft35 - u2,
        m3 * soft13 + n3 * soft34 + u1 - m1 * soft33 - n1 * soft36,
        m1 * soft23 + n1 * soft35 - m2 * soft13 - n2 * soft34,
        d1_1 * soft34 + d2_1 * soft35 + d3_1 * soft36,
        d1_2 * soft34 + d2_2 * soft35 + d3_2 * soft36,
        d1_3 * soft34 + d2_3 * soft35 + d3_3 * soft36,
    )


BY_FORCE = (
    (0, 10), (1, 10), (2, 10), (3, 10), (4, 10), (5, 10), (6, 10), (7, 10), (8, 10), (9, 10),
    (0, 11), (1, 11), (2, 11), (3, 11), (4, 11), (5, 11), (6, 11), (7, 11), (8, 11), (9, 11),
    (0, 12), (1, 12), (2, 12), (3, 12), (4, 12), (5, 12), (6, 12), (7, 12), (8, 12), (9, 12),
)


def _by_force(q: Numbers, m: Numbers, d: Numbers, n: Numbers, v: Numbers, soft: Numbers) -> Numbers:
    """Entries of the derivative of q', m', r' by the force."""
    q0, q1, q2, q3 = q
    m1, m2, m3 = m
    d1_1, d1_2, d1_3, d2_1, d2_2, d2_3, d3_1, d3_2, d3_3 = d
    n1, n2, n3 = n
    v1, v2, v3 = v
    (
        _, _, _, soft14, soft15, soft16, _, _, soft24, soft25, soft26, _, soft34, soft35, soft36,
        soft44, soft45, soft46, soft55, soft56, soft66,
    ) = soft
    u1_g1 = d1_1 * soft14 + d2_1 * soft15 + d3_1 * soft16
    u1_g2 = d1_2 * soft14 + d2_2 * soft15 + d3_2 * soft16
    u1_g3 = d1_3 * soft14 + d2_3 * soft15 + d3_3 * soft16
    u2_g1 = d1_1 * soft24 + d2_1 * soft25 + d3_1 * soft26
    u2_g2 = d1_2 * soft24 + d2_2 * soft25 + d3_2 * soft26
    u2_g3 = d1_3 * soft24 + d2_3 * soft25 + d3_3 * soft26
    u3_g1 = d1_1 * soft34 + d2_1 * soft35 + d3_1 * soft36
    u3_g2 = d1_2 * soft34 + d2_2 * soft35 + d3_2 * soft36
    u3_g3 = d1_3 * soft34 + d2_3 * soft35 + d3_3 * soft36
    v1_g1 = d1_1 * soft44 + d2_1 * soft45 + d3_1 * soft46
    v1_g2 = d1_2 * soft44 + d2_2 * soft45 + d3_2 * soft46
    v1_g3 = d1_3 * soft44 + d2_3 * soft45 + d3_3 * soft46
    v2_g1 = d1_1 * soft45 + d2_1 * soft55 + d3_1 * soft56
    v2_g2 = d1_2 * soft45 + d2_2 * soft55 + d3_2 * soft56
    v2_g3 = d1_3 * soft45 + d2_3 * soft55 + d3_3 * soft56
    v3_g1 = d1_1 * soft46 + d2_1 * soft56 + d3_1 * soft66
    v3_g2 = d1_2 * soft46 + d2_2 * soft56 + d3_2 * soft66
    v3_g3 = d1_3 * soft46 + d2_3 * soft56 + d3_3 * soft66
    return (
        -0.5 * (q1 * u1_g1 + q2 * u2_g1 + q3 * u3_g1),
        0.5 * (q0 * u1_g1 + q2 * u3_g1 - q3 * u2_g1),
        0.5 * (q0 * u2_g1 + q3 * u1_g1 - q1 * u3_g1),
        0.5 * (q0 * u3_g1 + q1 * u2_g1 - q2 * u1_g1),
        d2_1 * v3 + m2 * u3_g1 + n2 * v3_g1 - d3_1 * v2 - m3 * u2_g1 - n3 * v2_g1,
        d3_1 * v1 + m3 * u1_g1 + n3 * v1_g1 - d1_1 * v3 - m1 * u3_g1 - n1 * v3_g1,
        d1_1 * v2 + m1 * u2_g1 + n1 * v2_g1 - d2_1 * v1 - m2 * u1_g1 - n2 * v1_g1,
        d1_1 * v1_g1 + d2_1 * v2_g1 + d3_1 * v3_g1,
        d1_2 * v1_g1 + d2_2 * v2_g1 + d3_2 * v3_g1,
        d1_3 * v1_g1 + d2_3 * v2_g1 + d3_3 * v3_g1,
        -0.5 * (q1 * u1_g2 + q2 * u2_g2 + q3 * u3_g2),
        0.5 * (q0 * u1_g2 + q2 * u3_g2 - q3 * u2_g2),
        0.5 * (q0 * u2_g2 + q3 * u1_g2 - q1 * u3_g2),
        0.5 * (q0 * u3_g2 + q1 * u2_g2 - q2 * u1_g2),
        d2_2 * v3 + m2 * u3_g2 + n2 * v3_g2 - d3_2 * v2 - m3 * u2_g2 - n3 * v2_g2,
        d3_2 * v1 + m3 * u1_g2 + n3 * v1_g2 - d1_2 * v3 - m1 * u3_g2 - n1 * v3_g2,
        d1_2 * v2 + m1 * u2_g2 + n1 * v2_g2 - d2_2 * v1 - m2 * u1_g2 - n2 * v1_g2,
        d1_1 * v1_g2 + d2_1 * v2_g2 + d3_1 * v3_g2,
        d1_2 * v1_g2 + d2_2 * v2_g2 + d3_2 * v3_g2,
        d1_3 * v1_g2 + d2_3 * v2_g2 + d3_3 * v3_g2,
        -0.5 * (q1 * u1_g3 + q2 * u2_g3 + q3 * u3_g3),
        0.5 * (q0 * u1_g3 + q2 * u3_g3 - q3 * u2_g3),
        0.5 * (q0 * u2_g3 + q3 * u1_g3 - q1 * u3_g3),
        0.5 * (q0 * u3_g3 + q1 * u2_g3 - q2 * u1_g3),
        d2_3 * v3 + m2 * u3_g3 + n2 * v3_g3 - d3_3 * v2 - m3 * u2_g3 - n3 * v2_g3,
        d3_3 * v1 + m3 * u1_g3 + n3 * v1_g3 - d1_3 * v3 - m1 * u3_g3 - n1 * v3_g3,
        d1_3 * v2 + m1 * u2_g3 + n1 * v2_g3 - d2_3 * v1 - m2 * u1_g3 - n2 * v1_g3,
        d1_1 * v1_g3 + d2_1 * v2_g3 + d3_1 * v3_g3,
        d1_2 * v1_g3 + d2_2 * v2_g3 + d3_2 * v3_g3,
        d1_3 * v1_g3 + d2_3 * v2_g3 + d3_3 * v3_g3,
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


def _rows(name: str, value: ArrayLike, lengths: tuple[int, ...]) -> Numbers:
    """The components of an array: floats where it has one axis, else arrays."""
    array = np.asarray(value, dtype=float)
    if array.ndim == 0 or len(array) not in lengths:
        wanted = " or ".join(f"({length}, ...)" for length in lengths)
        raise ValueError(f"{name} must have the shape {wanted}, not {array.shape}")
    rows: Numbers = array.tolist() if array.ndim == 1 else list(array)
    return rows


def _law(m: Numbers, n: Numbers, c: Constants, linear: bool) -> tuple[Numbers, Numbers]:
    """The strains u and v under the loads."""
    if linear:
        found = _linear_strains((*m, *n), c)
        return found[:3], found[3:]
    u, v = strains(*_given(m, n), c)
    return u, v  # type: ignore[return-value]


def _given(m: Numbers, n: Numbers) -> tuple[Any, Any]:
    """Loads as the law takes them: of one rod as tuples, which is quick, of many as arrays."""
    if all(type(x) is float for x in (*m, *n)):
        return tuple(m), tuple(n)
    return _stack(m), _stack(n)


def _tangent(m: Numbers, n: Numbers, c: Constants, linear: bool) -> Numbers:
    """The entries of d(u, v)/d(m, n) on and above the diagonal, row by row."""
    if linear:
        return _linear_compliance(c)
    soft = compliance(*_given(m, n), c)
    return [soft[i][j] for i in range(6) for j in range(i, 6)]


def _matrix(size: int, entries: Sequence[tuple[int, int]], values: Numbers) -> Array:
    """A matrix of ``size`` rows from the entries that are not zero."""
    shapes = [value.shape for value in values if isinstance(value, np.ndarray)]
    out = np.zeros((size, size, *np.broadcast_shapes(*shapes)))
    for (i, j), value in zip(entries, values, strict=True):
        if i < size:
            out[i, j] = value
    return out


def _first(bad: Number, name: str, values: Numbers) -> str:
    """These rows of the first state that is refused, and of many states, which and how many."""
    place = tuple(map(int, np.argwhere(bad)[0]))
    numbers = ", ".join(repr(float(np.asarray(value)[place])) for value in values)
    said = f"{name} = {numbers}"
    if not place:
        return said
    where = f"state[:, {', '.join(map(str, place))}]"
    return f"{said} in {where}, the first of {np.sum(bad)} such of {np.size(bad)} states"


def _field(name: str, value: Field | None, s: Any) -> Numbers:
    """The components at s of a vector that is constant, given at every s, or a function of s."""
    if value is None:
        return 0.0, 0.0, 0.0
    return _rows(name, value(s) if callable(value) else value, (3,))


def _loads_at(
    s: Any, state: ArrayLike, force: Field | None
) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """Quaternion, couple, frame and force in the directors; which rows the state has is checked."""
    x = _rows("state", state, (10, 13))
    if (len(x) == 13) != (force is None):
        raise ValueError(
            "a state of 10 rows needs the force; one of 13 carries it in its last three"
            f" (here: {len(x)} rows, force {'not ' if force is None else ''}given)"
        )
    _has_a_norm(x[:4])
    d = _frame(x[:4])
    n = x[10:] if force is None else _field("force", force, s)
    return x[:4], x[4:7], d, _in_directors(d, n)


def _has_a_norm(q: Numbers) -> None:
    """Refuses a quaternion whose squared norm is zero or no float; one with a nan passes."""
    if isinstance(q[0], float):
        square: Number = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
        if 1e-300 < square < 1e300:
            return
    else:
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):
            square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    bad = np.less_equal(square, 1e-300) | np.greater_equal(square, 1e300)
    if np.any(bad):
        raise ValueError(
            f"the quaternion of the frame needs 1e-150 < |q| < 1e150: {_first(bad, 'q', q)}; any"
            " multiple of q is the same frame, divide it by its norm. If an integrator made it, its"
            " step was too large, ask for a smaller max_step or tolerance"
        )


def frame(state: ArrayLike) -> Array:
    """The directors, (3, 3, ...): column k - 1 is d_k in the fixed basis.

    state (10, ...) or (13, ...) as in `rates`; its quaternion need not be of norm one, but between
    1e-150 and 1e150 (ValueError).
    """
    q = _rows("state", state, (10, 13))[:4]
    _has_a_norm(q)
    d = _stack(_frame(q))
    return d.reshape(3, 3, *d.shape[1:]).swapaxes(0, 1)


def loads(s: Any, state: ArrayLike, force: Field | None = None) -> Pair:
    """Couple and force in the directors, m (3, ...) and n (3, ...): what `strains` takes."""
    _, m, _, n = _loads_at(s, state, force)
    return _stack(m), _stack(n)


def rates(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    force: Field | None = None,
    body_force: Field | None = None,
    body_couple: Field | None = None,
    *,
    linear: bool = False,
) -> Array:
    """d(state)/ds of a rod in equilibrium, in the shape of the state.

    s is the place, a number or an array; state holds in its rows

        0 to 3    q, the quaternion of the frame: its norm is kept and plays no part
        4 to 6    m, the couple in the directors, force times length
        7 to 9    r, the center line in the fixed basis
        10 to 12  n, the force in the fixed basis, where the state carries it

    and any trailing shape: rods, nodes, both. With 10 rows the force is an argument (the end load
    plus what body force lies beyond s); with 13 rows it is integrated, n' = -body_force. force,
    body_force and body_couple are in the fixed basis, per length where they are of the body: three
    numbers, an array (3, ...) over s, or a function of s that answers either. linear = True drops
    the limit: strains K^-1 (m, n)/gamma for every load. As `solve_ivp` and `solve_bvp` want it:

        fun = lambda s, x: rates(s, x, constants, force)

    Raises ValueError for other shapes, for a force both given and carried, and for a quaternion of
    a norm outside 1e-150 to 1e150, with the first such state; a state with a nan has rates of nan.
    """
    q, m, d, n = _loads_at(s, state, force)
    carried = force is None
    if body_force is not None and not carried:
        raise ValueError("body_force changes a force that the state carries, in 13 rows, only")
    b = _in_directors(d, _field("body_couple", body_couple, s))
    u, v = _law(m, n, constants, linear)
    found = _rates(q, m, d, n, b, u, v)
    if carried:
        found = (*found, *(-f for f in _field("body_force", body_force, s)))
        return _stack(found) + 0.0
    return _stack(found)


def jacobian(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    force: Field | None = None,
    body_force: Field | None = None,
    body_couple: Field | None = None,
    *,
    linear: bool = False,
) -> Array:
    """The derivative of `rates` by the state, (10, 10, ...) or (13, 13, ...).

    Arguments as there; entry (i, j) is that of row i by row j. body_force plays no part.
    """
    q, m, d, n = _loads_at(s, state, force)
    b = _in_directors(d, _field("body_couple", body_couple, s))
    u, v = _law(m, n, constants, linear)
    soft = _tangent(m, n, constants, linear)
    entries, values = list(BY_STATE), list(_by_state(q, m, d, n, b, u, v, soft))
    if force is None:
        entries += BY_FORCE
        values += _by_force(q, m, d, n, v, soft)
    return _matrix(13 if force is None else 10, entries, values)
