"""Scenes as their users meet them: arrays by scene, layouts, types, defaults, examples."""

from __future__ import annotations

import importlib
import runpy
import sys
import types
from pathlib import Path

import numpy as np
import pytest

from rodproof.codegen import generate, scene
from rodproof.codegen.live import groups, live
from rodproof.codegen.scene import FUNCTIONS_OF_LOADS as OF_LOADS
from rodproof.codegen.scene import Scene
from rodproof.derivations.theory import constrained
from rodproof.generated.scenes import dsdna, full_rod, kirchhoff

SCENES = {name: scene.committed(name) for name in scene.committed_names()}
FUSED = "loads_and_stiffness"
GAP = "strains_and_gap"
CALLS = [(name, f) for name, s in SCENES.items() for f in s.functions if f not in (FUSED, GAP)]
GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}


def module_of(own: Scene) -> types.ModuleType:
    """The scene's module; dataclass wants it among the modules while it loads."""
    module = types.ModuleType(own.name)
    sys.modules[own.name] = module
    try:
        exec(generate.render(own), module.__dict__)
    finally:
        del sys.modules[own.name]
    return module


def constants(own: Scene, module: types.ModuleType) -> tuple[object, full_rod.Constants]:
    """Constants of the scene and of the full rod that it restricts."""
    names = set(module.Constants.__dataclass_fields__) & set(GOOD)
    whole = {**GOOD, **own.fixed} | ({"iota": 0} if constrained.achiral(own.constraints) else {})
    given = {name: whole[name] for name in names - set(own.fixed)}
    return module.Constants(**given), full_rod.Constants(**whole)


def inputs(own: Scene, function: str, shape: tuple, dtype: type = np.float64) -> tuple:
    """What the scene's function takes, and what the full rod's does."""
    rng, at = np.random.default_rng(3), live(own).loads
    whole = np.zeros((6, *shape))
    whole[list(at)] = rng.uniform(-0.2, 0.2, (len(at), *shape))
    whole[5] += function not in OF_LOADS
    whole = whole.astype(dtype)
    parts = groups("mn" if function in OF_LOADS else "uv", at)
    given = [whole[list(g.components)] if g.head else whole[g.components[0]] for g in parts]
    return given, (whole[:3], whole[3:])


def by_component(own: Scene, function: str, got: object) -> np.ndarray:
    """What the scene returned, in the rows of the full rod's answer that the scene keeps."""
    parts = got if isinstance(got, tuple) else (got,)
    if function in ("strains", "loads"):
        kept = live(own).strains if function == "strains" else live(own).loads
        heads = [g.head for g in groups("uv" if function == "strains" else "mn", kept)]
        rows = [p if h else p[None] for p, h in zip(parts, heads, strict=True)]
        return np.concatenate(rows)
    return parts[0]


def restricted(own: Scene, function: str, got: object) -> np.ndarray:
    """The full rod's answer, at the components that the scene keeps."""
    at = list(live(own).loads)
    if function in ("strains", "loads"):
        kept = live(own).strains if function == "strains" else at
        return np.concatenate(got)[list(kept)]
    if function in ("stiffness", "compliance", "stiffness_at_loads"):
        return got[np.ix_(at, at)] if len(at) > 1 else got[at[0], at[0]]
    return got


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize(("name", "function"), CALLS)
def test_scene_has_the_numbers_of_the_full_rod(name: str, function: str, dtype: type) -> None:
    own, module = SCENES[name], importlib.import_module(f"rodproof.generated.scenes.{name}")
    mine, whole = constants(own, module)
    given, all_of_it = inputs(own, function, (4, 5), dtype)
    with np.errstate(all="raise", under="ignore"):
        got = by_component(own, function, getattr(module, function)(*given, mine))
    want = restricted(own, function, getattr(full_rod, function)(*all_of_it, whole))
    assert got.dtype == dtype
    assert got.shape == want.shape
    np.testing.assert_allclose(got, want, atol=float(np.abs(want).max()) * 8 * np.finfo(dtype).eps)


