"""The checks of Section 4.2 for the branch of sheared states, its threshold and its angle."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.thrust import domains, numeric, points
from rodproof.derivations.checks.thrust.moduli import (
    a,
    at_point,
    b,
    c,
    certified,
    is_positive,
    sides_of,
)
from rodproof.derivations.checks.thrust.states import REJECTED, InAllStates
from rodproof.derivations.exact.evaluate import context, number
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.notation import Chain, Implies, LimitOf, instances
from rodproof.derivations.proof.meaning import Meaning, Point
from rodproof.derivations.proof.prover import (
    DIGITS,
    POINTS,
    ROUTE_POINTS,
    Identity,
    at_generic_point,
    claims,
)
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import (
    iota,
    p,
    u3,
)  # fmt: skip
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import theta
from rodproof.derivations.theory.thrust import N, x

# -- the branch -------------------------------------------------------------------------------


@cache
def angle_is_function_of_thrust() -> bool:
    """For each N > N_thresh exactly one x in (0, 1) solves f_N(x) = 1/kappa; none for other N.

    N^{-p} = P(x) = (c x)^p - w^{p/2} increases with x, is 0 at the limiting cosine in (0, 1) and
    N_thresh^{-p} > 0 at 1: a bijection of (x_infinity, 1) and (N_thresh, oo), with a continuous
    inverse; below x_infinity P is negative, so that there is no N.
    """
    power = theory.inverse_thrust_power()
    facts = (*points.BRANCH_EXISTS, theory.weight())
    at_limit = theory.limiting_cosine()
    field = Field((*facts, theory.weight(at_limit)))
    return bool(
        certified(facts, sp.diff(power, x)) == 1
        and field.equal((c * at_limit) ** 2, theory.weight(at_limit))
        and field.sign(at_limit) == 1
        and field.equal((1 - at_limit**2) * (c**2 + c), (c - sp.sqrt(b)) * (c + sp.sqrt(b)))
        and field.sign((c - sp.sqrt(b)) * (c + sp.sqrt(b))) == 1
        and field.equal(theory.inverse_thrust_power(sp.Integer(1)), theory.threshold_power())
        and field.sign(theory.threshold_power()) == 1
    )


@dataclass(frozen=True, eq=False)
class OnTheBranch(InAllStates):
    """Identities on the branch, together with the proof that the branch is a graph over N."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        found = super().decide(printed, explain=explain)
        if not found.holds or not found.exact:
            return found
        if angle_is_function_of_thrust():
            how = "N^{-p} is explicit in the angle and strictly monotone, with exact end values"
            return Decision(True, True, f"{found.method}; {how}")
        return Decision(None, False, "monotonicity not proved")


