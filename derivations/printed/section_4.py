"""Section 4, the opening: the constant force and helical states, transcribed as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.end_force import FORCE, force_at
from rodproof.derivations.checks.euler import STATES, d, g
from rodproof.derivations.notation import Dot, Every, Prime, equal
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.records import Statement
from rodproof.derivations.theory.euler import N
from rodproof.derivations.theory.frames import theta

SECTION = "4"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (
        Statement(
            id="force-constant", section=SECTION, label="-",
            claim="Without body force the contact force is N g_3 all along the rod.",
            latex=r"\boldsymbol n(s) = N \boldsymbol g_3",
            printed=equal(force_at, N * g[3]),
            check=Identity(FORCE),
            note="From n' = 0 and n(1) = N g_3, for N of either sign or zero; that n(1) points "
            "along g_3 is a choice of the basis.",
        ),
        Statement(
            id="helical-state-definition", section=SECTION, label="-", introduces=True,
            claim="A helical state is an equilibrium whose third director keeps its polar angle.",
            latex=r"\boldsymbol d_3 \cdot \boldsymbol g_3 = \cos\theta, \quad "
            r"(\boldsymbol d_3 \cdot \boldsymbol g_3)' = -\sin\theta\,\theta'",
            printed=Every(
                equal(Dot(d[3], g[3]), sp.cos(theta)),
                equal(Prime(Dot(d[3], g[3])), -sp.sin(theta) * Prime(theta)),
            ),
            check=Identity(STATES),
            note="The polar angle is constant exactly where theta' = 0. The definition includes "
            "straight states (theta = 0) and needs a polar axis, here that of the force.",
        ),
    )  # fmt: skip
