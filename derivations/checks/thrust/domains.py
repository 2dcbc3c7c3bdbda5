"""The domains of Section 4.2: pure thrust, straight and sheared states, the function f_N.

Both signs of N have their own domain (N = R and N = -R with R > 0), so that |N| is never assumed;
N = 0 is a domain too. On the branch of sheared states the angle is free and N follows from it in
closed form, so that every claim about the branch is an identity. The second routes know nothing
of that: they find N by a root search on the moment balance, with K inverted numerically.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import _Numbers
from rodproof.derivations.notation import LimitOf
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    beta,
    chiral_gap,
    eta,
    gamma,
    iota,
    p,
    u3,
    v3,
    zeta,
)  # fmt: skip
from rodproof.derivations.theory import euler
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import euler_frame, phi, psi, theta
from rodproof.derivations.theory.thrust import N, s, x

R = sp.Symbol("R", positive=True)  # |N|
angle = sp.Symbol("vartheta", positive=True)  # the free angle of the branch
delta = sp.Symbol("delta", positive=True)  # distance of N^{-p} from N_thresh^{-p}
tension = sp.Symbol("n3", real=True)
scalar_v = sp.Symbol("v", positive=True)
psi0 = sp.Symbol(r"{\psi}(0)", real=True)
N_thresh = sp.Symbol("N_thresh", positive=True)
x_N = sp.Symbol("x_N", positive=True)
x_Nk = sp.Symbol("x_{N_k}", positive=True)
theta_Nk = sp.Symbol(r"{\theta}(N_k)", positive=True)
theta_of_N = sp.Symbol(r"{\theta}(N_j)", real=True)
strand_sense = sp.Symbol("h_strand", real=True)  # triple product of a strand's three derivatives
strand_twist = sp.Symbol("tau", real=True)
strand_radius, strand_stretch = sp.symbols("rho lambda", positive=True)
theta_hat = sp.Symbol(r"\hat{\theta}", real=True)
theta_infinity = sp.Symbol(r"{\theta}(\infty)", real=True)
theta_hat_infinity = sp.Symbol(r"\hat{\theta}(\infty)", real=True)
tangent = sp.IndexedBase("r'", real=True)  # components of r' in the fixed basis
d = sp.IndexedBase("d", real=True)  # d[k, i] = d_k . g_i


class fN(sp.Function):  # noqa: N801  the paper's name
    """v_3 - 1 as a function of cos theta, `fN(x)`."""

    nargs = 1

    def _latex(self, printer: Any, exp: str | None = None) -> str:
        return rf"f_N({printer._print(self.args[0])})"


# -- what is positive -------------------------------------------------------------------------

c, b, a = theory.softness(), theory.axial_compliance(), theory.shear_compliance()
SOFTER_IN_SHEAR = (chiral_gap, c)
BRANCH_EXISTS = (*SOFTER_IN_SHEAR, 1 + c, c - sp.sqrt(b), theory.threshold_power())

# -- generic points ---------------------------------------------------------------------------


@cache
def _sheared_constants(seed: int) -> tuple[tuple[sp.Symbol, sp.Rational], ...]:
    """Generic constants with gamma = 1 that meet both conditions on the moduli."""
    point = {**sampling.constants(seed), gamma: sp.Integer(1)}
    soft = float(b.subs(point))
    compliance = soft + math.sqrt(soft) * (1.4 + 0.3 * seed)  # c > b^{1/2}
    point[zeta] = sp.Rational(int(997 / math.sqrt(compliance)), 997)
    return tuple(point.items())


def sheared_constants(seed: int) -> Point:
    """As a mapping."""
    return dict(_sheared_constants(seed))


def _generic(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """Generic constants and thrusts, with everything that a state may depend on."""
    point = {**sampling.constants(seed), gamma: sp.Integer(1)}
    more = {
        R: (23, 31, 47),
        N: (23, 31, 47),
        theta: (11, 25, 40),
        phi: (-9, 14, 31),
        psi: (8, -13, 29),
        psi0: (15, 4, -7),
        s: (5, 9, 13),
        x: (6, 13, 17),
        strand_twist: (8, -11, 14),
        strand_radius: (5, 7, 9),
        strand_stretch: (23, 26, 15),
    }
    return point | {k: sp.Rational(v[seed % 3], 19) for k, v in more.items()}


def _on_the_branch(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """Generic constants that meet the conditions, and an angle below the limiting one."""
    point = sheared_constants(seed)
    limit = math.acos(float(theory.limiting_cosine().subs(point)))
    chosen = sp.Rational(int(997 * limit * (0.45 + 0.2 * (seed % 3))), 997)
    return {**_generic(seed), **point, angle: chosen, x: sp.Rational(13 + 2 * seed, 19)}


def _above(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """The distance of N^{-p} from its threshold, as a rational part of the latter."""
    point = _on_the_branch(seed)
    whole = float(theory.threshold_power().subs(point))
    return {**point, delta: sp.Rational(int(whole * 1e9 * (0.2 + 0.25 * (seed % 3))), 10**9)}


def _small(**others: object) -> tuple[Point, ...]:
    """Small points: beta, eta, zeta, iota, p with rational b, and others given by name."""
    rows = ((1, 2, 1, 0, 2), (2, 2, 1, 0, 2), (1, 1, 1, 0, 2), (1, 2, 1, 1, 2), (2, 1, 1, -1, 1))
    names = {k.name: k for k in (R, N, theta, phi, psi, psi0, s, x, angle)}
    given = {names[k]: sp.sympify(v) for k, v in others.items()}
    keys = (beta, eta, zeta, iota, p)
    return tuple({**dict(zip(keys, map(sp.Integer, row), strict=True)), **given} for row in rows)


def _small_points() -> tuple[Point, ...]:
    angles = {"theta": sp.pi / 6, "varphi": 0, "psi": 0, r"{\psi}(0)": 0, "s": 0}
    return (
        *_small(R=2, N=2, x=1, **angles),
        *_small(R="3/2", N="3/2", x=1, **angles),
        *_small(R="3/2", N="3/2", x="1/2", **angles),
    )


def _small_states() -> tuple[Point, ...]:
    angles = {"theta": sp.pi / 6, "varphi": 0, "psi": 0, r"{\psi}(0)": 0, "s": 0}
    rows = _small(R="3/4", x=1, vartheta=sp.pi / 6, **angles)
    # b = 4, R = 2 sends v_3 = 1 - b F R below zero: p = 1 and beta^2 eta^2 - iota^2 = 1/4
    extra = {beta: sp.Integer(1), eta: sp.Rational(1, 2), zeta: sp.Integer(1), iota: sp.Integer(0),
             p: sp.Integer(1), R: sp.Integer(2), phi: sp.Integer(0), psi0: sp.Integer(0),
             s: sp.Integer(0)}  # fmt: skip
    return (*rows, extra)


def _small_limits() -> tuple[Point, ...]:
    """b = 2/75, a = 9/25, c = 1/3, so that the limiting cosine is 9/10; beta = 2 and beta = 1."""
    return tuple(
        {beta: sp.Integer(k), eta: sp.Rational(49, 8), zeta: sp.Rational(5, 3),
         iota: sp.Rational(k, 8), p: sp.Integer(2)}
        for k in (2, 1)
    )  # fmt: skip


# -- states as components ---------------------------------------------------------------------


def _components(
    thrust: sp.Expr, polar: sp.Expr, azimuth: sp.Expr, twist: sp.Expr
) -> dict[sp.Symbol, sp.Expr]:
    """Everything that a statement may name, in a state with these angles under this thrust."""
    strains = theory.strains_from_rest(thrust, polar, twist)
    frame = euler_frame(azimuth, polar, twist)
    found = dict(zip(STRAINS, strains, strict=True)) | {v3: 1 + strains[5]}
    found |= dict(zip(LOADS[3:], theory.force_components(thrust, polar, twist), strict=True))
    found |= dict(zip(LOADS[:3], [sp.Integer(0)] * 3, strict=True))
    along = theory.tangent(thrust, polar, twist, azimuth)
    for i in range(3):
        found[sp.Symbol(f"r'{i + 1}", real=True)] = along[i]
        found |= {sp.Symbol(f"d{k + 1}{i + 1}", real=True): frame[k][i] for k in range(3)}
    found[strand_sense] = theory.strand_handedness(strand_twist, strand_radius, strand_stretch)
    return found | {scalar_v: theory.shear_scalar(thrust, polar), N: thrust}


def _f(thrust: sp.Expr) -> dict[type, Callable[..., sp.Expr]]:
    return {fN: lambda at: theory.dilatation(thrust, at)}


# -- second routes ----------------------------------------------------------------------------


def numeric_strains(point: Point, load: list[Any], ctx: Any) -> list[Any]:
    """The law as it stands, with K inverted numerically: (1 + Q*^{p/2})^{-1/p} K^{-1} sigma."""
    law = _Numbers(point, ctx)
    power = law.c[p]
    factor = (1 + law.dual(load) ** (power / 2)) ** (-1 / power)
    return [factor * e for e in ctx.lu_solve(law.K, ctx.matrix(load))]


def numeric_thrust(point: Point, polar: Any, ctx: Any) -> Any:
    """N > 0 at which r' is along g_3 for the given angle, by a root search."""

    def off_axis(log_thrust: Any) -> Any:
        force = ctx.exp(log_thrust)
        load = [0, 0, 0, -force * ctx.sin(polar), 0, force * ctx.cos(polar)]
        strain = numeric_strains(point, load, ctx)
        return strain[3] * ctx.cos(polar) + (1 + strain[5]) * ctx.sin(polar)

    low, high = ctx.mpf(-20), ctx.mpf(60)
    if not off_axis(low) * off_axis(high) < 0:
        raise ValueError("no sheared state at this angle")
    while high - low > 1:
        middle = (low + high) / 2
        low, high = (middle, high) if off_axis(low) * off_axis(middle) > 0 else (low, middle)
    return ctx.exp(ctx.findroot(off_axis, (low, high), solver="anderson"))


