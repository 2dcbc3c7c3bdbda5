"""The plain bodies: where they answer, that they are right up to the edges of their regions."""

from __future__ import annotations

import inspect
import math
import random
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from tests.generated.test_accuracy import EXPONENTS, KERNELS, MODULES, MODULI, SCENES, Call, excess

from rodproof.codegen.kernel import Kernel
from rodproof.codegen.live import live

PLAIN = [(own, f) for own, kernels in KERNELS.items() for f, k in kernels.items() if k.plain]
#: Functions whose numbers are those of others, to the bit (test_scenes).
FUSED = ("loads_and_stiffness", "strains_and_gap")


def plain_of(own: str, function: str) -> Kernel:
    plain = KERNELS[own][function].plain
    assert plain is not None
    return plain


def given(own: str, c: dict[str, float]) -> dict[str, float]:
    """What the scene's record takes of the constants."""
    return {n: c[n] for n in inspect.signature(MODULES[own].Constants).parameters}


def constants(rng: random.Random, spread: float) -> dict[str, float]:
    c = {name: 10 ** rng.uniform(-spread, spread) for name in ("alpha", "beta", "zeta", "eta")}
    gap = 10 ** -rng.uniform(0, 15) if rng.random() < 0.5 else rng.uniform(0.1, 1)
    c["iota"] = rng.choice((-1, 1)) * c["beta"] * c["eta"] * (1 - gap)
    return c | {"gamma": 10 ** rng.uniform(-spread, spread), "p": rng.choice(EXPONENTS)}


def point_at(own: str, function: str, c: dict, square: float, rng: random.Random) -> list[float]:
    """Loads with Q*/gamma^2 near ``square``, or strains with Q near it."""
    at = live(SCENES[own]).loads
    chirality = c["iota"] / (c["beta"] * c["eta"]) if "iota" in given(own, c) else 0.0
    parts = [rng.gauss(0, 1) * rng.choice((0, 1, 1, 1)) if i in at else 0.0 for i in range(6)]
    parts[at[0]] += 0.5
    if KERNELS[own][function].limit and square < 1e-20:  # v3 cannot hold such a stretch
        parts[5] = 0.0
    across = math.fsum(part * part for k, part in enumerate(parts) if k not in (2, 5))
    if KERNELS[own][function].limit:
        along = (parts[2] + chirality * parts[5]) ** 2 + (1 - chirality**2) * parts[5] ** 2
        size = math.sqrt(square / (across + along))
        whole = [size * part / c[m] for part, m in zip(parts, MODULI, strict=True)]
        whole[5] += 1
    else:
        along = (parts[2] - chirality * parts[5]) ** 2 / (1 - chirality**2) + parts[5] ** 2
        size = c["gamma"] * math.sqrt(square / (across + along))
        whole = [size * part * c[m] for part, m in zip(parts, MODULI, strict=True)]
    return [whole[i] for i in at]


def answers(own: str, function: str, point: list[float], c: dict[str, float]) -> bool:
    """Whether the plain body takes the point."""
    module, left = MODULES[own], iter(point)
    body = getattr(module, f"_{function}_plain")
    names = list(inspect.signature(body).parameters)
    arrays = {n: np.full((*module.HEADS[n], 1), 7.5) for n in names if n != "c"}
    inputs = [arrays[n] for n in names[: names.index("c")]]
    for rows in map(np.atleast_2d, inputs):
        rows[:, 0] = [next(left) for _ in rows]
    outs = [arrays[n] for n in names[names.index("c") + 1 :]]
    with np.errstate(all="raise", under="ignore"):
        return bool(body(*inputs, module.Constants(**given(own, c)), *outs))


@pytest.mark.parametrize("own", dict.fromkeys(own for own, _ in PLAIN))
def test_constants_are_rounded_once(own: str) -> None:
    """Each is the float nearest to its exact value, iota next to beta eta included."""
    rng = random.Random(own)
    for _ in range(5):
        c = constants(rng, 3.0)
        try:
            record = MODULES[own].Constants(**given(own, c))
        except ValueError:
            continue
        whole = {s: sp.Rational(Fraction(getattr(record, s.name))) for s in _symbols(own, record)}
        for kernel in (k.plain for k in KERNELS[own].values() if k.plain):
            for a in kernel.constants:
                exact = sp.Rational(a.expr.xreplace(whole))
                assert getattr(record.plain, a.name) == float(Fraction(exact.p, exact.q)), a.name


def _symbols(own: str, record: object) -> set[sp.Symbol]:
    every = {
        s
        for kernel in KERNELS[own].values()
        if kernel.plain
        for a in kernel.plain.constants
        for s in a.expr.free_symbols
    }
    return {s for s in every if hasattr(record, s.name)}


@pytest.mark.parametrize(("own", "function"), PLAIN)
def test_it_answers_inside_its_region_alone(own: str, function: str) -> None:
    c = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 2.3, "p": 3.3}
    rng = random.Random(function)
    quantity = plain_of(own, function).region.quantity
    record = MODULES[own].Constants(**given(own, c))
    low, high = getattr(record.plain, f"within_{quantity}")[np.dtype(float)]
    seen = {**c, **{n: getattr(record, n) for n in given(own, c)}}
    for inside in (low * 1.01, 1e-20, 1e-3, 0.1, 0.5, min(high, 1024) * 0.99):
        assert answers(own, function, point_at(own, function, seen, inside, rng), c)
    for outside in (0.0, low * 0.99, high * 1.01, 1e200, math.inf, math.nan):
        assert not answers(own, function, point_at(own, function, seen, outside, rng), c)
    for name in given(own, c):
        wrong = {**c, name: 1e-120 if name in ("alpha", "gamma", "zeta") else c[name]}
        if wrong != c:
            point = point_at(own, function, {**seen, **wrong}, 0.1, rng)
            used = {s.name for a in plain_of(own, function).constants for s in a.expr.free_symbols}
            used |= {s.name for e in plain_of(own, function).expressions() for s in e.free_symbols}
            assert answers(own, function, point, wrong) == (name not in used)


@pytest.mark.parametrize(("own", "function"), [(o, f) for o, f in PLAIN if f not in FUSED])
def test_eight_ulps_up_to_the_edges(own: str, function: str) -> None:
    """Constants over forty orders, squares from one edge of the region to the other."""
    rng = random.Random(f"{own} {function}")
    quantity = plain_of(own, function).region.quantity
    taken = 0
    for _ in range(60 if own == "full_rod" else 12):
        c = constants(rng, rng.choice((0.5, 20.0)))
        try:
            record = MODULES[own].Constants(**given(own, c))
        except ValueError:
            continue
        low, high = getattr(record.plain, f"within_{quantity}")[np.dtype(float)]
        if not low < high:
            continue
        seen = {**c, **{n: getattr(record, n) for n in given(own, c)}}
        edge = rng.choice((low * 1.01, high * (1 - 10 ** -rng.uniform(1, 14)), None))
        square = edge or math.exp(rng.uniform(math.log(low), math.log(high)))
        point = point_at(own, function, seen, square, rng)
        try:
            worst = excess(Call(own, "arrays", function), point, given(own, c))
        except ValueError:  # rounding took the strains past the limit
            continue
        assert worst <= 8
        taken += answers(own, function, point, c)
    assert taken > 3
