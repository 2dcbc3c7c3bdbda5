"""The domains of Section 4.2: pure thrust, straight and sheared states, the function f_N.

Both signs of N have their own domain (N = R and N = -R with R > 0), so that |N| is never assumed;
N = 0 is a domain too. On the branch of sheared states the angle is free and N follows from it in
closed form, so that every claim about the branch is an identity. The second routes know nothing
of that: they find N by a root search on the moment balance, with K inverted numerically.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import sympy as sp

from rodproof.derivations.checks.thrust.numeric import (
    cosine_at,
    route_at,
    route_f,
    route_far,
    route_on_branch,
    route_straight,
    strains_at,
    thrust_at,
)
from rodproof.derivations.checks.thrust.points import (
    BRANCH_EXISTS,
    SOFTER_IN_SHEAR,
    N_thresh,
    R,
    a,
    above,
    angle,
    b,
    c,
    delta,
    fN,
    generic,
    on_the_branch,
    psi0,
    scalar_v,
    small_limits,
    small_points,
    small_states,
    strand_radius,
    strand_sense,
    strand_stretch,
    strand_twist,
    tension,
    theta_hat,
    theta_hat_infinity,
    theta_Nk,
    x_N,
    x_Nk,
)
from rodproof.derivations.exact.evaluate import number
from rodproof.derivations.notation import LimitOf
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    beta,
    chiral_gap,
    eta,
    iota,
    p,
    u3,
    v3,
)  # fmt: skip
from rodproof.derivations.theory import euler
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import euler_frame, phi, psi, theta
from rodproof.derivations.theory.thrust import N, s, x

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


# -- the domains ------------------------------------------------------------------------------

_LAW = "the law with K inverted numerically, in a frame turned numerically"


def _couples() -> dict[sp.Symbol, sp.Expr]:
    """M_k = m . e_k for m = m_k d_k."""
    return {sp.Symbol(f"M{k}", real=True): part
            for k, part in enumerate(euler.couple_in_frame(), 1)}  # fmt: skip


COUPLES = Meaning(
    name="all couples and angles", free=LOADS[:3], components=_couples(), sample=generic,
    simple=lambda: (),
)  # fmt: skip


def _any_angle(sign: int) -> Meaning:
    return Meaning(
        name=f"any angles, N {'>' if sign > 0 else '<'} 0", free=(R, theta, phi, psi),
        components=_components(sign * R, theta, phi, psi), functions=_f(sign * R),
        positive=(chiral_gap, theory.dual_form(R, theta)),
        sample=generic, simple=small_points,
        route=route_at(sign, lambda ctx, point: number(ctx, point[theta])), route_name=_LAW,
    )  # fmt: skip


PUSHED_OR_PULLED = (_any_angle(1), _any_angle(-1))  # balanced or not


def sheared_residual() -> sp.Expr:
    """v_3 - v N cos theta under a tension, from the balance of couples over -N sin theta."""
    couple = theory.unbalanced_couple(R, theta, psi, phi)[1]
    return -couple / (R * sp.sin(theta))


AT_REST = Meaning(
    name="N = 0, any angles", free=(theta, phi, psi),
    components=_components(sp.Integer(0), theta, phi, psi), positive=(chiral_gap,),
    sample=generic, simple=small_points,
)  # fmt: skip


def _straight(sign: int, polar: sp.Expr) -> Meaning:
    """theta = 0 or pi; only phi + psi (phi - psi) is determined, so phi is left free."""
    strains = theory.strains_from_rest(sign * R, polar, sp.Integer(0))
    twist = strains[2] * s + psi0 - phi * sp.cos(polar)
    found = _components(sign * R, polar, phi, twist) | {theta: polar, psi: twist}
    return Meaning(
        name=f"theta = {polar}, N {'>' if sign > 0 else '<'} 0", free=(R, phi, psi0, s),
        components=found, positive=(chiral_gap,), sample=generic, simple=small_states,
        route=route_straight(sign) if polar == 0 else None, route_name=_LAW,
    )  # fmt: skip


v3_at_last, last_thrust, v3_slope = sp.symbols("v_3^{0} N^{0} v_3_N", real=True)


def _sample_compressible(seed: int) -> Point:
    """Constants with eta < 1, so that b > 1."""
    point = {**generic(seed), eta: sp.Rational(11 + 2 * seed, 19)}
    return {**point, iota: sp.Rational(2, 5) * point[beta] * point[eta] * (-1) ** seed}


def _route_last(point: Point, ctx: Any) -> Values:
    """The thrust at which the numerical law has v_3 = 0, by a root search."""

    def v_3(log_thrust: Any) -> Any:
        return 1 + strains_at(point, [0] * 5 + [-ctx.exp(log_thrust)], ctx)[5]

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
    simple=small_states, route=_route_last,
    route_name="root search for v_3 = 0 in the law with K inverted numerically",
)  # fmt: skip

#: The straight state as a function of N of either sign, for limits.
FAR = Meaning(
    name="theta = 0, N large", free=(N,),
    components={u3: theory.straight_strain(2), v3: 1 + theory.straight_strain(5)},
    positive=(chiral_gap,), sample=generic, simple=small_states, route=route_far,
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
        sample=on_the_branch, simple=small_states,
        route=route_on_branch if sign > 0 else None,
        route_name="N by a root search on the moment balance; " + _LAW,
    )  # fmt: skip


BRANCH, MIRRORED_BRANCH = _branch(1), _branch(-1)
#: The same with theta itself free, for limits in theta.
BRANCH_FROM_ZERO = Meaning(
    name="sheared states near theta = 0", free=(theta,),
    components={N: theory.thrust_near_zero(theta), N_thresh: theory.threshold()},
    positive=BRANCH_EXISTS, sample=on_the_branch, simple=small_states,
    route=lambda point, ctx: {
        LimitOf(N, theta, sp.Integer(0)): thrust_at(point, ctx.mpf(10) ** -40, ctx)
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
    sample=lambda seed: {**on_the_branch(seed), tension: sp.Rational(7 + 5 * seed, 11),
                         theta: sp.Rational((4, 30, 10)[seed % 3], 13)},
    simple=small_states,
)  # fmt: skip

#: f_N for N > 0, whatever the moduli. w(x) > 0 on the closed interval, so that an identity (or a
#: sign) proved there needs no separate look at x = 0 and x = 1.
ON_COSINES = Meaning(
    name="all N > 0 and x in [0, 1]", free=(N, x), functions=_f(N),
    positive=(chiral_gap, N, theory.weight(x)),
    sample=generic, simple=small_points, route=route_f,
    route_name="the law with K inverted numerically, numerical derivative, N = 1e60",
)  # fmt: skip
SOFT_COSINES = Meaning(
    name="all N > 0 and x in [0, 1], under condition 1", free=(N, x), functions=_f(N),
    positive=(*SOFTER_IN_SHEAR, N, theory.weight(x)),
    sample=on_the_branch, simple=small_points, route=route_f,
    route_name=ON_COSINES.route_name,
)  # fmt: skip


def _route_beyond(sign: int) -> Callable[[Point, Any], Values]:
    def route(point: Point, ctx: Any) -> Values:
        threshold = thrust_at(point, ctx.mpf(10) ** -40, ctx)  # the angle enters squared
        power = threshold ** -number(ctx, point[p]) - sign * number(ctx, point[delta])
        thrust = power ** (-1 / number(ctx, point[p]))
        value = strains_at(point, [0] * 5 + [thrust], ctx)[5]
        return {N: thrust, fN(sp.Integer(1)): value}

    return route


def _beyond(sign: int) -> Meaning:
    """N^{-p} = N_thresh^{-p} -+ delta: N above or below its threshold."""
    power = theory.threshold_power() - sign * delta
    held = theory.softness() ** p - sign * delta  # N^{-p} + b^{p/2}, a sum of positive numbers
    thrust = power ** (-1 / p)
    return Meaning(
        name=f"N {'>' if sign > 0 else '<'} N_thresh", free=(delta,), components={N: thrust},
        functions=_f(thrust), positive=(*BRANCH_EXISTS, power, held), sample=above,
        simple=small_states, route=_route_beyond(sign),
        route_name="f_N(1) from the law with K inverted numerically",
    )  # fmt: skip


def _route_at_infinity(point: Point, ctx: Any) -> Values:
    cosine = cosine_at(point, ctx.mpf(10) ** 60, ctx)
    return {x: cosine, theta_hat_infinity: ctx.acos(cosine)}


ABOVE_THRESHOLD, BELOW_THRESHOLD = _beyond(1), _beyond(-1)

#: The limit N -> oo of the branch: x is the cosine of the limiting angle.
AT_INFINITY = Meaning(
    name="the limit N -> oo on the branch", free=(),
    components={x: theory.limiting_cosine(), theta_hat_infinity: sp.acos(theory.limiting_cosine())},
    functions=_f(N), positive=(*BRANCH_EXISTS, theory.limiting_cosine()),
    sample=on_the_branch, simple=small_limits, route=_route_at_infinity,
    route_name="angle by a root search on the moment balance at N = 1e60",
)  # fmt: skip
