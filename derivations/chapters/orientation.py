"""Orientation and transverse symmetry (Sections 3.2 and 3.3)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_orientation(), _symmetry())


def _orientation() -> Derivation:
    return Derivation(
        label="orientation",
        title="Orientation of the rod and of the body it models",
        problem="For which constants do all strains below the limit keep `v_3 > 0`, and the body "
        "from turning inside out?",
        steps=(
            settle(
                "matconst1-iff",
                "Two forms of a condition",
                "Square both sides; `beta^2 eta^2 - iota^2 > 0` makes it an equivalence.",
            ),
            settle(
                "matconst1-sufficient",
                "It suffices",
                "By the bound on the dilatation strain.",
                "v3-sign",
            ),
            settle(
                "extra-v3-positive-sharp",
                "And but for equality it is needed",
                "The bound is a supremum that is not attained.",
            ),
            settle(
                "extra-determinant",
                "Gradient of the constrained deformation",
                "Differentiate `r + x_1 d_1 + x_2 d_2` and use the Darboux vector.",
                "chi-deformation",
            ),
            settle(
                "det-positive-iff",
                "Positive on the whole disc",
                "A linear function on a disc is smallest on its rim, at `v_3 - a |(u_1, u_2)|`.",
                "det-positive",
            ),
            settle(
                "matconst2-chain",
                "A sufficient radius",
                "Bound flexure and compression one by one.",
                "matconst2",
            ),
            settle(
                "extra-orientation-sharp",
                "The sharp radius",
                "Support function of the ellipsoid for flexure and compression together.",
            ),
        ),
    )


def _symmetry() -> Derivation:
    return Derivation(
        label="symmetry",
        title="What rotation, flip and reflection do to strains",
        problem="Turn the directors about `d_3`; reverse the arc with a half-turn; reflect. How "
        "do `u`, an axial vector, and `v`, a polar one, change, and which changes keep `W`?",
        steps=(
            settle("symmetry-matrices", "The matrices", "Rotation about `d_3`, and half-turn."),
            settle("hemitropic-definition", "Hemitropy", "Components turn, the rod does not."),
            settle("flip-definition", "Flip", "The arc's reversal changes the sign of both."),
            settle("isotropy-definition", "Isotropy", "A reflection: `u` is axial, `v` is not."),
            settle("hemitropic-flip-claim", "The rod is both", "`Q` is invariant."),
            settle(
                "isotropic-iff-iota-zero",
                "Isotropic without coupling",
                "The reflection changes the sign of the coupling term alone.",
            ),
        ),
    )
