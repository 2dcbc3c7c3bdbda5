"""The checks of Sections 2.1 and 2.2 on directors, strains and components.

The domain is all frames: eight free numbers q, q' (kinematics), a free tangent r', and free
vectors n, m with rates. The second route moves a quaternion along the rod, turns the basis with
numerical quaternion products, differentiates numerically, and solves linear systems for u, v.
"""

from __future__ import annotations

import random
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import numbers
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Prime
from rodproof.derivations.proof import curves
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.proof.prover import claims
from rodproof.derivations.proof.rules import Formalised
from rodproof.derivations.proof.vectors import (
    OnlySolution,
    VectorIdentity,
    Vectors,
    symbols_of,
)
from rodproof.derivations.symbols import LOADS, STRAINS, v3
from rodproof.derivations.theory import kinematics

d = sp.IndexedBase("d", real=True)
_D = tuple(sp.Symbol(f"d{i}", real=True) for i in (1, 2, 3))

#: Vectors as such, in the fixed basis: r' is `Prime(r_vector)`.
u_vector, r_vector, n_vector, m_vector = sp.symbols("bold_u bold_r bold_n bold_m", real=True)

_NAMED: dict[sp.Basic, str] = {
    **{director: str(director) for director in _D},
    **{Prime(director): f"{director}_rate" for director in _D},
    u_vector: "u", Prime(r_vector): "r_rate",
    n_vector: "n", m_vector: "m",
}  # fmt: skip
VECTORS = Vectors({vector: symbols_of(name) for vector, name in _NAMED.items()})


def _directors() -> dict[sp.Symbol, sp.Expr]:
    found: dict[sp.Symbol, sp.Expr] = {}
    for i, (director, rate) in enumerate(
        zip(kinematics.directors(), kinematics.director_rates(), strict=True), 1
    ):
        found |= dict(zip(symbols_of(f"d{i}"), director, strict=True))
        found |= dict(zip(symbols_of(f"d{i}_rate"), rate, strict=True))
    found |= dict(zip(symbols_of("u"), kinematics.darboux(), strict=True))
    found |= dict(zip(STRAINS[:3], kinematics.flexure_and_twist(), strict=True))
    return found


def _components_of_vectors() -> dict[sp.Symbol, sp.Expr]:
    """v_k, n_k, m_k from the vectors r', n, m, which are free in the fixed basis."""
    found: dict[sp.Symbol, sp.Expr] = {}
    for name, symbols in (("r_rate", STRAINS[3:]), ("n", LOADS[3:]), ("m", LOADS[:3])):
        found |= dict(zip(symbols, kinematics.in_directors(symbols_of(name)), strict=True))
    return found


_QUATERNIONS = (*kinematics.quaternion, *kinematics.quaternion_rate)
_LOOSE = (*symbols_of("r_rate"), *symbols_of("n"), *symbols_of("m"))


def _sample(seed: int) -> Point:
    rng = random.Random(f"frames {seed}")
    free = (*_QUATERNIONS, *_LOOSE, v3)
    return {s: sp.Rational(rng.choice((-1, 1)) * rng.randint(7, 61), 23) for s in free}


def _simple() -> tuple[Point, ...]:
    """The fixed basis turning about g_1, and a turned frame with everything at work."""
    zero = dict.fromkeys((*_QUATERNIONS, *_LOOSE), sp.Integer(0)) | {v3: sp.Integer(2)}
    plain = {_QUATERNIONS[0]: sp.Integer(1), _QUATERNIONS[5]: sp.Integer(1)}
    tangent = {s: sp.Integer(i) for i, s in enumerate(_LOOSE, 1)}
    turned = {q: sp.Integer(1 + i % 3) for i, q in enumerate(_QUATERNIONS)}
    return ({**zero, **plain, **tangent}, {**zero, **turned, **tangent})


def _route_of_frame(point: Point, ctx: Any) -> Values:
    c = numbers(ctx, point)
    q, w = ([c[s] for s in part] for part in (_QUATERNIONS[:4], _QUATERNIONS[4:]))

    def frame(s: Any) -> curves.Frame:
        return curves.quaternion_frame(curves.plus(q, curves.times(s, w)))

    here = frame(ctx.mpf(0))
    rates = curves.frame_rates(ctx, frame, ctx.mpf(0))
    u = curves.darboux(ctx, here, rates)
    found: dict[sp.Basic, Any] = dict(zip(symbols_of("u"), u, strict=True))
    found |= dict(zip(STRAINS[:3], curves.components(ctx, here, u), strict=True))
    for k in range(3):
        found |= dict(zip(symbols_of(f"d{k + 1}"), here[k], strict=True))
        found |= dict(zip(symbols_of(f"d{k + 1}_rate"), rates[k], strict=True))
    return found


