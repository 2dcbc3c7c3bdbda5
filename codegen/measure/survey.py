"""A whole measurement: the errors of all cells on workers, then the times alone on the machine.

What is finished is kept beside the target, by scene, forms and version; a run that was broken off
loses at most the cell it was at, and the next one goes on from there. The errors of peers are
computed here, after the workers are gone: what is compiled for them is compiled once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rodproof.codegen.measure import cells, records
from rodproof.codegen.measure.records import ErrorRow, Measurement, Missing, Settings, TimeRow
from rodproof.codegen.measure.rivals import all_forms
from rodproof.codegen.measure.store import Store, kept
from rodproof.codegen.measure.subjects import Subject, subjects
from rodproof.derivations import workers

Tell = Callable[[str, int, int], None]

SEED = 20240607


def settings(*, quick: bool) -> Settings:
    """What a quick look and a full measurement ask for."""
    if quick:
        return Settings(SEED, True, batches=3, points=3, rounds=7, timed_points=4096)
    return Settings(SEED, False, batches=20, points=6, rounds=11, timed_points=4096)


def measure(
    path: Path,
    asked: Settings,
    tell: Tell,
    *,
    chosen: Sequence[Subject] | None = None,
    jobs: int = 1,
    scheduler: str | None = None,
    executor: Executor | None = None,
) -> Measurement:
    """Measure every function of every scene (or of those chosen), and store it at ``path``.

    jobs, scheduler, executor: who computes the errors, as in `workers.run`. Times are always taken
    here, one after the other, when nobody works for us any more.
    """
    wanted = subjects() if chosen is None else tuple(chosen)
    store = Store(path.with_suffix(".cells"))
    errors = {cell: cells.key(cell, asked) for cell in cells.error_cells(wanted, asked)}
    clocks = {cell: cells.key(cell, asked) for cell in cells.time_cells(wanted, asked)}
    total = len(errors) + len(clocks)
    done = sum(key in store for key in (*errors.values(), *clocks.values()))
    tell(kept(done), done, total)
    todo = [cell for cell, key in errors.items() if key not in store]
    spread = [cell for cell in todo if not cell.of_peers]
    tasks = [workers.Task(cell.name, cells.measure_errors, (cell, asked)) for cell in spread]
    for index, rows in workers.run(tasks, jobs=jobs, scheduler=scheduler, executor=executor):
        store.add(errors[spread[index]], [asdict(row) for row in rows])
        done += 1
        tell(spread[index].name, done, total)
    for cell in todo:
        if cell.of_peers:
            store.add(errors[cell], [asdict(row) for row in cells.measure_errors(cell, asked)])
            done += 1
            tell(f"peers of {cell.name}", done, total)
    for clock, key in clocks.items():
        if key not in store:
            store.add(key, [asdict(row) for row in cells.measure_times(clock, asked)])
            done += 1
            tell(f"time of {clock.name}", done, total)
    found = [row for key in errors.values() for row in store[key]]
    times = tuple(TimeRow(**row) for key in clocks.values() for row in store[key])
    measured = _measurement(asked, wanted, found, times)
    records.save(measured, path)
    store.forget()
    return measured


def _measurement(
    asked: Settings,
    wanted: Sequence[Subject],
    found: Sequence[dict[str, Any]],
    times: tuple[TimeRow, ...],
) -> Measurement:
    """All that was found; a peer that failed in every kind of input is named once."""
    errors = tuple(ErrorRow(**row) for row in found if "why" not in row)
    failed = dict.fromkeys(Missing(**row) for row in found if "why" in row)
    known = {row.form for row in errors}
    return Measurement(
        records.this_machine(),
        asked,
        {form.name: form.words for form in all_forms() if form.name in known},
        {one.name: one.digest for one in wanted},
        errors,
        times,
        (*cells.missing(asked), *failed),
    )
