"""The states of Section 4.3 as domains: straight and twisted, helical, and their shape.

The polar angle runs through its half-angle tangent t in (0, 1], so that sines and cosines are
rational, and the couple through its size c > 0, once for each sign. The second route builds r(s)
and the directors of a state, measures strains, loads, angles and shape on these functions, and
weighs n' and m' + r' x n (module `equilibrium`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.couple.route import (
    Configuration,
    c,
    curvature,
    d1,
    d2,
    d3,
    length,
    m_g,
    measured,
    measured_shape,
    omega,
    pitch,
    r,
    r_s,
    radius,
    stretch,
    t,
    torsion,
)
from rodproof.derivations.exact.evaluate import context, number
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Prime
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values, of_vector
from rodproof.derivations.proof.prover import DIGITS, ROUTE_POINTS, Identity, claims
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import CONSTANTS, STRAINS, beta, chiral_gap, eta, gamma, v3
from rodproof.derivations.theory import couple as theory
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.constitutive import compliance_at_rest
from rodproof.derivations.theory.couple import psi_0, s
from rodproof.derivations.theory.euler import M1, M2, M3, phi_s, psi_s
from rodproof.derivations.theory.frames import phi, psi, theta

_COS, _SIN = (1 - t**2) / (1 + t**2), 2 * t / (1 + t**2)
#: theta = 2 arctan t.
HALF_ANGLE: Mapping[sp.Expr, sp.Expr] = {
    sp.sin(theta): _SIN, sp.cos(theta): _COS, sp.cot(theta): _COS / _SIN,
    sp.csc(theta): 1 / _SIN, theta: 2 * sp.atan(t),
}  # fmt: skip
UPRIGHT: Mapping[sp.Expr, sp.Expr] = {
    sp.sin(theta): sp.Integer(0),
    sp.cos(theta): sp.Integer(1),
    theta: sp.Integer(0),
}
RIGHT_ANGLE: Mapping[sp.Expr, sp.Expr] = {
    sp.sin(theta): sp.Integer(1),
    sp.cos(theta): sp.Integer(0),
    sp.cot(theta): sp.Integer(0),
    sp.csc(theta): sp.Integer(1),
    theta: sp.pi / 2,
}
_RATES = {phi: phi_s, psi: psi_s, M1: euler.M1_s, M2: euler.M2_s, M3: euler.M3_s,
          theta: euler.theta_s}  # fmt: skip


def prime(x: sp.Basic) -> sp.Expr:
    """x' as the symbol of its rate."""
    return _RATES[x]


# -- domains ------------------------------------------------------------------------------------


def sample(seed: int) -> Point:
    """Generic constants with gamma = 1, a couple, a polar angle and a place on the rod."""
    values = {
        x: sp.Rational((17 * k + 29 * seed) % 41 + 11, 97)
        for k, x in enumerate((c, t, s, psi_0, phi, omega, stretch))
    }
    known = sampling.constants(seed)
    values[t] = (values[t] + 1) / 2  # neither upright nor a circle
    values[c] *= known[beta] * known[eta] / 2  # a couple at which v_3 > 0 for sure
    return {**known, gamma: sp.Integer(1), **values}


def _simple(
    sign: int, couple: sp.Symbol, half: tuple[object, ...], more: Point | None = None
) -> tuple[Point, ...]:
    """Small constants and couples, at s = 0 and s = 1; `more` goes to every point."""
    rows = ((2, 1, 1, 1, 1, 0, 1, 2), (2, 1, 1, 1, 2, 1, 2, 1), (1, 1, 1, 1, 1, 0, 2, 1),
            (2, 1, 1, 1, 1, 0, 2, sp.Rational(3, 2)))  # fmt: skip
    return tuple(
        dict(zip(CONSTANTS, map(sp.sympify, row[:7]), strict=True))
        | {couple: sign * sp.sympify(row[7]), c: sp.sympify(row[7]), t: sp.sympify(h),
           psi_0: sp.Integer(0), s: sp.sympify(place)} | dict(more or {})
        for place in (0, 1) for h in half for row in rows
    )  # fmt: skip


def _simple_shape(sign: int) -> tuple[Point, ...]:
    """One small helix, at s = 0."""
    return (
        {M1: sp.Integer(sign), c: sp.Integer(1), t: sp.Rational(1, 2), s: sp.Integer(0),
         omega: sp.Integer(2), stretch: sp.Integer(1)},
    )  # fmt: skip


def small_circles() -> tuple[Point, ...]:
    """Small constants and couples of one sign."""
    return _simple(1, M1, (1,))


