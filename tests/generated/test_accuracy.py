"""Errors in ulps against the kernel's own oracle, where the conditioning is hardest.

Components are made comparable by the moduli on K's diagonal, strains times them and loads over
them, and errors are normwise in that. Taken off are half an ulp of v3, which holds 1 + (v3 - 1),
and what one ulp of every input does to the true value. For functions of the loads only the loads
count as inputs, so that near iota = beta eta the constants excuse nothing; for functions of the
strains the constants count too, as near the limit they decide how far away it is; so they do for
the stiffness at loads, which grows with the power p of load over gamma.
"""

from __future__ import annotations

import inspect
import math
import random
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

import mpmath
import numpy as np
import pytest

from rodproof.codegen import generate, scene
from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import groups, live
from rodproof.codegen.targets.mpmath_target import Evaluator
from rodproof.generated.scenes import full_rod as rod

DIGITS = 130
MP = mpmath.mp.clone()
MP.dps = DIGITS
SCENES = {name: scene.committed(name) for name in scene.committed_names()}
KERNELS = {name: {k.name: k for k in generate.kernels(s)} for name, s in SCENES.items()}
MODULES = {name: import_module(f"rodproof.generated.scenes.{name}") for name in SCENES}
NUMBA = pytest.mark.skipif(find_spec("numba") is None, reason="numba is not installed")
WAYS = [(name, "arrays", ()) for name in SCENES]
WAYS += [(name, "tuples", ()) for name in ("full_rod", "full_rod_p2", "dsdna", "thrust")]
WAYS += [(name, "numba", NUMBA) for name, own in SCENES.items() if "numba" in own.targets]
CALLS = [
    pytest.param(own, way, function, kind, id=f"{own}-{way}-{function}-{kind}", marks=marks)
    for own, way, marks in WAYS
    for function in KERNELS[own]
    if function not in ("loads_and_stiffness", "strains_and_gap")  # the parts: test_scenes.py
    for kind in ("chiral edge", "moduli", "gamma")
    if kind != "chiral edge" or "iota" in inspect.signature(MODULES[own].Constants).parameters
]
MODULI = ("alpha", "alpha", "beta", "zeta", "zeta", "eta")
POWER = {"strains": 1, "compliance": 1, "loads": -1, "stiffness": -1, "stiffness_at_loads": -1}
EXPONENTS = (0.3, 0.5, 0.7, 1 - 1e-10, 1.0, 1 + 1e-10, 2.0, 3.3, 40.0, 1000.0)


@dataclass(frozen=True)
class Call:
    """A function of a scene; points and values are lists by live components."""

    own: str
    way: str
    function: str

    @property
    def kernel(self) -> Kernel:
        return KERNELS[self.own][self.function]

    @property
    def components(self) -> tuple[int, ...]:
        """Of what is returned."""
        at = live(SCENES[self.own])
        return at.strains if self.function == "strains" else at.loads

    def answer(self, point: list[float], constants: dict) -> np.ndarray:
        """What the module says, flat; the entries on and above the diagonal of a matrix."""
        module, at = module_of(self.own, self.way), live(SCENES[self.own]).loads
        parts = groups("uv" if self.kernel.limit else "mn", at)
        given = [[point[at.index(i)] for i in g.components] for g in parts]
        given = [value if g.head else value[0] for g, value in zip(parts, given, strict=True)]
        if self.way == "tuples":
            given = [tuple(value) if isinstance(value, list) else value for value in given]
        got = getattr(module, self.function)(*given, module.Constants(**constants))
        matrix = len(self.kernel.outputs[0].index) == 2
        got = got if isinstance(got, tuple) and not matrix else (np.asarray(got),)
        flat = np.concatenate([np.atleast_1d(g) for g in got])
        return flat[np.triu_indices(len(flat))] if flat.ndim == 2 else flat


def module_of(own: str, way: str) -> ModuleType:
    """The module that is called in a way."""
    return import_module(f"rodproof.generated.numba.{own}") if way == "numba" else MODULES[own]


