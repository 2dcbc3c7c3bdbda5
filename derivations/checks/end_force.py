"""The constant force of Section 4 as a domain of its own."""

from __future__ import annotations

from typing import Any

import sympy as sp

from rodproof.derivations.checks.equilibrium import cross, dot
from rodproof.derivations.exact.evaluate import number
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.symbols import LOADS
from rodproof.derivations.theory import euler as theory

#: n(s), a linear form in the fixed basis.
force_at = sp.Symbol("n_s", real=True)
_G = sp.symbols("g1:4", real=True)


_SIZES = (sp.Integer(1), sp.Integer(-2))


def _sample(seed: int) -> Point:
    point = sampling.with_loads(seed)
    basis = {x: sp.Rational(5 * k + seed + 2, 7) for k, x in enumerate(_G)}
    return {theory.N: point[LOADS[3]], **{s: point[s] for s in LOADS}, **basis}


def _route(point: Point, ctx: Any) -> Values:
    """n_k' = -(u x n)_k in directors that turn at a constant rate u, from s = 1 to s = 0.

    Components and directors are turned by matrix exponentials, and put together again.
    """
    rate = [number(ctx, point[s]) for s in LOADS[:3]]
    size = number(ctx, point[theory.N])
    spin = ctx.matrix(3, 3)
    for k in range(3):
        axis = [ctx.mpf(int(i == k)) for i in range(3)]
        for i, x in enumerate(cross(rate, axis)):
            spin[i, k] = x
    components = ctx.expm(spin) * ctx.matrix([0, 0, size])  # back along -s: exp(+u x)
    directors = ctx.expm(-spin)  # the basis at s = 1, turned back to s = 0
    total = [dot([directors[i, k] for k in range(3)], list(components), ctx) for i in range(3)]
    basis = [number(ctx, point[x]) for x in _G]
    return {force_at: dot(total, basis, ctx)}


FORCE = Meaning(
    name="all end forces N g_3, no body force",
    free=(theory.N, *_G),
    sample=_sample,
    simple=lambda: tuple({theory.N: k, **dict.fromkeys(_G, sp.Integer(1))} for k in _SIZES),
    components={
        force_at: sp.Add(*(c * x for c, x in zip(theory.force_along_rod(), _G, strict=True)))
    },
    edges=({theory.N: sp.Integer(0)},),
    route=_route,
    route_name="components of n integrated in turning directors, put together again",
)
