"""Physical dimensions of the constants, solved from the requirement that all terms agree.

Length and force are the two units; u is 1/length, v a number, m force x length, n force.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.symbols import CONSTANTS, LOADS, STRAINS, gamma, p
from rodproof.derivations.theory.constitutive import (
    compliance_at_rest,
    quadratic_form,
)

length, force = sp.symbols("L F", positive=True)

#: (exponent of length, exponent of force) of the variables.
VARIABLES: dict[sp.Symbol, tuple[int, int]] = {
    **dict.fromkeys(STRAINS[:3], (-1, 0)),
    **dict.fromkeys(STRAINS[3:], (0, 0)),
    **dict.fromkeys(LOADS[:3], (1, 1)),
    **dict.fromkeys(LOADS[3:], (0, 1)),
    length: (1, 0),
    force: (0, 1),
}


@cache
def of_constants() -> dict[sp.Symbol, tuple[int, int]]:
    """Dimensions of the constants: Q and p are numbers, gamma^2 has the dimension of Q*."""
    unknown = {c: sp.symbols(f"length_{c} force_{c}") for c in CONSTANTS}
    equations: list[sp.Expr] = []

    def monomial(powers: dict[sp.Symbol, int]) -> tuple[sp.Expr, sp.Expr]:
        parts = [(k, VARIABLES.get(s) or unknown[s]) for s, k in powers.items()]
        return tuple(sp.Add(*(k * d[i] for k, d in parts)) for i in (0, 1))

    form = sp.Poly(sp.expand(quadratic_form()), *CONSTANTS, *STRAINS)
    for monom in form.monoms():
        powers = {s: k for s, k in zip(form.gens, monom, strict=True) if k}
        equations += monomial(powers)
    first = sp.fraction(compliance_at_rest()[0, 0])  # K^{-1}_{11} m_1^2 against gamma^2
    denominator = sp.Poly(first[1], *CONSTANTS).monoms()[0]
    powers = {s: -k for s, k in zip(CONSTANTS, denominator, strict=True) if k}
    equations += [
        a - 2 * b for a, b in zip(monomial({LOADS[0]: 2, **powers}), unknown[gamma], strict=True)
    ]
    equations += list(unknown[p])
    symbols = [s for pair in unknown.values() for s in pair]
    (solution,) = sp.linsolve(equations, symbols)
    values = dict(zip(symbols, solution, strict=True))
    return {c: (int(values[a]), int(values[b])) for c, (a, b) in unknown.items()}


def dimension(expr: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """(exponent of length, exponent of force) of a product of powers."""
    table = {**VARIABLES, **of_constants()}
    total = (sp.Integer(0), sp.Integer(0))
    for factor in sp.Mul.make_args(expr):
        base, exponent = factor.as_base_exp()
        if base.is_number:
            continue
        if base not in table:
            raise ValueError(f"{base} has no known dimension")
        total = tuple(a + exponent * b for a, b in zip(total, table[base], strict=True))
    return total
