"""Section 2.1, kinematics and strains: every printed statement, transcribed as printed."""

from __future__ import annotations

from rodproof.derivations.checks import kinematics as rules
from rodproof.derivations.checks import orientation
from rodproof.derivations.checks.kinematics import d, r_vector, u_vector
from rodproof.derivations.checks.routes import definitions
from rodproof.derivations.notation import (
    Cross,
    Dot,
    Every,
    Implies,
    Prime,
    Summed,
    equal,
    k,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement

SECTION = "2.1"
_TRIPLE_TEX = (
    r"[0,L] \ni s \mapsto (\boldsymbol r(s), \boldsymbol d_1(s), \boldsymbol d_2(s))"
    r" \in \mathbb E^3 \times \mathbb R^3 \times \mathbb R^3"
)


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (*_configuration(), *_darboux(), *_tangent())


def _configuration() -> tuple[Statement, ...]:
    return (
        Statement(
            id="config-triple", section=SECTION, label="-", introduces=True,
            claim="A configuration is a curve with two orthonormal vector fields along it.",
            latex=_TRIPLE_TEX + r", \quad \boldsymbol d_i \cdot \boldsymbol d_j = \delta_{ij}",
            printed=Every(
                equal(Dot(d[1], d[1]), 1), equal(Dot(d[2], d[2]), 1), equal(Dot(d[1], d[2]), 0)
            ),
            check=Routed(rules.ORTHONORMAL, definitions.ORTHONORMAL),
            note="Nine numbers under three equations: six degrees of freedom for each s.",
        ),
        Statement(
            id="d3-cross-product", section=SECTION, label="-", introduces=True,
            claim="The third director completes the first two to a right-handed frame.",
            latex=r"\boldsymbol d_3(s) = \boldsymbol d_1(s) \times \boldsymbol d_2(s)",
            printed=equal(d[3], Cross(d[1], d[2])), check=rules.ON_FRAMES,
        ),
    )  # fmt: skip


def _darboux() -> tuple[Statement, ...]:
    return (
        Statement(
            id="darboux-existence", section=SECTION, label="-",
            claim="Exactly one vector field turns all three directors at their rates.",
            latex=r"\exists!\, \boldsymbol u(s):\ "
            r"\boldsymbol d_k'(s) = \boldsymbol u(s) \times \boldsymbol d_k(s),\ k = 1, 2, 3",
            printed=equal(Prime(d[k]), Cross(u_vector, d[k])), check=rules.DARBOUX,
            note="The frame must be differentiable; being right-handed is not needed. Two of the "
            "three equations already determine u; one leaves its component along the director "
            "open.",
        ),
        Statement(
            id="darboux-components", section=SECTION, label="-", introduces=True,
            claim="Components of the Darboux vector in the directors.",
            latex=r"\boldsymbol u(s) = u_k(s) \boldsymbol d_k(s)",
            printed=equal(u_vector, Summed(u[k] * d[k], k)), check=rules.ON_FRAMES,
        ),
        Statement(
            id="darboux-equation", section=SECTION, label="-",
            claim="The rate of each director is the Darboux vector times the director.",
            latex=r"\boldsymbol d_k'(s) = \boldsymbol u(s) \times \boldsymbol d_k(s)",
            printed=equal(Prime(d[k]), Cross(u_vector, d[k])), check=rules.ON_FRAMES,
        ),
        Statement(
            id="darboux-formula", section=SECTION, label="eq:uequation",
            claim="The Darboux vector from the directors and their rates, summed over k.",
            latex=r"\boldsymbol u(s) = \tfrac12 \boldsymbol d_k(s) \times \boldsymbol d_k'(s)",
            printed=equal(u_vector, Summed(Cross(d[k], Prime(d[k])), k) / 2), check=rules.ON_FRAMES,
        ),
        Statement(
            id="extra-darboux-components", section=SECTION, label="-",
            claim="Each component of the Darboux vector is one scalar product.",
            latex=r"u_1 = \boldsymbol d_2' \cdot \boldsymbol d_3,\quad "
            r"u_2 = \boldsymbol d_3' \cdot \boldsymbol d_1,\quad "
            r"u_3 = \boldsymbol d_1' \cdot \boldsymbol d_2",
            printed=Every(
                equal(u[1], Dot(Prime(d[2]), d[3])),
                equal(u[2], Dot(Prime(d[3]), d[1])),
                equal(u[3], Dot(Prime(d[1]), d[2])),
            ),
            check=rules.ON_FRAMES,
            note="Cheaper than the sum of three vector products, and it needs no basis.",
        ),
    )  # fmt: skip


def _tangent() -> tuple[Statement, ...]:
    tangent = Prime(r_vector)
    return (
        Statement(
            id="v-components", section=SECTION, label="-", introduces=True,
            claim="Components of the tangent of the center line in the directors.",
            latex=r"\boldsymbol r'(s) = v_k(s) \boldsymbol d_k(s)",
            printed=equal(tangent, Summed(v[k] * d[k], k)), check=rules.ON_FRAMES,
        ),
        Statement(
            id="v3-positive", section=SECTION, label="eq:v3pos", introduces=True,
            claim="The third director points forwards along the center line.",
            latex=r"v_3(s) > 0", printed=positive(v[3]),
            check=Routed(rules.ORIENTED, definitions.FORWARDS),
        ),
        Statement(
            id="v3-positive-consequences", section=SECTION, label="-",
            claim="If v_3 is positive then the stretch is, and no section is tangent to the center "
            "line.",
            latex=r"v_3 > 0 \implies |\boldsymbol r'| > 0 \ \text{and}\ "
            r"\boldsymbol r' \cdot (\boldsymbol d_1 \times \boldsymbol d_2) > 0",
            printed=Implies(
                positive(v[3]),
                Every(
                    positive(Dot(tangent, tangent)), positive(Dot(tangent, Cross(d[1], d[2]))),
                ),
            ),
            check=Routed(orientation.STRETCHED, definitions.CONSEQUENCES),
            note="The sine of the angle between center line and section is v_3/|r'|. The stretch "
            "is positive as soon as v is not zero; only the second consequence needs v_3.",
        ),
    )  # fmt: skip
