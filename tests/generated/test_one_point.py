"""One point in plain Python: tuples of numbers in, tuples of floats out, the arrays' values."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rodproof.codegen import generate
from rodproof.codegen.scene import Scene
from rodproof.generated.scenes import dsdna, full_rod, kirchhoff

GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3}
C = full_rod.Constants(**GOOD, p=3.3)
OF_LOADS = ("strains", "complementary_energy", "compliance", "stiffness_at_loads")
OTHERS = ("loads", "stored_energy", "stiffness", "loads_and_stiffness")
#: How far the two ways may be apart, normwise, in ulps; near the limit times the conditioning.
APART = 8
finite = st.floats(-1e160, 1e160, allow_nan=False)
anything = st.one_of(finite, st.sampled_from([0.0, 5e-324, -1e-310, 1e-170, 1e155, 7]))


def flat(answer: object) -> list[float]:
    if isinstance(answer, tuple):
        return [number for part in answer for number in flat(part)]
    return [answer]  # type: ignore[list-item]


def arrays(answer: object) -> np.ndarray:
    parts = answer if isinstance(answer, tuple) else (answer,)
    return np.concatenate([np.ravel(part) for part in parts])


def shape(answer: object) -> object:
    """What is a tuple of what."""
    return [shape(part) for part in answer] if isinstance(answer, tuple) else type(answer)


@given(values=st.lists(anything, min_size=6, max_size=6), p=st.sampled_from([0.3, 1.0, 2.0, 1e3]))
def test_same_values_at_any_load(values: list[float], p: float) -> None:
    """Rest, subnormal and huge loads, whole numbers: without a warning, as floats."""
    c = full_rod.Constants(**GOOD, p=p)
    m, n = values[:3], values[3:]
    with np.errstate(all="raise", under="ignore"):
        got = full_rod.strains(tuple(m), tuple(n), c)
        want = full_rod.strains(m, n, c)
    assert shape(got) == [[float] * 3, [float] * 3]
    for a, b in zip(got, want, strict=True):
        assert np.abs(np.array(a) - b).max() <= APART * 2**-52 * np.abs(b).max() + 5e-324


@pytest.mark.parametrize("function", OTHERS)
@pytest.mark.parametrize("p", [0.3, 1 - 1e-10, 2.0, 40.0, 1e3])
def test_same_values_at_any_strain(function: str, p: float) -> None:
    c, rng = full_rod.Constants(**GOOD, p=p), random.Random(f"{function} {p}")
    law = getattr(full_rod, function)
    for _ in range(60):
        w = [rng.gauss(0, 1) for _ in range(6)]
        e = [w[0] / 0.7, w[1] / 0.7, w[2] / 1.1, w[3] / 0.9, w[4] / 0.9, w[5] / 1.6]
        q = math.sqrt(sum(a * a for a in w) + 2 * c.chirality * w[2] * w[5])
        gap = 10.0 ** -rng.uniform(0, 8)
        x = rng.choice([0.0, 10.0 ** -rng.uniform(0, 200), 1 - gap])
        u, v = [x / q * a for a in e[:3]], [x / q * a for a in e[3:]]
        v[2] += 1
        got, want = flat(law(tuple(u), tuple(v), c)), arrays(law(u, v, c))
        worst = np.abs(np.array(got) - want).max() / max(np.abs(want).max(), 1e-300)
        assert worst <= APART * 2**-52 * (1 + (1 + 1 / p) / (1 - x)), (u, v)
        assert all(type(number) is float for number in got)


def test_the_shapes_of_answers() -> None:
    zero, one = (0.0, 0.1, 0.0), (0.0, 0.0, 1.1)
    assert shape(full_rod.loads_and_stiffness(zero, one, C)) == [
        [float] * 3,
        [float] * 3,
        [[float] * 6] * 6,
    ]
    stiff = full_rod.stiffness(zero, one, C)
    assert stiff == tuple(zip(*stiff, strict=True))
    assert shape(full_rod.compliance(zero, one, C)) == [[float] * 6] * 6
    assert type(full_rod.stored_energy(zero, one, C)) is float
    u, v, gap = full_rod.strains_and_gap(zero, one, C)
    assert (u, v) == full_rod.strains(zero, one, C)
    assert type(gap) is float
    k = kirchhoff.Constants(alpha=0.7, beta=1.1, gamma=2.3, p=3.3)
    assert shape(kirchhoff.strains((0.1, 0.2, 0.3), k)) == [float] * 3
    d = dsdna.Constants.of_moduli(gamma=400.0, p=2.2)
    assert shape(dsdna.strains((0.1, 0.2, 0.3), 0.5, d)) == [[float] * 3, float]


@pytest.fixture
def module_of(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[Scene], ModuleType]:
    """A scene's module, imported from a file."""
    monkeypatch.syspath_prepend(tmp_path)

    def load(scene: Scene) -> ModuleType:
        generate.write_text(tmp_path / f"{scene.name}.py", generate.render(scene))
        return import_module(scene.name)

    return load