@dataclass(frozen=True, eq=False)
class Branch:
    """One sign of the couple on one domain, with the configuration that is to be an equilibrium."""

    meaning: Meaning
    configuration: Configuration

    def built(self, seed: int, ctx: Any, changed: Values | None = None) -> tuple[Values, float]:
        """The measured values, and the distance from equilibrium."""
        return measured(self.configuration, self.meaning.sample(seed), ctx, changed or {})


def _replaced(exprs: Any, *maps: Mapping[sp.Expr, sp.Expr]) -> tuple[sp.Expr, ...]:
    found = tuple(sp.sympify(e) for e in exprs)
    for table in maps:
        found = tuple(e.xreplace(dict(table)) for e in found)
    return found


@cache
def _measure(branch: Branch, seed: int) -> tuple[Values, float]:
    return branch.built(seed, context(DIGITS + 15))


def _branch(meaning: Meaning, configuration: Configuration) -> Branch:
    found = Branch(meaning, configuration)

    def numbers(point: Point, ctx: Any) -> Values:
        seed = next(k for k in range(ROUTE_POINTS) if meaning.sample(k) == point)
        return _measure(found, seed)[0]

    routed = replace(meaning, route=numbers, route_name=ROUTE_NAME)
    return Branch(routed, configuration)


ROUTE_NAME = "strains, loads and balance of r(s) and the directors, differentiated numerically"


@cache
def twisted(sign: int, upright: bool, turned: bool = False) -> Branch:
    """M_1 = 0, M_3 = sign c: theta > 0 with phi = 0, or theta = 0 with any phi(s).

    turned: theta > 0 with any constant phi.
    """
    state = theory.twisted()
    couple = {M3: sign * c}
    angle = UPRIGHT if upright else HALF_ANGLE
    strains = _replaced(state.strains, couple)
    turn = phi if upright or turned else sp.Integer(0)
    spin = _replaced([state.angles()[2]], couple)[0] - (phi if upright else 0)
    at = {phi: turn, psi: spin}
    components: dict[sp.Expr, sp.Expr] = {
        **dict(zip(STRAINS, strains, strict=True)), M1: sp.Integer(0), M2: sp.Integer(0),
        M3: sign * c, **angle,
    }  # fmt: skip
    for base, director in zip((d1, d2, d3), euler.directors(), strict=True):
        components |= of_vector(base, _replaced(director, at, angle))
    tangent = _replaced(theory.tangent(state), {v3: strains[5]}, at, angle)
    components |= of_vector(r_s, tangent)
    for k, e in enumerate(euler.directors()[2], 1):
        rate = _replaced([sp.diff(e.xreplace(at), s)], angle)[0]
        components[sp.Symbol(f"d3_s{k}", real=True)] = rate
    assert Field().is_zero(sum(e**2 for e in tangent) - strains[5] ** 2)
    components[length] = sp.Abs(strains[5])
    swing = s**2 + s / 3 if upright else turn
    configuration = Configuration(
        (swing, angle[theta], spin.xreplace({phi: swing})), tuple(s * e for e in tangent)
    )
    meaning = Meaning(
        name=f"twisted states, M_3 {'>' if sign > 0 else '<'} 0, theta {'=' if upright else '>'} 0",
        free=(*CONSTANTS, c, t, s, psi_0, phi), sample=sample,
        simple=lambda: _simple(sign, M3, (1, sp.Rational(1, 2)), {phi: sp.Integer(0)}),
        components=components,
        functions={Prime: prime}, positive=(chiral_gap,), edges=({c: sp.Integer(0)},),
    )  # fmt: skip
    return _branch(meaning, configuration)


@cache
def helical(sign: int, circle: bool = False) -> Branch:
    """M_1 = sign c and M_3 from the balance, 0 < theta <= pi/2 (or theta = pi/2)."""
    state = theory.helix()
    angle = RIGHT_ANGLE if circle else HALF_ANGLE
    couple = {M1: sign * c}
    strains = list(_replaced(state.strains, couple, angle))
    turn, spin = _replaced(state.rates, couple, angle)
    angles = {phi: turn * s, psi: spin * s + psi_0}
    vector = _replaced(theory.in_fixed_basis(state.couple), couple, angle, angles)
    components: dict[sp.Expr, sp.Expr] = {
        **dict(zip((M1, M2, M3), _replaced(state.couple, couple, angle), strict=True)),
        **dict(zip(STRAINS, _replaced(strains, angles), strict=True)),
        phi_s: turn, psi_s: spin, **angles, **angle,
        **of_vector(r_s, _replaced(theory.tangent(state), {v3: strains[5]}, angle, angles)),
        **of_vector(m_g, vector),
    }  # fmt: skip
    line = _replaced(theory.center_line(), {v3: strains[5], phi_s: turn}, angle)
    cosine, sine = angle[sp.cos(theta)], angle[sp.sin(theta)]
    bend, axial = (compliance_at_rest()[k, k] for k in (0, 2))
    meaning = Meaning(
        name=f"{'circles' if circle else 'helices'}, M_1 {'>' if sign > 0 else '<'} 0",
        free=(*CONSTANTS, c, t, s, psi_0), sample=sample,
        simple=lambda: _simple(sign, M1, (1, sp.Rational(1, 2))), components=components,
        functions={Prime: prime},
        positive=(chiral_gap, bend + axial * (cosine / sine) ** 2),
    )  # fmt: skip
    return _branch(meaning, Configuration((angles[phi], angle[theta], angles[psi]), line))


