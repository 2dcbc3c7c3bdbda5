"""Section 4.1, Euler angles and reduced equations: every printed statement, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.euler import (
    CLOSED,
    MOVING_LOADS,
    N_,
    OFF_BALANCE,
    STATES,
    UNIT_LOADS,
    B,
    J,
    L,
    M,
    N,
    d,
    e,
    g,
    m_vector,
    n_vector,
    q,
    u_scalar,
    v_scalar,
)
from rodproof.derivations.notation import (
    Chain,
    Cross,
    Dot,
    Every,
    Prime,
    Qstar,
    Wstar,
    equal,
    m,
    mu,
    n,
    u,
    v,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, iota, p, zeta
from rodproof.derivations.theory.euler import theta_s
from rodproof.derivations.theory.frames import phi, psi, theta

SECTION = "4.1"
_STATES = Identity(STATES)
_sin, _cos = sp.sin, sp.cos
_level = _cos(phi) * g[1] + _sin(phi) * g[2]  # the horizontal direction of d_3
_LEVEL_TEX = r"(\cos\varphi\,\boldsymbol g_1 + \sin\varphi\,\boldsymbol g_2)"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (
        *_frames(),
        *_loads(),
        *_strains(),
        *_law(),
        *_kinematic_equations(),
        *_balance_equations(),
        _closure(),
        *_first_integrals(),
    )


def _frames() -> tuple[Statement, ...]:
    return (
        Statement(
            id="euler-d3", section=SECTION, label="eq:d3eq", introduces=True,
            claim="Third director in spherical coordinates.",
            latex=rf"\boldsymbol d_3 = \sin\theta {_LEVEL_TEX} + \cos\theta\,\boldsymbol g_3",
            printed=equal(d[3], _sin(theta) * _level + _cos(theta) * g[3]), check=_STATES,
            note="Every unit vector has such angles; at the poles, where sin(theta) = 0, phi is "
            "arbitrary, and only psi + phi or psi - phi has a meaning.",
        ),
        Statement(
            id="euler-e3-e2", section=SECTION, label="-", introduces=True,
            claim="Third and second vector of the intermediate frame.",
            latex=r"\boldsymbol e_3 = \boldsymbol d_3, \quad \boldsymbol e_2 = -\sin\varphi\,"
            r"\boldsymbol g_1 + \cos\varphi\,\boldsymbol g_2",
            printed=Every(
                equal(e[3], d[3]), equal(e[2], -_sin(phi) * g[1] + _cos(phi) * g[2])
            ),
            check=_STATES,
        ),
        Statement(
            id="euler-e1", section=SECTION, label="-",
            claim="First vector of the intermediate frame.",
            latex=r"\boldsymbol e_1 = \boldsymbol e_2 \times \boldsymbol e_3 = \cos\theta "
            rf"{_LEVEL_TEX} - \sin\theta\,\boldsymbol g_3",
            printed=equal(
                e[1], Cross(e[2], e[3]), _cos(theta) * _level - _sin(theta) * g[3]
            ),
            check=_STATES,
        ),
        Statement(
            id="euler-d1", section=SECTION, label="eq:d1eq", introduces=True,
            claim="First director in the intermediate frame; introduces psi.",
            latex=r"\boldsymbol d_1 = \cos\psi\,\boldsymbol e_1 + \sin\psi\,\boldsymbol e_2",
            printed=equal(d[1], _cos(psi) * e[1] + _sin(psi) * e[2]), check=_STATES,
        ),
        Statement(
            id="euler-d2", section=SECTION, label="eq:d2eq",
            claim="Second director in the intermediate frame.",
            latex=r"\boldsymbol d_2 = -\sin\psi\,\boldsymbol e_1 + \cos\psi\,\boldsymbol e_2",
            printed=equal(d[2], -_sin(psi) * e[1] + _cos(psi) * e[2]), check=_STATES,
            note="With d_1 given it must be d_3 x d_1, as the directors are right-handed.",
        ),
    )  # fmt: skip


def _loads() -> tuple[Statement, ...]:
    rows: tuple[tuple[str, str, str, str, Chain], ...] = (
        ("euler-M1", "eq:M1eq", "First component of the couple in the intermediate frame.",
         r"M_1 = m_1 \cos\psi - m_2 \sin\psi",
         equal(M[1], m[1] * _cos(psi) - m[2] * _sin(psi))),
        ("euler-M2", "eq:M2eq", "Second component of the couple in the intermediate frame.",
         r"M_2 = m_1 \sin\psi + m_2 \cos\psi",
         equal(M[2], m[1] * _sin(psi) + m[2] * _cos(psi))),
        ("euler-M3", "eq:M3eq", "Third component of the couple in the intermediate frame.",
         r"M_3 = m_3", equal(M[3], m[3])),
        ("euler-N1", "eq:N1eq", "First component of the force in the intermediate frame.",
         r"N_1 = -N \sin\theta", equal(N_[1], -N * _sin(theta))),
        ("euler-N2", "eq:N2eq", "Second component of the force in the intermediate frame.",
         r"N_2 = 0", equal(N_[2], 0)),
        ("euler-N3", "eq:N3eq", "Third component of the force in the intermediate frame.",
         r"N_3 = N \cos\theta", equal(N_[3], N * _cos(theta))),
    )  # fmt: skip
    force = (
        -N * _sin(theta) * _cos(psi) * d[1] + N * _sin(theta) * _sin(psi) * d[2]
        + N * _cos(theta) * d[3]
    )  # fmt: skip
    return (
        Statement(
            id="euler-n", section=SECTION, label="eq:nsoln",
            claim="The force N g_3 expanded in the directors.",
            latex=r"\boldsymbol n = -N \sin\theta \cos\psi\,\boldsymbol d_1 + N \sin\theta "
            r"\sin\psi\,\boldsymbol d_2 + N \cos\theta\,\boldsymbol d_3",
            printed=equal(n_vector, force), check=_STATES,
        ),
        *(
            Statement(
                id=name, section=SECTION, label=label, claim=claim, latex=latex,
                printed=printed, check=_STATES,
            )
            for name, label, claim, latex, printed in rows
        ),
    )  # fmt: skip


def _strains() -> tuple[Statement, ...]:
    turning = Prime(phi) * _sin(theta)
    return (
        Statement(
            id="euler-u1", section=SECTION, label="eq:u1angle",
            claim="First flexural strain in terms of the Euler angles.",
            latex=r"u_1 = \theta' \sin\psi - \varphi' \sin\theta \cos\psi",
            printed=equal(u[1], Prime(theta) * _sin(psi) - turning * _cos(psi)), check=_STATES,
        ),
        Statement(
            id="euler-u2", section=SECTION, label="eq:u2angle",
            claim="Second flexural strain in terms of the Euler angles.",
            latex=r"u_2 = \theta_s \cos\psi + \varphi' \sin\theta \sin\psi",
            printed=equal(u[2], theta_s * _cos(psi) + turning * _sin(psi)),
            read_as=equal(u[2], Prime(theta) * _cos(psi) + turning * _sin(psi)),
            check=_STATES,
            reading="theta_s, which the paper does not define, is the derivative theta' of the "
            "neighbouring formula; with any other meaning nothing follows.",
        ),
        Statement(
            id="euler-u3", section=SECTION, label="eq:u3angle",
            claim="Twist in terms of the Euler angles.",
            latex=r"u_3 = \psi' + \varphi' \cos\theta",
            printed=equal(u[3], Prime(psi) + Prime(phi) * _cos(theta)), check=_STATES,
        ),
    )  # fmt: skip


def _law() -> tuple[Statement, ...]:
    factor = (1 + Qstar(m, n) ** (p / 2)) ** (-1 / p)
    factor_tex = r"\Bigl(1 + Q^*(\mathsf m, \mathsf n)^{p/2}\Bigr)^{-1/p}"
    law = Identity(UNIT_LOADS)
    return (
        Statement(
            id="scalar-u", section=SECTION, label="-", introduces=True,
            claim="Scalar factor between bending couples and flexural strains.",
            latex=rf"u = {factor_tex} \frac{{1}}{{\alpha^2}}",
            printed=equal(u_scalar, factor / alpha**2), check=law,
        ),
        Statement(
            id="scalar-v", section=SECTION, label="-", introduces=True,
            claim="Scalar factor between shear forces and shear strains.",
            latex=rf"v = {factor_tex} \frac{{1}}{{\zeta^2}}",
            printed=equal(v_scalar, factor / zeta**2), check=law,
        ),
        Statement(
            id="scalar-uv-relations", section=SECTION, label="-",
            claim="Flexural and shear strains are the scalar factors times their loads.",
            latex=r"u_\mu = u \cdot m_\mu, \quad v_\mu = v \cdot n_\mu",
            printed=Every(equal(u[mu], u_scalar * m[mu]), equal(v[mu], v_scalar * n[mu])),
            check=law,
        ),
    )  # fmt: skip


def _kinematic_equations() -> tuple[Statement, ...]:
    return (
        Statement(
            id="ode-phi", section=SECTION, label="eq:phiseq",
            claim="First-order equation for phi.",
            latex=r"\sin\theta\,\varphi' = -u M_1",
            printed=equal(_sin(theta) * Prime(phi), -u_scalar * M[1]), check=_STATES,
        ),
        Statement(
            id="ode-theta", section=SECTION, label="eq:thetaseq",
            claim="First-order equation for theta.",
            latex=r"\theta' = -u M_2",
            printed=equal(Prime(theta), -u_scalar * M[2]), check=_STATES,
            correction=equal(Prime(theta), u_scalar * M[2]),
            note="u_1 sin(psi) + u_2 cos(psi) is theta' by the printed strains and u M_2 by the "
            "printed components of the couple: the sign is wrong in this line alone. With it the "
            "balance of couples along e_3 would give M_3' = -2 u M_1 M_2 in place of 0.",
        ),
        Statement(
            id="ode-psi", section=SECTION, label="eq:psiseq",
            claim="First-order equation for psi.",
            latex=r"\psi' + \cos\theta\,\varphi' = u_3",
            printed=equal(Prime(psi) + _cos(theta) * Prime(phi), u[3]), check=_STATES,
        ),
    )  # fmt: skip


def _balance_along_e2() -> tuple[sp.Expr, sp.Expr]:
    turned = Prime(M[2]) + (M[1] * _cos(theta) + M[3] * _sin(theta)) * Prime(phi)
    return turned, N * v[3] * _sin(theta) - N**2 * v_scalar * _cos(theta) * _sin(theta)


def _balance_equations() -> tuple[Statement, ...]:
    first = Prime(M[1]) - M[2] * _cos(theta) * Prime(phi) + Prime(theta) * M[3]
    return (
        Statement(
            id="ode-M1", section=SECTION, label="eq:M1seq",
            claim="Balance of couples along e_1.",
            latex=r"M_1' - M_2 \cos\theta\,\varphi' + \theta' M_3 = 0",
            printed=equal(first, 0), check=_STATES,
        ),
        Statement(
            id="ode-M2", section=SECTION, label="eq:M2seq",
            claim="Balance of couples along e_2.",
            latex=r"M_2' + (M_1 \cos\theta + M_3 \sin\theta)\varphi' = N v_3 \sin\theta - N^2 v "
            r"\cos\theta \sin\theta",
            printed=equal(*_balance_along_e2()), check=_STATES,
        ),
        Statement(
            id="ode-M3", section=SECTION, label="eq:M3seq",
            claim="Balance of couples along e_3.",
            latex=r"M_3' = 0", printed=equal(Prime(M[3]), 0), check=_STATES,
            note="The balance alone reads M_3' = theta' M_1 + sin(theta) phi' M_2; it is zero "
            "because the law bends the rod in the plane of the bending couple.",
        ),
    )  # fmt: skip


def _closure() -> Statement:
    gap = beta**2 * eta**2 - iota**2
    tension = N * _cos(theta)
    factor = (1 + q ** (p / 2)) ** (-1 / p)
    form = (
        (M[1] ** 2 + M[2] ** 2) / alpha**2 + N**2 * _sin(theta) ** 2 / zeta**2
        + (eta**2 * M[3] ** 2 + beta**2 * tension**2 - 2 * iota * M[3] * tension) / gap
    )  # fmt: skip
    return Statement(
        id="six-equations", section=SECTION, label="-",
        claim="The six equations are a closed system for the three angles and three couples.",
        latex=r"\begin{aligned} &J = \sin\theta, \quad f = (1 + q^{p/2})^{-1/p}, \quad u = "
        r"\frac{f}{\alpha^2}, \quad v = \frac{f}{\zeta^2},\\ &q = \frac{M_1^2 + M_2^2}{\alpha^2} "
        r"+ \frac{N^2 \sin^2\theta}{\zeta^2} + \frac{\eta^2 M_3^2 + \beta^2 N^2 \cos^2\theta - "
        r"2\iota M_3 N \cos\theta}{\beta^2\eta^2 - \iota^2},\\ &u_3 = f \frac{\eta^2 M_3 - "
        r"\iota N \cos\theta}{\beta^2\eta^2 - \iota^2}, \quad v_3 - 1 = f \frac{-\iota M_3 + "
        r"\beta^2 N \cos\theta}{\beta^2\eta^2 - \iota^2} \end{aligned}",
        printed=Every(
            equal(J, _sin(theta)),
            equal(q, form),
            equal(u_scalar, factor / alpha**2),
            equal(v_scalar, factor / zeta**2),
            equal(u[3], factor * (eta**2 * M[3] - iota * tension) / gap),
            equal(v[3] - 1, factor * (-iota * M[3] + beta**2 * tension) / gap),
        ),
        check=Identity(CLOSED),
        reading="u, v, u_3 and v_3 must be read as functions of theta and M_k by the law (phi and "
        "psi drop out of Q*, here q), and sin(theta) must not be zero: J, the determinant of the "
        "coefficients of the six derivatives, is sin(theta). Where sin(theta) = 0 on an interval "
        "phi is not determined: theta = 0, M_1 = M_2 = 0, M_3 constant and psi = u_3 s - phi(s) "
        "solve all six for every function phi(s).",
    )  # fmt: skip


def _first_integrals() -> tuple[Statement, ...]:
    axial = -M[1] * _sin(theta) + M[3] * _cos(theta)
    left, right = _balance_along_e2()
    return (
        Statement(
            id="extra-equations-are-equilibrium", section=SECTION, label="-",
            claim="The six equations, theta' = u M_2 corrected, say the same as law and balance: "
            "their residuals are those of kinematics (L) and balance (B), turned by a matrix of "
            "determinant of size 1.",
            latex=r"\sin\theta\,\varphi' + u M_1 = -L_1,\ \theta' - u M_2 = L_2,\ \psi' + "
            r"\cos\theta\,\varphi' - u_3 = L_3,\ \ldots,\ M_3' = B_3 + M_1 L_2 - M_2 L_1",
            printed=Every(
                equal(_sin(theta) * Prime(phi) + u_scalar * M[1], -L[1]),
                equal(Prime(theta) - u_scalar * M[2], L[2]),
                equal(Prime(psi) + _cos(theta) * Prime(phi) - u[3], L[3]),
                equal(
                    Prime(M[1]) - M[2] * _cos(theta) * Prime(phi) + Prime(theta) * M[3], B[1]
                ),
                equal(left - right, B[2]),
                equal(Prime(M[3]), B[3] + M[1] * L[2] - M[2] * L[1]),
            ),
            check=Identity(OFF_BALANCE),
            note="Holds at sin(theta) = 0 too: what solves the six equations there is an "
            "equilibrium, though they do not determine phi.",
        ),
        Statement(
            id="extra-first-integral-couple", section=SECTION, label="-",
            claim="The couple about the axis of the force is constant along the rod.",
            latex=r"\boldsymbol m \cdot \boldsymbol g_3 = -M_1 \sin\theta + M_3 \cos\theta, \quad "
            r"(\boldsymbol m \cdot \boldsymbol g_3)' = 0",
            printed=Every(
                equal(Dot(m_vector, g[3]), axial), equal(Prime(Dot(m_vector, g[3])), 0)
            ),
            check=_STATES,
            note="A second first integral beside M_3, for every law.",
        ),
        Statement(
            id="extra-first-integral-energy", section=SECTION, label="-",
            claim="W* + n . d_3 = W* + N cos(theta) is constant along every equilibrium without "
            "body loads.",
            latex=r"\bigl(W^*(\mathsf m, \mathsf n) + n_3\bigr)' = 0, \quad n_3 = N \cos\theta",
            printed=equal(Prime(Wstar(m, n) + n[3]), 0),
            check=Identity(MOVING_LOADS),
            note="The third first integral, of every uniform hyperelastic rod; it also equals "
            "m . u + n . v - W. With M_3 and m . g_3 it reduces the six equations to one "
            "quadrature for theta.",
        ),
    )  # fmt: skip
