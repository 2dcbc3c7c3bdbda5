"""False claims that differ from true ones only where something vanishes, or in their logic."""

from __future__ import annotations

import pytest
import sympy as sp

from rodproof.derivations import ledger
from rodproof.derivations.checks.domains import ON_LOADS
from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.exact.limits import limit
from rodproof.derivations.notation import (
    Chain,
    Either,
    Every,
    Iff,
    Implies,
    Qstar,
    W,
    Wstar,
    chain,
    equal,
    instances,
    m,
    n,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.symbols import chiral_gap, eta, gamma, iota, p

x, y, N = sp.symbols("x y N", real=True)
h = sp.Symbol("h", positive=True)
z = sp.Symbol("z")

# -- the exact engine --------------------------------------------------------------------------

MAY_VANISH = [
    sp.sqrt(sp.Abs(x)),
    sp.sqrt(x**2 + y**2),
    (x**2 + y**2) ** (p / 2),
    (x**2 + y**2) ** (1 / p),
    sp.sqrt(x**2 - 2 * x + 1),
    sp.sqrt(1 - sp.cos(x) ** 2),
    x**p,
]


@pytest.mark.parametrize("power", MAY_VANISH)
def test_a_power_of_what_may_vanish_is_not_positive(power: sp.Expr) -> None:
    assert Field().sign(power) is None
    assert Field().sign(1 + power) == 1


def test_a_power_of_what_is_positive_is() -> None:
    assert Field((x**2 + y**2,)).sign((x**2 + y**2) ** (p / 2)) == 1


def test_squares_of_what_may_not_be_real_have_no_sign() -> None:
    assert Field().sign(z**2 + 1) is None
    assert not Field().equal(sp.Abs(z) ** 2, z**2)


def test_nothing_is_divided_by_a_hidden_zero() -> None:
    zeros = [sp.sin(t) ** 2 + sp.cos(t) ** 2 - 1 for t in (x, y)]
    with pytest.raises(OutOfReach):
        Field().equal(1 / zeros[0], 2 / zeros[1])


def test_contradictory_facts_are_refused() -> None:
    with pytest.raises(OutOfReach):
        Field((x, -x))


@pytest.mark.parametrize(
    ("expr", "variable", "target"),
    [
        ((iota + h) / (iota + 2 * h), h, sp.Integer(0)),  # 1, but 1/2 at iota = 0
        (N / (iota * N + 1), N, sp.oo),  # 1/iota, but infinite at iota = 0
        (sp.sin(x) / sp.Abs(x), x, sp.Integer(0)),  # 1 from above, -1 from below
        (sp.sin(N), N, sp.oo),
    ],
)
def test_limits_that_are_not_there(expr: sp.Expr, variable: sp.Symbol, target: sp.Expr) -> None:
    with pytest.raises(OutOfReach):
        limit(expr, variable, target)


# -- the prover --------------------------------------------------------------------------------

NOT_PROVED = [
    chain(0, "<", Qstar(m, n)),  # 0 at zero load
    Implies(chain(gamma, "<=", 1), chain(gamma, "<", 1)),
    Implies(chain(eta, "<", -1), chain(gamma, "<", 1)),  # a hypothesis that is never met
    Iff(positive(eta - 1), chain(eta, ">=", 1)),
    Iff(positive(eta - 1), chain(eta, ">", 1, ">", gamma)),
]


@pytest.mark.parametrize("claim", NOT_PROVED)
def test_the_prover_sees_equality_and_idle_hypotheses(claim: sp.Basic) -> None:
    assert Identity(ON_LOADS).decide(claim, explain=False).holds is not True


def test_a_weak_inequality_may_hold_with_equality_on_the_edge() -> None:
    assert Identity(ON_LOADS).decide(chain(0, "<=", Qstar(m, n))).holds


# -- statements: a relation, a quantifier or an argument exchanged ------------------------------


def _turned(tree: sp.Basic, old: object, new: object) -> sp.Basic:
    """The first chain of the tree with one relation in place of another."""
    first = next(c for c in sp.preorder_traversal(tree) if isinstance(c, Chain))
    marks = sp.Tuple(*(sp.Symbol(str(new if r == old else r)) for r in first.relations))
    return tree.xreplace({first: Chain(first.args[0], marks)})


def _either(tree: sp.Basic, part: int) -> sp.Basic:
    args = list(tree.args)
    args[part] = Either(*args[part].args)
    return tree.func(*args)


def _statement(name: str) -> tuple[sp.Basic, object]:
    (found,) = ledger.find((name,))
    return found.accepted, found.check


FALSE_TWINS = {
    "intro-poynting-chirality": lambda t: _turned(t, "<", "<="),
    "v3-positive-consequences": lambda t: _turned(t, ">", ">="),
    "matconst1-iff": lambda t: _turned(t, "<", "<="),
    "matconst2": lambda t: _turned(t, "<", "<="),
    "matconst2-chain": lambda t: _turned(t, "<", "<="),
    "pure-force-m-zero": lambda t: _turned(t, "=", "<="),
    "theta-alternatives": lambda t: t.xreplace(
        {e: Every(*e.args) for e in sp.preorder_traversal(t) if isinstance(e, Either)}
    ),
    "couple-M1-zero-cases": lambda t: _either(t, 0),
    "wstar-definition": lambda t: t.xreplace({Wstar(m, n): Wstar(n, m)}),
    "w-definition": lambda t: t.xreplace({W(u, v): W(v, u)}),
    "extra-first-integral-energy": lambda t: t.xreplace({Wstar(m, n): Wstar(n, m)}),
    "q-forms-positive-definite": lambda t: Implies(chain(0, "<=", chiral_gap), t.args[1]),
}


@pytest.mark.parametrize("name", FALSE_TWINS)
def test_false_twins_are_rejected(name: str) -> None:
    tree, check = _statement(name)
    twin = FALSE_TWINS[name](tree)
    assert twin != tree
    assert check.decide(tree, explain=False).holds
    assert check.decide(twin, explain=False).holds is not True


def test_one_energy_is_not_the_other() -> None:
    tree, check = _statement("wstar-definition")
    assert check.decide(equal(W(u, v), tree.sides[1]), explain=False).holds is not True
    assert check.decide(equal(*tree.sides[:1] * 2), explain=False).holds is not True


def test_m1_zero_cases_are_an_implication() -> None:
    tree, check = _statement("couple-M1-zero-cases")
    assert check.decide(Every(*tree.args), explain=False).holds is not True
    assert check.decide(_either(tree, 1), explain=False).holds is not True


# -- second routes -----------------------------------------------------------------------------


def test_a_false_inequality_shows_on_the_second_route() -> None:
    found = Identity(ON_LOADS).confirm(chain(Qstar(m, n), "<", 0))
    assert found is not None and found.residual > 1


@pytest.mark.parametrize("name", ["twist-limit-u3", "circle-limit-curvature", "n-thresh"])
def test_the_second_route_does_not_use_the_derived_formula(name: str) -> None:
    """It has its own number for the limit, or the threshold, in the statement."""
    tree, check = _statement(name)
    good = check.confirm(tree)
    assert good is not None and good.residual < 1e-30
    meaning = getattr(getattr(check, "check", check), "meaning", None) or check.states[0]
    values = meaning.route(meaning.sample(0), context(65))
    first = next(iter(tree.args)) if isinstance(tree, Every) else tree
    left = next(iter(instances(first)[0].sides))
    assert any(key in values for key in sp.preorder_traversal(left))


def test_no_couple_changes_no_length() -> None:
    (found,) = ledger.find(("twist-poynting",))
    assert found.check.decide(found.printed).counterexample is not None
    assert found.read_as is not None and found.check.decide(found.read_as).holds