@pytest.mark.parametrize("shape", [(), (7,), (2, 0), (3, 4)])
@pytest.mark.parametrize("name", ["full_rod", "planar", "dsdna"])
def test_components_last(name: str, shape: tuple) -> None:
    """The same numbers to the bit, with the axes of the components behind the points."""
    first = SCENES[name]
    last = Scene("last", constraints=first.constraints, layout="last")
    module = module_of(last)
    mine, _ = constants(last, module)
    usual = importlib.import_module(f"rodproof.generated.scenes.{name}")
    c, _ = constants(first, usual)
    for function in (f for f in last.functions if f != FUSED):
        given, _ = inputs(last, function, shape)
        turned = [np.moveaxis(a, 0, -1) if a.ndim > len(shape) else a for a in given]
        got = getattr(module, function)(*turned, mine)
        want = getattr(usual, function)(*given, c)
        pairs = zip(got, want, strict=True) if isinstance(got, tuple) else [(got, want)]
        for mine_, usual_ in pairs:
            extra = usual_.ndim - len(shape)
            moved = np.moveaxis(usual_, range(extra), range(-extra, 0))
            assert mine_.shape == moved.shape
            assert np.array_equal(mine_, moved)
        out = got if isinstance(got, tuple) else (got,)
        again = tuple(np.empty_like(g) for g in out)
        getattr(module, function)(*turned, mine, out=again if len(again) > 1 else again[0])
        assert all(np.array_equal(a, b) for a, b in zip(again, out, strict=True))


def test_components_last_says_what_it_wants() -> None:
    module = module_of(Scene("last", functions=("strains", "loads"), layout="last"))
    c = module.Constants(**GOOD)
    with pytest.raises(ValueError, match=r"m must hold real numbers in the shape \(\.\.\., 3\)"):
        module.strains(np.zeros((3, 4)), np.zeros(3), c)
    with pytest.raises(ValueError, match=r"m \(2, 3\) and n \(4, 3\) do not broadcast before"):
        module.strains(np.zeros((2, 3)), np.zeros((4, 3)), c)
    u = np.zeros((4, 5, 3))
    u[2, 3, 0] = 9
    with pytest.raises(ValueError, match=r"1 of 20 do not, the first at index \(2, 3\)"):
        module.loads(u, [0, 0, 1.0], c)


@pytest.mark.parametrize("precision", ["float32", "float64"])
def test_declared_precision(precision: str) -> None:
    module = module_of(Scene("own", functions=("strains",), precision=precision))
    for dtype in (np.float32, np.float64, np.int64):
        u, _ = module.strains(np.ones((3, 2), dtype), np.ones(3, dtype), module.Constants(**GOOD))
        assert u.dtype == precision
    want, _ = full_rod.strains([1, 1, 1], [1, 1, 1], full_rod.Constants(**GOOD))
    np.testing.assert_allclose(u[:, 0], want, rtol=4 * np.finfo(precision).eps)


