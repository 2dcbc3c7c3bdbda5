"""full_rod as its users meet it: shapes, types, reuse of arrays, bad input, isolation."""

from __future__ import annotations

import ast
import inspect
import math
import os
import subprocess
import sys
import types
import warnings
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import mutually_broadcastable_shapes

from rodproof.codegen import files, generate
from rodproof.codegen.scene import FUNCTIONS_OF_LOADS as OF_LOADS
from rodproof.codegen.scene import Scene
from rodproof.derivations import ledger
from rodproof.generated.scenes import full_rod as rod

GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}
C = rod.Constants(**GOOD)
HEADS = {
    "strains": ((3,), (3,)),
    "loads": ((3,), (3,)),
    "stored_energy": ((),),
    "complementary_energy": ((),),
    "stiffness": ((6, 6),),
    "compliance": ((6, 6),),
    "strains_and_gap": ((3,), (3,), ()),
    "stiffness_at_loads": ((6, 6),),
}
finite = st.floats(-1e160, 1e160, allow_nan=False)


def arrays(function: str, first: tuple, second: tuple, dtype: type, seed: int = 0) -> tuple:
    """Inputs inside the domain, of the given trailing shapes."""
    rng = np.random.default_rng(seed)
    a, b = rng.uniform(-0.2, 0.2, (3, *first)), rng.uniform(-0.2, 0.2, (3, *second))
    if function not in OF_LOADS:
        b[2] += 1
    return a.astype(dtype), b.astype(dtype)


def results(function: str, *args: object, **kw: object) -> tuple:
    got = getattr(rod, function)(*args, **kw)
    return got if isinstance(got, tuple) else (got,)


@given(
    shapes=mutually_broadcastable_shapes(num_shapes=2, max_dims=3, min_side=0, max_side=4),
    function=st.sampled_from(tuple(HEADS)),
    dtype=st.sampled_from([np.float32, np.float64]),
)
def test_shapes_and_types(shapes: object, function: str, dtype: type) -> None:
    (first, second), shape = shapes.input_shapes, shapes.result_shape
    a, b = arrays(function, first, second, dtype)
    with np.errstate(all="raise"):
        got = results(function, a, b, C)
    assert [g.shape for g in got] == [(*head, *shape) for head in HEADS[function]]
    assert all(isinstance(g, np.ndarray) and g.dtype == dtype for g in got)
    out = tuple(np.empty_like(g) for g in got)
    again = results(function, a, b, C, out=out if len(out) > 1 else out[0])
    assert all(g is o and np.array_equal(g, h) for g, o, h in zip(again, out, got, strict=True))


@given(values=st.lists(finite, min_size=6, max_size=6))
def test_any_finite_load_is_answered_inside_the_limit(values: list[float]) -> None:
    """No warning but underflow, finite strains within the limit, an energy that is not negative."""
    m, n = values[:3], values[3:]
    with np.errstate(all="raise", under="ignore"):
        u, v = rod.strains(m, n, C)
        energy, soft = rod.complementary_energy(m, n, C), rod.compliance(m, n, C)
    e = np.array([*u, *v]) - [0, 0, 0, 0, 0, 1]
    q = 0.49 * (e[0] ** 2 + e[1] ** 2) + 1.21 * e[2] ** 2 + 0.81 * (e[3] ** 2 + e[4] ** 2)
    q += 2.56 * e[5] ** 2 - 0.8 * e[2] * e[5]
    assert q <= 1 + 1e-14
    assert 0 <= energy < math.inf
    assert np.isfinite(soft).all()
    assert np.array_equal(soft, soft.T)
    assert (np.diag(soft) >= 0).all()


@pytest.mark.parametrize("function", HEADS)
def test_rest(function: str) -> None:
    """Exact zero: the linear rod, without a warning, scalars as arrays of shape ()."""
    small = 1.3e-200
    v = [0, 0, 1] if function not in OF_LOADS else [0, 0, 0]
    with np.errstate(all="raise"):
        got = results(function, [0, 0, 0], v, C)
    K = np.diag([0.49, 0.49, 1.21, 0.81, 0.81, 2.56])
    K[2, 5] = K[5, 2] = -0.4
    if function.startswith("stiffness"):
        np.testing.assert_allclose(got[0], 2.3 * K, rtol=1e-15)
    elif function == "compliance":
        np.testing.assert_allclose(got[0], np.linalg.inv(2.3 * K), rtol=1e-14, atol=1e-16)
    elif function.startswith("strains"):
        assert got[0].tolist() == [0, 0, 0]
        assert got[1].tolist() == [0, 0, 1]
        assert all(gap == 1 for gap in got[2:])
        u, _ = rod.strains([small, 0, 0], [0, 0, 0], C)
        np.testing.assert_allclose(u[0], small / 2.3 / 0.49, rtol=1e-15)
    else:
        assert all(
            g.shape == head and not g.any() for g, head in zip(got, HEADS[function], strict=True)
        )