def true_value(call: Call, point: list[Any], constants: dict) -> list[Any]:
    inputs = dict(zip(call.kernel.inputs, point, strict=True))
    value = list(Evaluator(DIGITS).evaluate(call.kernel, inputs, constants).values())
    if call.function == "strains" and 5 in call.components:
        value[call.components.index(5)] -= 1
    return value


def length(call: Call, values: list[Any], constants: dict) -> Any:
    if call.function.endswith("energy"):
        return abs(values[0])
    w = [MP.mpf(constants[MODULI[i]]) ** POWER[call.function] for i in call.components]
    if call.function in ("stiffness", "compliance", "stiffness_at_loads"):
        pairs = [(i, j) for i in range(len(w)) for j in range(i, len(w))]
        w = [w[i] * w[j] * (1 if i == j else MP.sqrt(2)) for i, j in pairs]
    return MP.sqrt(MP.fsum((a * b) ** 2 for a, b in zip(values, w, strict=True)))


def excess(call: Call, point: list[float], constants: dict) -> float:
    """Ulps of error beyond the conditioning."""
    true = true_value(call, point, constants)
    with np.errstate(all="raise", under="ignore"):
        if max(map(abs, true)) > np.finfo(float).max:
            try:
                got = call.answer(point, constants)
            except FloatingPointError as error:
                assert "overflow" in str(error)
            else:  # neither compiled code nor plain Python sets flags
                assert call.way != "arrays" and not np.isfinite(got).all()
            return 0.0
        flat = call.answer(point, constants)
    off = [abs(MP.mpf(float(g)) - t) for g, t in zip(flat, true, strict=True)]
    if call.function == "strains" and 5 in call.components:
        k = call.components.index(5)
        off[k] = abs(MP.mpf(float(flat[k])) - 1 - true[k]) - abs(1 + true[k]) * MP.mpf(2) ** -53
    off = [max(d - MP.mpf(2) ** -1022, MP.zero) for d in off]
    error = float(length(call, off, constants) / length(call, true, constants) * 2**52)
    return error - conditioning(call, point, constants, true) if error > 8 else error


def conditioning(call: Call, point: list[float], constants: dict, true: list[Any]) -> float:
    step = MP.mpf(10) ** -60
    exact = [MP.mpf(value) for value in point]
    total = MP.zero

    def change(moved: list[Any], moved_constants: dict) -> Any:
        new = true_value(call, moved, moved_constants)
        return length(call, [a - b for a, b in zip(new, true, strict=True)], constants)

    for k, value in enumerate(exact):
        part = value - 1 if call.kernel.inputs[k] == "v3" else value
        if part:
            moved = [*exact[:k], value + part * step, *exact[k + 1 :]]
            total += change(moved, constants) * abs(value / part)
    if call.kernel.limit or call.function == "stiffness_at_loads":
        for name, value in constants.items():
            total += change(exact, {**constants, name: MP.mpf(value) * (1 + step)})
    return float(total / step / length(call, true, constants))


def constants_of(kind: str, rng: random.Random) -> dict:
    """Constants that are right, of the kind: chiral edge, moduli or gamma far from 1."""
    spread = {"chiral edge": 0.5, "moduli": 100.0, "gamma": 0.5}[kind]
    while True:
        c = {name: 10 ** rng.uniform(-spread, spread) for name in ("alpha", "beta", "zeta", "eta")}
        gap = 10 ** -rng.uniform(0, 15) if kind == "chiral edge" else rng.uniform(0.1, 1)
        c["iota"] = rng.choice((-1, 1)) * c["beta"] * c["eta"] * (1 - gap)
        c["gamma"] = 10 ** rng.uniform(-200, 200) if kind == "gamma" else 10 ** rng.uniform(-2, 2)
        c["p"] = rng.choice(EXPONENTS)
        try:
            rod.Constants(**c)
        except ValueError:
            continue
        return c


def load_point(c: dict, rng: random.Random) -> list[float]:
    """Of any size from 1e-160 to 1e160, or near gamma; components of mixed size, some zero."""
    parts = [rng.gauss(0, 1) * rng.choice((0, 1, 1, 1, 1e-9)) for _ in range(6)]
    if rng.random() < 0.5:
        size = 10 ** rng.uniform(-160, 160)
        return [size * part for part in parts]
    size = c["gamma"] * 10 ** rng.uniform(-3, 6)
    return [size * part * c[name] for part, name in zip(parts, MODULI, strict=True)]


