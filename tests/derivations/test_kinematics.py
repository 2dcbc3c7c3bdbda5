"""Frames and balance: truths of the derivation, by a chart of angles and by broken twins."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.checks import balance as balance_rules
from rodproof.derivations.checks import kinematics as rules
from rodproof.derivations.checks.kinematics import d, u_vector
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Cross, Dot, Every, Prime, Summed, equal, k
from rodproof.derivations.theory import balance, kinematics
from rodproof.derivations.theory.frames import dot, euler_frame, phi, psi, theta


def test_directors_are_right_handed_and_orthonormal() -> None:
    R, field = kinematics.rotation(), Field()
    identity = R.T * R - sp.eye(3)
    assert all(field.is_zero(entry) for entry in identity)
    assert field.equal(R.det(), sp.Integer(1))


def test_rates_are_a_skew_matrix_times_the_directors() -> None:
    spin, field = kinematics.rotation_rate() * kinematics.rotation().T, Field()
    assert all(field.is_zero(entry) for entry in spin + spin.T)


def test_darboux_vector_of_euler_angles() -> None:
    """phi' g_3 + theta' e_2 + psi' d_3, turn by turn: another chart of the same frames."""
    s = sp.Symbol("s")
    angles = {a: sp.Function(str(a), real=True)(s) for a in (phi, theta, psi)}
    directors = [director.subs(angles) for director in euler_frame()]
    u = sum((x.cross(x.diff(s)) for x in directors), sp.zeros(3, 1)) / 2
    e2 = sp.Matrix([-sp.sin(phi), sp.cos(phi), 0]).subs(angles)
    turns = (angles[phi].diff(s) * sp.Matrix([0, 0, 1]) + angles[theta].diff(s) * e2
             + angles[psi].diff(s) * directors[2])  # fmt: skip
    field = Field()
    assert all(field.is_zero(entry) for entry in u - turns)
    assert field.equal(dot(u, directors[2]), dot(directors[0].diff(s), directors[1]))


@pytest.mark.parametrize(
    "twin",
    [
        equal(Prime(d[k]), Cross(d[k], u_vector)),
        equal(u_vector, Summed(Cross(d[k], Prime(d[k])), k)),
        equal(u_vector, Summed(Cross(Prime(d[k]), d[k]), k) / 2),
        equal(d[3], Cross(d[2], d[1])),
        equal(d[3], Dot(d[1], d[2])),
    ],
)
def test_broken_twins_of_kinematics_are_rejected(twin: sp.Basic) -> None:
    assert rules.ON_FRAMES.decide(twin).holds is False


def test_one_director_does_not_determine_the_darboux_vector() -> None:
    assert rules.DARBOUX.decide(equal(Prime(d[3]), Cross(u_vector, d[3]))).holds is False
    two = Every(*(equal(Prime(d[i]), Cross(u_vector, d[i])) for i in (1, 2)))
    assert rules.ON_FRAMES.decide(two).holds


def test_the_resultant_is_additive_and_moves_like_a_couple() -> None:
    """Contact actions inside a segment cancel; C(o) changes by the moment of the force."""
    a, b, c = balance.a, balance.b, sp.Symbol("c", real=True)
    couple, force = balance.resultant_couple(), balance.resultant_force()
    joined = couple.subs(b, c) + couple.subs(a, c)
    assert (joined - couple).applyfunc(sp.expand) == sp.zeros(3, 1)
    shift = sp.Matrix(sp.symbols("h1:4"))
    moved = couple.subs(dict(zip(balance.origin, balance.origin + shift, strict=True)))
    assert (moved - couple + shift.cross(force)).applyfunc(sp.expand) == sp.zeros(3, 1)


def test_the_other_sign_of_the_contact_force_is_rejected() -> None:
    n, f = balance_rules.n_vector, balance_rules.f_vector
    assert balance_rules.LOCAL.decide(equal(Prime(n) - f, 0)).holds is False
    r, m, body = balance_rules.r_vector, balance_rules.m_vector, balance_rules.l_vector
    assert balance_rules.LOCAL.decide(equal(Prime(m) + Cross(n, Prime(r)) + body, 0)).holds is False
