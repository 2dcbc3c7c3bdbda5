"""Blocks do not show: whatever stands beside a point, its answer is that of the point alone.

The block length is made small, so that few points make many blocks: some of them with squares that
overflow or underflow, which take the scaled path, and some without.
"""

from __future__ import annotations

import math
import sys
import threading
import types

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodproof.codegen import generate, scene
from rodproof.codegen.scene import Scene
from rodproof.codegen.texts import function_text

FULL = scene.committed("full_rod")
GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}
MODULI = np.array([0.7, 0.7, 1.1, 0.9, 0.9, 1.6])
BLOCK = 8
KERNELS = {kernel.name: kernel for kernel in generate.kernels(FULL)}
FUNCTIONS = tuple(KERNELS)
#: Sizes of loads, and of strains by their Q^(1/2), from rest to the edge.
SIZES = {"f8": (0, 1e-308, 1e-200, 1e-160, 1e-3, 1, 20, 1e90, 1e160, 1e300)}
SIZES["f4"] = (0, 1e-38, 1e-25, 1e-20, 1e-3, 1, 20, 1e10, 1e20, 1e35)
RADII = {"f8": (0, 1e-308, 1e-200, 1e-160, 1e-8, 0.1, 0.5, 0.9, 0.999)}
RADII["f4"] = (0, 1e-38, 1e-25, 1e-20, 1e-4, 0.1, 0.5, 0.9, 0.99)


def module_of(own: Scene, block: int) -> types.ModuleType:
    module = types.ModuleType(own.name)
    sys.modules[own.name] = module
    try:
        exec(generate.render(own), module.__dict__)
    finally:
        del sys.modules[own.name]
    module.BLOCK = block
    return module


MODULES = {
    layout: module_of(Scene(f"blocks_{layout}", functions=FULL.functions, layout=layout), BLOCK)
    for layout in ("first", "last")
}
WHOLE = module_of(FULL, 10**6)


def points(function: str, sizes: list[float], dtype: str, seed: int) -> tuple:
    """Inputs with the given sizes, components first."""
    directions = np.random.default_rng(seed).normal(size=(6, len(sizes)))
    directions *= np.random.default_rng(seed + 1).choice([0, 1, 1, 1e-9], directions.shape)
    if KERNELS[function].inputs[0] == "m1":
        whole = directions * sizes
    else:  # Q is at most twice the sum of the reduced squares
        length = np.sqrt(2 * (directions**2).sum(0))
        whole = directions / np.where(length, length, 1) / MODULI[:, None] * sizes
        whole[5] += 1
    whole = whole.astype(dtype)
    return whole[:3], whole[3:]


def answers(module: types.ModuleType, function: str, args: tuple, **kw: object) -> list:
    with np.errstate(all="raise", under="ignore"):
        got = getattr(module, function)(*args, module.Constants(**GOOD), **kw)
    return list(got) if isinstance(got, tuple) else [got]


