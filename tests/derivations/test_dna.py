"""Tangent stiffness, and what the moduli of dsDNA say of a rod."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p
from rodproof.derivations.theory import constitutive, dna


def test_one_temperature_gives_all_moduli() -> None:
    values = [dna.number(dna.DSDNA[k]) for k in ("bending", "twisting", "stretching", "coupling")]
    assert values == [185, 447, 1000, -70]


def test_moduli_fix_products_and_no_constant() -> None:
    fixed = (gamma * alpha**2, gamma * iota, alpha / beta, eta / beta)
    assert all(dna.determined(q) for q in fixed)
    assert not any(dna.determined(q) for q in (alpha, beta, gamma, iota, eta, p))


def test_units() -> None:
    assert dna.dimension(dna.pN * dna.nm**2) == (2, 1)
    assert dna.dimension(gamma * beta**2) == (2, 1)
    assert dna.dimension(gamma * iota) == dna.dimension(dna.pN * dna.nm)


def test_stiffness_along_a_ray_is_the_slope_of_the_inverse_law() -> None:
    x, y = constitutive.x, constitutive.y
    load = constitutive.radial_law().load
    slope = dna.tangent_stiffness().subs(y, load)
    assert Field((1 - x**p,)).equal(slope, sp.diff(load, x))


def test_dsdna_meets_the_coupling_hypothesis_by_far() -> None:
    at = dna.constants()
    gap = (gamma**2 * (beta**2 * eta**2 - iota**2)).xreplace(at)
    assert sp.simplify(gap / (dna.pN * dna.nm) ** 2) == 447 * 1000 - 70**2
