"""The constrained laws are limits of the full law, exactly; not truncations of it."""

from __future__ import annotations

import itertools

import pytest
import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.symbols import LOADS, beta, chiral_gap, eta, gamma, iota, p
from rodproof.derivations.theory import constitutive as theory
from rodproof.derivations.theory import constrained as rods

RIGID = tuple(name for name, c in rods.CONSTRAINTS.items() if c.rigid is not None)
SETS = (
    *((name,) for name in rods.CONSTRAINTS),
    ("unshearable", "inextensible"),
    ("unshearable", "untwisted"),
    ("untwisted", "inextensible"),
    ("unshearable", "achiral"),
    ("planar", "unshearable"),
    ("planar", "unshearable", "inextensible"),
)


@pytest.mark.parametrize("names", SETS, ids="+".join)
def test_limit_of_the_compliance_is_the_inverse_of_the_kept_stiffness(names: tuple) -> None:
    """Also: rows and columns of held strains vanish, so their loads appear nowhere."""
    C = rods.compliance_at_rest(*names)
    at = list(rods.kept(names))
    product = rods.stiffness_at_rest(*names) * C.extract(at, at)
    field = Field()
    assert all(field.is_zero(entry) for entry in product - sp.eye(len(at)))
    held = rods.reactions(names)
    assert all(C[i, j] == C[j, i] == 0 for i in held for j in range(6))
    assert not {LOADS[i] for i in held} & rods.dual_form(*names).free_symbols


@pytest.mark.parametrize("names", SETS, ids="+".join)
def test_order_of_the_limits_does_not_matter(names: tuple) -> None:
    field, wanted = Field(), rods.compliance_at_rest(*names)
    for other in itertools.permutations(names):
        found = rods.compliance_at_rest(*other)
        assert all(field.is_zero(entry) for entry in found - wanted)


@pytest.mark.parametrize("name", RIGID)
def test_strains_are_the_limit_of_the_strains(name: str) -> None:
    """Not of K^-1 alone: Q*, the radial factor and all six strains tend to the constrained ones.

    By limits of leading terms with symbolic p; the generic load has only positive components.
    """
    positive = sp.symbols("a1:7", positive=True)
    at = dict(zip(LOADS, positive, strict=True))
    modulus, field = rods.CONSTRAINTS[name].rigid, Field()
    form = limit(sp.expand(theory.dual_form().subs(at)), modulus, sp.oo)
    wanted = rods.dual_form(name).subs(at)
    assert field.equal(form, wanted)
    factor = (gamma**p + theory.y**p) ** (-1 / p)
    full = theory.compliance_at_rest() * sp.Matrix(positive)
    for row, strain in zip(full, rods.strains(name), strict=True):
        # the factor is continuous in Q*, so that the limit of the product is the product
        value = limit(sp.expand(row), modulus, sp.oo) * factor.subs(theory.y, sp.sqrt(wanted))
        assert field.equal(value, strain.subs(at))


@pytest.mark.parametrize("names", SETS, ids="+".join)
def test_loads_invert_the_strains_and_are_the_full_loads_at_kept_strains(names: tuple) -> None:
    """Legendre: W restricted has these loads as its gradient, so it is the dual of the limit."""
    lost = {
        s: (1 if i == 5 else 0) for i, s in enumerate(theory.STRAINS) if i not in rods.kept(names)
    } | ({iota: sp.S.Zero} if rods.achiral(names) else {})
    field = Field()
    assert field.equal(theory.quadratic_form().subs(lost), rods.quadratic_form(*names))
    K = rods.stiffness_at_rest(*names)
    eps = sp.Matrix([theory.STRAIN_FROM_REST[i] for i in rods.kept(names)])
    for i, strain in zip(rods.kept(names), eps, strict=True):
        symbol = theory.STRAINS[i]
        half = sp.diff(rods.quadratic_form(*names), symbol) / 2
        assert field.equal(half, (K * eps)[list(eps).index(strain)])  # dQ = 2 K eps
        assert field.equal(
            (theory.stiffness_at_rest() * sp.Matrix(theory.STRAIN_FROM_REST))[i].subs(lost), half
        )


@pytest.mark.parametrize("names", SETS, ids="+".join)
def test_hessians_are_inverse_to_each_other(names: tuple) -> None:
    """(K + g k k^T/Q)(C - h e e^T/Q*) = 1 where sigma = s K eps: y = s x, s the factor y/x."""
    K = rods.stiffness_at_rest(*names)
    at = list(rods.kept(names))
    C = rods.compliance_at_rest(*names).extract(at, at)
    eps = sp.Matrix([theory.STRAIN_FROM_REST[i] for i in at])
    q = sp.Symbol("q", positive=True)  # x^p; g = q/(1 - q), h = y^p/(gamma^p + y^p) = q
    form = rods.quadratic_form(*names)
    k, e = K * eps, C * (K * eps)
    product = (K + q / (1 - q) * k * k.T / form) * (C - q * e * e.T / form)
    field = Field()
    assert all(field.is_zero(entry) for entry in product - sp.eye(len(at)))


def test_reflection_commutes_with_the_law_exactly_without_chirality() -> None:
    K, R = theory.stiffness_at_rest(), rods.REFLECTION
    commutator = K * R - R * K
    assert commutator.subs(iota, 0) == sp.zeros(6, 6)
    assert [i for i in range(6) if R[i, i] == -1] == list(rods.CONSTRAINTS["planar"].lost)
    assert commutator[2, 5] == 2 * iota


def test_kept_coupling_and_kept_share_are_different_limits() -> None:
    """With chi = iota/(beta eta) kept, eta -> oo leaves twist softer by 1 - chi^2."""
    chi = sp.Symbol("chi", positive=True)
    entry = theory.compliance_at_rest()[2, 2]
    soft = sp.cancel(entry.subs(iota, chi * beta * eta))
    assert Field().equal(limit(soft, eta, sp.oo, (1 - chi**2,)), 1 / (beta**2 * (1 - chi**2)))
    assert rods.compliance_at_rest("inextensible")[2, 2] == 1 / beta**2
    assert sp.cancel(entry - eta**2 / chiral_gap) == 0


def test_wrong_limits_are_rejected() -> None:
    """zeta -> oo does not remove the coupling, and eta -> oo does not stiffen the twist."""
    assert rods.compliance_at_rest("unshearable")[2, 5] != 0
    assert rods.compliance_at_rest("inextensible")[2, 2] != 0
    assert rods.reactions(("planar",)) == ()
    assert rods.reactions(("unshearable", "inextensible")) == (3, 4, 5)
