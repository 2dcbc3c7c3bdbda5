"""Second routes to claims on states under couples: the law and frames, turned numerically."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import sympy as sp

from rodproof.derivations.checks.couple.route import length
from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.equilibrium import cross, dot, norm
from rodproof.derivations.checks.routes import law
from rodproof.derivations.checks.routes.law import Values
from rodproof.derivations.checks.thrust.numeric import turned
from rodproof.derivations.exact.evaluate import Evaluator, context, numbers
from rodproof.derivations.notation import Every, Iff, Prime, instances
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.prover import DIGITS, ROUTE_POINTS, claims
from rodproof.derivations.proof.routed import (
    ZERO,
    Route,
    at_odds,
    differ,
    excess,
    short,
    vanish_together,
)
from rodproof.derivations.symbols import LOADS, STRAINS, gamma, iota
from rodproof.derivations.theory.euler import M1, M2, M3
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.loading import couple, phase

# -- what couples do ----------------------------------------------------------------------------


def _generic(seed: int, ctx: Any) -> dict[sp.Symbol, Any]:
    """Generic constants, couples and angles."""
    point = {**sampling.with_loads(seed), gamma: sp.Integer(1) + seed}
    angles = {phi: (-9, 14)[seed % 2], theta: (11, 25)[seed % 2], psi: (8, -13)[seed % 2]}
    return numbers(ctx, {**point, **{x: sp.Rational(k, 19) for x, k in angles.items()}})


def _poynting(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Couples of all signs with bending: the premise holds exactly where the conclusion does."""
    (claim,) = instances(printed)
    for seed in range(2 * ROUTE_POINTS):
        values = _generic(seed, ctx)
        for sense in (1, -1):
            bent = [values[x] for x in LOADS[:2]]
            load = [*bent, sense * values[LOADS[2]], 0, 0, 0]
            strain = law.strains(values, load, ctx)
            at = {**values, **dict(zip(LOADS, load, strict=True)),
                  **dict(zip(STRAINS, (*strain[:5], 1 + strain[5]), strict=True))}  # fmt: skip
            evaluate = Evaluator(ctx, at)
            yield at_odds(*(excess(part, evaluate) for part in claim.args))


POYNTING = Route("the law with K solved numerically, couples of either chirality", _poynting)


