"""A second route of its own for a check that decides by exact algebra alone.

A route looks at a claim at numbers and says by how much it misses: 0 for an inequality or an
equivalence that holds at a point, the margin by which it fails where it does not, and the
relative difference of two numbers that should agree.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.notation import Chain
from rodproof.derivations.proof.meaning import IllTyped
from rodproof.derivations.proof.prover import DIGITS
from rodproof.derivations.records import Check, Confirmation, Decision

#: What is smaller is a zero up to rounding; generic quantities are far above it.
ZERO = 1e-40


@dataclass(frozen=True, eq=False)
class Route:
    """How a claim is looked at, in words, and by how much it misses at each of several points."""

    name: str
    misses: Callable[[sp.Basic, Any], Iterator[Any]]

    def look(self, printed: sp.Basic) -> Confirmation:
        """The worst of all points. Raises ValueError where a route has looked at no point."""
        return _looked(self, printed)


@cache  # two statements may say the same
def _looked(route: Route, printed: sp.Basic) -> Confirmation:
    found = [float(miss) for miss in route.misses(printed, context(DIGITS + 15))]
    worst = max(math.inf if math.isnan(miss) else miss for miss in found)
    return Confirmation(worst, len(found), DIGITS, route.name)


@dataclass(frozen=True, eq=False)
class Routed:
    """A check that decides as `check` does and is confirmed by `route`."""

    check: Check
    route: Route

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        return self.check.decide(printed, explain=explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return self.route.look(printed)


def excess(claim: sp.Basic, evaluate: Evaluator) -> Any:
    """greater - smaller of a single inequality, as a number: it holds where that is positive."""
    if not isinstance(claim, Chain) or claim.relations not in (("<",), (">",), ("<=",), (">=",)):
        raise IllTyped("one inequality is needed here")
    left, right = (evaluate(side) for side in claim.sides)
    return left - right if claim.relations[0] in (">", ">=") else right - left


def apart(claim: sp.Basic, evaluate: Evaluator) -> Any:
    """|left - right| of a single equation, as a number."""
    if not isinstance(claim, Chain) or claim.relations != ("=",):
        raise IllTyped("one equation is needed here")
    left, right = (evaluate(side) for side in claim.sides)
    return abs(left - right)


def short(value: Any) -> Any:
    """By how much a quantity fails to be positive; a zero fails altogether."""
    if value > ZERO:
        return 0.0
    return math.inf if value > -ZERO else -value


def at_odds(*values: Any) -> Any:
    """0 where all are positive or none is; else the size of the largest."""
    return 0.0 if len({bool(value > ZERO) for value in values}) == 1 else max(map(abs, values))


def vanish_together(*values: Any) -> Any:
    """0 where all vanish or none does; else the size of the largest."""
    sizes = [abs(value) for value in values]
    return 0.0 if len({bool(size < ZERO) for size in sizes}) == 1 else max(sizes)


def differ(found: Any, wanted: Any) -> Any:
    """The relative difference, absolute below 1."""
    return abs(found - wanted) / max(abs(found), abs(wanted), 1)
