"""The checks of Section 2.2: resultants, local balance, and balance seen from the directors.

Second routes: a resultant is recomputed as an integral along the segment, by quadrature of the
rate of n or of m + (r - o) x n; body loads are recomputed as minus the rate of the resultant of a
segment that grows, with the moment of the body force integrated; in the directors a rod with
constant strains carries n_k(s) d_k(s) and m_k(s) d_k(s) and everything is differentiated.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import sympy as sp

from rodproof.derivations.exact.evaluate import numbers
from rodproof.derivations.notation import Prime
from rodproof.derivations.proof import curves
from rodproof.derivations.proof.curves import Vector, cross, minus, plus, rate, times
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.proof.vectors import VectorIdentity, Vectors, symbols_of
from rodproof.derivations.symbols import LOADS, STRAINS
from rodproof.derivations.theory import balance
from rodproof.derivations.theory.kinematics import Triple

#: Vectors at the ends of a segment, at one place, and the resultants on the segment.
AT_ENDS = {
    name: {end: sp.Symbol(f"bold_{name}_{end}", real=True) for end in "ab"} for name in "rnm"
}
r_vector, n_vector, m_vector, f_vector, l_vector = sp.symbols(
    "bold_r bold_n bold_m bold_f bold_l", real=True
)
o_vector, force_on_segment, couple_on_segment = sp.symbols("bold_o bold_F bold_C", real=True)

_NAMES = {
    **{AT_ENDS[name][end]: f"{name}_{end}" for name in "rnm" for end in "ab"},
    **{x: str(x).removeprefix("bold_") for x in (r_vector, n_vector, m_vector, f_vector, l_vector)},
    **{Prime(x): f"{str(x).removeprefix('bold_')}_rate" for x in (r_vector, n_vector, m_vector)},
    o_vector: "o", force_on_segment: "F", couple_on_segment: "C",
}  # fmt: skip
VECTORS = Vectors({vector: symbols_of(name) for vector, name in _NAMES.items()})


def _named(expr: sp.Expr) -> sp.Expr:
    """Fields at a, b and their rates at b as the plain names of this module."""
    table: dict[sp.Basic, sp.Expr] = dict(zip(balance.origin, symbols_of("o"), strict=True))
    for name in "rnm":
        for end, place in (("a", balance.a), ("b", balance.b)):
            values = balance.field(name, place)
            table |= dict(zip(values, symbols_of(f"{name}_{end}"), strict=True))
        rates = balance.field(name, balance.b).diff(balance.b)
        table |= dict(zip(rates, symbols_of(f"{name}_rate"), strict=True))
    return expr.xreplace({k: v for k, v in table.items() if k.is_Derivative}).xreplace(table)


def _resultants() -> dict[sp.Symbol, sp.Expr]:
    found = dict(zip(symbols_of("F"), map(_named, balance.resultant_force()), strict=True))
    return found | dict(zip(symbols_of("C"), map(_named, balance.resultant_couple()), strict=True))


def _body_loads() -> dict[sp.Symbol, sp.Expr]:
    at_b = {s: t for x in "rnm" for s, t in zip(symbols_of(f"{x}_b"), symbols_of(x), strict=True)}
    found: dict[sp.Symbol, sp.Expr] = {}
    for name, part in zip("fl", balance.body_loads(), strict=True):
        values = [_named(e).xreplace(at_b) for e in part]
        found |= dict(zip(symbols_of(name), values, strict=True))
    return found


_FREE = tuple(
    s for name in ("r_a", "n_a", "m_a", "r_b", "n_b", "m_b", "o") for s in symbols_of(name)
)
_LOCAL = tuple(
    s for name in ("r", "n", "m", "r_rate", "n_rate", "m_rate", "o") for s in symbols_of(name)
)


def _sampler(free: tuple[sp.Symbol, ...]) -> Callable[[int], Point]:
    def sample(seed: int) -> Point:
        rng = random.Random(f"balance {seed}")
        return {s: sp.Rational(rng.choice((-1, 1)) * rng.randint(7, 61), 23) for s in free}

    return sample


def _small(free: tuple[sp.Symbol, ...]) -> tuple[Point, ...]:
    return ({s: sp.Integer((3 * i + 1) % 5 - 1) for i, s in enumerate(free)},)


def _bent(start: Vector, end: Vector) -> Callable[[Any], Vector]:
    """A cubic from `start` at 0 to `end` at 1."""

    def at(s: Any) -> Vector:
        straight = plus(times(1 - s, start), times(s, end))
        return plus(straight, times(s * (1 - s), [1, -2 - s, 3 * s]))

    return at


def _route_of_segment(point: Point, ctx: Any) -> Values:
    """Resultants as integrals of the rates along a segment with these end values."""
    c = numbers(ctx, point)
    r, n, m = (_bent(*([c[s] for s in symbols_of(f"{x}_{end}")] for end in "ab")) for x in "rnm")
    o = [c[s] for s in symbols_of("o")]

    def couple(s: Any) -> Vector:
        arm = minus(r(s), o)
        return plus(rate(ctx, m, s), cross(rate(ctx, r, s), n(s)), cross(arm, rate(ctx, n, s)))

    def integral(g: Callable[[Any], Vector], i: int) -> Any:
        """Six Gauss points: exact for the polynomials of degree 5 that stand here."""
        return ctx.quad(lambda s: g(s)[i], [0, 1], method="gauss-legendre", maxdegree=2)

    whole = [[integral(g, i) for i in range(3)] for g in (lambda s: rate(ctx, n, s), couple)]
    found: dict[sp.Basic, Any] = dict(zip(symbols_of("F"), whole[0], strict=True))
    return found | dict(zip(symbols_of("C"), whole[1], strict=True))


def _route_of_body_loads(point: Point, ctx: Any) -> Values:
    """Minus the rates of what a growing segment [0, b] feels, at b = 0."""
    c = numbers(ctx, point)

    def along(name: str) -> Callable[[Any], Vector]:
        value, slope = ([c[s] for s in symbols_of(x)] for x in (name, f"{name}_rate"))
        return lambda s: plus(value, times(ctx.sin(s), slope), times(s * s, [1, -1, 2]))

    r, n, m = (along(x) for x in "rnm")
    o, zero = [c[s] for s in symbols_of("o")], ctx.mpf(0)

    def resultant(b: Any) -> Vector:
        return plus(m(b), cross(minus(r(b), o), n(b)))

    force = times(-1, rate(ctx, n, zero))
    moment_of_f = cross(minus(r(zero), o), force)
    couple = minus(times(-1, rate(ctx, resultant, zero)), moment_of_f)
    found: dict[sp.Basic, Any] = dict(zip(symbols_of("f"), force, strict=True))
    return found | dict(zip(symbols_of("l"), couple, strict=True))


SEGMENT = VectorIdentity(
    Meaning(
        name="all segments", free=_FREE, components=_resultants(), sample=_sampler(_FREE),
        simple=lambda: _small(_FREE), route=_route_of_segment,
        route_name="quadrature of the rates along the segment",
    ),
    VECTORS,
)  # fmt: skip
LOCAL = VectorIdentity(
    Meaning(
        name="all rods in equilibrium", free=_LOCAL, components=_body_loads(),
        sample=_sampler(_LOCAL), simple=lambda: _small(_LOCAL), route=_route_of_body_loads,
        route_name="rates of the resultants on a growing segment",
    ),
    VECTORS,
)  # fmt: skip

# -- in the directors --------------------------------------------------------------------------

BODY = {name: sp.symbols(f"{name}1:4", real=True) for name in "fl"}
body_force, body_couple = (sp.IndexedBase(name, real=True) for name in "fl")


_RATE = {s: sp.Symbol(f"{s}_rate", real=True) for s in LOADS}


def _rates(symbols: tuple[sp.Symbol, ...]) -> Triple:
    first, second, third = (_RATE[s] for s in symbols)
    return first, second, third


def _in_directors() -> dict[sp.Symbol, sp.Expr]:
    """f = -n' and l = -(m' + r' x n), all in the directors."""
    u, v = STRAINS[:3], STRAINS[3:]
    m, n = LOADS[:3], LOADS[3:]
    n_rate = balance.in_the_frame(_rates(n), n, u)
    m_rate = balance.in_the_frame(_rates(m), m, u)
    turned = sp.Matrix(v).cross(sp.Matrix(n))
    found = {s: -x for s, x in zip(BODY["f"], n_rate, strict=True)}
    return found | {s: -x - y for s, x, y in zip(BODY["l"], m_rate, turned, strict=True)}


