"""The last table of ``rodproof run``: what came out of each stage, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rodproof.codegen import show
from rodproof.codegen.measure import records
from rodproof.codegen.pipeline import Outcome
from rodproof.codegen.places import Places

OURS = "stable float64"
RIVAL = "lambdify cse"


@dataclass(frozen=True)
class Row:
    """A stage, what came out of it in words, and the place."""

    stage: str
    outcome: str
    where: str


def rows(outcome: Outcome, places: Places) -> list[Row]:
    """One row a stage, and one for each statement that is false in print."""
    steps = sum(len(derivation.steps) for derivation in outcome.derived)
    wrong = [row for row in outcome.evidence if row.verdict == "refuted"]

    def where(paths: tuple[Path, ...]) -> str:
        return " ".join(places.shown(path) for path in paths)

    return [
        Row("derived", f"{len(outcome.derived)} derivations, {steps} steps", "rodproof derive"),
        Row("checked", show.totals(outcome.evidence), "rodproof check"),
        *(Row("refuted", f"{row.id} ({row.label})", f"rodproof check {row.id}") for row in wrong),
        Row("generated", f"{len(outcome.generated)} files", where(outcome.generated)),
        Row("documented", f"{len(outcome.documents)} files", where(outcome.documents)),
        Row("measured", _measured(places), where(outcome.reports)),
    ]


def _measured(places: Places) -> str:
    measured = records.load(places.measurement(quick=True))
    ours = [error for error in measured.errors if error.form == OURS]
    failures = sum(error.failures for error in ours)
    points = sum(error.points for error in ours)
    beyond = [error.beyond for error in ours if error.beyond is not None]
    blocks = [
        time
        for time in measured.times
        if time.form == RIVAL and time.points == measured.settings.timed_points
    ]
    ratios = [time.ratio for time in blocks]
    return (
        f"{OURS}: {failures} of {points} answers missing, at most {max(beyond, default=0):.1f} "
        f"ulps beyond what the inputs explain; {RIVAL} takes {min(ratios):.2g} to "
        f"{max(ratios):.2g} times as long"
    )
