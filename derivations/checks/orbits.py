"""Numbers for Section 4.1 without its formulas: an equilibrium moved along its rates, as vectors.

The directors and the couple are vectors in the fixed basis; the law is applied forwards,
(u, v - d_3) = (1 + y^p)^{-1/p} K^{-1} (m, n); d_k' = u x d_k, m' = -r' x n, n constant. What is
observed at tiny moves is differenced; steps of 10^-11 leave errors of relative order 10^-60.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.equilibrium import cross, dot, norm
from rodproof.derivations.exact.evaluate import number, numbers
from rodproof.derivations.proof.meaning import Point
from rodproof.derivations.symbols import CONSTANTS, STRAINS, gamma, p, v3
from rodproof.derivations.theory import euler as theory

Vector = list[Any]
_STEP = -11  # the power of ten of a step
_WEIGHTS = ((1, 45), (2, -9), (3, 1))
_EXTRA = 25  # digits that differences with such steps lose


@dataclass(frozen=True)
class Seen:
    """What is read off an equilibrium at one point, in the fixed basis and in both frames."""

    unknowns: Vector  # phi, theta, psi, M_1, M_2, M_3
    rates: Vector
    loads: Vector
    strains: Vector
    directors: list[Vector]
    frame: list[Vector]
    first_axis: Vector  # e_2 x e_3
    force_in_frame: Vector
    couple: Vector
    couple_rate: Vector
    polar_rate: Any  # (d_3 . g_3)'


def turned(quaternion: Sequence[sp.Rational], ctx: Any) -> list[Vector]:
    """Three directors from a quaternion (1, a, b, c), normalised: no Euler angle in it."""
    a = [ctx.mpf(1), *(number(ctx, x) for x in quaternion)]
    size = ctx.sqrt(ctx.fsum(x * x for x in a))
    w, x, y, z = (c / size for c in a)
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
        [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
        [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)],
    ]


class Orbit:
    """Equilibria of one rod (gamma = 1) by their vectors."""

    def __init__(self, constants: Point, ctx: Any) -> None:
        self.ctx = ctx
        with ctx.workdps(ctx.dps + _EXTRA):
            self.law = NumericLaw({**constants, gamma: sp.Integer(1)}, ctx)

    def strains(self, load: Vector) -> Vector:
        """(u, v) of a load in the directors; v_3 not shifted."""
        ctx, power = self.ctx, self.law.c[p]
        image = ctx.lu_solve(self.law.K, ctx.matrix(load))
        radius = ctx.sqrt(dot(load, list(image), ctx))
        found = [(1 + radius**power) ** (-1 / power) * x for x in image]
        found[5] += 1
        return found

    def _change(self, state: list[Vector], force: Vector) -> list[Vector]:
        """d_1', d_2', d_3', m'."""
        ctx = self.ctx
        *directors, couple = state
        load = [dot(x, d, ctx) for x in (couple, force) for d in directors]
        strain = self.strains(load)
        u, v = (
            [ctx.fdot(zip(part, axis, strict=True)) for axis in zip(*directors, strict=True)]
            for part in (strain[:3], strain[3:])
        )
        return [*(cross(u, d) for d in directors), [-x for x in cross(v, force)]]

    def _moved(self, state: list[Vector], force: Vector, h: Any) -> list[Vector]:
        """The state moved by h along its rates; at h = 0 its slope is that of the orbit."""
        return [
            [x + h * y for x, y in zip(a, b, strict=True)]
            for a, b in zip(state, self._change(state, force), strict=True)
        ]

    def _slope(
        self, state: list[Vector], force: Vector, observe: Callable[[list[Vector]], Vector]
    ) -> Vector:
        """d/ds of what is observed, by a central difference of order six along the orbit."""
        step = self.ctx.mpf(10) ** _STEP
        at = {k: observe(self._moved(state, force, k * step)) for k in (-3, -2, -1, 1, 2, 3)}
        pairs = [(w, at[k], at[-k]) for k, w in _WEIGHTS]
        return [
            self.ctx.fsum(w * (ahead[i] - behind[i]) for w, ahead, behind in pairs) / (60 * step)
            for i in range(len(pairs[0][1]))
        ]

    def observe(
        self, directors: list[Vector], couple: Sequence[sp.Rational], force: sp.Rational
    ) -> Seen:
        """Everything about the equilibrium with these directors, M_k and N at one point."""
        ctx = self.ctx
        with ctx.workdps(ctx.dps + _EXTRA):
            tension = number(ctx, force)
            n = [ctx.mpf(0), ctx.mpf(0), tension]
            frame = _intermediate(directors, ctx)
            parts = [number(ctx, x) for x in couple]
            m = [ctx.fdot(zip(parts, axis, strict=True)) for axis in zip(*frame, strict=True)]
            state = [*directors, m]
            load = [dot(x, d, ctx) for x in (m, n) for d in directors]
            rates = self._slope(state, n, lambda x: _unknowns(x, ctx))
            return Seen(
                unknowns=_unknowns(state, ctx), rates=rates, loads=load,
                strains=self.strains(load), directors=directors, frame=frame,
                first_axis=cross(frame[1], frame[2]),
                force_in_frame=[dot(n, e, ctx) for e in frame], couple=m,
                couple_rate=self._slope(state, n, lambda x: x[3]),
                polar_rate=self._slope(state, n, lambda x: [x[2][2]])[0],
            )  # fmt: skip

    def slope_along(self, load: Sequence[sp.Rational], observe: Callable[[Vector], Any]) -> Any:
        """d/ds of a function of the six components, for any force; directors start as the basis."""
        ctx = self.ctx
        with ctx.workdps(ctx.dps + _EXTRA):
            given = [number(ctx, x) for x in load]
            basis = [[ctx.mpf(int(i == k)) for i in range(3)] for k in range(3)]
            force = given[3:]

            def seen(state: list[Vector]) -> Vector:
                *directors, couple = state
                return [observe([dot(x, d, ctx) for x in (couple, force) for d in directors])]

            return self._slope([*basis, given[:3]], force, seen)[0]


def _intermediate(directors: list[Vector], ctx: Any) -> list[Vector]:
    """e_3 = d_3, e_2 level and across d_3, e_1 = e_2 x e_3."""
    e3 = directors[2]
    level = cross([ctx.mpf(0), ctx.mpf(0), ctx.mpf(1)], e3)
    size = norm(level, ctx)
    e2 = [x / size for x in level]
    return [cross(e2, e3), e2, e3]


def _unknowns(state: list[Vector], ctx: Any) -> Vector:
    """phi, theta, psi by geometry (0 < theta < pi), and m . e_k."""
    d1, d2, d3, couple = state
    angles = [ctx.atan2(d3[1], d3[0]), ctx.acos(d3[2]), ctx.atan2(d2[2], -d1[2])]
    return [*angles, *(dot(couple, e, ctx) for e in _intermediate([d1, d2, d3], ctx))]


# -- frames moved with given rates ---------------------------------------------------------------


def _matrix(angles: Sequence[Any], ctx: Any) -> tuple[Any, Any]:
    """R_3(phi) R_2(theta) and R_3(phi) R_2(theta) R_3(psi) as numbers."""
    phi, theta, psi = angles

    def about3(x: Any) -> Any:
        return ctx.matrix([[ctx.cos(x), -ctx.sin(x), 0], [ctx.sin(x), ctx.cos(x), 0], [0, 0, 1]])

    tilt = ctx.matrix(
        [[ctx.cos(theta), 0, ctx.sin(theta)], [0, 1, 0], [-ctx.sin(theta), 0, ctx.cos(theta)]]
    )
    frame = about3(phi) * tilt
    return frame, frame * about3(psi)


def _columns(matrix: Any) -> list[Vector]:
    return [[matrix[i, k] for i in range(3)] for k in range(3)]


def residuals_of(point: Point, ctx: Any) -> Vector:
    """Kinematics less law and the balance, projected on e_k, at given unknowns and rates."""
    c = numbers(ctx, point)
    return _residuals(c, [c[r] for r in theory.RATES.values()], ctx)


def _residuals(c: Mapping[sp.Symbol, Any], rates: Vector, ctx: Any) -> Vector:
    with ctx.workdps(ctx.dps + _EXTRA):
        start = [c[x] for x in theory.RATES]

        def at(h: Any) -> Vector:
            moved = [x + h * r for x, r in zip(start, rates, strict=True)]
            frame, directors = _matrix(moved[:3], ctx)
            couple = frame * ctx.matrix(moved[3:])
            return [x for d in _columns(directors) for x in d] + list(couple)

        step = ctx.mpf(10) ** _STEP
        slope = [
            ctx.fsum(w * (at(k * step)[i] - at(-k * step)[i]) for k, w in _WEIGHTS) / (60 * step)
            for i in range(12)
        ]
        frame, directors = (_columns(x) for x in _matrix(start[:3], ctx))
        darboux = [ctx.mpf(0)] * 3
        for k, d in enumerate(directors):
            turning = cross(d, slope[3 * k : 3 * k + 3])
            darboux = [a + b / 2 for a, b in zip(darboux, turning, strict=True)]
        n = [ctx.mpf(0), ctx.mpf(0), c[theory.N]]
        scalars = (c[theory.v_scalar], c[theory.v_scalar])
        v = [s * dot(n, d, ctx) for s, d in zip(scalars, directors[:2], strict=True)]
        v.append(c[v3])
        tangent = [ctx.fdot(zip(v, axis, strict=True)) for axis in zip(*directors, strict=True)]
        balance = [a + b for a, b in zip(slope[9:], cross(tangent, n), strict=True)]
        law = [c[theory.u_scalar] * c[x] for x in theory.COUPLE[:2]] + [c[STRAINS[2]]]
        return [
            *(dot(darboux, e, ctx) - x for e, x in zip(frame, law, strict=True)),
            *(dot(balance, e, ctx) for e in frame),
        ]


def determinant_of(point: Point, ctx: Any) -> Any:
    """The determinant of the six equations by the six rates, the first with its sign turned."""
    c = numbers(ctx, point)
    still = _residuals(c, [ctx.mpf(0)] * 6, ctx)
    columns = []
    for k in range(6):
        moved = _residuals(c, [ctx.mpf(int(i == k)) for i in range(6)], ctx)
        columns.append([a - b for a, b in zip(moved, still, strict=True)])
    return -ctx.det(ctx.matrix(columns))


def law_at(point: Point, ctx: Any) -> Vector:
    """(Q*, u, v, u_3, v_3) at given angles, M_k and N, by the law in the directors."""
    c = numbers(ctx, point)
    orbit = Orbit({k: x for k, x in point.items() if k in CONSTANTS}, ctx)
    frame, directors = _matrix([c[x] for x in theory.ANGLES], ctx)
    couple = list(frame * ctx.matrix([c[x] for x in theory.COUPLE]))
    force = [ctx.mpf(0), ctx.mpf(0), c[theory.N]]
    load = [dot(x, d, ctx) for x in (couple, force) for d in _columns(directors)]
    strain = orbit.strains(load)
    return [orbit.law.dual(load), strain[0] / load[0], strain[3] / load[3], strain[2], strain[5]]
