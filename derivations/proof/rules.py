"""Rules of proof beyond identities: potentials, sharp bounds, positive definite forms, ranges.

Each is a small frozen check. It accepts a transcription only with a proof, and is strict about
the strongest true form: a bound must be the supremum, a hypothesis must be equivalent to what
is needed, so that a weaker or stronger twin is rejected.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Every, Implies, PositiveDefinite, instances
from rodproof.derivations.proof.meaning import IllTyped, Meaning
from rodproof.derivations.proof.prover import (
    DIGITS,
    POINTS,
    ROUTE_POINTS,
    Identity,
    claims,
    counterexample,
)
from rodproof.derivations.records import Confirmation, Counterexample, Decision

_REJECTED = Decision(False, False, "rejected")


@dataclass(frozen=True, eq=False)
class Potential:
    """`F = expression` where F has the given gradient and vanishes at `rest`.

    Two functions on a connected domain with the same gradient and one common value agree, so an
    energy is decided without evaluating its integral. energy: F as the notation writes it, with
    its arguments in their order.
    """

    meaning: Meaning
    energy: sp.Expr
    gradient: tuple[tuple[sp.Symbol, sp.Expr], ...]
    rest: tuple[tuple[sp.Symbol, sp.Expr], ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Chain) or claim.relations != ("=",):
            return _REJECTED
        function, expression = claim.sides
        try:
            factor = sp.cancel(function / self.energy)  # a mutant may scale the left side
            if not factor.is_number or expression.has(type(self.energy)):
                return _REJECTED
            energy = self.meaning.interpret(expression) / factor
            slopes = tuple((sp.diff(energy, x), slope) for x, slope in self.gradient)
            at_rest = _collapse(energy.subs(dict(self.rest)))
        except (IllTyped, ValueError, ZeroDivisionError):
            return _REJECTED
        if at_rest != 0:
            point = tuple((str(k), str(x)) for k, x in self.rest)
            return Decision(False, True, "value at rest", Counterexample(point, "0", str(at_rest)))
        for slope, wanted in slopes:
            for seed in range(POINTS):
                evaluate = self.meaning.evaluator(context(DIGITS), self.meaning.sample(seed))
                if not _close(evaluate, slope, wanted):
                    found = counterexample((wanted, "=", slope), self.meaning) if explain else None
                    return Decision(False, found is not None, "gradient differs", found)
        field = Field(self.meaning.positive)
        if all(field.equal(slope, wanted) for slope, wanted in slopes):
            return Decision(True, True, "same gradient and same value at rest, exactly")
        return Decision(None, False, f"gradient agrees to {DIGITS} digits")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(self.meaning).confirm(printed)


def _collapse(expr: sp.Expr) -> sp.Expr:
    """Integrals over an empty interval are zero."""
    empty = {i: sp.Integer(0) for i in expr.atoms(sp.Integral) if i.args[1][1] == i.args[1][2]}
    return expr.xreplace(empty)


def _close(evaluate: Any, a: sp.Expr, b: sp.Expr) -> bool:
    try:
        left, right = evaluate(a), evaluate(b)
    except (ZeroDivisionError, KeyError, TypeError):
        return False
    return bool(abs(left - right) <= abs(right) * 10.0**-35)


@dataclass(frozen=True, eq=False)
class EllipsoidBound:
    """`functional < bound` on the strains with Q < 1, sharp and not attained.

    strain: the six strains from rest. stiffness: the matrix of Q. extremals: boundary points
    (Q = 1), possibly with a free angle, at which the functional must equal the bound.
    Proof: bound^2 Q - functional^2 is a sum of squares (exact LDL^T), so functional^2 <=
    bound^2 Q < bound^2; at the extremals equality holds, so no smaller bound is true.
    """

    strain: tuple[sp.Symbol, ...]
    rest: tuple[sp.Expr, ...]
    stiffness: sp.ImmutableMatrix
    extremals: tuple[tuple[sp.Expr, ...], ...]
    positive: tuple[sp.Expr, ...]
    sample: Callable[[int], Any]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Chain) or claim.relations != ("<",):
            return _REJECTED
        functional, bound = claim.sides
        field = Field(self.positive)
        try:
            for extremal in self.extremals:
                point = dict(zip(self.strain, extremal, strict=True))
                if not field.equal((functional**2).subs(point), bound**2):
                    return Decision(False, False, "not the supremum")
            if field.sign(bound) != 1 or field.sign(bound**2) != 1:
                return _REJECTED
            square = self._matrix(functional**2)
            if square is None or self._negative(functional):
                return _REJECTED
            if semidefinite(bound**2 * self.stiffness - square, field):
                return Decision(True, True, "sum of squares (LDL^T) and an exact extremal")
        except OutOfReach:
            return _REJECTED
        return Decision(None, False, "no sum of squares found")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The supremum as the largest eigenvalue of functional^2 relative to K."""
        (claim,) = claims(printed)
        functional, bound = claim.sides
        square = self._matrix(functional**2)
        assert square is not None
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(POINTS):
            point = self.sample(seed)
            L = ctx.matrix([[_number(ctx, e.subs(point)) for e in row] for row in square.tolist()])
            K = ctx.matrix(
                [[_number(ctx, e.subs(point)) for e in row] for row in self.stiffness.tolist()]
            )
            root = ctx.cholesky(K)
            inverse = ctx.inverse(root)
            values = ctx.eigsy(inverse * L * inverse.T, eigvals_only=True)
            target = _number(ctx, sp.N(bound.subs(point), DIGITS + 15))
            worst = max(worst, float(abs(ctx.sqrt(max(values)) / target - 1)))
        return Confirmation(worst, POINTS, DIGITS, "largest generalised eigenvalue, numerically")

    def _matrix(self, square: sp.Expr) -> sp.Matrix | None:
        """The symmetric matrix of a quadratic form in the strains from rest."""
        shifted = square.subs(
            {s: s + r for s, r in zip(self.strain, self.rest, strict=True)}, simultaneous=True
        )
        expanded = sp.expand(shifted)
        if not expanded.is_polynomial(*self.strain):
            return None
        form = sp.Poly(expanded, *self.strain)
        if any(sum(monom) != 2 for monom in form.monoms()):
            return None
        return sp.hessian(form.as_expr(), self.strain) / 2

    def _negative(self, functional: sp.Expr) -> bool:
        """A norm is nonnegative; a mutant may have put a minus before it."""
        point = self.sample(0)
        return bool(functional.subs(point) < 0)


