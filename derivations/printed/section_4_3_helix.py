"""Section 4.3, isolated couples: helices and circles, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.couple import equations as rules
from rodproof.derivations.checks.couple import states
from rodproof.derivations.checks.couple.domains import OfState
from rodproof.derivations.checks.couple.route import (
    curvature,
    m_g,
    pitch,
    r,
    r_s,
    radius,
    torsion,
)
from rodproof.derivations.checks.routes import states as measured
from rodproof.derivations.notation import (
    Every,
    Iff,
    LimitOf,
    Partial,
    Prime,
    chain,
    equal,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.exactly import exactly
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, iota, p
from rodproof.derivations.theory.couple import psi_0, s
from rodproof.derivations.theory.frames import phi, psi, theta

SECTION = "4.3"

M = sp.IndexedBase("M", real=True)
_D = beta**2 * eta**2 - iota**2
_D_TEX = r"\beta^2 \eta^2 - \iota^2"
_helix = (1 + sp.Abs(M[1]) ** p * (1 / alpha**2 + eta**2 / _D * sp.cot(theta) ** 2) ** (p / 2)) ** (
    -1 / p
)
_H_TEX = (
    r"\Bigl[ 1 + |M_1|^p \Bigl( \frac{1}{\alpha^2} + \frac{\eta^2}{" + _D_TEX
    + r"} \cot^2\theta \Bigr)^{p/2} \Bigr]^{-1/p}"
)  # fmt: skip
_circle = (1 + sp.Abs(M[1]) ** p * alpha ** (-p)) ** (-1 / p)
_C_TEX = r"\Bigl( 1 + |M_1|^p \alpha^{-p} \Bigr)^{-1/p}"


def statements() -> tuple[Statement, ...]:
    """The statements on helices and circles, in the order of the paper."""
    return (*_angles(), *_strains(), *_center_line(), *_circle_line(), *_pure_bending())


def _angles() -> tuple[Statement, ...]:
    check = OfState(rules.HELICES)
    turn = -_helix * M[1] * sp.csc(theta) * s
    spin = -(1 - _D / (alpha**2 * eta**2)) * _helix * eta**2 / _D * M[1] * sp.cot(theta) * s + psi_0
    return (
        Statement(
            id="M1-zero-remark",
            section=SECTION,
            label="-",
            claim="sin(theta) phi' vanishes somewhere if and only if M_1 = 0.",
            latex=r"\exists s\colon \sin\theta\,\varphi'(s) = 0 \iff M_1 = 0",
            printed=Iff(equal(sp.sin(theta) * Prime(phi), 0), equal(M[1], 0)),
            check=Routed(rules.TURNING_ZERO, measured.ZEROS),
            note="The equivalence holds at each s, and M_1 is constant along the rod.",
        ),
        Statement(
            id="helix-M3",
            section=SECTION,
            label="-",
            claim="Helical state: M_3 from M_1, and the range of theta.",
            latex=r"M_3 = -M_1 \cot\theta, \quad \theta \in (0, \pi/2]",
            printed=Every(
                equal(M[3], -M[1] * sp.cot(theta)), chain(0, "<", theta, "<=", sp.pi / 2)
            ),
            check=rules.HelixCouple(),
            note="Assumed in the paper; it follows from M_1 != 0.",
        ),
        Statement(
            id="extra-helix-axis",
            section=SECTION,
            label="-",
            claim="The couple of a helical state is along the axis of the helix.",
            latex=r"\boldsymbol m = -\frac{M_1}{\sin\theta} \boldsymbol g_3",
            **exactly(
                check,
                Every(equal(m_g[1], 0), equal(m_g[2], 0), equal(m_g[3], -M[1] / sp.sin(theta))),
            ),
            note="Each M_1 != 0 and each theta in (0, pi/2] give one, so the helices under a "
            "couple are a family of two parameters; m = M_3/cos(theta) g_3 below a right angle.",
        ),
        Statement(
            id="helix-phi",
            section=SECTION,
            label="-",
            claim="Helical state: the angle phi.",
            latex=rf"\varphi(s) = -{_H_TEX} M_1 (\csc\theta) s",
            printed=equal(phi, turn),
            check=check,
            correction=equal(phi, turn / alpha**2),
            note="A factor 1/alpha^2 is missing: phi' = -u M_1/sin(theta) and u contains it. With "
            "the printed phi the strains u_1, u_2 printed below do not follow, and the circle "
            "printed for theta = pi/2, which has the factor, contradicts it.",
        ),
        Statement(
            id="helix-psi",
            section=SECTION,
            label="-",
            claim="Helical state: the angle psi.",
            latex=rf"\psi(s) = -\Bigl( 1 - \frac{{{_D_TEX}}}{{\alpha^2\eta^2}} \Bigr) {_H_TEX}"
            rf" \times \frac{{\eta^2}}{{{_D_TEX}}} M_1 (\cot\theta) s + \psi(0)",
            printed=equal(psi, spin),
            check=check,
        ),
    )


def _strains() -> tuple[Statement, ...]:
    check = OfState(rules.HELICES)
    axial = rf"\frac{{\eta^2}}{{{_D_TEX}}} M_1 \cot\theta"
    return (
        Statement(
            id="helix-u1",
            section=SECTION,
            label="-",
            claim="Helical state: first flexural strain.",
            latex=rf"u_1 = {_H_TEX} \frac{{1}}{{\alpha^2}} M_1 \cos\psi(s)",
            printed=equal(u[1], _helix / alpha**2 * M[1] * sp.cos(psi)),
            check=check,
        ),
        Statement(
            id="helix-u2",
            section=SECTION,
            label="-",
            claim="Helical state: second flexural strain.",
            latex=rf"u_2 = -{_H_TEX} \frac{{1}}{{\alpha^2}} M_1 \sin\psi(s)",
            printed=equal(u[2], -_helix / alpha**2 * M[1] * sp.sin(psi)),
            check=check,
        ),
        Statement(
            id="helix-u3",
            section=SECTION,
            label="-",
            claim="Helical state: the twist.",
            latex=rf"u_3 = -{_H_TEX} {axial}",
            printed=equal(u[3], -_helix * eta**2 / _D * M[1] * sp.cot(theta)),
            check=check,
        ),
        Statement(
            id="helix-v12",
            section=SECTION,
            label="-",
            claim="Helical state: no shear.",
            latex=r"v_1 = v_2 = 0",
            **exactly(check, equal(v[1], v[2], 0)),
        ),
        Statement(
            id="helix-v3",
            section=SECTION,
            label="-",
            claim="Helical state: the dilatation strain less one.",
            latex=rf"v_3 - 1 = {_H_TEX} \frac{{\iota}}{{{_D_TEX}}} M_1 \cot\theta",
            printed=equal(v[3] - 1, _helix * iota / _D * M[1] * sp.cot(theta)),
            check=check,
        ),
    )


def _center_line() -> tuple[Statement, ...]:
    def tangent(second: sp.Expr) -> Every:
        across = v[3] * sp.sin(theta)
        return Every(
            equal(r_s[1], across * sp.cos(phi)), equal(r_s[2], across * second),
            equal(r_s[3], v[3] * sp.cos(theta)),
        )  # fmt: skip

    shape = states.OnShapes()
    tilt = v[3] * sp.cos(theta)
    d3 = (sp.sin(theta) * sp.cos(phi), sp.sin(theta) * sp.sin(phi), sp.cos(theta))
    return (
        Statement(
            id="helix-tangent",
            section=SECTION,
            label="-",
            claim="Helical state: the center line is tangent to d_3.",
            latex=r"\boldsymbol r' \times \boldsymbol d_3 = \boldsymbol 0",
            printed=Every(
                *(
                    equal(r_s[i] * d3[j - 1], r_s[j] * d3[i - 1])
                    for i, j in ((1, 2), (2, 3), (3, 1))
                )
            ),
            check=OfState(rules.HELICES),
        ),
        Statement(
            id="helix-rprime",
            section=SECTION,
            label="eq:rprimehelix",
            claim="Helical state: the tangent of the center line in the fixed basis.",
            latex=r"\boldsymbol r' = v_3 \sin\theta\cos\varphi(s)\, \boldsymbol g_1 + v_3"
            r"\sin\theta\cos\varphi(s)\, \boldsymbol g_2 + v_3 \cos\theta\, \boldsymbol g_3",
            printed=tangent(sp.cos(phi)),
            check=OfState(rules.HELICES),
            correction=tangent(sp.sin(phi)),
            note="A sine is misprinted as a cosine; the printed curve would lie in a plane.",
        ),
        Statement(
            id="helix-handedness",
            section=SECTION,
            label="-",
            claim="The center line is a right-handed helix: its torsion is positive.",
            latex=r"\tau > 0",
            printed=positive(torsion),
            check=shape,
            correction=Iff(positive(torsion), positive(-M[1])),
            note="tau = phi' cos(theta)/v_3, and phi' has the sign of -M_1. For theta < pi/2 the "
            "helix is right-handed if M_1 < 0 (which is M_3 > 0) and left-handed if M_1 > 0.",
        ),
        Statement(
            id="helix-radius",
            section=SECTION,
            label="-",
            claim="Radius of the helix.",
            latex=r"a = \frac{v_3 \sin\theta}{\varphi'}",
            check=shape,
            printed=equal(radius, v[3] * sp.sin(theta) / Prime(phi)),
            correction=equal(radius, v[3] * sp.sin(theta) / sp.Abs(Prime(phi))),
            note="phi' < 0 for M_1 > 0, and the printed radius is then negative. v_3 > 0, as "
            "Section 2 asks.",
        ),
        Statement(
            id="helix-pitch",
            section=SECTION,
            label="-",
            claim="Pitch of the helix.",
            latex=r"b = v_3 \cos\theta",
            printed=equal(pitch, tilt),
            check=shape,
            correction=equal(pitch, 2 * sp.pi * tilt / sp.Abs(Prime(phi))),
            note="v_3 cos(theta) is the rise per unit of reference length, not per turn; the rise "
            "per radian is v_3 cos(theta)/|phi'|, so the print is wrong in that reading as well.",
        ),
        Statement(
            id="extra-helix-curvature",
            section=SECTION,
            label="-",
            claim="Curvature and torsion of the helix.",
            latex=r"\kappa = \frac{|\varphi'| \sin\theta}{v_3}, \quad \tau = \frac{\varphi'"
            r"\cos\theta}{v_3}",
            printed=Every(
                equal(curvature, sp.Abs(Prime(phi)) * sp.sin(theta) / v[3]),
                equal(torsion, Prime(phi) * sp.cos(theta) / v[3]),
            ),
            check=shape,
        ),
    )


def _circle_line() -> tuple[Statement, ...]:
    size = alpha**2 / M[1] * (1 + sp.Abs(M[1]) ** p * alpha ** (-p)) ** (1 / p)
    angle = _circle * alpha**-2 * M[1] * s
    size_tex = r"\Bigl( 1 + |M_1|^p \alpha^{-p} \Bigr)^{1/p} \alpha^2 M_1^{-1}"
    angle_tex = rf"\Bigl( {_C_TEX} \alpha^{{-2}} M_1 s \Bigr)"
    return (
        Statement(
            id="circle-claim", section=SECTION, label="-",
            claim="For theta = pi/2 the center line runs on a circle in the plane of g_1 and g_2.",
            latex=r"\theta = \pi/2 \implies \boldsymbol r' \cdot \boldsymbol g_3 = 0,\; \tau = 0,\;"
            r" \kappa' = 0,\; \kappa > 0",
            **exactly(states.OnShapes(circle=True), Every(
                equal(M[3], 0), equal(r_s[3], 0), equal(torsion, 0),
                equal(Partial(curvature, s), 0), positive(curvature),
            )),
            note="An arc of a circle; the whole of it, or more, if |phi'| >= 2 pi.",
        ),
        Statement(
            id="circle-r", section=SECTION, label="-", claim="The center line for theta = pi/2.",
            latex=rf"\boldsymbol r(s) = {size_tex} \sin{angle_tex} \boldsymbol g_1"
            rf" + {size_tex} \cos{angle_tex} \boldsymbol g_2",
            printed=Every(
                equal(r[1], size * sp.sin(angle)), equal(r[2], size * sp.cos(angle)),
                equal(r[3], 0),
            ),
            check=states.CenterLine(rules.CIRCLES),
            reading="The origin is put at the center of the circle, a translation that the paper "
            "does not mention: equilibrium gives r' only. As printed r(0) is "
            "(1 + |M_1|^p alpha^{-p})^{1/p} alpha^2/M_1 g_2, not o.",
        ),
    )  # fmt: skip


def _pure_bending() -> tuple[Statement, ...]:
    check = OfState(rules.CIRCLES)
    first = _circle / alpha**2 * M[1] * sp.cos(psi_0)
    second = -_circle / alpha**2 * M[1] * sp.sin(psi_0)

    def at(sign: int, value: sp.Expr) -> LimitOf:
        return LimitOf(value, M[1], sign * sp.oo)

    bend = sp.sqrt(u[1] ** 2 + u[2] ** 2)
    return (
        Statement(
            id="circle-u1",
            section=SECTION,
            label="-",
            claim="Pure bending: first flexural strain.",
            latex=rf"u_1 = {_C_TEX} \frac{{1}}{{\alpha^2}} M_1 \cos\psi(0)",
            printed=equal(u[1], first),
            check=check,
        ),
        Statement(
            id="circle-u2",
            section=SECTION,
            label="-",
            claim="Pure bending: second flexural strain.",
            latex=rf"u_2 = -{_C_TEX} \frac{{1}}{{\alpha^2}} M_1 \sin\psi(0)",
            printed=equal(u[2], second),
            check=check,
        ),
        Statement(
            id="circle-u3",
            section=SECTION,
            label="-",
            claim="Pure bending: no twist.",
            latex=r"u_3 = 0",
            **exactly(check, equal(u[3], 0)),
        ),
        Statement(
            id="circle-v",
            section=SECTION,
            label="-",
            claim="Pure bending: no shear and no dilatation.",
            latex=r"v_1 = v_2 = v_3 - 1 = 0",
            **exactly(check, equal(v[1], v[2], v[3] - 1, 0)),
        ),
        Statement(
            id="circle-limit-u1",
            section=SECTION,
            label="-",
            claim="Pure bending: first flexural strain for an infinite couple.",
            latex=r"\lim_{M_1 \to \pm\infty} u_1 = \pm\frac1\alpha \cos\psi(0)",
            printed=Every(
                *(equal(at(sign, u[1]), sign * sp.cos(psi_0) / alpha) for sign in (1, -1))
            ),
            check=states.CIRCLE_LIMITS,
        ),
        Statement(
            id="circle-limit-u2",
            section=SECTION,
            label="-",
            claim="Pure bending: second flexural strain for an infinite couple.",
            latex=r"\lim_{M_1 \to \pm\infty} u_2 = \mp\frac1\alpha \sin\psi(0)",
            printed=Every(
                *(equal(at(sign, u[2]), -sign * sp.sin(psi_0) / alpha) for sign in (1, -1))
            ),
            check=states.CIRCLE_LIMITS,
        ),
        Statement(
            id="circle-limit-curvature",
            section=SECTION,
            label="-",
            claim="Pure bending: the curvature for an infinite couple.",
            latex=r"\lim_{M_1 \to \pm\infty} (u_1^2 + u_2^2)^{1/2} = \frac1\alpha",
            **exactly(
                states.CIRCLE_LIMITS, Every(*(equal(at(sign, bend), 1 / alpha) for sign in (1, -1)))
            ),
            note="The flexure is the curvature of the center line here, as v_3 = 1.",
        ),
    )
