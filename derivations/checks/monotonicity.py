"""The checks of Section 3.4: tangents, their value at rest, definiteness, monotonicity."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.tangents import (
    UNIT_STRAINS,
    WITH_ENERGY,
    numerical_tangent,
    simple_strains,
)
from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.notation import (
    Chain,
    HessianForm,
    Implies,
    Partial,
    PositiveDefinite,
    instances,
)
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning
from rodproof.derivations.proof.prover import DIGITS, ROUTE_POINTS, Identity, claims
from rodproof.derivations.proof.rules import semidefinite
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import LOADS, STRAINS, chiral_gap, gamma, iota, p
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import monotonicity as theory

_REJECTED = Decision(False, False, "rejected")

# -- tangents and their value at rest ----------------------------------------------------------


@dataclass(frozen=True, eq=False)
class TangentIdentity:
    """Equalities between tangents for every strain with Q < 1, rest included.

    Away from rest an exact identity. At rest a tangent is the limit of the ray quotient, and what
    is printed must tend to it along every ray; by Cauchy-Schwarz (`rest_is_uniform`) the limit
    does not depend on the way to rest.
    """

    meaning: Meaning
    _known: dict[sp.Basic, Decision] = field(default_factory=dict)

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        methods: list[str] = []
        for claim in claims(printed):
            found = self._known.get(claim)
            if found is None or (found.holds is False and explain):
                found = self._known[claim] = self._decide(claim, explain)
            if not found.holds:
                return found
            methods.append(found.method)
        return Decision(True, True, "; ".join(dict.fromkeys(methods)))

    def _decide(self, claim: sp.Basic, explain: bool) -> Decision:
        found = Identity(self.meaning).decide(claim, explain=explain)
        if not found.holds or not found.exact:
            return found
        if not isinstance(claim, Chain) or set(claim.relations) != {"="}:
            return _REJECTED
        try:
            values = [self._at_rest(side) for side in claim.sides]
        except OutOfReach as reason:
            return Decision(None, False, f"value at rest not decided: {reason}")
        if any(sp.expand(x - values[0]) != 0 for x in values) or not rest_is_uniform():
            return Decision(None, False, "differs at rest")
        return Decision(True, True, f"{found.method}, and the same limit at rest for every p > 0")

    def _at_rest(self, side: sp.Expr) -> sp.Expr:
        """The value at rest: tangents by their definition, the rest by the limit along a ray."""
        tangents = {node: _tangent_at_rest(node) for node in _outermost_tangents(side)}
        plain = self.meaning.interpret(side.xreplace(tangents))
        return limit(theory.along_ray(plain), theory.h, sp.Integer(0), self.meaning.positive)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(self.meaning).confirm(printed)


def _outermost_tangents(tree: sp.Basic) -> list[sp.Basic]:
    if isinstance(tree, Partial | HessianForm):
        return [tree]
    return [node for arg in tree.args for node in _outermost_tangents(arg)]


@cache
def _tangent_at_rest(node: sp.Basic) -> sp.Expr:
    if isinstance(node, HessianForm):
        return theory.rest_form()
    function, variable = node.args
    gradient = UNIT_STRAINS.interpret(function)
    quotient = theory.rest_quotient(gradient, STRAINS.index(variable))
    return limit(quotient, theory.h, sp.Integer(0), (chiral_gap,))


@cache
def rest_is_uniform() -> bool:
    """K_ii Q - (K eps)_i^2 >= 0 for every i: the second term of the tangent is O(Q^{p/2})."""
    K = constitutive.stiffness_at_rest()
    facts = Field((chiral_gap,))
    return all(semidefinite(sp.Matrix(K[i, i] * K - K[:, i] * K[i, :]), facts) for i in range(6))


@cache
def stiffness_is_definite() -> bool:
    """The leading minors of K are positive."""
    K = constitutive.stiffness_at_rest()
    facts = Field((chiral_gap,))
    return all(facts.sign(K[:k, :k].det(method="berkowitz")) == 1 for k in range(1, 7))


@cache
def _interpreted(meaning: Meaning, side: sp.Expr) -> sp.Expr:
    return meaning.interpret(side)


@cache
def _in_two_directions(meaning: Meaning) -> tuple[Evaluator, Evaluator]:
    first, other = meaning.sample(0), meaning.sample(1)
    second = {**first, **{d: other[d] for d in theory.DIRECTION}}
    return meaning.evaluator(context(DIGITS), first), meaning.evaluator(context(DIGITS), second)


# -- definiteness --------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class DefiniteTangent:
    """If Q(u, v) < 1, the form is positive definite in (a, b), rest included.

    The form must be a positive multiple of (1 - X) w.K w + (X/Q)(K eps . w)^2, X = Q^{p/2}: K has
    positive leading minors, 1 - X is positive, and the square is not negative. The hypothesis must
    be the whole domain: for Q >= 1 there is no law.
    """

    meaning: Meaning

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        claim, *others = instances(printed)
        if not isinstance(claim, Implies) or others:
            return _REJECTED
        hypothesis, conclusion = claim.args
        if not isinstance(conclusion, PositiveDefinite) or not self._whole_domain(hypothesis):
            return _REJECTED
        form = _interpreted(self.meaning, conclusion.args[0])
        facts = Field(self.meaning.positive)
        core = theory.form_of(theory.hessian_core())
        try:
            multiple = facts.sign(form / core) if self._proportional(form, core) else None
        except OutOfReach:
            return _REJECTED
        if multiple == 1 and stiffness_is_definite() and rest_is_uniform():
            return Decision(
                True, True, "K (leading minors positive) times 1 - X > 0, plus a square; K at rest"
            )
        failure = self._failure(form) if explain else None
        return _REJECTED if failure is None else Decision(False, True, "counterexample", failure)

    def _whole_domain(self, hypothesis: sp.Basic) -> bool:
        if not isinstance(hypothesis, Chain) or hypothesis.relations not in (("<",), (">",)):
            return False
        left, right = hypothesis.sides
        excess = left - right if hypothesis.relations == ("<",) else right - left
        difference = _interpreted(self.meaning, excess) - constitutive.quadratic_form() + 1
        return bool(sp.expand(difference) == 0)

    def _proportional(self, form: sp.Expr, core: sp.Expr) -> bool:
        """A quick look at two directions, before the exact certificate."""
        first, second = (e(form) / e(core) for e in _in_two_directions(self.meaning))
        return bool(abs(first - second) < abs(first) * 1e-35)

    def _failure(self, form: sp.Expr) -> Counterexample | None:
        """A strain and a direction, not zero, at which the form is zero or negative."""
        points = [*self.meaning.simple()[:6], self.meaning.sample(0)]
        for point in points:
            value = form.subs(point)
            if value.is_finite and sp.N(value, 30) <= 0:
                where = tuple((str(k), str(x)) for k, x in point.items())
                return Counterexample(where, f"form = {value}", "positive")
        return None

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """Eigenvalues of D^2 W against K: five are (1 - X)^{-1/p}, one is (1 - X)^{-1/p-1}."""
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(ROUTE_POINTS):
            point = self.meaning.sample(seed)
            K = constitutive.stiffness_at_rest().subs(point)
            root = ctx.cholesky(ctx.matrix([[_number(ctx, e) for e in row] for row in K.tolist()]))
            inverse = ctx.inverse(root)
            tangent = numerical_tangent(seed, ctx)
            found = ctx.eigsy(inverse * tangent * inverse.T, eigvals_only=True)
            x = ctx.sqrt(_number(ctx, constitutive.quadratic_form().subs(point)))
            power = _number(ctx, point[p])
            secant = (1 - x**power) ** (-1 / power)
            wanted = [secant] * 5 + [secant / (1 - x**power)]
            worst = max(
                worst, *(float(abs(e / w - 1)) for e, w in zip(sorted(found), wanted, strict=True))
            )
        return Confirmation(
            worst, ROUTE_POINTS, DIGITS, "eigenvalues of the differenced tangent against K"
        )


def _number(ctx: Any, value: sp.Expr) -> Any:
    return ctx.mpf(str(sp.N(value, ctx.dps + 5)))


# -- bounds of the tangent -----------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class TangentBounds:
    """`low <= D^2 W form <= high` with both bounds reached: by the form across K eps and along it.

    form - low and high - form must be positive multiples of (K eps . w)^2/Q and of its
    Cauchy-Schwarz gap w.K w - (K eps . w)^2/Q (semidefinite by LDL^T for each direction).
    """

    meaning: Meaning

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Chain) or claim.relations != ("<=", "<="):
            return _REJECTED
        facts = Field(self.meaning.positive)
        k = theory.load_direction()
        along = (sp.Matrix(theory.DIRECTION).T * k)[0, 0] ** 2 / constitutive.quadratic_form()
        across = theory.rest_form() - along
        try:
            low, form, high = (_interpreted(self.meaning, side) for side in claim.sides)
            derived = theory.form_of(theory.hessian())
            certificates = (
                facts.equal(form, derived),
                facts.sign((form - low) / along) == 1,
                facts.sign((high - form) / across) == 1,
            )
        except (OutOfReach, IllTyped):
            return _REJECTED
        if all(certificates) and rest_is_uniform():
            return Decision(True, True, "exact squares: each bound is reached, the other not")
        return _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return DefiniteTangent(self.meaning).confirm(printed)


# -- monotonicity --------------------------------------------------------------------------------

_CONJUGATE: Mapping[sp.Symbol, sp.Symbol] = dict(zip(LOADS, STRAINS, strict=True))
state = {
    name: sp.IndexedBase(name, real=True)
    for name in ("u^A", "u^B", "v^A", "v^B", "m^A", "m^B", "n^A", "n^B")
}


@dataclass(frozen=True, eq=False)
class Monotone:
    """Each load increases with its strain: partial derivatives, or any two states.

    Partial derivatives of loads (other strains held) are diagonal entries of D^2 W, those of
    strains (other loads held) of D^2 W*; all twelve must be claimed. For any two states, `a load
    is larger in B than in A => so is its strain` is refuted by two states.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        stated = list(claims(printed))
        if stated and all(isinstance(claim, Implies) for claim in stated):
            return Decision(False, True, "two states", _two_states() if explain else None)
        wanted = {(load, strain) for load, strain in _CONJUGATE.items()}
        found = set()
        for claim in stated:
            if not isinstance(claim, Chain) or claim.relations != (">",) or claim.sides[1] != 0:
                return _REJECTED
            if not isinstance(claim.sides[0], Partial):
                return _REJECTED
            found.add(claim.sides[0].args)
        if found != wanted | {(strain, load) for load, strain in wanted}:
            return _REJECTED
        if _diagonals_positive():
            return Decision(True, True, "diagonals of D^2 W and D^2 W*: positive plus squares")
        return Decision(None, False, "no certificate")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """Diagonals of the differenced tangent and of its inverse against the structure."""
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(ROUTE_POINTS):
            tangent = numerical_tangent(seed, ctx)
            inverse = ctx.inverse(tangent)
            point = UNIT_STRAINS.sample(seed)
            loads = dict(zip(LOADS, theory.unit_loads(), strict=True))
            for k in range(6):
                derived = theory.hessian_factor() * theory.hessian_core()[k, k]
                dual = (theory.inverse_factor() * theory.inverse_core()[k, k]).xreplace(loads)
                evaluate = UNIT_STRAINS.evaluator(ctx, point)
                for value, number in ((derived, tangent), (dual, inverse)):
                    if not number[k, k] > 0:
                        return Confirmation(float("inf"), ROUTE_POINTS, DIGITS, "diagonals")
                    worst = max(worst, float(abs(evaluate(value) / number[k, k] - 1)))
        return Confirmation(
            worst, ROUTE_POINTS, DIGITS, "diagonals of the differenced tangent and its inverse"
        )