@dataclass(frozen=True, eq=False)
class Determined(OnTheBranch):
    """The algebraic equation written out, so that N fixes theta up to finitely many values.

    sin theta = 0 or f_N(|cos theta|) = 1/kappa, which has one root at most; at N = 0 every theta
    solves the equation.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies):
            said = Counterexample((("N", "0"),), "theta = 0 solves 0 = 0", "so does theta = pi/6")
            return Decision(False, True, "counterexample", said)
        return super().decide(printed, explain=explain)


@cache
def taylor_of_thrust() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """N - N_thresh, dN/dtheta and half the second derivative, at theta = 0."""
    thrust, at_zero = domains.BRANCH.components[N], {points.angle: sp.Integer(0)}
    slopes = thrust, *(sp.diff(thrust, points.angle, k) / k for k in (1, 2))
    start, slope, second = (q.subs(at_zero) for q in slopes)
    return start - theory.threshold(), slope, second


@dataclass(frozen=True, eq=False)
class NearThreshold:
    """`lim_{theta -> 0} (N - N_thresh)/theta^2 = value`, by the first two derivatives at 0."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Chain) or printed.relations != ("=",):
            return REJECTED
        left, right = printed.sides
        if left != LimitOf((N - points.N_thresh) / theta**2, theta, sp.Integer(0)):
            return REJECTED
        value = domains.BRANCH.interpret(right)
        start, slope, wanted = taylor_of_thrust()
        for seed in range(POINTS):
            evaluate = at_generic_point(domains.BRANCH, seed)
            if not abs(evaluate(value) - evaluate(wanted)) < 1e-30:
                return Decision(False, False, "not the second derivative")
        field = Field(points.BRANCH_EXISTS)
        if field.is_zero(start) and field.is_zero(slope) and field.equal(value, wanted):
            return Decision(True, True, "Taylor's theorem with exact derivatives")
        return Decision(None, False, f"{DIGITS} digits")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The quotient at theta = 10^-20, where it is off by 10^-40."""
        ctx, worst = context(3 * DIGITS), 0.0
        for seed in range(ROUTE_POINTS):
            point = domains.BRANCH.sample(seed)
            tiny = ctx.mpf(10) ** -20
            near, at = (numeric.thrust_at(point, t, ctx) for t in (tiny, tiny**3))
            value = domains.BRANCH.evaluator(ctx, point)(printed.sides[1])
            worst = max(worst, float(abs((near - at) / tiny**2 / value - 1)))
        route = "N by a root search on the moment balance at theta = 1e-20"
        return Confirmation(worst, ROUTE_POINTS, DIGITS, route)


@dataclass(frozen=True, eq=False)
class SharpPowers:
    """A chain of `<` between positive quantities by comparing powers, with equality at an edge.

    greater^p/smaller^p - 1 has a sign certificate and vanishes at the edge of the domain, so that
    no sharper constant would do.
    """

    meaning: Meaning
    power: sp.Expr
    edge: tuple[tuple[sp.Symbol, sp.Expr], ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Chain) or set(printed.relations) - {"<", "="}:
            return REJECTED
        field, edge = Field(self.meaning.positive), dict(self.edge)
        for left, relation, right in printed.links():
            small, large = self.meaning.interpret(left), self.meaning.interpret(right)
            if relation == "=":
                found = Identity(self.meaning).decide(Chain(
                    sp.Tuple(left, right), sp.Tuple(sp.Symbol("="))), explain=explain)  # fmt: skip
                if not (found.holds and found.exact):
                    return found
                continue
            values = [at_generic_point(self.meaning, k) for k in range(POINTS)]
            if not all(is_positive(e(right) - e(left)) for e in values):
                return Decision(False, False, "fails at a generic point")
            if small == 0:
                if field.sign(large) != 1:
                    return REJECTED
                continue
            excess = (large / small) ** self.power - 1
            on_edge = [abs(e((large / small).subs(edge)) - 1) for e in values]
            if max(on_edge) > 1e-25 or not field.is_zero(excess.subs(edge)):
                return Decision(False, False, "not sharp")
            if field.sign(excess) != 1:
                return Decision(None, False, "not decided")
        return Decision(True, True, "powers compared by a sign certificate; equality on the edge")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(self.meaning).confirm(printed)


@dataclass(frozen=True, eq=False)
class SharpSign:
    """`expression > 0` on a domain, by a certificate; its infimum 0 is reached in a limit."""

    meaning: Meaning
    variable: sp.Symbol
    target: sp.Expr

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        pair = sides_of(claim)
        if pair is None:
            return REJECTED
        excess = self.meaning.interpret(pair[0] - pair[1])
        found = Identity(self.meaning).decide(printed, explain=explain)
        if not (found.holds and found.exact):
            return Decision(False, False, "fails at a generic point")
        try:
            infimum = limit(excess, self.variable, self.target, self.meaning.positive[:1])
        except OutOfReach:
            return REJECTED
        if infimum != 0:
            return Decision(False, False, "not sharp")
        return Decision(True, True, "sign certificate; the infimum is 0")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


# -- angles in closed form --------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class ClosedAngle:
    """`angle = arccos X` where X > 0 is the root below 1 of an equation.

    residual: X -> what must vanish. facts: what is positive; below_one: what
    (1 - X^2)(c^2 + c) is, with a sign certificate. thrust: the N at which the second route
    searches for the angle.
    """

    left: sp.Expr
    residual: Callable[[sp.Expr], sp.Expr]
    facts: tuple[sp.Expr, ...]
    below_one: sp.Expr
    sample: Callable[[int], Point]
    thrust: Callable[[Point, Any], Any]
    power: sp.Expr | None = None  # a value of p that the statement fixes
    symbols: tuple[tuple[sp.Symbol, sp.Expr], ...] = ()  # what other symbols on the right mean

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = instances(printed)
        if not isinstance(claim, Chain) or claim.sides[0] != self.left or claim.relations != ("=",):
            return REJECTED
        right = claim.sides[1].xreplace(dict(self.symbols))
        if not isinstance(right, sp.acos):
            return REJECTED
        cosine = right.args[0]
        for seed in range(POINTS):
            evaluate = at_point(tuple(self.sample(seed).items()))
            value = evaluate(cosine)
            if getattr(value, "imag", 0) or not 0 < value < 1:
                return Decision(False, False, "not a cosine")
            if abs(evaluate(self.residual(cosine))) > 1e-20:
                return Decision(False, False, "not the root")
        field = Field(self.facts)
        if not field.is_zero(self.residual(cosine)) or field.sign(cosine) != 1:
            return Decision(None, False, f"{DIGITS} digits")
        below = field.equal((1 - cosine**2) * (c**2 + c), self.below_one)
        if not below or field.sign(self.below_one) != 1 or not angle_is_function_of_thrust():
            return Decision(None, False, "not decided")
        return Decision(True, True, "the root in (0, 1) of the derived equation, exactly")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The angle at a thrust (10^60 for the limit) by a root search on the moment balance."""
        (claim,) = instances(printed)
        cosine = claim.sides[1].xreplace(dict(self.symbols)).args[0]
        ctx, worst = context(DIGITS + 15), 0.0
        for seed in range(ROUTE_POINTS):
            point = dict(self.sample(seed))
            if self.power is not None:
                point[p] = sp.sympify(self.power)
            wanted = numeric.cosine_at(point, self.thrust(point, ctx), ctx)
            found = domains.AT_INFINITY.evaluator(ctx, point)(cosine)
            worst = max(worst, float(abs(found - wanted)))
        route = "angle by a root search on the moment balance, K inverted numerically"
        return Confirmation(worst, ROUTE_POINTS, DIGITS, route)


