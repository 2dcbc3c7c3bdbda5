"""The checks of Section 5.2: tangent stiffness, moduli with units, what moduli determine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import sympy as sp

from rodproof.derivations.checks.constitutive import sample_radius
from rodproof.derivations.checks.domains import ON_LOADS, NumericLaw
from rodproof.derivations.checks.routes import values as measured
from rodproof.derivations.exact.field import Field, OutOfReach
from rodproof.derivations.notation import Chain, Iff, LimitOf, instances
from rodproof.derivations.proof import sampling
from rodproof.derivations.proof.meaning import IllTyped, Meaning, Point, Values
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.records import Confirmation, Counterexample, Decision
from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, chiral_gap, gamma, zeta
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory import dna as theory
from rodproof.derivations.theory.constitutive import y
from rodproof.derivations.theory.dna import nm, pN, tension

_REJECTED = Decision(False, False, "rejected")
stiffness = sp.Symbol("k", positive=True)  # dy/dx


#: The slope of the load radius by the strain radius.
SLOPES = Meaning(
    name="loads of any size along a ray", free=(*CONSTANTS, y), sample=sample_radius,
    simple=lambda: tuple({**c, y: sp.Integer(1)} for c in sampling.simple_constants()),
    components={stiffness: theory.tangent_stiffness()},
    route=measured.slopes(stiffness),
    route_name="load radius by root search, differenced; 40 digits from rest and from the limit",
)  # fmt: skip


# -- dsDNA --------------------------------------------------------------------------------------


def _sample(seed: int) -> Point:
    """Constants of dsDNA with gamma and p generic, in units that are not 1."""
    return {**sampling.constants(seed), gamma: sp.Rational(311 + seed, 7), tension:
            sp.Rational(23 + seed, 3), pN: sp.Rational(5, 3), nm: sp.Rational(7, 4)}  # fmt: skip


def _simple() -> tuple[Point, ...]:
    return tuple({**c, tension: sp.Integer(1), pN: sp.Integer(1), nm: sp.Integer(1)}
                 for c in sampling.simple_constants())  # fmt: skip


def _tension_route(point: Point, ctx: Any) -> Values:
    """Strains by the numerical gradient of W*; their slopes at N = 0 by solving K numerically."""
    exact = {x: sp.sympify(e).xreplace(dict(point)) for x, e in theory.constants().items()}
    numbers = {x: sp.Rational(str(sp.N(e, ctx.dps + 10))) for x, e in exact.items()}
    law = NumericLaw({**point, **numbers}, ctx)
    found: dict[sp.Basic, Any] = {}
    size = law.c[tension]
    full = law.strains([ctx.mpf(0)] * 5 + [size])
    found |= dict(zip(STRAINS, (*full[:5], 1 + full[5]), strict=True))
    linear = ctx.lu_solve(law.K, ctx.matrix([0] * 5 + [1]))
    for strain, value in ((STRAINS[2], linear[2]), (STRAINS[5] - 1, linear[5])):
        found[LimitOf(strain / tension, tension, sp.Integer(0))] = value / law.c[gamma]
    return found


#: dsDNA under a tension N > 0, whatever gamma and p.
DSDNA = Meaning(
    name="dsDNA under tension", free=(gamma, tension, pN, nm, zeta), sample=_sample,
    simple=_simple, functions={}, route=_tension_route,
    components={
        **theory.constants(), **dict(zip(STRAINS, theory.under_tension(), strict=True)),
    },
    route_name="numerical gradient of W*, and gamma K solved numerically",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Datum:
    """`modulus = number * unit`: an entry of the stiffness at rest, of the right dimension, with
    the value that the measured length times k_B T (or the measured force) rounds to."""

    name: str

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        if not isinstance(printed, Chain) or printed.relations != ("=",):
            return _REJECTED
        left, right = printed.sides
        modulus = theory.DSDNA[self.name]
        try:
            same = Field().equal(left, theory.moduli_at_rest()[modulus.entry])
            agree = theory.dimension(left) == theory.dimension(right)
        except (OutOfReach, ValueError):
            return _REJECTED
        unit = right.xreplace({pN: sp.Integer(1), nm: sp.Integer(1)})
        if same and agree and unit == theory.number(modulus):
            method = "an entry of gamma K, its dimension, and the measured value rounded"
            return Decision(True, True, method)
        return _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class Determined:
    """The listed quantities are fixed by the four moduli, and together fix the moduli."""

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        quantities = tuple(printed.args)
        free = [q for q in quantities if not theory.determined(q)]
        if free:
            found = Counterexample(
                (("pN", "1"), ("nm", "1"), ("alpha^2", "37/200"), ("beta^2", "447/1000"),
                 ("gamma", "1000"), ("eta", "1"), ("iota", "-7/100"), ("p", "1")),
                "the four printed moduli",
                "the same moduli with gamma = 4000, alpha^2 = 37/800, beta^2 = 447/4000, "
                "eta = 1/2, iota = -7/400, p = 2",
            )  # fmt: skip
            return Decision(False, True, f"not determined: {', '.join(map(str, free))}", found)
        logs = theory.logarithmic_jacobian(quantities)
        if logs.rank() == len(quantities) == len(theory.DSDNA) and self._plain(quantities):
            return Decision(True, True, "rank of the logarithmic Jacobian")
        return _REJECTED

    @staticmethod
    def _plain(quantities: tuple[sp.Expr, ...]) -> bool:
        """The moduli themselves, not other functions of them."""
        entries = {theory.moduli_at_rest()[m.entry] for m in theory.DSDNA.values()}
        return set(quantities) == entries

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@dataclass(frozen=True, eq=False)
class SameSign:
    """a > 0 iff b > 0, as a/b > 0 on the domain; sharp both ways."""

    meaning: Meaning

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        (claim,) = instances(printed)
        if not isinstance(claim, Iff) or not all(
            isinstance(s, Chain) and s.relations == (">",) for s in claim.args
        ):
            return _REJECTED
        try:
            first, second = (self.meaning.interpret(s.sides[0] - s.sides[1]) for s in claim.args)
            sign = Field(self.meaning.positive).sign(sp.expand(first) / sp.expand(second))
        except (OutOfReach, IllTyped):
            return _REJECTED
        return Decision(True, True, "positive ratio") if sign == 1 else _REJECTED

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


_NO_SHEAR = {LOADS[3]: sp.Integer(0), LOADS[4]: sp.Integer(0)}

#: All loads, with a couple or a tension among them, as the rod grows stiff in shear.
STIFF_IN_SHEAR = Identity(Meaning(
    name="all loads", free=(*CONSTANTS, *LOADS), sample=sampling.with_loads,
    simple=sampling.simple_loads, components=ON_LOADS.components,
    positive=(chiral_gap, constitutive.dual_form().xreplace(_NO_SHEAR)),
    route=measured.stiff_in_shear, route_name="the law with K solved numerically, at zeta = 10^60",
))  # fmt: skip