@cache
def _diagonals_positive() -> bool:
    """Diagonal entries as a positive factor times (positive + square), exactly; K, K^{-1} at rest.

    D^2 W: K_ii > 0 and (K eps)_i^2 >= 0. D^2 W*: K^{-1}_ii > 0, and K^{-1}_ii Q* - (K^{-1}
    sigma)_i^2 is semidefinite in sigma.
    """
    strains, loads = Field(UNIT_STRAINS.positive), Field((chiral_gap, constitutive.dual_form()))
    rest = Field((chiral_gap,))
    stiff, soft = constitutive.stiffness_at_rest(), constitutive.compliance_at_rest()
    tangent = theory.hessian_factor() * theory.hessian_core()
    inverse = theory.inverse_factor() * theory.inverse_core()
    return (
        strains.sign(theory.hessian_factor()) == 1
        and loads.sign(theory.inverse_factor()) == 1
        and all(
            strains.equal(theory.hessian()[i, i], tangent[i, i])
            and loads.equal(theory.inverse_hessian()[i, i], inverse[i, i])
            and rest.sign(stiff[i, i]) == 1
            and rest.sign(soft[i, i]) == 1
            and semidefinite(sp.Matrix(soft[i, i] * soft - soft[:, i] * soft[i, :]), rest)
            for i in range(6)
        )
    )


