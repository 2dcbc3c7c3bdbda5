"""The comparison with peers: they answer what ours does, and those that do not are named."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from rodproof.codegen.measure import peer_c, peers, timing, variants
from rodproof.codegen.measure.form import Code, Form, blocks, rows
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject


def _tell(name: str, done: int, total: int) -> None:
    """Nobody watches."""


FEW = ("stable float64", "C", "C exp/log", "lambdify cse")


def test_every_case_is_timed_and_stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peers, "peers", lambda: tuple(map(form_of, FEW)))
    monkeypatch.setattr(peers, "FUNCTIONS", ("strains", "loads"))
    found = peers.compare((1, 40), 3, _tell)
    here = ["stable float64", "lambdify cse"] + ["C", "C exp/log"] * bool(peer_c.compiler())
    assert set(found.peers) == set(here)
    cases = len(here) * 2 - ("C exp/log" in here)  # which is for general p alone
    assert len(found.times) == cases * len(peers.FUNCTIONS) * 2
    assert all(t.ratio == 1 for t in found.times if t.peer == peers.REFERENCE)
    assert set(found.missing) == {"C", "C exp/log"} - set(here)
    peers.save(found, tmp_path / "peers.json")
    stored = json.loads((tmp_path / "peers.json").read_text())
    assert len(stored["times"]) == len(found.times)
    columns, rows = peers.table(found)
    assert len(rows) == len(found.times)
    assert all(len(row) == len(columns) for row in rows)


def test_a_peer_that_fails_or_answers_something_else_is_named() -> None:
    def absent(code: Code, values: tuple[float, ...]) -> object:
        raise ImportError("no module named absent")

    def wrong(code: Code, values: tuple[float, ...]) -> object:
        return lambda first, second: (first + 1, second + 1)

    ours = form_of("stable float64")
    entries = (ours, Form("absent", "", absent, blocks), Form("wrong", "", wrong, blocks))
    missing: dict[str, str] = {}
    given = peers.task("strains", 2.0, 5)
    times = list(peers._case(given, entries, 3, missing))
    assert [t.peer for t in times] == ["stable float64"]
    assert missing["absent"] == "ImportError: no module named absent"
    assert "off by" in missing["wrong, strains"]


@pytest.mark.skipif(peer_c.compiler() is None, reason="no C compiler is installed")
@pytest.mark.parametrize("power", [peer_c.SQUARE, peer_c.EXP_LOG, peer_c.POW])
def test_the_c_kernel_writes_every_row(power: int, tmp_path: Path) -> None:
    """Symmetric, and the derivative of the loads."""
    given = peers.task("loads_and_stiffness", 2.0, 9)
    library, (first, second) = peer_c.build(power, tmp_path), (given.first, given.second)
    outs, more = (
        (np.zeros((3, 9)), np.zeros((3, 9)), np.zeros((6, 6, 9))) for _ in ("here", "moved")
    )
    k = np.array([0.49, 1.21, 0.81, 2.56, -0.4, 2.3, 2.0])
    peer_c.bound(library, given.function, (first, second, k, *outs), 9)()
    stiff = outs[2].copy()
    assert np.array_equal(stiff, stiff.transpose(1, 0, 2))
    step = 1e-6
    moved = first.copy()
    moved[1] += step
    peer_c.bound(library, given.function, (moved, second, k, *more), 9)()
    change = np.concatenate([more[0] - outs[0], more[1] - outs[1]]) / step
    np.testing.assert_allclose(change, stiff[:, 1], atol=1e-4)


@pytest.mark.skipif(peer_c.compiler() is None, reason="no C compiler is installed")
def test_loading_the_kernel_leaves_subnormals_alone(tmp_path: Path) -> None:
    peer_c.build(peer_c.EXP_LOG, tmp_path)
    assert (np.array([1e-310]) * 1.0)[0] == 1e-310


@pytest.mark.parametrize("p", peers.SCENES)
@pytest.mark.parametrize("function", peers.FUNCTIONS)
def test_ours_in_other_dress_has_the_same_numbers(function: str, p: float) -> None:
    """Without a guard in its text, and with components last."""
    given = peers.task(function, p, 7)
    code = Code(subject(peers.SCENES[p]), function, given.values)
    want = rows(peers._call(form_of("stable float64"), code, given)(), 7)
    for form in variants.forms():
        got = rows(peers._call(form, code, given)(), 7)
        np.testing.assert_allclose(got, want, rtol=1e-13, atol=1e-15 * np.abs(want).max())
    bare = vars(variants._module(variants.BARE, code, given.values))
    assert not {"_balanced", "_within_limit", f"_{function}_plain"} & set(bare)


def test_quick_calls_are_warmed_and_slow_ones_run_less(monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[str] = []
    calls = {name: partial(ran.append, name) for name in ("quick", "slow")}
    takes = {"quick": 10.0, "slow": 2.0 * timing.SLOW_NS}

    def clock(call: partial, count: int) -> float:
        call()
        return takes[ran[-1]]

    monkeypatch.setattr(timing, "clock", clock)
    assert timing.medians(calls, 7, 1) == takes
    assert ran.count("quick") == 2 + 2 * 7
    assert ran.count("slow") == 2 + timing.SLOW_ROUNDS
