"""The forms for p = 2: square roots in place of powers, and energies in closed form.

Each rule replaces the general expression and is an identity at p = 2 only.
"""

from __future__ import annotations

import sympy as sp

from rodproof.codegen import lower
from rodproof.codegen.kernel import Assignment, symbol
from rodproof.codegen.passes.stabilise import SPLIT_STRAIN_WEIGHT as SPLIT_BY_POWER
from rodproof.codegen.passes.stabilise import Rule
from rodproof.derivations.symbols import gamma
from rodproof.derivations.theory import constitutive as theory

x, y = theory.x, theory.y
q, factor, power, strain = map(symbol, ("q", "factor", "power", "strain"))
left, root = symbol("left"), symbol("root")

SOFTEN_DEFINITIONS = (
    Assignment("ratio", sp.Min(y, gamma) / sp.Max(y, gamma), (), "soften"),
    Assignment("power", symbol("ratio") ** 2, (), "soften"),
)
FACTOR = 1 / sp.Max(y, gamma) / sp.sqrt(1 + power)

SCALE_RADIAL_FACTOR = Rule(
    "take the larger of gamma and y out of the root",
    ((lower.strain_factor(), FACTOR),),
    SOFTEN_DEFINITIONS,
    "gamma^2 and y^2 overflow or underflow",
)

SPLIT_STRAIN_WEIGHT = Rule(
    "strain weight by the square",
    SPLIT_BY_POWER.pairs,
    SOFTEN_DEFINITIONS,
    "gamma^2 and y^2 overflow or underflow",
)

STIFFEN_DEFINITIONS = (
    Assignment("left", 1 - q, (), "stiffen"),
    Assignment("root", sp.sqrt(left), (), "stiffen"),
)

GROW_LOAD_FACTOR = Rule(
    "load factor by the root",
    ((lower.load_factor(), gamma / root),),
    STIFFEN_DEFINITIONS,
    "(1 - x)(1 + x) and 1 - x^2 lose what Q = x^2 still holds: 1 - Q is exact above 1/2",
)

GROW_LOAD_WEIGHT = Rule(
    "load weight is the growth",
    ((lower.load_weight(), symbol("growth")),),
    (*STIFFEN_DEFINITIONS, Assignment("growth", q / left)),
    "as for the load factor",
)

CLOSE_COMPLEMENTARY_ENERGY = Rule(
    "complementary energy in closed form",
    ((theory.complementary_energy(), strain * y / (1 + gamma * factor)),),
    (
        *SOFTEN_DEFINITIONS,
        Assignment("factor", FACTOR, (), "soften"),
        Assignment("strain", y * factor),
    ),
    "(gamma^2 + y^2)^{1/2} - gamma cancels at small loads: as y^2/(gamma + (gamma^2 + y^2)^{1/2})",
)

CLOSE_STORED_ENERGY = Rule(
    "stored energy in closed form",
    ((theory.stored_energy(), symbol("linear") * x / (1 + root)),),
    (*STIFFEN_DEFINITIONS, Assignment("linear", gamma * x)),  # the load of a linear rod
    "1 - (1 - x^2)^{1/2} cancels at small strains: x = 1e-8 is wrong by 122 %",
)