def numeric_cosine(point: Point, thrust: Any, ctx: Any) -> Any:
    """cos theta of the sheared state under a given thrust, by a root search in the angle."""

    def off_axis(polar: Any) -> Any:
        load = [0, 0, 0, -thrust * ctx.sin(polar), 0, thrust * ctx.cos(polar)]
        strain = numeric_strains(point, load, ctx)
        return strain[3] * ctx.cos(polar) / ctx.sin(polar) + 1 + strain[5]

    found = ctx.findroot(off_axis, (ctx.mpf(10) ** -10, ctx.pi / 2), solver="anderson")
    return ctx.cos(found)


def turned(ctx: Any, azimuth: Any, polar: Any, twist: Any) -> list[list[Any]]:
    """d_1, d_2, d_3 by turning e_1, e_2 and g_3 one rotation after the other (Rodrigues)."""

    def turn(vector: list[Any], axis: list[Any], by: Any) -> list[Any]:
        along = ctx.fdot(zip(axis, vector, strict=True)) * (1 - ctx.cos(by))
        across = [axis[i] * vector[j] - axis[j] * vector[i] for i, j in ((1, 2), (2, 0), (0, 1))]
        return [ctx.cos(by) * v + ctx.sin(by) * w + along * k
                for v, w, k in zip(vector, across, axis, strict=True)]  # fmt: skip

    frame = [[ctx.mpf(int(i == k)) for i in range(3)] for k in range(3)]
    for axis, by in ((2, azimuth), (1, polar), (2, twist)):
        frame = [turn(vector, frame[axis], by) for vector in frame]
    return frame


