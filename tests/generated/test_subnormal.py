"""Strains and loads so small that their products with the moduli round as subnormal numbers do.

The answers need not be small: gamma and the moduli bring them back among the normal numbers. The
inputs are taken as they stand, exactly, and the error is measured in ulps of each array's largest
component.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rodproof.codegen import generate, scene
from rodproof.codegen.live import groups, live
from rodproof.codegen.targets.mpmath_target import Evaluator
from rodproof.generated.scenes import full_rod

NAMES = ("full_rod", "full_rod_p2", "dsdna", "kirchhoff", "planar")
SCENES = {name: scene.committed(name) for name in NAMES}
KERNELS = {name: {k.name: k for k in generate.kernels(own)} for name, own in SCENES.items()}
NUMBA = pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
WAYS = [pytest.param(name, way, id=f"{name}-{way}") for name in NAMES for way in ("arrays", "tuples")]
WAYS += [pytest.param(name, "numba", id=f"{name}-numba", marks=NUMBA) for name in NAMES[:2]]
ULPS = 8
GOOD = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "p": 3.3}

tenth = st.integers(-319, -285).map(lambda k: 10.0**k)
component = st.one_of(st.just(0.0), st.builds(lambda a, b: a * b, st.floats(-1, 1), tenth))
points = st.lists(component, min_size=6, max_size=6)


def module_of(own: str, way: str) -> ModuleType:
    folder = "numba" if way == "numba" else "scenes"
    return import_module(f"rodproof.generated.{folder}.{own}")


def excess(module: ModuleType, own: str, way: str, function: str, point: list, gamma: float) -> float:
    """Ulps of the largest component, array by array, above one unit of the smallest number."""
    kernel, at = KERNELS[own][function], live(SCENES[own]).loads
    names = module.Constants.__dataclass_fields__
    values = {k: v for k, v in {**GOOD, "gamma": gamma}.items() if k in names and names[k].init}
    c = module.Constants(**values)
    known = {name: getattr(c, name) for name in (*GOOD, "gamma") if name in names}
    letters = "uv" if kernel.limit else "mn"
    whole = [*point[:5], 1.0] if kernel.limit else point
    parts = groups(letters, at)
    given_ = [[whole[i] for i in g.components] for g in parts]
    if way == "tuples":
        args: list[Any] = [tuple(g) if len(g) > 1 else g[0] for g in given_]
    else:
        args = [np.array(g) if len(g) > 1 else np.array(g[0]) for g in given_]
    with np.errstate(all="raise", under="ignore"):
        got = getattr(module, function)(*args, c)
    got = got if isinstance(got, tuple) and len({o.array for o in kernel.outputs}) > 1 else (got,)
    inputs = dict(zip(kernel.inputs, (whole[i] for i in at), strict=True))
    truth = Evaluator(60).evaluate(kernel, inputs, known)
    worst = 0.0
    for array, answer in zip(dict.fromkeys(o.array for o in kernel.outputs), got, strict=True):
        true = [v for (name, _), v in truth.items() if name == array]
        largest = max(map(abs, true))
        for a, b in zip(np.ravel(answer).tolist(), true, strict=True):
            left = abs(b - a) - 2.0**-1073
            worst = max(worst, float(left / largest * 2**52) if left > 0 else 0.0)
    return worst


@pytest.mark.parametrize("function", ["strains", "loads"])
@pytest.mark.parametrize(("own", "way"), WAYS)
def test_subnormal_inputs_lose_nothing(own: str, way: str, function: str) -> None:
    """At any gamma the answers are those of the inputs as they stand."""
    module = module_of(own, way)

    @settings(max_examples=15, deadline=None)
    @given(point=points, power=st.integers(-25, 60))
    def held(point: list[float], power: int) -> None:
        gamma = 10.0**-power if function == "strains" else 10.0**power
        assert excess(module, own, way, function, point, gamma) <= ULPS

    held()


def test_without_a_scale_they_would(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same with products of the inputs as they are, which round: 1e6 ulps and more."""

    def plain(form: Any, inputs: Any, c: Any) -> tuple:
        *values, square = form(inputs, c)
        return values, square, 1.0, square

    point = [1.3e-316, 0.0, -4.1e-317, 0.0, 2.2e-316, 0.0]
    assert excess(full_rod, "full_rod", "arrays", "loads", point, 1e20) <= ULPS
    assert excess(full_rod, "full_rod", "arrays", "strains", point, 1e-20) <= ULPS
    monkeypatch.setattr(full_rod, "_rescaled", plain)
    assert excess(full_rod, "full_rod", "arrays", "loads", point, 1e20) > 1e6
    assert excess(full_rod, "full_rod", "arrays", "strains", point, 1e-20) > 1e6
