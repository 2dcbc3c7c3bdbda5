"""The checks of Section 3.2: disc and body, the constrained deformation and its determinant.

Second route: a rod with constant strains from the exponential of its generator; the deformation
is evaluated at neighbouring points and differentiated numerically.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks import kinematics
from rodproof.derivations.checks.constitutive import all_around
from rodproof.derivations.exact.evaluate import context, numbers
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, ForAll, Iff, Prime, instances
from rodproof.derivations.proof import conditions, curves, sampling
from rodproof.derivations.proof.conditions import Ensures, OrientationChain, SameCondition
from rodproof.derivations.proof.implications import Implication, difference
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.proof.prover import Identity, claims
from rodproof.derivations.proof.rules import EllipsoidBound, Formalised
from rodproof.derivations.proof.vectors import REJECTED, VectorIdentity, Vectors, symbols_of
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import STRAINS, chiral_gap, v1, v2, v3
from rodproof.derivations.theory import kinematics as motion
from rodproof.derivations.theory import orientation
from rodproof.derivations.theory.constitutive import sharp_bound, stiffness_at_rest
from rodproof.derivations.theory.orientation import a, x1, x2

det = sp.Symbol("det_grad_chi", real=True)
s, L = sp.Symbol("s", real=True), sp.Symbol("L", positive=True)
chi_vector, r_vector = sp.symbols("bold_chi bold_r", real=True)

_ERRORS = (IllTyped, OutOfReach, ValueError, ZeroDivisionError)

# -- regions -----------------------------------------------------------------------------------

#: A place at distance rho in every direction (tan of half the angle; (-rho, 0) by continuity).
_rho, _half = sp.Symbol("rho", positive=True), sp.Symbol("half", real=True)
_POLAR = {
    x1: _rho * (1 - _half**2) / (1 + _half**2),
    x2: 2 * _rho * _half / (1 + _half**2),
}


def _is_disc(claim: sp.Basic) -> bool:
    """x1^2 + x2^2 <= a^2 in polar coordinates: a positive multiple of a - rho is not negative."""
    if not isinstance(claim, Chain) or len(claim.relations) != 1:
        return False
    if claim.relations[0] not in ("<=", ">="):
        return False
    try:
        inside = difference(claim).subs(_POLAR, simultaneous=True)
        return Field().sign(inside / (a - _rho)) == 1
    except _ERRORS:
        return False


def _is_body(printed: sp.Basic) -> bool:
    """0 <= s <= L and a point of the disc."""
    parts = list(claims(printed))
    discs = [part for part in parts if _is_disc(part)]
    others = [part for part in parts if part not in discs]
    if len(discs) != 1 or len(others) != 1 or not isinstance(others[0], Chain):
        return False
    if set(others[0].relations) != {"<="} or len(others[0].sides) != 3:
        return False
    low, middle, high = others[0].sides
    return bool((middle - low) * (high - middle) == s * (L - s) and low == 0)


DISC = Formalised(_is_disc, "closed disc of radius a, by a positive ratio in polar coordinates")
BODY = Formalised(_is_body, "closed cylinder over the disc, 0 <= s <= L")

# -- the deformation ---------------------------------------------------------------------------

_PLACE = (*symbols_of("r"), x1, x2)
_CHI = Vectors({**kinematics.VECTORS.table, chi_vector: symbols_of("chi"),
                r_vector: symbols_of("r")})  # fmt: skip


def _placed() -> dict[sp.Symbol, sp.Expr]:
    """A section is moved as a rigid body: the place (x1, x2, 0) turned by R, carried to r."""
    turned = motion.rotation() * sp.Matrix([x1, x2, 0])
    moved = [c + e for c, e in zip(symbols_of("r"), turned, strict=True)]
    return dict(zip(symbols_of("chi"), moved, strict=True))


def _sample_placed(seed: int) -> Point:
    rng = random.Random(f"places {seed}")
    return {**kinematics.FRAMES.sample(seed),
            **{c: sp.Rational(rng.randint(-40, 40), 17) for c in _PLACE}}  # fmt: skip


def _route_placed(point: Point, ctx: Any) -> Values:
    """q (0, x1, x2, 0) q^{-1} by Hamilton's product, basis vector by basis vector."""
    c = numbers(ctx, point)
    frame = curves.quaternion_frame([c[q] for q in motion.quaternion])
    moved = curves.plus([c[e] for e in symbols_of("r")], curves.times(c[x1], frame[0]),
                        curves.times(c[x2], frame[1]))  # fmt: skip
    found: dict[sp.Basic, Any] = dict(zip(symbols_of("chi"), moved, strict=True))
    return found | dict(kinematics.FRAMES.route(point, ctx))  # type: ignore[misc]