def _state_numbers(point: Point, ctx: Any, thrust: Any, angles: tuple[Any, Any, Any]) -> Values:
    """Strains by the numerical law in a frame that is turned numerically; r' from them."""
    frame = turned(ctx, *angles)
    force = [thrust * vector[2] for vector in frame]
    strain = numeric_strains(point, [0, 0, 0, *force], ctx)
    v = [strain[3], strain[4], 1 + strain[5]]
    found: dict[sp.Basic, Any] = dict(zip(STRAINS, [*strain[:3], *v], strict=True))
    found |= dict(zip(LOADS[3:], force, strict=True)) | {N: thrust}
    largest = max(range(2), key=lambda k: abs(force[k]))
    if force[largest]:
        found[scalar_v] = v[largest] / force[largest]
    for i in range(3):
        found[sp.Symbol(f"r'{i + 1}", real=True)] = ctx.fsum(v[k] * frame[k][i] for k in range(3))
        found |= {sp.Symbol(f"d{k + 1}{i + 1}", real=True): frame[k][i] for k in range(3)}
    return found


def _number(ctx: Any, value: sp.Rational) -> Any:
    return ctx.mpf(int(value.p)) / int(value.q)


def _route_at(sign: int, polar: Callable[[Any, Point], Any]) -> Callable[[Point, Any], Values]:
    def route(point: Point, ctx: Any) -> Values:
        angles = (_number(ctx, point[phi]), polar(ctx, point), _number(ctx, point[psi]))
        return _state_numbers(point, ctx, sign * _number(ctx, point[R]), angles)

    return route


