"""The strain-limiting special Cosserat rod: every strain, every load, any p.

Scene full_rod, written by: rodproof generate full_rod

Statements it rests on (paper label):
    qstar-form (Section 3.1)
    const-u-mu (eq:uconst)
    const-u-3 (eq:u3const)
    const-v-mu (eq:vconst)
    const-v-3 (eq:v3const)
    q-form (eq:quadraticform)
    strain-limit (eq:strainlimiting)
    const-m-mu (eq:mconst)
    const-m-3 (eq:m3const)
    const-n-mu (eq:nconst)
    const-n-3 (eq:n3const)
    w-definition (eq:stenergy)
    wstar-definition (eq:compenergy)
    hess-m-u
    hess-m-u3
    hess-m-v
    hess-m-v3
    hess-m3-u3
    hess-m3-v
    hess-m3-v3
    hess-n-v
    hess-n-v3
    hess-n3-v3
    wstar-gradient (Section 3.1)

Domain: all finite loads; strains with Q(u, v) < 1, past which the answer is
an error.

Operations a point (arithmetic, transcendental, energy share, temporaries):
    strains                 50   4   0  17
    loads                   42   4   0  17
    stored_energy           33   4   1  13
    complementary_energy    42   6   1  13
    stiffness              100   4   0  27
    compliance             158   4   0  43
"""


from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

Array = np.ndarray[Any, np.dtype[Any]]
Rows = Sequence[Array]

BLOCK = 8192  # points worked on at a time, so that temporaries stay in cache
TINY = {np.dtype(t): float(np.finfo(t).tiny) for t in (np.float32, np.float64)}
LOG_MAX = {t: -0.99 * math.log(TINY[t]) for t in TINY}  # exp of it is near the largest number


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
    chirality: float = field(init=False, repr=False, compare=False)
    gap: float = field(init=False, repr=False, compare=False)
    per_eta_gap: float = field(init=False, repr=False, compare=False)
    iota_beta: float = field(init=False, repr=False, compare=False)
    per_alpha: float = field(init=False, repr=False, compare=False)
    per_beta: float = field(init=False, repr=False, compare=False)
    per_zeta: float = field(init=False, repr=False, compare=False)
    per_eta: float = field(init=False, repr=False, compare=False)
    per_gap: float = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        for name in ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p"):
            value = float(getattr(self, name))
            if not math.isfinite(value) or (value <= 0 and name != "iota"):
                rule = "a finite number" if name == "iota" else "positive and finite"
                raise ValueError(f"Constants: {name} must be {rule}, not {value}")
            object.__setattr__(self, name, value)
        exact = (Fraction(v) for v in (self.alpha, self.beta, self.zeta, self.eta, self.iota))
        alpha, beta, zeta, eta, iota = exact
        if not beta**2 * eta**2 - iota**2 > 0:
            raise ValueError(
                "Constants: beta^2 eta^2 - iota^2 > 0 fails: |iota| must be smaller than beta*eta,"
                f" not beta={self.beta}, eta={self.eta}, iota={self.iota}"
            )
        derived = {
            "chirality": iota / beta / eta,
            "gap": (beta**2 * eta**2 - iota**2) / beta**2 / eta**2,
            "per_eta_gap": beta**2 * eta / (beta**2 * eta**2 - iota**2),
            "iota_beta": iota / beta**2,
            "per_alpha": 1 / alpha,
            "per_beta": 1 / beta,
            "per_zeta": 1 / zeta,
            "per_eta": 1 / eta,
            "per_gap": beta**2 * eta**2 / (beta**2 * eta**2 - iota**2),
        }
        for name, ratio in derived.items():  # exact, then rounded once
            object.__setattr__(self, name, float(ratio))

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


def _reduce_loads(
    m1: Array,
    m2: Array,
    m3: Array,
    n1: Array,
    n2: Array,
    n3: Array,
    c: Constants,
) -> tuple[Array, ...]:
    """Loads over their moduli, the linear rod's strains, and Q*(m, n) in squares."""
    mu_1 = c.per_alpha * m1
    mu_2 = c.per_alpha * m2
    mu_3 = c.per_beta * m3
    nu_1 = c.per_zeta * n1
    nu_2 = c.per_zeta * n2
    dilatation = c.per_eta_gap * (n3 - c.iota_beta * m3)
    twist = mu_3 - c.chirality * dilatation
    nu_3 = c.per_eta * n3
    q_star = c.gap * dilatation**2 + mu_1**2 + mu_2**2 + mu_3**2 + nu_1**2 + nu_2**2
    return (mu_1, mu_2, mu_3, nu_1, nu_2, dilatation, twist, nu_3, q_star)


