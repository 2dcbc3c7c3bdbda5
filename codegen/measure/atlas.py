"""The stability atlas: what ours and the textbook's form do at every spot of every map.

An answer's mark is its error beyond what is inherent, in ulps of the precision; or that the form
refused, that it gave no number, or that no number of the precision could hold the answer. Where
rounding took a strain past the limit, refusing is right and a number is wrong; where it lies so
close that an ulp of the inputs decides, refusing is right too.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median

import numpy as np

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import records
from rodproof.codegen.measure.errors import RIGHT, Truth, truth
from rodproof.codegen.measure.extremes import Outcome, outcomes
from rodproof.codegen.measure.form import Answer, answers
from rodproof.codegen.measure.inputs import inside
from rodproof.codegen.measure.records import Machine, finite
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.spots import DTYPES, MAPS, Spot, axes, named, spots
from rodproof.codegen.measure.store import Store, digest, kept
from rodproof.codegen.measure.subjects import Subject, subject, subjects
from rodproof.derivations import workers

Tell = Callable[[str, int, int], None]

#: A mark that is not a number: nan, infinity or no answer; a refusal that is right; nothing that
#: a number of the precision could hold.
NO_NUMBER, REFUSED, NOTHING = "nan", "refused", "-"
Mark = float | str
OURS = {"float64": "stable float64", "float32": "stable float32"}
BOOK = "textbook"


@dataclass(frozen=True)
class Look:
    """A spot with what happens there: the truth (None past the limit) and the answers' marks."""

    spot: Spot
    truth: Truth | None
    ours: Answer
    textbook: Answer

    @property
    def mark(self) -> Mark:
        return self._mark(self.ours)

    @property
    def book_mark(self) -> Mark:
        return self._mark(self.textbook)

    def _mark(self, answer: Answer) -> Mark:
        if answer is None and (self.truth is None or self.truth.at_edge):
            return REFUSED
        if self.truth is None:
            return NO_NUMBER
        if not self.truth.representable:
            return NOTHING
        error = self.truth.error(answer)
        if not math.isfinite(error):
            return NO_NUMBER
        return 0.0 if self.truth.at_edge else self.truth.beyond(error)

    @property
    def wrong(self) -> bool:
        """Whether ours breaks its promise here."""
        return rank(self.mark) > RIGHT


def look(spot: Spot) -> Look:
    """What happens at a spot; the textbook's form is tried in doubles only."""
    one, point = subject(spot.scene), spot.point
    of_strains = one.side(spot.function) == "strains"
    whole = np.concatenate([point.first, point.second])[:, 0]
    exact = None
    if not of_strains or inside(point.constants, whole):
        exact = truth(one, spot.function, point, 0, spot.dtype)
    with np.errstate(all="ignore"):
        (ours,) = answers(form_of(OURS[spot.precision]), one, spot.function, point)
        book: Answer = None
        if spot.precision == "float64":
            (book,) = answers(form_of(BOOK), one, spot.function, point)
    return Look(spot, exact, ours, book)


@dataclass(frozen=True)
class Settings:
    """Every ``coarse``-th place of a map, with so many choices of what it leaves open."""

    quick: bool
    coarse: int
    choices: int


@dataclass(frozen=True)
class Summary:
    """A function in one precision: how often ours is right, and the worst that it does.

    ``spots`` were looked at; at ``refused`` of them there is no answer, and ours refuses; at
    ``beyond_range`` of them no number of the precision could hold it. ``worst`` (None if it is no
    number) and ``median`` are of the rest, beyond what is inherent. ``wrong`` spots break the
    promise, ``book_wrong`` those of the textbook's form. The worst spot's name finds it again:
    ``rodproof measure --replay NAME``.
    """

    scene: str
    function: str
    precision: str
    spots: int
    refused: int
    beyond_range: int
    wrong: int
    worst: float | None
    median: float | None
    worst_spot: str
    constants: tuple[float, ...]
    point: tuple[float, ...]
    book_wrong: int | None


@dataclass(frozen=True)
class Chart:
    """A map in doubles: rows of the worst mark at each place, for the textbook's form and ours."""

    scene: str
    function: str
    chart: str
    across: str
    up: str
    columns: tuple[str, ...]
    rows: tuple[str, ...]
    textbook: list[list[Mark]]
    ours: list[list[Mark]]


@dataclass(frozen=True)
class Atlas:
    """All of it, as stored."""

    machine: Machine
    settings: Settings
    scenes: dict[str, str]
    summaries: tuple[Summary, ...]
    charts: tuple[Chart, ...]
    cases: tuple[Outcome, ...]


def settings(*, quick: bool) -> Settings:
    """What a quick look and the whole atlas ask for."""
    return Settings(quick, coarse=3, choices=1) if quick else Settings(quick, coarse=1, choices=2)


def measure_function(
    scene: str, function: str, precision: str, asked: Settings
) -> tuple[Summary, list[Chart]]:
    """The summary of a function in a precision, and its maps if that is the double one."""
    one = subject(scene)
    places = spots(one, function, precision, coarse=asked.coarse, choices=asked.choices)
    looks = [look(spot) for spot in places]
    charts = [_chart(one, function, chart, looks) for chart in MAPS if precision == "float64"]
    return _summary(one, function, precision, looks), charts


