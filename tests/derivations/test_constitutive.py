"""The derived law of Section 3.1: exact truths, and numbers that came another way."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.exact.evaluate import Evaluator, context
from rodproof.derivations.exact.field import Field
from rodproof.derivations.proof import sampling
from rodproof.derivations.symbols import LOADS, STRAINS, chiral_gap, gamma, p
from rodproof.derivations.theory import constitutive as law

STRAINS_OF_LOADS = {
    s: e + r for s, e, r in zip(STRAINS, law.strains(), (0, 0, 0, 0, 0, 1), strict=True)
}


@pytest.fixture
def on_loads() -> Field:
    return Field((chiral_gap, law.dual_form()))


@pytest.fixture
def on_strains() -> Field:
    return Field((chiral_gap, law.quadratic_form(), 1 - law.quadratic_form() ** (p / 2)))


def test_the_gradient_of_the_energy_is_the_structural_law(on_loads: Field) -> None:
    for a, b in zip(law.strains(), law.law_of_strains(), strict=True):
        assert on_loads.equal(a, b)


def test_loads_of_strains_of_loads(on_loads: Field) -> None:
    for load, symbol in zip(law.loads(), LOADS, strict=True):
        assert on_loads.equal(load.xreplace(STRAINS_OF_LOADS), symbol)


def test_strains_of_loads_of_strains(on_strains: Field) -> None:
    loads = dict(zip(LOADS, law.loads(), strict=True))
    for strain, wanted in zip(law.strains(), law.STRAIN_FROM_REST, strict=True):
        assert on_strains.equal(strain.xreplace(loads), wanted)


def test_both_energies_have_symmetric_hessians(on_loads: Field, on_strains: Field) -> None:
    for matrix, field in ((law.compliance(), on_loads), (law.stiffness(), on_strains)):
        assert all(field.equal(matrix[i, j], matrix[j, i]) for i in range(6) for j in range(i))


def test_at_rest_the_hessian_tends_to_gamma_K_for_every_p() -> None:
    """D^2 W - gamma (1 - q)^{-1/p} K = factor q khat khat^T with |khat| bounded, and q -> 0."""
    q = sp.Symbol("q", positive=True)
    structure = gamma * (1 - q) ** (-1 / p)
    assert sp.limit(structure.subs(p, sp.Rational(1, 2)), q, 0) == gamma
    assert structure.subs(q, 0) == gamma


@pytest.mark.parametrize("index", range(6))
def test_the_support_function_is_the_supremum(index: int) -> None:
    """No rational strain on the ellipsoid exceeds the bound; the extremal attains it."""
    unit = [sp.Integer(k == index) for k in range(6)]
    found = law.sharp_bound(*unit)
    field = Field((chiral_gap,))
    form = law.quadratic_form()
    at = dict(zip(STRAINS, (*found.extremal[:5], found.extremal[5] + 1), strict=True))
    assert field.equal(form.xreplace(at), sp.Integer(1))
    assert field.equal(found.extremal[index], found.bound)
    for seed in range(4):
        point = sampling.with_strains(seed)
        size = abs((law.STRAIN_FROM_REST[index]).subs(point)) / sp.sqrt(form.subs(point))
        assert sp.N(size - found.bound.subs(point), 30) < 0


@pytest.mark.parametrize("power", sorted(law.ELEMENTARY))
def test_elementary_energies_are_the_hypergeometric_ones(power: sp.Rational) -> None:
    point = {**sampling.constants(1), p: power, law.x: sp.Rational(5, 9), law.y: sp.Rational(7, 3)}
    evaluate = Evaluator(context(50), point)
    general = (law.stored_energy_closed(), law.complementary_energy_closed())
    for closed, elementary in zip(general, law.ELEMENTARY[power], strict=True):
        assert abs(evaluate(closed) - evaluate(elementary)) < 10**-45


def test_chebyshev_p_two_over_k_is_elementary() -> None:
    """For p = 2/k SymPy integrates r (1 - r^p)^{-1/p} after r = s^k; p = 2/3 as a witness."""
    s, x = sp.symbols("s x", positive=True)
    integrand = 3 * s**5 * (1 - s**2) ** sp.Rational(-3, 2)  # r = s^3, p = 2/3
    primitive = sp.integrate(sp.expand_power_base(integrand), s)
    assert not primitive.has(sp.hyper, sp.Integral)
    value = (primitive.subs(s, x) - primitive.subs(s, 0)).subs(x, sp.Rational(1, 2))
    evaluate = Evaluator(
        context(40), {p: sp.Rational(2, 3), gamma: sp.Integer(1), law.x: sp.Rational(1, 8)}
    )
    assert abs(evaluate(law.stored_energy_closed()) - evaluate(value)) < 10**-35