def _number(ctx: Any, value: sp.Expr) -> Any:
    return ctx.mpf(str(sp.N(value, ctx.dps + 5)))


def semidefinite(matrix: sp.Matrix, field: Field) -> bool:
    """Exact LDL^T with pivoting: eliminate by positive pivots until nothing is left."""
    a = sp.Matrix(matrix)
    left = list(range(a.rows))
    while left:
        pivot = next((k for k in left if field.sign(a[k, k]) == 1), None)
        if pivot is None:
            return all(field.is_zero(a[i, j]) for i in left for j in left)
        left.remove(pivot)
        for i in left:
            for j in left:
                a[i, j] = a[i, j] - a[i, pivot] * a[pivot, j] / a[pivot, pivot]
    return True


@dataclass(frozen=True, eq=False)
class Supremum:
    """`value < bound`, where `value` is the derived `radius`^2 and the bound its supremum.

    The derived radius x satisfies x^p = y^p/(gamma^p + y^p) = 1/(1 + (gamma/y)^p), increasing to 1.
    """

    meaning: Meaning
    value: sp.Expr
    power: sp.Expr
    fraction: sp.Expr  # value**power, as a fraction below 1 whose limit is 1
    supremum: sp.Expr
    onto: tuple[tuple[sp.Expr, sp.Expr], ...] = ()  # identities showing that all values occur

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Chain) or claim.relations != ("<",):
            return _REJECTED
        value, bound = (self.meaning.interpret(side) for side in claim.sides)
        field = Field(self.meaning.positive)
        try:
            same = field.equal(value, self.value) and field.equal(bound, self.supremum)
            proved = (
                same
                and field.equal(self.value**self.power, self.fraction)
                and field.sign(1 - self.fraction) == 1
                and all(field.equal(a, b) for a, b in self.onto)
            )
        except OutOfReach:
            return _REJECTED
        if not proved:
            return _REJECTED
        return Decision(True, True, "sign certificate, and the bound is the limit")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """At loads 10^k times a generic one the gap to the bound must close like (gamma/y)^p."""
        (claim,) = claims(printed)
        value, bound = claim.sides
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(ROUTE_POINTS):
            point = dict(self.meaning.sample(seed))
            assert self.meaning.route is not None
            evaluate = self.meaning.evaluator(ctx, point, self.meaning.route(point, ctx))
            found, sharp = evaluate(value), evaluate(bound)
            if not found < sharp:
                return Confirmation(float("inf"), ROUTE_POINTS, DIGITS, self.meaning.route_name)
            exact = evaluate(self.meaning.interpret(self.value))
            worst = max(worst, float(abs(found / exact - 1)))
        return Confirmation(worst, ROUTE_POINTS, DIGITS, self.meaning.route_name)


