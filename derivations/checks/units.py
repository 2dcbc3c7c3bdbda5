"""The choice of units of Section 3.4: which quantities may be set to 1."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.notation import Chain
from rodproof.derivations.proof.prover import claims
from rodproof.derivations.records import Confirmation, Decision
from rodproof.derivations.symbols import LOADS, STRAINS, chiral_gap, gamma
from rodproof.derivations.theory import constitutive, dimensions

_REJECTED = Decision(False, False, "rejected")


@dataclass(frozen=True, eq=False)
class Units:
    """Two quantities may be set to 1 by the choice of units.

    They must have independent dimensions in length and force, so that a unit of each exists, and
    the law must not notice: with every quantity divided by its unit the strains scale as they must.
    """

    def decide(self, printed: sp.Basic, *, explain: bool = True) -> Decision:
        chosen = []
        for claim in claims(printed):
            if not isinstance(claim, Chain) or claim.relations != ("=",):
                return _REJECTED
            scale, value = claim.sides
            if value != 1 or not isinstance(scale, sp.Symbol):
                return _REJECTED
            chosen.append(scale)
        dims = sp.Matrix([dimensions.dimension(scale) for scale in chosen])
        if dims.shape != (2, 2) or dims.det() == 0 or not _law_scales():
            return _REJECTED
        if dims != sp.eye(2):
            return _REJECTED  # the claim names a length and a force, in this order
        return Decision(True, True, "independent dimensions, and the law in these units is the law")

    def confirm(self, printed: sp.Basic) -> Confirmation | None:
        return None


@cache
def _law_scales() -> bool:
    """strains(loads/units; constants/units) = strains/units with units (L, gamma), exactly."""
    length, force = dimensions.length, gamma

    def scaled(symbol: sp.Symbol) -> sp.Expr:
        powers = dimensions.dimension(symbol)
        return symbol / length ** powers[0] / force ** powers[1]

    quantities = (*LOADS, *(c for c in dimensions.of_constants()))
    facts = Field((chiral_gap, constitutive.dual_form()))
    at = {s: scaled(s) for s in quantities}
    return all(
        facts.equal(law.subs(at, simultaneous=True), law * scaled(strain) / strain)
        for law, strain in zip(constitutive.strains(), STRAINS, strict=True)
    )