def test_functions_are_each_others_inverse() -> None:
    m, n = arrays("strains", (50,), (50,), np.float64)
    u, v = rod.strains(3 * m, 3 * n, C)
    back = rod.loads(u, v, C)
    np.testing.assert_allclose(back[0], 3 * m, rtol=1e-12)
    np.testing.assert_allclose(back[1], 3 * n, rtol=1e-12)
    product = np.einsum(
        "ij...,jk...->ik...", rod.stiffness(u, v, C), rod.compliance(3 * m, 3 * n, C)
    )
    np.testing.assert_allclose(product, np.eye(6)[:, :, None] + 0 * product, atol=1e-12)
    work = (3 * m * u).sum(0) + (3 * n * (v - [[0], [0], [1]])).sum(0)
    total = rod.stored_energy(u, v, C) + rod.complementary_energy(3 * m, 3 * n, C)
    np.testing.assert_allclose(total, work, rtol=1e-13)


def test_loads_tell_what_strains_no_longer_can() -> None:
    """At 1e15 gamma and more the strains are at the limit to the last digit; the loads go on."""
    m, n = arrays("strains", (50,), (50,), np.float64)
    for size in (1e-200, 1.0, 1e3, 1e15, 1e40):
        with np.errstate(all="raise", under="ignore"):
            u, v, gap = rod.strains_and_gap(size * m, size * n, C)
            stiff = rod.stiffness_at_loads(size * m, size * n, C)
        for a, b in zip((u, v), rod.strains(size * m, size * n, C), strict=True):
            np.testing.assert_allclose(a, b, rtol=4e-15)  # these may have come the short way
        y_p = (1 - gap) / gap  # (y/gamma)^p, and the stiffness along the load is (1 + y_p)^(1 + 1/p)
        load = np.concatenate([m, n])
        soft = np.einsum("ij...,j...->i...", rod.compliance(m * 1e-90, n * 1e-90, C), load)
        along = np.einsum("ij...,j...->i...", stiff, soft)
        np.testing.assert_allclose(along, load * (1 + y_p) ** (1 + 1 / 3.3), rtol=1e-12)
    with pytest.raises(FloatingPointError, match="overflow"), np.errstate(over="raise"):
        rod.stiffness_at_loads(1e150 * m, 1e150 * n, C)


def test_blocks_do_not_show() -> None:
    """A long input, odd strides, and results over the inputs give what a copy gives."""
    m, n = arrays("strains", (2 * rod.BLOCK + 3,), (1,), np.float64)
    u, v = rod.strains(m, n, C)
    at = rod.BLOCK + 1
    one = rod.strains(m[:, at], n[:, 0], C)
    np.testing.assert_allclose(u[:, at], one[0], rtol=4e-16)
    np.testing.assert_allclose(v[:, at], one[1], rtol=4e-16)
    wide = np.empty((3, u.shape[1], 2))
    rod.strains(m, n, C, out=(wide[..., 0], wide[..., 1]))
    assert np.array_equal(wide[..., 0], u)
    assert np.array_equal(wide[..., 1], v)
    over = np.stack([m, np.broadcast_to(n, m.shape)])
    rod.strains(over[0], over[1], C, out=(over[1], over[0]))
    assert np.array_equal(over[1], u)
    assert np.array_equal(over[0], v)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_long_results_begin_a_cache_line(dtype: type) -> None:
    m, n = arrays("strains", (2 * rod.BLOCK + 3,), (1,), dtype)
    for _ in range(4):  # fresh memory may begin one by chance
        u, v = rod.strains(m, n, C)
        stiff = rod.stiffness(u, v, C)
        assert [a.ctypes.data % rod.LINE for a in (u, v, stiff)] == [0, 0, 0]


def test_integers_lists_and_mixed_types() -> None:
    assert rod.strains([0, 0, 1], [0, 0, 1], C)[0].dtype == np.float64
    single = np.zeros(3, np.float32)
    assert rod.strains(single, np.zeros(3), C)[0].dtype == np.float64
    assert rod.strains(single, np.zeros(3, int), C)[0].dtype == np.float64
    assert rod.strains(np.zeros(3, np.float16), np.zeros(3, np.float16), C)[0].dtype == np.float64