_SEEN = (*STRAINS, *LOADS)
_SLOPES = tuple(_RATE.values())


def _sample_in_directors(seed: int) -> Point:
    rng = random.Random(f"directors {seed}")
    keys = (*_SEEN, *_SLOPES)
    return {s: sp.Rational(rng.choice((-1, 1)) * rng.randint(7, 61), 23) for s in keys}


def _route_in_directors(point: Point, ctx: Any) -> Values:
    c = numbers(ctx, point)
    rod = curves.uniform_rod(ctx, [c[s] for s in STRAINS[:3]], [c[s] for s in STRAINS[3:]])
    zero = ctx.mpf(0)

    def carried(symbols: tuple[sp.Symbol, ...]) -> Callable[[Any], Vector]:
        def at(s: Any) -> Vector:
            parts = zip(symbols, rod(s)[1], strict=True)
            return plus(*(times(c[x] + ctx.sin(s) * c[_RATE[x]], d) for x, d in parts))

        return at

    m, n = carried(LOADS[:3]), carried(LOADS[3:])
    frame = rod(zero)[1]
    force = times(-1, rate(ctx, n, zero))
    tangent = rate(ctx, lambda s: rod(s)[0], zero)
    couple = times(-1, plus(rate(ctx, m, zero), cross(tangent, n(zero))))
    found: dict[sp.Basic, Any] = {}
    for name, vector in (("f", force), ("l", couple)):
        found |= dict(zip(BODY[name], curves.components(ctx, frame, vector), strict=True))
    return found


IN_DIRECTORS = VectorIdentity(
    Meaning(
        name="all rods in equilibrium, seen from the directors", free=(*_SEEN, *_SLOPES),
        components=_in_directors(), sample=_sample_in_directors,
        simple=lambda: ({s: sp.Integer(i % 5 - 1) for i, s in enumerate((*_SEEN, *_SLOPES))},),
        route=_route_in_directors,
        route_name="a rod with constant strains, n and m carried by its directors, differentiated",
    ),
    Vectors({Prime(s): rate_of for s, rate_of in _RATE.items()}),
)  # fmt: skip
