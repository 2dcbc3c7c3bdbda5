"""The domains of Sections 4 and 4.1: states of the rod under the force N g_3, by Euler angles.

Vectors are linear forms in the symbols g_1, g_2, g_3 of the fixed basis. On a state the angles and
their rates are free, and so are N, m_3, v_3 and the positive scalar u of the law: the bending
couples follow from the kinematics, m_mu = u_mu/u, and the rates of the couple from its balance.
That covers sin(theta) = 0, where phi' could not be had from M_1. The second route never sees an
angle: it follows a true equilibrium (directors and couple as vectors, law forwards) for a few tiny
steps and reads angles, components and rates off the result.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import ON_LOADS, _of_loads
from rodproof.derivations.checks.orbits import (
    Orbit,
    determinant_of,
    law_at,
    residuals_of,
    turned,
)
from rodproof.derivations.exact.evaluate import number
from rodproof.derivations.notation import Cross, Dot, Prime, Wstar, m, n
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, alpha, gamma, p, u3, v3, zeta
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import euler as theory

e, d, g, M, N_ = (sp.IndexedBase(name, real=True) for name in ("e", "d", "g", "M", "N"))
n_vector, m_vector = sp.symbols("n_vector m_vector", real=True)
N, u_scalar, v_scalar = theory.N, theory.u_scalar, theory.v_scalar
UNIT_CONSTANTS = tuple(c for c in CONSTANTS if c != gamma)
_G = sp.symbols("g1:4", real=True)
_E, _D, _NK = (sp.symbols(f"{name}1:4", real=True) for name in ("e", "d", "N"))


def _linear(vector: sp.Matrix) -> sp.Expr:
    return sp.Add(*(c * basis for c, basis in zip(vector, _G, strict=True)))


_VECTORS: dict[sp.Symbol, sp.Expr] = {
    **{s: _linear(a) for s, a in zip(_E, theory.intermediate_frame(), strict=True)},
    **{s: _linear(a) for s, a in zip(_D, theory.directors(), strict=True)},
    n_vector: _linear(N * theory.G3),
    m_vector: _linear(theory.from_components(theory.COUPLE, theory.intermediate_frame())),
}


def _entries(vector: Any) -> sp.Matrix:
    """The components of a linear form in g_1, g_2, g_3."""
    if not isinstance(vector, sp.Expr):
        raise IllTyped(f"{vector} is no vector")
    form = sp.expand(vector.xreplace(_VECTORS))
    parts = [form.coeff(basis) for basis in _G]
    if sp.expand(form - _linear(parts)) != 0 or any(x.has(*_G) for x in parts):
        raise IllTyped(f"{vector} is no vector")
    return sp.Matrix(parts)


def _cross(a: Any, b: Any) -> sp.Expr:
    return _linear(_entries(a).cross(_entries(b)))


def _dot(a: Any, b: Any) -> sp.Expr:
    return _entries(a).dot(_entries(b))


def _prime(expr: Any) -> sp.Expr:
    moving = {*theory.RATES, N, *_G, *UNIT_CONSTANTS}
    if not isinstance(expr, sp.Expr) or expr.free_symbols - moving:
        raise IllTyped(f"the rate of {expr} is not among the unknowns")
    return theory.along(expr)


def _state() -> dict[sp.Symbol, sp.Expr]:
    """Everything that follows from the free quantities, each in terms of these alone."""
    strains = theory.curvatures()
    known: dict[sp.Symbol, sp.Expr] = dict(zip(STRAINS[:3], strains, strict=True))
    bending = dict(zip(LOADS[:2], (strains[0] / u_scalar, strains[1] / u_scalar), strict=True))
    known |= bending
    couple = (c.xreplace(bending) for c in theory.couple_in_frame())
    known |= dict(zip(theory.COUPLE, couple, strict=True))
    known |= dict(zip(LOADS[3:], theory.force(), strict=True))
    known |= dict(zip(_NK, theory.force_in_frame(), strict=True))
    known[v_scalar] = u_scalar * theory.SHEAR_OVER_BENDING
    known |= {s: known[v_scalar] * known[f] for s, f in zip(STRAINS[3:5], LOADS[3:5], strict=True)}
    rates = {rate: x.xreplace(known) for rate, x in theory.couple_rates().items()}
    vectors = {s: x.xreplace(known) for s, x in _VECTORS.items()}
    return {**known, **rates, **vectors}


def _sample(seed: int) -> Point:
    """Generic angles, rates and couples; constants with gamma = 1 for the second route."""
    names = (*theory.RATES, *theory.RATES.values(), N, LOADS[2], v3, u3, *_G)
    values = {
        x: sp.Rational((17 * k + 23 * seed) % 41 - 20, 13) or sp.Rational(3, 11)
        for k, x in enumerate(names)
    }
    values |= {u_scalar: sp.Rational(7 + seed, 5), v_scalar: sp.Rational(9 + seed, 7)}
    return {**sampling.constants(seed), gamma: sp.Integer(1), **values}


@cache
def _simple() -> tuple[Point, ...]:
    """d_3 across the force, along it, and between; small rates."""
    angles = ((0, sp.pi / 2, 0), (0, sp.pi / 2, sp.pi / 2), (0, 0, 0), (0, sp.pi / 3, 0))
    rates = ((1, 1, 0), (0, 1, 1), (1, 2, 3))
    one = dict.fromkeys((*_G, alpha, zeta, u_scalar, v_scalar, N, LOADS[2], v3), sp.Integer(1))
    keys = (*theory.ANGLES, theory.phi_s, theory.theta_s, theory.psi_s)
    return tuple(
        {**one, **dict(zip(keys, map(sp.sympify, (*turn, *rate)), strict=True))}
        for turn in angles
        for rate in rates
    )


# -- states, on an equilibrium ------------------------------------------------------------------


def _route(point: Point, ctx: Any) -> Values:
    """Angles, components and rates read off a true equilibrium."""
    orbit = Orbit({k: x for k, x in point.items() if k in CONSTANTS}, ctx)
    start = [point[a] for a in (*theory.ANGLES, *theory.COUPLE, N)]
    seen = orbit.observe(turned(start[:3], ctx), start[3:6], start[6])
    given = {x: number(ctx, point[x]) for x in (*_G, N)}
    basis = [given[x] for x in _G]
    found: dict[sp.Basic, Any] = {N: given[N]}
    found |= dict(zip((*theory.ANGLES, *theory.COUPLE), seen.unknowns, strict=True))
    found |= dict(zip(theory.RATES.values(), seen.rates, strict=True))
    found |= {Prime(x): r for x, r in zip(theory.RATES, seen.rates, strict=True)}
    found |= dict(zip(LOADS, seen.loads, strict=True))
    found |= dict(zip(STRAINS, seen.strains, strict=True))
    found |= dict(zip(_NK, seen.force_in_frame, strict=True))
    found[u_scalar] = seen.strains[0] / seen.loads[0]
    found[v_scalar] = seen.strains[3] / seen.loads[3]
    for names, vectors in ((_D, seen.directors), (_E, seen.frame)):
        for s, a in zip(names, vectors, strict=True):
            found[s] = ctx.fdot(zip(a, basis, strict=True))
    found[n_vector] = given[N] * basis[2]
    found[Cross(_E[1], _E[2])] = ctx.fdot(zip(seen.first_axis, basis, strict=True))
    found[Dot(_D[2], _G[2])] = seen.directors[2][2]
    found[Prime(Dot(_D[2], _G[2]))] = seen.polar_rate
    found[Dot(m_vector, _G[2])] = seen.couple[2]
    found[Prime(Dot(m_vector, _G[2]))] = seen.couple_rate[2]
    return found


STATES = Meaning(
    name="all states with m' + r' x n = 0, n = N g_3",
    free=(*theory.ANGLES, theory.phi_s, theory.theta_s, theory.psi_s, N, LOADS[2], v3, u_scalar,
          alpha, zeta, *_G),
    sample=_sample,
    simple=_simple,
    components=_state(),
    functions={Prime: _prime, Cross: _cross, Dot: _dot},
    route=_route,
    route_name="an equilibrium moved along its rates as vectors; angles and rates read off",
)  # fmt: skip

# -- states, equilibrium or not ------------------------------------------------------------------

L, B = (sp.IndexedBase(name, real=True) for name in ("L", "B"))
_RESIDUALS = (*sp.symbols("L1:4", real=True), *sp.symbols("B1:4", real=True))
J = sp.Symbol("J", real=True)
q = sp.Symbol("q", positive=True)  # Q*(m, n) in the reduced variables


def _residual_route(point: Point, ctx: Any) -> Values:
    """Kinematics less law, and the balance, from matrices moved with the given rates."""
    return dict(zip(_RESIDUALS, residuals_of(point, ctx), strict=True))


OFF_BALANCE = Meaning(
    name="all angles, couples and rates, in equilibrium or not",
    free=(*theory.RATES, *theory.RATES.values(), N, u_scalar, v_scalar, u3, v3),
    sample=_sample,
    simple=lambda: (_sample(0),),
    components=dict(zip(_RESIDUALS, theory.reduced_system(), strict=True)),
    functions={Prime: _prime},
    route=_residual_route,
    route_name="rotation matrices and vectors moved with the rates, differenced",
)

# -- the closed system ---------------------------------------------------------------------------


def _closure() -> dict[sp.Symbol, sp.Expr]:
    """Q*, u, v, u_3, v_3 by the law in the directors: psi is in the loads, and must drop out."""
    at = theory.reduced_loads()
    strains = [x.xreplace(at) for x in theory.strains_from_loads()]
    form = constitutive.dual_form().xreplace(at)
    factor = (1 + form ** (p / 2)) ** (-1 / p)
    compliance = constitutive.compliance_at_rest()
    return {
        q: form, u_scalar: factor * compliance[0, 0], v_scalar: factor * compliance[3, 3],
        u3: strains[2], v3: strains[5], J: theory.determinant(),
    }  # fmt: skip


def _closure_route(point: Point, ctx: Any) -> Values:
    names = (q, u_scalar, v_scalar, u3, v3)
    return {
        J: determinant_of(point, ctx),
        **dict(zip(names, law_at(point, ctx), strict=True)),
    }


CLOSED = Meaning(
    name="all angles and couples",
    free=(*theory.RATES, N, *UNIT_CONSTANTS),
    sample=_sample,
    simple=lambda: (_sample(0),),
    components=_closure(),
    positive=ON_LOADS.positive,
    route=_closure_route,
    route_name="determinant by differences of moved matrices, the law in the directors",
)

# -- loads with gamma = 1 ------------------------------------------------------------------------


def _unit_loads(seed: int) -> Point:
    return {**sampling.with_loads(seed), gamma: sp.Integer(1)}


def _simple_loads() -> tuple[Point, ...]:
    return tuple({**x, gamma: sp.Integer(1)} for x in sampling.simple_loads())


def _with_scalars(route: Callable[[Point, Any], Values]) -> Callable[[Point, Any], Values]:
    def at(point: Point, ctx: Any) -> Values:
        found = dict(route(point, ctx))
        load = {s: number(ctx, point[s]) for s in LOADS}
        found[u_scalar] = found[STRAINS[0]] / load[LOADS[0]]
        found[v_scalar] = found[STRAINS[3]] / load[LOADS[3]]
        return found

    return at


_GRADIENT = tuple(x.subs(gamma, 1) for x in constitutive.strains())
assert ON_LOADS.route is not None

#: All loads, gamma = 1, with the scalar factors as ratios of components of the gradient of W*.
UNIT_LOADS = replace(
    ON_LOADS,
    name="all loads, gamma = 1",
    free=(*UNIT_CONSTANTS, *LOADS),
    sample=_unit_loads,
    simple=_simple_loads,
    components={
        **dict(zip(STRAINS, (*_GRADIENT[:5], 1 + _GRADIENT[5]), strict=True)),
        u_scalar: _GRADIENT[0] / LOADS[0],
        v_scalar: _GRADIENT[3] / LOADS[3],
    },
    route=_with_scalars(ON_LOADS.route),
)


def _load_prime(expr: Any) -> sp.Expr:
    if not isinstance(expr, sp.Expr):
        raise IllTyped(f"{expr} has no rate")
    return sp.Add(*(sp.diff(expr, x) * rate for x, rate in theory.load_rates().items()))


def _integral_route(point: Point, ctx: Any) -> Values:
    """The slope of W* + n_3 along an equilibrium, the change of W* by quadrature between radii."""
    orbit = Orbit({k: x for k, x in point.items() if k in CONSTANTS}, ctx)
    power = orbit.law.c[p]

    def radius(load: list[Any]) -> Any:
        return ctx.sqrt(orbit.law.dual(load))

    start = [number(orbit.law.ctx, point[s]) for s in LOADS]

    def energy(load: list[Any]) -> Any:
        change = ctx.quad(
            lambda r: r * (1 + r**power) ** (-1 / power), [radius(start), radius(load)]
        )
        return change + load[5]

    slope = orbit.slope_along([point[s] for s in LOADS], energy)
    return {Prime(Wstar(m, n) + LOADS[5]): slope}


#: All loads of an equilibrium without body loads; primes by the balance in the turning frame.
MOVING_LOADS = replace(
    UNIT_LOADS,
    name="all loads of an equilibrium without body loads",
    functions={
        **ON_LOADS.functions,
        Wstar: _of_loads(constitutive.complementary_energy().subs(gamma, 1)),
        Prime: _load_prime,
    },
    route=_integral_route,
    route_name="W* + n_3 by quadrature along an equilibrium moved along its rates, differenced",
)
