"""Second routes to Section 5: what viscous laws dissipate, and the moduli of dsDNA."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.routes import law
from rodproof.derivations.checks.routes.constants import least_v3, measured_moduli
from rodproof.derivations.checks.routes.law import Values
from rodproof.derivations.exact.evaluate import Evaluator, context, numbers
from rodproof.derivations.notation import instances
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.prover import ROUTE_POINTS, claims
from rodproof.derivations.proof.routed import Route, at_odds, differ, excess
from rodproof.derivations.symbols import CONSTANTS, STRAINS, gamma, v3
from rodproof.derivations.theory import dna
from rodproof.derivations.theory.dissipation import second_time, time, viscosity_m, viscosity_n
from rodproof.derivations.theory.dna import nm, pN

# -- dissipation ---------------------------------------------------------------------------------

_OURS = (time, second_time, viscosity_m, viscosity_n)


def _losses(values: Values, given: Values, rates: list[Any], ctx: Any) -> tuple[Any, Any]:
    """(sigma - DW(eps)) . eps_t of the Kelvin-Voigt law and of the strain-rate law times the time.

    The first from the loads m = DW + mu u_t, n = DW + nu v_t; the second from the loads that a
    root search finds at eps + alpha eps_t.
    """
    measured = NumericLaw(values, ctx)
    eps = [measured.c[x] for x in STRAINS[:5]] + [measured.c[v3] - 1]
    now = measured.loads(eps)
    ahead = measured.loads([e + given[time] * r for e, r in zip(eps, rates, strict=True)])
    weights = [given[viscosity_m]] * 3 + [given[viscosity_n]] * 3
    viscous = [f + k * r for f, k, r in zip(now, weights, rates, strict=True)]

    def power(loads: list[Any]) -> Any:
        return ctx.fsum((a - b) * r for a, b, r in zip(loads, now, rates, strict=True))

    return power(viscous), power(ahead)


def _ranges(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Processes with the stated ranges, the other constants of either sign: none may gain energy.

    And each stated range is needed: with that constant alone negative some process gains energy.
    """
    stated = set()
    for claim in claims(printed):
        if claim.relations != (">=",) or claim.sides[1] != 0:
            yield math.inf
        stated.add(claim.sides[0])
    motions = [law.unit(k, ctx.mpf(1) / 50) for k in (0, 2, 4, 5)]
    values = numbers(ctx, sampling.with_strains(0))
    size = dict(zip(_OURS, (ctx.mpf(k) / 7 for k in (2, 3, 5, 9)), strict=True))

    def least(signs: dict[sp.Symbol, int]) -> Any:
        given = {x: signs.get(x, 1) * size[x] for x in _OURS}
        return min(min(_losses(values, given, rates, ctx)) for rates in motions)

    free = [x for x in _OURS if x not in stated]
    for signs in itertools.product((1, -1), repeat=len(free)):
        yield max(0, -least(dict(zip(free, signs, strict=True))))
    for x in stated:
        yield 0 if least({x: -1}) < 0 else math.inf


RANGES = Route("power of the loads of both laws, by root search, with constants of both signs",
               _ranges)  # fmt: skip

# -- dsDNA ---------------------------------------------------------------------------------------


def _dsdna(seed: int, ctx: Any) -> dict[sp.Symbol, Any]:
    """Generic gamma, p, zeta and units, and the constants that the four data then give."""
    point = {**sampling.constants(seed), gamma: sp.Rational(311 + seed, 7),
             pN: sp.Rational(5, 3), nm: sp.Rational(7, 4)}  # fmt: skip
    values = numbers(ctx, point)
    given = {x: Evaluator(ctx, values)(e) for x, e in dna.constants().items()}
    return {**values, **given}


def _datum(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Both sides are one entry of the stiffness at rest of a rod with the constants of dsDNA."""
    for seed in range(ROUTE_POINTS):
        values = _dsdna(seed, ctx)
        evaluate, entries = Evaluator(ctx, values), measured_moduli(values, ctx)
        left, right = (evaluate(side) for side in printed.sides)
        yield max(differ(left, right), min(differ(right, entry) for entry in entries))


DATUM = Route("stiffness at rest from strains under loads of size 1e-200, inverted", _datum)


def _fixed(printed: sp.Basic, _: Any) -> Iterator[Any]:
    """The quantities and the four measured moduli are functions of one another."""
    ctx = context(law.SPARE)
    values = numbers(ctx, sampling.constants(0))
    where = [m.entry for m in dna.DSDNA.values()]

    def moduli(at: Values) -> list[Any]:
        tangent = law.stiffness_at_rest(at, ctx)
        return [tangent[i, j] for i, j in where]

    def quantities(at: Values) -> list[Any]:
        return [Evaluator(ctx, at)(q) for q in printed.args]

    known, listed = (law.logarithmic_jacobian(f, values, CONSTANTS, ctx)
                     for f in (moduli, quantities))  # fmt: skip
    yield law.outside(listed, known, ctx)
    independent = min(law.singular_values(listed, ctx)) > 1e-10
    yield law.outside(known, listed, ctx) if independent else math.inf


FIXED = Route("measured moduli differentiated by the constants; least squares", _fixed)


def _orientation(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
    """Both conditions at a generic gamma, and just below and above where least v_3 is zero."""
    (claim,) = instances(printed)
    for seed in range(ROUTE_POINTS):
        values = _dsdna(seed, ctx)

        def rod(at: Values) -> dict[sp.Symbol, Any]:
            free = {x: e for x, e in at.items() if x not in dna.constants()}
            given = {x: Evaluator(ctx, free)(e) for x, e in dna.constants().items()}
            return {**free, **given}

        pair = law.border(lambda at: least_v3(rod(at), ctx), values, gamma, ctx, (1, 9000))
        for at in (values, *pair):
            evaluate = Evaluator(ctx, rod(at))
            sides = [excess(side, evaluate) for side in claim.args]
            yield at_odds(least_v3(rod(at), ctx), *sides)


ORIENTATION = Route("least v_3 over Q < 1 by a numerical linear solve, on both sides",
                    _orientation)  # fmt: skip
