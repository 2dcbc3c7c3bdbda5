"""What both routes of the reference share: numbers of many digits, and what they hand over."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import flint


class TooLong(ArithmeticError):
    """The reference would take more steps than it may."""


@dataclass(frozen=True)
class End:
    """The far end of a rod: place r, the directors d_1, d_2, d_3 one after the other, steps."""

    r: tuple[Any, ...]
    frame: tuple[Any, ...]
    steps: int


def pace(name: str, steps: int, done: float, most: int) -> None:
    """Raises TooLong where the end is out of reach: after ``most`` steps, or far sooner."""
    if steps >= most or (steps >= 60 and steps > 1.5 * most * done):
        raise TooLong(f"{name}: {most} steps do not reach the end")


@contextmanager
def digits(count: int, order: int = 10) -> Iterator[None]:
    """Arb numbers of so many digits and series of so many terms, and back to what was before."""
    context = flint.ctx
    before = context.prec, context.cap
    context.dps, context.cap = count, order
    try:
        yield
    finally:
        context.prec, context.cap = before


def middle(value: Any) -> Any:
    """The number without its ball: over many steps balls grow beyond all bounds, errors do not."""
    return flint.arb(value).mid()
