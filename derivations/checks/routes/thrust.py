"""Second routes to claims on sheared states and the moduli: states by root search or none.

A state is found by searching for the thrust, or the angle, at which r' is along g_3 in the law
with K solved numerically. Whether there is one at all decides the conditions on the moduli.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.equilibrium import cross, norm
from rodproof.derivations.checks.routes import law
from rodproof.derivations.checks.routes.law import Values
from rodproof.derivations.checks.thrust import points
from rodproof.derivations.checks.thrust.numeric import NoShearedState, off_axis, thrust_at, turned
from rodproof.derivations.exact.evaluate import Evaluator, numbers
from rodproof.derivations.notation import Either, Iff, Implies, instances
from rodproof.derivations.proof.meaning import Point
from rodproof.derivations.proof.prover import ROUTE_POINTS, claims
from rodproof.derivations.proof.routed import Route, apart, at_odds, excess, short
from rodproof.derivations.symbols import STRAINS, eta, iota, zeta
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.thrust import N

_FAR = 60  # the power of ten of a thrust that stands for an infinite one


def _state(point: Point, thrust: Any, polar: Any, ctx: Any) -> dict[sp.Symbol, Any]:
    """What a claim may name, in a frame turned numerically; and |r' x n| as `couple`."""
    values = numbers(ctx, point)
    frame = turned(ctx, values[phi], polar, values[psi])
    force = [thrust * d[2] for d in frame]
    strain = law.strains(values, [0, 0, 0, *force], ctx) if thrust else [ctx.mpf(0)] * 6
    v = (strain[3], strain[4], 1 + strain[5])
    tangent = [ctx.fsum(v[k] * frame[k][i] for k in range(3)) for i in range(3)]
    largest = max(range(2), key=lambda k: abs(force[k]))
    scalar = v[largest] / force[largest] if force[largest] else ctx.mpf(1)
    found = {**values, **dict(zip(STRAINS, (*strain[:3], *v), strict=True)),
             theta: polar, N: thrust, points.scalar_v: scalar}  # fmt: skip
    return found | {_couple: norm(cross(tangent, [0, 0, thrust]), ctx)}


_couple = sp.Symbol("couple")


def _sheared(seed: int, sign: int, ctx: Any, **changed: Any) -> dict[sp.Symbol, Any]:
    """A sheared state in tension (sign 1) or compression, its thrust by root search."""
    point = {**points.on_the_branch(seed), **{_NAMED[k]: x for k, x in changed.items()}}
    polar = numbers(ctx, point)[points.angle]
    thrust = thrust_at(point, polar, ctx)
    return _state(point, sign * thrust, polar if sign > 0 else ctx.pi - polar, ctx)


_NAMED = {"zeta": zeta, "eta": eta, "iota": iota}

# -- states --------------------------------------------------------------------------------------


