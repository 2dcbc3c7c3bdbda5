"""The numba modules: their own functions, what compiled code can call, the NumPy modules' words.

`test_accuracy` holds their numbers to the oracle.
"""

from __future__ import annotations

import importlib.util
import math
import sys
from dataclasses import replace

import mpmath
import numpy as np
import pytest

pytest.importorskip("numba", reason="numba is not installed")
from numba import njit

from rodproof.codegen import generate, scene
from rodproof.codegen.scene import Scene
from rodproof.generated.numba import full_rod, full_rod_p2
from rodproof.generated.scenes import full_rod as rod
from rodproof.generated.scenes import full_rod_p2 as rod_p2

GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3}
C2 = full_rod_p2.Constants(**GOOD)
TWIN = rod_p2.Constants(**GOOD)
MP = mpmath.mp.clone()
MP.dps = 40


def of_scene(own: Scene, folder, monkeypatch):
    """The scene's module, from a file: numba keeps what it compiles beside it."""
    path = folder / f"{own.name}.py"
    path.write_text(generate.render(own, target="numba"))
    spec = importlib.util.spec_from_file_location(own.name, path)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, own.name, module)
    spec.loader.exec_module(module)
    return module


def test_long_results_begin_a_cache_line() -> None:
    m, n = np.random.default_rng(3).normal(size=(2, 3, 5001))
    for _ in range(4):  # fresh memory may begin one by chance
        u, v = full_rod_p2.strains(m, n, C2)
        assert [a.ctypes.data % full_rod_p2.LINE for a in (u, v)] == [0, 0]


@pytest.mark.parametrize(
    ("name", "low", "high"),
    [("exp", -700, 709), ("expm1", -40, 700), ("log", -300, 300), ("log1p", -300, 300)],
)
def test_own_functions_are_within_an_ulp(name: str, low: float, high: float) -> None:
    own = getattr(full_rod, f"_{name}")

    @njit
    def over(given, made):
        for i in range(given.shape[0]):
            made[i] = own(given[i])

    rng = np.random.default_rng(7)
    points = rng.uniform(low, high, 300)
    points = np.concatenate([points, rng.uniform(0.1, 3, 300)])
    if name.startswith("log"):
        points[:300] = 10.0 ** points[:300]
    if name.endswith("1") or name == "log1p":
        points = np.concatenate([points, 10.0 ** rng.uniform(-300, 0, 100)])
    if name == "log":
        points = np.concatenate([points, 1 + rng.uniform(-1e-6, 1e-6, 100)])
    made = np.empty_like(points)
    over(points, made)
    for x, got in zip(points, made, strict=True):
        true = getattr(MP, name)(MP.mpf(x))
        assert abs(MP.mpf(got) - true) <= abs(true) * MP.mpf(2) ** -52 * 1.05, x
    over(np.array([math.nan, math.inf, 800.0]), made[:3])
    assert math.isnan(made[0])
    assert name.startswith("log") or made[2] == math.inf


def test_exp_goes_down_to_nought() -> None:
    """To within the spacing of the subnormal numbers; below the least one it is nought."""

    @njit
    def at(x):
        return full_rod._exp(x)

    for x in (*np.linspace(-760, -660, 201), -1e4, -1e300, -math.inf):
        true = MP.exp(MP.mpf(float(x)))
        assert abs(MP.mpf(at(float(x))) - true) <= max(2 * true * MP.mpf(2) ** -52, 2.0**-1074), x


def test_the_gap_is_that_of_arrays_down_to_nought() -> None:
    c, twin = full_rod.Constants(**GOOD, p=3.3), rod.Constants(**GOOD, p=3.3)
    m, n = np.zeros((2, 3, 400))
    n[2] = 10.0 ** np.linspace(0, 110, 400)
    with np.errstate(under="ignore"):
        *_, got = full_rod.strains_and_gap(m, n, c)
        *_, want = rod.strains_and_gap(m, n, twin)
    np.testing.assert_allclose(got, want, rtol=2e-13, atol=2.0**-1073)
    assert want[-1] == got[-1] == 0


