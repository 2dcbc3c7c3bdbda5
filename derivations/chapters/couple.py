"""States under an isolated couple: twist, helices, circles (Section 4.3)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_twisted(), _helical())


def _twisted() -> Derivation:
    return Derivation(
        label="twisted-states",
        title="Twist by a couple, and the Poynting effect",
        problem="No force; the couple is along `d_3`.",
        steps=(
            settle("couple-third-equation", "What is left of the balance", "With `N = 0`."),
            settle("twist-u3", "Twist", "The law at `m = M_3 d_3`."),
            settle("twist-v3", "Dilatation", "The law at `m = M_3 d_3`."),
            settle("twist-poynting", "Poynting effect", "The sign of `-iota M_3`."),
            settle("twist-limit-u3", "Limit of the twist", "Leading terms."),
            settle("twist-limit-v3", "Limit of the dilatation", "Leading terms."),
        ),
    )


def _helical() -> Derivation:
    return Derivation(
        label="helical-states",
        title="Helices and circles under a couple",
        problem="No force, constant polar angle, `M_1` not zero.",
        steps=(
            settle("helix-M3", "The couple is along the axis", "Balance along `e_2`."),
            settle("helix-phi", "Angle `varphi`", "Integrate its equation from 0."),
            settle("helix-psi", "Angle `psi`", "Integrate twist less `varphi' cos(theta)`."),
            settle("helix-u3", "Twist", "The law.", "helix-u1", "helix-u2"),
            settle("helix-v3", "Dilatation", "The law.", "helix-v12"),
            settle("helix-rprime", "Tangent", "It is along `d_3`.", "helix-tangent"),
            settle("extra-helix-curvature", "Curvature and torsion", "Frenet's formulas."),
            settle("helix-handedness", "Handedness", "The sign of the torsion."),
            settle("helix-radius", "Radius", "`kappa/(kappa^2 + tau^2)`."),
            settle("helix-pitch", "Rise of one turn", "`2 pi tau/(kappa^2 + tau^2)`."),
            settle("circle-r", "Circle", "`theta = pi/2`: no torsion, no twist."),
            settle("circle-limit-curvature", "Largest curvature", "Leading terms."),
        ),
    )
