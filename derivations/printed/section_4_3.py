"""Section 4.3, isolated couples: the general equations and the twisted states, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.couple import equations as rules
from rodproof.derivations.checks.couple import states
from rodproof.derivations.checks.couple.domains import OfState
from rodproof.derivations.checks.couple.route import d1, d2, d3, d3_s, length, r_s
from rodproof.derivations.checks.routes import states as measured
from rodproof.derivations.notation import (
    Every,
    Iff,
    Implies,
    LimitOf,
    Prime,
    chain,
    equal,
    m,
    positive,
    u,
    v,
)
from rodproof.derivations.printed import section_4_3_helix
from rodproof.derivations.proof.exactly import exactly
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import beta, eta, iota, p
from rodproof.derivations.theory.couple import psi_0, s
from rodproof.derivations.theory.euler import u_scalar
from rodproof.derivations.theory.frames import phi, psi, theta

SECTION = "4.3"

M = sp.IndexedBase("M", real=True)
_D = beta**2 * eta**2 - iota**2
_factor = (1 + eta**p / _D ** (p / 2) * sp.Abs(M[3]) ** p) ** (-1 / p)
_D_TEX = r"\beta^2 \eta^2 - \iota^2"
_F_TEX = rf"\Bigl( 1 + \frac{{\eta^p}}{{({_D_TEX})^{{p/2}}}} |M_3|^p \Bigr)^{{-1/p}}"
_V3_TEX = rf"{_F_TEX} \frac{{-\iota M_3}}{{{_D_TEX}}}"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (
        *_equations(),
        *_twisted(),
        *_directors(),
        *_length(),
        *_limits(),
        *section_4_3_helix.statements(),
    )


def _equations() -> tuple[Statement, ...]:
    turn = equal(sp.sin(theta) * Prime(phi), -u_scalar * M[1])
    spin = equal(Prime(psi) + sp.cos(theta) * Prime(phi), u[3])
    third = equal((M[1] * sp.cos(theta) + M[3] * sp.sin(theta)) * Prime(phi), 0)
    bend = equal(Prime(theta), u_scalar * M[2])
    first_balance = equal(Prime(M[1]) - M[2] * sp.cos(theta) * Prime(phi) + Prime(theta) * M[3], 0)
    second_balance = equal(
        Prime(M[2]) + (M[1] * sp.cos(theta) + M[3] * sp.sin(theta)) * Prime(phi), 0
    )
    third_balance = equal(Prime(M[3]), 0)
    concluded = Every(turn, spin, third, equal(Prime(M[1]), 0), equal(Prime(M[3]), 0))
    none = Every(equal(M[1], 0), equal(M[2], 0))
    return (
        Statement(
            id="M2-zero-iff",
            section=SECTION,
            label="-",
            claim="M_2 vanishes exactly where theta is stationary.",
            latex=r"M_2 = 0 \iff \theta' = 0",
            printed=Iff(equal(M[2], 0), equal(Prime(theta), 0)),
            check=Routed(rules.BENDING_ZERO, measured.ZEROS),
            note="theta' = u M_2 with u > 0; the sign of this relation does not matter here.",
        ),
        Statement(
            id="couple-theta-range",
            section=SECTION,
            label="-",
            introduces=True,
            claim="The polar angle is taken between 0 and a right angle.",
            latex=r"\theta \in [0, \pi/2]",
            printed=chain(0, "<=", theta, "<=", sp.pi / 2),
            check=rules.HalfOfAllAngles(),
            note="Nothing is lost: without force a half turn about g_1 is a symmetry, and it "
            "maps theta to pi - theta.",
        ),
        Statement(
            id="couple-derivation",
            section=SECTION,
            label="-",
            claim="With theta' = M_2 = 0 the first and third couple balance give the equations "
            "for phi and psi, the third condition, and constant theta, M_1 and M_3.",
            latex=r"\text{(M1seq), (M3seq)} \implies \sin\theta\,\varphi' = -u M_1,\;"
            r" \psi' + \cos\theta\,\varphi' = u_3,\; (M_1 \cos\theta + M_3 \sin\theta)\varphi' = 0,"
            r"\; M_1' = M_3' = 0",
            printed=Implies(Every(first_balance, third_balance), concluded),
            read_as=Implies(
                Every(turn, bend, spin, first_balance, second_balance, third_balance), concluded
            ),
            check=rules.Consequence(conclusions=5),
            reading="The two cited equations give that M_1 and M_3 are constant, and nothing more. "
            "The equations for phi and psi are eq:phiseq and eq:psiseq, and the "
            "condition (M_1 cos theta + M_3 sin theta) phi' = 0 is eq:M2seq, which is not "
            "cited: M_1 = 1, M_3 = 0, theta = pi/3 with constant phi' != 0 meets both cited "
            "equations and violates it.",
        ),
        Statement(
            id="couple-phi",
            section=SECTION,
            label="eq:noN1",
            claim="Under couples alone: equation for phi.",
            latex=r"\sin\theta\,\varphi' = -u M_1",
            printed=turn,
            check=rules.PHI_EQUATION,
        ),
        Statement(
            id="couple-psi",
            section=SECTION,
            label="-",
            claim="Under couples alone: equation for psi.",
            latex=r"\psi' + \cos\theta\,\varphi' = u_3",
            printed=spin,
            check=rules.PSI_EQUATION,
        ),
        Statement(
            id="couple-third-equation",
            section=SECTION,
            label="-",
            claim="Under couples alone: what is left of the balance of couples.",
            latex=r"(M_1 \cos\theta + M_3 \sin\theta)\varphi' = 0",
            printed=third,
            check=rules.THIRD_EQUATION,
        ),
        Statement(
            id="couple-M1-zero-cases",
            section=SECTION,
            label="-",
            claim="If M_1 = M_2 = 0 the bending couples vanish, and theta = 0 or phi is constant.",
            latex=r"M_1 = M_2 = 0 \implies m_1 = m_2 = 0,\; \sin\theta\,\varphi' = 0",
            printed=Implies(
                none,
                Every(equal(m[1], 0), equal(m[2], 0), equal(sp.sin(theta) * Prime(phi), 0)),
            ),
            check=rules.NoBending(),
            note="theta is constant, so one of the two cases holds along the whole rod.",
        ),
    )


def _twisted() -> tuple[Statement, ...]:
    check = OfState(rules.TWISTED)
    return (
        Statement(
            id="twist-u12",
            section=SECTION,
            label="-",
            claim="Twisted state: no flexure.",
            latex=r"u_1 = u_2 = 0",
            **exactly(check, equal(u[1], u[2], 0)),
        ),
        Statement(
            id="twist-u3",
            section=SECTION,
            label="eq:TTu3M",
            claim="Twisted state: the twist.",
            latex=rf"u_3 = {_F_TEX} \frac{{\eta^2 M_3}}{{{_D_TEX}}}",
            printed=equal(u[3], _factor * eta**2 * M[3] / _D),
            check=check,
        ),
        Statement(
            id="twist-v12",
            section=SECTION,
            label="-",
            claim="Twisted state: no shear.",
            latex=r"v_1 = v_2 = 0",
            **exactly(check, equal(v[1], v[2], 0)),
        ),
        Statement(
            id="twist-v3",
            section=SECTION,
            label="-",
            claim="Twisted state: the dilatation strain less one.",
            latex=rf"v_3 - 1 = {_V3_TEX}",
            printed=equal(v[3] - 1, _factor * -iota * M[3] / _D),
            check=check,
        ),
    )


def _directors() -> tuple[Statement, ...]:
    angle = u[3] * s + psi_0
    rows = (
        ("twist-d1", "first", d1,
         (sp.cos(theta) * sp.cos(angle), sp.sin(angle), -sp.sin(theta) * sp.cos(angle)),
         (r"\boldsymbol d_1(s) = \cos\theta\cos(u_3 s + \psi(0)) \boldsymbol g_1"
          r" + \sin(u_3 s + \psi(0)) \boldsymbol g_2"
          r" - \sin\theta\cos(u_3 s + \psi(0)) \boldsymbol g_3")),
        ("twist-d2", "second", d2,
         (-sp.cos(theta) * sp.sin(angle), sp.cos(angle), sp.sin(theta) * sp.sin(angle)),
         (r"\boldsymbol d_2(s) = -\cos\theta\sin(u_3 s + \psi(0)) \boldsymbol g_1"
          r" + \cos(u_3 s + \psi(0)) \boldsymbol g_2"
          r" + \sin\theta\sin(u_3 s + \psi(0)) \boldsymbol g_3")),
        ("twist-d3", "third", d3, (sp.sin(theta), sp.Integer(0), sp.cos(theta)),
         r"\boldsymbol d_3(s) = \sin\theta\, \boldsymbol g_1 + \cos\theta\, \boldsymbol g_3"),
    )  # fmt: skip
    check = OfState(rules.TWISTED)
    line = (
        equal(r_s[2] * d3[3], r_s[3] * d3[2]), equal(r_s[3] * d3[1], r_s[1] * d3[3]),
        equal(r_s[1] * d3[2], r_s[2] * d3[1]),
    )  # fmt: skip
    return (
        Statement(
            id="twist-centerline",
            section=SECTION,
            label="-",
            claim="Twisted state: d_3 is constant and the center line is parallel to it.",
            latex=r"\boldsymbol d_3' = \boldsymbol 0, \quad \boldsymbol r' \times \boldsymbol d_3"
            r" = \boldsymbol 0",
            **exactly(
                OfState((*rules.TWISTED, *rules.TURNED)),
                Every(*(equal(d3_s[k], 0) for k in (1, 2, 3)), *line),
            ),
        ),
        *(
            Statement(
                id=name,
                section=SECTION,
                label="-",
                claim=f"Twisted state: the {which} director.",
                latex=latex,
                **exactly(check, Every(*(equal(base[k], e) for k, e in enumerate(vector, 1)))),
                note="At theta = 0 only phi + psi is determined, and the formula holds for "
                "every phi(s) with phi(0) = 0.",
            )
            for name, which, base, vector, latex in rows
        ),
    )


def _length() -> tuple[Statement, ...]:
    elongation = v[3] - 1
    elongates = (
        Iff(positive(-iota * M[3]), positive(v[3] - 1)),
        Iff(positive(iota * M[3]), positive(1 - v[3])),
    )
    return (
        Statement(
            id="twist-length",
            section=SECTION,
            label="-",
            claim="The length of the twisted rod, less one.",
            latex=r"\int_0^1 |\boldsymbol r'(s)|\,ds - 1 = v_3 - 1 = " + _V3_TEX,
            printed=equal(
                sp.Integral(length, (s, 0, 1)) - 1, elongation, _factor * -iota * M[3] / _D
            ),
            check=states.OnTwisted(stretched=True),
            reading="What is given is the change of length, not the length, and |r'| = v_3 needs "
            "v_3 > 0 (required of all configurations in Section 2.1). The law alone does not "
            "ensure it: with beta = eta = 1, iota = 9/10 and p = 2 the strain v_3 tends to "
            "1 - 9/sqrt(19) < 0 as M_3 grows. See extra-twist-v3-positive.",
        ),
        Statement(
            id="extra-twist-v3-positive",
            section=SECTION,
            label="-",
            claim="The least v_3 that a couple about d_3 can approach is positive if and only if "
            "iota^2 (1 + eta^2) < beta^2 eta^4.",
            latex=r"\inf_{M_3} v_3 = 1 - \frac{|\iota|}{\eta(\beta^2\eta^2 - \iota^2)^{1/2}} > 0"
            r" \iff \iota^2(1 + \eta^2) < \beta^2\eta^4",
            printed=Iff(
                positive(1 - sp.Abs(iota) / (eta * sp.sqrt(_D))),
                positive(beta**2 * eta**4 - iota**2 * (1 + eta**2)),
            ),
            check=Routed(states.LEAST_STRETCH, measured.LEAST_STRETCH),
            note="At equality v_3 > 0 for every couple, and the infimum 0 is not reached. Weaker "
            "than the paper's condition for all loads, beta^2 + iota^2 < beta^2 eta^2.",
        ),
        Statement(
            id="twist-poynting",
            section=SECTION,
            label="-",
            claim="A couple about d_3 changes the length of a chiral rod; it elongates the rod "
            "exactly if -iota M_3 > 0, and shortens it if iota M_3 > 0.",
            latex=r"\iota \neq 0 \implies |\boldsymbol r'| - 1 \neq 0, \quad "
            r"-\iota M_3 > 0 \iff v_3 - 1 > 0, \quad \iota M_3 > 0 \iff 1 - v_3 > 0",
            printed=Every(Implies(sp.Ne(iota, 0), sp.Ne(length - 1, 0)), *elongates),
            read_as=Every(Implies(sp.Ne(iota * M[3], 0), sp.Ne(length - 1, 0)), *elongates),
            check=Routed(states.OnTwisted(stretched=True), measured.TWISTED),
            reading="M_3 is not 0, and v_3 > 0 (required of all configurations in Section 2.1, and "
            "not ensured by the law, see twist-length). For M_3 = 0 nothing changes whatever iota; "
            "with v_3 = -1, which the law reaches under a finite couple if |iota| > 2 eta "
            "(beta^2 eta^2 - iota^2)^{1/2}, |r'| is 1 again. The couple that elongates, "
            "-iota M_3 > 0, needs neither.",
        ),
    )


def _limits() -> tuple[Statement, ...]:
    def at(sign: int, strain: sp.Expr) -> LimitOf:
        return LimitOf(strain, M[3], sign * sp.oo)

    root = _D ** sp.Rational(-1, 2)
    return (
        Statement(
            id="twist-limit-u3",
            section=SECTION,
            label="-",
            claim="Twisted state: the twist for an infinite couple.",
            latex=rf"\lim_{{M_3 \to \pm\infty}} u_3 = \pm\eta({_D_TEX})^{{-1/2}}",
            printed=Every(equal(at(1, u[3]), eta * root), equal(at(-1, u[3]), -eta * root)),
            check=states.TWIST_LIMITS,
        ),
        Statement(
            id="twist-limit-v3",
            section=SECTION,
            label="-",
            claim="Twisted state: the dilatation strain less one for an infinite couple.",
            latex=r"\lim_{M_3 \to \pm\infty} (v_3 - 1) = \mp\frac{\iota}{\eta}"
            rf"({_D_TEX})^{{-1/2}}",
            printed=Every(
                equal(at(1, v[3] - 1), -iota / eta * root),
                equal(at(-1, v[3] - 1), iota / eta * root),
            ),
            check=states.TWIST_LIMITS,
            note="Nonzero, as the paper says of it, only for a chiral rod (iota != 0).",
        ),
    )
