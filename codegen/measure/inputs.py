"""The inputs at which forms are compared, by kind and precision; the same for the same seed.

ordinary  constants within a factor of four of each other, p from 0.5 to 10, strains well inside
extreme   loads from 1e-160 to 1e160, gamma from 1e-200 to 1e200, p from 0.3 to 1000, strains from
          1e-160, and zero; for single precision the same exponents divided by eight
limit     strains within 1e-3 to 1e-13 of the limit (1e-6 in single), loads up to 1e15 gamma
chiral    beta^2 eta^2 - iota^2 small: 1 - |iota|/(beta eta) from 1e-1 to 1e-10 (1e-4 in single);
          only for scenes with coupling

A scene's points are the full rod's with what the scene does not have left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Literal

import numpy as np
from flint import arb
from numpy.typing import NDArray

from rodproof.codegen.measure import oracle
from rodproof.codegen.measure.subjects import Side, Subject

Kind = Literal["ordinary", "extreme", "limit", "chiral"]
KINDS: tuple[Kind, ...] = ("ordinary", "extreme", "limit", "chiral")

Array = NDArray[np.floating]


@dataclass(frozen=True)
class Batch:
    """One set of constants and points for it: (3, N) each of m and n, or of u and v."""

    constants: tuple[float, ...]
    first: Array
    second: Array

    @property
    def size(self) -> int:
        return int(self.first.shape[1])

    def exact_constants(self) -> oracle.Constants:
        return oracle.Constants(*map(arb, self.constants))

    def column(self, index: int) -> Batch:
        """The batch with one of its points."""
        one = slice(index, index + 1)
        return Batch(self.constants, self.first[:, one], self.second[:, one])

    @oracle.exactly
    def exact(self, index: int, side: Side) -> list[arb]:
        """A point as the oracle wants it: the load, or the strain from rest."""
        values = [arb(float(a)) for a in (*self.first[:, index], *self.second[:, index])]
        return values if side == "loads" else [*values[:5], values[5] - 1]


def kinds(subject: Subject) -> tuple[Kind, ...]:
    """The kinds of input that a scene has."""
    return KINDS if subject.coupled else KINDS[:-1]


@oracle.exactly
def batches(
    subject: Subject,
    function: str,
    kind: Kind,
    dtype: type[np.floating],
    seed: int,
    count: int,
    points: int,
) -> tuple[Batch, ...]:
    """``count`` sets of constants with ``points`` points each."""
    side = subject.side(function)
    rng = np.random.default_rng([seed, KINDS.index(kind), side == "loads", np.finfo(dtype).bits])
    draw = _draw_loads if side == "loads" else _draw_strains
    made = []
    for _ in range(count):
        constants = subject.restricted(_draw_constants(rng, kind, dtype))
        columns = [draw(rng, kind, constants, dtype, subject.loads) for _ in range(points)]
        rows = np.stack(columns, axis=1)
        if kind == "extreme":  # rest is a point like any other
            rows[:, 0] = [0, 0, 0, 0, 0, int(side == "strains")]
        made.append(Batch(constants, rows[:3].copy(), rows[3:].copy()))
    return tuple(made)


def _log_uniform(rng: np.random.Generator, low: float, high: float) -> float:
    return float(10 ** rng.uniform(low, high))


def _draw_constants(
    rng: np.random.Generator, kind: Kind, dtype: type[np.floating]
) -> tuple[float, ...]:
    extreme, single = kind == "extreme", dtype is np.float32
    alpha, beta, zeta, eta = (
        _log_uniform(rng, *((-2, 2) if extreme else (-0.3, 0.3))) for _ in "abcd"
    )
    gap = _log_uniform(rng, -4 if single else -10, -1) if kind == "chiral" else rng.uniform(0.2, 1)
    iota = rng.choice([-1, 1]) * (1 - gap) * beta * eta
    gamma = _log_uniform(rng, *((-25, 25) if single else (-200, 200)) if extreme else (-1, 1))
    special = rng.choice([1.0, 2.0, 1 + 1e-6, 1 - 1e-6, 1000.0, 0.3])
    p = _log_uniform(rng, -0.3, 1)
    if extreme:
        p = special if rng.random() < 0.3 else _log_uniform(rng, np.log10(0.3), 3)
    drawn = tuple(float(dtype(x)) for x in (alpha, beta, zeta, eta, iota, gamma, p))
    if not oracle.Constants(*map(arb, drawn)).gap > 0:  # rounded away: draw again
        return _draw_constants(rng, kind, dtype)
    return drawn


def _direction(rng: np.random.Generator, kind: Kind, live: tuple[int, ...]) -> Array:
    """A unit vector of live components; at extremes some of them are missing or tiny."""
    w: Array = rng.normal(size=6)
    if kind == "extreme":
        w *= np.where(rng.random(6) < 0.25, 0.0, 10 ** rng.choice([0.0, 0.0, -9.0], size=6))
    w = only(w, live)
    length = float(np.linalg.norm(w))
    return w / length if length else _direction(rng, kind, live)


def only(values: Array, live: tuple[int, ...]) -> Array:
    """Six components with those zero that are not live."""
    return np.where(np.isin(np.arange(6), live), values, 0.0)


def coupling(constants: tuple[float, ...]) -> Array:
    """L with K = L L^T: what makes a whitened direction a load."""
    alpha, beta, zeta, eta, iota, _, _ = constants
    share = Fraction(iota) / (Fraction(beta) * Fraction(eta))  # exact: 1 - share^2 cancels
    L = np.diag([alpha, alpha, beta, zeta, zeta, eta * float(1 - share**2) ** 0.5])
    L[5, 2] = iota / beta
    return L


def strain_along(constants: tuple[float, ...], direction: Array) -> Array:
    """L^{-T} of a whitened direction: the strain from rest that it is."""
    L = coupling(constants)
    strain = direction / np.diag(L)
    strain[2] -= L[5, 2] / L[2, 2] * strain[5]
    return strain


def _draw_loads(
    rng: np.random.Generator,
    kind: Kind,
    constants: tuple[float, ...],
    dtype: type[np.floating],
    live: tuple[int, ...],
) -> Array:
    gamma, single = constants[5], dtype is np.float32
    direction = only(coupling(constants) @ _direction(rng, kind, live), live)
    if kind == "extreme" and rng.random() < 0.5:
        size = _log_uniform(rng, *((-20, 20) if single else (-160, 160)))
        return (direction / np.abs(direction).max() * size).astype(dtype)
    span = {"extreme": (-3.0, 3.0), "limit": (3.0, 7.0 if single else 15.0)}.get(kind, (-1.0, 1.0))
    return (direction * _log_uniform(rng, *span) * gamma).astype(dtype)


def _draw_strains(
    rng: np.random.Generator,
    kind: Kind,
    constants: tuple[float, ...],
    dtype: type[np.floating],
    live: tuple[int, ...],
) -> Array:
    single = dtype is np.float32
    if kind == "limit":
        x = 1 - _log_uniform(rng, -6 if single else -13, -3)
    elif kind == "extreme" and rng.random() < 0.6:
        x = _log_uniform(rng, -20 if single else -160, 0)
    else:
        x = rng.uniform(0.01, 0.98)
    strain = strain_along(constants, _direction(rng, kind, live) * x)
    strain = (strain if strain[5] > -1 else -strain) + np.eye(6)[5]  # v3 > 0
    strain = strain.astype(dtype)
    if not inside(constants, strain):  # rounded out of the domain: draw again
        return _draw_strains(rng, kind, constants, dtype, live)
    return strain


@oracle.exactly
def inside(constants: tuple[float, ...], strain: Array) -> bool:
    """Whether a strain (six numbers, v3 as it is) is below the limit, exactly."""
    exact = Batch(constants, strain[:3, None], strain[3:, None])
    whitened = oracle.whitened_strain(exact.exact_constants(), exact.exact(0, "strains"))
    return bool(oracle.norm(whitened) < 1)
