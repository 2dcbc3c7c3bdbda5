"""The domain of Section 3.4, strains with Q < 1 and gamma = 1, and its tangents as numbers.

The second route to a tangent inverts a numerical one: D^2 W* by central
differences of the law at the load that a root search finds for the strain, and its inverse.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import ON_STRAINS, NumericLaw
from rodproof.derivations.exact.evaluate import context, number
from rodproof.derivations.notation import FormQ, HessianForm, Partial, Q, W, u, v
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.proof.prover import ROUTE_POINTS
from rodproof.derivations.symbols import (
    CONSTANTS,
    LOADS,
    STRAINS,
    alpha,
    beta,
    eta,
    gamma,
    iota,
    p,
    zeta,
)
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import monotonicity as theory

a, b = (sp.IndexedBase(name, real=True) for name in "ab")
UNIT_CONSTANTS = tuple(c for c in CONSTANTS if c != gamma)

# -- the domains with gamma = 1 ---------------------------------------------------------------


def _vector(argument: Any) -> tuple[sp.Expr, ...]:
    """Three components; a number where a column belongs is read as its third component."""
    if isinstance(argument, tuple):
        return argument
    if not isinstance(argument, sp.Expr):
        raise IllTyped(f"{argument} is no column")
    return (sp.Integer(0), sp.Integer(0), argument)


def _form_at(expr: sp.Expr, variables: tuple[sp.Symbol, ...]) -> Any:
    def at(*arguments: Any) -> sp.Expr:
        components = [c for argument in arguments for c in _vector(argument)]
        return expr.xreplace(dict(zip(variables, components, strict=True)))

    return at


def _with_unit_force(point: Point) -> Point:
    return {**point, gamma: sp.Integer(1)}


def _sample(seed: int) -> Point:
    """Strains inside the limit, and a direction with mixed signs."""
    direction = {
        d: sp.Rational((13 * k + 7 * seed) % 11 - 5, 3) or sp.Rational(1, 7)
        for k, d in enumerate(theory.DIRECTION)
    }
    return {**_with_unit_force(sampling.with_strains(seed)), **direction}


#: p = 1 and rational radii: Q(u, v) = 49/100, but 1/4, 9/20 or 29/100 if the second argument of
#: Q is taken to be v_3 - 1 in one way or another; and one with p = 4.
_RADII = (
    {alpha: 1, beta: 1, zeta: 1, eta: 1, iota: 0, p: 1},
    {alpha: 1, beta: 1, zeta: 1, eta: 1, iota: 0, p: 4},
    {alpha: 1, beta: 1, zeta: 1, eta: 2, iota: 1, p: 1},
)
_STRAINS = (
    (0, 0, sp.Rational(3, 10), sp.Rational(1, 5), 0, sp.Rational(8, 5)),
    (sp.Rational(3, 10), sp.Rational(2, 5), 0, 0, 0, 1),
    (0, 0, sp.Rational(3, 10), 0, 0, sp.Rational(7, 5)),
)


@cache
def simple_strains() -> tuple[Point, ...]:
    """Small strains inside the limit, with rational radii first."""
    rows = [
        {**constants, **dict(zip(STRAINS, strain, strict=True))}
        for constants in _RADII
        for strain in _STRAINS
    ]
    first = [{c: sp.sympify(x) for c, x in row.items()} for row in rows]
    inside = [x for x in first if 0 < constitutive.quadratic_form().subs(x) < 1]
    return tuple(_with_unit_force(x) for x in (*inside, *sampling.simple_strains()))


@cache
def _simple() -> tuple[Point, ...]:
    """The same with the directions (0, e_3) and (e_1, 0)."""
    zero = (sp.Integer(0),) * 5
    directions = ((*zero, sp.Integer(1)), (sp.Integer(1), *zero))
    return tuple(
        {**x, **dict(zip(theory.DIRECTION, w, strict=True))}
        for x in simple_strains()
        for w in directions
    )


def numerical_tangent(seed: int, ctx: Any) -> Any:
    """D^2 W at the seed's strain as the inverse of D^2 W*, differenced from the forward law."""
    return ctx.matrix([[ctx.convert(e) for e in row] for row in _tangent(seed, ctx.dps)])


