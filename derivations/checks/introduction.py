"""The checks of the claims that the introduction makes in words."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import sympy as sp

from rodproof.derivations.checks.domains import FUNCTIONS, ON_LOADS, ON_STRAINS, NumericLaw
from rodproof.derivations.checks.symmetry import HasSymmetries
from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain, Every, Implies, Partial, PositiveDefinite
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.conditions import Ensures
from rodproof.derivations.proof.implications import Implication
from rodproof.derivations.proof.meaning import Meaning, Point, Values
from rodproof.derivations.proof.prover import Identity, claims, counterexample
from rodproof.derivations.proof.rules import Formalised
from rodproof.derivations.proof.vectors import REJECTED
from rodproof.derivations.records import Check, Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, chiral_gap, gamma, p
from rodproof.derivations.theory import constitutive, loading
from rodproof.derivations.theory.frames import theta
from rodproof.derivations.theory.loading import couple, phase, tau
from rodproof.derivations.theory.symmetry import ROTATION

# -- growth with the loads ---------------------------------------------------------------------

#: Strains from rest under the loads, under tau times the loads; Q^(1/2) of the first.
e, g = (sp.IndexedBase(name, real=True) for name in "eg")
radius = sp.Symbol("radius", positive=True)


def _named(name: str, values: tuple[sp.Expr, ...]) -> dict[sp.Symbol, sp.Expr]:
    return {sp.Symbol(f"{name}{i}", real=True): value for i, value in enumerate(values, 1)}


def _on_ray() -> dict[sp.Symbol, sp.Expr]:
    size = constitutive.radial_law().strain.subs(constitutive.y, sp.sqrt(constitutive.dual_form()))
    return {
        **ON_LOADS.components,
        **_named("e", constitutive.law_of_strains()),
        **_named("g", loading.strains_at_multiple()),
        radius: size,
    }


def _sample_ray(seed: int) -> Point:
    """The first point has bending couples of one sign, the others mixed ones."""
    point = {**sampling.with_loads(seed), tau: sp.Rational(13 + 5 * seed, 9)}
    return point if seed else {**point, **{load: abs(point[load]) for load in LOADS[:2]}}


def _two_couples() -> tuple[Point, ...]:
    """p = 1, all else 1: under m = (3, 4, 0) the strains are rational."""
    constants = dict(zip(CONSTANTS, map(sp.Integer, (1, 1, 1, 1, 1, 0, 1)), strict=True))
    loads = dict(zip(LOADS, map(sp.Integer, (3, 4, 0, 0, 0, 0)), strict=True))
    return ({**constants, **loads, tau: sp.Integer(1)},)


def _route_ray(point: Point, ctx: Any) -> Values:
    """The radius by integrating its slope in the load radius, the direction by a linear solve."""
    law = NumericLaw(point, ctx)
    load = [law.c[s] for s in LOADS]
    G, power, size = law.c[gamma] ** law.c[p], law.c[p], ctx.sqrt(law.dual(load))
    reached = ctx.quad(lambda r: G * (G + r**power) ** (-1 / power - 1), [0, size / 4, size])
    strain = [reached / size * c for c in ctx.lu_solve(law.K, ctx.matrix(load))]
    return {**dict(zip(_named("e", LOADS), strain, strict=True)), radius: reached}


_RAY = Meaning(
    name="all loads and their multiples", free=(*CONSTANTS, *LOADS, tau), components=_on_ray(),
    functions=FUNCTIONS, positive=ON_LOADS.positive, sample=_sample_ray, simple=_two_couples,
    route=_route_ray, route_name="radius by quadrature of its slope, K inverted numerically",
)  # fmt: skip


@cache
def _growth_factor() -> tuple[Field, sp.Expr]:
    """The strain radius under tau times the load, over that under the load."""
    law, load = constitutive.radial_law().strain, sp.sqrt(constitutive.dual_form())
    return Field(_RAY.positive), law.subs(constitutive.y, tau * load) / law.subs(
        constitutive.y, load
    )


@dataclass(frozen=True, eq=False)
class _Growth:
    """Every strain is the same increasing factor times its value, and has the stated limit.

    A claim `Partial(x, tau) > 0` is accepted if x is that factor, tau f(tau y)/f(y), exactly.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Every):
            return self._one_load_at_a_time(printed)
        parts = list(claims(printed))
        growing = [c for c in parts if isinstance(c, Chain) and c.relations == (">",)]
        limits = [c for c in parts if c not in growing]
        if len(growing) != 6 or len(limits) != 6:
            return REJECTED
        field, factor = _growth_factor()
        if field.sign(sp.diff(factor, tau)) != 1:
            return REJECTED
        for claim in growing:
            slope, zero = claim.sides
            if not isinstance(slope, Partial) or slope.args[1] != tau or zero != 0:
                return REJECTED
            if not field.equal(_RAY.interpret(slope.args[0]), factor):
                return Decision(False, False, "not the factor by which the strains grow")
        found = Identity(_RAY).decide(Every(*limits), explain=explain)
        return replace(found, method="one increasing factor for all strains; exact limits")

    @staticmethod
    def _one_load_at_a_time(printed: sp.Basic) -> Decision:
        """Slopes of single strains in single loads: one of them is negative somewhere."""
        for claim in claims(printed):
            if not isinstance(claim, Chain):
                return REJECTED
            for link in claim.links():
                found = counterexample(link, _RAY)
                if found is not None:
                    return Decision(False, True, "counterexample", found)
        return Decision(None, False, "no counterexample found")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Identity(_RAY).confirm(printed)


RAY = _Growth()

# -- an isolated couple ------------------------------------------------------------------------

