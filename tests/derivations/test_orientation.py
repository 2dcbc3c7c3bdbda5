"""Orientation: the determinant over all frames, and conditions that are sharp."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.checks import orientation as rules
from rodproof.derivations.notation import ForAll, Iff, Implies, Q, chain, positive, u, v
from rodproof.derivations.proof import conditions
from rodproof.derivations.symbols import CONSTANTS, STRAINS, alpha, beta, eta, iota
from rodproof.derivations.theory import orientation
from rodproof.derivations.theory.constitutive import quadratic_form
from rodproof.derivations.theory.orientation import a, x1, x2

GAP = beta**2 * eta**2 - iota**2
INSIDE = chain(Q(u, v), "<", 1)
FLEXURE = sp.sqrt(u[1] ** 2 + u[2] ** 2)


def test_determinant_is_the_triple_product_for_every_frame() -> None:
    assert rules._over_all_frames()


def test_the_rim_counts() -> None:
    """At v_3 = a |flexure| the determinant vanishes at a point of the closed disc."""
    at = {**orientation.REST, STRAINS[0]: sp.Integer(3), STRAINS[1]: sp.Integer(4), a: 2,
          STRAINS[5]: sp.Integer(10)}  # fmt: skip
    least = orientation.least_on_disc(orientation.determinant())
    place = [entry.subs(at) for entry in least.place]
    assert place[0] ** 2 + place[1] ** 2 == 4
    assert orientation.determinant().subs(at).subs({x1: place[0], x2: place[1]}) == 0


def test_the_printed_radius_is_not_necessary() -> None:
    """a = 3/5 passes the sharp condition and not the printed one."""
    values = (1, 1, 1, 1, sp.Rational(5, 3), 0, 2)
    at = dict(zip(CONSTANTS, map(sp.sympify, values), strict=True)) | {a: sp.Rational(3, 5)}
    assert (a - alpha * (1 - beta / sp.sqrt(GAP))).subs(at) > 0
    assert (1 - a**2 / alpha**2 - beta**2 / GAP).subs(at) > 0


def test_beyond_the_sharp_condition_a_section_turns_over() -> None:
    """a = 1 at the same constants: a strain with Q < 1 and v_3 < a |flexure|."""
    values = (1, 1, 1, 1, sp.Rational(5, 3), 0, 2)
    at = dict(zip(CONSTANTS, map(sp.sympify, values), strict=True))
    strain = {**orientation.REST, STRAINS[0]: sp.Rational(4, 5), STRAINS[5]: sp.Rational(7, 10)}
    assert quadratic_form().subs(at).subs(strain) < 1
    assert strain[STRAINS[5]] < strain[STRAINS[0]]


@pytest.mark.parametrize(
    "twin",
    [
        Implies(chain(1, "<", eta**2), positive(v[3])),
        Iff(ForAll(INSIDE, positive(v[3])), chain(1 + iota**2 / beta**2, "<", eta**2)),
        Iff(ForAll(INSIDE, chain(v[3], ">", a * FLEXURE)),
            chain(a / alpha + beta**2 / GAP, "<=", 1)),
        Iff(ForAll(INSIDE, chain(v[3], ">", -a * FLEXURE)),
            chain(a**2 / alpha**2 + beta**2 / GAP, "<=", 1)),
    ],
)  # fmt: skip
def test_broken_conditions_are_rejected(twin: sp.Basic) -> None:
    assert conditions.Ensures().decide(twin).holds is False


def test_an_open_disc_or_a_weak_inequality_is_another_claim() -> None:
    def claim(domain: str, relation: str) -> Iff:
        disc = chain(x1**2 + x2**2, domain, a**2)
        return Iff(ForAll(disc, positive(rules.det)), chain(v[3], relation, a * FLEXURE))

    assert rules.ON_THE_DISC.decide(claim("<=", ">")).holds
    assert rules.ON_THE_DISC.decide(claim("<", ">")).holds is False
    assert rules.ON_THE_DISC.decide(claim("<=", ">=")).holds is False
