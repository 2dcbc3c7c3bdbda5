"""Rods with constraints: what the law becomes, by exact limits of the complementary law.

Problem: some strains are held at rest by the making of the rod: it cannot shear (v1 = v2 = 0),
cannot stretch (v3 = 1) or cannot twist (u3 = 0). Which strains do the loads cause, and what are
the energies and Hessians on the strains that remain?

A held strain is a stiff one, so the constrained rod is the limit of rods whose modulus for it
tends to infinity, the other constants kept:

    zeta -> oo  unshearable       eta -> oo  inextensible       beta -> oo  untwisted

The limit is taken in the complementary law, where everything stays finite: K^{-1} tends to a
matrix C whose rows and columns of held strains vanish. So Q* loses the loads of held strains,
held strains are zero at every load, and these loads do no work: they are reactions, which the law
does not determine. On the kept components C is the inverse of the same block of K, iota set to
zero where twist or stretch is held (a coupling needs both). The law is radial with that block in
place of K, so its Legendre dual, the stored energy, is W of the full rod at the kept strains, and
the stiffness is that block of the full stiffness there. (The coupling iota is kept in the limit.
Keeping the share iota/(beta eta) instead would leave a softer rod, whose vanishing stretch still
eases the twist.)

Two more restrictions are symmetries and need no limit. The rod is achiral, equal to its mirror
images, exactly if iota = 0. Then the reflection that turns the signs of (u1, u3, v2) and of
(m1, m3, n2) commutes with the law: loads in the plane of d1 and d3 bend the rod in that plane.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.exact.limits import limit
from rodproof.derivations.symbols import LOADS, beta, eta, iota, zeta
from rodproof.derivations.theory import constitutive as theory


@dataclass(frozen=True)
class Constraint:
    """Strains held at rest, with the modulus that tends to infinity; or a plane of symmetry.

    ``lost`` are the components (of six) without strain. ``achiral`` says that iota is zero or
    has no say. Without a ``rigid`` modulus the loads of lost components are zero, not reactions.
    """

    name: str
    lost: tuple[int, ...] = ()
    rigid: sp.Symbol | None = None
    achiral: bool = False


CONSTRAINTS: dict[str, Constraint] = {
    c.name: c
    for c in (
        Constraint("unshearable", (3, 4), rigid=zeta),
        Constraint("inextensible", (5,), rigid=eta, achiral=True),
        Constraint("untwisted", (2,), rigid=beta, achiral=True),
        Constraint("achiral", achiral=True),
        Constraint("planar", (0, 2, 4), achiral=True),
    )
}

#: The reflection in the plane of d1 and d3, on (u, v - e3) and on (m, n) alike.
REFLECTION = sp.ImmutableMatrix(sp.diag(-1, 1, -1, 1, -1, 1))


def kept(names: Iterable[str]) -> tuple[int, ...]:
    """The components that all the constraints leave."""
    lost = {i for name in names for i in CONSTRAINTS[name].lost}
    return tuple(i for i in range(6) if i not in lost)


def reactions(names: Iterable[str]) -> tuple[int, ...]:
    """The components whose load is a reaction."""
    return tuple(sorted({i for c in map(CONSTRAINTS.get, names) if c and c.rigid for i in c.lost}))


def achiral(names: Iterable[str]) -> bool:
    """Whether iota is zero or without effect under the constraints."""
    return any(CONSTRAINTS[name].achiral for name in names)


@cache
def compliance_at_rest(*names: str) -> sp.ImmutableMatrix:
    """C = lim K^{-1}, entry by entry, the moduli of the constraints going to infinity in turn."""
    symmetric = {iota: sp.S.Zero} if any(_by_symmetry(name) for name in names) else {}
    matrix = theory.compliance_at_rest().subs(symmetric)
    for name in names:
        rigid = CONSTRAINTS[name].rigid
        if rigid is not None:
            matrix = matrix.applyfunc(lambda entry, to=rigid: _stiff_limit(entry, to))
    return sp.ImmutableMatrix(matrix)


def _by_symmetry(name: str) -> bool:
    constraint = CONSTRAINTS[name]
    return constraint.achiral and constraint.rigid is None


def _stiff_limit(entry: sp.Expr, modulus: sp.Symbol) -> sp.Expr:
    return limit(entry, modulus, sp.oo) if entry.has(modulus) else entry


@cache
def dual_form(*names: str) -> sp.Expr:
    """Q* = sigma . C sigma, free of reactions."""
    sigma = sp.Matrix(LOADS)
    return (sigma.T * compliance_at_rest(*names) * sigma)[0, 0]


@cache
def strains(*names: str) -> tuple[sp.Expr, ...]:
    """The six strains from rest, (gamma^p + Q*^{p/2})^{-1/p} C sigma."""
    factor = (theory.radial_law().strain / theory.y).subs(theory.y, sp.sqrt(dual_form(*names)))
    return tuple(factor * row for row in compliance_at_rest(*names) * sp.Matrix(LOADS))


@cache
def stiffness_at_rest(*names: str) -> sp.ImmutableMatrix:
    """The block of K on the kept components, free of iota where that has no say."""
    at = list(kept(names))
    whole = theory.stiffness_at_rest().subs({iota: 0} if achiral(names) else {})
    return sp.ImmutableMatrix(whole.extract(at, at))


@cache
def quadratic_form(*names: str) -> sp.Expr:
    """Q on the kept strains."""
    eps = sp.Matrix([theory.STRAIN_FROM_REST[i] for i in kept(names)])
    return (eps.T * stiffness_at_rest(*names) * eps)[0, 0]


@cache
def loads(*names: str) -> tuple[sp.Expr, ...]:
    """The loads of the kept strains, (y/x) K eps: the inverse of `strains` on its image."""
    factor = (theory.radial_law().load / theory.x).subs(theory.x, sp.sqrt(quadratic_form(*names)))
    eps = sp.Matrix([theory.STRAIN_FROM_REST[i] for i in kept(names)])
    return tuple(factor * row for row in stiffness_at_rest(*names) * eps)
