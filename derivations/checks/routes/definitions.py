"""Second routes to definitions with a formula: frames and deformations as numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import sympy as sp

from rodproof.derivations.checks.kinematics import FRAMES, VECTORS
from rodproof.derivations.checks.orientation import STRAINED, det, measured_determinant
from rodproof.derivations.exact.evaluate import Evaluator
from rodproof.derivations.notation import instances
from rodproof.derivations.proof.prover import claims
from rodproof.derivations.proof.routed import Route, apart, at_odds, excess, short
from rodproof.derivations.proof.vectors import symbols_of
from rodproof.derivations.symbols import STRAINS

_FRAMES = 6  # enough for both signs of v_3


def _framed(seed: int, ctx: Any) -> dict[Any, Any]:
    """A frame by numerical quaternion products, r' in the fixed basis and in the frame."""
    assert FRAMES.route is not None
    point = FRAMES.sample(seed)
    found = FRAMES.evaluator(ctx, point).values
    return {**found, **FRAMES.route(point, ctx)}


def _consequences(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Where r' has a positive component along d_3 the rest holds; both signs must occur."""
    hypotheses, conclusions = (VECTORS.spread(part).args for part in printed.args)
    senses = set()
    for seed in range(_FRAMES):
        evaluate = Evaluator(ctx, _framed(seed, ctx))
        held = all(excess(h, evaluate) > 0 for h in hypotheses)
        senses.add(held)
        for claim in conclusions if held else ():
            yield short(excess(claim, evaluate))
    if senses != {True, False}:
        yield math.inf


CONSEQUENCES = Route("r' in frames of numerical quaternions, v_3 of both signs", _consequences)


def _forwards(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The claim holds exactly where r' is on the side of d_3 that the quaternion gives."""
    (claim,) = claims(printed)
    for seed in range(_FRAMES):
        values = _framed(seed, ctx)
        frame = [[values[s] for s in symbols_of(f"d{k}")] for k in (1, 2, 3)]
        tangent = [values[s] for s in symbols_of("r_rate")]
        along = ctx.fdot(zip(frame[2], tangent, strict=True))
        for wanted in (along, ctx.mpf(10) ** -12, -(ctx.mpf(10) ** -12)):
            moved = [x + (wanted - along) * d for x, d in zip(tangent, frame[2], strict=True)]
            v = ctx.lu_solve(ctx.matrix(frame).T, ctx.matrix(moved))
            strains = dict(zip(STRAINS[3:], v, strict=True))
            yield at_odds(wanted, excess(claim, Evaluator(ctx, {**values, **strains})))


FORWARDS = Route("d_3 . r' in frames of numerical quaternions", _forwards)


def _orthonormal(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The equations hold for turned frames, and not for frames with one vector disturbed."""
    equations = VECTORS.spread(printed).args
    for seed in range(2):
        values = _framed(seed, ctx)
        for claim in equations:
            yield apart(claim, Evaluator(ctx, values))
        d1, d2 = ([values[s] for s in symbols_of(name)] for name in ("d1", "d2"))
        scaled = [ctx.mpf(7) / 6 * x for x in d1], [ctx.mpf(7) / 6 * x for x in d2]
        turn = ctx.mpf(1) / 9
        tilted = [ctx.cos(turn) * x + ctx.sin(turn) * y for x, y in zip(d2, d1, strict=True)]
        for first, second in ((scaled[0], d2), (d1, scaled[1]), (d1, tilted)):
            wrong = dict(zip((*symbols_of("d1"), *symbols_of("d2")), (*first, *second),
                             strict=True))  # fmt: skip
            misses = [apart(claim, Evaluator(ctx, {**values, **wrong})) for claim in equations]
            yield 0 if max(misses) > 1e-10 else math.inf


ORTHONORMAL = Route("frames of numerical quaternions, turned and disturbed", _orthonormal)


def _volume(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """The claim at a place holds exactly if the numerical deformation keeps the sense there."""
    (claim,) = instances(printed)
    condition = claim.args[1]
    for seed in range(2):
        for sense in (1, -1):
            point = dict(STRAINED.sample(seed))
            point[STRAINS[5]] *= 4 * sense  # far from the border, on either side
            found = measured_determinant(point, ctx)[det]
            stated = excess(condition, Evaluator(ctx, {det: found}))
            yield at_odds(STRAINED.evaluator(ctx, point)(det), stated)
            yield abs(STRAINED.evaluator(ctx, point)(det) - found)


VOLUME = Route("deformation of a uniformly strained rod, differentiated numerically", _volume)
