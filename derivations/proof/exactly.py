"""A check bound to the subject of its claim, so that a true formula about less is rejected."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.notation import Every, LimitOf, instances
from rodproof.derivations.records import Check, Confirmation, Decision

_REJECTED = Decision(False, False, "rejected")

#: The quantities of a claim, the limits that it takes, and the number of its parts.
Subject = tuple[frozenset[sp.Basic], frozenset[tuple[sp.Basic, ...]], int]


@dataclass(frozen=True, eq=False)
class Exactly:
    """A check whose claim must be about exactly these quantities, and not say a thing twice.

    Where quantities vanish, one may stand for another in a true formula that says less.
    """

    check: Check
    subject: Subject

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if _subject(printed) != self.subject:
            return _REJECTED
        return self.check.decide(printed, explain=explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return self.check.confirm(printed)


def _subject(printed: sp.Basic) -> Subject:
    (claim,) = instances(printed)
    parts = set(claim.args) if isinstance(claim, Every) else {claim}
    targets = frozenset(limit_.args[1:] for limit_ in claim.atoms(LimitOf))
    return frozenset(claim.free_symbols), targets, len(parts)


def exactly(check: Check, printed: sp.Basic) -> dict[str, Any]:
    """The two fields of a statement: what is printed, and the check bound to its subject."""
    return {"printed": printed, "check": Exactly(check, _subject(printed))}
