"""The records that pass between the stages: statements, decisions, evidence, derivation steps."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Protocol

import sympy as sp

VERDICTS = ("definition", "proved", "checked", "reading", "refuted", "undecided")


@dataclass(frozen=True)
class Counterexample:
    """A point of the claimed domain at which the claim fails, with both sides' values."""

    point: tuple[tuple[str, str], ...]
    left: str
    right: str

    def __str__(self) -> str:
        where = ", ".join(f"{name} = {value}" for name, value in self.point)
        left, right = (side.replace("**", "^") for side in (self.left, self.right))
        return f"at {where}: {left} against {right}"


@dataclass(frozen=True)
class Decision:
    """What a check finds of one transcription: `holds` is None where nothing could be decided.

    `exact` is True if `holds` rests on a proof; `method` names it.
    """

    holds: bool | None
    exact: bool
    method: str
    counterexample: Counterexample | None = None


@dataclass(frozen=True)
class Confirmation:
    """The second route: the largest relative residual over generic points, and how it was made."""

    residual: float
    points: int
    digits: int
    route: str


class Check(Protocol):
    """How a statement is held against the derivation."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        """Is this transcription true on the whole claimed domain?

        With `explain` False the caller only needs the answer: no counterexample is built.
        """

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """Numbers by an independent route, or None where a claim has no numbers in it."""


@dataclass(frozen=True)
class Statement:
    """One statement of the paper.

    id, section, label: as in the inventory. claim: what it says, in our words. latex: the
    formula as printed ('' for a claim in words). printed: its transcription, errors included;
    for a claim in words, its formal content. check: how it is decided. introduces: True for a
    definition. reading: what must be assumed for it to hold; read_as: the transcription under
    that reading. correction: the smallest repaired statement, for a false one. note: what else
    a reader should know.
    """

    id: str
    section: str
    label: str
    claim: str
    latex: str
    printed: sp.Basic
    check: Check
    introduces: bool = False
    reading: str = ""
    read_as: sp.Basic | None = None
    correction: sp.Basic | None = None
    note: str = ""

    @property
    def accepted(self) -> sp.Basic:
        """What is held to be true: the correction, the reading, or what is printed."""
        return self.correction or self.read_as or self.printed


@dataclass(frozen=True)
class Evidence:
    """The verdict on one statement and what it rests on (field names are the JSON's)."""

    id: str
    section: str
    label: str
    verdict: str
    method: str
    digits: int | None
    points: int
    seconds: float
    mutants_tried: int | None
    mutants_killed: int | None
    mutants_equivalent: int | None
    counterexample: str | None
    correction_latex: str | None
    reading: str | None
    claim: str = ""
    latex: str = ""
    residual: float | None = None
    route: str | None = None
    note: str = ""
    survivors: tuple[str, ...] = ()
    repaired_by: str | None = None

    def as_row(self) -> dict[str, object]:
        """The evidence as plain data for JSON."""
        return asdict(self)


@dataclass(frozen=True, eq=False)
class Step:
    """One step of a derivation.

    rule: why the formula follows from what stands before it. formula: what is reached, in the
    notation of the paper. check: proves the formula on its own (None for a definition).
    statements: the ids of the printed statements that it settles.
    """

    title: str
    rule: str
    formula: sp.Basic
    check: Check | None = None
    statements: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Derivation:
    """A named chain of steps, with the problem stated before any algebra."""

    label: str
    title: str
    problem: str
    steps: tuple[Step, ...]