DEFORMATION = VectorIdentity(
    Meaning(
        name="all frames and places", free=(*kinematics.FRAMES.free, *_PLACE),
        components={**kinematics.FRAMES.components, **_placed()},
        positive=kinematics.FRAMES.positive, sample=_sample_placed,
        simple=lambda: (_sample_placed(0),),
        route=_route_placed, route_name="basis vectors turned by a numerical quaternion product",
    ),
    _CHI,
)  # fmt: skip

# -- its determinant ---------------------------------------------------------------------------


def _sample_strained(seed: int) -> Point:
    return {**sampling.with_strains(seed), x1: sp.Rational(3 - 2 * seed, 7),
            x2: sp.Rational(2 + seed, 5), a: sp.Rational(9 + seed, 4)}  # fmt: skip


def measured_determinant(point: Point, ctx: Any) -> Values:
    """det grad chi of a uniformly strained rod, by numerical derivatives of its deformation."""
    c = numbers(ctx, point)
    rod = curves.uniform_rod(ctx, [c[e] for e in STRAINS[:3]], [c[e] for e in STRAINS[3:]])

    def chi(y1: Any, y2: Any, at: Any) -> curves.Vector:
        r, frame = rod(at)
        return curves.plus(r, curves.times(y1, frame[0]), curves.times(y2, frame[1]))

    here = (c[x1], c[x2], ctx.mpf(1) / 3)

    def along(k: int) -> curves.Vector:
        return curves.rate(ctx, lambda e: chi(*(y + e * (i == k) for i, y in enumerate(here))), 0)

    return {det: ctx.det(ctx.matrix([along(k) for k in range(3)]))}


STRAINED = Meaning(
    name="all strains and places in the section", free=(*STRAINS, x1, x2, a),
    components={det: orientation.determinant()}, sample=_sample_strained,
    simple=lambda: tuple({**p, x1: sp.Integer(1), x2: sp.Integer(2), a: sp.Integer(1)}
                         for p in sampling.simple_strains()),
    route=measured_determinant, route_name="numerical derivatives of the deformation",
)  # fmt: skip
DETERMINANT = Identity(STRAINED)


@cache
def _over_all_frames() -> bool:
    """The determinant in strains is (d_1 x d_2) . d chi/ds for every frame, exactly."""
    (d1, d2, _), (e1, e2, _) = (
        [sp.Matrix(x) for x in part] for part in (motion.directors(), motion.director_rates())
    )
    moving = sp.Matrix(symbols_of("r_rate")) + x1 * e1 + x2 * e2
    field = Field(kinematics.FRAMES.positive)
    in_strains = kinematics.FRAMES.interpret(orientation.determinant())
    return field.equal(d1.cross(d2).dot(moving), in_strains)


def _is_orientation(claim: sp.Basic) -> bool:
    """For all places of the closed disc a positive multiple of the determinant is positive."""
    if not isinstance(claim, ForAll) or not _is_disc(claim.args[0]):
        return False
    if not isinstance(claim.args[1], Chain) or claim.args[1].relations not in ((">",), ("<",)):
        return False
    try:
        ratio = difference(claim.args[1]) / det
        return Field().sign(ratio) == 1 and _over_all_frames()
    except _ERRORS:
        return False


ORIENTATION = Formalised(_is_orientation, "the triple product of the columns over all frames")


