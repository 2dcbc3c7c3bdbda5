"""A rod in equilibrium under the force N g_3, by Euler angles: rates and Jacobian.

Made by: rodproof generate

The reduced system of the paper, for any gamma. The angles are singular where sin(theta) = 0, and
slow near it; the module directors is not.

Statements it rests on (verdict; as corrected if refuted): euler-n proved, euler-u1 proved,
euler-u2 reading, euler-u3 proved, ode-phi proved, ode-theta refuted, ode-psi proved, ode-M1
proved, ode-M2 proved, ode-M3 proved, const-u-mu proved, const-u-3 proved, const-v-mu proved,
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


def _force(angles: Numbers, thrust: Number) -> Numbers:
    """The force N g_3 in the intermediate frame."""
    sin_theta, cos_theta, _, _ = angles
    N = thrust
    return (
        -N * sin_theta,
        0.0,
        N * cos_theta,
    )


def _rates(angles: Numbers, couple: Numbers, thrust: Number, u: Numbers, v: Numbers) -> Numbers:
    """phi', theta', psi', M', r'; u and v are the strains in the intermediate frame."""
    sin_theta, cos_theta, sin_phi, cos_phi = angles
    M1, M2, M3 = couple
    N = thrust
    u1, u2, u3 = u
    v1, _, v3 = v
    turn = -u1 / sin_theta
    return (
        turn,
        u2,
        u3 - cos_theta * turn,
        M2 * cos_theta * turn - M3 * u2,
        N * cos_theta * v1 + N * sin_theta * v3 - M1 * cos_theta * turn - M3 * sin_theta * turn,
        0.0,
        cos_phi * (cos_theta * v1 + sin_theta * v3),
        sin_phi * (cos_theta * v1 + sin_theta * v3),
        cos_theta * v3 - sin_theta * v1,
    )


BY_STATE = (
    (6, 0), (7, 0), (0, 1), (1, 1), (2, 1), (3, 1), (4, 1), (6, 1), (7, 1), (8, 1), (0, 3), (1, 3),
    (2, 3), (3, 3), (4, 3), (6, 3), (7, 3), (8, 3), (0, 4), (1, 4), (2, 4), (3, 4), (4, 4), (6, 4),
    (7, 4), (8, 4), (0, 5), (1, 5), (2, 5), (3, 5), (4, 5), (6, 5), (7, 5), (8, 5),
)


