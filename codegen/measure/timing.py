"""Time per point, side by side: every form in every round, the median of the rounds."""

from __future__ import annotations

import gc
from collections.abc import Callable, Mapping, Sequence
from statistics import median
from time import perf_counter_ns

import numpy as np

from rodproof.codegen.measure.form import Code, Form
from rodproof.codegen.measure.inputs import Batch, batches
from rodproof.codegen.measure.records import TimeRow, finite
from rodproof.codegen.measure.subjects import Subject

#: Points for a form that loops over them in Python.
FEW = 8
#: Different points of a block; the time of a block does not depend on how many there are.
DRAWN = 32
#: A call shorter than this is repeated until it is not.
SHORTEST_NS = 200_000
#: A call that takes longer meets caches of its own making anyway.
WARMED_NS = 10_000_000
#: What takes longer than this is timed in the first rounds alone.
SLOW_NS, SLOW_ROUNDS = 500_000_000, 3


def times(
    subject: Subject, function: str, forms: Sequence[Form], points: int, rounds: int, seed: int
) -> list[TimeRow]:
    """One row per form, on a block of ordinary points or on a single one.

    A form that cannot be had (its errors say why) has none.
    """
    (drawn,) = batches(subject, function, "ordinary", np.float64, seed, 1, DRAWN)
    code = Code(subject, function)
    bound = {form.name: _bound(form, code, points, drawn) for form in forms}
    calls = {name: found[0] for name, found in bound.items() if found}
    sizes = {name: found[1] for name, found in bound.items() if found}
    ns = {name: total / sizes[name] for name, total in medians(calls, rounds, SHORTEST_NS).items()}
    base = next(iter(ns.values()))
    return [
        TimeRow(
            subject.name,
            function,
            name,
            points,
            finite(own) or 0.0,
            finite(own / base) or 0.0,
        )
        for name, own in ns.items()
    ]


def _bound(
    form: Form, code: Code, points: int, drawn: Batch
) -> tuple[Callable[[], object], int] | None:
    size = min(points, FEW) if form.loops(code) else points
    first, second = (
        np.tile(rows, -(-size // DRAWN))[:, :size].astype(form.dtype)
        for rows in (drawn.first, drawn.second)
    )
    try:
        law = form.bind(code, drawn.constants)
        given = form.prepare(code, first, second, points == 1)
        law(*given)  # warm
    except Exception:
        if form.needs:
            return None
        raise
    return (lambda: law(*given)), size


def medians(
    calls: Mapping[str, Callable[[], object]], rounds: int, shortest: float
) -> dict[str, float]:
    """Nanoseconds of each call, which has run before: each in every round, the median of them.

    shortest: a call that takes less is repeated within its turn. What is quick runs once untimed
    before its turn, since those before it have left their own data in the caches; what is slow
    runs in the first rounds alone.
    """
    once = {name: min(clock(call, 1), clock(call, 1)) for name, call in calls.items()}
    repeats = {name: max(1, round(shortest / ns)) for name, ns in once.items()}
    samples: dict[str, list[float]] = {name: [] for name in calls}
    gc.collect()
    gc.disable()
    try:
        for turn in range(rounds):
            for name, call in calls.items():
                if once[name] > SLOW_NS and turn >= SLOW_ROUNDS:
                    continue
                if once[name] < WARMED_NS:
                    call()
                samples[name].append(clock(call, repeats[name]))
    finally:
        gc.enable()
    return {name: median(found) for name, found in samples.items()}


def clock(call: Callable[[], object], count: int) -> float:
    """Nanoseconds of a call, run so many times; at least one."""
    start = perf_counter_ns()
    for _ in range(count):
        call()
    return max((perf_counter_ns() - start) / count, 1.0)
