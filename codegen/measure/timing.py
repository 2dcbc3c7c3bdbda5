"""Time per point, side by side: every form in every round, the median of the rounds."""

from __future__ import annotations

import gc
from collections.abc import Callable, Sequence
from statistics import median
from time import perf_counter_ns

import numpy as np

from rodproof.codegen.measure.errors import SIDES
from rodproof.codegen.measure.inputs import batches
from rodproof.codegen.measure.records import TimeRow, finite
from rodproof.codegen.measure.rivals import Form

#: Points for a form that loops over them in Python.
FEW = 16
#: A call shorter than this is repeated until it is not.
SHORTEST_NS = 200_000


def times(
    function: str, forms: Sequence[Form], points: int, rounds: int, seed: int
) -> list[TimeRow]:
    """One row per form, on a block of ordinary points."""
    calls = [_bound(form, function, points, seed) for form in forms]
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
        TimeRow(function, form.name, points, finite(ns) or 0.0, finite(ns / middles[0]) or 0.0)
        for form, ns in zip(forms, middles, strict=True)
    ]


def _bound(form: Form, function: str, points: int, seed: int) -> tuple[Callable[[], object], int]:
    size = min(points, FEW) if function in form.by_point else points
    (batch,) = batches("ordinary", SIDES[function], np.float64, seed, 1, size)
    first, second = batch.first.astype(form.dtype), batch.second.astype(form.dtype)
    law = form.bind(function, batch.constants)
    return (lambda: law(first, second)), size


def _repeats(call: Callable[[], object]) -> int:
    call()  # warm
    return max(1, round(SHORTEST_NS / max(_clock(call, 1), 1.0)))


def _clock(call: Callable[[], object], count: int) -> float:
    start = perf_counter_ns()
    for _ in range(count):
        call()
    return (perf_counter_ns() - start) / count