def _soften(y: Array, c: Constants) -> tuple[Array, ...]:
    """Strain over load, (gamma^p + y^p)^(-1/p), by the ratio of gamma and y."""
    tiny = TINY[y.dtype]
    larger = np.maximum(y, c.gamma)
    ratio = np.maximum(tiny, np.minimum(y, c.gamma) / larger)
    power = np.exp(c.p * np.log(ratio))
    factor = np.exp(-np.log1p(power) / c.p) / larger
    return (ratio, power, factor)


def _reduce_strains(
    u1: Array,
    u2: Array,
    u3: Array,
    v1: Array,
    v2: Array,
    stretch: Array,
    c: Constants,
) -> tuple[Array, ...]:
    """Strains times their moduli, the linear rod's loads, and Q(u, v) in squares."""
    kappa_1 = c.alpha * u1
    kappa_2 = c.alpha * u2
    kappa_3 = c.beta * u3
    lam_1 = c.zeta * v1
    lam_2 = c.zeta * v2
    lam_3 = c.eta * stretch
    torque = c.chirality * lam_3 + kappa_3
    tension = c.chirality * torque + c.gap * lam_3
    q = c.gap * lam_3**2 + kappa_1**2 + kappa_2**2 + lam_1**2 + lam_2**2 + torque**2
    return (kappa_1, kappa_2, lam_1, lam_2, torque, tension, q)


def _stiffen(q: Array, c: Constants) -> tuple[Array, ...]:
    """Load over strain, gamma (1 - x^p)^(-1/p), by the growth x^p/(1 - x^p), x^2 = Q."""
    tiny = TINY[q.dtype]
    log_max = LOG_MAX[q.dtype]
    growth = 1 / np.expm1(np.minimum(log_max, -0.5 * c.p * np.log(np.maximum(q, tiny))))
    depth = np.log1p(growth)
    factor = c.gamma * np.exp(depth / c.p)
    return (growth, depth, factor)


def _balanced(
    form: Callable[..., tuple[Array, ...]], inputs: Rows, c: Constants
) -> tuple[tuple[Array, ...], Array, Array, Array]:
    """Values of ``form``, the root of its last one, and the radius and its square.

    Where squares would overflow or underflow the inputs are taken times a power of two, a factor
    that the values and their root share and that later cancels; the radius is free of it.
    """
    with np.errstate(over="ignore"):
        *values, square = form(*inputs, c)
    tiny = TINY[square.dtype]
    if square.min() > tiny * 2**60 and square.max() < 1 / tiny / 2**60:
        size = np.sqrt(square)
        return (*values,), size, size, square
    largest = np.maximum.reduce([np.abs(row) for row in (*inputs, *values)])
    power = np.frexp(largest)[1]
    *values, square = form(*(np.ldexp(row, -power) for row in inputs), c)
    size = np.sqrt(square)
    radius = np.ldexp(size, power)
    with np.errstate(over="ignore"):
        return (*values,), np.maximum(size, tiny), radius, radius * radius


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


class _PastLimit(Exception):
    """Some strains have Q >= 1."""


def _within_limit(q: Array) -> Array:
    """Q where all of it is below the limit."""
    if not (q < 1).all():
        raise _PastLimit
    return q


def _past_limit(strains: Rows, c: Constants, shape: tuple[int, ...]) -> ValueError:
    """The error for strains at or past the limit: how many points, the first and its Q."""
    u1, u2, u3, v1, v2, v3 = strains
    stretch = v3 - 1
    *_, q = _reduce_strains(u1, u2, u3, v1, v2, stretch, c)
    bad = np.flatnonzero(~(q < 1))
    index = tuple(int(i) for i in np.unravel_index(bad[0], shape))
    return ValueError(
        f"the strains must satisfy Q(u, v) < 1 (eq:strainlimiting); {bad.size} of {q.size} points are not, the"
        f" first at index {index} with Q = {float(q[bad[0]])!r}"
    )