def _route_straight(sign: int) -> Callable[[Point, Any], Values]:
    def route(point: Point, ctx: Any) -> Values:
        thrust, azimuth = sign * _number(ctx, point[R]), _number(ctx, point[phi])
        twist = numeric_strains(point, [0] * 5 + [thrust], ctx)[2]
        psi_of_s = twist * _number(ctx, point[s]) + _number(ctx, point[psi0]) - azimuth
        return _state_numbers(point, ctx, thrust, (azimuth, ctx.mpf(0), psi_of_s))

    return route


def route_on_branch(point: Point, ctx: Any) -> Values:
    """N by the root search; the strains, the frame and r' from the numerical law."""
    polar = _number(ctx, point[angle])
    thrust = numeric_thrust(point, polar, ctx)
    twist = numeric_strains(
        point, [0] * 3 + [-thrust * ctx.sin(polar), 0, thrust * ctx.cos(polar)], ctx
    )[2]
    psi_of_s = twist * _number(ctx, point[s]) + _number(ctx, point[psi0])
    found = dict(_state_numbers(point, ctx, thrust, (ctx.mpf(0), polar, psi_of_s)))
    return found | {x_N: ctx.cos(polar), theta: polar, theta_hat: polar, theta_Nk: polar,
                    x_Nk: ctx.cos(polar), fN(sp.cos(theta)): found[v3] - 1,
                    fN(x_N): found[v3] - 1,
                    N_thresh: numeric_thrust(point, ctx.mpf(10) ** -25, ctx)}  # fmt: skip


def _route_f(point: Point, ctx: Any) -> Values:
    """f_N(x) from the numerical law, its slope by a numerical derivative, its limit far away."""

    def value(at: Any, thrust: Any) -> Any:
        load = [0, 0, 0, thrust * ctx.sqrt(1 - at**2), 0, thrust * at]
        return numeric_strains(point, load, ctx)[5].real

    at, thrust = _number(ctx, point[x]), _number(ctx, point[N])
    far = ctx.mpf(10) ** 60
    return {
        fN(x): value(at, thrust),
        fN(sp.Integer(1)): value(ctx.mpf(1), thrust),
        fN(sp.Integer(0)): value(ctx.mpf(0), thrust),
        LimitOf(fN(sp.Integer(1)), N, sp.oo): value(ctx.mpf(1), far),
        LimitOf(fN(x), N, sp.oo): value(at, far),
    }


