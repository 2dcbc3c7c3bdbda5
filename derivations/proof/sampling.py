"""Points: generic rational constants, loads and strains by seed, and small ones by hand.

Generic means that no formula can pass by accident: p is not an integer, gamma is not 1, iota is
not 0 and has both signs, the loads have mixed signs and no two constants agree.
"""

from __future__ import annotations

import itertools
import random
from functools import cache

import sympy as sp

from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, beta, chiral_gap, eta, iota, p
from rodproof.derivations.theory.constitutive import quadratic_form

Point = dict[sp.Symbol, sp.Rational]


def _rational(rng: random.Random, low: float, high: float) -> sp.Rational:
    return sp.Rational(rng.randint(int(low * 997), int(high * 997)), 997)


@cache
def _constants(seed: int) -> tuple[tuple[sp.Symbol, sp.Rational], ...]:
    rng = random.Random(f"constants {seed}")
    values = {c: _rational(rng, 0.4, 2.6) for c in CONSTANTS}
    values[p] = sp.Rational(rng.randint(60, 420) * 2 + 1, 97)  # never an integer
    coupling = _rational(rng, 0.2, 0.8) * (-1) ** seed
    values[iota] = coupling * values[beta] * values[eta]
    return tuple(values.items())


def constants(seed: int) -> Point:
    """Generic constants that meet the hypotheses."""
    return dict(_constants(seed))


def with_loads(seed: int) -> Point:
    """Generic constants and loads."""
    rng = random.Random(f"loads {seed}")
    signs = (rng.choice((-1, 1)) for _ in LOADS)
    return constants(seed) | {
        load: s * _rational(rng, 0.2, 2.2) for load, s in zip(LOADS, signs, strict=True)
    }


@cache
def _with_strains(seed: int) -> tuple[tuple[sp.Symbol, sp.Rational], ...]:
    rng = random.Random(f"strains {seed}")
    point = constants(seed)
    direction = [rng.choice((-1, 1)) * _rational(rng, 0.3, 1) for _ in STRAINS]
    radius = _rational(rng, 0.45, 0.85)
    size = sp.Rational(1)

    def at(size: sp.Rational) -> Point:
        strains = [size * d for d in direction]
        strains[5] += 1
        return point | dict(zip(STRAINS, strains, strict=True))

    form = quadratic_form()
    while form.subs(at(size)) > radius**2:
        size *= sp.Rational(7, 8)
    return tuple(at(size).items())


def with_strains(seed: int) -> Point:
    """Generic constants and strains inside the limit, 0.1 < Q < 0.75."""
    return dict(_with_strains(seed))


#: Small constants, the plainest first: (alpha, beta, gamma, zeta, eta, iota, p).
_SIMPLE = (
    (1, 1, 1, 1, 1, 0, 2),
    (1, 1, 1, 1, 2, 1, 2),
    (2, 1, 3, 1, 2, 1, 2),
    (1, 2, 2, 1, 1, -1, 1),
    (1, 1, 1, 3, 2, sp.Rational(1, 2), 4),
    (2, 3, 5, 2, 1, 2, 1),
)


def simple_constants() -> tuple[Point, ...]:
    """Small rational constants that meet the hypotheses."""
    points = (dict(zip(CONSTANTS, map(sp.sympify, values), strict=True)) for values in _SIMPLE)
    return tuple(c for c in points if chiral_gap.subs(c) > 0)


@cache
def simple_loads() -> tuple[Point, ...]:
    """Small constants with small loads, rational radii where possible."""
    vectors = [tuple(3 if k == i else 0 for k in range(6)) for i in (0, 2, 3, 5)] + [
        (3, 4, 0, 0, 0, 0),
        (0, 0, 1, 0, 0, 2),
        (0, 0, 0, 3, 4, 0),
        (1, 2, 3, 4, 5, 6),
    ]
    return tuple(
        c | dict(zip(LOADS, map(sp.Integer, load), strict=True))
        for load, c in itertools.product(vectors, simple_constants())
    )


@cache
def simple_strains() -> tuple[Point, ...]:
    """Small constants with small strains inside the limit."""
    part = [sp.Rational(k, 10) for k in range(6)]
    vectors = [tuple(part[3] if k == i else 0 for k in range(6)) for i in (0, 2, 3, 5)] + [
        (part[3], 0, 0, 0, part[4], 0),
        (part[1], 0, part[1], 0, part[1], part[1]),
        tuple(part[1] for _ in range(6)),
    ]
    points = []
    for strain, c in itertools.product(vectors, simple_constants()):
        shifted = (*strain[:5], 1 + strain[5])
        points.append(c | dict(zip(STRAINS, map(sp.sympify, shifted), strict=True)))
    form = quadratic_form()
    return tuple(point for point in points if 0 < form.subs(point) < 1)