def _arguments(
    names: tuple[str, str], values: tuple[ArrayLike, ArrayLike]
) -> tuple[list[Array], tuple[int, ...]]:
    """The inputs as float arrays (3, ...) of one type, and their common trailing shape."""
    arrays = [np.asarray(value) for value in values]
    for name, array in zip(names, arrays, strict=True):
        if array.dtype.kind not in "iuf":
            raise ValueError(f"{name} must hold real numbers, not {array.dtype}")
        if array.shape[:1] != (3,):
            raise ValueError(f"{name} must have shape (3, ...), not {array.shape}")
    dtype = np.result_type(*arrays)
    dtype = np.dtype(dtype if dtype == np.float32 else np.float64)
    first, second = (array.shape[1:] for array in arrays)
    try:
        shape = np.broadcast_shapes(first, second)
    except ValueError:
        raise ValueError(
            f"{names[0]} and {names[1]} must broadcast after the first axis, but have the"
            f" shapes {arrays[0].shape} and {arrays[1].shape}"
        ) from None
    whole = [array.reshape(3, *(1,) * (len(shape) + 1 - array.ndim), *array.shape[1:]) for array in arrays]
    return [np.broadcast_to(a, (3, *shape)).astype(dtype, copy=False) for a in whole], shape


def _results(
    heads: dict[str, tuple[int, ...]],
    shape: tuple[int, ...],
    dtype: np.dtype[Any],
    out: tuple[Array, ...] | None,
) -> tuple[Array, ...]:
    """The arrays to fill: new ones, or ``out`` after a check of its shapes and types."""
    if out is None:
        return tuple(np.empty((*head, *shape), dtype) for head in heads.values())
    if not isinstance(out, tuple) or len(out) != len(heads):
        raise ValueError(f"out must be a tuple of {len(heads)} arrays, for {', '.join(heads)}")
    for (name, head), array in zip(heads.items(), out, strict=True):
        if not isinstance(array, np.ndarray) or array.dtype != dtype:
            kind = getattr(array, "dtype", type(array).__name__)
            raise ValueError(f"out for {name} must be an array of {dtype}, not of {kind}")
        if array.shape != (*head, *shape):
            raise ValueError(
                f"out for {name} must have shape {(*head, *shape)}, not {array.shape}"
            )
    return out


def _apply(
    body: Callable[..., None],
    inputs: dict[str, ArrayLike],
    c: Constants,
    heads: dict[str, tuple[int, ...]],
    out: tuple[Array, ...] | None,
) -> tuple[Array, ...]:
    """Runs ``body`` over blocks of points, straight into the results where that is safe."""
    (first, second), (name, other) = inputs.values(), inputs
    arrays, shape = _arguments((name, other), (first, second))
    results = _results(heads, shape, arrays[0].dtype, out)
    points = math.prod(shape)
    rows = [row for array in arrays for row in array.reshape(3, points)]
    direct = out is None or all(
        r.flags.c_contiguous and not any(np.may_share_memory(r, a) for a in arrays) for r in out
    )
    flat = [
        (r if direct else np.empty(r.shape, r.dtype)).reshape(*head, points)
        for r, head in zip(results, heads.values(), strict=True)
    ]
    with np.errstate(under="ignore"):
        for start in range(0, points, BLOCK):
            part = slice(start, start + BLOCK)
            try:
                body([row[part] for row in rows], c, *(array[..., part] for array in flat))
            except _PastLimit:
                raise _past_limit(rows, c, shape) from None
    if not direct:
        for result, values in zip(results, flat, strict=True):
            result[...] = values.reshape(result.shape)
    return results