def _route_far(point: Point, ctx: Any) -> Values:
    """The straight strains under thrusts of 10^60 and -10^60."""
    found: dict[sp.Basic, Any] = {}
    for sign, target in ((1, sp.oo), (-1, -sp.oo)):
        strain = numeric_strains(point, [0] * 5 + [sign * ctx.mpf(10) ** 60], ctx)
        found[LimitOf(u3, N, target)] = strain[2]
        found[LimitOf(v3 - 1, N, target)] = strain[5]
    return found


# -- the domains ------------------------------------------------------------------------------

_LAW = "the law with K inverted numerically, in a frame turned numerically"


def _couples() -> dict[sp.Symbol, sp.Expr]:
    """M_k = m . e_k for m = m_k d_k."""
    return {sp.Symbol(f"M{k}", real=True): part
            for k, part in enumerate(euler.couple_in_frame(), 1)}  # fmt: skip


COUPLES = Meaning(
    name="all couples and angles", free=LOADS[:3], components=_couples(), sample=_generic,
    simple=lambda: (),
)  # fmt: skip


def _any_angle(sign: int) -> Meaning:
    return Meaning(
        name=f"any angles, N {'>' if sign > 0 else '<'} 0", free=(R, theta, phi, psi),
        components=_components(sign * R, theta, phi, psi), functions=_f(sign * R),
        positive=(chiral_gap, theory.dual_form(R, theta)),
        sample=_generic, simple=_small_points,
        route=_route_at(sign, lambda ctx, point: _number(ctx, point[theta])), route_name=_LAW,
    )  # fmt: skip


PUSHED_OR_PULLED = (_any_angle(1), _any_angle(-1))  # balanced or not


def sheared_residual() -> sp.Expr:
    """v_3 - v N cos theta under a tension, from the balance of couples over -N sin theta."""
    couple = theory.unbalanced_couple(R, theta, psi, phi)[1]
    return -couple / (R * sp.sin(theta))


AT_REST = Meaning(
    name="N = 0, any angles", free=(theta, phi, psi),
    components=_components(sp.Integer(0), theta, phi, psi), positive=(chiral_gap,),
    sample=_generic, simple=_small_points,
)  # fmt: skip


def _straight(sign: int, polar: sp.Expr) -> Meaning:
    """theta = 0 or pi; only phi + psi (phi - psi) is determined, so phi is left free."""
    strains = theory.strains_from_rest(sign * R, polar, sp.Integer(0))
    twist = strains[2] * s + psi0 - phi * sp.cos(polar)
    found = _components(sign * R, polar, phi, twist) | {theta: polar, psi: twist}
    return Meaning(
        name=f"theta = {polar}, N {'>' if sign > 0 else '<'} 0", free=(R, phi, psi0, s),
        components=found, positive=(chiral_gap,), sample=_generic, simple=_small_states,
        route=_route_straight(sign) if polar == 0 else None, route_name=_LAW,
    )  # fmt: skip


v3_at_last, last_thrust, v3_slope = sp.symbols("v_3^{0} N^{0} v_3_N", real=True)


def _sample_compressible(seed: int) -> Point:
    """Constants with eta < 1, so that b > 1."""
    point = {**_generic(seed), eta: sp.Rational(11 + 2 * seed, 19)}
    return {**point, iota: sp.Rational(2, 5) * point[beta] * point[eta] * (-1) ** seed}