@st.composite
def mixtures(draw: st.DrawFn) -> tuple[str, str, list[float], int]:
    """A function, a type, and sizes whose number is at or around a multiple of the block."""
    function, dtype = draw(st.sampled_from(FUNCTIONS)), draw(st.sampled_from(("f8", "f4")))
    table = (SIZES if KERNELS[function].inputs[0] == "m1" else RADII)[dtype]
    if function == "stiffness_at_loads":  # it grows as y^(p + 1), out of the range of numbers
        table = [size for size in table if size < 1e3]
    count = draw(st.sampled_from((1, 2, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK, 2 * BLOCK + 3)))
    kinds = draw(st.lists(st.sampled_from(table), min_size=1, max_size=4))
    sizes = [kinds[k * len(kinds) // count] for k in range(count)]
    return function, dtype, sizes, draw(st.integers(0, 10**6))


def close(got: np.ndarray, want: np.ndarray, heads: int) -> None:
    """Normwise at each point; to a few ulps, as a scaled block rounds elsewhere."""
    axes = tuple(range(heads))
    scale = np.abs(want).max(axis=axes) if axes else np.abs(want)
    smallest = 4 * np.finfo(want.dtype).tiny
    with np.errstate(all="ignore"):
        assert (np.abs(got - want) <= 16 * np.finfo(want.dtype).eps * scale + smallest).all()


@settings(max_examples=150)
@given(case=mixtures(), layout=st.sampled_from(("first", "last")))
def test_a_point_in_a_block_is_the_point_alone(case: tuple, layout: str) -> None:
    function, dtype, sizes, seed = case
    args = points(function, sizes, dtype, seed)
    module, heads = MODULES[layout], function_text(KERNELS[function], FULL).outputs.values()
    given_ = args if layout == "first" else tuple(a.T for a in args)
    got = answers(module, function, given_)
    for k in range(len(sizes)):
        alone = answers(WHOLE, function, tuple(a[:, k] for a in args))
        for whole, one, head in zip(got, alone, heads, strict=True):
            mine = whole[..., k] if layout == "first" else whole[k]
            assert mine.dtype == dtype
            close(mine, one, len(head))


@pytest.mark.parametrize("function", FUNCTIONS)
@pytest.mark.parametrize("count", [BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK - 1])
def test_results_over_inputs_and_reused(function: str, count: int) -> None:
    """``out`` that shares memory with the inputs, or is strided, holds what a new array does."""
    args = points(function, [0.3] * count, "f8", 5)
    want = answers(MODULES["first"], function, args)
    for strided in (False, True):
        out = [np.empty((*w.shape, 2 if strided else 1))[..., 0] for w in want]
        given_ = [a.copy() for a in args]
        for k, (o, a) in enumerate(zip(out, given_, strict=False)):
            if o.shape == a.shape and not strided:  # results swapped with the inputs
                out[k] = given_[1 - k]
        got = answers(
            MODULES["first"], function, given_, out=tuple(out) if len(out) > 1 else out[0]
        )
        assert all(a is b for a, b in zip(got, out, strict=True))
        assert all(np.array_equal(a, b) for a, b in zip(got, want, strict=True))


def test_limit_is_found_in_any_block() -> None:
    """The error counts points over all blocks and names the first."""
    u, v = points("loads", [0.5] * (3 * BLOCK), "f8", 3)
    u[0, [BLOCK + 2, 2 * BLOCK + 1]] = 9
    with pytest.raises(ValueError, match=rf"2 of {3 * BLOCK} do not, the first at index \({BLOCK + 2},"):
        answers(MODULES["first"], "loads", (u, v))


def test_limit_as_nan_in_any_block() -> None:
    soft = module_of(Scene("soft", functions=("loads", "stiffness"), at_limit="nan"), BLOCK)
    u, v = points("loads", [0.5] * (3 * BLOCK), "f8", 3)
    good = answers(soft, "loads", (u, v))
    u[0, BLOCK + 2] = 9
    v[1, -1] = math.nan
    got = answers(soft, "loads", (u, v))
    bad = np.isin(np.arange(3 * BLOCK), (BLOCK + 2, 3 * BLOCK - 1))
    for mine, want in zip(got, good, strict=True):
        assert np.isnan(mine[:, bad]).all()
        # a block with such a point in it is worked on with care throughout
        np.testing.assert_allclose(mine[..., ~bad], want[..., ~bad], rtol=1e-12, atol=1e-15)


def test_threads_do_not_meet() -> None:
    """Scratch belongs to the thread."""
    module = MODULES["first"]
    cases = [points("compliance", [10.0**k] * 200, "f8", k) for k in range(4)]
    want = [answers(module, "compliance", case) for case in cases]
    wrong: list[int] = []

    def work(k: int) -> None:
        for _ in range(5):
            got = answers(module, "compliance", cases[k])
            if not all(np.array_equal(a, b) for a, b in zip(got, want[k], strict=True)):
                wrong.append(k)

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong
