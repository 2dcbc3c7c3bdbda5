"""Curves with directors and the balance of forces and couples (Section 2)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_strains(), _balance())


def _strains() -> Derivation:
    return Derivation(
        label="kinematics",
        title="Strains from a curve with directors",
        problem="A rod is a curve with two orthonormal directors. Which six numbers measure its "
        "deformation, whatever the rigid motion?",
        steps=(
            settle(
                "config-triple",
                "Configuration",
                "Nine numbers under three equations: six degrees of freedom at each `s`.",
            ),
            settle("d3-cross-product", "Third director", "It completes a right-handed frame."),
            settle(
                "darboux-existence",
                "Darboux vector",
                "Differentiate `R^T R = I`: `R^T R'` is skew, and a skew matrix in three "
                "dimensions is the product with exactly one vector.",
                "darboux-equation",
                "intro-darboux",
            ),
            settle(
                "darboux-formula",
                "Its formula",
                "Sum `d_k x (u x d_k)` over `k`: each term is `u` less its part along `d_k`.",
            ),
            settle(
                "extra-darboux-components",
                "Its components",
                "Project `d_k' = u x d_k` on the other directors.",
                "darboux-components",
            ),
            settle("v-components", "The tangent", "Expand the tangent in the directors."),
            settle(
                "v3-positive-consequences",
                "What `v_3 > 0` says",
                "`v_3` is the product of the tangent with `d_3`, the normal of the section.",
                "v3-positive",
            ),
        ),
    )


def _balance() -> Derivation:
    return Derivation(
        label="balance",
        title="Balance of forces and couples",
        problem="Every segment is in equilibrium under the contact loads at its ends and the "
        "body loads along it. What holds at each point?",
        steps=(
            settle("resultant-force", "Contact force", "What lies beyond acts at both ends."),
            settle("resultant-couple", "Contact couple", "With the moment of the contact forces."),
            settle(
                "force-balance",
                "Forces",
                "The integral of `n' + f` over every segment vanishes, so the integrand does.",
            ),
            settle(
                "moment-balance",
                "Couples",
                "Differentiate the resultant couple and use the balance of forces; the point `o` "
                "drops out.",
            ),
            settle(
                "extra-balance-in-directors",
                "In the directors",
                "The derivative of a vector is that of its components plus `u` times the vector.",
                "nm-components",
            ),
        ),
    )
