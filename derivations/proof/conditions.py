"""Conditions on the constants: sign equivalences, and what they ensure on all strains with Q < 1.

With D = beta^2 eta^2 - iota^2 = root^2 > 0 the conditions of the paper are rational in root once
iota is replaced by its two values +-(beta^2 eta^2 - root^2)^{1/2}; two conditions are equivalent
if the ratio of their two differences is positive for both.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from itertools import product

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, ForAll, Iff, Implies, Q, chain, instances, u, v
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.implications import difference
from rodproof.derivations.proof.meaning import IllTyped
from rodproof.derivations.proof.prover import DIGITS, POINTS
from rodproof.derivations.proof.rules import EllipsoidBound
from rodproof.derivations.proof.vectors import REJECTED
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import STRAINS, alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory import orientation
from rodproof.derivations.theory.constitutive import stiffness_at_rest
from rodproof.derivations.theory.orientation import Infimum, a, infimum

_root = sp.Symbol("root", positive=True)
_TIE = 1e-40
_ERRORS = (IllTyped, OutOfReach, ValueError, ZeroDivisionError)


def rooted(expr: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """The expression for both signs of iota, with D = root^2."""
    size = sp.sqrt(beta**2 * eta**2 - _root**2)
    return expr.xreplace({iota: size}), expr.xreplace({iota: -size})


def same_sign(first: sp.Expr, second: sp.Expr) -> bool:
    """A proof that both are positive, zero or negative together, for all constants."""
    try:
        pairs = zip(rooted(first), rooted(second), strict=True)
        return all(Field().sign(sp.together(x / y)) == 1 for x, y in pairs)
    except _ERRORS:
        return False


@cache
def trial_constants() -> tuple[dict[sp.Symbol, sp.Rational], ...]:
    """Constants with a rational root of D, on both sides of the conditions of Section 3.2."""
    R = sp.Rational
    shapes = [(1, R(5, 3), R(4, 3)), (1, 5, 4), (1, R(5, 2), R(3, 2)), (1, 2, 0), (1, R(1, 2), 0),
              (1, R(3, 2), 0), (2, R(5, 2), 3), (2, 1, R(6, 5)), (R(1, 2), 5, R(3, 2)),
              (3, R(5, 4), R(9, 4)), (1, R(13, 12), R(5, 12)), (1, R(5, 4), 0),
              (2, R(5, 3), 2), (1, R(3, 4), R(9, 20)), (R(1, 2), 3, 0),
              (3, R(1, 2), 0)]  # fmt: skip
    found: list[dict[sp.Symbol, sp.Rational]] = []
    for (b, e, i), sign, radius in product(shapes, (1, -1), (R(1, 10), R(2, 5), 1, 3)):
        size = (R(2), R(1), R(1, 2))[len(found) % 3]
        values = {alpha: size, beta: b, gamma: 1, zeta: 1, eta: e, iota: sign * i, p: 2, a: radius}
        found.append({s: sp.sympify(x) for s, x in values.items()})
    return tuple(found)


@cache
def _evaluators() -> tuple[Evaluator, ...]:
    return tuple(Evaluator(context(DIGITS), point) for point in trial_constants())


def disagreement(first: sp.Expr, second: sp.Expr) -> Counterexample | None:
    """Constants at which one is positive and the other is not (a tie up to rounding is neither)."""
    for point, evaluate in zip(trial_constants(), _evaluators(), strict=True):
        try:
            x, y = evaluate(first), evaluate(second)
        except (ZeroDivisionError, KeyError, TypeError):
            return Counterexample((), "a misprint", "no number")
        if getattr(x, "imag", 0) or getattr(y, "imag", 0) or (x > _TIE) != (y > _TIE):
            where = tuple((str(k), str(value)) for k, value in point.items())
            return Counterexample(where, str(first.subs(point)), str(second.subs(point)))
    return None


def _compared(first: sp.Expr, second: sp.Expr, method: str) -> Decision:
    found = disagreement(first, second)
    if found is not None:
        return Decision(False, True, "counterexample", found)
    if same_sign(first, second):
        return Decision(True, True, method)
    return Decision(None, False, "neither proved nor disproved")


def _one(tree: sp.Basic) -> sp.Basic:
    (claim,) = instances(tree)
    return claim


@dataclass(frozen=True, eq=False)
class SameCondition:
    """`Iff(A, B)` of two strict inequalities between constants, or one against a derived one."""

    derived: sp.Expr | None = None

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        try:
            if self.derived is None:
                if not isinstance(printed, Iff):
                    return REJECTED
                first, second = (difference(side, strict=True) for side in printed.args)
            else:
                first, second = difference(_one(printed), strict=True), self.derived
        except _ERRORS:
            return REJECTED
        return _compared(first, second, "ratio of the two sides positive, with D = root^2")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


def _affine(claim: sp.Basic) -> Infimum:
    """The infimum over Q < 1 of what the inequality says is positive.

    The norm of the flexure is the largest of its components over all directions, so where it
    is subtracted the least value is that with one of them, whatever the direction.
    """
    excess, norm = difference(claim), sp.sqrt(STRAINS[0] ** 2 + STRAINS[1] ** 2)
    if excess.has(norm) and Field().sign(sp.expand(excess).coeff(norm)) != -1:
        raise IllTyped("the norm does not lower what must be positive")
    return infimum(excess.xreplace({norm: orientation.flexure_in_direction()}))


def _margin(found: Infimum) -> sp.Expr:
    """center^2 - bound^2: the sign of center - bound, as center > 0 and bound >= 0."""
    if Field().sign(found.center) != 1:
        raise IllTyped("not positive at rest")
    return sp.cancel(found.center**2 - found.bound**2)


@dataclass(frozen=True, eq=False)
class Ensures:
    """`Implies(condition on the constants, claim on the strains)` for all strains with Q < 1.

    The claim is that an affine function is positive; it is so on the open ellipsoid exactly if
    its infimum is not negative. The condition must be that one (strict or not), not a stronger
    or a weaker one. An `Iff(ForAll(Q < 1, claim), condition)` must have it with equality.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        try:
            if isinstance(printed, Implies):
                condition, claim = (_one(part) for part in printed.args)
            elif isinstance(printed, Iff) and isinstance(printed.args[0], ForAll):
                domain, claim = printed.args[0].args
                condition, claim = _one(printed.args[1]), _one(claim)
                if domain != chain(Q(u, v), "<", 1):
                    return REJECTED
                if condition.relations[0] not in ("<=", ">="):
                    return Decision(False, False, "equality suffices")
            else:
                return REJECTED
            margin = _margin(_affine(claim))
            given = difference(condition)
        except _ERRORS:
            return REJECTED
        return _compared(given, margin, "infimum over Q < 1 (Cauchy-Schwarz), not attained")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The infimum along the solution of K eps = slope, solved numerically."""
        claim = _one(printed.args[1] if isinstance(printed, Implies) else printed.args[0].args[1])
        found, ctx, worst = _affine(claim), context(DIGITS + 15), 0.0
        norm = sp.sqrt(STRAINS[0] ** 2 + STRAINS[1] ** 2)
        affine = difference(claim).xreplace({norm: STRAINS[0]})
        slope = [sp.diff(affine, s) for s in STRAINS]
        for seed in range(POINTS):
            point = {**sampling.with_strains(seed), a: sp.Rational(5 + seed, 7)}
            evaluate = Evaluator(ctx, point)
            K = ctx.matrix([[evaluate(e) for e in row] for row in stiffness_at_rest().tolist()])
            k = ctx.matrix([evaluate(e) for e in slope])
            size = ctx.sqrt((k.T * ctx.lu_solve(K, k))[0])
            worst = max(worst, float(abs(size / evaluate(found.bound) - 1)))
        return Confirmation(worst, POINTS, DIGITS, "support function by a numerical linear solve")


def _sample_with_radius(seed: int) -> dict[sp.Symbol, sp.Rational]:
    return {**sampling.with_strains(seed), a: sp.Rational(5 + seed, 7)}


@dataclass(frozen=True, eq=False)
class OrientationChain:
    """condition => a |flexure| <= a/alpha < c < v_3 on all strains with Q < 1, each link sharp.

    First link: the supremum of a |flexure| (sum of squares). Second: the condition itself.
    Third: c is the infimum of v_3, which is not attained.
    """

    flexure: EllipsoidBound

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies):
            return REJECTED
        condition, whole = (_one(part) for part in printed.args)
        if not isinstance(whole, Chain) or len(whole.sides) != 4:
            return REJECTED
        size, bound, least, v3 = whole.sides
        first, second, third = whole.relations
        if first not in ("<", "<=") or (second, third) != ("<", "<"):
            return REJECTED
        try:
            given = difference(condition, strict=True)
            below = infimum(v3 - least)
            gaps = [Field().is_zero(e) for e in rooted(below.center**2 - below.bound**2)]
            positive = [Field().sign(e) == 1 for e in rooted(below.center)]
        except _ERRORS:
            return REJECTED
        if not (all(gaps) and all(positive) and below.bound != 0):
            return Decision(False, False, "the third link is not the infimum")
        supremum = self.flexure.decide(chain(size, "<", bound))
        if not (supremum.holds and supremum.exact):
            return Decision(False, False, "the first link is not the supremum")
        return _compared(given, least - bound, f"{supremum.method}; condition; infimum of v_3")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        size, bound = _one(printed.args[1]).sides[:2]
        return self.flexure.confirm(chain(size, "<", bound))