def test_callable_from_compiled_code() -> None:
    """The functions of one point, in a loop of somebody else's."""
    there, back = full_rod_p2.strains_at, full_rod_p2.loads_at

    @njit
    def round_trips(m, c):
        worst = 0.0
        for i in range(m.shape[0]):
            u, v = there(m[i], 0.2, -0.3, 0.1, 0.4, 0.5, c)
            again, _ = back(u[0], u[1], u[2], v[0], v[1], v[2], c)
            worst = max(worst, abs(again[0] - m[i]))
        return worst

    assert round_trips(np.linspace(-2, 2, 50), C2.values) < 1e-12
    stiff = full_rod_p2.stiffness_at(0.1, 0.0, 0.2, 0.0, 0.1, 1.1, C2.values)
    want = rod_p2.stiffness([0.1, 0, 0.2], [0, 0.1, 1.1], TWIN)
    np.testing.assert_allclose(stiff, want, rtol=1e-14)
    with pytest.raises(ValueError, match="Q"):
        full_rod_p2.loads_at(9.0, 0.0, 0.0, 0.0, 0.0, 1.0, C2.values)


def test_same_words_for_wrong_input() -> None:
    """Checks and errors are those of the NumPy module; results go straight into ``out``."""
    u = np.zeros((3, 4, 5))
    u[0, 2, 3] = u[0, 3, 4] = 9.0
    v = np.array([0, 0, 1.0]).reshape(3, 1, 1)
    for module, c in ((full_rod_p2, C2), (rod_p2, TWIN)):
        with pytest.raises(ValueError, match="2 of 20 do not, the first at") as caught:
            module.loads(u, v, c)
        assert "index (2, 3) with Q = 39.6" in str(caught.value)
        with pytest.raises(ValueError, match="m must hold real numbers"):
            module.strains(np.zeros(4), np.zeros(3), c)
        with pytest.raises(ValueError, match="out must be 2 arrays, for u and v"):
            module.strains(np.zeros((3, 7)), np.zeros((3, 7)), c, out=(np.zeros((3, 7)),))
        with pytest.raises(ValueError, match=r"beta\^2 eta\^2"):
            module.Constants(**{**GOOD, "iota": 9.0})
    m, n = np.random.default_rng(0).normal(size=(2, 3, 700))
    out = (np.empty((3, 700)), np.empty((3, 700)))
    got = full_rod_p2.strains(m, n, C2, out=out)
    assert got[0] is out[0]
    for a, b in zip(got, rod_p2.strains(m, n, TWIN), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-14, atol=1e-16)
    over = m.copy()
    full_rod_p2.strains(over, n, C2, out=(over, out[1]))  # results over the inputs
    assert np.array_equal(over, out[0])


def test_rest_is_rest_however_small_gamma_is() -> None:
    """Nothing is scaled there: a scale of 2^-480 takes 1/gamma out of its range."""
    for module, more in ((full_rod, {"p": 3.3}), (full_rod_p2, {})):
        for gamma in (1e-200, 1e200):
            c = module.Constants(**{**GOOD, "gamma": gamma}, **more)
            u, v, gap = module.strains_and_gap(np.zeros((3, 2)), np.zeros((3, 2)), c)
            assert not u.any()
            assert np.array_equal(v, np.tile([[0], [0], [1]], 2))
            assert np.array_equal(gap, [1, 1])
            assert np.array_equal(module.strains([0, 0, 0], [0, 0, 0], c)[1], [0, 0, 1])


def test_a_block_with_extremes_is_done_again_with_care() -> None:
    """Rest, subnormal and huge loads among ordinary ones, in the last block that is not full."""
    m, n = np.random.default_rng(0).normal(size=(2, 3, 300))
    m[:, 290], n[:, 290] = 0, 0
    m[:, 291], n[:, 291] = 5e-324, 0
    m[:, 292], n[:, 292] = 1e200, -1e190
    m[:, 293], n[:, 293] = 1e-170, 3e-165
    got, want = full_rod_p2.strains(m, n, C2), rod_p2.strains(m, n, TWIN)
    for a, b in zip(got, want, strict=True):
        assert (np.abs(a - b) <= 1e-14 * np.abs(b).max(axis=0) + 5e-324).all()
    single = full_rod_p2.strains(m[:, 7].astype("f4"), n[:, 7].astype("f4"), C2)
    assert single[0].dtype == np.float32


