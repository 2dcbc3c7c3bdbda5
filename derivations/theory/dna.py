"""Section 5.2: the tangent stiffness along a ray, and a rod with the moduli of dsDNA.

Problem 1: the slope dy/dx of the load radius by the strain radius, as a function of the load.

Problem 2: given the four small-strain moduli (gamma alpha^2, gamma beta^2, gamma eta^2,
gamma iota) of a rod, what of the rod is determined by them, which hypotheses they meet, and how
the rod answers to a tension N.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import (
    CONSTANTS,
    LOADS,
    STRAINS,
    alpha,
    beta,
    eta,
    gamma,
    iota,
    p,
)
from rodproof.derivations.theory import constitutive, dimensions
from rodproof.derivations.theory.constitutive import y

pN, nm = sp.symbols("pN nm", positive=True)
tension = sp.Symbol("N", positive=True)


@cache
def tangent_stiffness() -> sp.Expr:
    """dy/dx at the load radius y: the reciprocal of dx/dy, x = y (gamma^p + y^p)^{-1/p}."""
    slope = sp.diff(constitutive.radial_law().strain, y)
    stiffness = (gamma**p + y**p) ** (1 + 1 / p) / gamma**p
    assert Field().equal(slope * stiffness, sp.Integer(1))
    return stiffness


@dataclass(frozen=True)
class Modulus:
    """An entry of the stiffness at rest, gamma K, and the length that is it over k_B T.

    length: persistence length of bending or twist, or the coupling; None for a force.
    """

    entry: tuple[int, int]
    length: sp.Rational | None
    force: sp.Rational | None = None


#: Data, not derived: for dsDNA the persistence lengths of bending and of twist and the
#: twist-stretch coupling in nm (times k_B T), and the stretch modulus in pN, as single-molecule
#: experiments are known to report them. The derivation only says what they must be consistent
#: with: an entry of gamma K, its dimension, and one temperature for all of them.
DSDNA: Mapping[str, Modulus] = {
    "bending": Modulus((0, 0), sp.Rational(45)),
    "twisting": Modulus((2, 2), sp.Rational(109)),
    "coupling": Modulus((2, 5), sp.Rational(-17)),
    "stretching": Modulus((5, 5), None, sp.Rational(1000)),
}
BOLTZMANN = sp.Rational(1380649, 10**8)  # pN nm/K, exact in the SI
TEMPERATURE = sp.Rational(29715, 100)  # K: the one temperature at which all three agree


def number(modulus: Modulus) -> sp.Rational:
    """The modulus in pN and nm, rounded to an integer."""
    if modulus.force is not None:
        return modulus.force
    assert modulus.length is not None
    value = modulus.length * BOLTZMANN * TEMPERATURE
    return sp.sign(value) * sp.floor(abs(value) + sp.Rational(1, 2))


@cache
def moduli_at_rest() -> sp.ImmutableMatrix:
    """gamma K, the Jacobian of the linear law."""
    return sp.ImmutableMatrix(sp.Matrix(constitutive.loads_at_leading_order()).jacobian(STRAINS))


@cache
def constants() -> dict[sp.Symbol, sp.Expr]:
    """alpha, beta, eta, iota from the four moduli; gamma and p (and zeta) stay free."""
    value = {name: number(m) for name, m in DSDNA.items()}
    return {
        alpha: sp.sqrt(value["bending"] * pN / gamma) * nm,
        beta: sp.sqrt(value["twisting"] * pN / gamma) * nm,
        eta: sp.sqrt(value["stretching"] * pN / gamma),
        iota: value["coupling"] * pN * nm / gamma,
    }


@cache
def under_tension() -> tuple[sp.Expr, ...]:
    """The strains (u, v) under the tension N alone, with the constants of dsDNA."""
    at = dict.fromkeys(LOADS, sp.Integer(0)) | {LOADS[5]: tension}
    law = (e.xreplace(at).xreplace(constants()) for e in constitutive.law_of_strains())
    return tuple(e + r for e, r in zip(law, (0, 0, 0, 0, 0, 1), strict=True))


def dimension(expr: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """(exponent of length, exponent of force), pN being a force and nm a length."""
    return dimensions.dimension(expr.xreplace({pN: dimensions.force, nm: dimensions.length}))


def determined(quantity: sp.Expr) -> bool:
    """Do the four moduli fix the quantity? Its logarithmic gradient by the constants must be a
    combination of theirs (iota enters products only, so iota != 0 is used)."""
    moduli = [moduli_at_rest()[m.entry] for m in DSDNA.values()]
    rows = logarithmic_jacobian((*moduli, quantity))
    if not all(e.is_number for e in rows):
        return False
    return bool(rows.rank() == rows[:-1, :].rank())


def logarithmic_jacobian(quantities: tuple[sp.Expr, ...]) -> sp.Matrix:
    """The exponents of the constants in products of powers."""
    return sp.Matrix([[sp.cancel(sp.diff(q, c) * c / q) for c in CONSTANTS] for q in quantities])