def _strains(loads: Rows, c: Constants, u: Array, v: Array) -> None:
    """u = (gamma^p + Q*^(p/2))^(-1/p) (K^-1 (m, n))_u, v - e3 likewise (eq:uconst, eq:vconst)."""
    (mu_1, mu_2, _, nu_1, nu_2, dilatation, twist, _), size, y, _ = _balanced(_reduce_loads, loads, c)
    _, _, factor = _soften(y, c)
    reach = factor * y / size
    bend = c.per_alpha * reach
    turn = c.per_beta * reach
    shear = c.per_zeta * reach
    extend = c.per_eta * reach
    np.multiply(bend, mu_1, out=u[0])
    np.multiply(bend, mu_2, out=u[1])
    np.multiply(turn, twist, out=u[2])
    np.multiply(nu_1, shear, out=v[0])
    np.multiply(nu_2, shear, out=v[1])
    np.add(dilatation * extend, 1, out=v[2])


def strains(
    m: ArrayLike,
    n: ArrayLike,
    constants: Constants,
    out: tuple[Array, Array] | None = None,
) -> tuple[Array, Array]:
    """Strains u, v (3, ...) under the contact couple m and force n (eq:uconst to eq:v3const).

    m (3, ...) in force times length and n (3, ...) in force, any finite values.
    u comes in 1/length, v is plain; at rest u = 0, v = (0, 0, 1).
    """
    inputs = {"m": m, "n": n}
    u, v = _apply(_strains, inputs, constants, {"u": (3,), "v": (3,)}, out)
    return u, v


def _loads(strains: Rows, c: Constants, m: Array, n: Array) -> None:
    """m = gamma (1 - Q^(p/2))^(-1/p) (K (u, v - e3))_m, n likewise (eq:mconst, eq:nconst)."""
    u1, u2, u3, v1, v2, v3 = strains
    stretch = v3 - 1
    kappa_1, kappa_2, lam_1, lam_2, torque, tension, q = _reduce_strains(u1, u2, u3, v1, v2, stretch, c)
    q = _within_limit(q)
    _, _, factor = _stiffen(q, c)
    bend = c.alpha * factor
    turn = c.beta * factor
    shear = c.zeta * factor
    extend = c.eta * factor
    np.multiply(bend, kappa_1, out=m[0])
    np.multiply(bend, kappa_2, out=m[1])
    np.multiply(torque, turn, out=m[2])
    np.multiply(lam_1, shear, out=n[0])
    np.multiply(lam_2, shear, out=n[1])
    np.multiply(extend, tension, out=n[2])


def loads(
    u: ArrayLike,
    v: ArrayLike,
    constants: Constants,
    out: tuple[Array, Array] | None = None,
) -> tuple[Array, Array]:
    """Contact couple m and force n (3, ...) at the strains u, v (eq:mconst to eq:n3const).

    u (3, ...) in 1/length and v (3, ...) plain, with Q(u, v) < 1; else
    ValueError, and what ``out`` holds is unspecified.
    Near the limit the strains hardly determine the loads.
    """
    inputs = {"u": u, "v": v}
    m, n = _apply(_loads, inputs, constants, {"m": (3,), "n": (3,)}, out)
    return m, n


def _stored_energy(strains: Rows, c: Constants, w: Array) -> None:
    """W = gamma/2 int_0^Q (1 - t^(p/2))^(-1/p) dt, as its share of load times strain."""
    u1, u2, u3, v1, v2, v3 = strains
    stretch = v3 - 1
    _, _, x, q = _balanced(_reduce_strains, (u1, u2, u3, v1, v2, stretch), c)
    q = _within_limit(q)
    _, depth, factor = _stiffen(q, c)
    load = factor * x
    np.multiply(load * x, _work_share(depth, c), out=w)


def stored_energy(
    u: ArrayLike,
    v: ArrayLike,
    constants: Constants,
    out: Array | None = None,
) -> Array:
    """Stored energy W per length, in force (eq:stenergy), with the trailing shape.

    u (3, ...) in 1/length and v (3, ...) plain, with Q(u, v) < 1; else
    ValueError, and what ``out`` holds is unspecified.
    """
    inputs = {"u": u, "v": v}
    (w,) = _apply(_stored_energy, inputs, constants, {"w": ()}, None if out is None else (out,))
    return w


def _complementary_energy(loads: Rows, c: Constants, w_star: Array) -> None:
    """W* = 1/2 int_0^Q* (gamma^p + t^(p/2))^(-1/p) dt, as its share of load times strain."""
    _, _, y, _ = _balanced(_reduce_loads, loads, c)
    ratio, power, factor = _soften(y, c)
    strain = factor * y
    depth = np.log1p(power) - c.p * np.where(y <= c.gamma, 0.0, np.log(ratio))
    np.multiply(strain * y, 1 - _work_share(depth, c), out=w_star)


