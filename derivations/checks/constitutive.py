"""The particular checks of Section 3.1, built from the general rules and the derivation."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import FUNCTIONS, NO_LOAD, ON_LOADS, ON_STRAINS, REST
from rodproof.derivations.checks.routes import values as routes
from rodproof.derivations.exact.evaluate import numbers
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Every, W, Wstar, m, n, u, v
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import Meaning, Point, Values, of_matrix
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.rules import (
    DefiniteForms,
    EllipsoidBound,
    EquivalentSign,
    Formalised,
    Potential,
    Ranges,
    Supremum,
)
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import (
    CONSTANTS,
    LOADS,
    STRAINS,
    chiral_gap,
    gamma,
    p,
)
from rodproof.derivations.theory import constitutive as theory
from rodproof.derivations.theory import dimensions
from rodproof.derivations.theory.frames import dot, euler_frame

x, y = theory.x, theory.y
a, b, Y = sp.symbols("a b Y", positive=True)
s = sp.Function("s")
dim = sp.Function("dim")

# -- columns: the components of a vector in an orthonormal frame ------------------------------

_FRAME = euler_frame()


def _columns() -> dict[sp.Symbol, sp.Expr]:
    """The k-th entry is the k-th director times the vector."""
    found = {}
    for name, symbols in zip("uvmn", (STRAINS[:3], STRAINS[3:], LOADS[:3], LOADS[3:]), strict=True):
        vector = sum((c * d for c, d in zip(symbols, _FRAME, strict=True)), sp.zeros(3, 1))
        for k, director in enumerate(_FRAME, 1):
            found[sp.Symbol(f"column_{name}{k}", real=True)] = dot(director, vector)
    return found


def _sample_columns(seed: int) -> Point:
    angles = sorted(set().union(*(d.free_symbols for d in _FRAME)), key=str)
    point = {**sampling.with_loads(seed), **sampling.with_strains(seed)}
    return {**point, **{angle: sp.Rational(3 + 2 * k + seed, 7) for k, angle in enumerate(angles)}}


COLUMNS = Meaning(
    name="components in a frame",
    free=(*STRAINS, *LOADS),
    components=_columns(),
    sample=_sample_columns,
    simple=sampling.simple_loads,
    route=routes.columns,
    route_name="components solved for in a frame turned numerically",
)

# -- the three-dimensional relation -----------------------------------------------------------

T = sp.IndexedBase("T", real=True)
e = sp.IndexedBase("e", real=True)
B_inv = sp.IndexedBase("Binv", real=True)
norm_T = sp.Symbol("norm_T", positive=True)
_STRESS = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"T{min(i, j) + 1}{max(i, j) + 1}", real=True))
_F = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"F{i + 1}{j + 1}", real=True))


def _symmetric_stress() -> dict[sp.Symbol, sp.Expr]:
    """The rod's scalar law with gamma = 1/a and y = b|T|; T is symmetric."""
    norm = sp.sqrt(sum(entry**2 for entry in _STRESS))
    factor = (theory.radial_law().strain / y).subs({gamma: 1 / a, y: b * norm})
    lower = {k: value for k, value in of_matrix("T", _STRESS).items() if k != value}
    return {norm_T: norm, **lower, **of_matrix("e", factor * _STRESS)}


def _almansi() -> dict[sp.Symbol, sp.Expr]:
    """dx . e dx = (|dx|^2 - |dX|^2)/2 with dX = F^{-1} dx, and B = F F^T inverted on its own."""
    inverse = _F.adjugate() / _F.det()
    left = _F * _F.T
    strain = (sp.eye(3) - inverse.T * inverse) / 2
    return {**of_matrix("e", strain), **of_matrix("Binv", left.adjugate() / left.det())}


def _sample_tensor(seed: int) -> Point:
    symbols = [*_STRESS[:], *_F[:], a, b]
    values = {c: sp.Rational((17 * k + 29 * seed) % 41 + 3, 13) for k, c in enumerate(symbols)}
    return {**sampling.constants(seed), **values}


