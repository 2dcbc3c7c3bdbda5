"""Second routes for Section 4.2: roots by search, K inverted and frames turned numerically."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.thrust.points import (
    N_thresh,
    R,
    angle,
    fN,
    psi0,
    scalar_v,
    theta_hat,
    theta_Nk,
    x_N,
    x_Nk,
)
from rodproof.derivations.exact.evaluate import number
from rodproof.derivations.notation import LimitOf
from rodproof.derivations.proof.meaning import Point, Values
from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    u3,
    v3,
)  # fmt: skip
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.thrust import N, s, x

# -- second routes ----------------------------------------------------------------------------


def strains_at(point: Mapping[sp.Symbol, Any], load: list[Any], ctx: Any) -> list[Any]:
    """The law as it stands, with K inverted numerically: (1 + Q*^{p/2})^{-1/p} K^{-1} sigma."""
    return NumericLaw(point, ctx).under(load)


class NoShearedState(ValueError):
    """No thrust, small or large, brings r' along g_3 at an angle."""


def thrust_at(point: Mapping[sp.Symbol, Any], polar: Any, ctx: Any) -> Any:
    """N > 0 at which r' is along g_3 for the given angle, by a root search.

    Raises NoShearedState where r' x n keeps one sign.
    """
    law = NumericLaw(point, ctx)

    def at(log_thrust: Any) -> Any:
        return off_axis(law, ctx.exp(log_thrust), polar)

    low, high = ctx.mpf(-20), ctx.mpf(60)
    if not at(low) * at(high) < 0:
        raise NoShearedState("no sheared state at this angle")
    while high - low > 1:
        middle = (low + high) / 2
        low, high = (middle, high) if at(low) * at(middle) > 0 else (low, middle)
    return ctx.exp(ctx.findroot(at, (low, high), solver="anderson"))


def off_axis(law: NumericLaw, thrust: Any, polar: Any) -> Any:
    """The part of r' across g_3 over sin(theta), under N g_3 at an angle of d_3."""
    sine, cosine = law.ctx.sin(polar), law.ctx.cos(polar)
    strain = law.under([0, 0, 0, -thrust * sine, 0, thrust * cosine])
    return strain[3] * cosine / sine + 1 + strain[5]


def cosine_at(point: Point, thrust: Any, ctx: Any) -> Any:
    """cos theta of the sheared state under a given thrust, by a root search in the angle."""
    law, ends = NumericLaw(point, ctx), (ctx.mpf(10) ** -10, ctx.pi / 2)
    return ctx.cos(ctx.findroot(lambda at: off_axis(law, thrust, at), ends, solver="anderson"))


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
    strain = strains_at(point, [0, 0, 0, *force], ctx)
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


def route_at(sign: int, polar: Callable[[Any, Point], Any]) -> Callable[[Point, Any], Values]:
    """The state under the thrust of this sign at the point's angles, theta from ``polar``."""

    def route(point: Point, ctx: Any) -> Values:
        angles = (number(ctx, point[phi]), polar(ctx, point), number(ctx, point[psi]))
        return _state_numbers(point, ctx, sign * number(ctx, point[R]), angles)

    return route


def route_straight(sign: int) -> Callable[[Point, Any], Values]:
    """The straight state under the thrust of this sign, turned by its own twist."""

    def route(point: Point, ctx: Any) -> Values:
        thrust, azimuth = sign * number(ctx, point[R]), number(ctx, point[phi])
        twist = strains_at(point, [0] * 5 + [thrust], ctx)[2]
        psi_of_s = twist * number(ctx, point[s]) + number(ctx, point[psi0]) - azimuth
        return _state_numbers(point, ctx, thrust, (azimuth, ctx.mpf(0), psi_of_s))

    return route


def route_on_branch(point: Point, ctx: Any) -> Values:
    """N by the root search; the strains, the frame and r' from the numerical law."""
    polar = number(ctx, point[angle])
    thrust = thrust_at(point, polar, ctx)
    twist = strains_at(
        point, [0] * 3 + [-thrust * ctx.sin(polar), 0, thrust * ctx.cos(polar)], ctx
    )[2]
    psi_of_s = twist * number(ctx, point[s]) + number(ctx, point[psi0])
    found = dict(_state_numbers(point, ctx, thrust, (ctx.mpf(0), polar, psi_of_s)))
    return found | {x_N: ctx.cos(polar), theta: polar, theta_hat: polar, theta_Nk: polar,
                    x_Nk: ctx.cos(polar), fN(sp.cos(theta)): found[v3] - 1,
                    fN(x_N): found[v3] - 1,
                    N_thresh: thrust_at(point, ctx.mpf(10) ** -25, ctx)}  # fmt: skip


def route_f(point: Point, ctx: Any) -> Values:
    """f_N(x) from the numerical law, its slope by a numerical derivative, its limit far away."""

    def value(at: Any, thrust: Any) -> Any:
        load = [0, 0, 0, thrust * ctx.sqrt(1 - at**2), 0, thrust * at]
        return strains_at(point, load, ctx)[5].real

    at, thrust = number(ctx, point[x]), number(ctx, point[N])
    far = ctx.mpf(10) ** 60
    return {
        fN(x): value(at, thrust),
        fN(sp.Integer(1)): value(ctx.mpf(1), thrust),
        fN(sp.Integer(0)): value(ctx.mpf(0), thrust),
        LimitOf(fN(sp.Integer(1)), N, sp.oo): value(ctx.mpf(1), far),
        LimitOf(fN(x), N, sp.oo): value(at, far),
    }


def route_far(point: Point, ctx: Any) -> Values:
    """The straight strains under thrusts of 10^60 and -10^60."""
    found: dict[sp.Basic, Any] = {}
    for sign, target in ((1, sp.oo), (-1, -sp.oo)):
        strain = strains_at(point, [0] * 5 + [sign * ctx.mpf(10) ** 60], ctx)
        found[LimitOf(u3, N, target)] = strain[2]
        found[LimitOf(v3 - 1, N, target)] = strain[5]
    return found