@cache
def _two_states() -> Counterexample:
    """m_1 grows from 3/4 to 1 while n_1 grows from 0 to 7/4 (all moduli 1, iota = 0, p = 2)."""
    constants = {c: sp.Integer(1) for c in sampling.simple_constants()[0]}
    constants |= {iota: sp.Integer(0), p: sp.Integer(2), gamma: sp.Integer(1)}
    strain = constitutive.law_of_strains()[0].subs(constants)
    nothing = dict.fromkeys(LOADS, sp.Integer(0))
    first = {**nothing, LOADS[0]: sp.Rational(3, 4)}
    second = {**nothing, LOADS[0]: sp.Integer(1), LOADS[3]: sp.Rational(7, 4)}
    before, after = strain.subs(first), strain.subs(second)
    if not before > after:
        raise AssertionError("the two states do not refute the claim")
    where = (
        *((str(c), str(x)) for c, x in constants.items()),
        ("m1^A", "3/4"), ("n1^A", "0"), ("m1^B", "1"), ("n1^B", "7/4"), ("other loads", "0"),
    )  # fmt: skip
    return Counterexample(where, f"u1^A = {before}", f"u1^B = {after}")


ENTRIES = TangentIdentity(replace(UNIT_STRAINS, simple=simple_strains))
TANGENTS = TangentIdentity(UNIT_STRAINS)
BLOCKS = TangentIdentity(WITH_ENERGY)
