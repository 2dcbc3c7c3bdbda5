"""The law of the rod without a limit, for comparison: strains in proportion to the loads.

K^{-1} sigma/gamma, the limited law's tangent at rest taken for every load, in the constants that
the limited law's module computes.
"""

from __future__ import annotations

from dataclasses import replace

import sympy as sp

from rodproof.codegen.equilibria.system import Piece, piece
from rodproof.codegen.kernel import symbol
from rodproof.codegen.lower import LOAD_NAMES
from rodproof.codegen.passes import stabilise as rules
from rodproof.derivations.symbols import alpha, beta, eta, gamma, zeta
from rodproof.derivations.theory import constitutive

REDUCED = (rules.mu_1, rules.mu_2, rules.twist, rules.nu_1, rules.nu_2, rules.dilatation)
#: K^{-1} where beta^2 eta^2 - iota^2 is in the constants `gap` and `chirality`.
COUPLED = {
    (2, 2): rules.per_gap / beta**2,
    (2, 5): -rules.chirality * rules.per_gap / (beta * eta),
    (5, 5): rules.per_gap / eta**2,
}


def pieces() -> tuple[Piece, ...]:
    """Strains and compliance of the linear law; they divide by gamma, whose reciprocal the
    limited law does not keep.
    """
    divided = {symbol("per_gamma"): 1 / gamma}
    found = (_strains(), _compliance())
    return tuple(replace(part, kernel=part.kernel.rewrite(divided)) for part in found)


def _strains() -> Piece:
    moduli = (alpha, alpha, beta, zeta, zeta, eta)
    body = tuple(replace(a, step="") for a in rules.COMPLETE_DUAL_FORM.definitions)
    rest = (0, 0, 0, 0, 0, 1)
    return piece(
        "linear_strains",
        "(u, v) = K^-1 (m, n)/gamma + (0, e3): the law at rest, for every load.",
        {"loads": LOAD_NAMES},
        body,
        {(i,): rest[i] + REDUCED[i] / (moduli[i] * gamma) for i in range(6)},
        constants=rules.CHIRAL_CONSTANTS,
    )


def _compliance() -> Piece:
    inverse = constitutive.compliance_at_rest()
    entries = {
        (i, j): COUPLED.get((i, j), inverse[i, j]) / gamma for i in range(6) for j in range(i, 6)
    }
    return piece(
        "linear_compliance",
        "K^-1/gamma, the entries on and above the diagonal, row by row.",
        {},
        (),
        {(k,): sp.sympify(e) for k, e in enumerate(entries.values())},
        constants=rules.CHIRAL_CONSTANTS,
    )
