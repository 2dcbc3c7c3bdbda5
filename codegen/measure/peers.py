"""Run time beside what else a user could take: C, lambdify, numexpr, numba, JAX and others.

Every peer computes the same function of the same points, components first, and where it is made
of expressions the constants are numbers in them, which suits it best. One call a round, the peers
of a round one after the other; the median of the rounds counts. Those that are not installed are
named as missing, and so is what a peer fails at.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import compiled, records, variants
from rodproof.codegen.measure.form import Code, Form, rows
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject
from rodproof.codegen.measure.timing import medians
from rodproof.codegen.show import Tell

Array = np.ndarray[Any, np.dtype[Any]]
FUNCTIONS = compiled.BY_HAND
CONSTANTS = (0.7, 1.1, 0.9, 1.6, -0.4, 2.3)  # alpha, beta, zeta, eta, iota, gamma
SCENES = {3.3: compiled.FULL, 2.0: compiled.SQUARE}
REFERENCE = "C"
SHORTEST_NS = 100_000
APART = 1e-10  # relative to the largest component: a peer that is further off did something else


@dataclass(frozen=True)
class Task:
    """A function at points: three rows of inputs, three more, and the constants."""

    function: str
    p: float
    first: Array
    second: Array

    @property
    def points(self) -> int:
        return int(self.first.shape[1])

    @property
    def values(self) -> tuple[float, ...]:
        return (*CONSTANTS, self.p)


@dataclass(frozen=True)
class PeerTime:
    """Nanoseconds a point, and the ratio to the C kernel (to the first peer without a compiler)."""

    function: str
    p: float
    points: int
    peer: str
    nanoseconds: float
    ratio: float


@dataclass(frozen=True)
class Comparison:
    """What was measured, on what, and what was not measured for which reason."""

    machine: records.Machine
    rounds: int
    peers: dict[str, str]
    missing: dict[str, str]
    times: tuple[PeerTime, ...]


def peers() -> tuple[Form, ...]:
    """In the order of a round; the first answers are the ones to agree with."""
    usual = map(form_of, ("stable float64", "lambdify", "lambdify cse"))
    return (*usual, *variants.forms(), *compiled.forms())


def compare(points: tuple[int, ...], rounds: int, tell: Tell) -> Comparison:
    """Measure every peer that is there."""
    here, missing = [], {}
    for form in peers():
        why = compiled.missing(form)
        if why is None:
            here.append(form)
        else:
            missing[form.name] = why
    times: list[PeerTime] = []
    cases = [(f, p, n) for n in points for p in SCENES for f in FUNCTIONS]
    with np.errstate(all="ignore"):
        for done, (function, p, n) in enumerate(cases):
            tell(f"{function}, p = {p:g}, {n} points", done, len(cases))
            times += _case(task(function, p, n), here, rounds, missing)
    tell("done", len(cases), len(cases))
    measured = {row.peer for row in times}
    words = {form.name: form.words for form in here if form.name in measured}
    return Comparison(records.this_machine(), rounds, words, missing, tuple(times))


def task(function: str, p: float, points: int) -> Task:
    """Ordinary points inside the domain, and inside the ranges of the form without guards."""
    rng = np.random.default_rng(11)
    first, second = rng.uniform(-variants.REACH, variants.REACH, (2, 3, points))
    first[0] = np.maximum(np.abs(first[0]), variants.LEAST)
    second[2] += 0.0 if function == "strains" else 1.0
    return Task(function, p, first, second)


def _case(
    given: Task, forms: Sequence[Form], rounds: int, missing: dict[str, str]
) -> Iterator[PeerTime]:
    """The times of one function, for the peers that answer as ours does."""
    code = Code(subject(SCENES[given.p]), given.function, given.values)
    calls: dict[str, Callable[[], Any]] = {}
    want: Array | None = None
    for form in forms:
        if not form.can(code):
            continue
        try:
            call = _call(form, code, given)
            got = rows(call(), given.points)
        except Exception as error:  # whatever a peer fails with, the others go on
            missing.setdefault(form.name, compiled.sentence(error))
            continue
        want = got if want is None else want
        off = np.abs(got - want).max() / np.abs(want).max()
        if not off < APART:
            missing[f"{form.name}, {given.function}"] = f"off by {off:.1e} of the largest component"
        else:
            calls[form.name] = call
    found = medians(calls, rounds, SHORTEST_NS)
    base = found[REFERENCE if REFERENCE in found else next(iter(found))]
    for name, total in found.items():
        ns, ratio = records.finite(total / given.points), records.finite(total / base)
        yield PeerTime(given.function, given.p, given.points, name, ns or 0.0, ratio or 0.0)


def _call(form: Form, code: Code, given: Task) -> Callable[[], Any]:
    law = form.bind(code, given.values)
    arguments = form.prepare(code, given.first, given.second, given.points == 1)
    return lambda: law(*arguments)


def save(found: Comparison, path: Path) -> None:
    """Store as JSON, one time a line."""
    record = asdict(found)
    keys = ("machine", "rounds", "peers", "missing")
    lines = [f'"{key}": {json.dumps(record[key])}' for key in keys]
    rows = ",\n".join("  " + json.dumps(row) for row in record["times"])
    write_text(path, "{\n" + ",\n".join([*lines, f'"times": [\n{rows}\n]']) + "\n}\n")


def table(found: Comparison) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """Columns and rows for the terminal: ns a point and the ratio to C, a row a peer."""
    cases = list(dict.fromkeys((t.function, t.p, t.points) for t in found.times))
    cells = {(t.peer, t.function, t.p, t.points): t for t in found.times}
    rows: list[tuple[str, ...]] = []
    for function, power, points in cases:
        for name in found.peers:
            t = cells.get((name, function, power, points))
            if t:
                ns, ratio = f"{t.nanoseconds:.1f}", f"{t.ratio:.2f}"
                rows.append((function, f"{power:g}", str(points), name, ns, ratio))
    return ("function", "p", "points", "peer", "ns a point", "to C"), rows