def _alternatives(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The balance of couples vanishes where the claim says so: at its roots and elsewhere.

    Without the hypothesis N != 0 the state at rest is looked at too.
    """
    given, claim = printed.args if isinstance(printed, Implies) else (None, printed)
    (whole, either) = instances(claim)[0].args
    for seed in range(ROUTE_POINTS):
        point = points.on_the_branch(seed)
        found = [_sheared(seed, sign, ctx) for sign in (1, -1)]
        for thrust in (found[0][N], -found[0][N]):
            found += [_state(point, thrust, polar, ctx)
                      for polar in (ctx.mpf(0), ctx.mpf(2) / 7, ctx.mpf(19) / 7)]  # fmt: skip
        if given != sp.Ne(N, 0):
            found.append(_state(point, ctx.mpf(0), ctx.mpf(2) / 7, ctx))
        for state in found:
            evaluate = Evaluator(ctx, state)
            misses = [apart(one, evaluate) for one in either.args]
            one_holds = min(misses) if isinstance(either, Either) else max(misses)
            for size in (apart(whole, evaluate), one_holds):
                balanced = state[_couple] < 1e-30
                yield size if balanced else (math.inf if size < 1e-30 else 0)


ALTERNATIVES = Route(
    "r' x n of frames turned numerically, at thrusts found by root search and elsewhere",
    _alternatives,
)


def _tensile(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Generic rods, and one so stiff in shear that v_3 is close to its bound."""
    (claim,) = claims(printed)
    for seed in range(ROUTE_POINTS):
        for sign in (1, -1):
            for changed in ({}, {"zeta": sp.Rational(1, 500)}):
                state = _sheared(seed, sign, ctx, **changed)
                yield state[_couple]
                yield short(excess(claim, Evaluator(ctx, state)))


TENSILE = Route("thrust of sheared states by root search on r' x n", _tensile)


def _signs(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Angles by a search for sign changes of r' x n over (0, pi), for thrusts of both signs."""
    (claim,) = instances(printed)
    for seed in range(ROUTE_POINTS):
        point = points.on_the_branch(seed)
        size = _sheared(seed, 1, ctx)[N]
        for thrust in (size, -size):
            state = _state(point, thrust, _sheared_angle(point, thrust, ctx), ctx)
            evaluate = Evaluator(ctx, state)
            yield state[_couple]
            yield at_odds(*(excess(side, evaluate) for side in claim.args))


def _sheared_angle(point: Point, thrust: Any, ctx: Any) -> Any:
    """The angle in (0, pi) at which r' is along g_3 under a thrust of either sign."""
    measured = NumericLaw(point, ctx)

    def across(at: Any) -> Any:
        return off_axis(measured, thrust, at)

    places = [ctx.pi * (2 * k + 1) / 48 for k in range(24)]
    ends = [across(x) for x in places]
    for k in range(23):
        if ends[k] * ends[k + 1] < 0:
            return ctx.findroot(across, (places[k], places[k + 1]), solver="anderson")
    raise ValueError("no sheared state under this thrust")


SIGNS = Route("angle of sheared states by root search over (0, pi), both signs of N", _signs)

# -- conditions on the moduli --------------------------------------------------------------------


def _axial(values: Values, ctx: Any) -> Any:
    """The strain per unit of a small tension."""
    h = ctx.mpf(10) ** -200
    return law.strains(values, law.unit(5, h), ctx)[5] / h


def _softness(values: Values, ctx: Any) -> Any:
    """By how much a small force across d_3 strains the rod more than one along it."""
    h, measured = ctx.mpf(10) ** -200, NumericLaw(values, ctx)
    return (measured.under(law.unit(3, h))[3] - measured.under(law.unit(5, h))[5]) / h


def _headroom(values: Values, ctx: Any) -> Any:
    """What v_3 - 1 of a straight rod reaches under 10^60, less what a sheared state needs.

    It needs r' along g_3 however small the angle: v_1 cos = -v_3 sin, by both compliances.
    """
    far = ctx.mpf(10) ** _FAR
    needed = _axial(values, ctx) / _softness(values, ctx)
    return law.strains(values, law.unit(5, far), ctx)[5] - needed


def _near(measure: Any, seed: int, ctx: Any) -> tuple[dict[sp.Symbol, Any], ...]:
    """A generic rod, and the same where a measured quantity changes sign as zeta does."""
    point = points.sheared_constants(seed)
    values = numbers(ctx, point)
    stiff = values[eta] if measure is _softness else _stiffest(values, ctx)
    pair = law.border(lambda at: measure(at, ctx), values, zeta, ctx, (values[zeta] / 9, stiff))
    return (values, *pair)


def _stiffest(values: Values, ctx: Any) -> Any:
    """A zeta at which the rod is only just softer in shear: its softness is still positive."""
    return (1 - ctx.mpf(10) ** -6) / ctx.sqrt(_axial(values, ctx))


def _sheared_from(values: Values, polar: Any, ctx: Any) -> dict[sp.Symbol, Any] | None:
    """A sheared state at this angle, or None where the search finds none."""
    try:
        thrust = thrust_at(values, polar, ctx)
    except NoShearedState:
        return None
    return _state({phi: sp.Integer(0), psi: sp.Integer(0), **values}, thrust, polar, ctx)


def _barely(values: Values, ctx: Any) -> dict[sp.Symbol, Any]:
    """A rod that is soft in extension, and softer in shear by one part in 10^6 or so."""
    soft = {**values, eta: ctx.mpf(10) ** -6, iota: values[iota] / 10**7}
    axial = _axial(soft, ctx)
    return {**soft, zeta: 1 / ctx.sqrt(axial + 2 * ctx.sqrt(axial))}


def _first_needed(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Wherever the search finds a sheared state the condition must hold."""
    found = 0
    for seed in range(ROUTE_POINTS):
        rods = _near(_softness, seed, ctx)
        for values in (*rods, _barely(rods[0], ctx)):
            state = _sheared_from(values, ctx.mpf(1) / 10**6, ctx)
            if state is None or not state[STRAINS[5]] > 0:
                continue
            found += 1
            evaluate = Evaluator(ctx, state)
            yield apart(printed.args[0], evaluate)
            yield short(excess(printed.args[1], evaluate))
    if not found:
        yield math.inf


FIRST_NEEDED = Route("sheared states by root search, on both sides of the condition",
                     _first_needed)  # fmt: skip


def _second_needed(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """v_3 - 1 of straight rods takes the value exactly where the condition holds."""
    value, condition = printed.args
    for seed in range(ROUTE_POINTS):
        for values in _near(_headroom, seed, ctx):
            evaluate = Evaluator(ctx, values)
            if not _headroom(values, ctx) > 0:
                yield 0 if excess(condition, evaluate) < 0 else math.inf
                continue
            state = _sheared_from(values, ctx.mpf(10) ** -20, ctx)
            if state is None:
                yield math.inf
                continue
            yield apart(value, Evaluator(ctx, state))
            yield short(excess(condition, evaluate))


SECOND_NEEDED = Route("sheared states by root search, on both sides of the condition",
                      _second_needed)  # fmt: skip


def _same_as(measure: Any) -> Route:
    """Every form of a condition holds exactly where the measured quantity is positive."""

    def misses(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
        given, claim = printed.args if isinstance(printed, Implies) else (None, printed)
        forms = claim.args if isinstance(claim, Iff) else (claim,)
        for seed in range(ROUTE_POINTS):
            rods = [*_near(measure, seed, ctx)]
            if isinstance(claim, Iff):  # a rod that is stiffer in shear than in extension
                rods.append({**rods[0], zeta: 3 * rods[0][eta]})
            for values in rods:
                evaluate = Evaluator(ctx, values)
                if given is not None and not excess(given, evaluate) > 0:
                    continue
                measured = measure(values, ctx)
                if measure is _headroom and _softness(values, ctx) < 0:
                    measured = ctx.mpf(-1)  # no sheared state at all
                try:
                    yield at_odds(measured, *(excess(form, evaluate) for form in forms))
                except TypeError:  # the root of a negative number
                    yield math.inf

    name = "compliances of the law at 1e-200" + (", v_3 at 1e60" if measure is _headroom else "")
    return Route(f"{name}, on both sides of the condition", misses)


FIRST, SECOND = _same_as(_softness), _same_as(_headroom)
