"""Gives the slots of calls their rows of scratch, and prints the calls.

A row is an array as long as a block of points, ``s[k]`` in the text. A slot keeps its row until it
is read for the last time, and then hands it on, first of all to what that last call makes: the
fewer rows, the more of them stay in the cache.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from rodproof.codegen.targets.calls import Call

OPERATORS = {
    "np.add": "+=",
    "np.subtract": "-=",
    "np.multiply": "*=",
    "np.divide": "/=",
}


@dataclass(frozen=True)
class Printed:
    """The lines, the row of each slot that keeps one, and how many rows are in use at most."""

    lines: tuple[str, ...]
    row: Mapping[str, int]
    rows: int


def print_calls(
    calls: Sequence[Call],
    held: Mapping[str, int],
    *,
    places: Mapping[str, str] | None = None,
    fixed: Mapping[str, int] | None = None,
    kept: Collection[str] = (),
    opened: Collection[str] = (),
) -> Printed:
    """The text of calls.

    ``held`` are the rows taken at the start; ``places`` are slots that are no names, but entries
    of arrays; ``fixed`` are the rows that slots must have; slots in ``kept`` are not given up;
    those in ``opened`` have a value at the start.
    """
    printing = _Printing(calls, dict(held), places or {}, fixed or {}, frozenset(kept))
    printing.opened |= set(opened)
    lines = [line for at in range(len(calls)) for line in printing.line(at)]
    return Printed(tuple(lines), printing.row, printing.rows)


def last_reads(calls: Sequence[Call]) -> dict[str, int]:
    """Where each slot is read for the last time."""
    return {slot: at for at, call in enumerate(calls) for slot in call.reads}


class _Printing:
    """The row of each slot, and the rows that are free, the last one used last."""

    def __init__(
        self,
        calls: Sequence[Call],
        held: dict[str, int],
        places: Mapping[str, str],
        fixed: Mapping[str, int],
        kept: frozenset[str],
    ) -> None:
        self.calls, self.row, self.places, self.fixed = calls, held, places, fixed
        self.last = last_reads(calls) | {slot: len(calls) for slot in kept}
        self.rows = max((k + 1 for k in (*held.values(), *fixed.values())), default=0)
        taken = {*held.values(), *fixed.values()}
        self.free = [k for k in reversed(range(self.rows)) if k not in taken]
        self.opened: set[str] = set()
        self.inline: dict[str, str] = {}

    def line(self, at: int) -> list[str]:
        """The line of a call; none if it is written inside the next one."""
        call = self.calls[at]
        if not call.to:
            return self.verbatim(call, at)
        opening = call.to not in self.opened
        self.opened.add(call.to)
        operands = [self.text(operand) for operand in call.operands]
        dying = [s for s in sorted(call.reads) if self.last[s] == at and s != call.to]
        freed = [self.row.pop(s) for s in dying if s in self.row]
        freed = [k for k in freed if k not in self.fixed.values()]
        if opening:
            self.open(call, freed)
        self.free += [k for k in freed if k not in self.row.values()]
        text = self.printed(call, operands, opening)
        if "." in call.to and opening and self.last[call.to] == at + 1:
            following = self.calls[at + 1]
            self.inline |= {call.to: text} if following.to != call.to else {}
            return [] if call.to in self.inline else [text]
        return [text]

    def verbatim(self, call: Call, at: int) -> list[str]:
        """Lines as they are."""
        dying = [s for s in sorted(call.reads) if self.last[s] == at and s in self.row]
        self.free += [k for k in (self.row.pop(s) for s in dying) if k not in self.fixed.values()]
        return list(call.operands)

    def open(self, call: Call, freed: list[int]) -> None:
        """A row for the slot: its own, one that this call gives up, a free one, or a new one.

        What is taken over may live in the row that it was read from, and keeps that.
        """
        if call.to in self.fixed:
            self.row[call.to] = self.fixed[call.to]
        elif call.to in self.places:
            return
        elif freed:
            self.row[call.to] = freed[0]
        elif call.function:
            if not self.free:
                self.free.append(self.rows)
                self.rows += 1
            self.row[call.to] = self.free.pop()

    def printed(self, call: Call, operands: list[str], opening: bool) -> str:
        name, place = self.text(call.to), self.place(call.to)
        named = opening and name != place
        if not call.function:
            return f"{name} = {operands[0]}" if named else f"{place}[...] = {operands[0]}"
        if not opening and operands[0] == name and call.function in OPERATORS:
            return f"{name} {OPERATORS[call.function]} {operands[1]}"
        text = f"{call.function}({', '.join(operands)}, out={place if opening else name})"
        return f"{name} = {text}" if named else text

    def place(self, slot: str) -> str:
        return self.places[slot] if slot in self.places else f"s[{self.row.get(slot)}]"

    def text(self, slot: str) -> str:
        """A slot as an operand: its name, its place, or the call that makes it."""
        if slot in self.inline:
            return self.inline.pop(slot)
        known = slot in self.places or ("." in slot and slot in self.row)
        return self.place(slot) if known else slot
