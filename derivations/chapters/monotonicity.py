"""The Hessian as printed, and monotonicity (Section 3.4)."""

from __future__ import annotations

from rodproof.derivations.chapters.steps import settle
from rodproof.derivations.records import Derivation


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_monotonicity(),)


def _monotonicity() -> Derivation:
    return Derivation(
        label="monotonicity",
        title="Monotonicity of the law (`gamma = 1`)",
        problem="Is the Hessian of `W` positive definite, and what does that say of loads and "
        "strains?",
        steps=(
            settle(
                "hessian-quadratic-form",
                "The form of the Hessian",
                "Contract the Hessian with `(a, b)` twice.",
                "hess-m-u", "hess-m-u3", "hess-m-v", "hess-m-v3", "hess-m3-u3", "hess-m3-v",
                "hess-m3-v3", "hess-n-v", "hess-n-v3", "hess-n3-v3",
            ),
            settle(
                "hessian-positive-definite",
                "Positive definite",
                "A positive multiple of a positive definite form plus a square.",
                "hessian-conclusion",
            ),
            settle(
                "extra-hessian-bounds",
                "Between two multiples of `K`",
                "Cauchy-Schwarz bounds the square by `Q` times the form.",
            ),
            settle(
                "monotonicity-reading",
                "Each load grows with its own strain",
                "Diagonals of both Hessians: the other strains held, or the other loads.",
            ),
        ),
    )  # fmt: skip