@dataclass(frozen=True, eq=False)
class _PositiveOnDisc:
    """`Iff(ForAll(disc, det > 0), condition on the strains)`, both ways, on the closed disc.

    Sufficient: a^2 |c|^2 - (c.x)^2 = (a^2 - |x|^2)|c|^2 + (c1 x2 - c2 x1)^2, so the determinant
    is nowhere below its least value. Necessary: that value is taken at a point of the disc. The
    case c = 0, where the determinant is constant, is looked at on its own.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Iff) or not _is_orientation(printed.args[0]):
            return REJECTED
        (claim,) = instances(printed.args[1])
        if not isinstance(claim, Chain) or claim.relations not in ((">",), ("<",)):
            return REJECTED
        stated, least = difference(claim), orientation.least_on_disc(orientation.determinant())
        try:
            if not all(check(stated, least) for check in (_least_value, _bounds, _unbent)):
                return Decision(False, False, "not the least value on the disc")
        except _ERRORS:
            return REJECTED
        return Decision(True, True, "least value on the disc, taken at a point of it (Lagrange)")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        """The determinant at the least place, from the numerically differentiated deformation."""
        least = orientation.least_on_disc(orientation.determinant())
        worst = 0.0
        for seed in range(2):
            ctx = context(65)
            point = dict(STRAINED.sample(seed))
            evaluate = STRAINED.evaluator(ctx, point)
            place = {x: evaluate(e) for x, e in zip((x1, x2), least.place, strict=True)}
            c = {**numbers(ctx, point), **place}
            near = {k: sp.Rational(*map(int, _ratio(ctx, value))) for k, value in c.items()}
            found = measured_determinant(near, ctx)[det]
            (claim,) = instances(printed.args[1])
            worst = max(worst, float(abs(found - evaluate(difference(claim)))))
        return Confirmation(worst, 2, 50, "deformation differentiated at the least place")


def _ratio(ctx: Any, value: Any) -> tuple[int, int]:
    scale = 10**60
    return int(ctx.nint(value * scale)), scale


def _least_value(stated: sp.Expr, least: orientation.Least) -> bool:
    place = dict(zip((x1, x2), least.place, strict=True))
    at_place = orientation.determinant().subs(place, simultaneous=True)
    return Field().equal(stated, at_place) and Field().equal(
        least.place[0] ** 2 + least.place[1] ** 2, a**2
    )


def _bounds(stated: sp.Expr, least: orientation.Least) -> bool:
    """The identity of Lagrange for the gradient and the place."""
    c1, c2 = least.gradient
    size, product = c1**2 + c2**2, c1 * x1 + c2 * x2
    squares = (a**2 - x1**2 - x2**2) * size + (c1 * x2 - c2 * x1) ** 2
    return Field().equal(a**2 * size - product**2, squares)


def _unbent(stated: sp.Expr, least: orientation.Least) -> bool:
    flat = dict.fromkeys(sp.Tuple(*least.gradient).free_symbols, sp.Integer(0))
    return bool(sp.expand(stated.subs(flat) - orientation.determinant().subs(flat)) == 0)


ON_THE_DISC = _PositiveOnDisc()

# -- the center line ---------------------------------------------------------------------------

_UNIT = tuple(tuple(sp.Integer(i == k) for i in range(3)) for k in range(3))
_IN_DIRECTORS = Vectors(
    {sp.Symbol(f"d{k + 1}", real=True): _UNIT[k] for k in range(3)}
    | {Prime(r_vector): (v1, v2, v3)}
)
_TANGENTS = tuple(
    dict(zip((v1, v2, v3), map(sp.Integer, values), strict=True))
    for values in ((0, 0, 1), (0, 0, -1), (2, 0, 1), (1, 0, -1), (0, 3, -1), (-1, 2, 3), (1, 1, 0))
)
STRETCHED = Implication(
    Meaning("all r' seen from the directors", (v1, v2, v3), lambda seed: _TANGENTS[seed],
            lambda: _TANGENTS),
    _TANGENTS, vectors=_IN_DIRECTORS,
)  # fmt: skip

# -- conditions on the constants ---------------------------------------------------------------

EQUIVALENT = SameCondition()
ENSURES = Ensures()


def _separate_bounds() -> sp.Expr:
    """inf v_3 - a sup |flexure| over Q < 1, each extremum by itself."""
    lowest = orientation.infimum(v3)
    return (
        lowest.center
        - lowest.bound
        - a * sharp_bound(*(sp.diff(orientation.flexure_in_direction(), e) for e in STRAINS)).bound
    )


@cache
def radius_condition() -> SameCondition:
    """The condition on the radius that bounds flexure and dilatation separately."""
    return SameCondition(_separate_bounds())


def _shifted(point: tuple[sp.Expr, ...]) -> tuple[sp.Expr, ...]:
    return (*point[:5], 1 + point[5])


@cache
def chain() -> OrientationChain:
    """The chain of inequalities under the condition on the radius."""
    return OrientationChain(
        EllipsoidBound(
            strain=STRAINS, rest=(0, 0, 0, 0, 0, 1), stiffness=stiffness_at_rest(),
            extremals=(_shifted(all_around(0)),), positive=(chiral_gap,),
            sample=conditions._sample_with_radius,
        )
    )  # fmt: skip