ON_STRESSES = Meaning(
    name="all symmetric stresses",
    free=tuple(_STRESS.free_symbols),
    components=_symmetric_stress(),
    sample=_sample_tensor,
    simple=lambda: (_sample_tensor(0),),
    route=routes.stress,
    route_name="norm from eigenvalues, strain radius by integrating its slope",
)
ON_DEFORMATIONS = Meaning(
    name="all invertible deformation gradients",
    free=tuple(_F.free_symbols),
    components=_almansi(),
    sample=_sample_tensor,
    simple=lambda: (_sample_tensor(0),),
    route=routes.deformation,
    route_name="lengths of short lines, with F and F F^T solved numerically",
)
TB_RANGES = Ranges((a, b, p))

# -- constants and forms ----------------------------------------------------------------------

CONSTANT_RANGES = Ranges(tuple(c for c in CONSTANTS if c.is_positive))


def constants_of_all_signs() -> list[dict[sp.Symbol, sp.Expr]]:
    """Small constants in their ranges, whether or not the coupling hypothesis holds."""
    half = sp.Rational(1, 2)
    values = ((2, 1, 1, 1, 1, 3 * half), (1, 1, 1, 1, 2, 3 * half), (1, 1, 1, 1, 1, half),
              (3, 2, 1, 1, 1, 1), (1, 3, 1, half, 2, 1), (1, 1, 1, 1, 1, 2),
              (1, 1, 1, 1, 3, -2), (half, 2, 3, 1, 2, -3), (1, 2, 1, 1, 2, 3),
              (1, 2, 1, 1, half, 3 * half), (1, half, 1, 1, 3, 5 * half / 2),
              (1, half, 1, 1, half, half / 3), (1, 1, 1, 1, 2, 5 * half))  # fmt: skip
    return [
        dict(zip(CONSTANTS, (*map(sp.sympify, row), sp.Integer(2)), strict=True)) for row in values
    ]


def _definiteness(point: dict[sp.Symbol, sp.Expr]) -> str:
    block = theory.stiffness_at_rest().extract([2, 5], [2, 5]).subs(point)
    kind = "positive definite" if block.det() > 0 else "not positive definite"
    return f"[beta^2, iota; iota, eta^2] has determinant {block.det()}: Q is {kind}"


COUPLING = EquivalentSign(chiral_gap, constants_of_all_signs, _definiteness)
FORMS = DefiniteForms(
    forms=(
        (theory.quadratic_form(), STRAINS, (0, 0, 0, 0, 0, 1)),
        (theory.dual_form(), LOADS, (0, 0, 0, 0, 0, 0)),
    ),
    candidates=constants_of_all_signs,
)


def _greek(printed: sp.Basic) -> bool:
    K = theory.stiffness_at_rest()
    plain = [k for k in (1, 2, 3) if K[k - 1, k - 1] == K[0, 0] and K[k + 2, k + 2] == K[3, 3]]
    return bool(printed == sp.Tuple(*plain))


GREEK_RANGE = Formalised(_greek, "the indices with the same bending and shearing stiffness")

# -- limits -----------------------------------------------------------------------------------

_POWER_OF_LOAD = theory.dual_form() ** (p / 2)
_STRAIN_RADIUS_SQUARED = theory.quadratic_form().xreplace(dict(ON_LOADS.components))
_LIMIT_FRACTION = _POWER_OF_LOAD / (gamma**p + _POWER_OF_LOAD)

STRAIN_LIMIT = Supremum(
    meaning=ON_LOADS,
    value=_STRAIN_RADIUS_SQUARED,
    power=p / 2,
    fraction=_LIMIT_FRACTION,
    supremum=sp.Integer(1),
)


