"""What a change of directors, of direction along the rod and of space does to the strains.

Problem: a rod with center line r(s) and directors d_k(s) is described anew by

    r~(s) = S r(e s),    d~_k(s) = T_kj S d_j(e s),    e = +1 or -1,

S an orthogonal map of space, T an orthogonal matrix acting on the directors, e = -1 where the arc
is run through backwards. The new directors must be right-handed (det S det T = 1). Find the new
strains as linear maps of the old ones. A rod has the symmetry if its stored energy agrees.

rotation    T = turn by psi about d_3, S = 1, e = +1        transverse hemitropy
flip        T = half-turn about d_2,   S = 1, e = -1        reversal of the arc; d_3 follows it
reflection  T = diag(1, -1, 1),  S = any reflection, e = +1 mirror images are equivalent

By objectivity the directors may be taken as the fixed basis at the s in question, so d_k = g_k,
d_k' = u x g_k and r' = v with six free numbers u_k, v_k.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import STRAINS
from rodproof.derivations.theory.constitutive import quadratic_form
from rodproof.derivations.theory.frames import psi

#: The normal of the mirror, any nonzero vector.
mirror: tuple[sp.Symbol, ...] = sp.symbols("h1:4", real=True)


@dataclass(frozen=True)
class Operation:
    """A change of description: matrix on the directors, map of space, sense of the arc."""

    name: str
    directors: sp.ImmutableMatrix
    space: sp.ImmutableMatrix
    sense: int


def _rotation() -> Operation:
    c, s = sp.cos(psi), sp.sin(psi)
    turned = sp.ImmutableMatrix([[c, s, 0], [-s, c, 0], [0, 0, 1]])  # d~_1 = c d_1 + s d_2
    return Operation("rotation", turned, sp.ImmutableMatrix(sp.eye(3)), 1)


def _flip() -> Operation:
    half_turn = sp.ImmutableMatrix(sp.diag(-1, 1, -1))
    return Operation("flip", half_turn, sp.ImmutableMatrix(sp.eye(3)), -1)


def _reflection() -> Operation:
    normal = sp.Matrix(mirror)
    householder = sp.eye(3) - 2 * normal * normal.T / normal.dot(normal)
    swapped = sp.ImmutableMatrix(sp.diag(1, -1, 1))
    return Operation("reflection", swapped, sp.ImmutableMatrix(householder), 1)


ROTATION, FLIP, REFLECTION = _rotation(), _flip(), _reflection()


@dataclass(frozen=True)
class Action:
    """u~ = `on_u` u and v~ = `on_v` v."""

    on_u: sp.ImmutableMatrix
    on_v: sp.ImmutableMatrix


@cache
def action(operation: Operation) -> Action:
    """The maps of the strains, from the new frame, its derivative and the new tangent."""
    u, v = sp.Matrix(STRAINS[:3]), sp.Matrix(STRAINS[3:])
    basis = [sp.eye(3)[:, j] for j in range(3)]
    S, T, sense = operation.space, operation.directors, operation.sense

    def described(vectors: list[sp.Matrix]) -> list[sp.Matrix]:
        return [sum((T[k, j] * S * vectors[j] for j in range(3)), sp.zeros(3, 1)) for k in range(3)]

    directors = described(basis)
    rates = [sense * rate for rate in described([u.cross(d) for d in basis])]
    tangent = sense * S * v
    darboux = (
        sum((d.cross(rate) for d, rate in zip(directors, rates, strict=True)), sp.zeros(3, 1)) / 2
    )
    return Action(_linear(directors, darboux, u), _linear(directors, tangent, v))


def _linear(directors: list[sp.Matrix], vector: sp.Matrix, old: sp.Matrix) -> sp.ImmutableMatrix:
    new = sp.Matrix([(d.T * vector)[0, 0] for d in directors])
    return sp.ImmutableMatrix(new.jacobian(old).applyfunc(_simplest))


def _simplest(entry: sp.Expr) -> sp.Expr:
    """Free of the mirror: the value at one mirror, proved to be the value at all."""
    if not entry.has(*mirror):
        return sp.trigsimp(sp.expand(entry))
    value = entry.subs(dict(zip(mirror, (1, 2, 3), strict=True)))
    if not Field().equal(entry, value):
        raise ArithmeticError("the action of a reflection depends on the mirror")
    return value


def form_after(on_u: sp.Matrix, on_v: sp.Matrix) -> sp.Expr:
    """Q(A u, B v)."""
    new = (*(on_u * sp.Matrix(STRAINS[:3])), *(on_v * sp.Matrix(STRAINS[3:])))
    return quadratic_form().xreplace(dict(zip(STRAINS, new, strict=True)))