def _route_last(point: Point, ctx: Any) -> Values:
    """The thrust at which the numerical law has v_3 = 0, by a root search."""

    def v_3(log_thrust: Any) -> Any:
        return 1 + numeric_strains(point, [0] * 5 + [-ctx.exp(log_thrust)], ctx)[5]

    thrust = -ctx.exp(ctx.findroot(v_3, (ctx.mpf(-10), ctx.mpf(40)), solver="anderson"))
    return {last_thrust: thrust, v3_at_last: v_3(ctx.log(-thrust))}


#: Compression of a straight rod with b > 1, up to v_3 = 0.
LAST_COMPRESSION = Meaning(
    name="theta = 0, b > 1, N < 0", free=(R,),
    components={
        v3_at_last: 1 + theory.straight_strain(5, theory.last_compression()),
        last_thrust: theory.last_compression(),
        v3_slope: -sp.diff(theory.straight_strain(5, -R), R),
    },
    positive=(chiral_gap, b - 1, b**p - b ** (p / 2)), sample=_sample_compressible,
    simple=_small_states, route=_route_last,
    route_name="root search for v_3 = 0 in the law with K inverted numerically",
)  # fmt: skip

#: The straight state as a function of N of either sign, for limits.
FAR = Meaning(
    name="theta = 0, N large", free=(N,),
    components={u3: theory.straight_strain(2), v3: 1 + theory.straight_strain(5)},
    positive=(chiral_gap,), sample=_generic, simple=_small_states, route=_route_far,
    route_name="the law with K inverted numerically, N = 1e60 and -1e60",
)  # fmt: skip

PULLED, COMPRESSED = _straight(1, sp.Integer(0)), _straight(-1, sp.Integer(0))
STRAIGHT = (PULLED, COMPRESSED)
REVERSED = tuple(_straight(sign, sp.pi) for sign in (1, -1))


def _branch(sign: int) -> Meaning:
    """The sheared states, by their angle: theta in (0, pi/2), or its mirror image for N < 0."""
    thrust = sign * theory.thrust_of_angle(sp.cos(angle))
    polar = angle if sign > 0 else sp.pi - angle
    twist = theory.twist_compliance() * theory.stretched_force() * s + psi0
    found = _components(thrust, polar, sp.Integer(0), twist) | {
        theta: polar, phi: sp.Integer(0), psi: twist, theta_hat: polar, theta_Nk: polar,
        x_N: sp.cos(polar), x_Nk: sp.cos(polar), N_thresh: theory.threshold(),
    }  # fmt: skip
    power = theory.inverse_thrust_power(sp.cos(angle))
    return Meaning(
        name=f"sheared states, N {'>' if sign > 0 else '<'} 0", free=(angle, psi0, s),
        components=found, functions=_f(thrust),
        positive=(*BRANCH_EXISTS, sp.cos(angle), sp.sin(angle), 1 - sp.cos(angle),
                  theory.dual_form(sp.Integer(1), angle), power),
        sample=_on_the_branch, simple=_small_states,
        route=route_on_branch if sign > 0 else None,
        route_name="N by a root search on the moment balance; " + _LAW,
    )  # fmt: skip


BRANCH, MIRRORED_BRANCH = _branch(1), _branch(-1)
#: The same with theta itself free, for limits in theta.
BRANCH_FROM_ZERO = Meaning(
    name="sheared states near theta = 0", free=(theta,),
    components={N: theory.thrust_near_zero(theta), N_thresh: theory.threshold()},
    positive=BRANCH_EXISTS, sample=_on_the_branch, simple=_small_states,
    route=lambda point, ctx: {
        LimitOf(N, theta, sp.Integer(0)): numeric_thrust(point, ctx.mpf(10) ** -40, ctx)
    },
    route_name="N by a root search on the moment balance at theta = 1e-40",
)  # fmt: skip
#: Every state of equilibrium under a pure force with N not 0, and then those with N = 0.
LOADED_STATES = (*STRAIGHT, *REVERSED, BRANCH, MIRRORED_BRANCH)
ALL_STATES = (*LOADED_STATES, AT_REST)

