"""States under an isolated thrust: straight and sheared (Section 4.2)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_straight(), _sheared())


def _straight() -> Derivation:
    return Derivation(
        label="straight-states",
        title="Thrust along a straight rod",
        problem="Contact forces only: no couple anywhere, the force `N g_3`.",
        steps=(
            settle("pure-force-theta", "What is left of the balance", "With `m = 0`."),
            settle("centerline-parallel-g3", "The center line", "It is along the force."),
            settle("straight-u3", "Twist", "The law at `n = N d_3`.", "straight-u12"),
            settle("straight-v3", "Dilatation", "The law at `n = N d_3`.", "straight-v12"),
            settle("straight-limit-u3", "Limit of the twist", "Leading terms."),
            settle("straight-limit-v3", "Limit of the dilatation", "Leading terms."),
            settle(
                "extra-straight-orientation",
                "How far it can be compressed",
                "Solve `v_3 > 0` for the thrust.",
            ),
        ),
    )


def _sheared() -> Derivation:
    return Derivation(
        label="sheared-states",
        title="The shearing bifurcation",
        problem="Solve `v_3 = v N cos(theta)` with `theta` between 0 and a right angle.",
        steps=(
            settle("sheared-v3-second", "One ratio", "`v_3/(v_3 - 1)` is a ratio of moduli."),
            settle("sheared-v3-value", "The dilatation is fixed", "Solve for it."),
            settle("moduli-condition-1", "First condition", "It must be positive."),
            settle(
                "moduli-condition-2",
                "Second condition",
                "It must be below the strain limit.",
                "moduli-condition-2-iff",
                "moduli-condition-2-necessary",
            ),
            settle(
                "fN-derivative",
                "One equation for `x = cos(theta)`",
                "The slope is positive, so the root is unique.",
                "fN-definition",
                "fN-bijection",
            ),
            settle("n-thresh", "The threshold", "The root reaches `x = 1`."),
            settle("extra-threshold-sharp", "It is sharp", "`f_N(1)` increases with `N`."),
            settle(
                "extra-thrust-of-angle",
                "The branch, explicitly",
                "Solve for the thrust rather than for the angle.",
                "sheared-existence",
                "sheared-branch",
            ),
            settle("extra-near-threshold", "Near the threshold", "Expand at `theta = 0`."),
            settle("theta-p2", "The angle for `p = 2`", "The equation is linear in `x^2`."),
            settle("limiting-equation", "Infinite thrust", "`N^{-p} -> 0`."),
            settle("theta-limit", "The limiting angle", "Solve it."),
            settle("sheared-u3", "Twist", "The law with the factor known.", "sheared-identity"),
            settle("sheared-v1", "Shear", "The law with the factor known.", "sheared-v2"),
            settle("extra-sheared-stretch", "Stretch", "Only shear grows beyond the threshold."),
        ),
    )
