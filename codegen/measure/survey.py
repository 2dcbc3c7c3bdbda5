"""A whole measurement: errors over every sample and times, one function after the other.

After each function what is known is stored beside the target; a run that was broken off goes on
from there as long as settings, machine and generated code are the same.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from rodproof.codegen.measure import records
from rodproof.codegen.measure.errors import SIDES, Truth, truth
from rodproof.codegen.measure.inputs import KINDS, Batch, Kind, batches
from rodproof.codegen.measure.records import FUNCTIONS, ErrorRow, Measurement, Settings, finite
from rodproof.codegen.measure.rivals import Form, all_forms, answers
from rodproof.codegen.measure.timing import times
from rodproof.generated.scenes import full_rod

Tell = Callable[[str, int, int], None]

SEED = 20240607


def settings(*, quick: bool) -> Settings:
    """What a quick look and a full measurement ask for."""
    digest = hashlib.sha256(Path(full_rod.__file__).read_bytes()).hexdigest()[:16]
    if quick:
        return Settings(
            SEED, True, batches=10, points=10, rounds=7, timed_points=4096, digest=digest
        )
    return Settings(SEED, False, batches=50, points=20, rounds=25, timed_points=4096, digest=digest)


def measure(path: Path, asked: Settings, tell: Tell) -> Measurement:
    """Measure every function and store the result at ``path``."""
    forms = all_forms()
    partial = path.with_suffix(".partial.json")
    measured = resumed(partial, asked, forms)
    with np.errstate(all="ignore"):  # what the rivals do wrong is counted, not warned about
        for index, function in enumerate(FUNCTIONS):
            tell(function, index, len(FUNCTIONS))
            if function not in measured.done():
                measured = measured.extended(
                    errors(function, forms, asked),
                    [
                        row
                        for points in (asked.timed_points, 1)
                        for row in times(function, forms, points, asked.rounds, asked.seed)
                    ],
                )
                records.save(measured, partial)
    tell("done", len(FUNCTIONS), len(FUNCTIONS))
    partial.replace(path)
    return measured


def resumed(partial: Path, asked: Settings, forms: Sequence[Form]) -> Measurement:
    """What a run that was broken off left, if it is of this kind; else an empty measurement."""
    fresh = Measurement(records.this_machine(), asked, {form.name: form.words for form in forms})
    if not partial.exists():
        return fresh
    known = records.load(partial)
    same = (known.machine, known.settings, known.forms) == (fresh.machine, asked, fresh.forms)
    return known if same else fresh


def errors(function: str, forms: Sequence[Form], asked: Settings) -> list[ErrorRow]:
    """One row per sample and form."""
    rows = []
    for kind in KINDS:
        for dtype in dict.fromkeys(form.dtype for form in forms):
            sample = _sample(function, kind, dtype, asked)
            rows += [sample.row(form) for form in forms if form.dtype is dtype]
    return rows


@dataclass(frozen=True)
class _Sample:
    """The batches of one kind and precision, and the truth at their points."""

    function: str
    kind: Kind
    batches: tuple[Batch, ...]
    truths: tuple[tuple[Truth, ...], ...]

    def row(self, form: Form) -> ErrorRow:
        """What a form does on the sample, at the points whose answer the precision can hold."""
        pairs = [
            (exact.error(answer), exact.inherent)
            for batch, exacts in zip(self.batches, self.truths, strict=True)
            for answer, exact in zip(answers(form, self.function, batch), exacts, strict=True)
            if exact.representable
        ]
        error, inherent = np.array(pairs).T
        beyond = np.maximum(error - inherent, 0.0)
        finite_errors = error[np.isfinite(error)]
        to_double = float(np.finfo(form.dtype).eps / np.finfo(np.float64).eps)
        return ErrorRow(
            function=self.function,
            form=form.name,
            sample=self.kind,
            points=len(pairs),
            failures=len(pairs) - len(finite_errors),
            worst=finite(float(finite_errors.max()) * to_double) if finite_errors.size else None,
            median=finite(float(np.median(error)) * to_double),
            beyond=finite(float(beyond.max())),
            over_eight=int(np.sum(beyond > 8)),
            inherent=finite(float(inherent.max())),
        )


def _sample(function: str, kind: Kind, dtype: type[np.floating], asked: Settings) -> _Sample:
    drawn = batches(kind, SIDES[function], dtype, asked.seed, asked.batches, asked.points)
    truths = tuple(
        tuple(truth(function, batch, index, dtype) for index in range(batch.size))
        for batch in drawn
    )
    return _Sample(function, kind, drawn, truths)
