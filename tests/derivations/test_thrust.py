"""Pure thrust: the derivation's truths, the equilibrium route, and checks that can fail."""

import contextlib

import mpmath
import pytest
import sympy as sp

from rodproof.derivations.checks.equilibrium import balance_residual, curve, frame, loads_of
from rodproof.derivations.checks.thrust import domains, numeric, points
from rodproof.derivations.checks.thrust.branch import angle_is_function_of_thrust
from rodproof.derivations.exact.evaluate import context
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Every, Iff, chain, equal, positive, u, v
from rodproof.derivations.printed import section_4_2
from rodproof.derivations.proof import sampling
from rodproof.derivations.symbols import chiral_gap, gamma, iota, u3, v1, v2, v3
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import thrust as theory
from rodproof.derivations.theory.frames import euler_frame, theta

STATEMENTS = {s.id: s for s in section_4_2.statements()}


def test_only_one_component_of_the_couple_balance_is_left():
    field = Field((chiral_gap,))
    couple = theory.unbalanced_couple()
    assert field.is_zero(couple[0])
    assert field.is_zero(couple[2])
    assert not field.is_zero(couple[1])


def test_dual_form_does_not_depend_on_psi():
    loads = dict(zip(constitutive.LOADS, (0, 0, 0, *theory.force_components()), strict=True))
    assert Field((chiral_gap,)).equal(constitutive.dual_form().subs(loads), theory.dual_form())


def test_weight_is_the_dual_form_over_the_thrust_squared():
    assert Field((chiral_gap,)).equal(
        theory.weight(sp.cos(theta)), theory.dual_form(sp.Integer(1), theta)
    )
    near = theory.thrust_near_zero(points.angle)
    assert Field(domains.BRANCH.positive).equal(near, domains.BRANCH.components[theory.N])


def test_angle_is_a_function_of_thrust():
    assert angle_is_function_of_thrust()


@pytest.mark.parametrize("seed", range(3))
def test_no_sheared_state_below_the_threshold(seed):
    point = points.sheared_constants(seed)
    ctx = context(30)
    threshold = ctx.mpf(str(sp.N(theory.threshold().subs(point), 30)))
    cosine = numeric.cosine_at(point, threshold * ctx.mpf("1.001"), ctx)
    assert 0.9 < cosine < 1
    for polar in (0.001, 0.4, 1.2):  # r' is never along g_3
        force = threshold * ctx.mpf("0.999")
        load = [0, 0, 0, -force * ctx.sin(polar), 0, force * ctx.cos(polar)]
        strain = numeric.strains_at(point, load, ctx)
        assert strain[3] * ctx.cos(polar) + (1 + strain[5]) * ctx.sin(polar) > 0


def _sheared_state(**broken):
    """A sheared state with some components multiplied by -1."""
    point, ctx, s = domains.BRANCH.sample(1), context(50), theory.s
    c = domains.BRANCH.components
    twist = broken.get("u3", 1) * c[u3] * s + points.psi0
    d = [list(vector) for vector in euler_frame(sp.Integer(0), points.angle, twist)]
    for name in ("d1", "d2"):
        k = int(name[1]) - 1
        d[k] = [broken.get(name, 1) * entry for entry in d[k]]
    strains = [broken.get(str(symbol), 1) * c[symbol] for symbol in (v1, v2, v3)]
    tangent = [sum(e * vector[i] for e, vector in zip(strains, d, strict=True)) for i in range(3)]
    r = curve([s * t for t in tangent], s, point, ctx)
    found = balance_residual(r, frame(d, s, point, ctx), point, ctx, [sp.Rational(2, 7)])
    thrust = domains.BRANCH.evaluator(ctx, point)(theory.N)
    misses = [abs(a - b) for a, b in zip(found.forces[0], (0, 0, thrust), strict=True)]
    return max(found.residual, *map(float, misses), *(float(abs(m)) for m in found.couples[0]))


def test_sheared_state_is_in_equilibrium():
    assert _sheared_state() < 1e-30


@pytest.mark.parametrize("sign", ["u3", "v1", "v2", "d1", "d2"])
def test_a_wrong_sign_shows_in_the_balance(sign):
    with contextlib.suppress(ValueError):  # the strains may also leave the domain of the law
        assert _sheared_state(**{sign: -1}) > 1e-3


def test_loads_of_inverts_the_law():
    point = {**sampling.with_loads(2), gamma: sp.Integer(1)}
    ctx = context(50)
    load = [ctx.mpf(int(point[s].p)) / int(point[s].q) for s in constitutive.LOADS]
    strain = numeric.strains_at(point, load, ctx)
    m, n = loads_of(strain[:3], [strain[3], strain[4], 1 + strain[5]], point, ctx)
    assert max(abs(a - b) for a, b in zip([*m, *n], load, strict=True)) < mpmath.mpf("1e-40")


def test_strains_past_the_limit_have_no_loads():
    point = {**sampling.constants(0), gamma: sp.Integer(1)}
    ctx = context(30)
    with pytest.raises(ValueError, match="strain limit"):
        loads_of([ctx.mpf(9)] * 3, [ctx.mpf(9)] * 3, point, ctx)


@pytest.mark.parametrize(
    ("name", "broken"),
    [
        ("straight-u12", equal(u[2], u[2], 0)),
        ("sheared-tensile-state", positive(v[3])),
        ("fN-inequality", chain(0, "<", points.b / points.c / 2, "<",
                                points.fN(sp.Integer(1)), "=", points.fN(sp.Integer(1)))),
        ("moduli-condition-2-iff", STATEMENTS["moduli-condition-2-iff"].printed),
        ("moduli-condition-1", Iff(positive(points.c), positive(points.c - 1),
                                   positive(points.c))),
        ("r-dot-g1", STATEMENTS["r-dot-g1"].printed),
        ("theta-alternatives", STATEMENTS["theta-alternatives"].printed),
        ("straight-rprime", STATEMENTS["straight-rprime"].printed),
        ("straight-twisted-unsheared", STATEMENTS["straight-twisted-unsheared"].printed),
        ("pure-force-m-zero", Iff(Every(*[equal(u[1], 0)] * 3), Every(*[equal(u[1], 0)] * 3))),
    ],
)  # fmt: skip
def test_weaker_or_unloaded_claims_are_rejected(name, broken):
    assert STATEMENTS[name].check.decide(broken).holds is False


def test_twist_has_the_sign_of_minus_iota_times_thrust():
    for state, sign in zip(domains.STRAIGHT, (1, -1), strict=True):
        for seed in range(3):
            point = state.sample(seed)
            twist = state.evaluator(context(20), point)(u3)
            assert twist * sign * point[iota] < 0
