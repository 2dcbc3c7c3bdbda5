"""The account of a scene: what it says is left out is not there, and nothing costs more."""

from __future__ import annotations

import pytest

from rodproof.codegen import account, scene
from rodproof.codegen.measure.beside import Beside
from rodproof.codegen.scene import Scene

ACCOUNTS = {name: account.account(scene.committed(name)) for name in scene.committed_names()}


@pytest.mark.parametrize("name", ACCOUNTS)
def test_no_function_costs_more_than_the_full_rods(name: str) -> None:
    found = ACCOUNTS[name]
    assert [line.function for line in found.lines] == list(scene.committed(name).functions)
    for line in found.lines:
        assert line.own.arithmetic <= line.full.arithmetic
        assert line.own.transcendental <= line.full.transcendental
        assert line.own.special <= line.full.special
        assert line.own.temporaries <= line.full.temporaries + 1  # 1 - Q has a name at p = 2
    cheaper = sum(
        line.own.arithmetic + line.own.transcendental
        < line.full.arithmetic + line.full.transcendental
        for line in found.lines
    )
    assert cheaper == (0 if name == "full_rod" else len(found.lines))


def test_dna_in_words() -> None:
    said = account.sentences(ACCOUNTS["dsdna"])
    assert "unshearable; v1 = 0, v2 = 0; n1, n2 are reactions" in said[1]
    assert said[2:] == [
        "Constants: alpha, beta, eta, iota, gamma, p.",
        "Constants left out: zeta.",
    ]
    times = [Beside(line.function, 20.0, 40.25) for line in ACCOUNTS["dsdna"].lines]
    rows = {row[0]: row[1:] for row in account.timed(ACCOUNTS["dsdna"], times)}
    assert len(rows["strains"]) == len(account.TIMED) - 1
    assert rows["strains"][-1] == "20 of 40.2"
    assert rows["strains"][0] == "m (3, ...), n3 (...) -> u (3, ...), v3 (...)"
    assert rows["stiffness"][0] == "u (3, ...), v3 (...) -> stiff (4, 4, ...)"


def test_square_roots_in_place_of_powers() -> None:
    for line in ACCOUNTS["full_rod_p2"].lines:
        assert line.own.transcendental == line.own.special == 0
        assert line.full.transcendental > 0


def test_full_rod_and_constants_in_words() -> None:
    assert "Nothing is left out." in account.sentences(ACCOUNTS["full_rod"])
    own = Scene("a", functions=("strains",), fixed={"p": 3.0}, defaults={"beta": 1.5})
    (said,) = (s for s in account.sentences(account.account(own)) if s.startswith("Constants:"))
    assert "p = 3 always" in said
    assert "beta = 1.5" in said