@cache
def _tangent(seed: int, digits: int) -> Any:
    ctx = context(digits)
    law = NumericLaw({k: x for k, x in _sample(seed).items() if k in (*CONSTANTS, *STRAINS)}, ctx)
    strain = [law.c[s] for s in STRAINS[:5]] + [law.c[STRAINS[5]] - 1]
    load = law.loads(strain)
    power = law.c[p]

    def forward(sigma: list[Any]) -> Any:
        image = ctx.lu_solve(law.K, ctx.matrix(sigma))
        radius = ctx.sqrt(law._dot(sigma, image))
        return (1 + radius**power) ** (-1 / power) * image

    step = ctx.mpf(10) ** -10
    columns = []
    for j in range(6):
        moved = [(w, k) for k, w in ((1, 45), (2, -9), (3, 1), (-1, -45), (-2, 9), (-3, -1))]
        total = ctx.zeros(6, 1)
        for weight, k in moved:
            total += weight * forward([*load[:j], load[j] + k * step, *load[j + 1 :]])
        columns.append(total / (60 * step))
    compliance = ctx.matrix([[columns[j][i] for j in range(6)] for i in range(6)])
    return ctx.inverse(compliance).tolist()


def _second_derivatives(law: Any, strain: list[Any], ctx: Any) -> Any:
    """D^2 W from W itself: W depends on the radius r alone, W_ij = W'' r_i r_j + W' r_ij."""
    radius = ctx.sqrt(law.form(strain))
    step = radius * ctx.mpf(10) ** -9
    ray = [e / radius for e in strain]
    at = {k: law.stored([(radius + k * step) * e for e in ray]) for k in range(-3, 4)}
    odd, even = {1: 45, 2: -9, 3: 1}, {1: 270, 2: -27, 3: 2}
    first = sum(w * (at[k] - at[-k]) for k, w in odd.items()) / (60 * step)
    second = (sum(w * (at[k] + at[-k]) for k, w in even.items()) - 490 * at[0]) / (180 * step**2)

    def slope(*orders: int) -> Any:
        return ctx.diff(lambda *e: ctx.sqrt(law.form(list(e))), tuple(strain), orders)

    def unit(*indices: int) -> tuple[int, ...]:
        return tuple(indices.count(k) for k in range(6))

    gradient = [slope(*unit(i)) for i in range(6)]
    return [
        [second * gradient[i] * gradient[j] + first * slope(*unit(i, j)) for j in range(6)]
        for i in range(6)
    ]


def _route(point: Point, ctx: Any) -> Values:
    law = NumericLaw({k: x for k, x in point.items() if k in (*CONSTANTS, *STRAINS)}, ctx)
    seed = next(k for k in range(ROUTE_POINTS) if _sample(k) == point)
    tangent = numerical_tangent(seed, ctx)
    strain = [law.c[s] for s in STRAINS[:5]] + [law.c[STRAINS[5]] - 1]
    w = ctx.matrix([number(ctx, point[d]) for d in theory.DIRECTION])
    found: dict[sp.Basic, Any] = {
        Partial(load, s): tangent[i, j]
        for i, load in enumerate(LOADS)
        for j, s in enumerate(STRAINS)
    }
    found[Q(u, v)] = law.form(strain)
    found[FormQ(a, b)] = (w.T * law.K * w)[0]
    found[HessianForm(u, v, a, b)] = (w.T * tangent * w)[0]
    return found


def _route_with_energy(point: Point, ctx: Any) -> Values:
    law = NumericLaw({k: x for k, x in point.items() if k in (*CONSTANTS, *STRAINS)}, ctx)
    strain = [law.c[s] for s in STRAINS[:5]] + [law.c[STRAINS[5]] - 1]
    second = _second_derivatives(law, strain, ctx)
    energy = {
        Partial(Partial(W(u, v), x), y): second[i][j]
        for i, x in enumerate(STRAINS)
        for j, y in enumerate(STRAINS)
    }
    return {**_route(point, ctx), **energy}


#: All strains with Q < 1 except rest, gamma = 1.
UNIT_STRAINS = Meaning(
    name="all strains with Q < 1, gamma = 1",
    free=(*UNIT_CONSTANTS, *STRAINS, *theory.DIRECTION),
    sample=_sample,
    simple=_simple,
    components=dict(zip(LOADS, theory.unit_loads(), strict=True)),
    functions={
        Q: _form_at(constitutive.quadratic_form(), STRAINS),
        FormQ: _form_at(theory.rest_form(), theory.DIRECTION),
        HessianForm: _form_at(theory.form_of(theory.hessian()), (*STRAINS, *theory.DIRECTION)),
        W: _form_at(constitutive.stored_energy().subs(gamma, 1), STRAINS),
    },
    positive=tuple(fact.subs(gamma, 1) for fact in ON_STRAINS.positive),
    route=_route,
    route_name="inverse of D^2 W* differenced from the forward law, at a load found by root search",
)
WITH_ENERGY = replace(
    UNIT_STRAINS,
    route=_route_with_energy,
    route_name="second differences of W (Legendre duality, quadrature), inverse of D^2 W*",
)
