"""Each rewriting rule twice: as an exact identity, and for its error beside what it replaces."""

from __future__ import annotations

import random
from dataclasses import replace

import mpmath
import numpy as np
import pytest
import sympy as sp

from rodproof.codegen import lower, scene
from rodproof.codegen.kernel import Kernel, KernelError, Output
from rodproof.codegen.passes import stabilise as rules
from rodproof.codegen.passes import stabilise_at_loads as at_loads
from rodproof.codegen.passes import stabilise_p2 as square
from rodproof.codegen.passes.choose import GENERAL, Case
from rodproof.codegen.passes.choose import rules as chain
from rodproof.codegen.passes.order import order
from rodproof.codegen.passes.stabilise import Rule, apply
from rodproof.codegen.primitives import WorkShare
from rodproof.codegen.targets.mpmath_target import Evaluator
from rodproof.derivations.theory import constitutive as theory

NAIVE = {kernel.name: kernel for kernel in lower.lower(scene.committed("full_rod"))}
CASES = {
    "general": GENERAL,
    "achiral": Case(achiral=True),
    "p=2": Case(square=True),
    "p=2, achiral, from n1": Case(square=True, achiral=True, first=3),
}
STEPS = [
    pytest.param(case, name, k, id=f"{label}-{name}-{rule.name}")
    for label, case in CASES.items()
    for name in NAIVE
    for k, rule in enumerate(chain(name, case))
    if case == GENERAL or rule not in chain(name)
]

COMPLEMENTS = rules.complement_compliance(rules.SOFTEN_DEFINITIONS)


def before_and_after(name: str, k: int, case: Case) -> tuple[Kernel, Kernel]:
    kernel = NAIVE[name]
    for rule in chain(name, case)[:k]:
        kernel = apply(rule, kernel)
    return order(kernel), order(apply(chain(name, case)[k], kernel))


def point(name: str, rng: random.Random, case: Case = GENERAL) -> tuple[dict, dict]:
    """A generic point of the kernel's domain, and constants."""
    c = {n: rng.uniform(0.5, 2) for n in ("alpha", "beta", "zeta", "eta", "gamma")}
    c |= {"iota": rng.uniform(-0.9, 0.9) * c["beta"] * c["eta"], "p": rng.uniform(0.4, 6)}
    c |= {"iota": 0} if case.achiral else {}
    c |= {"p": 2} if case.square else {}
    reach = 3 if NAIVE[name].inputs[0] == "m1" else 0.15
    values = [rng.uniform(-reach, reach) for _ in range(6)]
    values[5] += 1
    return dict(zip(NAIVE[name].inputs, values, strict=True)), c


@pytest.mark.parametrize(("case", "name", "k"), STEPS)
def test_rule_is_an_identity(case: Case, name: str, k: int) -> None:
    rng = random.Random(k)
    before, after = before_and_after(name, k, case)
    for _ in range(2):
        where, constants = point(name, rng, case)
        old = Evaluator(50).evaluate(before, where, constants)
        new = Evaluator(50).evaluate(after, where, constants, scale=2.0**40)
        size = max(map(abs, old.values()))
        assert all(abs(old[key] - new[key]) < size * mpmath.mpf(10) ** -44 for key in old)


@pytest.mark.parametrize(
    "rule",
    [
        rules.COMPLETE_DUAL_FORM,
        rules.COMPLETE_FORM,
        rules.REDUCE_STRAINS,
        rules.REDUCE_LOADS,
    ],
)
def test_rational_rules_are_exact(rule: Rule) -> None:
    """With the definitions put in, both sides are the same rational function."""
    lowered = dict(zip(rules.e, lower.strains_at_loads(), strict=True))
    lowered |= dict(zip(rules.s, lower.loads_at_strains(), strict=True))
    earlier = (*rules.COMPLETE_DUAL_FORM.definitions, *rules.COMPLETE_FORM.definitions)
    defined = {a.symbol: a.expr for a in (*earlier, *rule.definitions, *rule.constants)}
    for before, after in rule.pairs:
        difference = (before - after).xreplace(lowered)
        for _ in range(6):
            difference = difference.xreplace(defined)
        difference = difference.xreplace({rules.unscale: sp.S.One})  # the gauge of scale one
        assert sp.cancel(difference) == 0


