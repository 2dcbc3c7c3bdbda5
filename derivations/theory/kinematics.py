"""Kinematics of directors: every smooth right-handed orthonormal frame, and its Darboux vector.

Problem: let d_1(s), d_2(s), d_3(s) be a differentiable right-handed orthonormal frame. Find all
vectors u with d_k' = u x d_k for k = 1, 2, 3, and the components of u and of r' in the frame.

A smooth frame is a smooth curve of rotation matrices R(s), its columns the directors, and every
such curve is the image R(q(s)) of a smooth curve of nonzero quaternions. So at one s the numbers
q and q' are eight free reals, and everything below is a rational function of them: what is
proved for them is proved for all frames at once, with no chart and no singular angle.

Since R R^T = 1, the matrix R' R^T is skew, and a skew matrix is the cross product by one vector.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

#: The quaternion of the frame at s, not zero, and its derivative.
quaternion: tuple[sp.Symbol, ...] = sp.symbols("q0:4", real=True)
quaternion_rate: tuple[sp.Symbol, ...] = sp.symbols("w0:4", real=True)
norm_squared: sp.Expr = sp.Add(*(q**2 for q in quaternion))

#: The tangent r' of the center line in the fixed basis, three free numbers.
tangent: tuple[sp.Symbol, ...] = sp.symbols("t1:4", real=True)

Triple = tuple[sp.Expr, sp.Expr, sp.Expr]


def left_product(q: tuple[sp.Expr, ...]) -> sp.Matrix:
    """The matrix of x -> q x in the algebra of quaternions."""
    a, b, c, d = q
    return sp.Matrix([[a, -b, -c, -d], [b, a, -d, c], [c, d, a, -b], [d, -c, b, a]])


def right_product(q: tuple[sp.Expr, ...]) -> sp.Matrix:
    """The matrix of x -> x q."""
    a, b, c, d = q
    return sp.Matrix([[a, -b, -c, -d], [b, a, d, -c], [c, -d, a, b], [d, c, -b, a]])


@cache
def rotation() -> sp.ImmutableMatrix:
    """R(q): x -> q x q^{-1} on vectors; the directors are its columns."""
    a, b, c, d = quaternion
    sandwich = left_product(quaternion) * right_product((a, -b, -c, -d)) / norm_squared
    return sp.ImmutableMatrix(sandwich[1:, 1:].applyfunc(sp.cancel))


@cache
def rotation_rate() -> sp.ImmutableMatrix:
    """R' by the chain rule."""
    R = rotation()
    terms = (R.diff(q) * w for q, w in zip(quaternion, quaternion_rate, strict=True))
    return sp.ImmutableMatrix(sum(terms, sp.zeros(3, 3)))


def directors() -> tuple[Triple, ...]:
    """d_1, d_2, d_3 in the fixed basis."""
    return _columns(rotation())


def director_rates() -> tuple[Triple, ...]:
    """d_1', d_2', d_3' in the fixed basis."""
    return _columns(rotation_rate())


def axial(matrix: sp.Matrix) -> Triple:
    """The vector whose cross product is the skew matrix."""
    return matrix[2, 1], matrix[0, 2], matrix[1, 0]


@cache
def darboux() -> Triple:
    """u in the fixed basis: the axial vector of R' R^T."""
    return axial((rotation_rate() * rotation().T).applyfunc(sp.cancel))


@cache
def flexure_and_twist() -> Triple:
    """(u_1, u_2, u_3): the axial vector of R^T R', which is u seen from the frame."""
    return axial((rotation().T * rotation_rate()).applyfunc(sp.cancel))


def in_directors(vector: tuple[sp.Expr, ...]) -> Triple:
    """The components of a vector in the directors, R^T vector."""
    a, b, c = rotation().T * sp.Matrix(vector)
    return a, b, c


def _columns(matrix: sp.Matrix) -> tuple[Triple, ...]:
    return tuple((matrix[0, j], matrix[1, j], matrix[2, j]) for j in range(3))