def test_the_records_are_the_same() -> None:
    c = full_rod.Constants(**GOOD, p=3.3)
    twin = rod.Constants(**GOOD, p=3.3)
    assert repr(c) == repr(twin)
    assert c.values[:7] == (0.7, 1.1, 0.9, 1.6, -0.4, 2.3, 3.3)
    assert all(getattr(twin, name) == getattr(c.values, name) for name in ("gap", "per_eta"))


@pytest.mark.parametrize("module", [full_rod, full_rod_p2])
def test_loops_work_on_vectors(module) -> None:
    """A loop that the compiler did not turn into vectors takes a root of one number at a time."""
    c = module.Constants(**GOOD, **({} if module is full_rod_p2 else {"p": 3.3}))
    options = {"error_model": "numpy", "fastmath": {"contract"}}
    fresh = njit(**options)(module._loads_and_stiffness_over.py_func)  # the kept one has no text
    u, v, m, n = np.zeros((4, 3, 20))
    fresh(c.numbers, u, v + [[0], [0], [0.9]], m, n, np.empty((6, 6, 20)))
    (text,) = fresh.inspect_llvm().values()
    assert "x double> @llvm.sqrt." in text


def test_results_that_share_memory() -> None:
    """Written as if one after the other: with an input, with each other, and in part."""
    memory = np.random.default_rng(3).normal(size=(7, 50))
    m, n = memory[:3].copy(), memory[3:6].copy()
    u, v = full_rod_p2.strains(m, n, C2)
    shifted = (memory[1:4], memory[4:7])
    got = full_rod_p2.strains(memory[:3], memory[3:6], C2, out=shifted)
    assert np.array_equal(got[0], u)
    assert np.array_equal(got[1], v)
    both = np.empty((3, 50))
    full_rod_p2.strains(m, n, C2, out=(both, both))
    assert np.array_equal(both, v)
    both.flags.writeable = False
    with pytest.raises(ValueError, match="read-only"):
        full_rod_p2.strains(m, n, C2, out=(both, u))


def test_components_last(tmp_path, monkeypatch) -> None:
    own = replace(
        scene.committed("full_rod_p2"), name="last", layout="last", functions=("strains", "stiffness")
    )
    module = of_scene(own, tmp_path, monkeypatch)
    c = module.Constants(**GOOD)
    for points in ((), (1,), (5, 60)):
        m, n = np.random.default_rng(4).normal(size=(2, 3, *points))
        u, v = rod_p2.strains(m, n, TWIN)
        given = [np.ascontiguousarray(np.moveaxis(a, 0, -1)) for a in (m, n, u, v)]
        for got, want in zip(module.strains(*given[:2], c), (u, v), strict=True):
            np.testing.assert_allclose(np.moveaxis(got, -1, 0), want, rtol=1e-14)
        stiff = module.stiffness(*given[2:], c)
        np.testing.assert_allclose(
            np.moveaxis(stiff, (-2, -1), (0, 1)), rod_p2.stiffness(u, v, TWIN), rtol=1e-13, atol=1e-14
        )


def test_past_the_limit_is_not_a_number(tmp_path, monkeypatch) -> None:
    """Where the scene says so, at those points alone; and what is no number stays that."""
    own = Scene("soft", functions=("loads", "stiffness"), at_limit="nan")
    module = of_scene(own, tmp_path, monkeypatch)
    c = module.Constants(**GOOD, p=3.3)
    u, v = np.random.default_rng(5).normal(0, 0.4, (2, 3, 600))
    v[2] += 1
    u[1, 7] = math.nan
    m, n = module.loads(u, v, c)
    past = np.isnan(m[2])
    assert 50 < past.sum() < 550
    assert past[7]
    stiff = module.stiffness(u, v, c)
    assert np.array_equal(np.isnan(stiff).all(axis=(0, 1)), past)
    assert np.array_equal(np.isnan(n).any(axis=0), past)
    want = rod.stiffness(u[:, ~past], v[:, ~past], rod.Constants(**GOOD, p=3.3))
    np.testing.assert_allclose(stiff[..., ~past], want, rtol=1e-9, atol=1e-9)
