"""Numerical rods: curves of frames built, differentiated and measured at 50 digits.

The second route to kinematic claims. Nothing here uses a derived formula: quaternions are
multiplied, a rod with constant strains comes from the exponential of its 4x4 generator,
derivatives are numerical and Darboux vectors solve the nine equations by least squares.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

Vector = list[Any]
Frame = list[Vector]  # the three directors, each in the fixed basis


def cross(a: Vector, b: Vector) -> Vector:
    """The vector product."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plus(*vectors: Vector) -> Vector:
    """The sum."""
    return [sum(entries) for entries in zip(*vectors, strict=True)]


def times(factor: Any, vector: Vector) -> Vector:
    """A multiple."""
    return [factor * entry for entry in vector]


def minus(a: Vector, b: Vector) -> Vector:
    """The difference."""
    return [x - y for x, y in zip(a, b, strict=True)]


def rate(ctx: Any, curve: Callable[[Any], Vector], at: Any) -> Vector:
    """The numerical derivative of a curve."""
    return [ctx.diff(lambda s, i=i: curve(s)[i], at) for i in range(len(curve(at)))]


def quaternion_frame(q: Vector) -> Frame:
    """The basis turned by a quaternion, q g_k q^{-1}, by Hamilton's product."""
    size = sum(x * x for x in q)
    conjugate = [q[0], -q[1], -q[2], -q[3]]
    basis = [[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    return [times(1 / size, _hamilton(_hamilton(q, e), conjugate)[1:]) for e in basis]


def _hamilton(a: Vector, b: Vector) -> Vector:
    scalar = a[0] * b[0] - sum(x * y for x, y in zip(a[1:], b[1:], strict=True))
    return [scalar, *plus(times(a[0], b[1:]), times(b[0], a[1:]), cross(a[1:], b[1:]))]


def uniform_rod(ctx: Any, u: Vector, v: Vector) -> Callable[[Any], tuple[Vector, Frame]]:
    """r(s) and the directors of the rod with constant strain components u and v."""
    generator = ctx.matrix(
        [[0, -u[2], u[1], v[0]], [u[2], 0, -u[0], v[1]], [-u[1], u[0], 0, v[2]], [0, 0, 0, 0]]
    )

    @cache
    def at(s: Any) -> tuple[Vector, Frame]:
        moved = ctx.expm(generator * s, method="taylor")
        frame = [[moved[i, j] for i in range(3)] for j in range(3)]
        return [moved[i, 3] for i in range(3)], frame

    return at


def darboux(ctx: Any, frame: Frame, rates: Frame) -> Vector:
    """u from the nine equations d_k' = u x d_k, by least squares."""
    rows, right = [], []
    for d, slope in zip(frame, rates, strict=True):
        rows += [[0, d[2], -d[1]], [-d[2], 0, d[0]], [d[1], -d[0], 0]]
        right += slope
    return list(ctx.lu_solve(ctx.matrix(rows), ctx.matrix(right)))


def components(ctx: Any, frame: Frame, vector: Vector) -> Vector:
    """The components in the directors, by solving for them."""
    columns = ctx.matrix([[frame[j][i] for j in range(3)] for i in range(3)])
    return list(ctx.lu_solve(columns, ctx.matrix(vector)))


def frame_rates(ctx: Any, curve: Callable[[Any], Frame], at: Any) -> Frame:
    """The numerical derivatives of the three directors."""

    def director(k: int) -> Callable[[Any], Vector]:
        return lambda s: curve(s)[k]

    return [rate(ctx, director(k), at) for k in range(3)]


def strains(
    ctx: Any, curve: Callable[[Any], tuple[Vector, Frame]], at: Any
) -> tuple[Vector, Vector]:
    """(u, v) of a rod given by r and its directors, by numerical derivatives."""
    frame = curve(at)[1]
    rates = frame_rates(ctx, lambda s: curve(s)[1], at)
    tangent = rate(ctx, lambda s: curve(s)[0], at)
    u = components(ctx, frame, darboux(ctx, frame, rates))
    return u, components(ctx, frame, tangent)
