"""Rows of scratch: lines that do the same to one row after another become one, and do the same."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodproof.codegen.targets.calls import Call
from rodproof.codegen.targets.rows import Line, joined, print_calls

LENGTHS = {"a": 3, "b": 3, "s": 4}
#: An operand that is the same for every line of a run, or goes on with it from a row.
fixed = st.sampled_from(["k", "-c.k", "root", "a[1]"]).map(lambda text: (text, None))
going = st.tuples(st.sampled_from([*LENGTHS]), st.integers(0, 2))
runs = st.tuples(
    st.sampled_from(["np.multiply", "np.add", "np.subtract"]),
    going,
    st.tuples(st.one_of(fixed, going), going),
    st.integers(1, 3),
    st.sampled_from([1, 1, -1]),
)


def lines_of(function: str, to: tuple, operands: tuple, count: int, turn: int) -> list[Line]:
    """Lines from row to row, as far as the arrays reach; operands in turn, or the same way."""

    def at(place: tuple, k: int) -> str:
        return place[0] if place[1] is None else f"{place[0]}[{place[1] + k}]"

    ends = [LENGTHS[array] - first for array, first in (to, *operands) if first is not None]
    return [
        Line(function, tuple(at(o, k) for o in operands[:: turn**k]), at(to, k))
        for k in range(min(count, *ends))
    ]


def after(text: list[str]) -> dict[str, np.ndarray]:
    """The arrays after the text, from the same start."""
    rng = np.random.default_rng(5)
    known = {name: rng.integers(-9, 9, (n, 5)).astype(float) for name, n in LENGTHS.items()}
    known["root"] = rng.integers(-9, 9, 5).astype(float)
    record = type("Record", (), {"k": 2.0})
    with np.errstate(all="ignore"):
        exec("\n".join(text), {"np": np, "k": 3.0, "c": record, **known})
    return known


@given(st.lists(runs, max_size=5))
def test_joined_lines_do_the_same(found: list[tuple]) -> None:
    """Whatever overlaps, to the bit."""
    steps = [line for run in found for line in lines_of(*run)]
    spelt = [f"{s.to}[:] = {s.function}({', '.join(s.operands)})" for s in steps]
    want, got = after(spelt), after([line.text for line in joined(steps, LENGTHS)])
    for name in want:
        np.testing.assert_array_equal(got[name], want[name])


def multiply(to: str, *operands: str) -> Line:
    return Line("np.multiply", operands, to)


@pytest.mark.parametrize(
    ("steps", "text"),
    [
        (
            [("a[0]", "b[0]", "s[0]"), ("a[1]", "s[1]", "b[1]")],
            "np.multiply(b[:2], s[:2], out=a[:2])",
        ),
        ([(f"a[{k}]", "k", f"b[{k}]") for k in range(3)], "np.multiply(k, b, out=a)"),
        ([(f"a[{k}]", f"a[{k}]", "root") for k in range(3)], "a *= root"),
        ([("s[2]", "root", "s[2]"), ("s[3]", "root", "s[3]")], "s[2:] *= root"),
    ],
)
def test_runs_of_rows_are_one_line(steps: list[tuple[str, ...]], text: str) -> None:
    assert [line.text for line in joined([multiply(*step) for step in steps], LENGTHS)] == [text]


@pytest.mark.parametrize(
    "steps",
    [
        [("a[1]", "k", "a[0]"), ("a[2]", "k", "a[1]")],  # the second reads what the first wrote
        [("a[0]", "k", "b[0]"), ("a[2]", "k", "b[2]")],  # a row between them
        [("a[0]", "k", "b[0]"), ("a[1]", "c.k", "b[1]")],  # another constant
        [("a[0]", "k", "root"), ("a[0]", "k", "root")],  # twice the same
    ],
)
def test_other_lines_stay_apart(steps: list[tuple[str, ...]]) -> None:
    assert len(joined([multiply(*step) for step in steps], LENGTHS)) == 2


def test_a_row_is_handed_on_after_its_last_use() -> None:
    """Rows that are taken are not given out; three slots, one after another, need one row."""
    chain = [("one", "k", "a"), ("two", "k", "one"), ("three", "k", "two")]
    steps = [Call(to, "np.multiply", (k, of), frozenset({of})) for to, k, of in chain]
    printed = print_calls(steps, {}, places={"a": "a[0]"}, lengths=LENGTHS, taken={0, 1})
    assert printed.rows == 3
    assert printed.lines[-1] == "three = np.multiply(k, two, out=s[2])"
