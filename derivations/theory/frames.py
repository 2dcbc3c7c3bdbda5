"""Frames: the directors from three Euler angles, as rotation matrices."""

from __future__ import annotations

import sympy as sp

phi, theta, psi = sp.symbols("varphi theta psi", real=True)


def rotation_about(axis: int, angle: sp.Expr) -> sp.Matrix:
    """The rotation by `angle` about the fixed basis vector `axis` (1, 2 or 3)."""
    c, s = sp.cos(angle), sp.sin(angle)
    plane = {1: (1, 2), 2: (2, 0), 3: (0, 1)}[axis]
    matrix = sp.eye(3)
    i, j = plane
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


def euler_frame(
    first: sp.Expr = phi, second: sp.Expr = theta, third: sp.Expr = psi
) -> tuple[sp.Matrix, sp.Matrix, sp.Matrix]:
    """(d_1, d_2, d_3) as columns in the fixed basis: turn by phi about g_3, theta about the new
    second axis, psi about the new third."""
    R = rotation_about(3, first) * rotation_about(2, second) * rotation_about(3, third)
    return R[:, 0], R[:, 1], R[:, 2]


def dot(a: sp.Matrix, b: sp.Matrix) -> sp.Expr:
    """The inner product of two columns."""
    return (a.T * b)[0, 0]