def complementary_energy(
    m: ArrayLike,
    n: ArrayLike,
    constants: Constants,
    out: Array | None = None,
) -> Array:
    """Complementary energy W* per length, in force (eq:compenergy), with the trailing shape.

    m (3, ...) in force times length and n (3, ...) in force, any finite values.
    """
    inputs = {"m": m, "n": n}
    (w_star,) = _apply(
        _complementary_energy,
        inputs,
        constants,
        {"w_star": ()},
        None if out is None else (out,),
    )
    return w_star


def _stiffness(strains: Rows, c: Constants, stiff: Array) -> None:
    """D^2 W = factor (K + growth t t^T), t = K (u, v - e3)/x."""
    u1, u2, u3, v1, v2, v3 = strains
    stretch = v3 - 1
    kappa_1, kappa_2, lam_1, lam_2, torque, tension, q = _reduce_strains(u1, u2, u3, v1, v2, stretch, c)
    q = _within_limit(q)
    growth, _, factor = _stiffen(q, c)
    steep = factor * growth
    tiny = TINY[q.dtype]
    x = np.sqrt(np.maximum(q, tiny))
    t1 = c.alpha * kappa_1 / x
    w1 = steep * t1
    t2 = c.alpha * kappa_2 / x
    w2 = steep * t2
    t3 = c.beta * torque / x
    w3 = steep * t3
    t4 = c.zeta * lam_1 / x
    w4 = steep * t4
    t5 = c.zeta * lam_2 / x
    w5 = steep * t5
    t6 = c.eta * tension / x
    w6 = steep * t6
    np.add(c.alpha**2 * factor, t1 * w1, out=stiff[0, 0])
    np.multiply(t2, w1, out=stiff[0, 1])
    np.multiply(t3, w1, out=stiff[0, 2])
    np.multiply(t4, w1, out=stiff[0, 3])
    np.multiply(t5, w1, out=stiff[0, 4])
    np.multiply(t6, w1, out=stiff[0, 5])
    np.add(c.alpha**2 * factor, t2 * w2, out=stiff[1, 1])
    np.multiply(t3, w2, out=stiff[1, 2])
    np.multiply(t4, w2, out=stiff[1, 3])
    np.multiply(t5, w2, out=stiff[1, 4])
    np.multiply(t6, w2, out=stiff[1, 5])
    np.add(c.beta**2 * factor, t3 * w3, out=stiff[2, 2])
    np.multiply(t4, w3, out=stiff[2, 3])
    np.multiply(t5, w3, out=stiff[2, 4])
    np.add(c.iota * factor, t6 * w3, out=stiff[2, 5])
    np.add(c.zeta**2 * factor, t4 * w4, out=stiff[3, 3])
    np.multiply(t5, w4, out=stiff[3, 4])
    np.multiply(t6, w4, out=stiff[3, 5])
    np.add(c.zeta**2 * factor, t5 * w5, out=stiff[4, 4])
    np.multiply(t6, w5, out=stiff[4, 5])
    np.add(c.eta**2 * factor, t6 * w6, out=stiff[5, 5])
    for row in range(1, 6):
        stiff[row, :row] = stiff[:row, row]


def stiffness(u: ArrayLike, v: ArrayLike, constants: Constants, out: Array | None = None) -> Array:
    """Stiffness d(m, n)/d(u, v), (6, 6, ...), symmetric positive definite (Section 3.4).

    u (3, ...) in 1/length and v (3, ...) plain, with Q(u, v) < 1; else
    ValueError, and what ``out`` holds is unspecified.
    Rows and columns are ordered (m1, m2, m3, n1, n2, n3) and (u1, u2, u3, v1, v2, v3).
    """
    inputs = {"u": u, "v": v}
    (stiff,) = _apply(
        _stiffness,
        inputs,
        constants,
        {"stiff": (6, 6)},
        None if out is None else (out,),
    )
    return stiff