def limiting_angle(left: sp.Expr) -> ClosedAngle:
    """arccos X with (c X)^2 = w(X) = a - c X^2: the limit N -> oo."""
    return ClosedAngle(
        left=left, residual=lambda X: (c * X) ** 2 - (a - c * X**2), facts=points.BRANCH_EXISTS,
        below_one=(c - sp.sqrt(b)) * (c + sp.sqrt(b)), sample=points.sheared_constants,
        thrust=lambda point, ctx: ctx.mpf(10) ** 60,
        symbols=((points.theta_hat_infinity, sp.acos(theory.limiting_cosine())),),
    )  # fmt: skip


def _above_threshold(seed: int) -> Point:
    """p = 2 and N = 1.5, 2 or 2.5 times the threshold, rounded to a rational number."""
    point = {**points.sheared_constants(seed), p: sp.Integer(2)}
    threshold = float(theory.threshold().subs(point))
    return {**point, N: sp.Rational(int(997 * threshold * (1.5 + 0.5 * seed)), 997)}


def angle_at_p2() -> ClosedAngle:
    """arccos X with (c X)^2 = N^{-2} + w(X), for p = 2 and N > N_thresh."""
    gap = c**2 - b - N**-2  # N_thresh^{-2} - N^{-2}
    return ClosedAngle(
        left=points.theta_hat, residual=lambda X: (c * X) ** 2 - N**-2 - (a - c * X**2),
        facts=(*points.BRANCH_EXISTS, N, gap), below_one=gap, sample=_above_threshold,
        power=sp.Integer(2), thrust=lambda point, ctx: number(ctx, point[N]),
    )  # fmt: skip


# -- chirality --------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class TwistedUnless:
    """`Implies(Ne(q, 0), Ne(u_3, 0))` for straight states: u_3/q must have a sign."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies) or printed.args[1] != sp.Ne(u3, 0):
            return REJECTED
        if not isinstance(printed.args[0], sp.Ne) or printed.args[0].args[1] != 0:
            return REJECTED
        given = printed.args[0].args[0]
        unloaded = {N: sp.Integer(0)}, {iota: sp.Integer(0)}
        for zero in unloaded:  # u_3 = 0 there, exactly
            if given.subs(zero) != 0:
                where = (*((str(k), str(q)) for k, q in zero.items()), (str(given), "1"))
                said = Counterexample(where, "u3 = 0", "u3 != 0")
                return Decision(False, True, "counterexample", said)
        for state in domains.STRAIGHT:
            if certified(state.positive, state.interpret(u3 / given)) not in (1, -1):
                return REJECTED
        return Decision(True, True, "u3 divided by it has a sign, and is defined")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


def of_both_chiralities(state: Meaning) -> tuple[Meaning, ...]:
    """A domain split by the sign of iota."""

    def part(sign: int) -> Meaning:
        def sample(seed: int) -> Point:
            point = dict(state.sample(seed))
            return {**point, iota: sign * abs(point[iota])}

        return Meaning(
            name=f"{state.name}, iota {'>' if sign > 0 else '<'} 0", free=state.free,
            components=state.components, functions=state.functions,
            positive=(*state.positive, sign * iota), sample=sample, simple=state.simple,
            route=state.route, route_name=state.route_name,
        )  # fmt: skip

    return part(1), part(-1)
