"""Where the stability atlas looks: three maps for each function, from corner to corner.

limit    the exponent p across, and how far the limit is up: Q from 1e-300 to 1 - 1e-15 for
         functions of strains, y/gamma from 1e-160 to 1e160 for those of loads
load     gamma across, and the size of the load up, from zero and the subnormal numbers on; for
         functions of strains the strain that it causes, which may round to the limit or past it
moduli   the relative gap 1 - |iota|/(beta eta) across, from 1 to 1e-15, and the scale of the
         moduli up, from 1e-100 to 1e100

A scene without coupling has p across its moduli, one with a fixed p the gap across its limit.
Single precision has the same maps with its own ends. A spot is a place on a map with one of a few
random choices of what the map leaves open; its name is enough to find it again.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import nextafter

import numpy as np
from flint import arb

from rodproof.codegen.measure import oracle
from rodproof.codegen.measure.inputs import Array, Batch, coupling, inside, only, strain_along
from rodproof.codegen.measure.subjects import Subject, subject

SEED = 20240607
DTYPES: dict[str, type[np.floating]] = {"float64": np.float64, "float32": np.float32}
MAPS = ("limit", "load", "moduli")

EXPONENTS: tuple[float, ...] = (
    0.3,
    0.5,
    0.7,
    0.95,
    1 - 1e-6,
    1 - 1e-10,
    1.0,
    1 + 1e-10,
    1 + 1e-6,
    1.5,
    2.0,
    3.3,
)
EXPONENTS = (*EXPONENTS, 8.0, 40.0, 200.0, 1000.0)
NEAR = (3, 6, 9, 12, 14, 15)  # Q = 1 - 10^-k
FORMS = (1e-300, 1e-160, 1e-80, 1e-30, 1e-12, 1e-6, 1e-2, 0.5, 0.9)
REACHES: tuple[float, ...] = (
    -160.0,
    -80.0,
    -30.0,
    -8.0,
    -4.0,
    -2.0,
    -0.5,
    0.0,
    0.5,
    2.0,
    4.0,
    8.0,
    15.0,
)
REACHES = (*REACHES, 30.0, 80.0, 160.0)
GAMMAS = (-100.0, -50.0, -20.0, -8.0, -3.0, 0.0, 3.0, 8.0, 20.0, 50.0, 100.0)
SIZES: tuple[float, ...] = (-np.inf, -323.3, -310.0, -160.0, -100.0, -50.0, -20.0, -8.0, -3.0, 0.0)
SIZES = (*SIZES, 3.0, 8.0, 20.0, 50.0, 100.0, 160.0)
GAPS = (0, 0.3, 1, 2, 4, 6, 8, 10, 12, 14, 15)  # 1 - |iota|/(beta eta) = 10^-k
SCALES = (-100.0, -50.0, -10.0, 0.0, 10.0, 50.0, 100.0)
#: What is left of these in single precision: exponents of ten by eight, gaps by half.
SINGLE, HALF = 8.0, 2.0


@dataclass(frozen=True)
class Axis:
    """The places of a map in one direction, as numbers and as a reader sees them."""

    name: str
    values: tuple[float, ...]
    labels: tuple[str, ...]


@dataclass(frozen=True)
class Spot:
    """A place on a map of a scene's function, and one of the choices there."""

    scene: str
    function: str
    precision: str
    chart: str
    column: int
    row: int
    choice: int

    @property
    def name(self) -> str:
        """``full_rod.strains.float64.limit.3.7.0``."""
        place = f"{self.column}.{self.row}.{self.choice}"
        return f"{self.scene}.{self.function}.{self.precision}.{self.chart}.{place}"

    @property
    def dtype(self) -> type[np.floating]:
        return DTYPES[self.precision]

    @cached_property
    def point(self) -> Batch:
        """The constants and the point."""
        return _point(self)


def named(name: str) -> Spot:
    """The spot of that name; ValueError if there is none."""
    parts = name.split(".")
    try:
        scene, function, precision, chart, *numbers = parts
        column, row, choice = map(int, numbers)
        spot = Spot(scene, function, precision, chart, column, row, choice)
        across, up = axes(subject(scene), function, precision, chart)
        known = function in subject(scene).functions and precision in DTYPES and chart in MAPS
        if not (known and 0 <= column < len(across.values) and 0 <= row < len(up.values)):
            raise ValueError(name)
    except ValueError:
        wanted = "SCENE.FUNCTION.PRECISION.MAP.COLUMN.ROW.CHOICE"
        raise ValueError(f"no spot of the atlas is called {name!r}; a name is {wanted}") from None
    return spot


def axes(one: Subject, function: str, precision: str, chart: str) -> tuple[Axis, Axis]:
    """What a map has across and up."""
    single = precision == "float32"
    by = SINGLE if single else 1.0
    exponents = Axis("p", EXPONENTS, tuple(map(_exponent_label, EXPONENTS)))
    shares = tuple(k / HALF for k in GAPS) if single else GAPS
    gaps = Axis(
        "1 - |iota|/(beta eta)",
        tuple(10.0**-k for k in shares),
        tuple(map(_power, np.negative(shares))),
    )
    across = exponents if "p" in one.constants else gaps
    if chart == "limit" and one.side(function) == "strains":
        near = [k / HALF if single else k for k in NEAR]
        forms = [form ** (1 / by) if form < 1e-7 else form for form in FORMS]
        labels = (*(f"{form:.0e}" if form < 0.01 else f"{form:g}" for form in forms),)
        labels += tuple(f"1-1e-{k:g}" for k in near)
        return across, Axis("Q", (*forms, *(1 - 10.0**-k for k in near)), labels)
    if chart == "limit":
        return across, _powers("y/gamma", [k / by if abs(k) > 8 else k for k in REACHES])
    if chart == "load":
        sizes = [k / by for k in SIZES]
        return _powers("gamma", [k / by for k in GAMMAS]), _powers("|load|", sizes)
    return (gaps if one.coupled else exponents), _powers("moduli", [k / by for k in SCALES])