def _compliance(loads: Rows, c: Constants, soft: Array) -> None:
    """D^2 W* = factor (K^-1 - share d d^T), d = K^-1 (m, n)/y, its diagonal as sums of squares."""
    (mu_1, mu_2, mu_3, nu_1, nu_2, dilatation, twist, nu_3), size, y, _ = _balanced(_reduce_loads, loads, c)
    _, power, factor = _soften(y, c)
    remain = np.where(y <= c.gamma, 1.0, power) / (power + 1)
    a1 = mu_1 / size
    a1_square = a1**2
    a2 = mu_2 / size
    a2_square = a2**2
    a3 = mu_3 / size
    a3_square = a3**2
    b1 = nu_1 / size
    b1_square = b1**2
    b2 = nu_2 / size
    b2_square = b2**2
    b3 = nu_3 / size
    c3 = twist / size
    c6 = dilatation / size
    c6_square = c6**2
    across = a1_square + a2_square + b1_square + b2_square
    coupled = a3_square + c.gap * c6_square
    share = np.where(y <= c.gamma, power, 1.0) / (power + 1)
    steep = -factor * share
    d1 = c.per_alpha * a1
    w1 = d1 * steep
    d2 = c.per_alpha * a2
    w2 = d2 * steep
    d3 = c.per_beta * c3
    w3 = d3 * steep
    d4 = c.per_zeta * b1
    w4 = d4 * steep
    d5 = c.per_zeta * b2
    w5 = d5 * steep
    d6 = c.per_eta * c6
    np.multiply(
        c.per_alpha**2 * factor,
        a1_square * remain + a2_square + b1_square + b2_square + coupled,
        out=soft[0, 0],
    )
    np.multiply(d2, w1, out=soft[0, 1])
    np.multiply(d3, w1, out=soft[0, 2])
    np.multiply(d4, w1, out=soft[0, 3])
    np.multiply(d5, w1, out=soft[0, 4])
    np.multiply(d6, w1, out=soft[0, 5])
    np.multiply(
        c.per_alpha**2 * factor,
        a1_square + a2_square * remain + b1_square + b2_square + coupled,
        out=soft[1, 1],
    )
    np.multiply(d3, w2, out=soft[1, 2])
    np.multiply(d4, w2, out=soft[1, 3])
    np.multiply(d5, w2, out=soft[1, 4])
    np.multiply(d6, w2, out=soft[1, 5])
    np.multiply(
        c.per_beta**2 * factor,
        c3**2 * remain + c.per_gap * (across + b3**2),
        out=soft[2, 2],
    )
    np.multiply(d4, w3, out=soft[2, 3])
    np.multiply(d5, w3, out=soft[2, 4])
    np.multiply(
        c.per_beta * c.per_eta * factor,
        c3 * c6 * remain - c.per_gap * (a3 * b3 + c.chirality * across),
        out=soft[2, 5],
    )
    np.multiply(
        c.per_zeta**2 * factor,
        a1_square + a2_square + b1_square * remain + b2_square + coupled,
        out=soft[3, 3],
    )
    np.multiply(d5, w4, out=soft[3, 4])
    np.multiply(d6, w4, out=soft[3, 5])
    np.multiply(
        c.per_zeta**2 * factor,
        a1_square + a2_square + b1_square + b2_square * remain + coupled,
        out=soft[4, 4],
    )
    np.multiply(d6, w5, out=soft[4, 5])
    np.multiply(
        c.per_eta**2 * factor,
        c6_square * remain + c.per_gap * (a3_square + across),
        out=soft[5, 5],
    )
    for row in range(1, 6):
        soft[row, :row] = soft[:row, row]


def compliance(m: ArrayLike, n: ArrayLike, constants: Constants, out: Array | None = None) -> Array:
    """Compliance d(u, v)/d(m, n), (6, 6, ...), the inverse of the stiffness at these loads.

    m (3, ...) in force times length and n (3, ...) in force, any finite values.
    Rows and columns are ordered (u1, u2, u3, v1, v2, v3) and (m1, m2, m3, n1, n2, n3).
    """
    inputs = {"m": m, "n": n}
    (soft,) = _apply(
        _compliance,
        inputs,
        constants,
        {"soft": (6, 6)},
        None if out is None else (out,),
    )
    return soft
