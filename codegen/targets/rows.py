"""Gives the slots of calls their rows of scratch, and prints the calls.

A row is an array as long as a block of points, ``s[k]`` in the text. A slot keeps its row until it
is read for the last time, and then hands it on, first of all to what that last call makes: the
fewer rows, the more of them stay in the cache. Calls that do the same to rows which follow each
other in their arrays become one.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from rodproof.codegen.targets.calls import Call

OPERATORS = {
    "np.add": "+=",
    "np.subtract": "-=",
    "np.multiply": "*=",
    "np.divide": "/=",
}
COMMUTE = {"np.add", "np.multiply"}
ROW = re.compile(r"(\w+)\[(\d+)\]")
OPERAND = re.compile(r"-?[\w.]+(\[\d+\])?")


@dataclass(frozen=True)
class Printed:
    """The lines, the row of each slot that keeps one, and how many rows are in use at most."""

    lines: tuple[str, ...]
    row: Mapping[str, int]
    rows: int


@dataclass(frozen=True)
class Line:
    """``function(*operands)`` into ``to``, called ``name`` then if it has one; or a text."""

    function: str = ""
    operands: tuple[str, ...] = ()
    to: str = ""
    name: str = ""
    verbatim: str = ""

    @property
    def text(self) -> str:
        if not self.function:
            return self.verbatim
        operands = self.operands[::-1] if self.function in COMMUTE else self.operands
        for first, second in (self.operands, operands) if self.function in OPERATORS else ():
            if first == self.to and not self.name:
                return f"{self.to} {OPERATORS[self.function]} {second}"
        call = f"{self.function}({', '.join(self.operands)}, out={self.to})"
        return f"{self.name} = {call}" if self.name else call


def print_calls(
    calls: Sequence[Call],
    held: Mapping[str, int],
    *,
    places: Mapping[str, str],
    lengths: Mapping[str, int],
    taken: Collection[int] = (),
    kept: Collection[str] = (),
    opened: Collection[str] = (),
) -> Printed:
    """The text of calls.

    ``held`` are the rows that slots have at the start, and those ``taken`` are not for slots;
    ``places`` are slots that are no names, but rows or entries of arrays, whose ``lengths`` are
    given; slots in ``kept`` are not given up; those in ``opened`` have a value at the start.
    """
    printing = _Printing(calls, dict(held), places, taken, frozenset(kept))
    printing.opened |= set(opened)
    lines = [line for at in range(len(calls)) for line in printing.line(at)]
    text = tuple(line.text for line in joined(lines, lengths))
    return Printed(text, printing.row, printing.rows)


def joined(lines: Sequence[Line], lengths: Mapping[str, int]) -> list[Line]:
    """With runs of lines that do the same to one row after another in one."""
    done, run = list[Line](), list[Line]()
    for line in lines:
        fitting = next((way for way in _ways(line) if run and _joint([*run, way], lengths)), None)
        if run and fitting is None:
            done.append(_joint(run, lengths) or run[0])
            run = []
        run.append(fitting or line)
    return [*done, *(_joint(part, lengths) or part[0] for part in [run] if part)]


def _ways(line: Line) -> list[Line]:
    """The line, and with its operands in the other order where that is the same."""
    other = replace(line, operands=line.operands[::-1])
    return [line, other] if line.function in COMMUTE else [line]


def _joint(run: Sequence[Line], lengths: Mapping[str, int]) -> Line | None:
    """One line for all of them, if there is one."""
    first = run[0]
    if len(run) == 1:
        return first
    if any(line.name or not line.function or line.function != first.function for line in run):
        return None
    if any(line.to in later.operands for k, line in enumerate(run) for later in run[k + 1 :]):
        return None
    columns = [*zip(*((line.to, *line.operands) for line in run), strict=True)]
    to, *operands = (_span(texts, lengths) for texts in columns)
    several = [len({*texts}) > 1 for texts in columns]
    if None in (to, *operands) or not several[0] or not any(several[1:]):
        return None
    return Line(first.function, tuple(filter(None, operands)), to or "")


def _span(texts: Sequence[str], lengths: Mapping[str, int]) -> str | None:
    """Rows that follow each other in an array as its part; the same for all as it is."""
    if len(set(texts)) == 1:
        return texts[0] if OPERAND.fullmatch(texts[0]) else None
    found = [ROW.fullmatch(text) for text in texts]
    rows = [(m[1], int(m[2])) for m in found if m]
    array, first = rows[0] if rows else ("", 0)
    if rows != [(array, first + k) for k in range(len(texts))] or array not in lengths:
        return None
    end = first + len(texts)
    if (first, end) == (0, lengths[array]):
        return array
    return f"{array}[{first or ''}:{end if end < lengths[array] else ''}]"


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
        taken: Collection[int],
        kept: frozenset[str],
    ) -> None:
        self.calls, self.row, self.places = calls, held, places
        self.last = last_reads(calls) | {slot: len(calls) for slot in kept}
        used = {*held.values(), *taken}
        self.rows = max((k + 1 for k in used), default=0)
        self.free = [k for k in reversed(range(self.rows)) if k not in used]
        self.opened: set[str] = set()
        self.inline: dict[str, str] = {}

    def line(self, at: int) -> list[Line]:
        """The line of a call; none if it is written inside the next one."""
        call = self.calls[at]
        if not call.to:
            self.free += [self.row.pop(s) for s in self.dying(call, at) if s in self.row]
            return [Line(verbatim=text) for text in call.operands]
        opening = call.to not in self.opened
        self.opened.add(call.to)
        operands = tuple(self.text(operand) for operand in call.operands)
        freed = [self.row.pop(s) for s in self.dying(call, at) if s in self.row]
        if opening:
            self.open(call, freed)
        self.free += [k for k in freed if k not in self.row.values()]
        line = self.printed(call, operands, opening)
        once = "." in call.to and opening and self.last[call.to] == at + 1
        if once and self.calls[at + 1].to != call.to:
            self.inline[call.to] = line.text
            return []
        return [line]

    def dying(self, call: Call, at: int) -> list[str]:
        """The slots that are read for the last time."""
        return [s for s in sorted(call.reads) if self.last[s] == at and s != call.to]

    def open(self, call: Call, freed: list[int]) -> None:
        """A row for the slot: one that this call gives up, a free one, or a new one.

        What is taken over may live in the row that it was read from, and keeps that.
        """
        if call.to in self.places:
            return
        if freed:
            self.row[call.to] = freed[0]
        elif call.function:
            if not self.free:
                self.free.append(self.rows)
                self.rows += 1
            self.row[call.to] = self.free.pop()

    def printed(self, call: Call, operands: tuple[str, ...], opening: bool) -> Line:
        name, place = self.text(call.to), self.place(call.to)
        named = name if opening and name != place else ""
        if not call.function:
            left = named or f"{place}[...]"
            return Line(verbatim=f"{left} = {operands[0]}")
        return Line(call.function, operands, place if opening else name, named)

    def place(self, slot: str) -> str:
        return self.places[slot] if slot in self.places else f"s[{self.row.get(slot)}]"

    def text(self, slot: str) -> str:
        """A slot as an operand: its name, its place, or the call that makes it."""
        if slot in self.inline:
            return self.inline.pop(slot)
        known = slot in self.places or ("." in slot and slot in self.row)
        return self.place(slot) if known else slot
