"""Equations between vectors: each becomes three equations between components, then proved as such.

A transcription names vectors as it names numbers (`Prime(d[k])`, `Cross(u_vector, d[k])`); a
`Vectors` table says which names are vectors and what their components are in the fixed basis. A
sum of a vector and a number, or a product of two vectors without a sign, is a misprint.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import sympy as sp

from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Cross, Dot, Every
from rodproof.derivations.proof.meaning import IllTyped, Meaning
from rodproof.derivations.proof.prover import DIGITS, POINTS, Identity, claims
from rodproof.derivations.records import Confirmation, Decision

Components = tuple[sp.Expr, ...]
REJECTED = Decision(False, False, "rejected")


def symbols_of(name: str) -> Components:
    """The names of the three components of a vector in the fixed basis."""
    return tuple(sp.Symbol(f"{name}_g{i}", real=True) for i in (1, 2, 3))


@dataclass(frozen=True, eq=False)
class Vectors:
    """The vectors of a transcription with the symbols of their components; numbers with theirs."""

    table: Mapping[sp.Basic, Components | sp.Expr]

    def spread(self, printed: sp.Basic) -> Every:
        """The same claim with each equation between vectors as three between numbers."""
        found: list[sp.Basic] = []
        for claim in claims(printed):
            if not isinstance(claim, Chain):
                raise IllTyped("only chains can hold between vectors")
            found += self._chains(claim)
        return Every(*found)

    def _chains(self, claim: Chain) -> list[Chain]:
        sides = [self.value(side) for side in claim.sides]
        if not any(isinstance(side, tuple) for side in sides):
            return [Chain(sp.Tuple(*sides), claim.args[1])]
        if set(claim.relations) != {"="}:
            raise IllTyped("vectors are equal or not, none is the greater")
        return [
            Chain(sp.Tuple(*(self._entry(side, i) for side in sides)), claim.args[1])
            for i in range(3)
        ]

    @staticmethod
    def _entry(value: sp.Expr | Components, i: int) -> sp.Expr:
        if isinstance(value, tuple):
            return value[i]
        if value != 0:
            raise IllTyped(f"the number {value} stands where a vector belongs")
        return sp.Integer(0)

    def value(self, expr: sp.Expr) -> sp.Expr | Components:
        """The components of a vector, or a number."""
        if expr in self.table:
            return self.table[expr]
        if isinstance(expr, Cross | Dot):
            return self._product(expr)
        if isinstance(expr, sp.Add):
            return self._sum([self.value(a) for a in expr.args])
        if isinstance(expr, sp.Mul):
            return self._scaled([self.value(a) for a in expr.args])
        if not expr.args:
            return expr
        parts = [self.value(a) for a in expr.args]
        if any(isinstance(part, tuple) for part in parts):
            raise IllTyped(f"{expr.func.__name__} of a vector")
        return expr.func(*parts)

    def _product(self, expr: sp.Expr) -> sp.Expr | Components:
        a, b = (self.value(arg) for arg in expr.args)
        if not isinstance(a, tuple) or not isinstance(b, tuple):
            raise IllTyped(f"{expr} takes two vectors")
        if isinstance(expr, Dot):
            return sp.Add(*(x * y for x, y in zip(a, b, strict=True)))
        return tuple(sp.Matrix(a).cross(sp.Matrix(b)))

    @staticmethod
    def _sum(parts: list[sp.Expr | Components]) -> sp.Expr | Components:
        vectors = [part for part in parts if isinstance(part, tuple)]
        if not vectors:
            return sp.Add(*parts)
        if len(vectors) < len(parts):
            raise IllTyped("a number is added to a vector")
        return tuple(sp.Add(*entries) for entries in zip(*vectors, strict=True))

    @staticmethod
    def _scaled(parts: list[sp.Expr | Components]) -> sp.Expr | Components:
        vectors = [part for part in parts if isinstance(part, tuple)]
        if len(vectors) > 1:
            raise IllTyped("a product of vectors without a cross or a dot")
        factor = sp.Mul(*(part for part in parts if not isinstance(part, tuple)))
        return tuple(factor * entry for entry in vectors[0]) if vectors else factor


@dataclass(frozen=True, eq=False)
class VectorIdentity:
    """Equations between vectors (and between numbers made of them) on the domain of `meaning`."""

    meaning: Meaning
    vectors: Vectors

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        try:
            spread = self.vectors.spread(printed)
        except IllTyped as reason:
            return Decision(False, False, f"ill-typed: {reason}")
        return Identity(self.meaning).decide(spread, explain=explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(self.meaning).confirm(self.vectors.spread(printed))


@dataclass(frozen=True, eq=False)
class OnlySolution:
    """The equations have exactly one solution for one vector, the derived one.

    Existence: the derived vector satisfies them all identically. Uniqueness: they are linear in
    it, with a matrix A for which A^T A is a positive multiple of the identity.
    """

    identity: VectorIdentity
    unknown: sp.Symbol

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        found = self.identity.decide(printed, explain=explain)
        if not (found.holds and found.exact):
            return found
        gram = self._gram(printed)
        field = Field(self.identity.meaning.positive)
        scale = gram[0, 0]
        isotropic = all(
            field.equal(gram[i, j], scale if i == j else sp.Integer(0))
            for i in range(3)
            for j in range(i, 3)
        )
        if not isotropic or field.sign(scale) != 1:
            return Decision(False, False, "the equations do not determine the vector")
        method = "the derived vector satisfies all equations exactly; A^T A = 2 I, so no other does"
        return Decision(True, True, method)

    def _gram(self, printed: sp.Basic) -> sp.Matrix:
        unknown = self.identity.vectors.table[self.unknown]
        rows = []
        for chain in self.identity.vectors.spread(printed).args:
            residual = chain.sides[0] - chain.sides[1]
            row = [sp.diff(residual, entry) for entry in unknown]
            rows.append([self.identity.meaning.interpret(entry) for entry in row])
        A = sp.Matrix(rows)
        return A.T * A

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The smallest singular value of the system must be away from zero as well."""
        confirmed = self.identity.confirm(printed)
        gram, ctx = self._gram(printed), context(DIGITS)
        for seed in range(POINTS):
            meaning = self.identity.meaning
            evaluate = meaning.evaluator(ctx, meaning.sample(seed))
            numbers = ctx.matrix([[evaluate(entry) for entry in row] for row in gram.tolist()])
            if min(ctx.eigsy(numbers, eigvals_only=True)) < 1:
                return Confirmation(float("inf"), POINTS, DIGITS, "singular system")
        return confirmed
