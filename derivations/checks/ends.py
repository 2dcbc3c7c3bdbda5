"""Section 5.1, conditions at the ends: any equilibrium under n = N g_3, and the two branches.

The second route builds a sheared rod: directors at a constant angle theta to g_3 that twist at a
constant rate, and r' = lambda g_3; lambda and the twist are those that leave n along g_3 and no
couple. Loads are measured at both ends.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks import equilibrium as numeric
from rodproof.derivations.checks.couple.domains import HALF_ANGLE, on_all
from rodproof.derivations.checks.couple.route import t
from rodproof.derivations.exact.evaluate import context, numbers
from rodproof.derivations.notation import Every
from rodproof.derivations.proof.meaning import Meaning, Point, Values, of_vector
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import CONSTANTS, beta, eta, iota, v3, zeta
from rodproof.derivations.theory import ends as theory
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.frames import euler_frame, theta

#: Vectors in the fixed basis: the origin, m, r, n at the ends s = 0 (a) and s = 1 (b).
o, m_a, m_b, r_a, r_b, n_b = (
    sp.IndexedBase(name, real=True) for name in ("o", "m_a", "m_b", "r_a", "r_b", "n_b")
)
tilt_sheared, tilt_straight = sp.symbols("tilt_sheared tilt_straight", real=True)


_ORIGIN = of_vector(r_a, theory.origin)
_FORCE = of_vector(n_b, theory.force)
_ROUTE = "loads of a straight sheared rod at both ends, from r(s) and the directors"


def _sample(seed: int) -> Point:
    names = (*theory.origin, *theory.first_couple, *theory.any_force, *theory.last_place,
             euler.N, t, v3, euler.v_scalar)  # fmt: skip
    # eta^2 - iota^2/beta^2 > zeta^2 and a moderate tilt, so that a sheared state exists
    rod = (1, sp.Rational(9, 7), 1, sp.Rational(1, 5), sp.Rational(7, 5), sp.Rational(1, 3),
           sp.Rational(17, 9))  # fmt: skip
    values = {x: sp.Rational((23 * k + 13 * seed) % 37 + 3, 41) for k, x in enumerate(names)}
    known = dict(zip(CONSTANTS, map(sp.sympify, rod), strict=True))
    return {**values, **known, t: sp.Rational(2 + seed, 9)}


@cache
def _measured(seed: int) -> dict[sp.Basic, Any]:
    ctx = context(65)
    point = _sample(seed)
    c = numbers(ctx, point)
    angle = 2 * ctx.atan(c[t])
    stiffness = c[eta] ** 2 - c[iota] ** 2 / c[beta] ** 2
    stretch = stiffness / (ctx.cos(angle) * (stiffness - c[zeta] ** 2))
    twist = -c[iota] * (stretch * ctx.cos(angle) - 1) / c[beta] ** 2
    at = sp.Symbol("s", real=True)
    place, rate, tilt = sp.symbols("stretch twist tilt", positive=True)
    values = {place: stretch, rate: twist, tilt: angle}
    start = [c[x] for x in theory.origin]

    def line(s: Any) -> list[Any]:
        return [start[0], start[1], start[2] + stretch * s]

    frame = numeric.frame(euler_frame(sp.Integer(0), tilt, rate * at), at, values, ctx)
    law = {x: point[x] for x in CONSTANTS}
    first, _ = numeric.contact(line, frame, law, ctx.mpf(0), ctx)
    last, force = numeric.contact(line, frame, law, ctx.mpf(1), ctx)
    return {
        **of_vector(m_a, first), **of_vector(m_b, last), **of_vector(r_a, start),
        **of_vector(r_b, line(ctx.mpf(1))), **of_vector(n_b, force), euler.N: force[2],
        tilt_sheared: frame(ctx.mpf(0))[2][2], tilt_straight: ctx.mpf(1),
    }  # fmt: skip


def _route(point: Point, ctx: Any) -> Values:
    return _measured(next(k for k in range(9) if _sample(k) == point))


def _meaning(name: str, components: dict[sp.Symbol, sp.Expr]) -> Meaning:
    return Meaning(
        name=name, free=(), sample=_sample, simple=lambda: (_sample(0),), components=components,
        positive=(1 - t**2,), route=_route, route_name=_ROUTE,
    )  # fmt: skip


#: Every equilibrium with r(0) = o.
ANY = _meaning(
    "equilibria under any end force",
    {**_ORIGIN, **of_vector(m_b, theory.last_couple())},
)


def _branch(name: str, line: sp.Matrix) -> Meaning:
    """m = 0 along the rod."""
    nothing = sp.zeros(3, 1)
    return _meaning(name, {
        **_ORIGIN, **_FORCE, **of_vector(m_a, nothing), **of_vector(m_b, nothing),
        **of_vector(r_b, theory.origin + line),
    })  # fmt: skip


STRAIGHT = _branch("straight and unsheared", theory.straight())
SHEARED = _branch("straight and sheared", theory.sheared())

#: d_3 . g_3 on the two branches; 0 < theta < pi/2 on the sheared one.
TILTS = _meaning("tilt of the two branches", {
    tilt_sheared: theory.tilt().xreplace({theta: theta}).xreplace(dict(HALF_ANGLE)),
    tilt_straight: theory.tilt().subs(theta, 0),
})  # fmt: skip


@dataclass(frozen=True, eq=False)
class OnBranches:
    """True on both branches; and the conditions at r(0), and on the couple, on all equilibria.

    Three vector equations in this order: for r(0), for the couple, and for n(1).
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Every) or len(set(printed.args)) != 9:
            return Decision(False, False, "rejected")
        force = {x for claim in printed.args[6:] for x in claim.sides if x.is_Indexed}
        if force != {n_b[1], n_b[2], n_b[3]}:
            return Decision(False, False, "rejected")
        found = Identity(ANY).decide(Every(*printed.args[:6]), explain=explain)
        if not found.holds:
            return found
        return on_all([Identity(STRAIGHT), Identity(SHEARED)], printed, explain)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(SHEARED).confirm(printed)
