"""The tangents: Hessians of both energies and their being each other's inverse (Section 3.1)."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.domains import ON_LOADS, ON_STRAINS
from rodproof.derivations.notation import Q, Qstar, equal, m, n, u, v
from rodproof.derivations.proof.rules import MatrixIdentity
from rodproof.derivations.records import Derivation, Step
from rodproof.derivations.symbols import LOADS, gamma, p
from rodproof.derivations.theory import constitutive as theory


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_hessian(),)


def _compliance_at_strains() -> sp.Matrix:
    """D^2 W* at the loads that belong to the strains."""
    loads = dict(ON_STRAINS.components)
    return theory.compliance().xreplace({s: loads[s] for s in LOADS})


def _hessian() -> Derivation:
    K, K_inv = sp.Symbol("K"), sp.Symbol("K_inverse")
    k, e = sp.Symbol("k"), sp.Symbol("e")
    q, q_star = Q(u, v) ** (p / 2), Qstar(m, n) ** (p / 2)
    return Derivation(
        label="hessian",
        title="Hessians of the two energies",
        problem="Differentiate the law and its inverse once more. Write `k = K eps` and "
        "`e = K^{-1} sigma`.",
        steps=(
            Step(
                "D^2 W",
                "Product rule: the radial factor times `K`, plus its own slope times a rank-one "
                "matrix. At rest the second term tends to 0 for every `p > 0`.",
                equal(
                    sp.Symbol("D2W"),
                    gamma
                    * (1 - q) ** (-1 / p)
                    * (K + q / (1 - q) * k * sp.Symbol("k^T") / Q(u, v)),
                ),
                MatrixIdentity(
                    lambda: (theory.stiffness(), theory.stiffness_structure()),
                    ON_STRAINS.positive,
                ),
                ("hessian-blocks",),
            ),
            Step(
                "D^2 W*",
                "The same for the strains as functions of the loads.",
                equal(
                    sp.Symbol("D2Wstar"),
                    (gamma**p + q_star) ** (-1 / p)
                    * (K_inv - q_star / (gamma**p + q_star) * e * sp.Symbol("e^T") / Qstar(m, n)),
                ),
                MatrixIdentity(
                    lambda: (theory.compliance(), theory.compliance_structure()),
                    ON_LOADS.positive,
                ),
            ),
            Step(
                "Each other's inverse",
                "At strains and loads that belong to each other the "
                "Jacobians of inverse maps are inverse matrices.",
                equal(sp.Symbol("D2W") * sp.Symbol("D2Wstar"), sp.Symbol("I")),
                MatrixIdentity(
                    lambda: (theory.stiffness() * _compliance_at_strains(), sp.eye(6)),
                    ON_STRAINS.positive,
                ),
            ),
        ),
    )
