"""Second routes as values: what the symbols of a domain are as numbers, by another way."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import NumericLaw
from rodproof.derivations.checks.routes import law
from rodproof.derivations.checks.thrust.numeric import turned
from rodproof.derivations.exact.evaluate import context, numbers
from rodproof.derivations.notation import LimitOf, Partial
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Point, Values, of_matrix
from rodproof.derivations.symbols import LOADS, STRAINS, alpha, gamma, p, zeta
from rodproof.derivations.theory.constitutive import y
from rodproof.derivations.theory.dissipation import a as time_u
from rodproof.derivations.theory.dissipation import b as time_v
from rodproof.derivations.theory.frames import phi, psi, theta

# -- vectors and tensors -------------------------------------------------------------------------


def columns(point: Point, ctx: Any) -> Values:
    """Components by solving for them, of vectors built in a frame that is turned numerically."""
    values = numbers(ctx, point)
    frame = turned(ctx, *(values[x] for x in (phi, theta, psi)))
    found: dict[sp.Basic, Any] = {}
    parts = (STRAINS[:3], STRAINS[3:], LOADS[:3], LOADS[3:])
    for name, symbols in zip("uvmn", parts, strict=True):
        vector = [ctx.fsum(values[x] * d[i] for x, d in zip(symbols, frame, strict=True))
                  for i in range(3)]  # fmt: skip
        solved = ctx.lu_solve(ctx.matrix(frame).T, ctx.matrix(vector))
        names = (sp.Symbol(f"column_{name}{k}", real=True) for k in (1, 2, 3))
        found |= dict(zip(names, solved, strict=True))
    return found


def _tensor(name: str, values: Mapping[sp.Symbol, Any], ctx: Any, symmetric: bool) -> Any:
    def entry(i: int, j: int) -> Any:
        first, second = sorted((i, j)) if symmetric else (i, j)
        return values[sp.Symbol(f"{name}{first + 1}{second + 1}", real=True)]

    return ctx.matrix([[entry(i, j) for j in range(3)] for i in range(3)])


def stress(point: Point, ctx: Any) -> Values:
    """|T| from its eigenvalues; e with the strain radius from integrating its slope in b|T|."""
    values = numbers(ctx, point)
    a, b, power = (values[sp.Symbol(name, positive=True)] for name in ("a", "b", "p"))
    T = _tensor("T", values, ctx, symmetric=True)
    norm = ctx.sqrt(ctx.fsum(x**2 for x in ctx.eigsy(T, eigvals_only=True)))
    G = a**-power
    reached = ctx.quad(
        lambda r: G * (G + r**power) ** (-1 / power - 1), [0, b * norm / 4, b * norm]
    )
    lower = {x: e for x, e in of_matrix("T", T).items() if x not in values}
    return {sp.Symbol("norm_T", positive=True): norm, **lower,
            **of_matrix("e", reached / (b * norm) * T)}  # fmt: skip


def deformation(point: Point, ctx: Any) -> Values:
    """e from the lengths of short lines before and after: dX solves F dX = dx."""
    F = _tensor("F", numbers(ctx, point), ctx, symmetric=False)

    def grown(dx: list[Any]) -> Any:
        """dx . e dx."""
        before = ctx.lu_solve(F, ctx.matrix(dx))
        return ctx.fsum(x**2 for x in dx) / 2 - ctx.fsum(x**2 for x in before) / 2

    def axis(*which: int) -> list[Any]:
        return [ctx.mpf(which.count(k)) for k in range(3)]

    e = ctx.matrix(3)
    for i in range(3):
        for j in range(3):
            e[i, j] = (grown(axis(i, j)) - grown(axis(i)) - grown(axis(j))) / 2
    return {**of_matrix("e", e), **of_matrix("Binv", ctx.inverse(F * F.T))}


# -- slopes and limits ---------------------------------------------------------------------------


def _radial(values: Mapping[sp.Symbol, Any], ctx: Any) -> Any:
    """The load radius as a function of the strain radius, by root search along one ray."""
    measured = NumericLaw(values, ctx)
    ray = law.unit(5, 1 / ctx.sqrt(measured.form(law.unit(5))))

    def radius(x: Any) -> Any:
        return ctx.sqrt(measured.dual(measured.loads([x * e for e in ray])))

    return radius


def slopes(stiffness: sp.Symbol) -> Any:
    """Values of dy/dx at rest, far out, and of its slope, from the law solved for its load."""

    def route(point: Point, _: Any) -> Values:
        ctx = context(3 * law.SPARE)  # dy/dx of 1e40 and more, differenced twice
        values = numbers(ctx, point)
        radius, power, G = _radial(values, ctx), values[p], values[gamma]

        def rate(x: Any) -> Any:
            step = x * ctx.mpf(10) ** -90
            return (radius(x + step) - radius(x - step)) / (2 * step)

        def at(load: Any) -> Any:
            """The strain radius under a load, from the law with K solved numerically."""
            measured, tension = NumericLaw(values, ctx), law.unit(5)
            size = load / ctx.sqrt(measured.dual(tension))
            return ctx.sqrt(measured.form(law.strains(values, [size * f for f in tension], ctx)))

        here, far = values[y], G * ctx.mpf(10) ** (40 / power)
        step = here * ctx.mpf(10) ** -40
        bend = (rate(at(here + step)) - rate(at(here - step))) / (2 * step)
        ratio = stiffness * gamma**p / y ** (p + 1)
        return {
            LimitOf(stiffness, y, sp.Integer(0)): rate(ctx.mpf(10) ** (-60 / power)),
            Partial(stiffness, y): bend,
            LimitOf(ratio, y, sp.oo): rate(at(far)) * G**power / far ** (power + 1),
        }

    return route


def stiff_in_shear(point: Point, _: Any) -> Values:
    """The shear strains at zeta = 10^60."""
    ctx = context(2 * law.SPARE)  # entries of K are 10^120 apart
    values = {**numbers(ctx, point), zeta: ctx.mpf(10) ** 60}
    strain = law.strains(values, [values[x] for x in LOADS], ctx)
    return {LimitOf(x, zeta, sp.oo): strain[3 + k] for k, x in enumerate(STRAINS[3:5])}


# -- a process with two relaxation times -----------------------------------------------------------


def two_times(loss: sp.Symbol) -> Any:
    """xi of a small process at Q = 1 - 2e-40, over c = (dy/dx - y/x)/x^2.

    xi = (sigma - DW(eps)) . eps_t with sigma = DW(eps + T eps_t): loads by root search.
    """

    def route(point: Point, _: Any) -> Values:
        ctx = context(2 * law.SPARE)
        values = numbers(ctx, {**sampling.constants(0), **point})
        measured, x = NumericLaw(values, ctx), 1 - ctx.mpf(10) ** -40
        small, half = ctx.mpf(10) ** -110, x / ctx.sqrt(2)
        u, v = values[time_u], values[time_v]

        def loads(bend: Any, shear: Any) -> tuple[Any, Any]:
            found = measured.loads([bend, 0, 0, shear, 0, 0])
            return found[0], found[3]

        eps = (half / values[alpha], half / values[zeta])  # bending and shear in equal parts
        w = (values[alpha] ** 2 * eps[0], values[zeta] ** 2 * eps[1])
        z = (1 / w[0], -(1 + v / u) / 2 / w[1])
        now = loads(*eps)
        ahead = loads(*(e + small * r for e, r in zip(eps, z, strict=True)))
        power = ctx.fsum((f - g) / small * r / t
                         for f, g, r, t in zip(ahead, now, z, (u, v), strict=True))  # fmt: skip
        radius = _radial(values, ctx)
        rate = (radius(x + small) - radius(x - small)) / (2 * small)
        return {loss: power / ((rate - radius(x) / x) / x**2)}

    return route
