"""Section 4.3 from first principles: a rod under couples alone, with a constant polar angle.

Equilibrium without force (N = 0) leaves n = 0 and a constant vector m. Problem: all states of
the reduced system (module `euler`, gamma = 1) with theta' = 0; that is, with M_2 = 0, as
theta' = u M_2 and u > 0. What is left of the six equations is

    -sin(theta) phi' = u M_1,    psi' + cos(theta) phi' = u_3,
    (M_1 cos(theta) + M_3 sin(theta)) phi' = 0,    M_1' = M_3' = 0,

and it splits: either M_1 = 0, and the rod is straight and twisted; or M_1 != 0, which excludes
theta = 0 and phi' = 0, so M_3 = -M_1 cot(theta), and the rod is a helix about g_3, the axis of m.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.symbols import STRAINS
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.euler import (
    M1,
    M2,
    M3,
    M2_s,
    N,
    Vector,
    phi_s,
    psi_s,
    theta_s,
)
from rodproof.derivations.theory.frames import phi, theta

s = sp.Symbol("s", real=True)
psi_0 = sp.Symbol("psi_0", real=True)  # psi(0)

#: No force and a constant polar angle.
STEADY: Mapping[sp.Symbol, sp.Expr] = dict.fromkeys((N, theta_s, M2, M2_s), sp.Integer(0))


@cache
def steady_equations() -> tuple[sp.Expr, ...]:
    """The reduced system for N = 0, theta' = 0, M_2 = 0: three of the law, three of balance."""
    return tuple(e.xreplace(dict(STEADY)) for e in euler.reduced_system())


@dataclass(frozen=True)
class State:
    """A family of equilibria: what the couple, the angles and the strains are along the rod.

    strains: (u_1, u_2, u_3, v_1, v_2, v_3) in M_1 or M_3, theta and psi. rates: (phi', psi').
    couple: (M_1, M_2, M_3).
    """

    couple: tuple[sp.Expr, sp.Expr, sp.Expr]
    rates: tuple[sp.Expr, sp.Expr]
    strains: tuple[sp.Expr, ...]

    def angles(self) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
        """(phi, theta, psi) as functions of s with phi(0) = 0; the rates are constant."""
        return self.rates[0] * s, theta, self.rates[1] * s + psi_0


def _strains(couple: tuple[sp.Expr, sp.Expr, sp.Expr]) -> tuple[sp.Expr, ...]:
    """The law in the reduced variables, where Q* is free of psi."""
    bending, shear = euler.bending_factor(), euler.shear_factor()
    m, n = euler.couple(), euler.force()
    law = (bending * m[0], bending * m[1], euler.twist(),
           shear * n[0], shear * n[1], euler.dilatation())  # fmt: skip
    at = dict(zip((M1, M2, M3), couple, strict=True)) | {N: sp.Integer(0)}
    return tuple(e.xreplace(at) for e in law)


@cache
def twisted() -> State:
    """M_1 = 0: then sin(theta) phi' = 0, so phi = 0 (or theta = 0, where only phi + psi counts)."""
    couple = (sp.Integer(0), sp.Integer(0), M3)
    strains = _strains(couple)
    (turn,) = sp.solve(
        steady_equations()[2].xreplace({phi_s: sp.Integer(0), STRAINS[2]: strains[2]}), psi_s
    )
    return State(couple, (sp.Integer(0), turn), strains)


@cache
def axial_couple() -> sp.Expr:
    """M_3 where phi' != 0 and sin(theta) != 0, from the balance about e_2."""
    balance = sp.expand(steady_equations()[4] / phi_s)  # linear in M_3
    return -balance.xreplace({M3: sp.Integer(0)}) / sp.diff(balance, M3)


@cache
def helix() -> State:
    """M_1 != 0: phi' from the law along e_1, psi' from the law along e_3."""
    couple = (M1, sp.Integer(0), axial_couple())
    at = dict(zip((M2, M3), couple[1:], strict=True)) | {N: sp.Integer(0)}
    closed = {k: e.xreplace(at) for k, e in euler.reduced_law().items()}
    first, _, third = (e.xreplace(closed) for e in steady_equations()[:3])
    turn = -first.xreplace({phi_s: sp.Integer(0)}) / sp.diff(first, phi_s)  # linear in phi'
    spin = -third.xreplace({psi_s: sp.Integer(0), phi_s: turn})  # psi' has coefficient 1
    return State(couple, (turn, spin), _strains(couple))


def in_fixed_basis(couple: tuple[sp.Expr, sp.Expr, sp.Expr]) -> Vector:
    """M_k e_k in the basis g_k."""
    return euler.from_components(couple, euler.intermediate_frame())


def tangent(state: State) -> Vector:
    """r' = v_k d_k of a state with v_1 = v_2 = 0 in the symbol v_3."""
    assert state.strains[3] == state.strains[4] == 0
    return Vector(STRAINS[5] * euler.directors()[2])


# -- the shape of the centre line --------------------------------------------------------------


@dataclass(frozen=True)
class Shape:
    """Curvature and torsion, and radius and rise per radian of the helix that has them."""

    curvature: sp.Expr
    torsion: sp.Expr
    radius: sp.Expr
    rise: sp.Expr


@cache
def shape() -> Shape:
    """kappa = |r' x r''|/|r'|^3 and tau = det(r', r'', r''')/|r' x r''|^2; a helix of radius a
    and rise h per radian has kappa = a/(a^2 + h^2) and tau = h/(a^2 + h^2), h < 0 if left-handed.

    In the frame e_k, where r' = v_3 e_3 has constant components and ' is the product with the
    frame's Darboux vector. theta, v_3 and phi' are constant. Handedness is the sign of tau.
    """
    spin = sp.Matrix(euler.frame_rates()).xreplace(dict(STEADY))
    first = sp.Matrix([0, 0, STRAINS[5]])
    second = spin.cross(first)
    third = spin.cross(second)
    binormal = first.cross(second)
    area, speed = sp.factor(binormal.dot(binormal)), first.dot(first)
    torsion = sp.cancel(binormal.dot(third) / area)
    curvature = sp.sqrt(area) / sp.sqrt(speed) ** 3
    total = sp.cancel(area / speed**3) + torsion**2
    return Shape(curvature, torsion, curvature / total, torsion / total)


@cache
def center_line() -> Vector:
    """r(s) up to a translation, for r' = v_3 d_3 and phi = phi' s, in the symbols v_3 and phi'."""
    a, b, c = tangent(helix())
    line = sp.ImmutableMatrix([sp.integrate(a, phi) / phi_s, sp.integrate(b, phi) / phi_s, c * s])
    return Vector(line.subs(phi, phi_s * s))