def _summary(one: Subject, function: str, precision: str, looks: Sequence[Look]) -> Summary:
    marks = [look.mark for look in looks]
    worst = max(looks, key=lambda look: rank(look.mark))
    numbers = [mark for mark in marks if isinstance(mark, float)]
    book = None
    if precision == "float64":
        book = sum(rank(look.book_mark) > RIGHT for look in looks)
    point = worst.spot.point
    return Summary(
        scene=one.name,
        function=function,
        precision=precision,
        spots=len(looks),
        refused=marks.count(REFUSED),
        beyond_range=marks.count(NOTHING),
        wrong=sum(look.wrong for look in looks),
        worst=finite(worst.mark) if isinstance(worst.mark, float) else None,
        median=finite(median(numbers)) if numbers else None,
        worst_spot=worst.spot.name,
        constants=point.constants,
        point=tuple(float(x) for x in (*point.first[:, 0], *point.second[:, 0])),
        book_wrong=book,
    )


def rank(mark: Mark) -> float:
    """Marks in order of badness."""
    if isinstance(mark, float):
        return mark
    return {NOTHING: -2.0, REFUSED: -1.0}.get(mark, math.inf)


def _chart(one: Subject, function: str, chart: str, looks: Sequence[Look]) -> Chart:
    across, up = axes(one, function, "float64", chart)
    here = [look for look in looks if look.spot.chart == chart]
    columns = sorted({look.spot.column for look in here})
    rows = sorted({look.spot.row for look in here})

    def worst(row: int, column: int, marks: Callable[[Look], Mark]) -> Mark:
        at = [m for m in here if (m.spot.row, m.spot.column) == (row, column)]
        return _stored(max((marks(m) for m in at), key=rank))

    return Chart(
        one.name,
        function,
        chart,
        across.name,
        up.name,
        tuple(across.labels[k] for k in columns),
        tuple(up.labels[k] for k in rows),
        [[worst(r, c, lambda m: m.book_mark) for c in columns] for r in rows],
        [[worst(r, c, lambda m: m.mark) for c in columns] for r in rows],
    )


def _stored(mark: Mark) -> Mark:
    """A mark as it goes into the file."""
    return float(f"{mark:.2g}") if isinstance(mark, float) else mark


def measure(
    path: Path,
    asked: Settings,
    tell: Tell,
    *,
    chosen: Sequence[Subject] | None = None,
    jobs: int = 1,
    scheduler: str | None = None,
    executor: Executor | None = None,
) -> Atlas:
    """The atlas of every function of every scene (or of those chosen), stored at ``path``.

    Goes on where a run was broken off. jobs, scheduler, executor: as in `workers.run`.
    """
    wanted = subjects() if chosen is None else tuple(chosen)
    store = Store(path.with_suffix(".cells"))
    code = workers.fingerprint()
    keys = {
        (one.name, function, precision): digest(
            "atlas", one.name, function, precision, asdict(asked), code
        )
        for one in wanted
        for function in one.functions
        for precision in DTYPES
    }
    missing = [cell for cell, key in keys.items() if key not in store]
    done = len(keys) - len(missing)
    tell(kept(done), done, len(keys))
    tasks = [workers.Task(".".join(cell), measure_function, (*cell, asked)) for cell in missing]
    for index, (summary, charts) in workers.run(
        tasks, jobs=jobs, scheduler=scheduler, executor=executor
    ):
        store.add(keys[missing[index]], [asdict(summary), [asdict(chart) for chart in charts]])
        done += 1
        tell(tasks[index].name, done, len(keys))
    found = [store[key] for key in keys.values()]
    atlas = Atlas(
        records.this_machine(),
        asked,
        {one.name: one.digest for one in wanted},
        tuple(_summary_of(summary) for summary, _ in found),
        tuple(_chart_of(chart) for _, charts in found for chart in charts),
        outcomes(),
    )
    save(atlas, path)
    store.forget()
    return atlas


def _summary_of(record: dict[str, object]) -> Summary:
    known = {**record, "constants": tuple(record["constants"]), "point": tuple(record["point"])}  # type: ignore[arg-type]
    return Summary(**known)  # type: ignore[arg-type]


def _chart_of(record: dict[str, object]) -> Chart:
    known = {**record, "columns": tuple(record["columns"]), "rows": tuple(record["rows"])}  # type: ignore[arg-type]
    return Chart(**known)  # type: ignore[arg-type]


def save(atlas: Atlas, path: Path) -> None:
    """Store as JSON, one summary or map a line."""
    parts = [
        f'"machine": {json.dumps(asdict(atlas.machine))}',
        f'"settings": {json.dumps(asdict(atlas.settings))}',
        f'"scenes": {json.dumps(atlas.scenes)}',
        records.table_text("summaries", Summary, atlas.summaries),
        records.table_text("charts", Chart, atlas.charts),
        records.table_text("cases", Outcome, atlas.cases),
    ]
    write_text(path, "{\n" + ",\n".join(parts) + "\n}\n")


def load(path: Path) -> Atlas:
    """Read what ``save`` wrote; a ValueError says which file is not an atlas."""
    record = records.read(path, "stability atlas", "rodproof measure --atlas")
    try:
        return Atlas(
            Machine(**record["machine"]),
            Settings(**record["settings"]),
            record["scenes"],
            tuple(map(_summary_of, _records(record["summaries"]))),
            tuple(map(_chart_of, _records(record["charts"]))),
            records.rows_of(Outcome, record["cases"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise ValueError(f"{path}: not a stability atlas of rodproof ({error!r})") from None


def _records(entry: dict[str, list[list[object]]]) -> list[dict[str, object]]:
    return [dict(zip(entry["columns"], row, strict=True)) for row in entry["rows"]]  # type: ignore[arg-type]


def replay(name: str) -> Look:
    """The spot of that name, looked at again."""
    return look(named(name))
