"""One point in plain Python: tuples of numbers in, tuples of floats out, the arrays' values."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodproof.codegen import files, generate, scene
from rodproof.codegen.live import groups, live
from rodproof.codegen.scene import FUNCTIONS_OF_LOADS as OF_LOADS
from rodproof.codegen.scene import Scene
from rodproof.generated.scenes import dsdna, full_rod, kirchhoff

GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3}
C = full_rod.Constants(**GOOD, p=3.3)
SCENES = {name: scene.committed(name) for name in scene.committed_names()}
MODULES = {name: import_module(f"rodproof.generated.scenes.{name}") for name in SCENES}
CALLS = [(name, function) for name, own in SCENES.items() for function in own.functions]
#: How far the two ways may be apart, normwise, in ulps; near the limit times the conditioning.
APART = 8
finite = st.floats(-1e160, 1e160, allow_nan=False)
anything = st.one_of(finite, st.sampled_from([0.0, 5e-324, -1e-310, 1e-170, 1e155, 7]))
exponents = st.sampled_from([0.3, 1 - 1e-10, 1.0, 2.0, 3.3, 40.0, 1e3])
radii = st.one_of(
    st.just(0.0),
    st.floats(0, 200).map(lambda k: 10.0**-k),
    st.floats(0, 8).map(lambda k: 1 - 10.0**-k),
)


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


def constants_of(own: str, p: float) -> Any:
    """Constants of the scene's module: the good ones that it has, and p if it is free."""
    record = MODULES[own].Constants
    names = inspect.signature(record).parameters
    return record(**{k: v for k, v in {**GOOD, "p": p}.items() if k in names})


def both(own: str, function: str, values: list[float], c: Any) -> tuple[object, object]:
    """The answers to a point as tuples and as arrays; components that the scene lacks are left."""
    law = getattr(MODULES[own], function)
    parts = groups("mn" if function in OF_LOADS else "uv", live(SCENES[own]).loads)
    point = [[values[i] for i in g.components] for g in parts]
    one = [tuple(part) if len(part) > 1 else float(part[0]) for part in point]
    many = [np.array(part) if len(part) > 1 else np.array(part[0]) for part in point]
    with np.errstate(all="ignore"):
        return law(*one, c), law(*many, c)


def apart(got: object, want: object) -> float:
    """Ulps of the largest component of each array; numbers out of range must be so in both."""
    worst = 0.0
    single = isinstance(want, np.ndarray) or np.isscalar(want)
    for one, many in [(got, want)] if single else zip(got, want, strict=True):  # type: ignore[call-overload]
        a, b = np.array(one), np.array(many)
        assert a.shape == b.shape
        assert all(type(number) is float for number in flat(one))
        assert np.array_equal(np.isfinite(a), np.isfinite(b)), (a, b)
        if np.isfinite(b).all():
            left = np.maximum(np.abs(a - b) - 2.0**-1022, 0)
            worst = max(worst, float((left / max(np.abs(b).max(), 2.0**-1022)).max() * 2**52))
    return worst


@pytest.mark.parametrize(("own", "function"), [c for c in CALLS if c[1] in OF_LOADS])
@settings(max_examples=25)
@given(values=st.lists(anything, min_size=6, max_size=6), p=exponents)
def test_same_values_at_any_load(own: str, function: str, values: list[float], p: float) -> None:
    """Rest, subnormal and huge loads, whole numbers.

    What grows as y^p, or falls so, carries p ulps, and those of the logarithm it is taken by.
    """
    c = constants_of(own, p)
    got, want = both(own, function, values, c)
    bound: float = APART
    if function in ("stiffness_at_loads", "strains_and_gap"):
        last = np.abs(want[-1] if isinstance(want, tuple) else want).max()
        bound += APART * getattr(c, "p", 2.0) + abs(math.log(last if 0 < last < math.inf else 1))
    assert apart(got, want) <= bound


@pytest.mark.parametrize(("own", "function"), [c for c in CALLS if c[1] not in OF_LOADS])
@settings(max_examples=25)
@given(direction=st.lists(finite.filter(bool), min_size=6, max_size=6), radius=radii, p=exponents)
def test_same_values_at_any_strain(
    own: str, function: str, direction: list[float], radius: float, p: float
) -> None:
    """From rest to the limit; there the strains hardly determine loads and stiffness."""
    c, at = constants_of(own, p), live(SCENES[own]).loads
    largest = max(abs(direction[i]) for i in at)
    w = [direction[i] / largest if i in at else 0.0 for i in range(6)]
    q = sum(a * a for a in w) + 2 * getattr(c, "chirality", 0.0) * w[2] * w[5]
    moduli = [getattr(c, name, 1.0) for name in ("alpha", "alpha", "beta", "zeta", "zeta", "eta")]
    strains = [radius / math.sqrt(q) * a / b for a, b in zip(w, moduli, strict=True)]
    strains[5] += 1
    try:
        got, want = both(own, function, strains, c)
    except ValueError as error:  # at the limit to a few ulps
        assert "Q(u, v) < 1" in str(error) and radius > 1 - 1e-14
        return
    growth = 1 + 1 / getattr(c, "p", 2.0)
    at_limit = 2.0**52 * 16**growth  # some ulps of Q are all of 1 - Q, which has a factor of 16
    bound = APART * (1 + growth / (1 - radius)) if radius < 1 else at_limit
    assert apart(got, want) <= bound


def test_energies_by_either_form_of_the_share() -> None:
    """Up to exp(depth) = 9 and beyond, at exponents around those where the sum changes its form."""
    for p in (0.3, 0.5, 1 - 1e-10, 1.0, 1 + 1e-10, 2.0, 3.3, 40.0, 1e3):
        c = full_rod.Constants(**GOOD, p=p)
        depths = np.concatenate([np.linspace(0, 3, 40), 10.0 ** np.linspace(-12, 2.5, 60)])
        got = [full_rod._work_share_at(depth, c) for depth in depths.tolist()]
        np.testing.assert_allclose(got, full_rod._work_share(depths, c), rtol=APART * 2**-52)


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
        files.write_text(tmp_path / f"{scene.name}.py", generate.render(scene))
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


def test_without_guards_other_numbers_become_floats_too(
    module_of: Callable[[Scene], ModuleType],
) -> None:
    """Where ranges leave no guard to see the type of the square, every component is asked."""
    ranges = dict.fromkeys(("alpha", "beta", "gamma", "p"), (1.0, 2.0))
    ranges |= {"m1": (0.1, 0.5), "m2": (-1.0, 1.0), "m3": (-1.0, 1.0)}
    own = Scene(
        "unguarded_point",
        constraints=("unshearable", "inextensible"),
        functions=("strains", "compliance"),
        ranges=ranges,
    )
    assert "_Extreme" in generate.render(own) and "_balanced" not in generate.render(own)
    law = module_of(own)
    c = law.Constants(alpha=1.2, beta=1.1, gamma=1.3, p=1.4)
    m = (0.2, 0.5, -0.3)
    for function in (law.strains, law.compliance):
        for given_ in (tuple(map(np.float64, m)), (np.float64(0.2), 0.5, -0.3)):
            assert function(given_, c) == function(m, c)
            assert all(type(number) is float for number in flat(function(given_, c)))
        np.testing.assert_allclose(function(m, c), function(list(m), c), rtol=1e-14)


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
    with pytest.raises(full_rod._Extreme):
        full_rod._loads_at(u, (0.0, 0.0, 9.0), C)
