"""The cells of a measurement: what is computed, stored and lost in one piece.

An error cell is a scene's function on one kind of input in one precision: the truth at its points
is computed once, and every form of that precision is held against it; the peers, which a worker
may not have, have cells of their own. A time cell is a scene's function with all its forms side by
side, on blocks or on a single point.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass

import numpy as np

from rodproof.codegen.measure import compiled
from rodproof.codegen.measure.errors import RIGHT, Truth, truth
from rodproof.codegen.measure.form import Code, Form, answers
from rodproof.codegen.measure.inputs import Batch, Kind, batches, kinds
from rodproof.codegen.measure.records import ErrorRow, Missing, Settings, TimeRow, finite
from rodproof.codegen.measure.rivals import all_forms, form_of
from rodproof.codegen.measure.store import digest
from rodproof.codegen.measure.subjects import Subject, subject
from rodproof.codegen.measure.timing import times

LIBRARIES = ("numpy", "sympy", "mpmath", "python-flint")
#: Where every form is measured on every function. Elsewhere the peers have the law alone: they
#: would be compiled for minutes.
WHOLE = ("full_rod", "full_rod_p2")
LAW = ("strains", "loads", "stiffness", "loads_and_stiffness")


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

    @property
    def of_peers(self) -> bool:
        """Whether it is computed here, where the peers are."""
        return any(form_of(form).needs for form in self.forms)


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
    one = subject(cell.scene)
    needs = [need for form in cell.forms for need in form_of(form).needs]
    versions = [compiled.version(library) for library in LIBRARIES]
    peers = compiled.versions(Code(one, cell.function), needs)
    return digest(what, asdict(settings), one.digest, versions, peers)


def chosen(scene: str, function: str, settings: Settings) -> tuple[Form, ...]:
    """The forms that a function is measured with, of those that are here.

    In a hurry without the peers, and the full rod alone with all the others.
    """
    code = Code(subject(scene), function)
    return tuple(form for form in all_forms() if _wanted(form, code, settings))


def _wanted(form: Form, code: Code, settings: Settings) -> bool:
    scene = code.subject.name
    if not form.needs:
        return form.quick or not settings.quick or scene == "full_rod"
    asked = not settings.quick and (scene in WHOLE or code.function in LAW)
    return asked and form.can(code) and compiled.missing(form) is None


def missing(settings: Settings) -> tuple[Missing, ...]:
    """The forms that were asked for and are not here."""
    found = ((form.name, compiled.missing(form)) for form in all_forms() if not settings.quick)
    return tuple(Missing(name, "", why) for name, why in found if why)


def error_cells(subjects: Sequence[Subject], settings: Settings) -> list[ErrorCell]:
    """Every error cell, those of a function together."""
    return [
        ErrorCell(one.name, function, tuple(names), kind)
        for one in subjects
        for function in one.functions
        for names in _groups(chosen(one.name, function, settings))
        for kind in kinds(one)
    ]


def time_cells(subjects: Sequence[Subject], settings: Settings) -> list[TimeCell]:
    """Every time cell."""
    return [
        TimeCell(
            one.name,
            function,
            tuple(form.name for form in chosen(one.name, function, settings)),
            points,
        )
        for one in subjects
        for function in one.functions
        for points in (settings.timed_points, 1)
    ]


def _groups(forms: Sequence[Form]) -> list[list[str]]:
    """By precision, the peers apart."""
    found: dict[tuple[type[np.floating], bool], list[str]] = {}
    for form in forms:
        found.setdefault((form.dtype, bool(form.needs)), []).append(form.name)
    return list(found.values())


def measure_errors(cell: ErrorCell, settings: Settings) -> list[ErrorRow | Missing]:
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
        return [_row_or_why(cell, form, drawn, truths) for form in forms]


def _row_or_why(
    cell: ErrorCell, form: Form, drawn: Sequence[Batch], truths: Sequence[Sequence[Truth]]
) -> ErrorRow | Missing:
    try:
        return _row(cell, form, drawn, truths)
    except Exception as error:  # whatever a peer fails with, the others go on
        if not form.needs:
            raise
        return Missing(form.name, f"{cell.scene}.{cell.function}", compiled.sentence(error))


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