@cache
def shaped(sign: int, circle: bool = False) -> Meaning:
    """The centre line of a helix with |phi'| = omega and v_3 = stretch > 0; M_1 = sign c."""
    angle = RIGHT_ANGLE if circle else HALF_ANGLE
    turn = theory.helix().rates[0].xreplace({M1: sign * c}).xreplace(dict(angle))
    facts = helical(sign, circle).meaning.positive
    rate = Field(facts).sign(turn) * omega  # the sign of phi', from the law
    table = {phi_s: rate, v3: stretch}
    found = theory.shape()
    rise = theory.tangent(theory.helix())[2] * 2 * sp.pi / omega  # r_3 over one turn
    names = dict(zip((curvature, torsion, radius, pitch),
                     (found.curvature, found.torsion, found.radius, rise),
                     strict=True))  # fmt: skip
    components: dict[sp.Expr, sp.Expr] = {
        M1: sign * c, M3: theory.axial_couple().xreplace({M1: sign * c}).xreplace(dict(angle)),
        **{k: e.xreplace(dict(angle)).xreplace(table) for k, e in names.items()},
        **table, **angle,
        **of_vector(r_s, _replaced(theory.tangent(theory.helix()), table, angle, {phi: rate * s})),
    }  # fmt: skip
    branch = helical(sign, circle)

    def numbers(point: Point, ctx: Any) -> Values:
        values = dict(branch.meaning.route(point, ctx))  # type: ignore[misc]
        line, _ = branch.configuration.functions(point, ctx, {})
        values |= measured_shape(line, number(ctx, point[s]),
                                 values[phi_s], ctx)  # fmt: skip
        return values | {stretch: values[v3]}

    return Meaning(
        name=f"centre lines of helices, M_1 {'>' if sign > 0 else '<'} 0",
        free=(c, t, s, omega, stretch), sample=sample, functions={Prime: prime},
        simple=lambda: _simple_shape(sign), components=components,
        positive=() if circle else (1 - t**2,),
        route=numbers, route_name=f"{ROUTE_NAME}; r''' and points half a turn and a turn apart",
    )  # fmt: skip


# -- checks -------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class OfState:
    """A statement about a family of equilibria, on each of its branches.

    Second route: a formula for an angle, a director or the centre line is put in place of the
    derived one, and the configuration must still be an equilibrium that carries the same couple.
    """

    branches: tuple[Branch, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        return on_all([Identity(b.meaning) for b in self.branches], printed, explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        ctx = context(DIGITS + 15)
        worst, points = 0.0, 0
        for branch in self.branches:
            found = Identity(branch.meaning).confirm(printed)
            assert found is not None
            worst, points = max(worst, found.residual), points + found.points
            for seed in range(ROUTE_POINTS):
                worst = max(worst, self.rebuilt(branch, seed, printed, ctx))
        return Confirmation(worst, points, DIGITS, ROUTE_NAME)

    @staticmethod
    def rebuilt(branch: Branch, seed: int, printed: sp.Basic, ctx: Any) -> float:
        """The distance from equilibrium, and from the same couple, of the stated configuration."""
        inputs = {phi, psi, *(x for base in (d1, d2, d3, r) for x in of_vector(base, (0, 0, 0)))}
        changed = {
            claim.sides[0]: branch.meaning.interpret(claim.sides[1])
            for claim in claims(printed)
            if isinstance(claim, Chain) and claim.sides[0] in inputs
        }
        values, residual = _measure(branch, seed)
        if changed:
            again, residual = branch.built(seed, ctx, changed)
            moved = [abs(again[x] - values[x]) for x in (*of_vector(m_g, (0, 0, 0)), M3)]
            residual = max(residual, float(max(moved)))
        return residual


def on_all(parts: list[Any], printed: sp.Basic, explain: bool) -> Decision:
    """What holds on every one of several domains."""
    methods: list[str] = []
    exact = True
    for part in parts:
        found = part.decide(printed, explain=explain)
        if not found.holds:
            return Decision(found.holds, found.exact, found.method, found.counterexample)
        exact = exact and found.exact
        methods += [found.method] if found.method not in methods else []
    return Decision(True, exact, "; ".join(methods))