@dataclass(frozen=True, eq=False)
class Ranges:
    """Exactly these quantities are declared positive (a definition of ranges)."""

    positive: tuple[sp.Expr, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        found = set()
        for claim in claims(printed):
            if not isinstance(claim, Chain) or claim.relations != (">",) or claim.sides[1] != 0:
                return _REJECTED
            found.add(claim.sides[0])
        if found == set(self.positive):
            return Decision(True, True, "the ranges that the derivation needs")
        return _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class EquivalentSign:
    """`expression > 0` exactly when `needed` > 0, for constants in their ranges.

    Proved by a positive ratio; refuted by constants at which the signs differ.
    """

    needed: sp.Expr
    candidates: Callable[[], Iterable[dict[sp.Symbol, sp.Expr]]]
    consequence: Callable[[dict[sp.Symbol, sp.Expr]], str]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = claims(printed)
        if not isinstance(claim, Chain) or claim.relations not in ((">",), ("<",)):
            return _REJECTED
        left, right = claim.sides
        expression = left - right if claim.relations == (">",) else right - left
        if Field().sign(sp.together(expression / self.needed)) == 1:
            return Decision(True, True, "equivalent to positive definiteness of K")
        for point in self.candidates():
            value, needed = expression.subs(point), self.needed.subs(point)
            if (value > 0) != (needed > 0):
                where = tuple((str(k), str(x)) for k, x in point.items())
                found = Counterexample(where, f"{expression} = {value}", self.consequence(point))
                return Decision(False, True, "counterexample", found)
        return Decision(None, False, "not decided")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class DefiniteForms:
    """Under a hypothesis on the constants the derived forms are positive definite.

    The transcribed forms must be the derived ones, and every leading minor positive under the
    hypothesis (Sylvester). Refuted by constants that meet the hypothesis and a vector at which a
    form is not positive.
    """

    forms: tuple[tuple[sp.Expr, tuple[sp.Symbol, ...], tuple[sp.Expr, ...]], ...]
    candidates: Callable[[], Iterable[dict[sp.Symbol, sp.Expr]]]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = instances(printed)
        if not isinstance(claim, Implies):
            return _REJECTED
        hypothesis, conclusion = claim.args
        stated = conclusion.args if isinstance(conclusion, Every) else (conclusion,)
        definite = all(isinstance(s, PositiveDefinite) for s in stated)
        if len(stated) != len(self.forms) or not definite:
            return _REJECTED
        hypotheses = hypothesis.args if isinstance(hypothesis, Every) else (hypothesis,)
        try:
            facts = [_excess(h) for h in hypotheses]
            field = Field(facts)
        except (IllTyped, OutOfReach):
            return _REJECTED
        if explain:
            for point in self.candidates():
                failure = self._failure(point, facts)
                if failure is not None:
                    return Decision(False, True, "counterexample", failure)
        for statement, (form, variables, rest) in zip(stated, self.forms, strict=True):
            if not field.equal(statement.args[0], form):
                found = _different_form(statement.args[0], form, variables) if explain else None
                return Decision(False, found is not None, "not the derived form", found)
            matrix = _form_matrix(form, variables, rest)
            minors = (matrix[:k, :k].det(method="berkowitz") for k in range(1, 7))
            if not all(field.sign(minor) == 1 for minor in minors):
                return _REJECTED
        return Decision(True, True, "leading minors positive by factorisation")

    def _failure(
        self, point: dict[sp.Symbol, sp.Expr], facts: list[sp.Expr]
    ) -> Counterexample | None:
        if not all(fact.subs(point) > 0 for fact in facts):
            return None
        for form, variables, rest in self.forms:
            if form.subs(point).has(sp.zoo, sp.nan):
                continue
            for a, b in ((1, 0), (0, 1), (1, -1), (1, 1)):
                at = {**dict.fromkeys(variables, sp.Integer(0)), variables[2]: sp.Integer(a)}
                at = {s: x + r for (s, x), r in zip(at.items(), rest, strict=True)}
                at[variables[5]] = b + rest[5]
                value = form.subs(point).subs(at)
                if value <= 0:
                    where = tuple((str(k), str(x)) for k, x in {**point, **at}.items())
                    return Counterexample(where, f"form = {value}", "positive")
        return None

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


def _excess(claim: sp.Basic) -> sp.Expr:
    if not isinstance(claim, Chain) or claim.relations not in (("<",), (">",)):
        raise IllTyped("a hypothesis on the constants is one strict inequality")
    left, right = claim.sides
    return left - right if claim.relations == (">",) else right - left


def _form_matrix(
    form: sp.Expr, variables: tuple[sp.Symbol, ...], rest: tuple[sp.Expr, ...]
) -> sp.Matrix:
    shifted = form.subs({s: s + r for s, r in zip(variables, rest, strict=True)}, simultaneous=True)
    return sp.hessian(shifted, variables) / 2


def _different_form(
    printed: sp.Expr, derived: sp.Expr, variables: tuple[sp.Symbol, ...]
) -> Counterexample | None:
    difference = sp.expand(printed - derived)
    for symbol in sorted(difference.free_symbols, key=str):
        others = {s: 1 if s.is_positive else 0 for s in difference.free_symbols - {symbol}}
        point = {**others, symbol: sp.Integer(1)}
        a, b = printed.subs(point), derived.subs(point)
        if a.is_finite and b.is_finite and a != b and not symbol.is_positive:
            where = tuple((str(k), str(x)) for k, x in sorted(point.items(), key=str))
            return Counterexample(where, str(a), str(b))
    return None


@dataclass(frozen=True, eq=False)
class Formalised:
    """A claim in words, decided by `accepts` on its formal content; `method` says how."""

    accepts: Callable[[sp.Basic], bool]
    method: str

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        return Decision(True, True, self.method) if self.accepts(printed) else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class MatrixIdentity:
    """Two matrices agree entry by entry, exactly; `sides` makes them when they are asked for."""

    sides: Callable[[], tuple[sp.Matrix, sp.Matrix]]
    positive: tuple[sp.Expr, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        field = Field(self.positive)
        left, right = self.sides()
        agree = all(field.equal(a, b) for a, b in zip(left, right, strict=True))
        return Decision(agree or None, True, f"exact identity of {len(left)} entries")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None
