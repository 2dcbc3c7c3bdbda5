"""The checks of Section 4.2 for the reduced equations and their consequences."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks.equilibrium import (
    cross,
    dot,
    strains_of,
)  # fmt: skip
from rodproof.derivations.checks.thrust import domains, numeric, points
from rodproof.derivations.checks.thrust.states import REJECTED, worst_of
from rodproof.derivations.exact.evaluate import context, numbers
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Either, Every, Iff, Implies, Prime, instances
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point
from rodproof.derivations.proof.prover import (
    DIGITS,
    POINTS,
    ROUTE_POINTS,
    claims,
)
from rodproof.derivations.records import Check, Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import u3, v3
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.thrust import N

# -- one equation and its consequences --------------------------------------------------------


@dataclass(frozen=True, eq=False)
class LinkByLink:
    """A chain each of whose links has its own check (an identity first, then what balance says)."""

    checks: tuple[Check, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        parts = self._parts(printed)
        if parts is None:
            return REJECTED
        pairs = zip(self.checks, parts, strict=True)
        found = [check.decide(part, explain=explain) for check, part in pairs]
        failed = [f for f in found if not (f.holds and f.exact)]
        methods = "; then ".join(f.method for f in found)
        return failed[0] if failed else Decision(True, True, methods)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        parts = self._parts(printed)
        assert parts is not None
        found = [c.confirm(part) for c, part in zip(self.checks, parts, strict=True)]
        return worst_of([f for f in found if f is not None])

    def _parts(self, printed: sp.Basic) -> list[sp.Basic] | None:
        hypothesis, chain = printed.args if isinstance(printed, Implies) else (None, printed)
        if not isinstance(chain, Chain) or len(chain.relations) != len(self.checks):
            return None
        links = [Chain(sp.Tuple(a, b), sp.Tuple(sp.Symbol(r))) for a, r, b in chain.links()]
        # The hypothesis is for what follows from balance, never for the first identity.
        return links[:1] + [link if hypothesis is None else Implies(hypothesis, link)
                            for link in links[1:]]  # fmt: skip


def reduced(expr: sp.Expr) -> sp.Expr:
    """An equation of the reduced system at m = 0: M_k = M_k' = 0."""
    gone = dict.fromkeys((*euler.COUPLE, euler.M1_s, euler.M2_s, euler.M3_s), sp.Integer(0))
    return expr.xreplace(gone)