def test_packed_matrices_are_one_tuple(module_of: Callable[[Scene], ModuleType]) -> None:
    own = module_of(
        Scene("packed_point", functions=("stiffness", "loads"), matrix="packed", layout="last")
    )
    c = own.Constants(**GOOD, p=3.3)
    u, v = (0.1, 0.0, 0.2), (0.0, 0.1, 1.1)
    got = own.stiffness(u, v, c)
    assert shape(got) == [float] * 21
    np.testing.assert_allclose(got, own.stiffness(list(u), list(v), c), rtol=1e-13)
    soft = module_of(Scene("nan_point", functions=("loads",), at_limit="nan"))
    assert np.isnan(flat(soft.loads((9.0, 0.0, 0.0), (0.0, 0.0, 1.0), c))).all()


def test_numbers_that_are_no_floats_become_floats() -> None:
    want = full_rod.strains((1.0, 2.0, 3.0), (0.5, 0.0, 1.0), C)
    for kind in (np.float64, np.float32):
        m, n = tuple(map(kind, (1, 2, 3))), tuple(map(kind, (0.5, 0, 1)))
        assert full_rod.strains(m, n, C) == want
    assert full_rod.strains((1, 2, 3), (0.5, 0, 1), C) == want
    with np.errstate(all="raise", under="ignore"):
        huge = full_rod.strains((np.float64(1e160), 1, 1), (0.0, np.float64(-1e159), 1), C)
    assert shape(huge) == [[float] * 3, [float] * 3]


def test_tuples_of_arrays_and_lists_are_arrays() -> None:
    row = np.linspace(0, 1, 5)
    u, v = full_rod.strains((row, row, row), (row, 2 * row, row), C)
    assert u.shape == v.shape == (3, 5)
    assert full_rod.strains([1, 2, 3], (1.0, 2.0, 3.0), C)[0].shape == (3,)


def test_wrong_input_gets_the_sentence_of_the_arrays() -> None:
    with pytest.raises(ValueError, match=r"1 of 1 do not, the first at index \(\) with Q = 39.69"):
        full_rod.loads((9.0, 0.0, 0.0), (0.0, 0.0, 1.0), C)
    with pytest.raises(ValueError, match="Q = nan"):
        full_rod.loads((math.nan, 0.0, 0.0), (0.0, 0.0, 1.0), C)
    with pytest.raises(ValueError, match=r"m must hold real numbers in the shape \(3, ...\)"):
        full_rod.strains((1.0, 2.0), (1.0, 2.0, 3.0), C)
    with pytest.raises(ValueError, match="out is for arrays"):
        full_rod.strains((1.0, 2.0, 3.0), (1.0, 2.0, 3.0), C, out=(np.empty(3), np.empty(3)))


def test_ordinary_points_take_the_plain_way() -> None:
    """The values are those of the private function, which knows no arrays."""
    m, n = (0.1, 0.2, -0.3), (0.4, -0.5, 0.6)
    assert full_rod._strains_at(m, n, C) == full_rod.strains(m, n, C)
    u, v = full_rod.strains(m, n, C)
    assert full_rod._stiffness_at(u, v, C) == full_rod.stiffness(u, v, C)
    assert full_rod._loads_at(u, (0.0, 0.0, 9.0), C) is None
