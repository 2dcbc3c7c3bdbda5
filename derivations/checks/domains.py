"""The two domains of Section 3.1, with a second, numerical route to every quantity.

On loads: all (m, n). On strains: all (u, v) with Q < 1. The second route never uses the derived
formulas: the dual form comes from a numerical linear solve, strains from a numerical gradient of
W* integrated by quadrature, loads from solving the law for its unknown, W from Legendre duality.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import numbers
from rodproof.derivations.notation import Partial, Q, Qstar, W, Wstar, m, n, u, v
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.symbols import (
    CONSTANTS,
    LOADS,
    STRAINS,
    alpha,
    beta,
    chiral_gap,
    eta,
    gamma,
    iota,
    p,
    v3,
    zeta,
)
from rodproof.derivations.theory import constitutive

REST = {**dict.fromkeys(STRAINS, sp.Integer(0)), v3: sp.Integer(1)}
NO_LOAD = dict.fromkeys(LOADS, sp.Integer(0))


def _of_strains(expr: sp.Expr) -> Any:
    def at(first: Any, second: Any) -> sp.Expr:
        if not (isinstance(first, tuple) and isinstance(second, tuple)):
            raise IllTyped("a form takes two vectors, and one argument is a number")
        return expr.xreplace(dict(zip(STRAINS, (*first, *second), strict=True)))

    return at


def _of_loads(expr: sp.Expr) -> Any:
    def at(first: Any, second: Any) -> sp.Expr:
        if not (isinstance(first, tuple) and isinstance(second, tuple)):
            raise IllTyped("a form takes two vectors, and one argument is a number")
        return expr.xreplace(dict(zip(LOADS, (*first, *second), strict=True)))

    return at


FUNCTIONS = {
    Q: _of_strains(constitutive.quadratic_form()),
    Qstar: _of_loads(constitutive.dual_form()),
    W: _of_strains(constitutive.stored_energy()),
    Wstar: _of_loads(constitutive.complementary_energy()),
}


class NumericLaw:
    """The law from its definition, numerically: K, one quadrature, one root."""

    def __init__(self, point: Mapping[sp.Symbol, Any], ctx: Any) -> None:
        self.ctx = ctx
        self.c = numbers(ctx, point)
        c = self.c
        self.K = ctx.diag(
            [c[alpha] ** 2, c[alpha] ** 2, c[beta] ** 2, c[zeta] ** 2, c[zeta] ** 2, c[eta] ** 2]
        )
        self.K[2, 5] = self.K[5, 2] = c[iota]

    @cached_property
    def _inverse(self) -> list[list[Any]]:
        """K inverted numerically, once: root searches ask for it over and over."""
        return [list(row) for row in self.ctx.inverse(self.K).tolist()]

    def image(self, load: Sequence[Any]) -> list[Any]:
        """K^{-1} sigma."""
        present = [(k, x) for k, x in enumerate(load) if x]
        return [self.ctx.fsum(row[k] * x for k, x in present) for row in self._inverse]

    def dual(self, load: Sequence[Any]) -> Any:
        return self._dot(load, self.image(load))

    def under(self, load: Sequence[Any]) -> list[Any]:
        """The law as it stands, (gamma^p + y^p)^{-1/p} K^{-1} sigma; gamma is 1 where not given."""
        image, power = self.image(load), self.c[p]
        radius = self.ctx.sqrt(self._dot(load, image))
        factor = (self.c.get(gamma, 1) ** power + radius**power) ** (-1 / power)
        return [factor * e for e in image]

    def form(self, strain: list[Any]) -> Any:
        return self._dot(strain, self.K * self.ctx.matrix(strain))

    def complementary(self, load: list[Any]) -> Any:
        return self._energy(self.ctx.sqrt(self.dual(load)))

    def _energy(self, radius: Any) -> Any:
        """W* in the variable r = t^{1/2}: the integrand r (gamma^p + r^p)^{-1/p} is tame at 0."""
        power, root = self.c[p], -1 / self.c[p]
        scale = self.c[gamma] ** power
        return self.ctx.quad(lambda r: r * (scale + r**power) ** root, [0, radius])

    def strains(self, load: list[Any]) -> list[Any]:
        """Numerical gradient of W*: the slope in the load radius times the radius' gradient."""
        radius = self.ctx.sqrt(self.dual(load))
        slope = self._slope(self._energy, radius)
        return [slope * g for g in self._gradient(lambda s: self.ctx.sqrt(self.dual(s)), load)]

    def loads(self, strain: list[Any]) -> list[Any]:
        """The load s K eps with s from y = s x, x = y (gamma^p + y^p)^{-1/p}, by bisection."""
        ctx, power, scale = self.ctx, self.c[p], self.c[gamma]
        radius = ctx.sqrt(self.form(strain))

        def excess(log_y: Any) -> Any:
            y = ctx.exp(log_y)
            return y * (scale**power + y**power) ** (-1 / power) / radius - 1

        low = ctx.log(scale * radius / 2)
        high = low + 1
        while excess(high) < 0:
            low, high = high, high + 1
        y = ctx.exp(ctx.findroot(excess, (low, high), solver="anderson"))
        return [y / radius * row for row in self.K * ctx.matrix(strain)]

    def stored(self, strain: list[Any]) -> Any:
        """W = sigma . eps - W*(sigma) at the load that belongs to the strain."""
        load = self.loads(strain)
        return self._dot(load, strain) - self.complementary(load)

    def stored_gradient(self, strain: list[Any]) -> list[Any]:
        """Numerical gradient of W: its slope along the ray times the radius' gradient."""
        radius = self.ctx.sqrt(self.form(strain))
        slope = self._slope(lambda r: self.stored([r / radius * e for e in strain]), radius)
        return [slope * g for g in self._gradient(lambda e: self.ctx.sqrt(self.form(e)), strain)]

    def _slope(self, function: Any, at: Any) -> Any:
        """Central difference of order six: 54 digits of 65 with a step of 1e-9."""
        step = at * self.ctx.mpf(10) ** -9
        weights = {1: 45, 2: -9, 3: 1}
        return self.ctx.fsum(
            w * (function(at + k * step) - function(at - k * step)) for k, w in weights.items()
        ) / (60 * step)

    def _gradient(self, function: Any, at: list[Any]) -> list[Any]:
        return [
            self.ctx.diff(lambda x, i=i: function([*at[:i], x, *at[i + 1 :]]), at[i])
            for i in range(6)
        ]

    def _dot(self, a: Any, b: Any) -> Any:
        return self.ctx.fsum(x * y for x, y in zip(a, b, strict=True))


