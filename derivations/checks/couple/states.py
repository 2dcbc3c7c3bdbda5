"""The checks of Section 4.3 on states: center lines, shapes, signs, limits in the couple."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import sympy as sp

from rodproof.derivations.checks.couple import domains
from rodproof.derivations.checks.couple.domains import Branch, OfState, on_all
from rodproof.derivations.checks.couple.equations import TWISTED
from rodproof.derivations.checks.couple.route import c, length, r_s
from rodproof.derivations.checks.thrust.numeric import strains_at
from rodproof.derivations.exact.evaluate import context, number
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.notation import (
    Chain,
    Every,
    Iff,
    Implies,
    LimitOf,
    equal,
    instances,
)
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.proof.prover import DIGITS, ROUTE_POINTS, Identity, claims
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import STRAINS, chiral_gap, iota
from rodproof.derivations.theory import couple as theory
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.couple import psi_0, s
from rodproof.derivations.theory.frames import psi

_REJECTED = Decision(False, False, "rejected")


@dataclass(frozen=True, eq=False)
class CenterLine:
    """A stated r(s): its derivative must be the derived r' (a shift is free)."""

    branches: tuple[Branch, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        slopes = []
        for k, claim in enumerate(claims(printed), 1):
            if not isinstance(claim, Chain) or claim.sides[0] != sp.Symbol(f"r{k}", real=True):
                return _REJECTED
            slopes.append(equal(r_s[k], sp.diff(claim.sides[1], s)))
        return on_all([Identity(b.meaning) for b in self.branches], Every(*slopes), explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        worst = [
            OfState.rebuilt(b, seed, printed, context(DIGITS + 15))
            for b in self.branches for seed in range(ROUTE_POINTS)
        ]  # fmt: skip
        return Confirmation(max(worst), len(worst), DIGITS, domains.ROUTE_NAME)


@dataclass(frozen=True, eq=False)
class OnShapes:
    """Shape of the center line, for both signs of M_1; equivalences of signs included."""

    circle: bool = False

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        meanings = [domains.shaped(sign, self.circle) for sign in (1, -1)]
        if isinstance(printed, Iff):
            return self._equivalent(printed, meanings)
        return on_all([Identity(m) for m in meanings], printed, explain)

    @staticmethod
    def _equivalent(printed: Iff, meanings: list[Meaning]) -> Decision:
        for meaning in meanings:
            try:
                signs = {_sign(side, meaning) for side in instances(printed)[0].args}
            except (IllTyped, OutOfReach):
                return _REJECTED
            if len(signs) != 1 or signs & {None, 0}:
                return _REJECTED
        return Decision(True, True, "both sides have the same sign, for either sign of M_1")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        if isinstance(printed, Iff):
            return self._signs_agree(printed)
        found = [Identity(domains.shaped(sign, self.circle)).confirm(printed) for sign in (1, -1)]
        worst = max(f.residual for f in found if f)
        return Confirmation(worst, 2 * len(found), DIGITS, domains.shaped(1).route_name)

    def _signs_agree(self, printed: Iff) -> Confirmation:
        """Both sides of the equivalence on the measured shape, for either sign of M_1."""
        ctx = context(DIGITS + 15)
        (claim,), agree = instances(printed), []
        for sign in (1, -1):
            meaning = domains.shaped(sign, self.circle)
            assert meaning.route is not None
            values = meaning.route(meaning.sample(0), ctx)
            evaluate = meaning.evaluator(ctx, meaning.sample(0), values)
            found = {evaluate(a) > evaluate(b) for a, b in (side.sides for side in claim.args)}
            agree.append(len(found) == 1)
        residual = 0.0 if all(agree) else float("inf")
        return Confirmation(residual, 2, DIGITS, domains.shaped(1).route_name)


def _sign(claim: sp.Basic, meaning: Meaning) -> int | None:
    """The sign of left - right, turned so that the claim says +1."""
    if not isinstance(claim, Chain) or claim.relations not in ((">",), ("<",)):
        raise IllTyped("not an inequality")
    left, right = (meaning.interpret(side) for side in claim.sides)
    sign = Field(meaning.positive).sign(left - right)
    return sign if sign is None or claim.relations == (">",) else -sign


@dataclass(frozen=True, eq=False)
class OnTwisted:
    """Equalities on twisted states with v_3 > 0; equivalences of signs on all of them."""

    stretched: bool = False

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        meanings = [b.meaning for b in TWISTED]
        if self.stretched:
            v3 = sp.Symbol("v3", real=True)
            meanings = [
                replace(m, components={**m.components, length: m.components[v3]}) for m in meanings
            ]  # |v_3| = v_3
        parts = list(printed.args) if isinstance(printed, Every) else [printed]
        found = [
            self._sign_claim(part, meanings) if isinstance(part, Iff)
            else self._vanishes_only_with(part, meanings) if isinstance(part, Implies)
            else on_all([Identity(m) for m in meanings], _integrated(part, meanings), explain)
            for part in parts
        ]  # fmt: skip
        bad = next((f for f in found if not f.holds), None)
        return bad or Decision(True, True, "; ".join(dict.fromkeys(f.method for f in found)))

    @staticmethod
    def _sign_claim(printed: Iff, meanings: list[Meaning]) -> Decision:
        """a > 0 iff b > 0, as a/b > 0 wherever c > 0; both vanish at c = 0."""
        for meaning in meanings:
            (claim,) = instances(printed)
            if not all(isinstance(p, Chain) and p.relations == (">",) for p in claim.args):
                return _REJECTED
            sides = [meaning.interpret(p.sides[0] - p.sides[1]) for p in claim.args]
            at_rest = [side.subs(c, 0) for side in sides]
            try:
                if Field(meaning.positive).sign(sides[0] / sides[1]) != 1 or any(at_rest):
                    return _REJECTED
            except OutOfReach:
                return _REJECTED
        return Decision(True, True, "ratio of the two sides positive; both zero without couple")

    @staticmethod
    def _vanishes_only_with(printed: Implies, meanings: list[Meaning]) -> Decision:
        """`q != 0 implies x != 0`: x/q has a sign, and q vanishes with iota and with M_3, as x."""
        (claim,) = instances(printed)
        if not all(isinstance(part, sp.Ne) and part.args[1] == 0 for part in claim.args):
            return _REJECTED
        given, changed = (part.args[0] for part in claim.args)
        for zero, other in ((euler.M3, iota), (iota, euler.M3)):
            if given.subs(zero, 0) != 0:
                where = ((str(zero), "0"), (str(other), "1"))
                found = Counterexample(where, f"{changed} = 0", f"{changed} != 0")
                return Decision(False, True, "counterexample", found)
        try:
            ratios = [m.interpret(changed) / m.interpret(given) for m in meanings]
            signs = [Field(m.positive).sign(r) for m, r in zip(meanings, ratios, strict=True)]
        except OutOfReach:
            return _REJECTED
        same = set(signs) in ({1}, {-1})
        return Decision(True, True, "a ratio of known sign") if same else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        meanings = [b.meaning for b in TWISTED]
        parts = list(printed.args) if isinstance(printed, Every) else [printed]
        parts = [_integrated(p, meanings) for p in parts]
        equations = [p for p in parts if isinstance(p, Chain) and p.relations[0] == "="]
        return OfState(TWISTED).confirm(Every(*equations)) if equations else None


def _integrated(printed: sp.Basic, meanings: list[Meaning]) -> sp.Basic:
    """Integrals along the rod of what is constant along it."""
    done = {}
    for integral in printed.atoms(sp.Integral):
        integrand, (_, low, high) = integral.args[0], integral.args[1].args
        if not any(m.interpret(integrand).has(s) for m in meanings):
            done[integral] = integrand * (high - low)
    return printed.xreplace(done)


def _route_far(couple: sp.Symbol) -> Callable[[Point, Any], Values]:
    """The strains under couples of 10^400 and -10^400, M_2 = 0 and psi = psi(0)."""

    def route(point: Point, ctx: Any) -> Values:
        turn = number(ctx, point[psi_0])
        found: dict[sp.Basic, Any] = {}
        for sign, target in ((1, sp.oo), (-1, -sp.oo)):
            size = sign * ctx.mpf(10) ** 400
            bent = [size * ctx.cos(turn), -size * ctx.sin(turn), 0]
            load = [0, 0, size] if couple == euler.M3 else bent
            u1, u2, u3, _, _, dilatation = strains_at(point, [*load, 0, 0, 0], ctx)
            far = dict(zip(STRAINS[:3], (u1, u2, u3), strict=True))
            far |= {STRAINS[5] - 1: dilatation, _FLEXURE: ctx.hypot(u1, u2)}
            found |= {LimitOf(strain, couple, target): value for strain, value in far.items()}
        return found

    return route


_FLEXURE = sp.sqrt(STRAINS[0] ** 2 + STRAINS[1] ** 2)


def _in_the_couple(
    state: theory.State, angle: Mapping[sp.Expr, sp.Expr], couple: sp.Symbol
) -> Identity:
    """Statements with a limit in the couple, which is then the variable itself."""
    strains = [e.xreplace(dict(angle)).xreplace({psi: psi_0}) for e in state.strains]
    return Identity(Meaning(
        name="couples of any size", free=(), sample=domains.sample, simple=domains.small_circles,
        components=dict(zip(STRAINS, strains, strict=True)),
        positive=(chiral_gap,), route=_route_far(couple),
        route_name="the law with K inverted numerically, at couples of 10^400 and -10^400",
    ))  # fmt: skip


TWIST_LIMITS = _in_the_couple(theory.twisted(), {}, euler.M3)
CIRCLE_LIMITS = _in_the_couple(theory.helix(), domains.RIGHT_ANGLE, euler.M1)


@dataclass(frozen=True, eq=False)
class LeastStretch:
    """The first side is the infimum of v_3 over all couples about d_3, and has the second's sign.

    v_3 runs monotonically between its limits at M_3 -> -oo and +oo, so the smaller one is its
    infimum. a - b > 0 iff a^2 - b^2 > 0 for positive a, b; here a = 1, b = |iota|/(eta sqrt D).
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Iff) or not all(
            isinstance(side, Chain) and side.relations == (">",) for side in printed.args
        ):
            return _REJECTED
        infimum, condition = (side.sides[0] - side.sides[1] for side in printed.args)
        v3 = theory.twisted().strains[5]
        field = Field((chiral_gap,))
        slope = sp.diff((v3 - 1) / -iota, euler.M3).subs(euler.M3, c)
        ends = [limit(v3 - 1, euler.M3, end, (chiral_gap,)) for end in (sp.oo, -sp.oo)]
        depth = -infimum + 1
        try:
            least = all(field.is_zero(depth**2 - end**2) for end in ends)
            least = least and field.sign(slope) == 1 and self._positive(depth)
            ratio = field.sign((1 - depth**2) / condition)
        except OutOfReach:
            return _REJECTED
        method = "monotone in M_3 between exact limits; positive ratio of the conditions"
        return Decision(True, True, method) if least and ratio == 1 else _REJECTED

    @staticmethod
    def _positive(depth: sp.Expr) -> bool:
        """depth^2 is known, so the sign for one iota of either sign decides all."""
        return all(depth.subs(domains.sample(seed)) > 0 for seed in (0, 1))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


LEAST_STRETCH = LeastStretch()
