"""The oracle against definitions: quadratures, numerical derivatives and inverses in mpmath."""

from __future__ import annotations

import mpmath
import pytest
from flint import arb, ctx

from rodproof.codegen.measure import oracle

GENERIC = (0.7, 1.1, 0.9, 1.6, -0.4, 2.3, 3.3)
LOAD = (0.3, -0.2, 0.5, 0.1, 0.7, -1.1)
STRAIN = (0.1, -0.3, 0.2, 0.15, -0.05, -0.25)  # from rest


@pytest.fixture
def mp() -> mpmath.ctx_mp.MPContext:
    context = mpmath.mp.clone()
    context.dps = 70
    return context


def constants(p: float = GENERIC[-1]) -> oracle.Constants:
    return oracle.Constants(*map(arb, (*GENERIC[:6], p)))


def balls(values: tuple[float, ...]) -> list[arb]:
    return [arb(value) for value in values]


def close(ball: arb, number: mpmath.mpf, digits: int) -> bool:
    with ctx.workprec(400):
        return bool(abs(ball - arb(number)) < arb(10) ** -digits)


def dual_form(mp, s):
    alpha, beta, zeta, eta, iota, _, _ = map(mp.mpf, GENERIC)
    s = [mp.mpf(entry) for entry in s]
    block = mp.matrix([[beta**2, iota], [iota, eta**2]])
    coupled = mp.matrix([s[2], s[5]])
    rest = (s[0] ** 2 + s[1] ** 2) / alpha**2 + (s[3] ** 2 + s[4] ** 2) / zeta**2
    return rest + (coupled.T * mp.inverse(block) * coupled)[0]


def form(mp, e):
    alpha, beta, zeta, eta, iota, _, _ = map(mp.mpf, GENERIC)
    e = [mp.mpf(entry) for entry in e]
    straight = alpha**2 * (e[0] ** 2 + e[1] ** 2) + zeta**2 * (e[3] ** 2 + e[4] ** 2)
    return straight + (beta * e[2]) ** 2 + (eta * e[5]) ** 2 + 2 * iota * e[2] * e[5]


def w_star(mp, s, p):
    """The definition of the complementary energy."""
    gamma, p = mp.mpf(GENERIC[5]), mp.mpf(p)
    top = mp.sqrt(dual_form(mp, s))  # t = r^2
    return mp.quad(lambda r: r * (gamma**p + r**p) ** (-1 / p), mp.linspace(0, top, 9))


@pytest.mark.parametrize("p", [0.7, 1.0, 2.0, 3.3])
def test_complementary_energy_is_its_integral(mp, p: float) -> None:
    (value,) = oracle.certain(oracle.complementary_energy, constants(p), balls(LOAD))
    assert close(value, w_star(mp, LOAD, p), 40 if p >= 1 else 15)


def test_strains_are_the_gradient(mp) -> None:
    step = mp.mpf(10) ** -20

    def energy(i: int, sign: int) -> mpmath.mpf:
        moved = [mp.mpf(entry) + sign * step * (i == j) for j, entry in enumerate(LOAD)]
        return w_star(mp, moved, GENERIC[-1])

    found = oracle.certain(oracle.strains, constants(), balls(LOAD))
    for i, strain in enumerate(found):
        assert close(strain, (energy(i, 1) - energy(i, -1)) / (2 * step), 25)


def test_loads_undo_strains() -> None:
    with ctx.workprec(400):
        back = oracle.strains(constants(), oracle.loads(constants(), balls(STRAIN)))
        assert all(abs(a - b) < arb(10) ** -90 for a, b in zip(back, balls(STRAIN), strict=True))


def test_stored_energy_is_the_work_along_the_ray(mp) -> None:
    gamma, p = mp.mpf(GENERIC[5]), mp.mpf(GENERIC[6])
    top = mp.sqrt(form(mp, STRAIN))
    work = mp.quad(lambda r: gamma * r * (1 - r**p) ** (-1 / p), mp.linspace(0, top, 9))
    (value,) = oracle.certain(oracle.stored_energy, constants(), balls(STRAIN))
    assert close(value, work, 40)


def test_duality_of_the_energies() -> None:
    """W + W* = sigma . eps at corresponding states."""
    with ctx.workprec(400):
        strain = balls(STRAIN)
        load = oracle.loads(constants(), strain)
        (w,) = oracle.stored_energy(constants(), strain)
        (dual,) = oracle.complementary_energy(constants(), load)
        product = sum(a * b for a, b in zip(load, strain, strict=True))
        assert abs(w + dual - product) < arb(10) ** -90