def _by_state(
    angles: Numbers, couple: Numbers, thrust: Number, u: Numbers, v: Numbers, soft: Numbers
) -> Numbers:
    """Entries of the derivative of the rates by phi, theta and M."""
    sin_theta, cos_theta, sin_phi, cos_phi = angles
    M1, M2, M3 = couple
    N = thrust
    u1, u2, _ = u
    v1, _, v3 = v
    (
        soft11, soft12, soft13, soft14, _, soft16, soft22, soft23, soft24, _, soft26, soft33,
        soft34, _, soft36, soft44, _, soft46, _, _, soft66,
    ) = soft
    turn = -u1 / sin_theta
    u1_theta = -N * (cos_theta * soft14 + sin_theta * soft16)
    u2_theta = -N * (cos_theta * soft24 + sin_theta * soft26)
    u3_theta = -N * (cos_theta * soft34 + sin_theta * soft36)
    v1_theta = -N * (cos_theta * soft44 + sin_theta * soft46)
    v3_theta = -N * (cos_theta * soft46 + sin_theta * soft66)
    turn_M1 = -soft11 / sin_theta
    turn_M2 = -soft12 / sin_theta
    turn_M3 = -soft13 / sin_theta
    turn_theta = -(cos_theta * turn + u1_theta) / sin_theta
    return (
        -sin_phi * (cos_theta * v1 + sin_theta * v3),
        cos_phi * (cos_theta * v1 + sin_theta * v3),
        turn_theta,
        u2_theta,
        sin_theta * turn + u3_theta - cos_theta * turn_theta,
        M2 * cos_theta * turn_theta - M2 * sin_theta * turn - M3 * u2_theta,
        (
            M1 * sin_theta * turn
            + N * cos_theta * v1_theta
            + N * cos_theta * v3
            + N * sin_theta * v3_theta
            - M3 * cos_theta * turn
            - N * sin_theta * v1
            - turn_theta * (M1 * cos_theta + M3 * sin_theta)
        ),
        cos_phi * (cos_theta * v1_theta + cos_theta * v3 + sin_theta * v3_theta - sin_theta * v1),
        sin_phi * (cos_theta * v1_theta + cos_theta * v3 + sin_theta * v3_theta - sin_theta * v1),
        cos_theta * v3_theta - cos_theta * v1 - sin_theta * v1_theta - sin_theta * v3,
        turn_M1,
        soft12,
        soft13 - cos_theta * turn_M1,
        M2 * cos_theta * turn_M1 - M3 * soft12,
        (
            N * cos_theta * soft14
            + N * sin_theta * soft16
            - cos_theta * turn
            - turn_M1 * (M1 * cos_theta + M3 * sin_theta)
        ),
        cos_phi * (cos_theta * soft14 + sin_theta * soft16),
        sin_phi * (cos_theta * soft14 + sin_theta * soft16),
        cos_theta * soft16 - sin_theta * soft14,
        turn_M2,
        soft22,
        soft23 - cos_theta * turn_M2,
        M2 * cos_theta * turn_M2 + cos_theta * turn - M3 * soft22,
        (
            N * cos_theta * soft24
            + N * sin_theta * soft26
            - turn_M2 * (M1 * cos_theta + M3 * sin_theta)
        ),
        cos_phi * (cos_theta * soft24 + sin_theta * soft26),
        sin_phi * (cos_theta * soft24 + sin_theta * soft26),
        cos_theta * soft26 - sin_theta * soft24,
        turn_M3,
        soft23,
        soft33 - cos_theta * turn_M3,
        M2 * cos_theta * turn_M3 - M3 * soft23 - u2,
        (
            N * cos_theta * soft34
            + N * sin_theta * soft36
            - sin_theta * turn
            - turn_M3 * (M1 * cos_theta + M3 * sin_theta)
        ),
        cos_phi * (cos_theta * soft34 + sin_theta * soft36),
        sin_phi * (cos_theta * soft34 + sin_theta * soft36),
        cos_theta * soft36 - sin_theta * soft34,
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


def _at(
    state: ArrayLike, thrust: ArrayLike
) -> tuple[int, Numbers, Numbers, Numbers, Number]:
    """Rows, sines and cosines, couple, force in the intermediate frame, thrust; checked."""
    x = _rows("state", state, (6, 9))
    one = isinstance(x[1], float)
    if one and not (math.isfinite(x[0]) and math.isfinite(x[1])):
        raise ValueError(f"the angles phi = {x[0]!r} and theta = {x[1]!r} must be finite")
    sin, cos = (math.sin, math.cos) if one else (np.sin, np.cos)
    angles = sin(x[1]), cos(x[1]), sin(x[0]), cos(x[0])
    _off_the_pole(x[1], angles[0])
    given = np.asarray(thrust, dtype=float)
    N = given if given.ndim else float(given)
    return len(x), angles, x[3:6], _force(angles, N), N


def _off_the_pole(theta: Number, sine: Number) -> None:
    """Refuses sin(theta) = 0, as far as theta as a float can tell, where phi' is not determined."""
    if isinstance(theta, float) and abs(sine) > max(2**-51 * abs(theta), 2.0**-1000):
        return
    bad = ~(np.abs(sine) > np.maximum(2**-51 * np.abs(theta), 2.0**-1000))
    if np.any(bad):
        raise ValueError(
            f"Euler angles are singular at sin(theta) = 0: {_first(bad, 'theta', [theta])};"
            " the module directors has no such place"
        )


def rates(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    thrust: ArrayLike,
    *,
    linear: bool = False,
) -> Array:
    """d(state)/ds of a rod in equilibrium under the force N g_3, in the shape of the state.

    s plays no part (the rod is uniform and the force dead); state holds in its rows

        0 to 2    phi, theta, psi; the directors are R_3(phi) R_2(theta) R_3(psi)
        3 to 5    M1, M2, M3, the couple in the intermediate frame R_3(phi) R_2(theta)
        6 to 8    r, the center line in the fixed basis, if wanted

    and any trailing shape; thrust is N, a number or an array of that shape. linear = True drops
    the limit: strains K^-1 (m, n)/gamma for every load. M3' is zero. As `solve_ivp` and
    `solve_bvp` want it:

        fun = lambda s, x: rates(s, x, constants, thrust)

    Raises ValueError where sin(theta) = 0, which these angles cannot pass, and for other shapes.
    """
    rows, angles, M, n, N = _at(state, thrust)
    u, v = _law(M, n, constants, linear)
    return _stack(_rates(angles, M, N, u, v)[:rows])


def jacobian(
    s: Any,
    state: ArrayLike,
    constants: Constants,
    thrust: ArrayLike,
    *,
    linear: bool = False,
) -> Array:
    """The derivative of `rates` by the state, (6, 6, ...) or (9, 9, ...).

    Arguments as there; entry (i, j) is that of row i by row j.
    """
    rows, angles, M, n, N = _at(state, thrust)
    u, v = _law(M, n, constants, linear)
    soft = _tangent(M, n, constants, linear)
    return _matrix(rows, BY_STATE, _by_state(angles, M, N, u, v, soft))
