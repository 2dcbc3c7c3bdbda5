"""The far end of a rod, known by two routes that share neither equations nor method.

What is proven is that they agree: `bound` is how far they are apart. An error in either, a wrong
sign, a wrong law, a step too long, would part them; rods on which they differ have no reference.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rodproof.codegen.measure.integrators import extrapolation, taylor
from rodproof.codegen.measure.integrators.precision import End, TooLong, digits
from rodproof.codegen.measure.integrators.problems import Problem

#: The routes must agree to this: well below what a double can show.
AGREEMENT = 1e-17
#: More steps than any rod of the grid needs that an integrator can follow.
STEPS = 8000


@dataclass(frozen=True)
class Reference:
    """r in the unit of length and the directors d_1, d_2, d_3 one after the other, as doubles.

    bound: how far the two routes are apart, in r over max(length, |r|) and in the entries of the
    frame; None, with the reason in ``why``, where there is no reference.
    """

    problem: str
    r: tuple[float, ...]
    frame: tuple[float, ...]
    bound: float | None
    steps: tuple[int, ...]
    why: str = ""


def reference(problem: Problem) -> Reference:
    """Both routes, compared; the quicker one first, as it finds out what is out of reach."""
    try:
        second = extrapolation.end(problem, STEPS)
        first = taylor.end(problem, STEPS)
    except TooLong as error:
        return Reference(problem.name, (), (), None, (), str(error))
    return compared(problem, first, second)


def compared(problem: Problem, first: End, second: End) -> Reference:
    """The reference of two ends, if they agree."""
    with digits(taylor.DIGITS):
        size = max(problem.length, *(abs(float(a.mid())) for a in first.r))
        bound = max(_apart(first.r, second.r) / size, _apart(first.frame, second.frame))
    steps = (first.steps, second.steps)
    if not bound <= AGREEMENT:
        return Reference(problem.name, (), (), None, steps, f"the routes differ by {bound:.1e}")
    r, frame = (tuple(float(a.mid()) for a in part) for part in (first.r, first.frame))
    return Reference(problem.name, r, frame, float(f"{bound:.1e}"), steps)


def _apart(first: tuple[Any, ...], second: tuple[Any, ...]) -> float:
    return max(abs(float((a - b).mid())) for a, b in zip(first, second, strict=True))
