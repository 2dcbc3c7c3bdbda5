"""Steps that establish a printed statement, with the statement's own formula and check."""

from __future__ import annotations

from rodproof.derivations import ledger
from rodproof.derivations.records import Step


def settle(name: str, title: str, rule: str, *also: str) -> Step:
    """A step whose formula is what the statement says, corrected or as read where it must be.

    also: further statements that the same step settles.
    """
    (statement,) = ledger.find((name,))
    return Step(title, rule, statement.accepted, statement.check, (name, *also))
