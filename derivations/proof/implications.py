"""If one strict inequality holds then others do, proved by solving the first for a variable."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cache

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Implies
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point
from rodproof.derivations.proof.prover import DIGITS
from rodproof.derivations.proof.vectors import REJECTED, Vectors
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import CONSTANTS

_excess = sp.Symbol("excess", positive=True)


def difference(claim: sp.Basic, *, strict: bool = False) -> sp.Expr:
    """What is positive (or not negative, unless `strict`) if the single inequality holds."""
    if not isinstance(claim, Chain) or len(claim.relations) != 1 or claim.relations[0] == "=":
        raise IllTyped("one inequality is needed here")
    if strict and claim.relations[0] not in ("<", ">"):
        raise IllTyped("a strict inequality is needed here")
    left, right = claim.sides
    return left - right if claim.relations[0] in (">", ">=") else right - left


@cache
def _evaluators(check: Implication) -> tuple[Evaluator, ...]:
    ctx = context(DIGITS)
    return tuple(check.meaning.evaluator(ctx, point) for point in check.candidates)


@dataclass(frozen=True, eq=False)
class Implication:
    """`Implies(h > 0, c > 0)` (or several c) on the domain of `meaning`.

    Proof: h is a monomial in one free variable up to its coefficient, so h = excess > 0 is solved
    for it, and then every c has a sign certificate. Disproof: a point with h > 0 and not c > 0.
    A hypothesis that no trial point meets is rejected: nothing would be claimed. With `sharp`,
    every c must vanish with h, so that a weaker conclusion is rejected too.
    """

    meaning: Meaning
    candidates: tuple[Point, ...]
    sharp: bool = False
    vectors: Vectors = field(default_factory=lambda: Vectors({}))

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Implies):
            return REJECTED
        try:
            hypotheses, conclusions = (self.vectors.spread(part).args for part in printed.args)
            (given,) = (self.meaning.interpret(difference(h, strict=True)) for h in hypotheses)
            wanted = [self.meaning.interpret(difference(c, strict=True)) for c in conclusions]
        except (IllTyped, ValueError):
            return REJECTED
        try:
            return self._decide(given, wanted, explain)
        except (KeyError, TypeError, ZeroDivisionError):
            return REJECTED  # a quantity that the domain does not have

    def _decide(self, given: sp.Expr, wanted: list[sp.Expr], explain: bool) -> Decision:
        trials = zip(self.candidates, _evaluators(self), strict=True)
        held = [(point, evaluate) for point, evaluate in trials if evaluate(given) > 0]
        if not held:
            return Decision(False, False, "the hypothesis is never met")
        for point, evaluate in held:
            for c in wanted:
                if not evaluate(c) > 0:
                    where = tuple((str(k), str(x)) for k, x in point.items())
                    exact = str(sp.nsimplify(c.subs(point)))
                    found = Counterexample(where, exact, "> 0") if explain else None
                    return Decision(False, found is not None, "counterexample", found)
        return self._prove(given, wanted)

    def _prove(self, given: sp.Expr, wanted: list[sp.Expr]) -> Decision:
        for variable in sorted(given.free_symbols, key=lambda s: (s in CONSTANTS, str(s))):
            coefficient = sp.cancel(given / variable)
            if variable not in self.meaning.free or coefficient.has(variable):
                continue
            solved = {variable: _excess / coefficient}
            try:
                facts = [fact.subs(solved) for fact in self.meaning.positive]
                if not all(Field(facts).sign(c.subs(solved)) == 1 for c in wanted):
                    continue
                if self.sharp and not all(Field().is_zero(c.subs(variable, 0)) for c in wanted):
                    return Decision(False, False, "true, but more could be said")
                return Decision(True, True, "hypothesis solved for, then sign certificates")
            except OutOfReach:
                continue
        return Decision(None, False, f"{DIGITS} digits at {len(self.candidates)} points")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None