def strain_point(c: dict, rng: random.Random) -> list[float]:
    """With x from 1e-8 up to a distance of 1e-15 from the limit, often in the soft direction."""
    chirality = c["iota"] / (c["beta"] * c["eta"])
    while True:
        parts = [rng.gauss(0, 1) * rng.choice((0, 1, 1, 1, 1e-9)) for _ in range(6)]
        if rng.random() < 0.3:
            parts[2] = -chirality * parts[5]
        q = math.fsum(part * part for part in parts) + 2 * chirality * parts[2] * parts[5]
        if q > 0:
            break
    near = math.sqrt(1 - 10 ** -rng.uniform(0, 15))
    x = near if rng.random() < 0.5 else 10 ** rng.uniform(-8, 0)
    scaled = [x / math.sqrt(q) * part / c[m] for part, m in zip(parts, MODULI, strict=True)]
    return [*scaled[:5], 1 + scaled[5]]


@pytest.mark.parametrize(("own", "way", "function", "kind"), CALLS)
def test_eight_ulps_beyond_conditioning(own: str, way: str, function: str, kind: str) -> None:
    rng = random.Random(f"{function} {kind}")
    call, at = Call(own, way, function), live(SCENES[own]).loads
    names = inspect.signature(MODULES[own].Constants).parameters
    worst = 0.0
    for _ in range(40 if (own, way) == ("full_rod", "arrays") else 6):
        c = constants_of(kind, rng)
        c |= {} if "iota" in names else {"iota": 0.0}
        limited = call.kernel.limit is not None
        whole = strain_point(c, rng) if limited else load_point(c, rng)
        point = [whole[i] for i in at]
        if all(value in (0, 1) for value in point):
            continue
        try:
            worst = max(worst, excess(call, point, {n: c[n] for n in names}))
        except ValueError:  # rounding took the strains past the limit
            assert limited
    assert worst <= 8


@pytest.mark.parametrize("p", EXPONENTS)
def test_share_of_the_work(p: float) -> None:
    """The energy primitive on its own: depth over its whole range and both sides of the split."""
    constants = {"alpha": 1, "beta": 1, "zeta": 1, "eta": 1, "iota": 0, "gamma": 1}
    c = rod.Constants(**constants, p=p)
    near = [math.log(9) * (1 + k * 1e-15) for k in range(-3, 4)]
    depths = [*(10.0 ** -np.arange(1, 18, 2)), *np.linspace(0.1, 3, 25), *near, 5.0, 12.0, 30.0]
    share = rod._work_share(np.array(depths), c)
    mp = mpmath.mp.clone()
    mp.dps = 40
    for depth, got in zip(depths, share, strict=True):
        a = 1 / mp.mpf(p)
        true = mp.hyp2f1(1, a, 1 + 2 * a, -mp.expm1(mp.mpf(depth))) / 2
        # an ulp of the depth moves exp(-depth/p) by depth/p ulps
        assert abs(mp.mpf(got) - true) / true * 2**52 < 6 + depth * max(1, 1 / p) / 2
    assert rod._work_share(np.zeros(1), c) == 0.5


def test_share_by_its_definition() -> None:
    """The hypergeometric oracle is the quadrature of the definition."""
    kernel = KERNELS["full_rod"]["stored_energy"]
    point = dict(zip(kernel.inputs, (0.3, -0.2, 0.1, 0.2, 0.4, 1.3), strict=True))
    for p in (0.7, 1.0, 2.0, 3.3):
        constants = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.2, "iota": -0.4, "gamma": 2}
        constants["p"] = p
        fast = Evaluator(40).evaluate(kernel, point, constants)["w", ()]
        slow = Evaluator(40, quadrature=True).evaluate(kernel, point, constants)["w", ()]
        assert abs(fast - slow) < fast * MP.mpf(10) ** -36
