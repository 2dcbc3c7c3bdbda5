"""Decides transcriptions: chains of equalities and inequalities, implications, equivalences.

A claim is first tried at generic points with 50 digits: a difference there disproves it, and a
small rational counterexample is looked for. Where all points agree the exact engine proves it,
or the decision stays open (`holds` None, and never "true").
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Every, Iff, Implies, instances
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point
from rodproof.derivations.records import Confirmation, Counterexample, Decision

DIGITS = 50
POINTS = 3
ROUTE_POINTS = 2  # the second route integrates, differentiates and solves: a second a point
TOLERANCE = 35  # digits that must agree; quadratures and numerical derivatives lose some
_ORDER = {"<": -1, "<=": -1, ">": 1, ">=": 1}


@dataclass(frozen=True, eq=False)
class Identity:
    """Equalities (and sign conditions) between derived quantities, on the domain of `meaning`."""

    meaning: Meaning

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        try:
            return self._decide(printed, explain)
        except (IllTyped, OutOfReach) as reason:
            return Decision(None, False, f"not decided: {reason}")

    def _decide(self, printed: sp.Basic, explain: bool) -> Decision:
        exact = True
        methods: list[str] = []
        for claim in claims(printed):
            found = _decide_claim(claim, self.meaning, explain)
            if found.holds is False or (found.holds is None and not found.exact):
                return found
            exact = exact and found.exact
            if found.method not in methods:
                methods.append(found.method)
        return Decision(True, exact, "; ".join(methods))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        if self.meaning.route is None:
            return None
        ctx = context(DIGITS + 15)
        worst = 0.0
        for seed in range(ROUTE_POINTS):
            point = self.meaning.sample(seed)
            evaluate = self.meaning.evaluator(ctx, point, _routed(self.meaning, seed))
            for claim in claims(printed):
                for left, relation, right in _links(claim):
                    if relation == "=":
                        worst = max(worst, _residual(evaluate(left), evaluate(right)))
                    elif not _agrees((left, relation, right), evaluate):
                        worst = float("inf")
        return Confirmation(worst, ROUTE_POINTS, DIGITS, self.meaning.route_name)


@cache
def _routed(meaning: Meaning, seed: int) -> dict[sp.Basic, Any]:
    assert meaning.route is not None
    return dict(meaning.route(meaning.sample(seed), context(DIGITS + 15)))


@cache
def at_generic_point(meaning: Meaning, seed: int) -> Evaluator:
    """The numbers of one generic point of a domain, shared by all broken twins."""
    return meaning.evaluator(context(DIGITS), meaning.sample(seed))


def claims(printed: sp.Basic) -> Iterator[sp.Basic]:
    """The single claims of a transcription: one per value of its Greek indices."""
    for tree in instances(printed):
        yield from tree.args if isinstance(tree, Every) else (tree,)


def _links(claim: sp.Basic) -> Iterator[tuple[sp.Expr, str, sp.Expr]]:
    if isinstance(claim, Chain):
        yield from claim.links()


@cache  # a mutant differs from its original in one claim of many
def _decide_claim(claim: sp.Basic, meaning: Meaning, explain: bool) -> Decision:
    if isinstance(claim, Chain):
        return _decide_chain(claim, meaning, explain)
    if isinstance(claim, Implies):
        hypothesis, conclusion = claim.args
        if not isinstance(hypothesis, Chain) or not set(hypothesis.relations) <= {"<", ">"}:
            raise IllTyped("only strict inequalities narrow a domain")
        facts = tuple(_difference(link, meaning) for link in hypothesis.links())
        return _decide_chain(conclusion, _given(meaning, hypothesis, facts), explain)
    if isinstance(claim, Iff):
        return _decide_equivalence(claim, meaning)
    raise IllTyped(f"no rule for a claim of the form {type(claim).__name__}")


def _given(meaning: Meaning, hypothesis: Chain, facts: tuple[sp.Expr, ...]) -> Meaning:
    """The domain narrowed by a hypothesis: its points, and what is positive there."""

    def meets(point: Point) -> bool:
        return all(bool(sp.N(fact.subs(point), 30) > 0) for fact in facts)

    def sample(seed: int) -> Point:
        found = (meaning.sample(k) for k in range(seed, seed + 200))
        point = next((point for point in found if meets(point)), None)
        if point is None:
            raise IllTyped(f"no generic point meets {hypothesis}: nothing would be claimed")
        return point

    return replace(
        meaning,
        name=f"{meaning.name}, {hypothesis}",
        positive=meaning.positive + facts,
        sample=sample,
        simple=lambda: tuple(point for point in meaning.simple() if meets(point)),
    )


def _decide_chain(claim: Chain, meaning: Meaning, explain: bool) -> Decision:
    for link in claim.links():
        for seed in range(POINTS):
            if not _agrees(link, at_generic_point(meaning, seed)):
                found = counterexample(link, meaning) if explain else None
                return Decision(False, found is not None, "counterexample", found)
    field = Field(meaning.positive)
    methods = []
    for link in claim.links():
        left, relation, right = (link[0], link[1], link[2])
        if relation == "=":
            if not field.equal(meaning.interpret(left), meaning.interpret(right)):
                return Decision(None, False, f"{DIGITS} digits at {POINTS} generic points")
            methods.append("exact identity")
        else:
            sign = field.sign(_difference(link, meaning))
            if sign != 1 and not (sign == 0 and relation in ("<=", ">=")):
                return Decision(None, False, f"{DIGITS} digits at {POINTS} generic points")
            methods.append("sign certificate")
        edge = _edge_failure(link, meaning)
        if edge is not None:
            return edge
    return Decision(True, True, ", ".join(dict.fromkeys(methods)))


def _edge_failure(link: tuple[sp.Expr, str, sp.Expr], meaning: Meaning) -> Decision | None:
    """Claims must also hold where the generic argument says nothing (zero load, rest)."""
    for edge in meaning.edges:
        try:
            sides = [meaning.interpret(side).subs(edge) for side in (link[0], link[2])]
        except ZeroDivisionError:
            sides = [sp.nan, sp.nan]
        where = tuple((str(k), str(v)) for k, v in edge.items())
        undefined = any(_undefined(side, edge, meaning) for side in (link[0], link[2]))
        infinite = any(side.has(sp.nan, sp.zoo, sp.oo) or _power_of_zero(side) for side in sides)
        if undefined or infinite:
            found = Counterexample(where, *(str(s) for s in sides))
            return Decision(False, True, "undefined on the edge of the domain", found)
        if link[1] != "=":
            if not _ordered(sides, link[1], meaning, edge):
                return Decision(None, False, f"{DIGITS} digits; open on the edge of the domain")
            continue
        if sp.expand(sides[0] - sides[1]) != 0 and not Field().equal(*sides):
            found = Counterexample(where, *(str(s) for s in sides))
            return Decision(False, True, "counterexample on the edge of the domain", found)
    return None


def _ordered(
    sides: list[sp.Expr], relation: str, meaning: Meaning, edge: Mapping[sp.Symbol, sp.Expr]
) -> bool:
    """An inequality on the edge, by what is positive there still."""
    facts = (fact.subs(edge) for fact in meaning.positive)
    field = Field(fact for fact in facts if fact.free_symbols)
    sign = field.sign(_ORDER[relation] * (sides[0] - sides[1]))
    return sign == 1 or (sign == 0 and relation in ("<=", ">="))


def _undefined(side: sp.Expr, edge: Mapping[sp.Symbol, sp.Expr], meaning: Meaning) -> bool:
    """Does the transcription itself divide by zero there, even if a zero factor hides it?"""
    return any(
        not power.exp.is_positive and meaning.interpret(power.base).subs(edge) == 0
        for power in side.atoms(sp.Pow)
        if not power.base.is_Symbol and not power.base.is_number
    )


def _power_of_zero(expr: sp.Basic) -> bool:
    return any(power.base == 0 for power in expr.atoms(sp.Pow))


def _decide_equivalence(claim: Iff, meaning: Meaning) -> Decision:
    """a > 0 iff b > 0, because a is b times something positive (both ways at once)."""
    field = Field(meaning.positive)
    for side in claim.args:
        if not isinstance(side, Chain) or side.relations not in (("<",), (">",)):
            raise IllTyped("only single strict inequalities are compared")
    differences = [_difference(next(iter(side.links())), meaning) for side in claim.args]
    for other in differences[1:]:
        if field.sign(differences[0] / other) != 1:
            return Decision(None, False, "no positive ratio found")
    return Decision(True, True, "ratio of the two sides positive by factorisation")


def _difference(link: tuple[sp.Expr, str, sp.Expr], meaning: Meaning) -> sp.Expr:
    """What is positive if the inequality holds."""
    left, relation, right = link
    sign = _ORDER[relation]
    return sign * (meaning.interpret(left) - meaning.interpret(right))


def _agrees(link: tuple[sp.Expr, str, sp.Expr], evaluate: Evaluator) -> bool:
    left, relation, right = link
    try:
        a, b = evaluate(left), evaluate(right)
    except (ZeroDivisionError, IllTyped, KeyError, TypeError):
        return False
    if relation == "=":
        return _residual(a, b) < 10.0**-TOLERANCE
    if _is_complex(a) or _is_complex(b):
        return False
    return bool(a <= b if _ORDER[relation] < 0 else a >= b)


def _is_complex(value: Any) -> bool:
    return bool(getattr(value, "imag", 0))


def _residual(a: Any, b: Any) -> float:
    scale = max(abs(a), abs(b))
    return 0.0 if a == b else float(abs(a - b) / max(scale, 1))


def counterexample(link: tuple[sp.Expr, str, sp.Expr], meaning: Meaning) -> Counterexample | None:
    """A small point of the domain with exact, different values: rational ones if there are any."""
    relation = link[1]
    left, right = (meaning.interpret(side) for side in (link[0], link[2]))
    fallback = None
    for point in meaning.simple():
        a, b = left.subs(point), right.subs(point)
        if not (a.is_finite and b.is_finite) or _respects(a, relation, b):
            continue
        plays = left.free_symbols | right.free_symbols
        where = tuple((str(k), str(x)) for k, x in point.items() if k in plays)
        found = Counterexample(where, str(a), str(b))
        if a.is_Rational and b.is_Rational:
            return found
        fallback = fallback or found
    return fallback


def _respects(a: sp.Expr, relation: str, b: sp.Expr) -> bool:
    difference = sp.N(a - b, 30)
    if relation == "=":
        return bool(abs(difference) < sp.Float("1e-25"))
    return bool(difference < 0) if relation in ("<", "<=") else bool(difference > 0)