def _twisted(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The length of r' under a couple about d_3, for both signs of iota and M_3 and without."""
    parts = printed.args if isinstance(printed, Every) else (printed,)
    for seed in range(ROUTE_POINTS):
        generic = _generic(seed, ctx)
        for chirality, sense in ((1, 1), (1, -1), (-1, 1), (-1, -1), (0, 1), (1, 0)):
            values = {**generic, iota: chirality * generic[iota]}
            size = sense * generic[LOADS[2]] / 9  # v_3 > 0 for sure
            values |= {M3: size, M1: ctx.mpf(0), M2: ctx.mpf(0)}
            strain = law.strains(values, law.unit(2, size), ctx) if sense else [ctx.mpf(0)] * 6
            values |= dict(zip(STRAINS, (*strain[:5], 1 + strain[5]), strict=True))
            frame = turned(ctx, *(values[x] for x in (phi, theta, psi)))
            along = [sum((strain[3 + k] + (k == 2)) * frame[k][i] for k in range(3))
                     for i in range(3)]  # fmt: skip
            evaluate = Evaluator(ctx, {**values, length: norm(along, ctx)})
            for part in parts:
                yield _holds(instances(part)[0], evaluate)


def _holds(claim: sp.Basic, evaluate: Evaluator) -> Any:
    """The margin by which an equivalence of signs, or of what is not zero, fails."""
    if isinstance(claim, Iff):
        return at_odds(*(excess(side, evaluate) for side in claim.args))
    given, found = (abs(evaluate(side.args[0] - side.args[1])) for side in claim.args)
    return math.inf if given > ZERO and found < ZERO else 0.0


TWISTED = Route("|r'| from the law with K solved numerically, in a turned frame", _twisted)


def _least(values: Values, ctx: Any) -> Any:
    """The least v_3 that couples of 1e60 about d_3 give."""
    far = ctx.mpf(10) ** 60
    return 1 + min(law.strains(values, law.unit(2, s * far), ctx)[5] for s in (1, -1))


def _least_stretch(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    (claim,) = instances(printed)
    for seed in range(ROUTE_POINTS):
        values = _generic(seed, ctx)
        edge = values[sp.Symbol("beta", positive=True)] * values[sp.Symbol("eta", positive=True)]
        pair = law.border(
            lambda at: _least(at, ctx), values, iota, ctx, (edge / 1000, 0.99999 * edge)
        )
        for at in (values, *pair):
            evaluate, measured = Evaluator(ctx, at), _least(at, ctx)
            sides = [excess(side, evaluate) for side in claim.args]
            yield differ(sides[0], measured)
            yield at_odds(measured, *sides)


LEAST_STRETCH = Route("the law with K solved numerically, couples of 1e60 and -1e60",
                      _least_stretch)  # fmt: skip

# -- the family of helices ----------------------------------------------------------------------


def _shape(values: Values, load: tuple[Any, Any, Any], ctx: Any) -> list[Any]:
    """(curvature, torsion, stretch) of the rod under a couple fixed in space.

    The frame moves by d_k' = u x d_k with the law for u; r', r'' and r''' are differentiated
    along that motion.
    """
    size, polar, twist = load
    measured = NumericLaw(values, ctx)
    spatial = [ctx.mpf(0), ctx.mpf(0), size]
    step = ctx.mpf(10) ** -30

    def strains(frame: list[Any]) -> list[Any]:
        inside = [dot(spatial, d, ctx) for d in frame]
        return measured.under([*inside, 0, 0, 0])

    def tangent(frame: list[Any]) -> list[Any]:
        strain = strains(frame)
        v = (strain[3], strain[4], 1 + strain[5])
        return [ctx.fsum(v[k] * frame[k][i] for k in range(3)) for i in range(3)]

    def moved(frame: list[Any], by: Any) -> list[Any]:
        strain = strains(frame)
        u = [ctx.fsum(strain[k] * frame[k][i] for k in range(3)) for i in range(3)]
        return [[x + by * y for x, y in zip(d, cross(u, d), strict=True)] for d in frame]

    def rate(function: Callable[[list[Any]], list[Any]]) -> Callable[[list[Any]], list[Any]]:
        def at(frame: list[Any]) -> list[Any]:
            ahead, behind = (function(moved(frame, by)) for by in (step, -step))
            return [(x - y) / (2 * step) for x, y in zip(ahead, behind, strict=True)]

        return at

    frame = turned(ctx, ctx.mpf(0), polar, twist)
    first = tangent(frame)
    second, third = rate(tangent)(frame), rate(rate(tangent))(frame)
    area = cross(first, second)
    size_of_area = norm(area, ctx)
    return [size_of_area / norm(first, ctx) ** 3, dot(area, third, ctx) / size_of_area**2,
            norm(first, ctx)]  # fmt: skip


def _family(printed: sp.Basic, _: Any) -> Iterator[Any]:
    """The shape moves with each parameter on its own, and the family has no other.

    All of the couple's size, its angle and the turn of the directors are tried.
    """
    ctx = context(3 * DIGITS)
    values = _generic(0, ctx)
    at = {couple: ctx.mpf(7) / 5, theta: ctx.mpf(11) / 19, phase: ctx.mpf(3) / 7}

    def jacobian(parameters: tuple[sp.Symbol, ...]) -> Any:
        return law.logarithmic_jacobian(
            lambda here: _shape(values, tuple(here[x] for x in at), ctx), at, parameters, ctx
        )

    whole, stated = jacobian(tuple(at)), jacobian(tuple(printed.args))
    sizes, own = law.singular_values(whole, ctx), law.singular_values(stated, ctx)
    count = len(printed.args)
    yield sizes[count] if count < len(sizes) else 0
    yield 0 if own[count - 1] > 1e-10 else math.inf


FAMILY = Route(
    "curvature, torsion and stretch by three derivatives along a frame that the law moves; "
    "singular values",
    _family,
)

# -- rates of the angles ------------------------------------------------------------------------


def _rates(
    measured: NumericLaw, values: Values, across: Mapping[sp.Symbol, Any], ctx: Any
) -> dict[sp.Basic, Any]:
    """theta' and phi' of a rod that carries these M_1, M_2, M_3 and no force: d_3' = u x d_3."""
    polar, azimuth = values[theta], values[phi]
    frame = turned(ctx, azimuth, polar, values[psi])
    basis = turned(ctx, azimuth, polar, ctx.mpf(0))
    vector = [ctx.fsum(across[M] * basis[k][i] for k, M in enumerate((M1, M2, M3)))
              for i in range(3)]  # fmt: skip
    strain = measured.under([*(dot(vector, d, ctx) for d in frame), 0, 0, 0])
    u = [ctx.fsum(strain[k] * frame[k][i] for k in range(3)) for i in range(3)]
    turning = cross(u, frame[2])
    around = turning[1] * frame[2][0] - turning[0] * frame[2][1]
    return {Prime(theta): -turning[2] / ctx.sin(polar), Prime(phi): around / ctx.sin(polar) ** 2}


def _zeros(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Both sides vanish for the same couples: at zeros of each component, and of each rate."""
    (claim,) = instances(printed)
    for seed in range(ROUTE_POINTS):
        values = _generic(seed, ctx)
        measured = NumericLaw(values, ctx)
        generic = dict(zip((M1, M2, M3), (values[x] for x in LOADS[:3]), strict=True))

        def sides(across: Mapping[sp.Symbol, Any], values: Values = values,
                  measured: NumericLaw = measured) -> list[Any]:  # fmt: skip
            given = _rates(measured, values, across, ctx)
            found = []
            for side in claim.args:
                rated = {x: sp.Symbol(f"rate{k}") for k, x in enumerate(given)}
                known = {rated[x]: value for x, value in given.items()}
                difference = (side.sides[0] - side.sides[1]).xreplace(rated)
                found.append(Evaluator(ctx, {**values, **across, **known})(difference))
            return found

        yield vanish_together(*sides(generic))
        for component in (M1, M2, M3):
            yield vanish_together(*sides({**generic, component: ctx.mpf(0)}))
            ends = (ctx.mpf(-13) / 7, ctx.mpf(11) / 6)
            for k in range(len(claim.args)):

                def side(x: Any, k: int = k, component: sp.Symbol = component,
                         generic: Values = generic) -> Any:  # fmt: skip
                    return sides({**generic, component: x})[k]

                if side(ends[0]) * side(ends[1]) < 0:
                    at = ctx.findroot(side, ends, solver="anderson")
                    yield max(map(abs, sides({**generic, component: at})))


ZEROS = Route("rates of the angles from u x d_3, the law with K solved numerically", _zeros)


def _vanish(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Each side as a linear map of (m_1, m_2, m_3), measured: regular, and zero at zero."""
    for seed in range(ROUTE_POINTS):
        values = _generic(seed, ctx)
        azimuth, polar, twist = (values[x] for x in (phi, theta, psi))
        frame, basis = (turned(ctx, azimuth, polar, x) for x in (twist, ctx.mpf(0)))

        def measured(m: list[Any], frame: Any = frame, basis: Any = basis) -> dict[Any, Any]:
            vector = [ctx.fsum(m[k] * frame[k][i] for k in range(3)) for i in range(3)]
            across = (dot(vector, e, ctx) for e in basis)
            names = (*LOADS[:3], M1, M2, M3)
            return dict(zip(names, (*m, *across), strict=True))

        for side in printed.args:
            equations = [left - right for claim in claims(side) for left, _, right in claim.links()]

            def misses(m: list[Any], equations: Any = equations) -> list[Any]:
                evaluate = Evaluator(ctx, measured(m))
                return [evaluate(e) for e in equations]

            yield max(map(abs, misses([ctx.mpf(0)] * 3)))
            columns = [misses([ctx.mpf(int(i == k)) for i in range(3)]) for k in range(3)]
            sizes = law.singular_values(ctx.matrix(columns), ctx)
            yield 0 if min(sizes) > 1e-10 else math.inf


VANISH = Route("components in both frames, turned numerically; singular values", _vanish)


def _flexure(turn: Any, values: Values, ctx: Any) -> Any:
    """u . e_1 of a frame whose azimuth turns at a given rate and whose polar angle is constant."""

    def frame(s: Any) -> list[Any]:
        spin = ctx.mpf(3) / 7
        return turned(ctx, values[phi] + s * turn, values[theta], values[psi] + s * spin)

    step = ctx.mpf(10) ** -12
    here, ahead, behind = (frame(k * step) for k in (0, 1, -1))
    u = [ctx.mpf(0)] * 3
    for d, x, y in zip(here, ahead, behind, strict=True):
        rate = [(a - b) / (2 * step) for a, b in zip(x, y, strict=True)]
        u = [a + b / 2 for a, b in zip(u, cross(d, rate), strict=True)]
    return dot(u, turned(ctx, values[phi], values[theta], ctx.mpf(0))[0], ctx)


def _azimuth(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The azimuth's rate at which the flexure along e_1 is zero, by a root search."""
    premises, conclusion = printed.args
    rate = sp.Symbol("rate")
    for seed in range(ROUTE_POINTS):
        values = _generic(seed, ctx)
        found = ctx.findroot(
            lambda turn, values=values: _flexure(turn, values, ctx),
            (ctx.mpf(-2), ctx.mpf(3)),
        )  # fmt: skip
        evaluate = Evaluator(ctx, {**values, rate: found})
        for claim in (premises.args[1], conclusion):
            left, right = (side.xreplace({Prime(phi): rate}) for side in claim.sides)
            yield abs(evaluate(left - right))
        yield short(abs(evaluate(premises.args[0].args[0])))


AZIMUTH = Route("rate of the azimuth by a root search for zero flexure of a turned frame",
                _azimuth)  # fmt: skip
