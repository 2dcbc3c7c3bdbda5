"""The compiled peers: right where the derivation is, named where they are not to be had.

JAX computes in a process of its own: one that it has started threads in must not be forked any
more, and other tests do.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

from rodproof.codegen.measure import cells, compiled, form, peer_c, records, survey, table, timing
from rodproof.codegen.measure.form import Code, Form, NotHere
from rodproof.codegen.measure.inputs import batches
from rodproof.codegen.measure.records import ErrorRow, Missing, Settings
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject

WHOLE = Settings(20240607, False, batches=1, points=2, rounds=1, timed_points=8)
PEERS = compiled.forms()
PLACES = ("full_rod.strains", "full_rod_p2.loads_and_stiffness", "kirchhoff.loads")


def here(peer: Form, *more: str) -> object:
    """The peer as a parameter, skipped where it is missing."""
    why = compiled.missing(peer)
    mark = pytest.mark.skipif(why is not None, reason=str(why))
    return pytest.param(peer, *more, id="-".join((peer.name, *more)), marks=mark)


def can(peer: Form, where: str) -> bool:
    scene, function = where.split(".")
    return peer.can(Code(subject(scene), function))


@pytest.fixture(scope="module")
def apart() -> Iterator[Executor]:
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:
        yield executor


@pytest.mark.parametrize(
    ("peer", "where"), [here(peer, where) for where in PLACES for peer in PEERS if can(peer, where)]
)
def test_a_peer_answers_as_the_oracle(peer: Form, where: str, apart: Executor) -> None:
    scene, function = where.split(".")
    if peer.name == "numba cse" and "stiffness" in function:
        function = "loads"  # the matrix is compiled for many seconds
    cell = cells.ErrorCell(scene, function, (peer.name,), "ordinary")
    if peer.name == "jax":
        (row,) = apart.submit(cells.measure_errors, cell, WHOLE).result()
    else:
        (row,) = cells.measure_errors(cell, WHOLE)
    assert isinstance(row, ErrorRow), row
    assert row.points == 2
    assert row.failures == 0
    assert row.worst is not None
    assert row.worst < 1e6


@pytest.mark.parametrize("peer", [here(peer) for peer in PEERS if peer.name != "jax"])
def test_blocks_of_any_size_and_constants_of_any_kind(peer: Form) -> None:
    """A law that is built once answers other constants and other blocks, and numbers put in."""
    one = subject("full_rod")
    for batch in batches(one, "strains", "ordinary", np.float64, 1, 2, 5):
        for code in (Code(one, "strains"), Code(one, "strains", batch.constants)):
            for size in (5, 1):
                points = batch.first[:, :size], batch.second[:, :size]
                law = peer.bind(code, batch.constants)
                got = form.rows(law(*peer.prepare(code, *points, size == 1)), size)
                ours = form_of("stable float64")
                truth = ours.bind(code, batch.constants)
                want = form.rows(truth(*ours.prepare(code, *points, False)), size)
                np.testing.assert_allclose(got, want, rtol=1e-12, atol=1e-13)


def test_numbers_leave_no_constants() -> None:
    values = (0.7, 1.1, 0.9, 1.6, -0.4, 2.3, 3.3)
    code = Code(subject("full_rod"), "strains", values)
    assert code.constants == ()
    assert code.given(values) == ()
    for entry in code.components:
        assert entry.free_symbols <= set(code.rows)


def test_what_is_not_installed_is_named_and_not_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "find_spec", lambda name: None)
    monkeypatch.setattr(peer_c, "compiler", lambda *, plus=False: None)
    assert {form.name for form in cells.chosen("full_rod", "loads", WHOLE) if form.needs} == set()
    said = {row.form: row.why for row in cells.missing(WHOLE)}
    assert set(said) == {peer.name for peer in compiled.forms()}
    assert said["C"] == "needs a C compiler"
    assert said["jax"] == "jax is not installed: pip install 'rodproof[peers]'"
    assert cells.missing(replace(WHOLE, quick=True)) == ()


def test_in_a_hurry_there_are_no_peers() -> None:
    for scene in ("full_rod", "kirchhoff"):
        found = cells.chosen(scene, "strains", replace(WHOLE, quick=True))
        assert not [form.name for form in found if form.needs]


def test_each_peer_is_measured_where_it_can(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "missing", lambda form: None)
    peers = {peer.name for peer in compiled.forms()}

    def chosen(scene: str, function: str) -> set[str]:
        return {form.name for form in cells.chosen(scene, function, WHOLE)} & peers

    assert chosen("full_rod", "loads_and_stiffness") == peers
    assert chosen("full_rod_p2", "stiffness") == peers - {"C exp/log"}
    assert chosen("full_rod", "stored_energy") == {"stable numba"}  # no elementary form
    derived = {"numba cse", "numexpr", "jax", "casadi", "symforce"}
    assert chosen("full_rod", "compliance") == derived | {"stable numba"}
    assert chosen("dsdna", "loads") == derived
    assert chosen("dsdna", "compliance") == set()


def failing(error: Exception) -> Form:
    def bind(code: Code, values: tuple[float, ...]) -> form.Call:
        raise error

    return Form("broken", "", bind, form.blocks, needs=("numpy",))


def test_a_peer_that_fails_is_named_and_the_others_go_on(monkeypatch: pytest.MonkeyPatch) -> None:
    broken, ours = failing(TypeError("no such thing\nand more")), form_of("stable float64")
    named = {"broken": broken, "stable float64": ours}
    monkeypatch.setattr(cells, "form_of", named.__getitem__)
    cell = cells.ErrorCell("thrust", "strains", ("broken", "stable float64"), "ordinary")
    gone, row = cells.measure_errors(cell, WHOLE)
    assert gone == Missing("broken", "thrust.strains", "TypeError: no such thing")
    assert isinstance(row, ErrorRow)
    times = timing.times(subject("thrust"), "strains", [broken, ours], 8, 1, 1)
    assert [(time.form, time.ratio) for time in times] == [("stable float64", 1.0)]
    named["broken"] = replace(broken, needs=())  # one that is always there has no excuse
    with pytest.raises(TypeError, match="no such thing"):
        cells.measure_errors(cell, WHOLE)
    with pytest.raises(TypeError, match="no such thing"):
        timing.times(subject("thrust"), "strains", [named["broken"], ours], 8, 1, 1)


def test_a_peer_that_answers_something_else_is_far_off(monkeypatch: pytest.MonkeyPatch) -> None:
    def bind(code: Code, values: tuple[float, ...]) -> form.Call:
        law = form_of("textbook").bind(code, values)
        return lambda first, second: 1.001 * law(first, second)[0]

    wrong = Form("wrong", "", bind, form.blocks, needs=("numpy",))
    monkeypatch.setattr(cells, "form_of", {"wrong": wrong}.__getitem__)
    cell = cells.ErrorCell("full_rod", "loads", ("wrong",), "ordinary")
    (row,) = cells.measure_errors(cell, WHOLE)
    assert isinstance(row, ErrorRow)
    assert row.worst is not None
    assert row.worst > 1e11


def test_a_compiler_that_fails_says_so(tmp_path: Path) -> None:
    source = tmp_path / "law.c"
    source.write_text("this is no C\n")
    compiler = peer_c.compiler()
    if compiler is None:
        pytest.skip("no C compiler is installed")
    with pytest.raises(NotHere, match=r"law\.c"):
        compiled._shared(compiler, source)


def test_results_are_kept_by_the_peers_version(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compiled, "version", lambda need: "1.0")
    cell = cells.ErrorCell("thrust", "strains", ("jax",), "ordinary")
    usual = cells.ErrorCell("thrust", "strains", ("textbook",), "ordinary")
    before = [cells.key(one, WHOLE) for one in (cell, usual)]
    versions = {"jax": "1.1"}
    monkeypatch.setattr(compiled, "version", lambda need: versions.get(need, "1.0"))
    after = [cells.key(one, WHOLE) for one in (cell, usual)]
    assert before[0] != after[0]
    assert before[1] == after[1]


def test_peers_are_in_a_full_measurement(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Errors, times, words and what is missing, stored and on the page; goes on among the peers."""
    missing = compiled.missing
    derived = [peer for peer in compiled.forms() if peer.can(Code(subject("thrust"), "strains"))]
    if all(missing(peer) for peer in derived if peer.name != "jax"):
        pytest.skip("no peer is installed: pip install 'rodproof[peers]'")

    def without_jax(peer: Form) -> str | None:
        return "left out" if peer.name == "jax" else missing(peer)

    monkeypatch.setattr(compiled, "missing", without_jax)
    path = tmp_path / "measurement.json"
    told: list[tuple[int, int]] = []

    def tell(name: str, done: int, total: int) -> None:
        told.append((done, total))
        if name == broken_off:
            raise KeyboardInterrupt

    broken_off, chosen = "peers of thrust.strains, extreme", (subject("thrust"),)
    with pytest.raises(KeyboardInterrupt):
        survey.measure(path, WHOLE, tell, chosen=chosen)
    (kept, total), broken_off = told[-1], ""
    told.clear()
    found = survey.measure(path, WHOLE, tell, chosen=chosen)
    assert told == [(done, total) for done in range(kept, total + 1)]
    assert records.load(path) == found
    absent = {row.form for row in found.missing}
    assert "jax" in absent
    for peer in derived:
        known = found.error("thrust", "strains", peer.name, "ordinary")
        assert (known is None) == (peer.name in absent) == (peer.name not in found.forms)
        for points in (8, 1):
            timed = found.time("thrust", "strains", peer.name, points)
            assert (timed is None) == (peer.name in absent)
    page = table.page(replace(found, missing=(Missing("casadi", "", "it is not installed"),)))
    assert "Not measured here:\n\n- casadi: it is not installed" in page
