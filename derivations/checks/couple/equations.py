"""The particular checks of Section 4.3: equations, zeros, consequences, ranges, center lines."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from rodproof.derivations.checks.couple import domains
from rodproof.derivations.checks.couple.domains import Branch, OfState, on_all
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import (
    Chain,
    Every,
    Iff,
    Implies,
    Prime,
    equal,
    instances,
)
from rodproof.derivations.proof.meaning import IllTyped, Meaning
from rodproof.derivations.proof.prover import Identity, claims
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.theory import couple as theory
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.frames import phi, theta

_REJECTED = Decision(False, False, "rejected")
HELICES = (domains.helical(1), domains.helical(-1))
CIRCLES = (domains.helical(1, True), domains.helical(-1, True))
TILTED = (domains.twisted(1, False), domains.twisted(-1, False))
#: The same before the basis is turned so that phi(0) = 0.
TURNED = (domains.twisted(1, False, True), domains.twisted(-1, False, True))
TWISTED = (*TILTED, domains.twisted(1, True), domains.twisted(-1, True))

#: Unknowns and rates as they stand in the reduced equations, nothing solved for.
JETS = Meaning(
    name="states under couples alone",
    free=(),
    sample=domains.sample,
    simple=lambda: (),
    functions={Prime: domains.prime},
)


def _jets(claim: sp.Basic) -> sp.Expr:
    """left - right of an equation, in unknowns and rates."""
    if not isinstance(claim, Chain) or claim.relations != ("=",):
        raise IllTyped("not an equation")
    left, right = (JETS.interpret(side) for side in claim.sides)
    return left - right


def _measured(printed: sp.Basic, branches: tuple[Branch, ...]) -> Confirmation | None:
    """Both sides of every equation on measured configurations."""
    return OfState(branches).confirm(printed)


@dataclass(frozen=True, eq=False)
class SameEquation:
    """The printed equation has the same solutions as the derived one, `derived = 0`.

    Their ratio is a factor without zeros, by its sign.
    """

    derived: sp.Expr
    branches: tuple[Branch, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        try:
            same = Field().sign(_jets(claim) / self.derived) in (1, -1)
        except (IllTyped, OutOfReach, KeyError):
            return _REJECTED
        method = "the derived equation up to a nonzero factor"
        return Decision(True, True, method) if same else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return _measured(printed, self.branches)


@dataclass(frozen=True, eq=False)
class SameZeros:
    """`a = 0` iff `b = 0`: by a derived equation a is b times a factor of known sign.

    solved: (unknown, its value by the derived equations).
    """

    solved: tuple[tuple[sp.Symbol, sp.Expr], ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Iff) or len(claim.args) != 2:
            return _REJECTED
        try:
            first, second = (_jets(side).xreplace(dict(self.solved)) for side in claim.args)
            if first == 0 or second == 0:
                return _REJECTED
            sign = Field().sign(first / second)
        except (IllTyped, OutOfReach, KeyError):
            return _REJECTED
        method = "ratio of known sign, so the zeros agree"
        return Decision(True, True, method) if sign else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


_EQUATIONS = theory.steady_equations()
_ALL = tuple(e.xreplace({euler.N: sp.Integer(0)}) for e in euler.reduced_system())
#: The last balance of couples, m_3' = 0 in disguise: the law removes what bends and turns.
_LAST = sp.expand(_ALL[5] - euler.M2 * _ALL[0] + euler.M1 * _ALL[1])
_FULL = (*_ALL[:5], _LAST)
TURN = (euler.phi_s, sp.solve(_EQUATIONS[0], euler.phi_s)[0])
PHI_EQUATION = SameEquation(_EQUATIONS[0], HELICES)
PSI_EQUATION = SameEquation(_EQUATIONS[2], HELICES)
THIRD_EQUATION = SameEquation(_EQUATIONS[4], HELICES)
BENDING_ZERO = SameZeros(((euler.theta_s, sp.solve(_FULL[1], euler.theta_s)[0]),))
TURNING_ZERO = SameZeros((TURN,))


@dataclass(frozen=True, eq=False)
class Consequence:
    """The cited equations are derived ones, and with theta' = M_2 = 0 they imply the conclusions.

    Exact: each of so many different conclusions is a cited equation under these hypotheses.
    """

    conclusions: int

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = instances(printed)
        if not isinstance(claim, Implies):
            return _REJECTED
        cited, conclusions = (p.args if isinstance(p, Every) else (p,) for p in claim.args)
        if len(set(conclusions)) != self.conclusions:
            return _REJECTED
        try:
            hypotheses = [_jets(h) for h in cited]
            if not all(any(_proportional(h, e) for e in _FULL) for h in hypotheses):
                return _REJECTED
            known = [h.xreplace(dict(theory.STEADY)) for h in hypotheses]
            missing = [e for e in conclusions if not any(_proportional(_jets(e), k) for k in known)]
        except (IllTyped, KeyError):
            return _REJECTED
        if missing:
            found = Counterexample(
                (("M_1", "1"), ("M_3", "0"), ("theta", "pi/3"), ("varphi'", "1"), ("M_1'", "0"),
                 ("M_3'", "0")),
                "the cited equations hold", f"these do not follow: {len(missing)} equations",
            )  # fmt: skip
            return Decision(False, True, "not a consequence of what is cited", found)
        return Decision(True, True, "each conclusion is a cited equation at theta' = M_2 = N = 0")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        (claim,) = instances(printed)
        return _measured(Every(*claim.args[1].args[:3]), HELICES)


def _proportional(a: sp.Expr, b: sp.Expr) -> bool:
    """a = q b with a rational number q != 0."""
    if a == 0 or b == 0:
        return False
    atoms = sorted((a.free_symbols | b.free_symbols) - {theta}, key=str)
    point: dict[sp.Expr, sp.Expr] = {x: sp.Integer(sp.prime(k + 2)) for k, x in enumerate(atoms)}
    point |= {sp.sin(theta): sp.Rational(3, 5), sp.cos(theta): sp.Rational(4, 5)}
    first, second = a.xreplace(point), b.xreplace(point)
    if not (first.is_Rational and second.is_Rational and first * second != 0):
        return False
    return bool(sp.expand(a - first / second * b) == 0)


@dataclass(frozen=True, eq=False)
class NoBending:
    """M_1 = M_2 = 0 implies m_1 = m_2 = 0, and sin(theta) phi' = 0: theta = 0 or phi' = 0.

    printed: Implies(Every(M_1 = 0, M_2 = 0), Every(m_1 = 0, m_2 = 0, a b = 0)), where the factors
    a and b must be sin(theta) and phi'; sin has the one zero 0 on [0, pi/2].
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = instances(printed)
        if not isinstance(claim, Implies) or not all(isinstance(q, Every) for q in claim.args):
            return _REJECTED
        hypothesis, conclusion = claim.args
        zero = {_jets(h) for h in hypothesis.args}
        if zero != {euler.M1, euler.M2}:
            return _REJECTED
        *bending, last = (_jets(e) for e in conclusion.args)
        m1, m2 = euler.couple()[:2]
        nothing = dict.fromkeys((euler.M1, euler.M2), sp.Integer(0))
        vanish = [e.xreplace(nothing) == 0 for e in (m1, m2)]
        named = set(bending) == set(sp.symbols("m1 m2", real=True))
        law = _EQUATIONS[0].xreplace(nothing)
        zeros = sp.solveset(sp.sin(theta), theta, sp.Interval(0, sp.pi / 2))
        if all(vanish) and named and _proportional(last, law) and zeros == sp.FiniteSet(0):
            return Decision(True, True, "an invertible turn of (M_1, M_2); zero of a product")
        return _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return _measured(Every(equal(euler.M1, 0), equal(Prime(phi) * sp.sin(theta), 0)), TILTED)


