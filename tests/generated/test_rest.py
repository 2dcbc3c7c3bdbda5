"""At rest every function of every scene answers, whatever the moduli: numbers, and no warning."""

from __future__ import annotations

import inspect
import itertools
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from rodproof.codegen import scene

SCENES = {name: scene.committed(name) for name in scene.committed_names()}
NUMBA = pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
WAYS = [(own, way, ()) for own in SCENES for way in ("arrays", "tuples")]
WAYS += [(own, "numba", NUMBA) for own, s in SCENES.items() if "numba" in s.targets]
CALLS = [
    pytest.param(own, way, function, id=f"{own}-{way}-{function}", marks=marks)
    for own, way, marks in WAYS
    for function in SCENES[own].functions
]
SIZES = (1e-100, 1.0, 1e100)


def rest(module: ModuleType, function: str, way: str) -> list[Any]:
    """No load, or no strain."""
    names = [n for n in inspect.signature(getattr(module, function)).parameters]
    given = []
    for name in names[: names.index("constants")]:
        value = np.zeros(module.HEADS[name])
        if name in ("v", "v3"):  # v3 is the last of them where it is live
            value[...] = 0.0
            value.reshape(-1)[-1] = 1.0
        given.append(value)
    if way == "tuples":
        return [tuple(a.tolist()) if a.ndim else float(a) for a in given]
    return given


@pytest.mark.parametrize(("own", "way", "function"), CALLS)
def test_rest_answers_with_moduli_of_any_size(own: str, way: str, function: str) -> None:
    folder = "numba" if way == "numba" else "scenes"
    module = import_module(f"rodproof.generated.{folder}.{own}")
    names = list(inspect.signature(module.Constants).parameters)
    at_rest, seen = rest(module, function, way), 0
    for sizes, p in itertools.product(itertools.product(SIZES, repeat=4), (0.3, 2.0, 1000.0)):
        c = dict(zip(("alpha", "beta", "zeta", "eta"), sizes, strict=True))
        c |= {"iota": 0.0, "gamma": 0.77, "p": p}
        constants = module.Constants(**{name: c[name] for name in names})
        with np.errstate(all="raise", under="ignore"):
            got = getattr(module, function)(*at_rest, constants)
        for part in got if isinstance(got, tuple) else (got,):
            assert np.isfinite(np.asarray(part, float)).all(), constants
            seen += 1
    assert seen