@pytest.mark.parametrize("first", range(6))
def test_floors_are_the_direction_of_a_load(first: int) -> None:
    """What the floors add at rest has unit length and is the reduced form of one load."""
    floor = {name: value / rules.tiny for name, value in rules.FLOORS[first].items()}
    reduced = dict(zip(("a1", "a2", "a3", "b1", "b2", "b3", "c3", "c6"), range(8), strict=True))
    names = ("mu_1", "mu_2", "mu_3", "nu_1", "nu_2", "nu_3", "twist", "dilatation")
    got = [sp.sympify(floor.get(name, 0)) for name in reduced]
    moduli = sp.symbols("alpha beta zeta eta", positive=True)
    constants = {a.symbol: a.expr for a in rules.CHIRAL_CONSTANTS}
    units = (moduli[0], moduli[0], moduli[1], moduli[2], moduli[2], moduli[3])
    defined = {a.symbol: a.expr for a in rules.COMPLETE_DUAL_FORM.definitions}
    loads = dict.fromkeys(rules.LOADS, sp.S.Zero) | {rules.LOADS[first]: units[first]}
    if first == 2:  # with the n3 that leaves no dilatation
        loads[rules.LOADS[5]] = rules.iota / moduli[1]
    if first == 5:  # n3 alone, of unit length
        loads[rules.LOADS[5]] = moduli[3] * rules.gap * sp.sqrt(rules.per_gap)
    squares = sum(floor.get(name, 0) ** 2 for name in ("a1", "a2", "a3", "b1", "b2"))
    unit = squares + rules.gap * floor.get("c6", sp.S.Zero) ** 2
    assert sp.cancel(unit.xreplace(constants)) == 1
    for name, value in zip(names, got, strict=True):
        want = rules.symbol(name)
        for _ in range(3):
            want, value = (e.xreplace(defined).xreplace(loads) for e in (want, value))
        assert sp.cancel((want - value).xreplace(constants)) == 0


def test_complements_are_exact() -> None:
    """On |k| = 1 the sums of squares are K^-1 less the rank-one term, for any weight."""
    reduced = [a.symbol for a in rules.COMPLETE_DUAL_FORM.definitions if a.name[:2] in ("mu", "nu")]
    defined = {a.symbol: a.expr for a in (*rules.CHIRAL_CONSTANTS,)}
    size = sp.sqrt(theory.dual_form())
    defined |= {
        a.symbol: a.expr for a in (*rules.COMPLETE_DUAL_FORM.definitions, *_directions().values())
    }
    moduli = dict(zip(rules.d, zip(rules.directions, rules.moduli, strict=True), strict=True))
    defined |= {d: k / modulus for d, (k, modulus) in moduli.items()}
    defined |= {rules.remain: 1 - rules.share, rules.tiny: sp.S.Zero}
    assert len(reduced) == 6
    for before, after in COMPLEMENTS.pairs:
        difference = before - after
        for _ in range(8):
            difference = difference.xreplace(defined)
        difference = sp.together(difference.xreplace({rules.size: size}))
        numerator = sp.expand(sp.fraction(sp.cancel(difference))[0])
        assert numerator == 0


def _directions() -> dict[str, rules.Assignment]:
    skipped = {"ratio", "power", "remain"}
    return {a.name: a for a in COMPLEMENTS.definitions if a.name not in skipped}


def test_work_share_is_the_ratio_of_energy_to_work() -> None:
    """d/dx of the energy written with the share is the load, and both vanish at rest: exact."""
    x, p = theory.x, sp.Symbol("p", positive=True)
    depth = -sp.log(1 - x**p)
    share = WorkShare(depth, p)
    energy = x**2 * (1 - x**p) ** (-1 / p) * share
    kept = sp.Symbol("share")
    slope = sp.diff(energy, x).subs(share, kept)
    assert sp.simplify(slope - x * (1 - x**p) ** (-1 / p)) == 0


def test_rule_that_finds_nothing_is_refused() -> None:
    with pytest.raises(KernelError, match="finds no"):
        apply(rules.COMPLETE_FORM, NAIVE["strains"])


def test_wrong_rule_is_rejected() -> None:
    """A twin of the radial rule with the smaller of gamma and y outside is no identity."""
    rule = rules.SCALE_RADIAL_FACTOR
    wrong = replace(rule, pairs=((rule.pairs[0][0], rule.pairs[0][1] * 2),))
    where, constants = point("strains", random.Random(1))
    old = Evaluator(50).evaluate(NAIVE["strains"], where, constants)
    new = Evaluator(50).evaluate(order(apply(wrong, NAIVE["strains"])), where, constants)
    assert abs(old["u", (0,)] - new["u", (0,)]) > abs(old["u", (0,)]) / 10


# --- error in doubles -----------------------------------------------------------------------

