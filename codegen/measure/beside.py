"""The functions of a scene timed beside the full rod's, here and now: for `rodproof scenes NAME`.

One measurement for a reader, not for the record: that is `rodproof measure`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rodproof.codegen.measure.form import Code
from rodproof.codegen.measure.inputs import batches
from rodproof.codegen.measure.records import finite
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject
from rodproof.codegen.measure.survey import SEED
from rodproof.codegen.measure.timing import DRAWN, medians
from rodproof.codegen.show import Tell

POINTS, ROUNDS = 10_000, 7
SHORTEST_NS = 100_000
FULL = "full_rod"
NOTE = (
    f"ns a point: on this machine, now; blocks of {POINTS} ordinary points, one thread, results "
    f"reused, median of\n{ROUNDS} interleaved rounds (`rodproof measure` is for the record)."
)


@dataclass(frozen=True)
class Beside:
    """Nanoseconds a point of a scene's function, and of the full rod's."""

    function: str
    own: float
    full: float


def beside(name: str, tell: Tell, *, points: int = POINTS, rounds: int = ROUNDS) -> list[Beside]:
    """Every function of a committed scene; the full rod has its constants, and more of them."""
    functions = subject(name).functions
    found = []
    with np.errstate(all="ignore"):
        for done, function in enumerate(functions):
            tell(function, done, len(functions))
            calls = {of: _call(of, function, points) for of in (name, FULL)}
            ns = medians(calls, rounds, SHORTEST_NS)
            own, full = (finite(ns[of] / points) or 0.0 for of in (name, FULL))
            found.append(Beside(function, own, full))
    tell("", len(functions), len(functions))
    return found


def data(times: Sequence[Beside]) -> dict[str, Any]:
    """The same for JSON, with what it was measured on."""
    functions = [asdict(time) for time in times]
    return {"points": POINTS, "rounds": ROUNDS, "functions": functions}


def _call(scene: str, function: str, points: int) -> Callable[[], object]:
    """The function over the points that `rodproof measure` takes its times at, run once."""
    one, form = subject(scene), form_of("stable float64")
    (drawn,) = batches(one, function, "ordinary", np.float64, SEED, 1, DRAWN)
    first, second = (
        np.tile(rows, -(-points // DRAWN))[:, :points] for rows in (drawn.first, drawn.second)
    )
    code = Code(one, function)
    law, given = form.bind(code, drawn.constants), form.prepare(code, first, second, False)
    law(*given)
    return lambda: law(*given)