@dataclass(frozen=True, eq=False)
class _Reached:
    """Q < 1 is the whole image: the supremum, and strains(loads(eps)) = eps for each Q < 1."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        found = STRAIN_LIMIT.decide(printed, explain=explain)
        if not found.holds:
            return found
        field = Field(ON_STRAINS.positive)
        loads = dict(ON_STRAINS.components)
        reached = all(
            field.equal(strain.xreplace(loads), wanted)
            for strain, wanted in zip(theory.strains(), theory.STRAIN_FROM_REST, strict=True)
        )
        if not reached:
            return Decision(None, False, "surjectivity not proved")
        return Decision(True, True, f"{found.method}; strains(loads(eps)) = eps on all of it")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return STRAIN_LIMIT.confirm(printed)


INVERSE_DOMAIN = _Reached()


def _bound(*extremals: tuple[sp.Expr, ...]) -> EllipsoidBound:
    shifted = tuple((*point[:5], point[5] + 1) for point in extremals)
    return EllipsoidBound(
        strain=STRAINS,
        rest=(0, 0, 0, 0, 0, 1),
        stiffness=theory.stiffness_at_rest(),
        extremals=shifted,
        positive=(chiral_gap,),
        sample=sampling.with_strains,
    )


_ANGLE = sp.Symbol("chi", real=True)


def all_around(first: int) -> tuple[sp.Expr, ...]:
    """The strains from rest at which two components are furthest out, in every direction."""
    functional = [sp.Integer(0)] * 6
    functional[first], functional[first + 1] = sp.cos(_ANGLE), sp.sin(_ANGLE)
    return theory.sharp_bound(*functional).extremal


def _both_ways(index: int) -> tuple[tuple[sp.Expr, ...], ...]:
    unit = [sp.Integer(1 if k == index else 0) for k in range(6)]
    extremal = theory.sharp_bound(*unit).extremal
    return extremal, tuple(-c for c in extremal)


def flexure_bound() -> EllipsoidBound:
    """(u1^2 + u2^2)^{1/2}, extremal in every direction of bending."""
    return _bound(all_around(0))


def shear_bound() -> EllipsoidBound:
    """(v1^2 + v2^2)^{1/2}, extremal in every direction of shear."""
    return _bound(all_around(3))


def twist_bound() -> EllipsoidBound:
    """|u3|, extremal for both senses of twist."""
    return _bound(*_both_ways(2))


def dilatation_bound() -> EllipsoidBound:
    """|v3 - 1|, extremal in tension and compression."""
    return _bound(*_both_ways(5))


# -- energies and the inverse -----------------------------------------------------------------

#: The structural law against the gradient of W*.
LAW_ON_LOADS = Meaning(
    name="all loads, strains by the structural law",
    free=ON_LOADS.free,
    components=dict(
        zip(STRAINS, (*theory.law_of_strains()[:5], 1 + theory.law_of_strains()[5]), strict=True)
    ),
    functions=FUNCTIONS,
    positive=ON_LOADS.positive,
    edges=ON_LOADS.edges,
    sample=ON_LOADS.sample,
    simple=ON_LOADS.simple,
    route=ON_LOADS.route,
    route_name=ON_LOADS.route_name,
)

COMPLEMENTARY_POTENTIAL = Potential(
    ON_LOADS,
    Wstar(m, n),
    tuple(zip(LOADS, theory.law_of_strains(), strict=True)),
    tuple(NO_LOAD.items()),
)
STORED_POTENTIAL = Potential(
    ON_STRAINS, W(u, v), tuple(zip(STRAINS, theory.loads(), strict=True)), tuple(REST.items())
)


def _radius_route(point: Point, ctx: Any) -> Values:
    """x from y by integrating dx/dy = gamma^p (gamma^p + y^p)^{-1/p - 1} from rest."""
    c = numbers(ctx, point)
    G, power = c[gamma] ** c[p], c[p]
    slope = lambda r: G * (G + r**power) ** (-1 / power - 1)  # noqa: E731
    return {x: ctx.quad(slope, [0, c[y]])}


def sample_radius(seed: int) -> Point:
    """Generic constants and a generic load radius y."""
    return {**sampling.constants(seed), y: sp.Rational(5 + 4 * seed, 3)}


ON_RADII = Meaning(
    name="all load radii",
    free=(*CONSTANTS, y),
    components={x: theory.radial_law().strain},
    sample=sample_radius,
    positive=(chiral_gap,),
    simple=lambda: tuple(
        {**c, y: sp.Integer(k)} for c in sampling.simple_constants() for k in (1, 3)
    ),
    route=_radius_route,
    route_name="strain radius by integrating its slope in the load",
)


@dataclass(frozen=True, eq=False)
class _Inverse:
    """`y = g(x)` with g(x(y)) = y for all y and x(g(x)) = x for all 0 <= x < 1."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        found = Identity(ON_RADII).decide(printed, explain=explain)
        if not found.holds or not isinstance(printed, Chain) or printed.sides[0] != y:
            return found if not found.holds else Decision(False, False, "rejected")
        back = theory.radial_law().strain.subs(y, printed.sides[1])
        if Field((chiral_gap, 1 - x**p)).equal(back, x):
            return Decision(True, True, "both compositions are the identity, exactly")
        return Decision(None, False, "one composition only")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(ON_RADII).confirm(printed)