MODULES = [
    {
        "log1p": np.log1p,
        "expm1": np.expm1,
        "Max": lambda *a: np.maximum.reduce(a),
        "Min": lambda *a: np.minimum.reduce(a),
    },
    "numpy",
]
SMALL = {rules.tiny: sp.Float(float(np.finfo(float).tiny)), rules.log_max: sp.Integer(700)}


def in_doubles(expr: sp.Expr, values: dict[str, float]) -> float:
    symbols = sorted(expr.free_symbols, key=str)
    with np.errstate(all="ignore"):
        function = sp.lambdify(symbols, expr, MODULES)
        return float(function(*(np.float64(values[s.name]) for s in symbols)))


def stepwise(rule: Rule, values: dict[str, float]) -> float:
    """The right side in doubles, definition by definition, as a module computes it."""
    known = dict(values)
    for a in rule.definitions:
        known[a.name] = in_doubles(a.expr.xreplace(SMALL), known)
    return in_doubles(rule.pairs[0][1].xreplace(SMALL), known)


def unfolded(rule: Rule, expr: sp.Expr) -> sp.Expr:
    """The right side with the rule's definitions put in, for one evaluation in doubles."""
    for _ in range(6):
        expr = expr.xreplace({a.symbol: a.expr for a in rule.definitions})
    return expr.xreplace(SMALL)


def ulps(got: float, want: mpmath.mpf) -> float:
    return float(abs(mpmath.mpf(got) - want) / abs(want) * 2**52) if np.isfinite(got) else np.inf


EDGES = [
    (square.SCALE_RADIAL_FACTOR, {"y": 1e-170, "gamma": 2e-170, "p": 2.0}),
    (square.SCALE_RADIAL_FACTOR, {"y": 1e170, "gamma": 2.0, "p": 2.0}),
    (square.SPLIT_STRAIN_WEIGHT, {"y": 1e-170, "gamma": 1.1e-170, "p": 2.0}),
    (at_loads.SCALE_LOAD_FACTOR, {"y": 1e10, "gamma": 1.5, "p": 40.0}),
    (at_loads.SCALE_LOAD_ROOT, {"y": 1e170, "gamma": 2.0, "p": 2.0}),
    (at_loads.GROW_WITH_LOAD, {"y": 1e6, "gamma": 2.0, "p": 2.5}),
    (at_loads.GROW_BY_SQUARE, {"y": 1e7, "gamma": 2.0, "p": 2.0}),
    (at_loads.KEEP_GAP, {"y": 1e6, "gamma": 2.0, "p": 2.5}),
    (at_loads.KEEP_GAP_SQUARE, {"y": 1e8, "gamma": 2.0, "p": 2.0}),
    (rules.SCALE_RADIAL_FACTOR, {"y": 1e10, "gamma": 1.5, "p": 40.0}),
    (rules.SCALE_RADIAL_FACTOR, {"y": 1e-50, "gamma": 2e-50, "p": 8.0}),
    (rules.SPLIT_STRAIN_WEIGHT, {"y": 1e-50, "gamma": 1.1e-50, "p": 8.0}),
    (rules.GROW_LOAD_FACTOR, {"x": 0.9999999949999999, "gamma": 1.3, "p": 0.7}),
    (rules.GROW_LOAD_WEIGHT, {"x": 0.9999999949999999, "gamma": 1.3, "p": 0.7}),
]


@pytest.mark.parametrize(("rule", "values"), EDGES)
def test_rule_lowers_the_error(rule: Rule, values: dict[str, float]) -> None:
    """Where ``why`` says that the left side fails it does, and the right side holds."""
    before, _ = rule.pairs[0]
    with mpmath.workdps(60):
        exact = {name: mpmath.mpf(value) for name, value in values.items()}
        if "x" in values:  # the right side takes Q; give both the same point
            values = {**values, "q": values["x"] ** 2}
            exact["x"] = mpmath.sqrt(mpmath.mpf(values["q"]))
        symbols = sorted(before.free_symbols, key=str)
        truth = sp.lambdify(symbols, before, "mpmath")(*(exact[s.name] for s in symbols))
        left = ulps(in_doubles(before, values), truth)
        right = ulps(stepwise(rule, values), truth)
    assert right < 8
    assert left > 100 * max(right, 1)