_COUPLES = tuple(
    {**c, **dict(zip(LOADS, map(sp.Integer, (*couple_, 0, 0, 0)), strict=True))}
    for c in (*sampling.simple_constants(), *(sampling.constants(k) for k in range(4)))
    for couple_ in ((0, 0, 1), (0, 0, -2), (1, -2, 3), (-2, 1, -1), (1, 1, -2), (-1, -1, 2))
)
ELONGATION = Implication(
    Meaning(
        name="all isolated couples", free=(*CONSTANTS, *LOADS[:3]),
        components={**dict(zip(STRAINS, loading.strains_of_couple(), strict=True)),
                    **loading.NO_FORCE},
        positive=(chiral_gap, constitutive.dual_form().xreplace(loading.NO_FORCE)),
        sample=lambda seed: _COUPLES[-1 - seed], simple=lambda: _COUPLES,
    ),
    _COUPLES, sharp=True,
)  # fmt: skip

# -- properties valid for all loads ------------------------------------------------------------

hessian = sp.Symbol("D2W", real=True)


@dataclass(frozen=True, eq=False)
class _Oriented:
    """v_3 > 0 for all strains with Q < 1 under a condition; without one, a load that inverts it."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if isinstance(printed, Implies):
            return Ensures().decide(printed, explain=explain)
        values = (1, 1, 1, 1, sp.Rational(1, 2), 0, 1)
        at = dict(zip(CONSTANTS, map(sp.sympify, values), strict=True))
        at |= dict.fromkeys(LOADS, sp.Integer(0)) | {LOADS[5]: sp.Integer(-1)}
        inverted = 1 + constitutive.law_of_strains()[5].subs(at)
        if not isinstance(printed, Chain) or inverted > 0:
            return REJECTED
        where = tuple((str(s), str(x)) for s, x in at.items())
        found = Counterexample(where, f"v3 = {inverted}", "v3 > 0")
        return Decision(False, True, "a load that inverts it", found)

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return Ensures().confirm(printed)


@cache
def _stiffness_is_positive() -> bool:
    """(1 - X)^{1/p + 1} D^2 W/gamma = (1 - X) K + (X/Q)(K eps)(K eps)^T with X = Q^{p/2} < 1.

    K is positive definite, so the sum is; at rest, where X = 0, D^2 W is gamma K.
    """
    X, Q = constitutive.quadratic_form() ** (p / 2), constitutive.quadratic_form()
    K, square = loading.tangent_stiffness_split()
    field, D2W = Field(ON_STRAINS.positive), constitutive.stiffness()
    factor = (1 - X) ** (1 / p + 1) / gamma
    split = all(
        field.equal(factor * D2W[i, j], (1 - X) * K[i, j] + X / Q * square[i, j])
        for i in range(6)
        for j in range(i, 6)
    )
    minors = (K[:k, :k].det(method="berkowitz") for k in range(1, 7))
    return split and all(field.sign(minor) == 1 for minor in minors) and field.sign(1 - X) == 1


def _monotone(printed: sp.Basic) -> bool:
    if not isinstance(printed, PositiveDefinite) or printed.args[0] != hessian:
        return False
    return _stiffness_is_positive()


@dataclass(frozen=True, eq=False)
class Together:
    """A claim of several parts, each with its own check."""

    checks: tuple[Check, ...]

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Every) or len(printed.args) != len(self.checks):
            return REJECTED
        found = [
            check.decide(part, explain=explain)
            for check, part in zip(self.checks, printed.args, strict=True)
        ]
        failed = [decision for decision in found if not (decision.holds and decision.exact)]
        return failed[0] if failed else Decision(True, True, "; ".join(d.method for d in found))

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        pairs = zip(self.checks, printed.args, strict=True)
        found = [c for c in (check.confirm(part) for check, part in pairs) if c is not None]
        return max(found, key=lambda c: c.residual) if found else None


PROPERTIES = Together(
    (
        _Oriented(),
        HasSymmetries((ROTATION,)),
        Formalised(_monotone, "D^2 W is a sum of positive matrices, exactly"),
    )
)

# -- the family of helices ---------------------------------------------------------------------


@cache
def _rank(*parameters: sp.Symbol) -> int:
    """The rank of (curvature, torsion, stretch) in the parameters, at generic constants.

    A nonzero minor at one rational point is a proof that the rank is at least that generically;
    it is at most the number of parameters that occur.
    """
    point = {**sampling.simple_constants()[1], couple: sp.Integer(1)}
    half = sp.Rational(1, 3)
    turned = {sp.cos(theta): (1 - half**2) / (1 + half**2),
              sp.sin(theta): 2 * half / (1 + half**2)}  # fmt: skip
    constants = {c: point[c] for c in CONSTANTS}
    state = sp.Matrix([entry.subs(constants) for entry in loading.helix()])
    jacobian = state.jacobian(parameters).subs(turned).subs(point)
    return int(jacobian.applyfunc(sp.radsimp).rank())


def _two_parameters(printed: sp.Basic) -> bool:
    """The parameters are independent, and no constant of the state but the phase is left out.

    The phase turns the directors about d_3: it leaves v_3 and the flexure as they are.
    """
    if not isinstance(printed, sp.Tuple) or not all(x.is_Symbol for x in printed):
        return False
    at = loading.strains_of_spinning_couple()
    field = Field((chiral_gap,))
    invariant = (at[0] ** 2 + at[1] ** 2, at[2], at[5])
    unturned = all(field.is_zero(sp.diff(entry, phase)) for entry in invariant)
    family = set().union(*(entry.free_symbols for entry in loading.helix())) - set(CONSTANTS)
    return unturned and set(printed) == family and _rank(*printed) == len(printed)


FAMILY = Formalised(_two_parameters, "rank of curvature, torsion and stretch in the parameters")
