"""The second route for equilibria: differentiate a configuration, apply the law, weigh the balance.

A state of equilibrium is stated as a center line r(s) and directors d_1, d_2, d_3(s). From these
functions alone, and numerically,

    u = (d_1 x d_1' + d_2 x d_2' + d_3 x d_3')/2,   u_k = u . d_k,   v_k = r' . d_k,

(m, n) follow from the law by a root search, and n' and m' + r' x n must vanish. None of the
derived formulas for equilibria is used, so that a wrong sign anywhere in a stated one shows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.exact.evaluate import Evaluator
from rodproof.derivations.proof.meaning import Point

Vector = list[Any]  # three numbers of the context, components in the fixed basis
Curve = Callable[[Any], Sequence[Any]]
Frame = Callable[[Any], Sequence[Sequence[Any]]]


@dataclass(frozen=True)
class Balance:
    """What a stated configuration is found to carry, at each of the points s asked for.

    force_slope: the largest |n'|. couple_slope: the largest |m' + r' x n|. forces, couples: the
    vectors n(s) and m(s) in the fixed basis. strains: (u, v) in the directors.
    """

    force_slope: Any
    couple_slope: Any
    forces: tuple[Vector, ...]
    couples: tuple[Vector, ...]
    strains: tuple[tuple[Vector, Vector], ...]

    @property
    def residual(self) -> float:
        """The larger of the two residuals."""
        return float(max(self.force_slope, self.couple_slope))


def strains_of(r: Curve, directors: Frame, s: Any, ctx: Any) -> tuple[Vector, Vector]:
    """The strains (u, v) in the directors, by numerical differentiation of r and the directors."""
    frame = [list(d) for d in directors(s)]
    tangent = slope(r, s, ctx)
    rates = slope(lambda x: [c for d in directors(x) for c in d], s, ctx)
    darboux = [ctx.mpf(0)] * 3
    for k, director in enumerate(frame):
        turned = cross(director, rates[3 * k : 3 * k + 3])
        darboux = [a + b / 2 for a, b in zip(darboux, turned, strict=True)]
    return [dot(darboux, d, ctx) for d in frame], [dot(tangent, d, ctx) for d in frame]


def loads_of(u: Vector, v: Vector, constants: Point, ctx: Any) -> tuple[Vector, Vector]:
    """The loads (m, n) in the directors that belong to strains, by solving the law for them.

    Raises ValueError for strains that no load has (Q >= 1).
    """
    strain = [*u, v[0], v[1], v[2] - 1]
    if not any(strain):
        return [ctx.mpf(0)] * 3, [ctx.mpf(0)] * 3
    law = NumericLaw(constants, ctx)
    if law.form(strain) >= 1:
        raise ValueError("strains at or past the strain limit")
    load = law.loads(strain)
    return load[:3], load[3:]


def contact(
    r: Curve, directors: Frame, constants: Point, s: Any, ctx: Any
) -> tuple[Vector, Vector]:
    """The vectors m(s) and n(s) in the fixed basis."""
    frame = directors(s)
    loads = loads_of(*strains_of(r, directors, s, ctx), constants, ctx)
    couple, force = (
        [ctx.fdot(zip(load, axis, strict=True)) for axis in zip(*frame, strict=True)]
        for load in loads
    )
    return couple, force


def balance_residual(
    r: Curve, directors: Frame, constants: Point, ctx: Any, s_values: Iterable[Any]
) -> Balance:
    """How far a configuration is from equilibrium without body loads, and what it carries."""
    worst = [ctx.mpf(0), ctx.mpf(0)]
    forces, couples, strains = [], [], []
    for s in (ctx.convert(x) for x in s_values):
        couple, force = contact(r, directors, constants, s, ctx)
        slopes = slope(lambda x: [*(c for part in contact(r, directors, constants, x, ctx)
                                    for c in part)], s, ctx)  # fmt: skip
        turning = cross(slope(r, s, ctx), force)
        unbalanced = [a + b for a, b in zip(slopes[:3], turning, strict=True)]
        worst = [max(worst[0], norm(slopes[3:], ctx)), max(worst[1], norm(unbalanced, ctx))]
        forces.append(force)
        couples.append(couple)
        strains.append(strains_of(r, directors, s, ctx))
    return Balance(worst[0], worst[1], tuple(forces), tuple(couples), tuple(strains))


def curve(
    expressions: Iterable[sp.Expr], parameter: sp.Symbol, values: Mapping[sp.Symbol, Any], ctx: Any
) -> Curve:
    """Expressions in `parameter` as a function of it, the other symbols held at `values`."""
    constants: dict[sp.Symbol, Any] = {}
    evaluate = Evaluator(ctx, values)

    def fold(expr: sp.Expr) -> sp.Expr:
        """What does not depend on the parameter is evaluated once."""
        if expr == parameter or expr.is_Rational:
            return expr
        if expr.has(parameter):
            return expr.func(*map(fold, expr.args))
        known = sp.Dummy()
        constants[known] = evaluate(expr)
        return known

    todo = tuple(fold(sp.sympify(e)) for e in expressions)

    def at(s: Any) -> Vector:
        here = Evaluator(ctx, {**constants, parameter: s})
        return [here(e) for e in todo]

    return at


def frame(
    vectors: Iterable[Iterable[sp.Expr]], parameter: sp.Symbol,
    values: Mapping[sp.Symbol, Any], ctx: Any,
) -> Frame:  # fmt: skip
    """Three vectors of expressions as one function of `parameter`."""
    curves = [curve(vector, parameter, values, ctx) for vector in vectors]
    return lambda s: [c(s) for c in curves]


def slope(function: Curve, s: Any, ctx: Any) -> Vector:
    """The derivative of a vector by a central difference of order six, 51 digits and more.

    Steps of 10^-12 lose twelve digits of the working precision to rounding, and the remainder is
    of relative order 10^-72; the precision is raised for the while by what is lost.
    """
    with ctx.workdps(ctx.dps + 15):
        step = ctx.mpf(10) ** -12
        weights = ((1, 45), (2, -9), (3, 1))
        pairs = [(w, function(s + k * step), function(s - k * step)) for k, w in weights]
        return [
            ctx.fsum(w * (ahead[i] - behind[i]) for w, ahead, behind in pairs) / (60 * step)
            for i in range(len(pairs[0][1]))
        ]


def cross(a: Sequence[Any], b: Sequence[Any]) -> Vector:
    """The vector product."""
    return [a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))]


def dot(a: Sequence[Any], b: Sequence[Any], ctx: Any) -> Any:
    """The inner product."""
    return ctx.fdot(zip(a, b, strict=True))


def norm(a: Sequence[Any], ctx: Any) -> Any:
    """The length of a vector."""
    return ctx.sqrt(dot(a, a, ctx))
