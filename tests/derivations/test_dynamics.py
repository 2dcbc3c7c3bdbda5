"""Moving sections, conditions at the ends, and what the viscous laws dissipate."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import dynamics as domains
from rodproof.derivations.checks import ends
from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import STRAINS, alpha, beta, chiral_gap, eta, gamma, iota, zeta
from rodproof.derivations.theory import constitutive, dissipation, dynamics
from rodproof.derivations.theory.dissipation import a, b, x


def test_the_balance_about_r_is_that_of_the_section_if_r_is_the_center_of_mass() -> None:
    difference = dynamics.couple_rate() - dynamics.section_momentum_rate()
    extra = sp.Matrix([dynamics.S1, dynamics.S2, 0]).cross(dynamics.acceleration)
    assert sp.expand(difference - extra) == sp.zeros(3, 1)


def test_first_moments_enter_the_linear_balance() -> None:
    assert dynamics.force_slope().has(dynamics.S1)
    assert not dynamics.force_slope().xreplace(dynamics.CENTRAL).has(dynamics.J1)


def test_the_built_sheared_rod_carries_no_couple_and_a_force_along_g3() -> None:
    found = ends._measured(0)
    for base, last in ((ends.m_a, 3), (ends.m_b, 3), (ends.n_b, 2)):
        for k in range(1, last + 1):
            assert abs(found[sp.Symbol(f"{base.label}{k}", real=True)]) < 1e-50
    assert found[ends.euler.N] > 0
    assert found[ends.tilt_sheared] < 1


def test_equal_times_dissipate() -> None:
    assert domains.monotone()


def test_the_tangent_has_the_parts_that_the_loss_is_computed_from() -> None:
    """D^2 W = g K + c w w^T at a mixed strain, entry by entry."""
    g, c = dissipation.tangent_parts()
    K = constitutive.stiffness_at_rest()
    at = dissipation.MIXED
    eps = sp.Matrix([at[s] for s in STRAINS]) - sp.Matrix([0, 0, 0, 0, 0, 1])
    w = K * eps
    field = Field((1 - x ** sp.Symbol("p", positive=True), chiral_gap))
    for i, j in ((0, 0), (0, 3), (3, 3), (1, 1)):
        entry = constitutive.stiffness()[i, j].subs(at)
        assert field.equal(entry, g * K[i, j] + c * w[i] * w[j])


def test_small_strain_dissipation_of_two_times() -> None:
    """The symmetric part of K T^{-1} is definite iff 4 a b beta^2 eta^2 > iota^2 (a + b)^2."""
    block = sp.Matrix([[beta**2 / a, iota * (1 / a + 1 / b) / 2],
                       [iota * (1 / a + 1 / b) / 2, eta**2 / b]])  # fmt: skip
    condition = 4 * a * b * beta**2 * eta**2 - iota**2 * (a + b) ** 2
    assert sp.cancel(block.det() - condition / (4 * a**2 * b**2)) == 0


def test_two_times_can_create_energy() -> None:
    """An exact process of the linear law, iota = 1/2, times 1 and 100."""
    K = constitutive.stiffness_at_rest().subs(
        {alpha: 1, beta: 1, gamma: 1, zeta: 1, eta: 1, iota: sp.Rational(1, 2)}
    )
    T = sp.diag(1, 1, 1, 100, 100, 100)
    rates = [sp.Matrix([0, 0, k, 0, 0, 1]) for k in range(-60, 0)]
    assert min((z.T * T * K * z)[0, 0] for z in rates) < 0