def test_the_spread_weight_does_not_overflow() -> None:
    """(y/gamma)^p = 1e330 overflows; alpha^2 times that, with alpha = 1e-80, does not."""
    values = {"alpha": 1e-80, "gamma": 1.0, "p": 3.3, "y": 1e100}
    rule = at_loads.SPREAD_WEIGHT
    values |= {"factor": 1e100, "size": 1e100, "mu_1": 1e100}
    values["t1"], values["share"] = 1e-80, in_doubles(rules.y**rules.p, values)
    values["rise"] = in_doubles(at_loads.RISE.expr.xreplace(SMALL), values)
    for name in ("rise_per_size", "bend_rise", "h1"):
        (a,) = (a for a in rule.definitions if a.name == name)
        values[name] = in_doubles(a.expr.xreplace(SMALL), values)
    before, after = rule.pairs[0]
    assert not np.isfinite(in_doubles(before, values))
    assert ulps(in_doubles(after, values), mpmath.mpf(10) ** (330 - 160 + 100)) < 2**11  # 1.6 p


def test_energies_at_two_hold_where_the_textbook_cancels() -> None:
    """x = 1e-8: 1 - (1 - x^2)^(1/2) has no digit left; likewise W* at y = 1e-8 gamma."""
    stored, dual = theory.ELEMENTARY[sp.Integer(2)]
    pairs = (
        (stored, square.CLOSE_STORED_ENERGY, {"x": 1e-8, "gamma": 1.3, "p": 2.0}),
        (dual, square.CLOSE_COMPLEMENTARY_ENERGY, {"y": 1e-8, "gamma": 1.3, "p": 2.0}),
    )
    for closed, rule, values in pairs:
        values = {**values, "q": values.get("x", 0.0) ** 2}
        with mpmath.workdps(60):
            names = sorted(closed.free_symbols, key=str)
            exact = (mpmath.mpf(values[s.name]) for s in names)
            truth = sp.lambdify(names, closed, "mpmath")(*exact)
        assert ulps(in_doubles(unfolded(rule, rule.pairs[0][1]), values), truth) < 4
        assert ulps(in_doubles(closed, values), truth) > 1e10


def test_energies_at_two_are_the_closed_forms_of_the_theory() -> None:
    """Exactly: the stable forms, unfolded, less 1 - (1 - x^2)^(1/2) and its dual."""
    x, y, g = theory.x, theory.y, sp.Symbol("gamma", positive=True)
    stored, dual = theory.ELEMENTARY[sp.Integer(2)]
    w = unfolded(square.CLOSE_STORED_ENERGY, square.CLOSE_STORED_ENERGY.pairs[0][1])
    assert sp.simplify(w.subs(sp.Symbol("q", real=True), x**2) - stored) == 0
    w_star = unfolded(
        square.CLOSE_COMPLEMENTARY_ENERGY, square.CLOSE_COMPLEMENTARY_ENERGY.pairs[0][1]
    )
    for larger, smaller in ((g, y), (y, g)):
        picked = w_star.replace(sp.Max, lambda *_, a=larger: a).replace(
            sp.Min, lambda *_, a=smaller: a
        )
        assert sp.simplify(picked - dual) == 0


@pytest.mark.parametrize("rule", [rules.COMPLETE_DUAL_FORM, rules.COMPLETE_FORM])
def test_squares_hold_at_the_chiral_edge(rule: Rule) -> None:
    """iota -> beta eta along the soft (stiff) direction; the constants are rounded once."""
    before, after = rule.pairs[0]
    beta, eta = 1.1, 1.6
    values = {"alpha": 0.7, "beta": beta, "zeta": 0.9, "eta": eta}
    values |= {"iota": beta * eta * (1 - 1e-12), "u1": 0.0, "u2": 0.0, "v1": 0.0, "v2": 0.0}
    values |= {"m1": 0.0, "m2": 0.0, "n1": 0.0, "n2": 0.0}
    values |= {"u3": 0.3 / beta, "stretch": -0.3 / eta, "m3": 0.3 * beta, "n3": 0.7}
    with mpmath.workdps(60):
        exact = {name: mpmath.mpf(value) for name, value in values.items()}
        symbols = sorted(before.free_symbols, key=str)
        truth = sp.lambdify(symbols, before, "mpmath")(*(exact[s.name] for s in symbols))
        for a in rule.constants:
            names = sorted(a.expr.free_symbols, key=str)
            values[a.name] = float(
                sp.lambdify(names, a.expr, "mpmath")(*(exact[s.name] for s in names))
            )
    names = [
        a.name for a in order(Kernel("k", (), rule.definitions, (Output("w", (), after),))).body
    ]
    for name in names:
        (a,) = (a for a in rule.definitions if a.name == name)
        values[name] = in_doubles(a.expr, values)
    left, right = ulps(in_doubles(before, values), truth), ulps(in_doubles(after, values), truth)
    assert right < left / 100
