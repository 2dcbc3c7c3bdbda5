"""The checks of Section 4.2 for conditions on the moduli: equivalence, necessity, sharp signs."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.thrust import domains, points
from rodproof.derivations.checks.thrust.equations import Equation
from rodproof.derivations.checks.thrust.states import REJECTED, all_of
from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Iff, Implies
from rodproof.derivations.proof.meaning import Meaning, Point
from rodproof.derivations.proof.prover import POINTS
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import (
    alpha,
    beta,
    chiral_gap,
    eta,
    gamma,
    iota,
    p,
    v3,
    zeta,
)  # fmt: skip
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import theta
from rodproof.derivations.theory.thrust import N

a, b, c = theory.shear_compliance(), theory.axial_compliance(), theory.softness()
kappa = c / b  # (beta^2 eta^2 - iota^2)/(beta^2 zeta^2) - 1, derived as the ratio of compliances


def certified(facts: tuple[sp.Expr, ...], expr: sp.Expr) -> int | None:
    """The sign of an expression, or None where there is no certificate."""
    try:
        return Field(facts).sign(expr)
    except OutOfReach:
        return None


def sides_of(claim: sp.Basic) -> tuple[sp.Expr, sp.Expr] | None:
    """(greater, smaller) of a single strict inequality."""
    if not isinstance(claim, Chain) or claim.relations not in (("<",), (">",)):
        return None
    left, right = claim.sides
    return (left, right) if claim.relations == (">",) else (right, left)


@cache
def moduli() -> tuple[Point, ...]:
    """Constants on both sides of both conditions, near and far, chiral or not; small ones first."""
    half = sp.Rational(1, 2)
    grid = itertools.product((1, 2), (1, 2, 3), (half, 2), (0, 1, -half), (2, 1))
    keys = (beta, eta, zeta, iota, p)
    found = [{alpha: sp.Rational(7, 5), **dict(zip(keys, map(sp.sympify, row), strict=True))}
             for row in grid]  # fmt: skip
    for seed in range(6):
        point = points.sheared_constants(seed)
        soft = float(b.subs(point))
        for off in (-0.4, -0.06, -0.01, 0.01, 0.06, 0.4, 2):
            borders = soft * (1 + off), soft + math.sqrt(soft) * (1 + off)  # c = 0, c = b^{1/2}
            found += [{**point, zeta: sp.Rational(int(99991 / math.sqrt(k)), 99991)}
                      for k in borders]  # fmt: skip
    return tuple(q for q in found if chiral_gap.subs(q) > 0)


@cache
def moduli_with(facts: tuple[sp.Expr, ...]) -> tuple[Point, ...]:
    """Those at which the facts hold."""
    return tuple(q for q in moduli() if all(is_positive(_value(fact, q)) for fact in facts))


def _value(expr: sp.Expr, point: Point) -> Any:
    return at_point(tuple(point.items()))(expr)


@cache
def at_point(point: tuple[tuple[sp.Symbol, sp.Rational], ...]) -> Evaluator:
    """One evaluator a point: what the broken twins share is evaluated once."""
    return Evaluator(context(30), dict(point))


@dataclass(frozen=True, eq=False)
class SameSign:
    """Inequalities on the moduli that hold exactly where `needed` > 0 (so each iff the others).

    Two are equivalent if their differences have a positive ratio, or if greater/smaller of one
    is a positive power of greater/smaller of the other, all positive. given: facts of the
    context. hypothesis: the quantity whose positivity the claim may assume, `Implies(q > 0, ...)`.
    Disproof: constants at which one holds and another does not.
    """

    needed: tuple[sp.Expr, sp.Expr]  # (greater, smaller)
    given: tuple[sp.Expr, ...] = (chiral_gap,)
    hypothesis: sp.Expr | None = None

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        facts, claim = self.given, printed
        if isinstance(printed, Implies):
            assumed, claim = printed.args
            pair = sides_of(assumed)
            if pair is None or self.hypothesis is None:
                return REJECTED
            if certified(self.given, (pair[0] - pair[1]) / self.hypothesis) != 1:
                return REJECTED
            facts = (*facts, self.hypothesis)
        sides = [sides_of(q) for q in (claim.args if isinstance(claim, Iff) else (claim,))]
        if None in sides:
            return REJECTED
        pairs = [self.needed, *(pair for pair in sides if pair is not None)]
        found = self._disproof(pairs, facts, explain)
        if found is not None:
            return found
        if all(self._equivalent(self.needed, pair, facts) for pair in pairs[1:]):
            return Decision(True, True, "equivalent to the derived condition, exactly")
        return Decision(None, False, "not decided")

    def _disproof(
        self, pairs: list[tuple[sp.Expr, sp.Expr]], facts: tuple[sp.Expr, ...], explain: bool
    ) -> Decision | None:
        for point in moduli_with(facts):
            try:
                truths = [is_positive(_value(big - small, point)) for big, small in pairs]
            except ZeroDivisionError:
                continue
            except (TypeError, KeyError):  # the root of a negative number, or a foreign symbol
                return REJECTED
            if len(set(truths)) > 1:
                where = tuple((str(k), str(q)) for k, q in point.items() if k not in (gamma, alpha))
                told = (*pairs[1:], pairs[0]) if explain else ()
                said = [f"{big.subs(point)} > {small.subs(point)}" for big, small in told]
                found = Counterexample(where, said[0], said[1]) if said else None
                return Decision(False, True, "counterexample", found)
        return None

    def _equivalent(
        self, one: tuple[sp.Expr, sp.Expr], two: tuple[sp.Expr, sp.Expr], facts: tuple[sp.Expr, ...]
    ) -> bool:
        if certified(facts, (two[0] - two[1]) / (one[0] - one[1])) == 1:
            return True
        field = Field(facts)
        for power in (sp.Integer(1), sp.Integer(2), p, p / 2):
            try:
                if all(field.sign(q) == 1 for q in (*one, *two)) and field.equal(
                    two[0] / two[1], (one[0] / one[1]) ** power
                ):
                    return True
            except OutOfReach:
                return False
        return False

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


def is_positive(value: Any) -> bool:
    """A real number above rounding."""
    return not getattr(value, "imag", 0) and bool(value.real > 1e-25)


@dataclass(frozen=True, eq=False)
class SameSides:
    """Two inequalities that hold together on a domain: the product of their differences has a
    positive sign there, by a certificate."""

    meaning: Meaning

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        pairs = [sides_of(q) for q in printed.args]
        if len(pairs) != 2 or None in pairs:
            return REJECTED
        differences = [self.meaning.interpret(q[0] - q[1]) for q in pairs if q is not None]
        for seed in range(POINTS):
            evaluate = self.meaning.evaluator(context(30), self.meaning.sample(seed))
            try:
                together = is_positive(evaluate(sp.Mul(*differences)))
            except KeyError:
                return REJECTED  # a quantity that the claim is not about
            if not together:
                return Decision(False, False, "fails at a generic point")
        if certified(self.meaning.positive, sp.Mul(*differences)) == 1:
            return Decision(True, True, "the product of both is positive by a certificate")
        return Decision(None, False, "not decided")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class Necessary:
    """`Implies(equation, condition)`: the equation is the derived one, the condition the derived
    necessary one, and `proof` shows that the equation entails it."""

    equation: Equation
    condition: SameSign
    proof: Callable[[], bool]
    method: str

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies):
            return REJECTED
        found = all_of((self.equation,), printed.args[0], explain)
        if not found.holds:
            return found
        found = all_of((self.condition,), printed.args[1], explain)
        return Decision(True, True, self.method) if found.holds and self.proof() else found

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@cache
def condition_1_follows() -> bool:
    """In a sheared state with v_3 > 0 and F > 0: c > 0 (by F n_3 = 1/c and v_3 = a/c)."""
    facts = domains.SHEARED.positive[:3]
    return certified(facts, c) == 1


@cache
def condition_2_follows() -> bool:
    """(v_3 - 1)^2 < b for every N and theta, so that v_3 - 1 = 1/kappa needs 1/kappa < b^{1/2}.

    b - (v_3 - 1)^2 = b (1 - F^2 Q*) + b F^2 (Q* - b N^2 cos^2 theta), where Q* - b N^2 cos^2 theta
    = a N^2 sin^2 theta >= 0 and (F^2 Q*)^{p/2} = Q*^{p/2}/(1 + Q*^{p/2}) < 1.
    """
    for state in domains.PUSHED_OR_PULLED:
        thrust, field = state.components[N], Field(state.positive)
        Q, F = theory.dual_form(thrust), theory.law_factor(thrust)
        strain = state.components[v3] - 1
        rest = b * (1 - F**2 * Q) + F**2 * b * a * (thrust * sp.sin(theta)) ** 2
        power = Q ** (p / 2)
        if not (
            field.equal(b - strain**2, rest)
            and field.equal((F**2 * Q) ** (p / 2), power / (1 + power))
            and field.sign(1 - power / (1 + power)) == 1
        ):
            return False
    return True
