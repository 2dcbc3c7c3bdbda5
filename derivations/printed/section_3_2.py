"""Section 3.2, orientation preservation: every printed statement, transcribed as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import kinematics
from rodproof.derivations.checks import orientation as rules
from rodproof.derivations.checks.kinematics import d
from rodproof.derivations.checks.orientation import L, chi_vector, det, r_vector, s
from rodproof.derivations.checks.routes import constants, definitions
from rodproof.derivations.notation import (
    Chain,
    Every,
    ForAll,
    Iff,
    Implies,
    Q,
    chain,
    equal,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, iota
from rodproof.derivations.theory.orientation import a, x1, x2

SECTION = "3.2"

_D = beta**2 * eta**2 - iota**2
_ratio = beta * _D ** sp.Rational(-1, 2)
_flexure = sp.sqrt(u[1] ** 2 + u[2] ** 2)
_inside = chain(Q(u, v), "<", 1)
_RATIO_TEX = r"\beta(\beta^2\eta^2 - \iota^2)^{-1/2}"
_FLEXURE_TEX = r"((u_1(s))^2 + (u_2(s))^2)^{1/2}"
_IN_BODY_TEX = r"\det \nabla \boldsymbol\chi > 0 \text{ on } \mathcal B"


def _disc() -> Chain:
    return chain(x1**2 + x2**2, "<=", a**2)


def _condition() -> Chain:
    return chain(1 + iota**2 / beta**2, "<", eta**2)


def _radius_condition() -> Chain:
    return chain(a, "<", alpha * (1 - _ratio))


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (*_center_line(), *_body(), *_determinant(), *_radius())


def _center_line() -> tuple[Statement, ...]:
    return (
        Statement(
            id="v3-sign", section=SECTION, label="eq:v3sign", introduces=True,
            claim="The condition that fixes the sense of d_3 and keeps the stretch from zero.",
            latex="v_3(s) > 0", printed=positive(v[3]),
            check=Routed(kinematics.ORIENTED, definitions.FORWARDS),
        ),
        Statement(
            id="matconst1-iff", section=SECTION, label="eq:matconst1",
            claim="Two forms of the condition under which the dilatation strain stays positive.",
            latex=_RATIO_TEX + r" < 1 \iff 1 + \frac{\iota^2}{\beta^2} < \eta^2",
            printed=Iff(chain(_ratio, "<", 1), _condition()),
            check=Routed(rules.EQUIVALENT, constants.V3_POSITIVE),
            note="The left form needs beta^2 eta^2 > iota^2; the right one implies it.",
        ),
        Statement(
            id="matconst1-sufficient", section=SECTION, label="-",
            claim="Under that condition every strain within the limit has a positive v_3.",
            latex=r"1 + \frac{\iota^2}{\beta^2} < \eta^2 \implies v_3(s) > 0",
            printed=Implies(_condition(), positive(v[3])), check=rules.ENSURES,
            note="Sharp but for equality, which suffices too (extra-v3-positive-sharp).",
        ),
        Statement(
            id="extra-v3-positive-sharp", section=SECTION, label="-",
            claim="Within the limit the dilatation strain is positive exactly on this condition.",
            latex=r"v_3 > 0 \text{ for all } Q(\mathsf u, \mathsf v) < 1 \iff "
            r"1 + \frac{\iota^2}{\beta^2} \leq \eta^2",
            printed=Iff(
                ForAll(_inside, positive(v[3])), chain(1 + iota**2 / beta**2, "<=", eta**2)
            ),
            check=rules.ENSURES,
        ),
    )  # fmt: skip


def _body() -> tuple[Statement, ...]:
    return (
        Statement(
            id="cross-section-disk",
            section=SECTION,
            label="-",
            introduces=True,
            claim="The material section is the closed disc of radius a.",
            latex=r"\mathcal A(s) = \{(x^1, x^2) \mid (x^1)^2 + (x^2)^2 \leq a^2\}",
            printed=_disc(),
            check=rules.DISC,
        ),
        Statement(
            id="reference-body",
            section=SECTION,
            label="-",
            introduces=True,
            claim="The slender body at rest: all sections along the rod.",
            latex=r"\mathcal B = \{(x^1, x^2, s) \mid s \in [0, L], (x^1, x^2) \in \mathcal A(s)\}",
            printed=Every(chain(0, "<=", s, "<=", L), _disc()),
            check=rules.BODY,
        ),
        Statement(
            id="chi-deformation",
            section=SECTION,
            label="-",
            introduces=True,
            claim="The deformation that moves each section as a rigid disc.",
            latex=r"\boldsymbol\chi(x^1, x^2, s) = \boldsymbol r(s) + x^1 \boldsymbol d_1(s)"
            r" + x^2 \boldsymbol d_2(s)",
            printed=equal(chi_vector, r_vector + x1 * d[1] + x2 * d[2]),
            check=rules.DEFORMATION,
        ),
    )


def _determinant() -> tuple[Statement, ...]:
    oriented = ForAll(_disc(), positive(det))
    return (
        Statement(
            id="det-positive-iff", section=SECTION, label="eq:v3strongpos",
            claim="The constrained deformation preserves orientation exactly if v_3 exceeds the "
            "radius times the flexure.",
            latex=_IN_BODY_TEX + rf" \iff v_3(s) > a {_FLEXURE_TEX}",
            printed=Iff(oriented, chain(v[3], ">", a * _flexure)), check=rules.ON_THE_DISC,
            note="Strict, because the disc is closed and the least value is taken on its rim.",
        ),
        Statement(
            id="det-positive", section=SECTION, label="-", introduces=True,
            claim="What it means that the constrained deformation preserves orientation.",
            latex=_IN_BODY_TEX, printed=oriented,
            check=Routed(rules.ORIENTATION, definitions.VOLUME),
        ),
        Statement(
            id="extra-determinant", section=SECTION, label="-",
            claim="The determinant of the constrained deformation's gradient.",
            latex=r"\det \nabla \boldsymbol\chi = v_3 + u_1 x^2 - u_2 x^1",
            printed=equal(det, v[3] + u[1] * x2 - u[2] * x1), check=rules.DETERMINANT,
            note="Neither the twist nor the shear changes volume to first order.",
        ),
    )  # fmt: skip


def _radius() -> tuple[Statement, ...]:
    return (
        Statement(
            id="matconst2", section=SECTION, label="eq:matconst2", introduces=True,
            claim="The condition on the radius of the section.",
            latex=rf"a < \alpha(1 - {_RATIO_TEX})",
            printed=_radius_condition(), check=Routed(rules.radius_condition(), constants.RADIUS),
            note="It implies eq:matconst1, as a > 0; if the right side is not positive no radius "
            "meets it. It bounds flexure and dilatation separately and is sufficient, not "
            "necessary: the sharp condition is extra-orientation-sharp.",
        ),
        Statement(
            id="matconst2-chain", section=SECTION, label="-",
            claim="Under the condition on the radius the strong orientation condition holds.",
            latex=rf"a {_FLEXURE_TEX} \leq \frac{{a}}{{\alpha}} < 1 - {_RATIO_TEX} < v_3(s)",
            printed=Implies(
                _radius_condition(),
                chain(a * _flexure, "<=", a / alpha, "<", 1 - _ratio, "<", v[3]),
            ),
            check=rules.chain(),
            note="The first inequality is strict too, by eq:u1u2bd.",
        ),
        Statement(
            id="extra-orientation-sharp", section=SECTION, label="-",
            claim="Within the limit the strong condition holds exactly for these radii.",
            latex=r"v_3 > a(u_1^2 + u_2^2)^{1/2} \text{ for all } Q(\mathsf u, \mathsf v) < 1 \iff "
            r"\frac{a^2}{\alpha^2} + \frac{\beta^2}{\beta^2\eta^2 - \iota^2} \leq 1",
            printed=Iff(
                ForAll(_inside, chain(v[3], ">", a * _flexure)),
                chain(a**2 / alpha**2 + beta**2 / _D, "<=", 1),
            ),
            check=rules.ENSURES,
            note="Largest flexure and largest compression cannot occur together, so a may be as "
            "large as alpha (1 - beta^2/(beta^2 eta^2 - iota^2))^{1/2}, more than printed.",
        ),
    )  # fmt: skip
