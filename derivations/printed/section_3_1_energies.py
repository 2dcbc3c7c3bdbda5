"""Section 3.1 from the energies on: W*, loads of strains, W, dimensions, small strain."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import constitutive as rules
from rodproof.derivations.checks.domains import (
    MIRRORED_FORM,
    NEAR_REST,
    ON_STRAINS,
)
from rodproof.derivations.checks.routes import constants
from rodproof.derivations.notation import (
    Chain,
    Every,
    Partial,
    Q,
    Qstar,
    W,
    Wstar,
    chain,
    equal,
    m,
    mu,
    n,
    t,
    u,
    v,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory.dimensions import force, length

SECTION = "3.1"

D = beta**2 * eta**2 - iota**2
strain_factor = (gamma**p + Qstar(m, n) ** (p / 2)) ** (-1 / p)
load_factor = gamma * (1 - Q(u, v) ** (p / 2)) ** (-1 / p)
D_TEX = r"\beta^2 \eta^2 - \iota^2"
STRAIN_TEX = r"\Bigl(\gamma^p + Q^*(\mathsf{m}, \mathsf{n})^{p/2}\Bigr)^{-1/p}"
_L_TEX = r"\gamma\Bigl(1 - Q(\mathsf{u}, \mathsf{v})^{p/2}\Bigr)^{-1/p}"
_GRADIENT_TEX = r"\begin{bmatrix} %s \end{bmatrix} = \frac{\partial %s}{\partial \mathsf{%s}}"


def statements() -> tuple[Statement, ...]:
    """The statements of the second half of the section, in the order of the paper."""
    return (
        *_complementary_energy(),
        *_loads_from_strains(),
        *_stored_energy(),
        *_dimensions(),
        *_small_strain(),
    )


def _complementary_energy() -> tuple[Statement, ...]:
    energy = Wstar(m, n)
    strains = {u: (u[1], u[2], u[3]), v: (v[1], v[2], v[3] - 1)}
    gradient = Every(
        *(equal(e, Partial(energy, m[k])) for k, e in enumerate(strains[u], 1)),
        *(equal(e, Partial(energy, n[k])) for k, e in enumerate(strains[v], 1)),
    )
    integrand = (gamma**p + t ** (p / 2)) ** (-1 / p)
    return (
        Statement(
            id="wstar-gradient", section=SECTION, label="-",
            claim="The strains of the relations are the gradient of the complementary energy.",
            latex=_GRADIENT_TEX % (r"u_1 \\ u_2 \\ u_3", "W^*", "m")
            + r", \quad " + _GRADIENT_TEX % (r"v_1 \\ v_2 \\ v_3 - 1", "W^*", "n"),
            printed=gradient, check=Identity(rules.LAW_ON_LOADS),
        ),
        Statement(
            id="wstar-definition", section=SECTION, label="eq:compenergy",
            claim="Complementary energy as an integral over [0, Q*].",
            latex=r"W^*(\mathsf m, \mathsf n) = \frac12 \int_0^{Q^*(\mathsf m, \mathsf n)}"
            r" (\gamma^p + t^{p/2})^{-1/p}\, dt",
            printed=equal(energy, sp.Integral(integrand, (t, 0, Qstar(m, n))) / 2),
            check=rules.COMPLEMENTARY_POTENTIAL,
            note="The potential of the relations that vanishes at zero load.",
        ),
    )  # fmt: skip


def _loads_from_strains() -> tuple[Statement, ...]:
    law = Identity(ON_STRAINS)
    rows: tuple[tuple[str, str, str, str, sp.Indexed, sp.Expr, sp.Expr], ...] = (
        ("const-m-mu", "eq:mconst", "Bending couples as functions of the strains.",
         rf"m_\mu = \frac{{\partial W}}{{\partial u_\mu}} = {_L_TEX} \alpha^2 u_\mu",
         u[mu], m[mu], alpha**2 * u[mu]),
        ("const-m-3", "eq:m3const", "Twisting couple as a function of the strains.",
         rf"m_3 = \frac{{\partial W}}{{\partial u_3}} = {_L_TEX} (\beta^2 u_3 + \iota(v_3 - 1))",
         u[3], m[3], beta**2 * u[3] + iota * (v[3] - 1)),
        ("const-n-mu", "eq:nconst", "Shear forces as functions of the strains.",
         rf"n_\mu = \frac{{\partial W}}{{\partial v_\mu}} = {_L_TEX} \zeta^2 v_\mu",
         v[mu], n[mu], zeta**2 * v[mu]),
        ("const-n-3", "eq:n3const", "Tension as a function of the strains.",
         rf"n_3 = \frac{{\partial W}}{{\partial v_3}} = {_L_TEX} (\iota u_3 + \eta^2(v_3 - 1))",
         v[3], n[3], iota * u[3] + eta**2 * (v[3] - 1)),
    )  # fmt: skip
    relations = tuple(
        Statement(
            id=name,
            section=SECTION,
            label=label,
            claim=claim,
            latex=latex,
            check=law,
            printed=equal(load, Partial(W(u, v), strain), load_factor * row),
        )
        for name, label, claim, latex, strain, load, row in rows
    )
    x, y = rules.x, rules.y
    inverse = Statement(
        id="inversion-claim",
        section=SECTION,
        label="-",
        claim="The constitutive relations can be inverted: loads as functions of the strains.",
        latex=r"y = \gamma x (1 - x^p)^{-1/p}, \quad x = Q^{1/2},\; y = {Q^*}^{1/2}",
        printed=equal(y, gamma * x * (1 - x**p) ** (-1 / p)),
        check=rules.INVERSION,
        note="The relation between the radii is a bijection of [0, oo) onto [0, 1), and the "
        "direction is carried by K and its inverse, zero load and zero strain included.",
    )
    return (
        inverse,
        *relations,
        Statement(
            id="inverse-domain",
            section=SECTION,
            label="-",
            claim="The inverted relations hold for exactly the strains with Q < 1.",
            latex=r"Q(\mathsf u, \mathsf v) < 1",
            printed=chain(Q(u, v), "<", 1),
            check=rules.INVERSE_DOMAIN,
        ),
        Statement(
            id="saturation-not-invertible",
            section=SECTION,
            label="-",
            claim="Strains that stop growing at a finite load would make the relations "
            "non-invertible.",
            latex=r"s(y) = s_\infty \ \text{for all}\ y \geq Y \implies s(Y) = s(2Y)",
            printed=equal(rules.s(rules.Y), rules.s(2 * rules.Y)),
            check=Routed(rules.SATURATION, constants.SATURATION),
        ),
    )


def _stored_energy() -> tuple[Statement, ...]:
    energy = W(u, v)
    gradient = Every(
        *(equal(m[k], Partial(energy, u[k])) for k in (1, 2, 3)),
        *(equal(n[k], Partial(energy, v[k])) for k in (1, 2, 3)),
    )
    integrand = (1 - t ** (p / 2)) ** (-1 / p)
    return (
        Statement(
            id="w-gradient", section=SECTION, label="-",
            claim="Contact couple and force are the gradient of the stored energy.",
            latex=_GRADIENT_TEX % (r"m_1 \\ m_2 \\ m_3", "W", "u")
            + r", \quad " + _GRADIENT_TEX % (r"n_1 \\ n_2 \\ n_3", "W", "v"),
            printed=gradient, check=Identity(ON_STRAINS),
        ),
        Statement(
            id="w-definition", section=SECTION, label="eq:stenergy",
            claim="Stored energy as an integral over [0, Q].",
            latex=r"W(\mathsf u, \mathsf v) = \frac\gamma2 \int_0^{Q(\mathsf u, \mathsf v)}"
            r" (1 - t^{p/2})^{-1/p}\, dt",
            printed=equal(energy, gamma * sp.Integral(integrand, (t, 0, Q(u, v))) / 2),
            check=rules.STORED_POTENTIAL,
            note="The potential of the inverted relations that vanishes at rest.",
        ),
    )  # fmt: skip


def _dimensions() -> tuple[Statement, ...]:
    dim = rules.dim
    groups = sp.Tuple(gamma / force, alpha / length, beta / length, iota / length, zeta, eta, p)
    return (
        Statement(
            id="constants-dimensions", section=SECTION, label="-",
            claim="alpha, beta, iota scale like length, gamma like force; zeta, eta are numbers.",
            latex=r"[\alpha] = [\beta] = [\iota] = L, \quad [\gamma] = F, "
            r"\quad [\zeta] = [\eta] = 1",
            printed=Every(
                *(equal(dim(c), length) for c in (alpha, beta, iota)),
                equal(dim(gamma), force), equal(dim(zeta), 1), equal(dim(eta), 1),
            ),
            check=Routed(rules.DIMENSIONS, constants.DIMENSIONS),
        ),
        Statement(
            id="seven-dimensionless-parameters", section=SECTION, label="-",
            claim="The model has seven dimensionless parameters.",
            latex=r"\gamma/F,\ \alpha/L,\ \beta/L,\ \iota/L,\ \zeta,\ \eta,\ p",
            printed=groups, check=Routed(rules.GROUPS, constants.GROUPS),
            note="Nine quantities (seven constants, L and F) less two units; with gamma itself as "
            "the unit of force six remain.",
        ),
        Statement(
            id="all-but-p-interpretation", section=SECTION, label="-",
            claim="All constants but p have a small-strain interpretation.",
            latex=r"\gamma\alpha^2,\ \gamma\beta^2,\ \gamma\zeta^2,\ \gamma\eta^2,\ \gamma\iota",
            printed=sp.Tuple(*(gamma * c for c in (alpha**2, beta**2, zeta**2, eta**2, iota))),
            check=Routed(rules.MODULI, constants.MODULI),
            reading="Each constant but p enters a small-strain modulus, but not one of them alone "
            "is a modulus: the five moduli do not fix the six constants. (gamma, alpha, beta, "
            "zeta, eta, iota) and (4 gamma, alpha/2, beta/2, zeta/2, eta/2, iota/4) have the same "
            "moduli and different strain limits; what fixes gamma is a limit, such as 1/alpha.",
        ),
    )  # fmt: skip


def _small_strain() -> tuple[Statement, ...]:
    near = Identity(NEAR_REST)
    mirrored = Q(u, v) - 4 * iota * u[3] * (v[3] - 1)

    def shear(right: sp.IndexedBase) -> Chain:
        return equal(n[mu], gamma * zeta**2 * right[mu])

    return (
        Statement(
            id="small-strain-m-mu",
            section=SECTION,
            label="-",
            claim="Leading-order bending couple.",
            latex=r"m_\mu = \gamma\alpha^2 u_\mu",
            printed=equal(m[mu], gamma * alpha**2 * u[mu]),
            check=near,
        ),
        Statement(
            id="small-strain-m-3",
            section=SECTION,
            label="-",
            claim="Leading-order twisting couple.",
            latex=r"m_3 = \gamma\beta^2 u_3 + \gamma\iota(v_3 - 1)",
            printed=equal(m[3], gamma * beta**2 * u[3] + gamma * iota * (v[3] - 1)),
            check=near,
        ),
        Statement(
            id="small-strain-n-mu",
            section=SECTION,
            label="-",
            claim="Leading-order shear force.",
            latex=r"n_\mu = \gamma\zeta^2 n_\mu",
            printed=shear(n),
            check=near,
            correction=shear(v),
            note="The shear force stands on both sides; the strain belongs on the right.",
        ),
        Statement(
            id="small-strain-n-3",
            section=SECTION,
            label="-",
            claim="Leading-order tension.",
            latex=r"n_3 = \gamma\iota u_3 + \gamma\eta^2(v_3 - 1)",
            printed=equal(n[3], gamma * iota * u[3] + gamma * eta**2 * (v[3] - 1)),
            check=near,
        ),
        Statement(
            id="small-strain-moduli",
            section=SECTION,
            label="-",
            claim="Four products of constants are the small-strain moduli.",
            latex=r"\frac{\partial m_\mu}{\partial u_\mu} = \gamma\alpha^2,\ \frac{\partial m_3}"
            r"{\partial u_3} = \gamma\beta^2,\ \frac{\partial n_\mu}{\partial v_\mu} = "
            r"\gamma\zeta^2,\ \frac{\partial n_3}{\partial v_3} = \gamma\eta^2",
            printed=Every(
                equal(Partial(m[mu], u[mu]), gamma * alpha**2),
                equal(Partial(m[3], u[3]), gamma * beta**2),
                equal(Partial(n[mu], v[mu]), gamma * zeta**2),
                equal(Partial(n[3], v[3]), gamma * eta**2),
            ),
            check=near,
            reading="A modulus is the derivative of a load by its own strain with the others held "
            "fixed. With the other loads held at zero, as in a tension or torsion test, a "
            "chiral rod shows gamma(eta^2 - iota^2/beta^2) in tension and gamma(beta^2 - "
            "iota^2/eta^2) in torsion.",
        ),
        Statement(
            id="chirality-constant",
            section=SECTION,
            label="-",
            claim="gamma iota couples twist to extension, and its sign is the rod's chirality.",
            latex=r"\frac{\partial m_3}{\partial v_3} = \frac{\partial n_3}{\partial u_3} = "
            r"\gamma\iota, \quad Q_{\text{mirror}} = Q - 4\iota u_3(v_3 - 1) "
            r"= Q|_{\iota \to -\iota}",
            printed=Every(
                equal(Partial(m[3], v[3]), gamma * iota),
                equal(Partial(n[3], u[3]), gamma * iota),
                equal(MIRRORED_FORM, mirrored),
            ),
            check=near,
            note="A reflection turns the rod into the one with iota of the other sign.",
        ),
    )