def test_constants_fixed_and_with_defaults() -> None:
    """Fixed numbers are not asked for; with a number for each the functions need no constants."""
    fixed = {"alpha": 0.7, "gamma": 1.0, "p": 3.3}
    defaults = {"beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4}
    module = module_of(Scene("own", functions=("strains",), fixed=fixed, defaults=defaults))
    want = full_rod.strains([0.1, 0.2, 0.3], [1, 2, 3], full_rod.Constants(**fixed, **defaults))
    got = module.strains([0.1, 0.2, 0.3], [1, 2, 3])
    np.testing.assert_allclose(got, want, rtol=1e-15)
    again = module.strains([0.1, 0.2, 0.3], [1, 2, 3], module.Constants(beta=1.1))
    assert np.array_equal(got, again)
    with pytest.raises(TypeError, match="alpha"):
        module.Constants(alpha=0.7)
    assert "gamma" not in module.Constants.__dataclass_fields__  # a factor of one is none
    some = module_of(Scene("own", functions=("strains",), defaults={"p": 2.5}))
    rest = {name: value for name, value in GOOD.items() if name != "p"}
    assert some.Constants(**rest).p == 2.5
    with pytest.raises(TypeError, match="constants"):
        some.strains([0, 0, 0], [0, 0, 0])


@pytest.mark.parametrize("component", range(6))
def test_a_single_load(component: int) -> None:
    """One live load: arrays without leading axes, at rest too, with and without coupling."""
    load = scene.LOAD_NAMES[component]
    functions = ("strains", "complementary_energy", "compliance")
    for constraints in ((), ("achiral",)):
        own = Scene("one", functions=functions, loads=(load,), constraints=constraints)
        module = module_of(own)
        mine, whole = constants(own, module)
        for size in (0.0, 1e-200, 0.7, -3e7):
            full = np.zeros(6)
            full[component] = size
            with np.errstate(all="raise", under="ignore"):
                soft = module.compliance(np.array(size), mine)
                assert type(module.compliance(size, mine)) is float
            want = full_rod.compliance(full[:3], full[3:], whole)[component, component]
            assert soft.shape == ()
            np.testing.assert_allclose(soft, want, rtol=2e-14)
            got = by_component(own, "strains", module.strains(np.array(size), mine))
            strains = full_rod.strains(full[:3], full[3:], whole)
            np.testing.assert_allclose(got, restricted(own, "strains", strains), rtol=2e-14)


@pytest.mark.parametrize("constraint", ["untwisted", "inextensible", "unshearable"])
def test_a_constrained_rod_is_the_limit_of_stiff_ones(constraint: str) -> None:
    """Numerically, with reactions that are not zero: a modulus of 1e9 is infinity to 1e-8."""
    own = Scene("held", constraints=(constraint,))
    module = module_of(own)
    rigid = constrained.CONSTRAINTS[constraint].rigid.name
    names = set(module.Constants.__dataclass_fields__) & set(GOOD)
    mine = module.Constants(**{name: GOOD[name] for name in names})
    stiff = full_rod.Constants(**{**GOOD, rigid: 1e9})
    m, n = np.array([0.3, -0.2, 0.5]), np.array([0.4, 0.1, -0.6])
    whole = np.concatenate([m, n])
    at = live(own).loads
    parts = groups("mn", at)
    given = [whole[list(g.components)] if g.head else whole[g.components[0]] for g in parts]
    got = by_component(own, "strains", module.strains(*given, mine))
    want = np.concatenate(full_rod.strains(m, n, stiff))
    np.testing.assert_allclose(got, want[list(at)], rtol=1e-8)
    lost = [i for i in range(6) if i not in at]
    np.testing.assert_allclose(want[lost], [float(i == 5) for i in lost], atol=1e-8)


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("name", [n for n, s in SCENES.items() if FUSED in s.functions])
def test_fused_function_has_the_same_numbers_to_the_bit(name: str, dtype: type) -> None:
    own, module = SCENES[name], importlib.import_module(f"rodproof.generated.scenes.{name}")
    mine, _ = constants(own, module)
    given, _ = inputs(own, FUSED, (4, 5), dtype)
    *loads, stiff = module.loads_and_stiffness(*given, mine)
    apart = module.loads(*given, mine)
    apart = apart if isinstance(apart, tuple) else (apart,)
    assert all(np.array_equal(a, b) for a, b in zip(loads, apart, strict=True))
    assert np.array_equal(stiff, module.stiffness(*given, mine))
    out = tuple(np.empty_like(part) for part in (*loads, stiff))
    again = module.loads_and_stiffness(*given, mine, out=out)
    assert all(a is b for a, b in zip(again, out, strict=True))


@pytest.mark.parametrize("dtype", [np.float64, np.float32])
@pytest.mark.parametrize("name", [n for n, s in SCENES.items() if GAP in s.functions])
def test_strains_beside_the_gap_are_the_strains(name: str, dtype: type) -> None:
    """To a few ulps: by themselves they may come the short way, which has no gap."""
    own, module = SCENES[name], importlib.import_module(f"rodproof.generated.scenes.{name}")
    mine, whole = constants(own, module)
    given, (m, n) = inputs(own, GAP, (4, 5), dtype)
    *strains, gap = module.strains_and_gap(*given, mine)
    apart = module.strains(*given, mine)
    apart = apart if isinstance(apart, tuple) else (apart,)
    for a, b in zip(strains, apart, strict=True):
        np.testing.assert_allclose(a, b, rtol=16 * np.finfo(dtype).eps)
    *_, wanted = full_rod.strains_and_gap(m, n, whole)
    assert gap.dtype == dtype
    np.testing.assert_allclose(gap, wanted, rtol=8 * np.finfo(dtype).eps)


@pytest.mark.parametrize("layout", ["first", "last"])
@pytest.mark.parametrize("constraints", [(), ("planar",), ("unshearable",)])
def test_packed_matrices(constraints: tuple, layout: str) -> None:
    """The entries on and above the diagonal, row by row, to the bit those of the whole."""
    functions = ("stiffness", FUSED, "compliance", "stiffness_at_loads")
    settings = {"functions": functions, "constraints": constraints}
    whole = Scene("a", **settings)
    packed = Scene("a", **settings, matrix="packed", layout=layout)
    a, b = module_of(whole), module_of(packed)
    for function in functions:
        given, _ = inputs(whole, function, (7,))
        turned = [np.moveaxis(g, 0, -1) if g.ndim > 1 and layout == "last" else g for g in given]
        want = getattr(a, function)(*given, constants(whole, a)[0])
        got = getattr(b, function)(*turned, constants(packed, b)[0])
        if function == FUSED:
            want, got = want[-1], got[-1]
        upper = want[np.triu_indices(len(want))]
        assert np.array_equal(got, upper if layout == "first" else upper.T)


def test_moduli_of_dna() -> None:
    """The moduli at rest come back as the stiffness at rest, whatever gamma."""
    for gamma in (50.0, 65.0):
        c = dsdna.Constants.of_moduli(gamma=gamma, p=2.4)
        K = dsdna.stiffness([0, 0, 0], 1.0, c)
        wanted = np.diag([185.0, 185.0, 447.0, 1000.0])
        wanted[2, 3] = wanted[3, 2] = -70
        np.testing.assert_allclose(K, wanted, rtol=1e-14, atol=1e-12)
    own = dsdna.Constants.of_moduli(gamma=50.0, p=2.0, bending=200.0)
    assert own.alpha == 2.0


def test_kirchhoff_takes_and_gives_single_arrays() -> None:
    c = kirchhoff.Constants(alpha=0.7, beta=1.1, gamma=2.3, p=3.3)
    m = np.array([[0.1, 1], [0.2, 2], [0.3, 3]])
    u = kirchhoff.strains(m, c)
    assert isinstance(u, np.ndarray)
    np.testing.assert_allclose(kirchhoff.loads(u, c), m, rtol=1e-13)
    assert kirchhoff.stiffness(u, c).shape == (3, 3, 2)
    out = np.empty_like(u)
    assert kirchhoff.strains(m, c, out=out) is out


@pytest.mark.parametrize("name", SCENES)
def test_example_runs(name: str, root: Path, capsys: pytest.CaptureFixture) -> None:
    """Each scene has a short example; what it prints is no test, what it asserts is."""
    path = root / "docs" / "examples" / f"{name}.py"
    assert len(path.read_text("utf-8").splitlines()) < 40
    runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


ONES = (
    {"alpha": 1.0, "beta": 1.0, "zeta": 1.0, "eta": 1.0, "gamma": 1.0, "p": 2.0},
    {"alpha": 1.0, "beta": 1.0, "zeta": 1.0, "eta": 1.0},
    {"eta": 1.0, "iota": 1.0},
)


@pytest.mark.parametrize("fixed", ONES, ids=lambda fixed: "-".join(fixed))
def test_constants_fixed_at_one_are_numbers_like_others(fixed: dict[str, float]) -> None:
    """Factors of one are left out; where squares underflow or overflow the scale stays right."""
    own = Scene("ones", fixed=fixed)
    module = module_of(own)
    whole = {**GOOD, "beta": 1.5, **fixed}
    fields = set(module.Constants.__dataclass_fields__) - set(fixed)
    mine = module.Constants(**{name: whole[name] for name in fields & set(whole)})
    rod = full_rod.Constants(**whole)
    for function in own.functions:
        _, (first, last) = inputs(own, function, (3,))
        parts = np.concatenate([first, last])
        small, large = (1e-160, 1e160) if function in OF_LOADS else (1e-160, 1.0)
        parts[:, 1] *= small
        parts[:, 2] *= large
        parts[5, 1] = 0.0 if function in OF_LOADS else 1.0
        with np.errstate(over="ignore", invalid="ignore"):  # the largest stiffness is infinite
            got = getattr(module, function)(parts[:3], parts[3:], mine)
            want = getattr(full_rod, function)(parts[:3], parts[3:], rod)
            pairs = zip(got, want, strict=True) if isinstance(got, tuple) else [(got, want)]
            for a, b in pairs:
                largest = np.abs(b).max(axis=tuple(range(b.ndim - 1)), initial=0.0)
                near = np.abs(a - b) <= 8 * np.finfo(float).eps * largest
                assert ((a == b) | near).all(), function


@pytest.mark.parametrize(
    ("constraints", "fixed"),
    [
        (
            ("achiral",),
            {"alpha": 1.0, "beta": 1.0, "zeta": 1.0, "eta": 1.0, "gamma": 1.0, "p": 2.0},
        ),
        (("unshearable", "inextensible"), {"beta": 1.0}),
        (("planar", "unshearable", "inextensible"), {"alpha": 1.0}),
        (("planar", "unshearable", "inextensible"), {"gamma": 1.0, "p": 2.0}),
    ],
)
def test_a_part_of_the_rod_with_constants_fixed_at_one(constraints: tuple, fixed: dict) -> None:
    """Arrays and one point, near rest and where squares underflow, as the full rod has them."""
    own = Scene("part", constraints=constraints, fixed=fixed)
    module = module_of(own)
    mine, whole = constants(own, module)
    for function in own.functions:
        given, all_of_it = inputs(own, function, (2,))
        if function in OF_LOADS:
            for part in (*given, *all_of_it):
                part[..., 1] *= 1e-160
        law = getattr(module, function)
        single = [a[..., 0].tolist() for a in given]
        point = law(*(tuple(s) if isinstance(s, list) else s for s in single), mine)
        got = law(*given, mine)
        pairs = zip(got, point, strict=True) if isinstance(got, tuple) else [(got, point)]
        for array, number in pairs:
            np.testing.assert_allclose(array[..., 0], number, rtol=1e-13, atol=1e-15)
        if function not in (FUSED, GAP):
            got = by_component(own, function, got)
            want = restricted(own, function, getattr(full_rod, function)(*all_of_it, whole))
            near = 8 * np.finfo(float).eps * np.abs(want).max(axis=tuple(range(want.ndim - 1)))
            assert (np.abs(got - want) <= near).all(), function


def test_the_coupling_is_checked_where_some_of_it_is_fixed_at_one() -> None:
    module = module_of(Scene("ones", functions=("compliance",), fixed={"eta": 1.0, "iota": 1.0}))
    with pytest.raises(ValueError, match=r"smaller than beta\*eta, not beta=0.5, iota=1.0"):
        module.Constants(alpha=1, beta=0.5, zeta=1, gamma=1, p=3)
    module = module_of(Scene("ones", functions=("strains",), fixed={"eta": 1.0, "beta": 1.0}))
    with pytest.raises(ValueError, match=r"smaller than beta\*eta, not iota=1.5"):
        module.Constants(alpha=1, iota=1.5, zeta=1, gamma=1, p=3)