@pytest.mark.parametrize("name", ["stiffness", "compliance"])
def test_tangents_are_difference_quotients(name: str) -> None:
    law, tangent, at = {
        "stiffness": (oracle.loads, oracle.stiffness, STRAIN),
        "compliance": (oracle.strains, oracle.compliance, LOAD),
    }[name]
    with ctx.workprec(800):
        step = arb(10) ** -60
        found = tangent(constants(), balls(at))
        for j in range(6):
            ahead, behind = balls(at), balls(at)
            ahead[j], behind[j] = ahead[j] + step, behind[j] - step
            pairs = zip(law(constants(), ahead), law(constants(), behind), strict=True)
            for i, (a, b) in enumerate(pairs):
                assert abs((a - b) / (2 * step) - found[6 * i + j]) < arb(10) ** -100


def test_rest_is_the_linear_law() -> None:
    rest = [arb(0)] * 6
    with ctx.workprec(400):
        assert all(value == 0 for value in oracle.strains(constants(0.7), rest))
        assert oracle.stored_energy(constants(0.7), rest)[0] == 0
        stiffness = oracle.stiffness(constants(0.7), rest)
        assert abs(stiffness[0] - arb(2.3) * arb(0.7) ** 2) < arb(10) ** -90


def test_answers_are_certain_where_all_cancels() -> None:
    """A strain 1e-14 from the limit, where 1 - x^p has lost what a double holds."""
    near = oracle.Constants(*map(arb, (1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.3)))
    load = oracle.certain(oracle.loads, near, [arb(1 - 1e-14), *[arb(0)] * 5])
    assert load[0].rel_accuracy_bits() >= oracle.ACCURACY
    assert load[0] > 1e40


def test_a_component_that_all_but_vanishes_stops_nothing() -> None:
    """With one load alone and p = 1000 its own compliance is 1e-18000 of the others."""
    sharp = oracle.Constants(*map(arb, (1.0, 1.0, 1.0, 1.0, 0.0, 1e-18, 1000.0)))
    compliance = oracle.certain(oracle.compliance, sharp, [arb(1.0), *[arb(0)] * 5])
    with ctx.workprec(400):
        assert abs(compliance[0]) < arb(2) ** -oracle.ACCURACY
        assert abs(compliance[7] - 1) < arb(2) ** -oracle.ACCURACY


def test_the_stiffness_at_loads_is_that_at_their_strains() -> None:
    with ctx.workprec(600):
        load = balls(LOAD)
        strain = oracle.strains(constants(), load)
        pairs = zip(
            oracle.stiffness_at_loads(constants(), load),
            oracle.stiffness(constants(), strain),
            strict=True,
        )
        assert all(abs(a - b) < arb(10) ** -150 for a, b in pairs)
        x = oracle.norm(oracle.whitened_strain(constants(), strain))
        (gap,) = oracle.limit_gap(constants(), load)
        assert abs(gap - (1 - x ** arb(GENERIC[-1]))) < arb(10) ** -150


CONSTRAINTS = [("unshearable",), ("inextensible",), ("unshearable", "inextensible"), ("planar",)]


@pytest.mark.parametrize("names", CONSTRAINTS, ids=",".join)
def test_a_constrained_rod_is_the_full_one_without_reactions(names: tuple[str, ...]) -> None:
    """The derived limits of the law, and what the measurement takes for them."""
    import sympy as sp

    from rodproof.derivations.symbols import LOADS, STRAINS, alpha, beta, eta, gamma, iota, p, zeta
    from rodproof.derivations.theory import constrained

    def wide(value: float) -> sp.Float:
        return sp.Float(value, 60)

    values = [*GENERIC[:4], 0.0 if constrained.achiral(names) else GENERIC[4], *GENERIC[5:]]
    numbers = dict(zip((alpha, beta, zeta, eta, iota, gamma, p), map(wide, values), strict=True))
    at = constrained.kept(names)
    load = [LOAD[i] if i in at else 0.0 for i in range(6)]
    numbers |= dict(zip(LOADS, map(wide, load), strict=True))
    law = [sp.N(e.subs(numbers), 40) for e in constrained.strains(*names)]
    rigid = {c.rigid.name for n in names if (c := constrained.CONSTRAINTS[n]).rigid is not None}
    given = [
        1.0 if c.name in rigid else v
        for c, v in zip((alpha, beta, zeta, eta), values[:4], strict=True)
    ]
    own = oracle.Constants(*map(arb, (*given, *values[4:])))
    found = oracle.certain(oracle.strains, own, balls(tuple(load)))
    with ctx.workprec(400):
        for ball, number in zip(found, law, strict=True):
            assert abs(ball - arb(str(number))) < arb(10) ** -35
    strain = [STRAIN[i] / 3 if i in at else 0.0 for i in range(6)]
    numbers |= {s: wide(e) + int(s is STRAINS[5]) for s, e in zip(STRAINS, strain, strict=True)}
    loads = [sp.N(e.subs(numbers), 40) for e in constrained.loads(*names)]
    held = oracle.certain(oracle.loads, own, balls(tuple(strain)))
    with ctx.workprec(400):
        for i, number in zip(at, loads, strict=True):
            assert abs(held[i] - arb(str(number))) < arb(10) ** -35
