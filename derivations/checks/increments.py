"""Any two states of the rod: the work of the increments of load on those of strain."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.monotonicity import stiffness_is_definite
from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.proof.prover import DIGITS, ROUTE_POINTS, claims
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import CONSTANTS, STRAINS, chiral_gap, gamma, p
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import monotonicity as theory

_REJECTED = Decision(False, False, "rejected")
LOADS_A = sp.symbols("mA1:4 nA1:4", real=True)
LOADS_B = sp.symbols("mB1:4 nB1:4", real=True)
xA, xB, yA, yB = sp.symbols("x_A x_B y_A y_B", positive=True)
_STATES = ((theory.STATE_A, LOADS_A, xA, yA), (theory.STATE_B, LOADS_B, xB, yB))


def _components() -> dict[sp.Symbol, sp.Expr]:
    found: dict[sp.Symbol, sp.Expr] = {}
    for state, loads, x, y in _STATES:
        at = dict(zip(STRAINS, state, strict=True))
        found |= {s: e.xreplace(at) for s, e in zip(loads, theory.unit_loads(), strict=True)}
        found |= {x: theory.strain_radius(state), y: theory.load_radius(state)}
    return found


def _sample(seed: int) -> Point:
    """Two strains inside the limit of the same rod, one of them turned and shorter."""
    point = sampling.with_strains(seed)
    strain = [point[s] for s in STRAINS[:5]] + [point[STRAINS[5]] - 1]
    turns = (sp.Rational(-1, 3), sp.Rational(2, 5), sp.Rational(1, 7), sp.Rational(-3, 7))
    other = [x * turns[(k + seed) % 4] for k, x in enumerate(strain)]
    states = {
        **dict(zip(theory.STATE_A, (*strain[:5], 1 + strain[5]), strict=True)),
        **dict(zip(theory.STATE_B, (*other[:5], 1 + other[5]), strict=True)),
    }
    return {**{c: point[c] for c in CONSTANTS}, gamma: sp.Integer(1), **states}


def _route(point: Point, ctx: Any) -> Values:
    law = NumericLaw(point, ctx)
    found: dict[sp.Basic, Any] = {}
    for state, names, x, y in _STATES:
        strain = [law.c[s] for s in state[:5]] + [law.c[state[5]] - 1]
        load = law.loads(strain)
        found |= dict(zip(names, load, strict=True))
        found |= {x: ctx.sqrt(law.form(strain)), y: ctx.sqrt(law.dual(load))}
    return found


TWO_STATES = Meaning(
    name="any two strains with Q < 1, gamma = 1",
    free=(*(c for c in CONSTANTS if c != gamma), *theory.STATE_A, *theory.STATE_B),
    sample=_sample,
    simple=lambda: (_sample(0),),
    components=_components(),
    positive=(
        chiral_gap,
        *(theory.strain_radius(s) ** 2 for s in (theory.STATE_A, theory.STATE_B)),
        *(1 - theory.strain_radius(s) ** p for s in (theory.STATE_A, theory.STATE_B)),
    ),
    route=_route,
    route_name="loads of both states by root search",
)


@cache
def _load_increases() -> bool:
    """dy/dx > 0 for 0 < x < 1."""
    x = constitutive.x
    slope = sp.diff(x * (1 - x**p) ** (-1 / p), x)
    return Field((1 - x**p,)).sign(slope) == 1


@dataclass(frozen=True, eq=False)
class Increments:
    """`work of the increments >= (x_B - x_A)(y_B - y_A) >= 0`, the second a product of like signs.

    The gap of the first is (y_A/x_A + y_B/x_B)(x_A x_B - eps_A . K eps_B), exactly; both
    inequalities are equalities only for equal strains. If A is rest, the limit of y_A/x_A is 1 and
    the work is x_B y_B: the first is an equality.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        claim, *others = claims(printed)
        if others or not isinstance(claim, Chain) or claim.relations != (">=", ">="):
            return _REJECTED
        work, product, zero = (TWO_STATES.interpret(side) for side in claim.sides)
        if zero != 0 or not self._looks_right(work, product):
            return _REJECTED
        facts = Field(TWO_STATES.positive)
        radii = [theory.strain_radius(s) for s in (theory.STATE_A, theory.STATE_B)]
        loads = [theory.load_radius(s) for s in (theory.STATE_A, theory.STATE_B)]
        try:
            exact = (
                facts.equal(work, theory.work_of_increments())
                and facts.equal(work - product, theory.increment_gap())
                and facts.equal(product, (radii[1] - radii[0]) * (loads[1] - loads[0]))
            )
        except OutOfReach:
            return _REJECTED
        if exact and _load_increases() and stiffness_is_definite():
            return Decision(True, True, "exact gap, Cauchy-Schwarz in K, and dy/dx > 0")
        return _REJECTED

    def _looks_right(self, work: sp.Expr, product: sp.Expr) -> bool:
        evaluate = TWO_STATES.evaluator(context(DIGITS), _sample(0))
        wanted = evaluate(theory.increment_gap())
        return bool(abs(evaluate(work - product) - wanted) < 1e-30)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The sides from loads found by root search, against the derived gap."""
        (claim,) = claims(printed)
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(ROUTE_POINTS):
            point = _sample(seed)
            evaluate = TWO_STATES.evaluator(ctx, point, _route(point, ctx))
            work, product = (evaluate(side) for side in claim.sides[:2])
            if not work > product > 0:
                return Confirmation(float("inf"), ROUTE_POINTS, DIGITS, TWO_STATES.route_name)
            gap = TWO_STATES.evaluator(ctx, point)(theory.increment_gap())
            worst = max(worst, float(abs((work - product) / gap - 1)))
        return Confirmation(worst, ROUTE_POINTS, DIGITS, TWO_STATES.route_name)