@pytest.mark.parametrize(
    ("changed", "sentence"),
    [
        ({"beta": 0.1}, r"beta^2 eta^2 - iota^2 > 0 fails"),
        ({"iota": 1.1 * 1.6 + 1e-9}, r"|iota| must be smaller than beta*eta"),
        ({"alpha": -1.0}, "alpha must be positive and finite, not -1.0"),
        ({"p": 0.0}, "p must be positive and finite, not 0.0"),
        ({"gamma": math.nan}, "gamma must be positive and finite, not nan"),
        ({"zeta": math.inf}, "zeta must be positive and finite, not inf"),
        ({"iota": math.nan}, "iota must be a finite number, not nan"),
        ({"alpha": 1e-310}, "per_alpha leaves the range of floating point numbers"),
    ],
)
def test_constants_are_checked(changed: dict, sentence: str) -> None:
    with pytest.raises(ValueError, match=r"^Constants: ") as caught:
        rod.Constants(**{**GOOD, **changed})
    assert sentence in str(caught.value)


def test_coupling_is_decided_exactly() -> None:
    """beta^2 eta^2 and iota^2 are equal in doubles here, and the constants are still right."""
    beta, eta = 1.0 + 2**-52, 1.0
    iota = math.nextafter(beta, 0)
    assert rod.Constants(**{**GOOD, "beta": beta, "eta": eta, "iota": iota}).gap > 0
    with pytest.raises(ValueError, match="iota"):
        rod.Constants(**{**GOOD, "beta": beta, "eta": eta, "iota": beta})


def test_constants_are_a_frozen_value() -> None:
    assert rod.Constants(**GOOD) == C
    assert hash(C) == hash(rod.Constants(**GOOD))
    assert "gap" not in repr(C)
    with pytest.raises(AttributeError):
        C.alpha = 1.0


@pytest.mark.parametrize("function", ["loads", "stored_energy", "stiffness"])
@pytest.mark.parametrize("bad", [1 / 0.7, 9.0, 1e300, math.inf, math.nan])
def test_past_the_limit(function: str, bad: float) -> None:
    u = np.zeros((3, 4, 5))
    u[0, 2, 3] = u[0, 3, 4] = bad
    v = np.array([0, 0, 1.0]).reshape(3, 1, 1)
    with np.errstate(all="raise"), pytest.raises(ValueError, match="Q") as caught:
        getattr(rod, function)(u, v, C)
    sentence = str(caught.value)
    assert "strains must satisfy Q(u, v) < 1: 2 of 20 do not" in sentence
    assert "the first at index (2, 3) with Q = " in sentence


def module_of(own: Scene) -> dict:
    """The names of a scene's module; dataclass wants it among the modules while it loads."""
    module = types.ModuleType(own.name)
    sys.modules[own.name] = module
    try:
        exec(generate.render(own), module.__dict__)
    finally:
        del sys.modules[own.name]
    return module.__dict__


@pytest.mark.parametrize("function", HEADS)
def test_scene_of_one_function_gives_the_same_numbers(function: str) -> None:
    own = module_of(Scene("one", functions=(function,)))
    a, b = arrays(function, (7,), (7,), np.float64)
    got = own[function](a, b, own["Constants"](**GOOD))
    want = getattr(rod, function)(a, b, C)
    pairs = zip(got, want, strict=True) if isinstance(got, tuple) else [(got, want)]
    assert all(np.array_equal(mine, usual) for mine, usual in pairs)
    assert [name for name in HEADS if name in own] == [function]
    assert ("_work_share" in own) == function.endswith("energy")
    assert ("_within_limit" in own) == (function not in OF_LOADS)


def test_policy_nan() -> None:
    names = module_of(Scene("soft", functions=("loads", "stored_energy"), at_limit="nan"))
    c = names["Constants"](**GOOD)
    u = np.array([[9.0, 0.1], [0, 0], [0, 0]])
    with np.errstate(all="raise", under="ignore"):
        m, n = names["loads"](u, np.array([[0], [0], [1.0]]), c)
        w = names["stored_energy"](u, np.array([[0], [0], [1.0]]), c)
    assert np.isnan(m[:, 0]).all()
    assert np.isnan(n[:, 0]).all()
    assert np.isnan(w[0])
    np.testing.assert_allclose(m[:, 1], rod.loads(u[:, 1], [0, 0, 1], C)[0], rtol=1e-15)
    assert w[1] == rod.stored_energy(u[:, 1], [0, 0, 1], C)
    assert "stiffness" not in names
    assert "compliance" not in names


