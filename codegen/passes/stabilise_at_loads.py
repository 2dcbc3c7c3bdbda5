"""The stiffness and the distance to the limit from the loads, for any p and for p = 2.

Near the limit the strains no longer say how near; the loads do. So the stiffness there is taken
from the loads, as the inverse of the compliance, and 1 - x^p goes beside the strains.
"""

from __future__ import annotations

import sympy as sp
from sympy.codegen.cfunctions import log1p

from rodproof.codegen import lower
from rodproof.codegen.kernel import Assignment, Dyad, symbol, tiny
from rodproof.codegen.passes import stabilise_p2 as square
from rodproof.codegen.passes.stabilise import (
    CHIRAL_CONSTANTS,
    REMAIN,
    SOFTEN_DEFINITIONS,
    Rule,
    answers,
    factor,
    moduli,
    mu_1,
    mu_2,
    mu_3,
    nu_1,
    nu_2,
    nu_3,
    power,
    share,
    size,
    t,
)
from rodproof.derivations.symbols import gamma, p
from rodproof.derivations.theory import constitutive as theory

y = theory.y
rise, half, remain = symbol("rise"), symbol("half"), symbol("remain")
h = tuple(symbol(f"h{i}") for i in range(1, 7))  # (y/gamma)^(p/2) sigma/y

#: The root of the weight, and from it the power of the radial factor, whichever is larger.
POWER = (
    Assignment("half", sp.Min(rise, 1 / sp.Max(rise, tiny)), (), "harden"),
    Assignment("power", half**2, (), "harden"),
)
RISE = Assignment("rise", sp.exp(p / 2 * sp.log(sp.Max(y / gamma, tiny))), (), "harden")
RISE_SQUARE = Assignment("rise", y / gamma, (), "harden")

SCALE_LOAD_FACTOR = Rule(
    "take the larger of gamma and y out of the load factor",
    ((lower.load_factor_at_loads(), sp.Max(y, gamma) * sp.exp(log1p(power) / p)),),
    (RISE, *POWER),
    "gamma^p and y^p overflow or underflow: y = 1e10, p = 40 answers inf",
)

SCALE_LOAD_ROOT = Rule(
    "take the larger of gamma and y out of the root",
    ((lower.load_factor_at_loads(), sp.Max(y, gamma) * sp.sqrt(1 + power)),),
    (RISE_SQUARE, *POWER),
    "gamma^2 and y^2 overflow or underflow",
)

GROW_WITH_LOAD = Rule(
    "load weight is (y/gamma)^p",
    ((lower.load_weight_at_loads(), rise**2),),
    (RISE,),
    "1 - x^p cancels near the limit: y = 1e8 gamma, p = 2 answers inf",
)

GROW_BY_SQUARE = Rule(
    "load weight is the square of y/gamma",
    GROW_WITH_LOAD.pairs,
    (RISE_SQUARE,),
    GROW_WITH_LOAD.why,
)

KEEP_GAP = Rule(
    "distance to the limit by the same power",
    ((lower.limit_gap(), remain),),
    (*SOFTEN_DEFINITIONS, REMAIN),
    "1 - x^p cancels near the limit: y = 1e8 gamma, p = 2 answers 0",
)

KEEP_GAP_SQUARE = Rule(
    "distance to the limit by the same square",
    KEEP_GAP.pairs,
    (*square.SOFTEN_DEFINITIONS, REMAIN),
    KEEP_GAP.why,
)


def _spread() -> Rule:
    """Entries factor (K + h h^T), the rank one alone off the diagonal but for K's coupling."""
    rest = theory.stiffness_at_rest()
    pairs = tuple(
        (
            factor * (rest[i, j] + share * t[i] * t[j]),
            factor * rest[i, j] + factor * h[i] * h[j],
        )
        for i in range(6)
        for j in range(i, 6)
    )
    reduced = zip(h, answers, (mu_1, mu_2, mu_3, nu_1, nu_2, nu_3), strict=True)
    scaled = dict(zip(answers, moduli, strict=True))
    definitions = (
        # a floor for rest alone: every other norm is far above it
        Assignment("rise_per_size", rise / sp.Max(size, sp.sqrt(tiny))),
        *(Assignment(f"{a.name}_rise", m * symbol("rise_per_size")) for a, m in scaled.items()),
        *(Assignment(k.name, symbol(f"{a.name}_rise") * row) for k, a, row in reduced),
    )
    return Rule(
        "the root of the weight with either direction, by the reduced loads",
        pairs,
        definitions,
        "the weight overflows where its product with small moduli does not; near rest y has few "
        "digits or none",
        CHIRAL_CONSTANTS,
        Dyad("stiff", "factor", tuple(k.name for k in h)),
    )


SPREAD_WEIGHT = _spread()
