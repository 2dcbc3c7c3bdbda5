"""Tangents of the law: structure, rest, definiteness, and what monotonicity does not say."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.checks import monotonicity as rules
from rodproof.derivations.checks.tangents import UNIT_STRAINS
from rodproof.derivations.exact.field import Field
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.ledger import check, find, judge
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import STRAINS, beta, chiral_gap, eta, iota, p
from rodproof.derivations.theory import monotonicity as theory
from rodproof.derivations.theory.constitutive import (
    STRAIN_FROM_REST,
    quadratic_form,
    stiffness_at_rest,
    x,
)


def statement(name: str) -> Statement:
    (found,) = find([name])
    return found


def test_hessian_has_its_structure_and_is_symmetric():
    facts = Field(UNIT_STRAINS.positive)
    hessian = theory.hessian()
    structure = theory.hessian_factor() * theory.hessian_core()
    for i in range(6):
        for j in range(6):
            assert facts.equal(hessian[i, j], structure[i, j])
            assert facts.equal(hessian[i, j], hessian[j, i])


def test_tangent_along_the_strain_is_the_slope_of_the_radial_law():
    """The bracket maps eps to K eps, so F/(1 - X) = dy/dx is the stiffness along the ray."""
    facts = Field(UNIT_STRAINS.positive)
    radial = theory.hessian_core() * sp.Matrix(STRAIN_FROM_REST)
    for entry, wanted in zip(radial, theory.load_direction(), strict=True):
        assert facts.equal(entry, wanted)
    slope = sp.diff(x * (1 - x**p) ** (-1 / p), x)
    assert Field((1 - x**p,)).equal(slope, (1 - x**p) ** (-1 / p - 1))


@pytest.mark.parametrize("power", [sp.Rational(1, 3), 1, sp.Rational(3, 2), 2, 5])
def test_second_term_vanishes_at_rest_though_its_power_of_Q_does_not(power):
    form = quadratic_form()
    k = theory.load_direction()
    term = theory.along_ray(form ** (p / 2 - 1) * k[0] * k[0]).subs(p, power)
    assert limit(term, theory.h, sp.Integer(0), (form, chiral_gap)) == 0
    assert rules.rest_is_uniform()


def test_definiteness_needs_the_coupling_hypothesis():
    K = stiffness_at_rest()
    assert K.subs(iota, beta * eta).det() == 0
    assert rules.stiffness_is_definite()
    assert Field((chiral_gap,)).sign(K.det(method="berkowitz")) == 1
    assert Field().sign(K.det(method="berkowitz")) is None


def test_flexure_can_fall_while_its_couple_grows():
    found = judge(statement("monotonicity-reading"))
    assert found.verdict == "reading"
    assert found.counterexample is not None
    assert "u1^A = 3/5 against u1^B = 4/9" in found.counterexample


def test_shifted_form_does_not_conclude():
    found = judge(statement("hessian-conclusion"))
    assert found.verdict == "reading"
    assert found.counterexample is not None
    assert "form = 0" in found.counterexample


@pytest.mark.parametrize("name", ["hess-m3-u3", "hess-m3-v3", "hessian-quadratic-form"])
def test_misprints_are_refuted_by_rational_counterexamples(name):
    found = judge(statement(name))
    assert found.verdict == "refuted"
    assert found.counterexample is not None
    left, right = found.counterexample.split(": ")[1].split(" against ")
    assert sp.Rational(left) != sp.Rational(right)


def test_misread_argument_fails_in_every_reading():
    """Q(u, v_3 - 1): as third component, with v_1, v_2 kept, and as a form without shear."""
    point = {s: sp.Integer(0) for s in STRAINS}
    point |= {STRAINS[2]: sp.Rational(3, 10), STRAINS[3]: sp.Rational(1, 5)}
    point[STRAINS[5]] = sp.Rational(8, 5)
    constants = {s: sp.Integer(1) for s in quadratic_form().free_symbols - set(STRAINS)}
    constants[iota] = sp.Integer(0)
    form = quadratic_form().subs(constants)
    true = form.subs(point)
    third = {**point, STRAINS[3]: 0, STRAINS[5]: point[STRAINS[5]] - 1}
    kept = {**point, STRAINS[5]: point[STRAINS[5]] - 1}
    no_shear = {**point, STRAINS[3]: 0}
    assert true == sp.Rational(49, 100)
    assert {form.subs(third), form.subs(kept), form.subs(no_shear)}.isdisjoint({true})


@pytest.mark.parametrize(
    "name", ["hess-m3-u3", "hessian-positive-definite", "extra-hessian-bounds"]
)
def test_broken_twins_are_rejected(name):
    (found,) = check([statement(name)], mutants=True)
    assert (found.survivors, found.mutants_equivalent) == ((), 0)
    assert found.residual is not None
    assert found.residual < 1e-30