#: A sheared state without its closed form: the factor F of the law solves F a n_3 = 1 + F b n_3,
#: and all that is used is F > 0 and v_3 > 0. theta is in (0, pi), N = n_3/cos theta.
SHEARED = Meaning(
    name="states with v_3 = v N cos theta", free=(tension, theta),
    components={
        v3: 1 + theory.dilatation_when_sheared(),
        scalar_v: theory.stretched_force() / tension * a,
        N: tension / sp.cos(theta),
    },
    positive=(chiral_gap, a / c, 1 / (c * tension), sp.sin(theta)),
    sample=lambda seed: {**_on_the_branch(seed), tension: sp.Rational(7 + 5 * seed, 11),
                         theta: sp.Rational((4, 30, 10)[seed % 3], 13)},
    simple=_small_states,
)  # fmt: skip

#: f_N for N > 0, whatever the moduli. w(x) > 0 on the closed interval, so that an identity (or a
#: sign) proved there needs no separate look at x = 0 and x = 1.
ON_COSINES = Meaning(
    name="all N > 0 and x in [0, 1]", free=(N, x), functions=_f(N),
    positive=(chiral_gap, N, theory.weight(x)),
    sample=_generic, simple=_small_points, route=_route_f,
    route_name="the law with K inverted numerically, numerical derivative, N = 1e60",
)  # fmt: skip
SOFT_COSINES = Meaning(
    name="all N > 0 and x in [0, 1], under condition 1", free=(N, x), functions=_f(N),
    positive=(*SOFTER_IN_SHEAR, N, theory.weight(x)),
    sample=_on_the_branch, simple=_small_points, route=_route_f,
    route_name=ON_COSINES.route_name,
)  # fmt: skip


def _route_beyond(sign: int) -> Callable[[Point, Any], Values]:
    def route(point: Point, ctx: Any) -> Values:
        threshold = numeric_thrust(point, ctx.mpf(10) ** -40, ctx)  # the angle enters squared
        power = threshold ** -_number(ctx, point[p]) - sign * _number(ctx, point[delta])
        thrust = power ** (-1 / _number(ctx, point[p]))
        value = numeric_strains(point, [0] * 5 + [thrust], ctx)[5]
        return {N: thrust, fN(sp.Integer(1)): value}

    return route


def _beyond(sign: int) -> Meaning:
    """N^{-p} = N_thresh^{-p} -+ delta: N above or below its threshold."""
    power = theory.threshold_power() - sign * delta
    held = theory.softness() ** p - sign * delta  # N^{-p} + b^{p/2}, a sum of positive numbers
    thrust = power ** (-1 / p)
    return Meaning(
        name=f"N {'>' if sign > 0 else '<'} N_thresh", free=(delta,), components={N: thrust},
        functions=_f(thrust), positive=(*BRANCH_EXISTS, power, held), sample=_above,
        simple=_small_states, route=_route_beyond(sign),
        route_name="f_N(1) from the law with K inverted numerically",
    )  # fmt: skip


def _route_at_infinity(point: Point, ctx: Any) -> Values:
    cosine = numeric_cosine(point, ctx.mpf(10) ** 60, ctx)
    return {x: cosine, theta_hat_infinity: ctx.acos(cosine)}


ABOVE_THRESHOLD, BELOW_THRESHOLD = _beyond(1), _beyond(-1)

#: The limit N -> oo of the branch: x is the cosine of the limiting angle.
AT_INFINITY = Meaning(
    name="the limit N -> oo on the branch", free=(),
    components={x: theory.limiting_cosine(), theta_hat_infinity: sp.acos(theory.limiting_cosine())},
    functions=_f(N), positive=(*BRANCH_EXISTS, theory.limiting_cosine()),
    sample=_on_the_branch, simple=_small_limits, route=_route_at_infinity,
    route_name="angle by a root search on the moment balance at N = 1e60",
)  # fmt: skip