INVERSION = _Inverse()


def _saturates(printed: sp.Basic) -> bool:
    """Two different loads at or beyond Y, so the same strain twice."""
    if not isinstance(printed, Chain) or printed.relations != ("=",):
        return False
    if not all(side.func == s for side in printed.sides):
        return False
    first, second = (side.args[0] for side in printed.sides)
    beyond = [Field().sign(load - Y) in (0, 1) for load in (first, second)]
    return all(beyond) and Field().sign(second - first) == 1


SATURATION = Formalised(_saturates, "two different loads with the same strain, by construction")

# -- dimensions and moduli --------------------------------------------------------------------


def _dimensions_agree(printed: sp.Basic) -> bool:
    if not isinstance(printed, Every) or len(printed.args) != 6:
        return False
    named = set()
    for claim in printed.args:
        if not isinstance(claim, Chain) or claim.relations != ("=",):
            return False
        constant, unit = claim.sides
        if constant.func != dim or constant.args[0] not in CONSTANTS or unit.is_Add:
            return False
        named.add(constant.args[0])
        if any(f.is_number and f != 1 for f in sp.Mul.make_args(unit)):
            return False
        if dimensions.of_constants()[constant.args[0]] != dimensions.dimension(unit):
            return False
    return len(named) == 6


def _independent_groups(printed: sp.Basic) -> bool:
    """Buckingham: nine quantities less two units, and the seven groups are independent."""
    quantities = (*CONSTANTS, dimensions.length, dimensions.force)
    if len(printed.args) != len(quantities) - 2:
        return False
    rows = []
    for group in printed.args:
        powers = dict(f.as_base_exp() for f in sp.Mul.make_args(group) if not f.is_number)
        if set(powers) - set(quantities) or dimensions.dimension(group) != (0, 0):
            return False
        rows.append([powers.get(q, 0) for q in quantities])
    return bool(sp.Matrix(rows).rank() == len(rows))


def _moduli(printed: sp.Basic) -> bool:
    """Entries of D^2 W at rest that together involve every constant but p."""
    at_rest = sp.Matrix(theory.loads_at_leading_order()).jacobian(STRAINS)
    if len(set(printed.args)) != 5 or not all(entry in set(at_rest) for entry in printed.args):
        return False
    jacobian = sp.Matrix(printed.args).jacobian(CONSTANTS)
    moved = [any(entry != 0 for entry in jacobian[:, k]) for k in range(len(CONSTANTS))]
    return moved == [c != p for c in CONSTANTS] and jacobian.rank() == 5


DIMENSIONS = Formalised(_dimensions_agree, "dimensions solved from the homogeneity of Q and Q*")
GROUPS = Formalised(_independent_groups, "rank of the exponent matrix (Buckingham)")
MODULI = Formalised(_moduli, "Jacobian of the moduli: every constant but p moves one, rank 5 of 6")
