"""States under couples alone: the derivation's truths, and broken twins that must show."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.checks.couple import domains
from rodproof.derivations.checks.couple.domains import OfState
from rodproof.derivations.checks.couple.equations import CIRCLES, HELICES, TWISTED
from rodproof.derivations.checks.couple.route import torsion
from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import equal, u
from rodproof.derivations.symbols import v3
from rodproof.derivations.theory import couple, euler
from rodproof.derivations.theory.euler import M1, phi_s
from rodproof.derivations.theory.frames import phi, psi, theta


@pytest.mark.parametrize("branch", [*HELICES, *CIRCLES, *TWISTED], ids=lambda b: b.meaning.name)
def test_the_states_are_equilibria_when_built_and_measured(branch: domains.Branch) -> None:
    values, residual = branch.built(0, context(60))
    assert residual < 1e-45
    assert abs(values[sp.Symbol("v1", real=True)]) < 1e-45


@pytest.mark.parametrize("name", [phi, psi])
def test_a_wrong_sign_of_an_angle_shows_in_the_balance(name: sp.Symbol) -> None:
    branch = HELICES[0]
    angle = dict(zip((phi, theta, psi), branch.configuration.angles, strict=True))[name]
    _, residual = branch.built(0, context(60), {name: -angle})
    assert residual > 1e-3


def test_a_wrong_sign_of_a_strain_shows_on_the_second_route() -> None:
    right = OfState(HELICES)
    bend = HELICES[0].meaning.components[sp.Symbol("u1", real=True)]
    assert right.confirm(equal(u[1], bend)).residual > 1e-3  # the other branch has the other sign
    assert OfState(HELICES[:1]).confirm(equal(u[1], bend)).residual < 1e-40


def test_the_couple_of_a_helix_is_along_its_axis() -> None:
    vector = couple.in_fixed_basis(couple.helix().couple)
    assert all(Field().is_zero(e) for e in vector[:2])
    assert Field().equal(vector[2], -M1 / sp.sin(theta))


def test_shape_of_the_centre_line_agrees_with_its_closed_form() -> None:
    line = couple.center_line()
    tangent = couple.tangent(couple.helix()).subs(phi, phi_s * couple.s)
    assert all(Field().equal(sp.diff(a, couple.s), b) for a, b in zip(line, tangent, strict=True))
    assert Field().equal(line[0] ** 2 + line[1] ** 2, (v3 * sp.sin(theta) / phi_s) ** 2)
    assert couple.shape().torsion == phi_s * sp.cos(theta) / v3


def test_handedness_is_that_of_the_twisting_couple() -> None:
    for sign in (1, -1):
        shape = domains.shaped(sign)
        assert Field(shape.positive).sign(shape.components[torsion]) == -sign
        assert Field(shape.positive).sign(shape.components[euler.M3]) == -sign