def _route_on_loads(point: Point, ctx: Any) -> Values:
    law = NumericLaw(point, ctx)
    load = [law.c[s] for s in LOADS]
    strain = law.strains(load)
    found: dict[sp.Basic, Any] = dict(zip(STRAINS, strain, strict=True))
    found[v3] = 1 + strain[5]
    found[Q(u, v)] = law.form(strain)
    found[Qstar(m, n)] = law.dual(load)
    found[Wstar(m, n)] = law.complementary(load)
    found |= {Partial(Wstar(m, n), s): e for s, e in zip(LOADS, strain, strict=True)}
    return found


def _route_on_strains(point: Point, ctx: Any) -> Values:
    law = NumericLaw(point, ctx)
    strain = [law.c[s] for s in STRAINS[:5]] + [law.c[v3] - 1]
    found: dict[sp.Basic, Any] = dict(zip(LOADS, law.loads(strain), strict=True))
    found[Q(u, v)] = law.form(strain)
    found[W(u, v)] = law.stored(strain)
    slopes = law.stored_gradient(strain)
    found |= {Partial(W(u, v), s): g for s, g in zip(STRAINS, slopes, strict=True)}
    return found


#: All loads; the strains depend on them.
ON_LOADS = Meaning(
    name="all loads",
    free=(*CONSTANTS, *LOADS),
    sample=sampling.with_loads,
    simple=sampling.simple_loads,
    components=dict(
        zip(STRAINS, (*constitutive.strains()[:5], 1 + constitutive.strains()[5]), strict=True)
    ),
    functions=FUNCTIONS,
    positive=(chiral_gap, constitutive.dual_form()),
    edges=(NO_LOAD,),
    route=_route_on_loads,
    route_name="numerical gradient of W* by quadrature, K inverted numerically",
)

#: All strains with Q < 1; the loads depend on them.
ON_STRAINS = Meaning(
    name="all strains with Q < 1",
    free=(*CONSTANTS, *STRAINS),
    sample=sampling.with_strains,
    simple=sampling.simple_strains,
    components=dict(zip(LOADS, constitutive.loads(), strict=True)),
    functions=FUNCTIONS,
    positive=(
        chiral_gap,
        constitutive.quadratic_form(),
        1 - constitutive.quadratic_form() ** (p / 2),
    ),
    edges=(REST,),
    route=_route_on_strains,
    route_name="loads by root-finding, W by Legendre duality and quadrature",
)


def _route_near_rest(point: Point, ctx: Any) -> Values:
    law = NumericLaw(point, ctx)
    h = ctx.mpf(10) ** -200  # the remainder is of relative order h^p
    strain = [law.c[s] for s in STRAINS[:5]] + [law.c[v3] - 1]
    tiny = law.loads([h * e for e in strain])
    found: dict[sp.Basic, Any] = {s: f / h for s, f in zip(LOADS, tiny, strict=True)}
    for j, s in enumerate(STRAINS):
        column = law.loads([h if i == j else ctx.mpf(0) for i in range(6)])
        found |= {Partial(load, s): f / h for load, f in zip(LOADS, column, strict=True)}
    found[Q(u, v)] = law.form(strain)
    found[MIRRORED_FORM] = law.form([e * k for e, k in zip(strain, MIRROR, strict=True)])
    return found


#: A reflection in the plane of d_1 and d_3: v is a vector, u an axial vector.
MIRROR = (-1, 1, -1, 1, -1, 1)
MIRRORED_FORM = sp.Symbol("Q_mirror", real=True)

#: The linear law near rest.
NEAR_REST = Meaning(
    name="leading order at rest",
    free=(*CONSTANTS, *STRAINS),
    sample=sampling.with_strains,
    simple=sampling.simple_strains,
    components={
        **dict(zip(LOADS, constitutive.loads_at_leading_order(), strict=True)),
        MIRRORED_FORM: constitutive.quadratic_form().subs(
            {
                s: k * e + r
                for s, k, e, r in zip(
                    STRAINS, MIRROR, constitutive.STRAIN_FROM_REST, (0, 0, 0, 0, 0, 1), strict=True
                )
            },
            simultaneous=True,
        ),
    },
    functions=FUNCTIONS,
    positive=(chiral_gap,),
    route=_route_near_rest,
    route_name="loads by root-finding at strains of size 1e-200, divided by it",
)
