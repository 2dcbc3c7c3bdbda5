"""Euler angles and the reduced equations (Sections 4 and 4.1)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_euler(), _reduced())


def _euler() -> Derivation:
    return Derivation(
        label="euler-angles",
        title="Euler angles",
        problem="Write directors, strains and loads by three angles, the force along `g_3`.",
        steps=(
            settle("force-constant", "The force", "No body force, and its value at the end."),
            settle("euler-d3", "`d_3`", "Spherical coordinates of a unit vector."),
            settle("euler-e3-e2", "A frame for `d_3`", "The derivative by `varphi`, normalised."),
            settle("euler-e1", "Its first vector", "Product of the other two."),
            settle("euler-d1", "`d_1`", "Turned by `psi` about `d_3`."),
            settle("euler-d2", "`d_2`", "Product of the other two."),
            settle("euler-n", "Components of the force", "Products with the directors."),
            settle("euler-M2", "Components of the couple", "The turn by `psi`.", "euler-M1",
                   "euler-M3"),
            settle("euler-u1", "First flexural strain", "`d_2' . d_3` in the angles."),
            settle("euler-u2", "Second flexural strain", "`d_3' . d_1` in the angles."),
            settle("euler-u3", "Twist", "`d_1' . d_2` in the angles."),
        ),
    )  # fmt: skip


def _reduced() -> Derivation:
    return Derivation(
        label="reduced-equations",
        title="Six equations for three angles and three couples",
        problem="Project the balance of couples on the frame `e_k`, which itself turns.",
        steps=(
            settle("ode-phi", "Angle `varphi`", "Combine both flexural strains with `psi`."),
            settle(
                "ode-theta",
                "Angle `theta`",
                "`u_1 sin(psi) + u_2 cos(psi)`; both the strain and the couple have a plus sign.",
            ),
            settle("ode-psi", "Angle `psi`", "The twist."),
            settle("ode-M1", "Along `e_1`", "The frame turns with `theta' e_2 + varphi' g_3`."),
            settle("ode-M2", "Along `e_2`", "The only component of the moment of the force."),
            settle("ode-M3", "Along `e_3`", "The law bends in the plane of the bending couple."),
            settle("six-equations", "A closed system", "The loads determine all strains."),
            settle("extra-first-integral-couple", "First integral", "`g_3` is constant."),
            settle(
                "extra-first-integral-energy",
                "First integral",
                "The rod is uniform: nothing depends on `s` itself.",
            ),
        ),
    )
