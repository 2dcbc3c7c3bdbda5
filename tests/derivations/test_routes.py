"""Second routes: each agrees with what is held to be true, and sees a twin that is not."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import pytest
import sympy as sp

from rodproof.derivations import ledger
from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.notation import Chain, Every, Implies, Prime, equal, m
from rodproof.derivations.proof import routed
from rodproof.derivations.proof.routed import Route, at_odds, short, vanish_together
from rodproof.derivations.records import Confirmation
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, zeta
from rodproof.derivations.theory.frames import phi, theta
from rodproof.derivations.theory.loading import couple, phase

Twin = Callable[[sp.Basic], sp.Basic]


def _chains(tree: sp.Basic) -> list[Chain]:
    return [c for c in sp.preorder_traversal(tree) if isinstance(c, Chain)]


def _off(which: int = -1, by: object = sp.Rational(1, 10**6)) -> Twin:
    """A little added to the left side of one claim."""

    def twin(tree: sp.Basic) -> sp.Basic:
        claim = _chains(tree)[which]
        left, *others = claim.sides
        return tree.xreplace({claim: Chain(sp.Tuple(left + by, *others), claim.args[1])})

    return twin


def _round(which: int = -1) -> Twin:
    """One inequality turned round."""

    def twin(tree: sp.Basic) -> sp.Basic:
        claim = _chains(tree)[which]
        other = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}
        marks = sp.Tuple(*(sp.Symbol(other[r]) for r in claim.relations))
        return tree.xreplace({claim: Chain(claim.args[0], marks)})

    return twin


def _with(*pairs: tuple[Any, Any]) -> Twin:
    return lambda tree: tree.subs([(old, new) for old, new in pairs], simultaneous=True)


def _exactly(old: Any, new: Any) -> Twin:
    """One node of the tree in place of another, nothing evaluated."""
    return lambda tree: tree.xreplace({old: new})


def _one_less(tree: sp.Basic) -> sp.Basic:
    """The last of several things left out."""
    return tree.func(*tree.args[:-1])


def _both(tree: sp.Basic) -> sp.Basic:
    """The last of two things said twice."""
    return tree.func(*tree.args[:-2], tree.args[-1], tree.args[-1])


def _printed(name: str) -> Twin:
    """What is printed, where that is false."""
    (statement,) = ledger.find((name,))
    assert statement.accepted is not statement.printed
    return lambda tree: statement.printed


Y, L = (sp.Symbol(name, positive=True) for name in "YL")
dim, s = sp.Function("dim"), sp.Function("s")
K = (beta**2 * eta**2 - iota**2) / (beta**2 * zeta**2)
M_ = sp.IndexedBase("M", real=True)

#: A false twin of each: small changes where the truth has a border, other quantities elsewhere.
TWINS: dict[str, Twin] = {
    "intro-moduli-interpretation": _with((gamma * iota, gamma * iota**2)),
    "intro-poynting-chirality": _round(0),
    "intro-helix-two-parameters": lambda tree: sp.Tuple(couple, phase),
    "config-triple": _both,
    "v3-positive": _off(),
    "v3-positive-consequences": _round(),
    "strain-columns": _off(),
    "stress-columns": _off(),
    "tb-relation": _off(),
    "tb-almansi": _off(),
    "tb-norm": _off(),
    "constants-hypothesis": _printed("constants-hypothesis"),
    "q-forms-positive-definite": _printed("q-forms-positive-definite"),
    "saturation-not-invertible": _exactly(s(Y), s(Y / 2)),
    "constants-dimensions": _exactly(equal(dim(zeta), 1), equal(dim(zeta), L)),
    "seven-dimensionless-parameters": _exactly(iota / L, iota / L**2),
    "all-but-p-interpretation": _with((gamma * zeta**2, gamma * zeta)),
    "v3-sign": _round(),
    "matconst1-iff": _off(),
    "matconst2": _off(),
    "det-positive": _round(),
    "nondimensionalization": _exactly(equal(gamma, 1), equal(gamma, 2)),
    "pure-force-m-zero": _exactly(equal(m[3], 0), equal(m[1] + m[2], 0)),
    "theta-alternatives": _printed("theta-alternatives"),
    "sheared-tensile-state": _off(by=-sp.Rational(1, 10**4)),
    "sheared-subcase-N-positive": _round(),
    "moduli-condition-1-necessary": _off(by=-sp.Rational(1, 10**4)),
    "moduli-condition-1": _off(),
    "moduli-condition-2-necessary": _off(),
    "moduli-condition-2": _off(),
    "moduli-condition-2-iff": _printed("moduli-condition-2-iff"),
    "sheared-phi-constant": _off(),
    "M2-zero-iff": _exactly(Prime(theta), Prime(phi)),
    "extra-twist-v3-positive": _off(),
    "twist-poynting": _printed("twist-poynting"),
    "M1-zero-remark": _exactly(M_[1], M_[2]),
    "extra-strain-rate-two-times": _off(),
    "dissipation-constants": _printed("dissipation-constants"),
    "dna-bending": _with((gamma * alpha**2, gamma * beta**2)),
    "dna-twisting": _off(),
    "dna-stretching": _off(),
    "dna-coupling": _off(),
    "dna-constants-given": _printed("dna-constants-given"),
    "extra-dna-orientation": _off(),
    "tangent-stiffness": _off(),
    "dna-unshearable": _off(),
}


def _looked(name: str, twin: Twin = lambda tree: tree) -> Confirmation | None:
    (statement,) = ledger.find((name,))
    return statement.check.confirm(twin(statement.accepted))


@pytest.mark.parametrize("name", TWINS)
def test_a_route_sees_what_is_false(name: str) -> None:
    (statement,) = ledger.find((name,))
    twin = TWINS[name](statement.accepted)
    assert twin != statement.accepted
    right, wrong = (statement.check.confirm(tree) for tree in (statement.accepted, twin))
    assert right is not None and right.residual < ledger.AGREEMENT
    assert wrong is not None and wrong.residual > 1e-13


#: A false twin of another kind: one that says less, or too much, or twice the same.
MORE_TWINS: dict[str, tuple[str, Twin]] = {
    "a modulus left out": ("all-but-p-interpretation", _both),
    "a parameter left out": ("intro-helix-two-parameters", lambda tree: sp.Tuple(couple)),
    "a parameter too many": (
        "intro-helix-two-parameters", lambda tree: sp.Tuple(couple, theta, phase)
    ),
    "a group left out": ("seven-dimensionless-parameters", _one_less),
    "a group twice": ("seven-dimensionless-parameters", _both),
    "a range left out": ("dissipation-constants", _one_less),
    "a modulus of four": ("dna-constants-given", _one_less),
    "a component left out": ("pure-force-m-zero", _exactly(equal(M_[3], 0), equal(M_[2], 0))),
    "one branch only": (
        "theta-alternatives", lambda tree: Implies(
            tree.args[0], tree.args[1].func(tree.args[1].args[0], Every(*tree.args[1].args[1].args))
        )
    ),
    "another power of p": ("moduli-condition-2-iff", _with((K - 1, K))),
}  # fmt: skip


@pytest.mark.parametrize("name", MORE_TWINS)
def test_a_route_sees_what_is_missing(name: str) -> None:
    statement, twin = MORE_TWINS[name]
    found = _looked(statement, twin)
    assert found is not None and found.residual > 1e-13


#: Rows whose route measures the law: with another law they must not be confirmed.
MEASURED = (
    "intro-moduli-interpretation", "matconst1-iff", "matconst2", "moduli-condition-1",
    "moduli-condition-2", "moduli-condition-2-necessary", "extra-twist-v3-positive",
    "dna-stretching", "extra-dna-orientation", "constants-dimensions",
)  # fmt: skip


@pytest.fixture
def another_law(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """K with 1/100 more in bending, where it is a length squared, and in extension."""

    def inverse(numbers: NumericLaw) -> list[list[Any]]:
        other = numbers.K.copy()
        for k in (0, 5):
            other[k, k] += numbers.ctx.mpf(1) / 100
        return [list(row) for row in numbers.ctx.inverse(other).tolist()]

    found = cached_property(inverse)
    found.__set_name__(NumericLaw, "_inverse")
    routed._looked.cache_clear()
    monkeypatch.setattr(NumericLaw, "_inverse", found)
    yield
    routed._looked.cache_clear()


@pytest.mark.usefixtures("another_law")
@pytest.mark.parametrize("name", MEASURED)
def test_a_route_sees_another_law(name: str) -> None:
    seen = _looked(name)
    assert seen is not None and seen.residual > 1e-13


# -- margins -------------------------------------------------------------------------------------


def test_margins() -> None:
    assert short(1e-9) == 0 and short(-0.5) == 0.5 and short(0.0) == math.inf
    assert at_odds(1, 2) == at_odds(-1, -2) == 0 and at_odds(3, -2) == 3
    assert vanish_together(0, 1e-60) == vanish_together(2, -1) == 0 and vanish_together(0, -2) == 2


def test_a_route_without_points_or_with_no_number_confirms_nothing() -> None:
    def nothing(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
        yield from ()

    def unknown(printed: sp.Basic, ctx: Any) -> Iterator[Any]:
        yield from (ctx.mpf(0), ctx.mpf("nan"), ctx.mpf(0))

    with pytest.raises(ValueError, match="empty"):
        Route("no points", nothing).look(sp.Integer(0))
    assert Route("not a number", unknown).look(sp.Integer(0)).residual == math.inf
    assert context(20).mpf("nan") != 0
