"""The cells of a measurement: what is computed, stored and lost in one piece.

An error cell is a scene's function on one kind of input in one precision: the truth at its points
is computed once, and every form of that precision is held against it. A time cell is a scene's
function with all its forms side by side, on blocks or on a single point.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from importlib.metadata import version

import numpy as np

from rodproof.codegen.measure.errors import RIGHT, Truth, truth
from rodproof.codegen.measure.inputs import Batch, Kind, batches, kinds
from rodproof.codegen.measure.records import ErrorRow, Settings, TimeRow, finite
from rodproof.codegen.measure.rivals import Form, all_forms, answers, form_of
from rodproof.codegen.measure.subjects import Subject, subject
from rodproof.codegen.measure.timing import times

LIBRARIES = ("numpy", "sympy", "mpmath", "python-flint")


@dataclass(frozen=True)
class ErrorCell:
    """Errors of some forms, all of one precision, of a function on one kind of input."""

    scene: str
    function: str
    forms: tuple[str, ...]
    kind: Kind

    @property
    def name(self) -> str:
        return f"{self.scene}.{self.function}, {self.kind}"


@dataclass(frozen=True)
class TimeCell:
    """Times of some forms of a function on blocks of so many points."""

    scene: str
    function: str
    forms: tuple[str, ...]
    points: int

    @property
    def name(self) -> str:
        block = "one point" if self.points == 1 else "blocks"
        return f"{self.scene}.{self.function}, {block}"


Cell = ErrorCell | TimeCell


def key(cell: Cell, settings: Settings) -> str:
    """All that decides the cell's result: what is asked, the module's text, the libraries."""
    what = {"kind": type(cell).__name__} | asdict(cell)
    versions = [version(library) for library in LIBRARIES]
    parts = [what, asdict(settings), subject(cell.scene).digest, versions]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()


def chosen(forms: Sequence[Form], scene: str, settings: Settings) -> tuple[Form, ...]:
    """The forms that a scene is measured with: in a hurry the full rod alone with all of them."""
    whole = not settings.quick or scene == "full_rod"
    return tuple(form for form in forms if whole or form.quick)


def error_cells(subjects: Sequence[Subject], settings: Settings) -> list[ErrorCell]:
    """Every error cell, those of a function together."""
    return [
        ErrorCell(one.name, function, tuple(names), kind)
        for one in subjects
        for function in one.functions
        for names in _by_precision(chosen(all_forms(), one.name, settings))
        for kind in kinds(one)
    ]


def time_cells(subjects: Sequence[Subject], settings: Settings) -> list[TimeCell]:
    """Every time cell."""
    return [
        TimeCell(
            one.name,
            function,
            tuple(form.name for form in chosen(all_forms(), one.name, settings)),
            points,
        )
        for one in subjects
        for function in one.functions
        for points in (settings.timed_points, 1)
    ]


def _by_precision(forms: Sequence[Form]) -> list[list[str]]:
    found: dict[type[np.floating], list[str]] = {}
    for form in forms:
        found.setdefault(form.dtype, []).append(form.name)
    return list(found.values())


def measure_errors(cell: ErrorCell, settings: Settings) -> list[ErrorRow]:
    """A row per form of the cell."""
    one, forms = subject(cell.scene), [form_of(name) for name in cell.forms]
    dtype = forms[0].dtype
    drawn = batches(
        one, cell.function, cell.kind, dtype, settings.seed, settings.batches, settings.points
    )
    truths = [
        [truth(one, cell.function, batch, index, dtype) for index in range(batch.size)]
        for batch in drawn
    ]
    with np.errstate(all="ignore"):  # what the rivals do wrong is counted, not warned about
        return [_row(cell, form, drawn, truths) for form in forms]


def _row(
    cell: ErrorCell, form: Form, drawn: Sequence[Batch], truths: Sequence[Sequence[Truth]]
) -> ErrorRow:
    """What a form does on the sample, at the points whose answer the precision can hold."""
    one = subject(cell.scene)
    pairs = [
        (exact, exact.error(answer))
        for batch, exacts in zip(drawn, truths, strict=True)
        for answer, exact in zip(answers(form, one, cell.function, batch), exacts, strict=True)
        if exact.representable
    ]
    error = np.array([error for _, error in pairs])
    beyond = np.array([exact.beyond(error) for exact, error in pairs])
    held = error[np.isfinite(error)]
    to_double = float(np.finfo(form.dtype).eps / np.finfo(np.float64).eps)
    return ErrorRow(
        scene=cell.scene,
        function=cell.function,
        form=form.name,
        sample=cell.kind,
        points=len(pairs),
        failures=len(pairs) - len(held),
        worst=finite(float(held.max()) * to_double) if held.size else None,
        median=finite(float(np.median(error)) * to_double),
        beyond=finite(float(beyond.max())),
        over_eight=int(np.sum(beyond > RIGHT)),
    )


def measure_times(cell: TimeCell, settings: Settings) -> list[TimeRow]:
    """A row per form of the cell; to be run alone on the machine."""
    forms = [form_of(name) for name in cell.forms]
    with np.errstate(all="ignore"):
        return times(
            subject(cell.scene),
            cell.function,
            forms,
            cell.points,
            settings.rounds,
            settings.seed,
        )