def _route(point: Point, ctx: Any) -> Values:
    """The frame, and the components of the free vectors in it."""
    c, found = numbers(ctx, point), dict(_route_of_frame(point, ctx))
    here = [[found[s] for s in symbols_of(f"d{k}")] for k in (1, 2, 3)]
    for name, symbols in (("r_rate", STRAINS[3:]), ("n", LOADS[3:]), ("m", LOADS[:3])):
        vector = [c[s] for s in symbols_of(name)]
        found |= dict(zip(symbols, curves.components(ctx, here, vector), strict=True))
    return found


FRAMES = Meaning(
    name="all smooth frames, all r', n and m", free=(*_QUATERNIONS, *_LOOSE),
    components={**_directors(), **_components_of_vectors()},
    positive=(kinematics.norm_squared,), sample=_sample, simple=_simple,
    route=_route, route_name="numerical quaternion curve, its derivative, least squares for u",
)  # fmt: skip


def _constrained(v: tuple[sp.Expr, sp.Expr, sp.Expr], name: str) -> VectorIdentity:
    """All frames with prescribed components of r'."""
    tangent = tuple(kinematics.rotation() * sp.Matrix(v))
    along = dict(zip(symbols_of("r_rate"), tangent, strict=True))
    fixed = {s: x for s, x in zip(STRAINS[3:], v, strict=True) if s != x}

    def route(point: Point, ctx: Any) -> Values:
        c, found = numbers(ctx, point), dict(_route_of_frame(point, ctx))
        rows = [[found[s] for s in symbols_of(f"d{k}")] for k in (1, 2, 3)]
        stretch = c[v3] if v[2] == v3 else ctx.mpf(1)
        solved = ctx.lu_solve(ctx.matrix(rows), ctx.matrix([0, 0, stretch]))  # d_k . r' = v_k
        return found | dict(zip(symbols_of("r_rate"), solved, strict=True))

    meaning = Meaning(
        name=name, free=(*_QUATERNIONS, v3), sample=_sample, simple=_simple,
        components={**_directors(), **fixed, **along},
        positive=(kinematics.norm_squared,),
        route=route, route_name="numerical frame, r' solved from its products with the directors",
    )  # fmt: skip
    return VectorIdentity(meaning, VECTORS)


ON_FRAMES = VectorIdentity(FRAMES, VECTORS)
DARBOUX = OnlySolution(ON_FRAMES, u_vector)


@cache
def unshearable() -> VectorIdentity:
    """Frames and center lines with v_1 = v_2 = 0."""
    return _constrained((sp.Integer(0), sp.Integer(0), v3), "no shear")


@cache
def unshearable_inextensible() -> VectorIdentity:
    """Frames and center lines with v_1 = v_2 = 0 and v_3 = 1."""
    return _constrained((sp.Integer(0), sp.Integer(0), sp.Integer(1)), "no shear, no stretch")


# -- definitions that are relations ------------------------------------------------------------

_FREE = tuple(sp.Matrix(symbols_of(f"d{k}")) for k in (1, 2))
_GRAM = tuple((_FREE[i].T * _FREE[j])[0, 0] - int(i == j) for i, j in ((0, 0), (1, 1), (0, 1)))


def _orthonormal(printed: sp.Basic) -> bool:
    """Three equations that hold between two vectors exactly if the vectors are orthonormal."""
    try:
        chains = VECTORS.spread(printed).args
    except IllTyped:
        return False
    if any(chain.relations != ("=",) for chain in chains) or len(chains) != len(_GRAM):
        return False
    left = {sp.expand(chain.sides[0] - chain.sides[1]) for chain in chains}
    wanted = {sp.expand(g) for g in _GRAM}
    return {frozenset((e, sp.expand(-e))) for e in left} == {
        frozenset((e, sp.expand(-e))) for e in wanted
    }


ORTHONORMAL = Formalised(_orthonormal, "the three equations are those of the Gram matrix")


def _orients(printed: sp.Basic) -> bool:
    """A positive multiple of d_3 . r' is positive."""
    if not isinstance(printed, Chain) or printed.relations not in ((">",), ("<",)):
        return False
    (link,) = claims(printed)
    left, relation, right = next(iter(link.links()))
    difference = left - right if relation == ">" else right - left
    d3, tangent = sp.Matrix(kinematics.directors()[2]), sp.Matrix(symbols_of("r_rate"))
    wanted = d3.dot(tangent)
    try:
        ratio = FRAMES.interpret(difference) / wanted
        return Field(FRAMES.positive).sign(ratio) == 1
    except OutOfReach:
        return False


ORIENTED = Formalised(_orients, "v_3 = d_3 . r', by a positive ratio over all frames")
