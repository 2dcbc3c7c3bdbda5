"""A whole study: the references first, on any workers; then the runs, alone, as they are timed.

What is known is kept beside the target, reference by reference and cell by cell (one rod, one form
of the equations, one method): a study that was broken off loses one cell at most.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, astuple
from pathlib import Path

from rodproof.codegen.measure.integrators import records
from rodproof.codegen.measure.integrators.problems import Problem
from rodproof.codegen.measure.integrators.records import Settings, Study
from rodproof.codegen.measure.integrators.reference import reference
from rodproof.codegen.measure.integrators.runs import EQUATIONS, METHODS, Run, runs
from rodproof.codegen.measure.store import Store, kept
from rodproof.derivations import workers

Tell = Callable[[str, int, int], None]


def measure(
    path: Path,
    asked: Settings,
    tell: Tell,
    *,
    chosen: tuple[Problem, ...] | None = None,
    jobs: int = 1,
    scheduler: str | None = None,
) -> Study:
    """Study these rods (all if none is named) and store the result at ``path``.

    jobs, scheduler: who computes the references, as in `workers.run`.
    """
    rods = records.rods(asked) if chosen is None else chosen
    store = Store(path.with_suffix(".cells"))
    ends = {rod: records.key(asked, "reference", rod.name) for rod in rods}
    cells = {
        (rod, name, method): records.key(asked, rod.name, name, method)
        for rod in rods
        for name in EQUATIONS
        for method in METHODS
    }
    done = sum(key in store for key in (*ends.values(), *cells.values()))
    clock = _Clock(tell, len(ends) + len(cells), done)
    missing = [rod for rod, key in ends.items() if key not in store]
    tasks = [workers.Task(rod.name, reference, (rod,)) for rod in missing]
    clock.tell(kept(done) or "references")
    for index, known in workers.run(tasks, jobs=jobs, scheduler=scheduler):
        store.add(ends[missing[index]], asdict(known))
        clock.done(missing[index].name)
    references = {rod: records.reference_of(store[key]) for rod, key in ends.items()}
    for (rod, name, method), key in cells.items():
        if key in store:
            continue
        clock.tell(f"{rod.name}, {name}, {method}")
        found = runs(rod, name, method, references[rod], asked.tolerances, asked.budget)
        store.add(key, [astuple(run) for run in found])
        clock.done(rod.name)
    study = Study(
        asked,
        rods,
        tuple(references.values()),
        tuple(Run(*row) for key in cells.values() for row in store[key]),
    )
    records.save(study, path)
    store.forget()
    clock.tell("done")
    return study


class _Clock:
    """Tells what is being done, how many of how many, and the time left at the pace so far."""

    def __init__(self, tell: Tell, total: int, kept: int) -> None:
        self._tell, self._total, self._kept, self._new = tell, total, kept, 0
        self._started = time.monotonic()

    def done(self, name: str) -> None:
        self._new += 1
        self.tell(name)

    def tell(self, name: str) -> None:
        finished = self._kept + self._new
        left = (self._total - finished) * (time.monotonic() - self._started) / max(self._new, 1)
        words = f"{name}; {left / 60:.0f} min left" if self._new and left else name
        self._tell(words, finished, self._total)