@pytest.mark.parametrize(
    ("args", "out", "sentence"),
    [
        ((np.zeros(4), np.zeros(3)), None, "m must hold real numbers in the shape (3, ...)"),
        ((np.zeros(3), 1.0), None, "n must hold real numbers in the shape (3, ...)"),
        ((np.zeros(3, complex), np.zeros(3)), None, "not complex128 of shape (3,)"),
        ((np.zeros((3, 2)), np.zeros((3, 4))), None, "m (3, 2) and n (3, 4) do not broadcast"),
        ((np.zeros(3), np.zeros(3)), np.zeros(3), "out must be 2 arrays, for u and v"),
        (
            (np.zeros(3), np.zeros(3)),
            (np.zeros(3), np.zeros(4)),
            "out for v must be float64 of shape (3,)",
        ),
        ((np.zeros(3), np.zeros(3)), (np.zeros(3, "f4"), np.zeros(3)), "out for u must be float64"),
        ((np.zeros(3), np.zeros(3)), ([0, 0, 0], np.zeros(3)), "out for u must be float64"),
    ],
)
def test_wrong_shapes_get_a_sentence(args: tuple, out: object, sentence: str) -> None:
    with pytest.raises(ValueError, match=r".") as caught:
        rod.strains(*args, C, out=out)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_alone_with_numpy(tmp_path: Path) -> None:
    """The file alone, in a folder of its own, imports NumPy and the standard library only."""
    copy = tmp_path / "my_rod.py"
    copy.write_text(inspect.getsource(rod), "utf-8")
    site = Path(np.__file__).parent.parent
    program = (
        f"import sys; sys.path[:0] = [{str(tmp_path)!r}]; sys.path.append({str(site)!r})\n"
        "import my_rod, numpy as np\n"
        f"c = my_rod.Constants(**{GOOD!r})\n"
        "u, v = my_rod.strains([0, 0, 1], [0, 0, 1], c)\n"
        "assert np.allclose(my_rod.loads(u, v, c), [[0, 0, 1], [0, 0, 1]])\n"
        "bad = {'sympy', 'mpmath', 'scipy', 'rodproof', 'flint'} & set(sys.modules)\n"
        "assert not bad, bad\n"
    )
    subprocess.run([sys.executable, "-I", "-S", "-c", program], check=True, cwd=tmp_path)


def test_same_bytes_whatever_the_hash_seed(root: Path) -> None:
    program = (
        "import hashlib\n"
        "from rodproof.codegen import generate\n"
        "files = generate.everything()\n"
        "print({path: hashlib.sha256(text.encode()).hexdigest() for path, text in files.items()})\n"
    )
    runs = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "77")
    }
    assert len(runs) == 1


def test_committed_files_follow_from_the_source(root: Path) -> None:
    differences = generate.check(root / "generated", verdicts=ledger.recorded())
    assert [(d.path, d.kind) for d in differences] == []


def test_check_finds_changed_missing_and_stray(tmp_path: Path) -> None:
    generate.write(tmp_path)
    assert generate.check(tmp_path) == []
    (tmp_path / "scenes/full_rod.py").write_text("changed\n", "utf-8")
    (tmp_path / "scenes/__init__.py").unlink()
    (tmp_path / "scenes/old.py").write_text("", "utf-8")
    kinds = {d.path: d.kind for d in generate.check(tmp_path)}
    assert kinds == {
        "scenes/full_rod.py": "changed",
        "scenes/__init__.py": "missing",
        "scenes/old.py": "stray",
    }
    (changed, _, _) = sorted(generate.check(tmp_path), key=lambda d: d.kind)
    assert "-changed" in changed.diff


def test_own_scene_is_written_whole_or_not_at_all(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "law.py"
    files.write_text(path, generate.render(Scene("law", functions=("strains",))))
    before = path.read_text("utf-8")

    def refuse(self: Path, target: Path) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(OSError, match="disk full"):
        files.write_text(path, "half")
    assert path.read_text("utf-8") == before
    assert [p.name for p in tmp_path.iterdir()] == ["law.py"]


def test_text_is_fit_to_read() -> None:
    text = inspect.getsource(rod)
    assert max(map(len, text.splitlines())) <= 100
    assert text.isascii()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        compile(text, "full_rod.py", "exec")
    for function in HEADS:
        assert getattr(rod, function).__doc__


GENERATED = sorted(Path(rod.__file__).parents[1].glob("*/*.py"))


@pytest.mark.parametrize("path", GENERATED, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_nothing_is_set_or_defined_that_nothing_uses(path: Path) -> None:
    """Each name of a module's top is public or is used in the module."""
    tree = ast.parse(path.read_text("utf-8"))
    loads = (n for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load))
    used = {n.id for n in loads}
    for node in tree.body:
        names: list[str] = []
        if isinstance(node, ast.Assign):
            names = [n.id for n in ast.walk(node.targets[0]) if isinstance(n, ast.Name)]
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name.startswith("_"):
            names = [node.name]
        if names and not {*names} & used:
            pytest.fail(f"line {node.lineno}: nothing uses {', '.join(names)}")
