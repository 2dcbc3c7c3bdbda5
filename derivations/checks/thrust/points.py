"""The names of Section 4.2, what is positive there, and generic points of its domains."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Point
from rodproof.derivations.symbols import (
    beta,
    chiral_gap,
    eta,
    gamma,
    iota,
    p,
    zeta,
)  # fmt: skip
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import phi, psi, theta
from rodproof.derivations.theory.thrust import N, s, x

R = sp.Symbol("|N|", positive=True)
angle = sp.Symbol("vartheta", positive=True)  # the free angle of the branch
delta = sp.Symbol("delta", positive=True)  # distance of N^{-p} from N_thresh^{-p}
tension = sp.Symbol("n3", real=True)
scalar_v = sp.Symbol("v", positive=True)
psi0 = sp.Symbol(r"{\psi}(0)", real=True)
N_thresh = sp.Symbol("N_thresh", positive=True)
x_N = sp.Symbol("x_N", positive=True)
x_Nk = sp.Symbol("x_{N_k}", positive=True)
theta_Nk = sp.Symbol(r"{\theta}(N_k)", positive=True)
theta_of_N = sp.Symbol(r"{\theta}(N_j)", real=True)
strand_sense = sp.Symbol("h_strand", real=True)  # triple product of a strand's three derivatives
strand_twist = sp.Symbol("tau", real=True)
strand_radius, strand_stretch = sp.symbols("rho lambda", positive=True)
theta_hat = sp.Symbol(r"\hat{\theta}", real=True)
theta_infinity = sp.Symbol(r"{\theta}(\infty)", real=True)
theta_hat_infinity = sp.Symbol(r"\hat{\theta}(\infty)", real=True)
tangent = sp.IndexedBase("r'", real=True)  # components of r' in the fixed basis
d = sp.IndexedBase("d", real=True)  # d[k, i] = d_k . g_i


class fN(sp.Function):  # noqa: N801  the paper's name
    """v_3 - 1 as a function of cos theta, `fN(x)`."""

    nargs = 1

    def _latex(self, printer: Any, exp: str | None = None) -> str:
        return rf"f_N({printer._print(self.args[0])})"


# -- what is positive -------------------------------------------------------------------------

c, b, a = theory.softness(), theory.axial_compliance(), theory.shear_compliance()
SOFTER_IN_SHEAR = (chiral_gap, c)
BRANCH_EXISTS = (*SOFTER_IN_SHEAR, 1 + c, c - sp.sqrt(b), theory.threshold_power())

# -- generic points ---------------------------------------------------------------------------


@cache
def _sheared_constants(seed: int) -> tuple[tuple[sp.Symbol, sp.Rational], ...]:
    """Generic constants with gamma = 1 that meet both conditions on the moduli."""
    point = {**sampling.constants(seed), gamma: sp.Integer(1)}
    soft = float(b.subs(point))
    compliance = soft + math.sqrt(soft) * (1.4 + 0.3 * seed)  # c > b^{1/2}
    point[zeta] = sp.Rational(int(997 / math.sqrt(compliance)), 997)
    return tuple(point.items())


def sheared_constants(seed: int) -> Point:
    """As a mapping."""
    return dict(_sheared_constants(seed))


def generic(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """Generic constants and thrusts, with everything that a state may depend on."""
    point = {**sampling.constants(seed), gamma: sp.Integer(1)}
    more = {
        R: (23, 31, 47),
        N: (23, 31, 47),
        theta: (11, 25, 40),
        phi: (-9, 14, 31),
        psi: (8, -13, 29),
        psi0: (15, 4, -7),
        s: (5, 9, 13),
        x: (6, 13, 17),
        strand_twist: (8, -11, 14),
        strand_radius: (5, 7, 9),
        strand_stretch: (23, 26, 15),
    }
    return point | {k: sp.Rational(v[seed % 3], 19) for k, v in more.items()}


def on_the_branch(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """Generic constants that meet the conditions, and an angle below the limiting one."""
    point = sheared_constants(seed)
    limit = math.acos(float(theory.limiting_cosine().subs(point)))
    chosen = sp.Rational(int(997 * limit * (0.45 + 0.2 * (seed % 3))), 997)
    return {**generic(seed), **point, angle: chosen, x: sp.Rational(13 + 2 * seed, 19)}


def above(seed: int) -> dict[sp.Symbol, sp.Rational]:
    """The distance of N^{-p} from its threshold, as a rational part of the latter."""
    point = on_the_branch(seed)
    whole = float(theory.threshold_power().subs(point))
    return {**point, delta: sp.Rational(int(whole * 1e9 * (0.2 + 0.25 * (seed % 3))), 10**9)}


def _small(**others: object) -> tuple[Point, ...]:
    """Small points: beta, eta, zeta, iota, p with rational b, and others given by name."""
    rows = ((1, 2, 1, 0, 2), (2, 2, 1, 0, 2), (1, 1, 1, 0, 2), (1, 2, 1, 1, 2), (2, 1, 1, -1, 1))
    names = {"R": R} | {k.name: k for k in (N, theta, phi, psi, psi0, s, x, angle)}
    given = {names[k]: sp.sympify(v) for k, v in others.items()}
    keys = (beta, eta, zeta, iota, p)
    return tuple({**dict(zip(keys, map(sp.Integer, row), strict=True)), **given} for row in rows)


def small_points() -> tuple[Point, ...]:
    """Small points at any angle, for three thrusts."""
    angles = {"theta": sp.pi / 6, "varphi": 0, "psi": 0, r"{\psi}(0)": 0, "s": 0}
    return (
        *_small(R=2, N=2, x=1, **angles),
        *_small(R="3/2", N="3/2", x=1, **angles),
        *_small(R="3/2", N="3/2", x="1/2", **angles),
    )


def small_states() -> tuple[Point, ...]:
    """Small points at a sheared angle, and one rod that is compressed to nothing."""
    angles = {"theta": sp.pi / 6, "varphi": 0, "psi": 0, r"{\psi}(0)": 0, "s": 0}
    rows = _small(R="3/4", x=1, vartheta=sp.pi / 6, **angles)
    # b = 4, R = 2 sends v_3 = 1 - b F R below zero: p = 1 and beta^2 eta^2 - iota^2 = 1/4
    extra = {beta: sp.Integer(1), eta: sp.Rational(1, 2), zeta: sp.Integer(1), iota: sp.Integer(0),
             p: sp.Integer(1), R: sp.Integer(2), phi: sp.Integer(0), psi0: sp.Integer(0),
             s: sp.Integer(0)}  # fmt: skip
    return (*rows, extra)


def small_limits() -> tuple[Point, ...]:
    """b = 2/75, a = 9/25, c = 1/3, so that the limiting cosine is 9/10; beta = 2 and beta = 1."""
    return tuple(
        {beta: sp.Integer(k), eta: sp.Rational(49, 8), zeta: sp.Rational(5, 3),
         iota: sp.Rational(k, 8), p: sp.Integer(2)}
        for k in (2, 1)
    )  # fmt: skip
