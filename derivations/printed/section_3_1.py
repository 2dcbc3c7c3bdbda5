"""The statements of Section 3.1: quadratic forms, strains from loads, the strain limit."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import constitutive as rules
from rodproof.derivations.checks.domains import (
    ON_LOADS,
    ON_STRAINS,
)
from rodproof.derivations.checks.routes import constants
from rodproof.derivations.notation import (
    Every,
    Implies,
    PositiveDefinite,
    Q,
    Qstar,
    chain,
    equal,
    m,
    mu,
    n,
    positive,
    u,
    v,
)
from rodproof.derivations.printed import section_3_1_energies
from rodproof.derivations.printed.section_3_1_energies import (
    D_TEX,
    SECTION,
    STRAIN_TEX,
    D,
    strain_factor,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (
        *_columns(),
        *_three_dimensional_relation(),
        *_constants_and_forms(),
        *_strains_from_loads(),
        *_limits(),
        *section_3_1_energies.statements(),
    )


def _columns() -> tuple[Statement, ...]:
    column = {name: sp.IndexedBase(f"column_{name}", real=True) for name in "uvmn"}

    def columns(*pairs: tuple[str, sp.IndexedBase]) -> Every:
        return Every(*(equal(column[a][k], b[k]) for a, b in pairs for k in (1, 2, 3)))

    return (
        Statement(
            id="strain-columns",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Columns of the components of the strains u and v in the directors.",
            latex=r"\mathsf{u} = (u_1, u_2, u_3)^T, \quad \mathsf{v} = (v_1, v_2, v_3)^T",
            printed=columns(("u", u), ("v", v)),
            check=Identity(rules.COLUMNS),
        ),
        Statement(
            id="stress-columns",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Columns of the components of the contact couple and force in the directors.",
            latex=r"\mathsf{m} = (m_1, m_2, m_3)^T, \quad \mathsf{n} = (n_1, n_2, n_3)^T",
            printed=columns(("m", m), ("n", n)),
            check=Identity(rules.COLUMNS),
        ),
    )


def _three_dimensional_relation() -> tuple[Statement, ...]:
    a, b, T, e, B_inv = rules.a, rules.b, rules.T, rules.e, rules.B_inv
    pairs = [(i, j) for i in (1, 2, 3) for j in (1, 2, 3)]
    factor = (a ** (-p) + (b * rules.norm_T) ** p) ** (-1 / p)
    return (
        Statement(
            id="tb-relation",
            section=SECTION,
            label="eq:TB",
            introduces=True,
            claim="Three-dimensional strain-limiting relation that inspires the rod's law.",
            latex=r"\boldsymbol e = \Bigl(a^{-p} + |b \boldsymbol T|^p\Bigr)^{-1/p} \boldsymbol T",
            printed=Every(*(equal(e[i, j], factor * T[i, j]) for i, j in pairs)),
            check=Identity(rules.ON_STRESSES),
            note="Its scalar law is the rod's with gamma = 1/a and y = b|T|, so |e| < 1/b.",
        ),
        Statement(
            id="tb-hypotheses",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Range of the three constants of the three-dimensional relation.",
            latex="a, b, p > 0",
            printed=Every(positive(a), positive(b), positive(p)),
            check=rules.TB_RANGES,
            note="For every stress T to belong to a deformation, e = (I - B^{-1})/2 also needs "
            "eigenvalues below 1/2; under uniaxial tension that is b >= 2.",
        ),
        Statement(
            id="tb-almansi",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Definition of the Almansi-Hamel strain through the left Cauchy-Green tensor.",
            latex=r"\boldsymbol e = \tfrac12(\boldsymbol I - \boldsymbol B^{-1})",
            printed=Every(
                *(equal(e[i, j], ((1 if i == j else 0) - B_inv[i, j]) / 2) for i, j in pairs)
            ),
            check=Identity(rules.ON_DEFORMATIONS),
            note="It measures dx . e dx = (|dx|^2 - |dX|^2)/2, which is how it is derived here.",
        ),
        Statement(
            id="tb-norm",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Norm of the Cauchy stress.",
            latex=r"|\boldsymbol T|^2 = \operatorname{tr}(\boldsymbol T^2)",
            printed=equal(rules.norm_T**2, sp.Add(*(T[i, j] * T[j, i] for i, j in pairs))),
            check=Identity(rules.ON_STRESSES),
        ),
    )


def _form_of_strains() -> sp.Expr:
    return (
        alpha**2 * (u[1] ** 2 + u[2] ** 2) + beta**2 * u[3] ** 2
        + +(zeta**2) * (v[1] ** 2 + v[2] ** 2)
        + eta**2 * (v[3] - 1) ** 2 + 2 * iota * u[3] * (v[3] - 1)
    )  # fmt: skip


def _form_of_loads(shear: sp.IndexedBase) -> sp.Expr:
    return (
        (m[1] ** 2 + m[2] ** 2) / alpha**2 + (shear[1] ** 2 + shear[2] ** 2) / zeta**2
        + eta**2 / D * m[3] ** 2 + beta**2 / D * n[3] ** 2 - 2 * iota / D * m[3] * n[3]
    )  # fmt: skip


def _constants_and_forms() -> tuple[Statement, ...]:
    q_tex = (
        r"\alpha^2(u_1^2 + u_2^2) + \beta^2 u_3^2 + {+}\zeta^2(v_1^2 + v_2^2)"
        r" + \eta^2(v_3 - 1)^2 + 2\iota u_3(v_3 - 1)"
    )
    qstar_tex = (
        r"\frac{1}{\alpha^2}(m_1^2 + m_2^2) + \frac{1}{\zeta^2}(v_1^2 + v_2^2)"
        rf" + \frac{{\eta^2}}{{{D_TEX}}} m_3^2 + \frac{{\beta^2}}{{{D_TEX}}} n_3^2"
        rf" - \frac{{2\iota}}{{{D_TEX}}} m_3 n_3"
    )

    def definite(hypothesis: sp.Expr, shear: sp.IndexedBase) -> Implies:
        return Implies(
            positive(hypothesis),
            Every(
                PositiveDefinite(_form_of_strains(), sp.Tuple(u, v)),
                PositiveDefinite(_form_of_loads(shear), sp.Tuple(m, n)),
            ),
        )

    return (
        Statement(
            id="constants-positive",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Ranges of the seven constants of the rod.",
            latex=r"p, \alpha, \beta, \gamma, \zeta, \eta \in (0, \infty), \quad "
            r"\iota \in \mathbb R",
            printed=Every(*(positive(c) for c in (p, alpha, beta, gamma, zeta, eta))),
            check=rules.CONSTANT_RANGES,
        ),
        Statement(
            id="constants-hypothesis",
            section=SECTION,
            label="-",
            claim="Inequality on the constants that makes both quadratic forms positive definite.",
            latex=r"\alpha^2 \beta^2 - \iota^2 > 0",
            printed=positive(alpha**2 * beta**2 - iota**2),
            check=Routed(rules.COUPLING, constants.COUPLING),
            correction=positive(D),
            note="The printed inequality is not even dimensionally consistent: alpha^2 beta^2 "
            "scales like length^4 and iota^2 like length^2. It neither implies nor follows from "
            "positive definiteness.",
        ),
        Statement(
            id="q-forms-positive-definite",
            section=SECTION,
            label="-",
            claim="Under the printed inequality both quadratic forms are positive definite.",
            latex=r"\begin{aligned} &\alpha^2\beta^2 - \iota^2 > 0 "
            r"\implies \text{positive definite:}\\"
            rf"&Q = {q_tex}\\ &Q^* = {qstar_tex}\end{{aligned}}",
            printed=definite(alpha**2 * beta**2 - iota**2, v),
            check=Routed(rules.FORMS, constants.FORMS),
            correction=definite(D, n),
        ),
        Statement(
            id="q-form",
            section=SECTION,
            label="eq:quadraticform",
            introduces=True,
            claim="Quadratic form Q in the strains.",
            latex=rf"Q(\mathsf u, \mathsf v) = {q_tex}",
            printed=equal(Q(u, v), _form_of_strains()),
            check=Identity(ON_STRAINS),
            note="The doubled plus sign is harmless.",
        ),
        Statement(
            id="qstar-form",
            section=SECTION,
            label="-",
            claim="Quadratic form Q* in the contact couple and contact force.",
            latex=rf"Q^*(\mathsf m, \mathsf n) = {qstar_tex}",
            printed=equal(Qstar(m, n), _form_of_loads(v)),
            check=Identity(ON_LOADS),
            correction=equal(Qstar(m, n), _form_of_loads(n)),
            note="Shear strains stand where shear forces belong.",
        ),
    )


def _strains_from_loads() -> tuple[Statement, ...]:
    law = Identity(ON_LOADS)
    twist = (eta**2 * m[3] - iota * n[3]) / D
    dilatation = (-iota * m[3] + beta**2 * n[3]) / D
    return (
        Statement(
            id="const-u-mu",
            section=SECTION,
            label="eq:uconst",
            claim="Flexural strains as functions of contact couple and force.",
            latex=rf"u_\mu = {STRAIN_TEX} \frac{{1}}{{\alpha^2}} m_\mu",
            printed=equal(u[mu], strain_factor * m[mu] / alpha**2),
            check=law,
        ),
        Statement(
            id="const-u-3",
            section=SECTION,
            label="eq:u3const",
            claim="Twist as a function of contact couple and force.",
            latex=rf"u_3 = {STRAIN_TEX} \frac{{1}}{{{D_TEX}}}(\eta^2 m_3 - \iota n_3)",
            printed=equal(u[3], strain_factor * twist),
            check=law,
        ),
        Statement(
            id="const-v-mu",
            section=SECTION,
            label="eq:vconst",
            claim="Shear strains as functions of contact couple and force.",
            latex=rf"v_\mu = {STRAIN_TEX} \frac{{1}}{{\zeta^2}} n_\mu",
            printed=equal(v[mu], strain_factor * n[mu] / zeta**2),
            check=law,
        ),
        Statement(
            id="const-v-3",
            section=SECTION,
            label="eq:v3const",
            claim="Dilatation strain minus one as a function of contact couple and force.",
            latex=rf"v_3 - 1 = {STRAIN_TEX} \frac{{1}}{{{D_TEX}}}(-\iota m_3 + \beta^2 n_3)",
            printed=equal(v[3] - 1, strain_factor * dilatation),
            check=law,
        ),
        Statement(
            id="greek-index-range",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Greek letters used as indices range over 1 and 2.",
            latex=r"\mu, \nu \in \{1, 2\}",
            printed=sp.Tuple(1, 2),
            check=rules.GREEK_RANGE,
        ),
    )


def _limits() -> tuple[Statement, ...]:
    root = 1 / sp.sqrt(D)
    return (
        Statement(
            id="strain-limit",
            section=SECTION,
            label="eq:strainlimiting",
            claim="The strains given by the constitutive relations satisfy Q < 1.",
            latex=r"Q(\mathsf u, \mathsf v) < 1",
            printed=chain(Q(u, v), "<", 1),
            check=rules.STRAIN_LIMIT,
            note="1 is the supremum, approached as the load grows without bound.",
        ),
        Statement(
            id="bound-u-perp",
            section=SECTION,
            label="eq:u1u2bd",
            claim="Bound on the flexural strains.",
            latex=r"(u_1^2 + u_2^2)^{1/2} < \frac1\alpha",
            printed=chain(sp.sqrt(u[1] ** 2 + u[2] ** 2), "<", 1 / alpha),
            check=rules.flexure_bound(),
        ),
        Statement(
            id="bound-u3",
            section=SECTION,
            label="eq:u3bd",
            claim="Bound on the twist.",
            latex=rf"|u_3| < \eta({D_TEX})^{{-1/2}}",
            printed=chain(sp.Abs(u[3]), "<", eta * root),
            check=rules.twist_bound(),
            note="Sharp, and approached only by a combined load: the extremal strain has "
            "v_3 - 1 = -iota/(eta (beta^2 eta^2 - iota^2)^{1/2}).",
        ),
        Statement(
            id="bound-v-perp",
            section=SECTION,
            label="eq:v1v2bd",
            claim="Bound on the shear strains.",
            latex=r"(v_1^2 + v_2^2)^{1/2} < \frac1\zeta",
            printed=chain(sp.sqrt(v[1] ** 2 + v[2] ** 2), "<", 1 / zeta),
            check=rules.shear_bound(),
        ),
        Statement(
            id="bound-v3",
            section=SECTION,
            label="eq:v3bd",
            claim="Bound on the dilatation strain minus one.",
            latex=rf"|v_3 - 1| < \beta({D_TEX})^{{-1/2}}",
            printed=chain(sp.Abs(v[3] - 1), "<", beta * root),
            check=rules.dilatation_bound(),
        ),
    )
