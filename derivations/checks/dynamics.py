"""Section 5.1 as domains and checks: moving sections, viscous laws, conditions at the ends.

Second routes: four point masses that move with a rotating frame, differentiated numerically;
loads by root-finding at the strains that a law prescribes; a sheared and a straight rod built
from r(s) and the directors.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import sympy as sp

from rodproof.derivations.checks import equilibrium as numeric
from rodproof.derivations.checks.domains import (
    NO_LOAD,
    ON_LOADS,
    ON_STRAINS,
    NumericLaw,
)
from rodproof.derivations.checks.routes import values as measured
from rodproof.derivations.exact.evaluate import number, numbers
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Every, Partial, W, Wstar, m, n, u, v
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values, of_vector
from rodproof.derivations.proof.prover import Identity, claims
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, v3
from rodproof.derivations.theory import constitutive, dissipation
from rodproof.derivations.theory import dynamics as theory
from rodproof.derivations.theory.dissipation import RATES, time, viscosity_m, viscosity_n

_REJECTED = Decision(False, False, "rejected")

# -- sections that move -------------------------------------------------------------------------

#: Vectors in the directors: n_s, m_s, r_tt, the angular momentum H = (rho J) w and its rate, w.
n_s, m_s, r_tt, H, H_t, w = (
    sp.IndexedBase(name, real=True) for name in ("n_s", "m_s", "r_tt", "H", "H_t", "w")
)
FORCE = sp.Matrix(LOADS[3:])
TANGENT = sp.Matrix(STRAINS[3:])


def _moving(central: dict[sp.Symbol, sp.Expr]) -> Meaning:
    """Any motion; `central` says which moments of the mass vanish."""
    couple_slope = theory.couple_rate() - TANGENT.cross(FORCE)
    components = {
        **of_vector(n_s, theory.force_slope()), **of_vector(m_s, couple_slope),
        **of_vector(H, theory.section_momentum()), **of_vector(H_t, theory.section_momentum_rate()),
    }  # fmt: skip
    return Meaning(
        name="moving sections", free=(), sample=_sample_motion,
        simple=lambda: (_sample_motion(0),), route=_masses, route_name=_MASSES,
        components={x: e.xreplace(central) for x, e in components.items()},
    )  # fmt: skip


_MASSES = "four point masses on the principal axes, positions differentiated numerically"
_HALF = (sp.Rational(3, 5), sp.Rational(7, 8))  # distances of the masses on the two axes
_MASS = sp.Rational(5, 4)


def _sample_motion(seed: int) -> Point:
    """Generic rates; the moments are those of the point masses of the second route."""
    names = (*theory.spin, *theory.spin_t, *theory.acceleration, *LOADS, *STRAINS)
    values = {x: sp.Rational((31 * k + 17 * seed) % 53 - 26, 19) for k, x in enumerate(names, 3)}
    a, b = _HALF
    moments = {theory.rho_A: 4 * _MASS, theory.J1: 2 * _MASS * b**2, theory.J2: 2 * _MASS * a**2}
    return values | moments | dict.fromkeys((theory.S1, theory.S2, theory.J12), sp.Integer(0))


def _masses(point: Point, ctx: Any) -> Values:
    """The same vectors from the positions of four masses; n and v as in the sample."""
    law = numbers(ctx, point)
    curves = zip(STRAINS, LOADS, (*theory.spin, *theory.acceleration), strict=True)
    coefficients = [[law[x] for x in row] for row in curves]  # of the angles, then of r

    def rows(at: Any, which: int) -> list[Any]:
        return [c[0] + c[1] * at + c[2] * at**2 for c in coefficients[which : which + 3]]

    def frame(at: Any) -> list[list[Any]]:
        first, second, third = rows(at, 0)
        turn = [ctx.matrix(3), ctx.matrix(3), ctx.matrix(3)]
        for matrix, angle, axes in ((turn[0], first, (0, 1)), (turn[1], second, (2, 0)),
                                    (turn[2], third, (0, 1))):  # fmt: skip
            i, j = axes
            for k in range(3):
                matrix[k, k] = ctx.mpf(1)
            matrix[i, i] = matrix[j, j] = ctx.cos(angle)
            matrix[j, i] = ctx.sin(angle)
            matrix[i, j] = -ctx.sin(angle)
        total = turn[0] * turn[1] * turn[2]
        return [[total[row, k] for row in range(3)] for k in range(3)]

    def arms(at: Any) -> list[list[Any]]:
        d1, d2, _ = frame(at)
        a, b = (number(ctx, e) for e in _HALF)
        return [[k * x for x in d] for d, k in ((d1, a), (d1, -a), (d2, b), (d2, -b))]

    def place(at: Any) -> list[Any]:
        return rows(at, 3)

    def arm(k: int, at: Any) -> list[Any]:
        return arms(at)[k]

    def position(k: int, at: Any) -> list[Any]:
        return [p + q for p, q in zip(place(at), arm(k, at), strict=True)]

    mass, zero = number(ctx, _MASS), ctx.mpf(0)

    def arm_momentum(at: Any) -> list[Any]:
        total = [zero] * 3
        for k in range(4):
            turned = numeric.cross(arms(at)[k], numeric.slope(partial(arm, k), at, ctx))
            total = [x + mass * y for x, y in zip(total, turned, strict=True)]
        return total

    def momentum(at: Any) -> list[Any]:
        """The momentum, and the angular momentum about the origin."""
        total = [zero] * 6
        for k in range(4):
            moved = numeric.slope(partial(position, k), at, ctx)
            both = (*moved, *numeric.cross(position(k, at), moved))
            total = [x + mass * y for x, y in zip(total, both, strict=True)]
        return total

    directors = frame(zero)

    def inside(vector: list[Any]) -> list[Any]:
        return [numeric.dot(vector, d, ctx) for d in directors]

    u_like, _ = numeric.strains_of(place, frame, zero, ctx)  # the angular velocity: t for s
    force = [law[x] for x in LOADS[3:]]
    tangent = [law[x] for x in STRAINS[3:]]
    turning = inside(numeric.slope(arm_momentum, zero, ctx))
    slope = numeric.slope(lambda x: numeric.slope(place, x, ctx), zero, ctx)
    slopes = numeric.slope(momentum, zero, ctx)
    about_o = inside(slopes[3:])
    lever = inside(numeric.cross(place(zero), slopes[:3]))
    couple = zip(about_o, lever, numeric.cross(tangent, force), strict=True)
    return {
        **of_vector(w, u_like), **of_vector(r_tt, inside(slope)),
        **of_vector(n_s, inside(slopes[:3])),
        **of_vector(H, inside(arm_momentum(zero))), **of_vector(H_t, turning),
        **of_vector(m_s, [x - y - z for x, y, z in couple]),
        **of_vector(v, tangent), **of_vector(n, force),
    }  # fmt: skip


MOVING = _moving(dict(theory.CENTRAL))
#: Principal axes, the center line anywhere: enough for the momentum relative to r.
MOVING_ANYWHERE = _moving({theory.J12: sp.Integer(0)})

# -- viscous laws -------------------------------------------------------------------------------

u_t, v_t = (sp.IndexedBase(name, real=True) for name in ("u_t", "v_t"))
_STILL = dict.fromkeys(RATES, sp.Integer(0))


def _rates(seed: int) -> Point:
    values = {x: sp.Rational((13 * k + 7 * seed) % 31 - 15, 83) for k, x in enumerate(RATES, 2)}
    return {**values, time: sp.Rational(3 + seed, 17), viscosity_m: sp.Rational(5, 7),
            viscosity_n: sp.Rational(11 + seed, 9)}  # fmt: skip


def _strain_rate_route(point: Point, ctx: Any) -> Values:
    """Loads by root-finding at eps + time eps_t; the gradient of W* there, by quadrature."""
    seed = next(k for k in range(9) if sampling.with_loads(k).items() <= point.items())
    law = NumericLaw({**sampling.with_strains(seed), **_rates(seed)}, ctx)
    eps = [law.c[x] for x in STRAINS[:5]] + [law.c[v3] - 1]
    ahead = [e + law.c[time] * law.c[x] / 8 for e, x in zip(eps, RATES, strict=True)]
    load = law.loads(ahead)
    found: dict[sp.Basic, Any] = dict(zip(LOADS, load, strict=True))
    found |= dict(zip(STRAINS, (*eps[:5], 1 + eps[5]), strict=True))
    found |= {x: law.c[x] / 8 for x in RATES}
    slopes = law.strains(load)
    return found | {Partial(Wstar(m, n), x): e for x, e in zip(LOADS, slopes, strict=True)}


def _kelvin_voigt_route(point: Point, ctx: Any) -> Values:
    """The elastic loads as the numerical gradient of W, the viscous ones from half the loss."""
    law = NumericLaw(point, ctx)
    eps = [law.c[x] for x in STRAINS[:5]] + [law.c[v3] - 1]
    rates = [law.c[x] for x in RATES]

    def loss(rate: list[Any]) -> Any:
        weights = [law.c[viscosity_m]] * 3 + [law.c[viscosity_n]] * 3
        return ctx.fsum(k * x**2 for k, x in zip(weights, rate, strict=True)) / 2

    viscous = [
        ctx.diff(lambda x, i=i: loss([*rates[:i], x, *rates[i + 1 :]]), rates[i]) for i in range(6)
    ]
    slopes = law.stored_gradient(eps)
    loads = [a + b for a, b in zip(law.loads(eps), viscous, strict=True)]
    found: dict[sp.Basic, Any] = dict(zip(LOADS, loads, strict=True))
    found[dissipated_kv] = ctx.fsum(a * b for a, b in zip(viscous, rates, strict=True))
    return found | {Partial(W(u, v), x): e for x, e in zip(STRAINS, slopes, strict=True)}


dissipated_kv, dissipated_sr = sp.symbols("xi_KV xi_SR", real=True)
_ahead = dissipation.strain_rate()

#: eps + time eps_t = DW*(sigma): the strains at given loads and rates.
STRAIN_RATE = Meaning(
    name="strain-rate law", free=(*CONSTANTS, *LOADS, *RATES, time),
    sample=lambda seed: {**sampling.with_loads(seed), **_rates(seed)},
    simple=lambda: tuple({**p, **_STILL} for p in sampling.simple_loads()),
    components=dict(zip(STRAINS, (*_ahead[:5], 1 + _ahead[5]), strict=True)),
    functions=ON_LOADS.functions, positive=ON_LOADS.positive, edges=(NO_LOAD,),
    route=_strain_rate_route, route_name="loads by root-finding at eps + alpha eps_t",
)  # fmt: skip

#: sigma = DW(eps) + DR(eps_t): the loads at given strains and rates.
KELVIN_VOIGT = Meaning(
    name="Kelvin-Voigt law", free=(*CONSTANTS, *STRAINS, *RATES, viscosity_m, viscosity_n),
    sample=lambda seed: {**sampling.with_strains(seed), **_rates(seed)},
    simple=lambda: tuple({**p, **_STILL} for p in sampling.simple_strains()),
    components={
        **dict(zip(LOADS, dissipation.kelvin_voigt(), strict=True)),
        dissipated_kv: dissipation.kelvin_voigt_rate(),
    },
    functions=ON_STRAINS.functions, positive=ON_STRAINS.positive,
    route=_kelvin_voigt_route, route_name="numerical gradients of W and of the loss",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Statics:
    """Static relations of both kinds: those with W* on all loads, those with W on all strains."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        methods: list[str] = []
        for claim in claims(printed):
            kind = ON_LOADS if claim.has(Wstar) else ON_STRAINS
            found = Identity(kind).decide(claim, explain=explain)
            if not found.holds:
                return found
            methods.append(found.method)
        return Decision(True, True, "; ".join(dict.fromkeys(methods)))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        both = []
        for kind in (ON_LOADS, ON_STRAINS):
            part = [c for c in claims(printed) if c.has(Wstar) == (kind is ON_LOADS)]
            both.append(Identity(kind).confirm(Every(*part)))
        worst = max((c for c in both if c), key=lambda c: c.residual)
        return Confirmation(worst.residual, sum(c.points for c in both if c), worst.digits,
                            "; ".join(c.route for c in both if c))  # fmt: skip