def _powers(name: str, exponents: list[float]) -> Axis:
    values = tuple(0.0 if k == -np.inf else float(10.0**k) for k in exponents)
    return Axis(name, values, tuple("0" if k == -np.inf else _power(k) for k in exponents))


def _power(exponent: float) -> str:
    return "1" if exponent == 0 else f"1e{exponent:.3g}"


def _exponent_label(p: float) -> str:
    return f"{p:g}" if abs(p - 1) > 1e-5 or p == 1 else f"1{p - 1:+.0e}"


def spots(one: Subject, function: str, precision: str, *, coarse: int, choices: int) -> list[Spot]:
    """Every spot of a function, or every ``coarse``-th place in both directions."""
    found = []
    for chart in MAPS:
        across, up = axes(one, function, precision, chart)
        found += [
            Spot(one.name, function, precision, chart, column, row, choice)
            for row in range(0, len(up.values), coarse)
            for column in range(0, len(across.values), coarse)
            for choice in range(choices)
        ]
    return found


@oracle.exactly
def _point(spot: Spot) -> Batch:
    one = subject(spot.scene)
    across, up = axes(one, spot.function, spot.precision, spot.chart)
    at = {across.name: across.values[spot.column], up.name: up.values[spot.row]}
    rng = np.random.default_rng(
        [SEED, MAPS.index(spot.chart), spot.column, spot.row, spot.choice, one.coupled]
    )
    constants = _constants(spot, one, at, rng)
    for _ in range(40):  # near the limit rounding may take a strain past it: try other directions
        direction = only(_direction(rng), one.loads)
        size = float(np.linalg.norm(direction))
        if not size:
            continue
        row = _row(spot, one, at, constants, direction / size, rng)
        if one.side(spot.function) == "loads" or inside(constants, row):
            break
    return Batch(constants, row[:3, None], row[3:, None])


def _constants(
    spot: Spot, one: Subject, at: dict[str, float], rng: np.random.Generator
) -> tuple[float, ...]:
    """What the map says, and the rest in its middle; in numbers of the precision."""
    dtype = spot.dtype
    alpha, beta, zeta, eta = (float(10 ** rng.uniform(-0.5, 0.5)) for _ in "abcd")
    scale = at.get("moduli", 1.0)
    alpha, beta = alpha * scale, beta * scale
    other = 1 / scale if spot.choice % 2 else scale  # all alike, or lengths against plain numbers
    zeta, eta = zeta * other, eta * other
    p = at.get("p", float(rng.choice([0.7, 2.4, 11.0])))
    gap = at.get("1 - |iota|/(beta eta)", rng.uniform(0.1, 1))
    sign = float(rng.choice([-1, 1]))
    alpha, beta, zeta, eta = (float(dtype(x)) for x in (alpha, beta, zeta, eta))
    iota = float(dtype(sign * (1 - gap) * beta * eta))
    gamma = float(dtype(at.get("gamma", float(10 ** rng.uniform(-1, 1)))))
    drawn = one.restricted((alpha, beta, zeta, eta, iota, gamma, float(p)))
    while not oracle.Constants(*map(arb, drawn)).gap > 0:  # rounded away
        toward = nextafter if dtype is np.float64 else lambda a, b: float(np.nextafter(dtype(a), b))
        iota = toward(drawn[4], 0.0)
        drawn = (*drawn[:4], float(dtype(iota)), *drawn[5:])
    return drawn


def _direction(rng: np.random.Generator) -> Array:
    """Whitened, often with parts that are missing, tiny, or the coupled pair alone."""
    w = rng.normal(size=6)
    fate = rng.random()
    if fate < 0.2:
        w *= np.isin(np.arange(6), (2, 5))
    elif fate < 0.5:
        w *= np.where(rng.random(6) < 0.25, 0.0, 10 ** rng.choice([0.0, 0.0, -9.0], size=6))
    return w


def _row(
    spot: Spot,
    one: Subject,
    at: dict[str, float],
    constants: tuple[float, ...],
    direction: Array,
    rng: np.random.Generator,
) -> Array:
    """The six numbers of the point."""
    gamma, p = constants[5:]
    load = only(coupling(constants) @ direction, one.loads)
    if one.side(spot.function) == "loads":
        if "|load|" in at:
            return (load / np.abs(load).max() * at["|load|"]).astype(spot.dtype)
        reach = at.get("y/gamma", float(10 ** rng.uniform(-2, 2)))
        return (load * (gamma * reach)).astype(spot.dtype)
    if "|load|" in at:
        reach = at["|load|"] / float(np.abs(load).max()) / gamma
        x = (1 + reach**-p) ** (-1 / p) if reach > 1 else reach * (1 + reach**p) ** (-1 / p)
    else:
        x = at["Q"] ** 0.5 if "Q" in at else rng.uniform(0.05, 0.95)
    strain = strain_along(constants, direction * x)
    strain = -strain if strain[5] <= -1 else strain
    return (strain + np.eye(6)[5]).astype(spot.dtype)
