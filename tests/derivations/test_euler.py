"""The Euler frame and the reduced equations: truths, other routes, broken twins."""

from __future__ import annotations

import itertools

import pytest
import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.ledger import check, find, judge
from rodproof.derivations.notation import Prime, Wstar, equal, m, n
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import LOADS, STRAINS, v3
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.frames import dot, phi, psi, theta


def statement(name: str) -> Statement:
    (found,) = find([name])
    return found


@pytest.mark.parametrize("frame", [euler.directors, euler.intermediate_frame])
def test_frames_are_orthonormal_and_right_handed(frame):
    vectors = frame()
    for (i, a), (j, b) in itertools.product(enumerate(vectors), repeat=2):
        assert euler.reduce_squares(dot(a, b)) == (1 if i == j else 0)
    volume = euler.reduce_squares(dot(vectors[0].cross(vectors[1]), vectors[2]))
    assert volume == 1


def test_darboux_vector_turns_every_director():
    u = euler.darboux(euler.directors())
    for d in euler.directors():
        difference = euler.along_vector(d) - u.cross(d)
        assert all(euler.reduce_squares(x) == 0 for x in difference)


def test_strains_by_composition_of_turns():
    """phi' g_3 + theta' e_2 + psi' d_3, the textbook sum of three turns."""
    _, e2, d3 = euler.intermediate_frame()
    total = euler.phi_s * euler.G3 + euler.theta_s * e2 + euler.psi_s * d3
    expected = euler.in_frame(sp.ImmutableMatrix(total), euler.directors())
    assert expected == euler.curvatures()


def test_third_couple_is_constant_by_the_law_alone():
    """M_3' from the balance vanishes once kinematics and law are used, whatever N is."""
    rate = euler.couple_rates()[euler.M3_s]
    sines = {
        euler.M1: -sp.sin(theta) * euler.phi_s / euler.u_scalar,
        euler.M2: euler.theta_s / euler.u_scalar,
    }
    assert sp.expand(rate.subs(sines)) == 0


@pytest.mark.parametrize("angle", [phi, psi])
def test_the_law_in_the_directors_forgets_the_angle(angle):
    strains = [e.xreplace(euler.reduced_loads()) for e in euler.strains_from_loads()]
    facts = Field()
    for strain in (strains[2], strains[5]):
        assert facts.is_zero(sp.diff(strain, angle))
    third = dict(euler.reduced_law())
    assert facts.equal(strains[2], third[STRAINS[2]])
    assert facts.equal(strains[5], third[v3])


def test_six_equations_lose_phi_at_the_poles():
    assert euler.determinant() == sp.sin(theta)
    assert euler.determinant().subs(theta, 0) == 0


def test_any_phi_solves_the_system_along_the_axis():
    """theta = 0, no bending couple, psi = u_3 s - phi(s): every residual vanishes for any phi'."""
    state = {
        theta: 0, euler.theta_s: 0, euler.M1: 0, euler.M2: 0,
        euler.M1_s: 0, euler.M2_s: 0, euler.M3_s: 0,
        euler.psi_s: STRAINS[2] - euler.phi_s,
    }  # fmt: skip
    assert all(sp.expand(e.subs(state)) == 0 for e in euler.reduced_system())


def test_balance_in_the_directors_keeps_the_size_of_the_force():
    rates = euler.load_rates()
    assert sp.expand(sp.Add(*(x * rates[x] for x in LOADS[3:]))) == 0


def test_printed_sign_of_theta_is_refuted_exactly():
    found = judge(statement("ode-theta"))
    assert found.verdict == "refuted"
    assert found.counterexample is not None
    assert found.counterexample.endswith("1 against -1")


@pytest.mark.parametrize("name", ["ode-theta", "ode-M1", "ode-M2", "euler-u1", "six-equations"])
def test_broken_twins_are_rejected(name):
    (found,) = check([statement(name)], mutants=True)
    assert found.survivors == ()
    assert found.mutants_equivalent in (0, 2)  # both sides of `= 0` may be scaled
    assert found.residual is not None
    assert found.residual < 1e-30


def test_wrong_energy_integral_is_not_conserved():
    """W* - N cos(theta) in place of W* + N cos(theta)."""
    claim = statement("extra-first-integral-energy")
    wrong = equal(Prime(Wstar(m, n) - n[3]), 0)
    assert claim.check.decide(claim.printed).holds
    assert claim.check.decide(wrong, explain=False).holds is False