def interval(claim: sp.Basic) -> sp.Set:
    """The set of theta that a chain `a < theta <= b` describes."""
    if not isinstance(claim, Chain) or len(claim.sides) != 3 or claim.sides[1] != theta:
        raise IllTyped("not a range of theta")
    (low, _, high), (first, second) = claim.sides, claim.relations
    if not {first, second} <= {"<", "<="}:
        raise IllTyped("not a range of theta")
    return sp.Interval(low, high, first == "<", second == "<")


@dataclass(frozen=True, eq=False)
class HalfOfAllAngles:
    """A range of theta that, with its mirror image pi - theta, covers [0, pi] once.

    Turning a state about g_1 by pi turns theta into pi - theta and leaves n = 0 as it is, so the
    other half is the same states seen upside down.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        try:
            half = interval(printed)
        except IllTyped:
            return _REJECTED
        mirror = sp.Interval(sp.pi - half.end, sp.pi - half.start, half.right_open, half.left_open)
        d3 = euler.directors()[2]
        turned = sp.diag(1, -1, -1) * d3
        image = d3.xreplace({theta: sp.pi - theta, phi: -phi})
        covers = half.union(mirror) == sp.Interval(0, sp.pi)
        once = half.intersect(mirror).measure == 0
        if covers and once and sp.expand(turned - image) == sp.zeros(3, 1):
            return Decision(True, True, "a half turn about g_1 maps it onto the rest of [0, pi]")
        return _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class HelixCouple:
    """M_3 from the balance, on exactly the range of theta that M_1 != 0 leaves."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        first, second = printed.args
        found = on_all([Identity(b.meaning) for b in HELICES], first, explain)
        if not found.holds:
            return found
        try:
            stated = interval(second)
        except IllTyped:
            return _REJECTED
        everything = sp.Interval(0, sp.pi / 2)
        straight = sp.solveset(sp.sin(theta), theta, everything)  # there u M_1 = 0
        same = stated == everything - straight
        method = f"{found.method}; sin(theta) phi' = -u M_1 != 0 excludes theta = 0 only"
        return Decision(True, True, method) if same else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return OfState(HELICES).confirm(printed.args[0])
