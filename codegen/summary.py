"""The last table of ``rodproof run``: what came out of each stage, and where it lies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rodproof.codegen import show
from rodproof.codegen.measure import records
from rodproof.codegen.measure.form import ENERGIES
from rodproof.codegen.pipeline import Outcome
from rodproof.codegen.places import Places

OURS = "stable float64"
RIVAL = "lambdify cse"


PICTURES = (".svg", ".png")


@dataclass(frozen=True)
class Row:
    """A stage, what came out of it in words, and the place."""

    stage: str
    outcome: str
    where: str


def rows(outcome: Outcome, places: Places) -> list[Row]:
    """A row or more for each stage; every statement that is false in print has its own."""
    steps = sum(len(derivation.steps) for derivation in outcome.derived)
    wrong = [row for row in outcome.evidence if row.verdict == "refuted"]
    modules = [path for path in outcome.generated if path.name != "__init__.py"]
    return [
        Row("derived", f"{len(outcome.derived)} derivations in {steps} steps", "rodproof derive"),
        Row("checked", show.totals(outcome.evidence), "rodproof check"),
        *(Row("refuted", row.claim, f"rodproof check {row.id}") for row in wrong),
        *(Row("generated", path.stem, places.shown(path)) for path in modules),
        *(Row("documented", _document(path), places.shown(path)) for path in outcome.documents),
        *_measured(places, outcome.reports),
        *_drawn(places, outcome.reports),
    ]


def _document(path: Path) -> str:
    """A document's name; that of a site is its folder's."""
    return path.parent.name if path.stem == "index" else path.stem


def _drawn(places: Places, reports: tuple[Path, ...]) -> list[Row]:
    """A row a picture, whatever formats it is in."""
    files: dict[str, list[str]] = {}
    for path in reports:
        if path.suffix in PICTURES:
            files.setdefault(path.stem, []).append(places.shown(path))
    return [Row("drawn", stem, " ".join(paths)) for stem, paths in files.items()]


def _measured(places: Places, reports: tuple[Path, ...]) -> list[Row]:
    data, page, picture, *_ = (places.shown(path) for path in reports)
    measured = records.load(places.measurement(quick=True))
    ours = [error for error in measured.errors if error.form == OURS]
    failures = sum(error.failures for error in ours)
    beyond = max((error.beyond for error in ours if error.beyond is not None), default=0.0)
    points = measured.settings.timed_points
    ratios = [  # not of the energies, which are mpmath's there
        time.ratio
        for time in measured.times
        if time.form == RIVAL and time.points == points and time.function not in ENERGIES
    ]
    faster = f"{RIVAL} takes {min(ratios):.2g} to {max(ratios):.2g} times as long, energies apart"
    return [
        Row("measured", f"{OURS}: {failures} of {sum(e.points for e in ours)} answers fail", data),
        Row("measured", f"at most {beyond:.1f} ulps beyond what the inputs explain", page),
        Row("measured", faster, picture),
    ]
