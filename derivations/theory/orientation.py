"""Orientation: the determinant of the constrained deformation, and what the strain limit ensures.

Problem 1: chi(x1, x2, s) = r(s) + x1 d_1(s) + x2 d_2(s) is the deformation of a slender body whose
sections are discs of radius a that stay plane and rigid. When is det grad chi > 0 on all of it?

In the directors the columns of grad chi are (1, 0, 0), (0, 1, 0) and v + u x (x1, x2, 0), so the
determinant is affine in (x1, x2) and its least value on the closed disc is at the boundary point
opposite to its gradient.

Problem 2: over all strains with Q < 1, how small do v3, the determinant and their bounds get?
An affine function c + k . eps has the infimum c - (k . K^{-1} k)^{1/2} there, not attained
unless k = 0, since the ellipsoid is open.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.symbols import STRAINS, v3
from rodproof.derivations.theory.constitutive import sharp_bound

x1, x2 = sp.symbols("x1 x2", real=True)
a = sp.Symbol("a", positive=True)
bending_angle = sp.Symbol("omega", real=True)

#: The strains at rest, about which affine functions are expanded.
REST = {**dict.fromkeys(STRAINS, sp.Integer(0)), v3: sp.Integer(1)}


@cache
def determinant() -> sp.Expr:
    """det grad chi as a function of the strains and of the place (x1, x2) in the section."""
    u, v = sp.Matrix(STRAINS[:3]), sp.Matrix(STRAINS[3:])
    place = sp.Matrix([x1, x2, 0])
    columns = (place.diff(x1), place.diff(x2), v + u.cross(place))
    return sp.expand(sp.Matrix.hstack(*columns).det())


@dataclass(frozen=True)
class Least:
    """The least value of c + c1 x1 + c2 x2 on the disc of radius a, and where it is taken."""

    value: sp.Expr
    place: tuple[sp.Expr, sp.Expr]
    gradient: tuple[sp.Expr, sp.Expr]


def least_on_disc(affine: sp.Expr) -> Least:
    """Cauchy-Schwarz: c1 x1 + c2 x2 >= -a (c1^2 + c2^2)^{1/2}, with equality at -a c/|c|."""
    c1, c2 = affine.coeff(x1), affine.coeff(x2)
    size = sp.sqrt(c1**2 + c2**2)
    center = affine.subs({x1: 0, x2: 0})
    return Least(center - a * size, (-a * c1 / size, -a * c2 / size), (c1, c2))


@dataclass(frozen=True)
class Infimum:
    """`center - bound`: the infimum over Q < 1 of an affine function of the strains."""

    center: sp.Expr
    bound: sp.Expr


def infimum(affine: sp.Expr) -> Infimum:
    """The infimum over all strains with Q < 1; not attained where the function is not constant."""
    slope = [sp.diff(affine, strain) for strain in STRAINS]
    if any(entry.free_symbols & set(STRAINS) for entry in slope):
        raise ValueError(f"{affine} is not affine in the strains")
    return Infimum(affine.subs(REST), sharp_bound(*slope).bound)


def flexure_in_direction() -> sp.Expr:
    """u1 cos omega + u2 sin omega, whose largest value over omega is (u1^2 + u2^2)^{1/2}."""
    return sp.cos(bending_angle) * STRAINS[0] + sp.sin(bending_angle) * STRAINS[1]
