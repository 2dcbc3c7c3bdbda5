"""Time per point, side by side: every form in every round, the median of the rounds."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from statistics import median
from time import perf_counter_ns

import numpy as np

from rodproof.codegen.measure.inputs import Batch, batches
from rodproof.codegen.measure.records import TimeRow, finite
from rodproof.codegen.measure.rivals import Form
from rodproof.codegen.measure.subjects import Subject

#: Points for a form that loops over them in Python.
FEW = 8
#: Different points of a block; the time of a block does not depend on how many there are.
DRAWN = 32
#: A call shorter than this is repeated until it is not.
SHORTEST_NS = 200_000


def times(
    subject: Subject, function: str, forms: Sequence[Form], points: int, rounds: int, seed: int
) -> list[TimeRow]:
    """One row per form, on a block of ordinary points or on a single one."""
    (drawn,) = batches(subject, function, "ordinary", np.float64, seed, 1, DRAWN)
    calls = [_bound(form, subject, function, points, drawn) for form in forms]
    repeats = [_repeats(call) for call, _ in calls]
    rows: list[list[float]] = [[] for _ in forms]
    gc.collect()
    gc.disable()
    try:
        for _ in range(rounds):
            for samples, (call, size), count in zip(rows, calls, repeats, strict=True):
                samples.append(_clock(call, count) / size)
    finally:
        gc.enable()
    middles = [median(samples) for samples in rows]
    return [
        TimeRow(
            subject.name,
            function,
            form.name,
            points,
            finite(ns) or 0.0,
            finite(ns / middles[0]) or 0.0,
        )
        for form, ns in zip(forms, middles, strict=True)
    ]


def _bound(
    form: Form, subject: Subject, function: str, points: int, drawn: Batch
) -> tuple[Callable[[], object], int]:
    size = min(points, FEW) if form.loops(subject, function) else points
    first, second = (
        np.tile(rows, -(-size // DRAWN))[:, :size].astype(form.dtype)
        for rows in (drawn.first, drawn.second)
    )
    law = form.bind(subject, function, drawn.constants)
    given = form.prepare(subject, function, first, second, points == 1)
    return (lambda: law(*given)), size


def _repeats(call: Callable[[], object]) -> int:
    call()  # warm
    return max(1, round(SHORTEST_NS / max(_clock(call, 1), 1.0)))


def _clock(call: Callable[[], object], count: int) -> float:
    start = perf_counter_ns()
    for _ in range(count):
        call()
    return (perf_counter_ns() - start) / count