@cache
def monotone() -> bool:
    """a xi >= 0 for equal times: the split, a rising radial law, and Cauchy and Schwarz in K.

    K is positive definite (its minors), so that |e . K f| <= x_e x_f.
    """
    field = Field((1 - constitutive.x ** sp.Symbol("p", positive=True),))
    split = dissipation.monotone_part() + dissipation.angle_part()
    K = constitutive.stiffness_at_rest()
    minors = [K[:k, :k].det() for k in range(1, 7)]
    definite = Field((theory_gap(),))
    return (
        sp.expand(dissipation.strain_rate_dissipation() - split) == 0
        and field.sign(dissipation.radial_slope()) == 1
        and all(definite.sign(minor) == 1 for minor in minors)
    )


def theory_gap() -> sp.Expr:
    """beta^2 eta^2 - iota^2, positive by hypothesis."""
    return constitutive.stiffness_at_rest().extract([2, 5], [2, 5]).det()


@dataclass(frozen=True, eq=False)
class Dissipates:
    """xi of the Kelvin-Voigt law as printed and nonnegative, and xi of the other nonnegative."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Every) or len(set(printed.args)) != 3:
            return _REJECTED
        rate, first, second = printed.args
        found = Identity(KELVIN_VOIGT).decide(rate, explain=explain)
        if not found.holds:
            return found
        loss = sp.Poly(dissipation.kelvin_voigt_rate(), *RATES)
        squares = all(sorted(k) == [0] * 5 + [2] for k in loss.monoms())
        signs = all(c.is_nonnegative for c in loss.coeffs())
        named = [self._nonnegative(c) for c in (first, second)]
        if named == [dissipated_kv, dissipated_sr] and squares and signs and monotone():
            method = "sum of squares; monotone radial law and Cauchy-Schwarz"
            return Decision(True, True, f"{found.method}; {method}")
        return _REJECTED

    @staticmethod
    def _nonnegative(claim: sp.Basic) -> sp.Expr | None:
        """The quantity that a claim says is nonnegative."""
        if not isinstance(claim, Chain) or claim.relations != (">=",) or claim.sides[1] != 0:
            return None
        return claim.sides[0]

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(KELVIN_VOIGT).confirm(printed.args[0])


@dataclass(frozen=True, eq=False)
class DissipativeConstants:
    """The constants that are said to be nonnegative are those on which the sign of xi rests.

    The Kelvin-Voigt law dissipates sum mu u_t^2 + nu v_t^2, so both coefficients must be; the
    strain-rate law at small strain dissipates gamma alpha eps_t . K eps_t.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        loss = sp.Poly(dissipation.kelvin_voigt_rate(), *RATES)
        needed = {*loss.coeffs(), sp.diff(-dissipation.strain_rate()[0], RATES[0])}
        stated = set()
        for claim in claims(printed):
            if not isinstance(claim, Chain) or claim.relations != (">=",) or claim.sides[1] != 0:
                return _REJECTED
            stated.add(claim.sides[0])
        method = "coefficients of the two dissipation rates, and no others"
        return Decision(True, True, method) if stated == needed else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


loss_at_limit = sp.Symbol("xi_limit", real=True)


TWO_TIMES = Meaning(
    name="two relaxation times near the strain limit", free=(dissipation.a, dissipation.b),
    sample=lambda seed: {dissipation.a: sp.Rational(3 + seed, 7), dissipation.b: sp.Rational(9, 5)},
    simple=lambda: ({dissipation.a: sp.Integer(1), dissipation.b: sp.Integer(3)},),
    components={loss_at_limit: dissipation.loss()}, route=measured.two_times(loss_at_limit),
    route_name="power of a small process at Q = 1 - 2e-40, loads by root search",
)  # fmt: skip
