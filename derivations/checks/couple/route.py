"""Configurations of rods under couples: built as functions of s, then measured numerically."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks import equilibrium as route
from rodproof.derivations.exact.evaluate import Evaluator, number
from rodproof.derivations.notation import Prime
from rodproof.derivations.proof.meaning import Point, Values, of_vector
from rodproof.derivations.symbols import STRAINS, gamma
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.couple import s
from rodproof.derivations.theory.euler import M1, M2, M3, phi_s, psi_s, u_scalar
from rodproof.derivations.theory.frames import phi, psi, theta

c, t, omega, stretch = (
    sp.Symbol(name, positive=True) for name in ("|M|", "tan(theta/2)", "|varphi'|", "v_3")
)
curvature, torsion, radius, pitch = sp.symbols("curvature torsion radius pitch", real=True)
length = sp.Symbol("length", real=True)
#: Components in the fixed basis of the directors, of r, of r', and of the couple.
d1, d2, d3, d3_s, r, r_s, m_g = (
    sp.IndexedBase(name, real=True) for name in ("d1_", "d2_", "d3_", "d3_s", "r", "r_s", "m_g")
)


@dataclass(frozen=True, eq=False)
class Configuration:
    """phi(s), theta, psi(s) and r(s) in closed form, in the free symbols of a meaning."""

    angles: tuple[sp.Expr, sp.Expr, sp.Expr]
    line: tuple[sp.Expr, ...]

    def functions(self, point: Point, ctx: Any, changed: Values) -> tuple[Any, Any]:
        """r(s) and the directors as functions; `changed` holds what a statement says instead."""
        names = {phi: 0, theta: 1, psi: 2}
        angles = {x: changed.get(x, self.angles[i]) for x, i in names.items()}
        vectors = [
            [changed.get(name, e.xreplace(angles)) for name, e in of_vector(base, d).items()]
            for base, d in zip((d1, d2, d3), euler.directors(), strict=True)
        ]
        line = [changed.get(x, e) for x, e in zip(of_vector(r, self.line), self.line, strict=True)]
        frame = _function([e for vector in vectors for e in vector], point, ctx)
        return _function(line, point, ctx), lambda x: _rows(frame(x))


def _rows(entries_: list[Any]) -> list[list[Any]]:
    return [entries_[0:3], entries_[3:6], entries_[6:9]]


def _function(expressions: list[sp.Expr], point: Point, ctx: Any) -> Any:
    """Expressions as one function of s: what does not depend on s is evaluated once."""
    values: dict[sp.Symbol, Any] = {}
    folded = [_folded(e, values, point, ctx) for e in expressions]
    code = sp.lambdify([s, *values], folded, modules=[{"sin": ctx.sin, "cos": ctx.cos}], cse=True)
    known: dict[Any, list[Any]] = {}

    def at(x: Any) -> list[Any]:
        key = (x, ctx.prec)  # a frame is asked for thrice, once a director
        if key not in known:
            known[key] = code(x, *values.values())
        return known[key]

    return at


def _folded(expr: sp.Expr, values: dict[sp.Symbol, Any], point: Point, ctx: Any) -> sp.Expr:
    """The expression with all that does not depend on s evaluated once, under new symbols."""
    if expr.is_Integer or expr == s:
        return expr
    if not expr.has(s):
        name = sp.Symbol(f"k{len(values)}")
        with ctx.workdps(ctx.dps + 40):
            values[name] = Evaluator(ctx, point)(expr)
        return name
    return expr.func(*(_folded(a, values, point, ctx) for a in expr.args))


def measured(state: Configuration, point: Point, ctx: Any, changed: Values) -> tuple[Values, float]:
    """What a configuration carries at s, and how far it is from equilibrium without force."""
    line, frame = state.functions(point, ctx, changed)
    at = number(ctx, point[s])
    balance = route.balance_residual(line, frame, {**point, gamma: sp.Integer(1)}, ctx, [at])
    (u, v), m, directors = balance.strains[0], balance.couples[0], frame(at)
    found: dict[sp.Basic, Any] = dict(zip(STRAINS, (*u, *v), strict=True))
    tangent = route.slope(line, at, ctx)
    for base, vector in ((r_s, tangent), (m_g, m), (d1, directors[0]), (d2, directors[1]),
                         (d3, directors[2])):  # fmt: skip
        found |= of_vector(base, vector)
    found |= of_vector(d3_s, route.slope(lambda x: frame(x)[2], at, ctx))
    found[length] = ctx.sqrt(route.dot(tangent, tangent, ctx))
    found[M3] = route.dot(m, directors[2], ctx)
    if state.angles[1] != 0:
        found |= _measured_turning(frame, at, m, u, ctx)
    return found, max(balance.residual, float(route.norm(balance.forces[0], ctx)))


def _measured_turning(frame: Any, at: Any, m: Any, u: Any, ctx: Any) -> Values:
    """The rates of the angles and the couple in the intermediate frame, where sin(theta) != 0."""

    def intermediate(x: Any) -> tuple[Any, Any]:
        axis = frame(x)[2]
        across = [-axis[1], axis[0], ctx.mpf(0)]
        size = route.norm(across, ctx)
        e2 = [a / size for a in across]
        return route.cross(e2, axis), e2

    def angles(x: Any) -> list[Any]:
        (e1, e2), (first, _, axis) = intermediate(x), frame(x)
        return [ctx.atan2(axis[1], axis[0]),
                ctx.atan2(route.dot(first, e2, ctx), route.dot(first, e1, ctx))]  # fmt: skip

    e1, e2 = intermediate(at)
    turn, spin = route.slope(angles, at, ctx)
    across = [route.dot(m, e1, ctx), route.dot(m, e2, ctx)]
    found = {M1: across[0], M2: across[1], phi_s: turn, psi_s: spin,
             Prime(phi): turn, Prime(psi): spin, euler.theta_s: ctx.mpf(0)}  # fmt: skip
    if any(abs(x) > 1e-20 for x in across):
        found[u_scalar] = ctx.hypot(u[0], u[1]) / ctx.hypot(*across)
    return found


def measured_shape(line: Any, at: Any, turn: Any, ctx: Any) -> Values:
    """Curvature and torsion by three derivatives; radius and pitch from points of the curve."""
    derivatives = [line]
    for _ in range(3):
        derivatives.append(lambda x, f=derivatives[-1]: route.slope(f, x, ctx))
    first, second, third = (f(at) for f in derivatives[1:])
    binormal = route.cross(first, second)
    area = route.norm(binormal, ctx)
    period = 2 * ctx.pi / abs(turn)
    near, opposite, far = line(at), line(at + period / 2), line(at + period)
    return {
        curvature: area / route.norm(first, ctx) ** 3,
        torsion: route.dot(binormal, third, ctx) / area**2,
        radius: ctx.hypot(near[0] - opposite[0], near[1] - opposite[1]) / 2,
        pitch: far[2] - near[2],
        omega: abs(turn),
    }
