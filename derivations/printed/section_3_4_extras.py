"""What the derivation of Section 3.4 finds beyond the paper."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import monotonicity as rules
from rodproof.derivations.checks.increments import Increments, xA, xB, yA, yB
from rodproof.derivations.checks.tangents import UNIT_STRAINS, a, b
from rodproof.derivations.notation import FormQ, HessianForm, Q, chain, u, v
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import p


def statements() -> tuple[Statement, ...]:
    """Bounds of the tangent stiffness, and any two states."""
    return (_bounds(), _increments())


def _bounds() -> Statement:
    X = Q(u, v) ** (p / 2)
    secant, tangent = (1 - X) ** (-1 / p), (1 - X) ** (-1 / p - 1)
    return Statement(
        id="extra-hessian-bounds", section="3.4", label="-",
        claim="Against the small-strain stiffness the tangent stiffness lies between the secant "
        "one and the secant one over 1 - Q^{p/2}; both bounds are reached.",
        latex=r"(1 - Q^{p/2})^{-1/p}\, \mathsf w \cdot K \mathsf w \leq \mathsf w \cdot D^2 W"
        r"(\mathsf u, \mathsf v)\, \mathsf w \leq (1 - Q^{p/2})^{-1/p-1}\, \mathsf w \cdot K "
        r"\mathsf w, \quad \mathsf w = (\mathsf a, \mathsf b)",
        printed=chain(
            secant * FormQ(a, b), "<=", HessianForm(u, v, a, b), "<=", tangent * FormQ(a, b)
        ),
        check=rules.TangentBounds(UNIT_STRAINS),
        note="D^2 W has five times the eigenvalue (1 - Q^{p/2})^{-1/p} relative to K, across the "
        "load, and once (1 - Q^{p/2})^{-1/p-1}, along it. So its condition grows like "
        "1/(1 - Q^{p/2}) at the strain limit, and det D^2 W = alpha^4 zeta^4 (beta^2 eta^2 - "
        "iota^2) (1 - Q^{p/2})^{-6/p-1}.",
    )  # fmt: skip


def _increments() -> Statement:
    at = {
        name: sp.IndexedBase(name, real=True)
        for name in ("uA", "uB", "vA", "vB", "mA", "mB", "nA", "nB")
    }
    work = sp.Add(
        *(
            (at[f"{load}B"][k] - at[f"{load}A"][k]) * (at[f"{strain}B"][k] - at[f"{strain}A"][k])
            for load, strain in (("m", "u"), ("n", "v"))
            for k in (1, 2, 3)
        )
    )
    return Statement(
        id="extra-increments", section="3.4", label="-",
        claim="Between any two states the increments of the loads do positive work on those of the "
        "strains, at least the product of the increments of both radii x = Q^{1/2}, y = Q*^{1/2}.",
        latex=r"(\mathsf m_B - \mathsf m_A) \cdot (\mathsf u_B - \mathsf u_A) + (\mathsf n_B - "
        r"\mathsf n_A) \cdot (\mathsf v_B - \mathsf v_A) \geq (y_B - y_A)(x_B - x_A) \geq 0",
        printed=chain(work, ">=", (yB - yA) * (xB - xA), ">=", 0),
        check=Increments(),
        note="What the monotonicity of the single components comes to when nothing is held. Both "
        "signs are strict unless the strains are equal or parallel (first) or of equal radius "
        "(second), so that different strains always give a positive sum.",
    )  # fmt: skip
