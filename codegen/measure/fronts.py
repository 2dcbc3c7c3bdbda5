"""Error against time: the marks of the forms of a function, what nothing beats, and the winners."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from rodproof.codegen.measure.records import ErrorRow, Measurement
from rodproof.codegen.measure.rivals import form_of

#: Above every error: no number, or a refusal.
NO_NUMBER = 1e18
#: Errors that a reader may be content with, in ulps of a double: all digits, twelve, ten, six.
WANTED = (8.0, 1e3, 1e6, 1e10)

Inputs = Literal["ordinary", "all"]


@dataclass(frozen=True)
class Mark:
    """A form: time per point in ns, worst and median error in ulps of a double.

    On ordinary inputs that is the error; on all of them the error beyond what is inherent.
    """

    form: str
    time: float
    worst: float
    median: float


def marks(measurement: Measurement, scene: str, function: str, inputs: Inputs) -> list[Mark]:
    """What is known of each form, in the order of the report."""
    found = []
    for form in measurement.forms:
        time = measurement.time(scene, function, form, measurement.settings.timed_points)
        samples = ("ordinary",) if inputs == "ordinary" else measurement.samples(scene)
        rows = [measurement.error(scene, function, form, sample) for sample in samples]
        known = [row for row in rows if row]
        if time and known:
            median = known[0].median
            worst = max(_worst(row, inputs) for row in known)
            found.append(
                Mark(form, time.nanoseconds, worst, NO_NUMBER if median is None else median)
            )
    return found


def _worst(row: ErrorRow, inputs: Inputs) -> float:
    if row.failures:
        return NO_NUMBER
    if inputs == "ordinary":
        return NO_NUMBER if row.worst is None else row.worst
    to_double = np.finfo(form_of(row.form).dtype).eps / np.finfo(float).eps
    return NO_NUMBER if row.beyond is None else row.beyond * float(to_double)


def front(found: list[Mark]) -> list[Mark]:
    """The marks that no other beats in both time and worst error, fastest first."""
    best: list[Mark] = []
    for mark in sorted(found, key=lambda mark: (mark.time, mark.worst)):
        if not best or mark.worst < best[-1].worst:
            best.append(mark)
    return best


def winner(found: list[Mark], wanted: float, *, plain: bool = False) -> Mark | None:
    """The cheapest form whose worst error is at most ``wanted``; None if there is none.

    plain: of those that need no compiler and no other library.
    """
    good = [mark for mark in found if mark.worst <= wanted]
    good = [mark for mark in good if not plain or not form_of(mark.form).needs]
    return min(good, key=lambda mark: mark.time, default=None)