#: Rates in a transcription are the symbols of the reduced system; loads and strains stay symbols.
SYMBOLIC = Meaning(
    name="all angles, rates and strains", free=(),
    functions={Prime: lambda unknown: euler.RATES[unknown]},
    sample=lambda seed: {
        k: sp.Rational((7 + 5 * i + 11 * seed) % 29 + 2, 13 + 2 * seed)
        for i, k in enumerate((phi, theta, psi, *euler.RATES.values(), u3, v3, N,
                               points.scalar_v))
    },
    simple=lambda: (),
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Equation:
    """`left = right` says exactly `residual = 0`: the difference is a fixed multiple of it."""

    residual: sp.Expr
    meaning: Meaning = SYMBOLIC
    route: Callable[[Point, Any], Any] | None = None

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        parts = list(claims(printed))
        if len(parts) != 1 or not isinstance(parts[0], Chain) or parts[0].relations != ("=",):
            return REJECTED
        left, right = parts[0].sides
        try:
            difference = self.meaning.interpret(left - right)
            ratio = self.constant_ratio(difference)
        except (IllTyped, KeyError, TypeError, ZeroDivisionError):
            return REJECTED
        if ratio is None:
            return REJECTED
        if Field(self.meaning.positive).equal(difference, ratio * self.residual):
            return Decision(True, True, "the derived equation, exactly")
        return Decision(None, False, f"{DIGITS} digits")

    def constant_ratio(self, difference: sp.Expr) -> sp.Rational | None:
        """The small rational q with difference = q residual at generic points, if there is one."""
        quotients = []
        for seed in range(POINTS):
            evaluate = self.meaning.evaluator(context(30), self.meaning.sample(seed))
            quotients.append(evaluate(difference) / evaluate(self.residual))
        for q in (1, -1, 2, -2, sp.Rational(1, 2), sp.Rational(-1, 2)):
            if all(abs(x - float(q)) < 1e-25 for x in quotients):
                return sp.sympify(q)
        return None

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The difference of the sides against the residual in a frame turned numerically."""
        if self.route is None:
            return None
        (claim,) = claims(printed)
        left, right = claim.sides
        difference = self.meaning.interpret(left - right)
        ratio, ctx, worst = self.constant_ratio(difference), context(DIGITS + 15), 0.0
        for seed in range(ROUTE_POINTS):
            point = self.meaning.sample(seed)
            found = self.meaning.evaluator(ctx, point)(difference)
            worst = max(worst, float(abs(found - int(ratio or 0) * self.route(point, ctx))))
        how = "frames turned one rotation after the other, differentiated numerically"
        return Confirmation(worst, ROUTE_POINTS, DIGITS, how)


def _numeric(part: int) -> Callable[[Point, Any], Any]:
    """u . e_1, u . e_2, u . e_3 - u_3 (part 0, 1, 2) or (r' x N g_3) . e_2 (part 3), as numbers."""

    def route(point: Point, ctx: Any) -> Any:
        c = numbers(ctx, point)
        along = [(c[a], c[euler.RATES[a]]) for a in (phi, theta, psi)]

        def directors(at: Any) -> list[list[Any]]:
            return numeric.turned(ctx, *(start + rate * at for start, rate in along))

        def still(at: Any) -> list[Any]:
            return [ctx.mpf(0)] * 3

        frame_now = directors(ctx.mpf(0))
        basis = numeric.turned(ctx, c[phi], c[theta], ctx.mpf(0))
        if part < 3:
            u, _ = strains_of(still, directors, ctx.mpf(0), ctx)
            darboux = [ctx.fsum(u[k] * frame_now[k][i] for k in range(3)) for i in range(3)]
            return dot(darboux, basis[part], ctx) - (c[u3] if part == 2 else 0)
        force = [c[N] * d[2] for d in frame_now]
        v = [c[points.scalar_v] * force[0], c[points.scalar_v] * force[1], c[v3]]
        tangent = [ctx.fsum(v[k] * frame_now[k][i] for k in range(3)) for i in range(3)]
        return dot(cross(tangent, [0, 0, c[N]]), basis[1], ctx)

    return route


FLEXURE_1, FLEXURE_2, TWIST = (
    Equation(reduced(e), route=_numeric(k)) for k, e in enumerate(euler.law_in_frame())
)
COUPLE_BALANCE = Equation(reduced(euler.couple_balance()[1]), route=_numeric(3))


@dataclass(frozen=True, eq=False)
class Alternatives:
    """`equation iff one of two others`, under a hypothesis that makes the quotient nonzero.

    The product of the alternatives divides the residual; the quotient must not vanish.
    """

    equation: Equation

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        given, claim = printed.args if isinstance(printed, Implies) else (None, printed)
        if not isinstance(claim, Iff) or len(claim.args) != 2:
            return REJECTED
        whole, either = instances(claim)[0].args
        if not isinstance(either, Either) or not self.equation.decide(whole).holds:
            return REJECTED
        if any(alternative.relations != ("=",) for alternative in either.args):
            return REJECTED
        meaning = self.equation.meaning
        sides = [alternative.sides for alternative in either.args]
        product = sp.Mul(*(meaning.interpret(a - b) for a, b in sides))
        quotient = Equation(self.equation.residual, meaning)
        try:
            divides = quotient.constant_ratio(N * product) is not None
        except KeyError:
            divides = False  # a quantity that the equation is not about
        if not divides:
            return REJECTED
        if given == sp.Ne(N, 0):
            return Decision(True, True, "the equation factorises, exactly; N is not 0")
        point = (("N", "0"), ("theta", "pi/6"), ("v3", "1"))
        values = "sin(theta) = 1/2, v3 - v*N*cos(theta) = 1"
        return Decision(False, True, "counterexample", Counterexample(point, "0 = 0", values))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class Deduction:
    """`factor != 0 and factor * X = 0, so X = 0`, where factor * X = 0 is a derived equation."""

    equation: Equation

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies) or not isinstance(printed.args[0], Every):
            return REJECTED
        (nonzero, given), conclusion = printed.args[0].args, printed.args[1]
        if not isinstance(nonzero, sp.Ne) or not self.equation.decide(given).holds:
            return REJECTED
        factor, (left, right) = nonzero.args[0] - nonzero.args[1], conclusion.sides
        try:
            implied = self.equation.meaning.interpret(factor * (left - right))
        except KeyError:
            return REJECTED
        if self.equation.constant_ratio(implied) is None:
            return REJECTED
        known = Field(domains.BRANCH.positive).sign(domains.BRANCH.interpret(factor))
        if known in (1, -1):
            return Decision(True, True, "a factor that is not zero on the branch is cancelled")
        return REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class Vanish:
    """`vector = 0 iff components = 0`: both sides are regular linear systems in m_1, m_2, m_3."""

    meaning: Meaning
    unknown: tuple[sp.Symbol, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Iff) or len(printed.args) != 2:
            return REJECTED
        for side in printed.args:
            equations = []
            for claim in claims(side):
                if not isinstance(claim, Chain) or set(claim.relations) != {"="}:
                    return REJECTED
                for left, _, right in claim.links():
                    equations.append(self.meaning.interpret(left - right))
            system = sp.Matrix(equations)
            matrix = system.jacobian(self.unknown)
            rest = system.xreplace(dict.fromkeys(self.unknown, sp.Integer(0)))
            if len(equations) != len(self.unknown) or any(rest):
                return REJECTED
            if Field().sign(sp.expand(matrix.det(method="berkowitz"))) not in (1, -1):
                return REJECTED
        return Decision(True, True, "regular linear systems (determinants are nonzero numbers)")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None
