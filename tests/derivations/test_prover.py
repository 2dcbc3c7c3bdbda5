"""The prover: true claims are proved, false ones refuted with exact points, others left open."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations.checks.domains import ON_LOADS, ON_STRAINS
from rodproof.derivations.notation import (
    Every,
    Iff,
    Implies,
    Partial,
    Q,
    Qstar,
    W,
    chain,
    equal,
    instances,
    m,
    mu,
    n,
    nu,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.mutants import mutants
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.symbols import alpha, beta, chiral_gap, eta, gamma, iota, p

FLEXURE = equal(u[mu], (gamma**p + Qstar(m, n) ** (p / 2)) ** (-1 / p) * m[mu] / alpha**2)


def test_a_true_family_is_proved_for_each_index() -> None:
    found = Identity(ON_LOADS).decide(FLEXURE)
    assert found.holds and found.exact
    assert len(instances(FLEXURE)) == 2


def test_a_false_claim_gets_a_rational_counterexample() -> None:
    wrong = equal(u[mu], (gamma**p + Qstar(m, n) ** (p / 2)) ** (-1 / p) * m[mu] / alpha)
    found = Identity(ON_LOADS).decide(wrong)
    assert found.holds is False and found.counterexample is not None
    values = dict(found.counterexample.point)
    assert sp.sympify(found.counterexample.left) != sp.sympify(found.counterexample.right)
    assert all(sp.sympify(x).is_Rational for x in values.values())


def test_an_undefined_edge_is_found() -> None:
    """Q^{p/2 - 1} u_1^2 says nothing at rest if p < 2, though it is fine elsewhere."""
    smooth = equal(u[1] ** 2 * Q(u, v) ** (p / 2), (u[1] * Q(u, v) ** (p / 4)) ** 2)
    singular = equal(u[1] ** 2 * Q(u, v) ** (p / 2 - 1), u[1] ** 2 * Q(u, v) ** (p / 2 - 1))
    assert Identity(ON_STRAINS).decide(smooth).holds
    found = Identity(ON_STRAINS).decide(singular)
    assert found.holds is False and "edge" in found.method


def test_implications_and_equivalences() -> None:
    law = Identity(ON_LOADS)
    condition = Iff(positive(eta**2 - 1 - iota**2 / beta**2), positive(chiral_gap - beta**2))
    assert law.decide(condition).holds
    assert law.decide(Iff(positive(eta - 1), positive(chiral_gap))).holds is None
    inside = Implies(positive(1 - gamma), chain(gamma, "<", 1))
    assert law.decide(inside).holds


def test_ill_typed_notation_is_not_accepted() -> None:
    assert Identity(ON_STRAINS).decide(equal(Q(u, v[3] - 1), Q(u, v))).holds is not True


def test_the_second_route_sees_a_wrong_sign() -> None:
    check = Identity(ON_LOADS)
    right, wrong = FLEXURE, equal(*(s * k for s, k in zip(FLEXURE.sides, (1, -1), strict=True)))
    good, bad = check.confirm(right), check.confirm(wrong)
    assert good is not None and good.residual < 1e-45
    assert bad is not None and bad.residual > 1e-3


def test_the_second_route_of_the_energy_gradient() -> None:
    gradient = Every(*(equal(m[k], Partial(W(u, v), u[k])) for k in (1, 2, 3)))
    found = Identity(ON_STRAINS).confirm(gradient)
    assert found is not None and found.residual < 1e-45


@pytest.mark.parametrize("claim", [FLEXURE, equal(m[mu], Partial(W(u, v), u[mu]))])
def test_every_broken_twin_is_rejected(claim: sp.Basic) -> None:
    check = Identity(ON_LOADS if claim is FLEXURE else ON_STRAINS)
    twins = mutants(claim)
    assert len(twins) > 8
    assert [t.change for t in twins if check.decide(t.tree, explain=False).holds is not False] == []


def test_mutants_differ_from_the_original_and_do_not_repeat() -> None:
    twins = [t.tree for t in mutants(FLEXURE)]
    assert FLEXURE not in twins and len(set(twins)) == len(twins)
    assert equal(u[nu], FLEXURE.sides[1]) in twins
