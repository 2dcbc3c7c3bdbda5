"""Ends, motion and dissipation (Section 5.1), and what stiffening means (Section 5.2)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_motion(), _dissipation())


def _motion() -> Derivation:
    return Derivation(
        label="motion",
        title="Boundary conditions and motion",
        problem="Which ends admit the sheared states, and how does the rod move?",
        steps=(
            settle("bc-fixed-end", "A clamped end", "It fixes `theta = 0` at `s = 0`."),
            settle(
                "bc-resultant-couple",
                "No resultant couple",
                "`m + r × n` is constant along every equilibrium.",
            ),
            settle("dynamic-linear-momentum", "Linear momentum", "Sum over the section."),
            settle("dynamic-angular-momentum", "Angular momentum", "Sum over the section."),
        ),
    )


def _dissipation() -> Derivation:
    return Derivation(
        label="dissipation",
        title="Two viscous laws",
        problem="Which statics do they have, and is the dissipation never negative?",
        steps=(
            settle("strain-rate-u", "Strain-rate law for `u`", "A relaxation time."),
            settle("strain-rate-v", "Strain-rate law for `v`", "Strains are measured from rest."),
            settle("dissipation-static-limit", "Static limit", "All rates vanish."),
            settle("dissipation-nonnegative", "Dissipation", "Monotonicity of the law."),
            settle(
                "extra-strain-rate-two-times",
                "Two different times",
                "The form of the dissipation becomes indefinite near the strain limit.",
            ),
            settle("tangent-stiffness", "Stiffening", "Leading terms along a ray."),
        ),
    )
