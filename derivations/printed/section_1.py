"""Section 1, introduction: every claim that can be judged, transcribed as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import constitutive, kinematics
from rodproof.derivations.checks import introduction as rules
from rodproof.derivations.checks.introduction import e, g, hessian, radius
from rodproof.derivations.checks.kinematics import d, r_vector, u_vector
from rodproof.derivations.checks.routes import constants, states
from rodproof.derivations.checks.symmetry import INSIDE, R
from rodproof.derivations.notation import (
    Cross,
    Every,
    ForAll,
    Implies,
    LimitOf,
    Partial,
    PositiveDefinite,
    Prime,
    W,
    chain,
    equal,
    k,
    m,
    mu,
    nu,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, zeta
from rodproof.derivations.theory.frames import psi, theta
from rodproof.derivations.theory.loading import couple, tau

SECTION = "1"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (_darboux(), _monotone(), *_constraints(), *_properties(), *_couples())


def _darboux() -> Statement:
    return Statement(
        id="intro-darboux", section=SECTION, label="-", introduces=True,
        claim="The Darboux vector turns each director at its rate.",
        latex=r"\frac{d}{ds} \boldsymbol d_k(s) = \boldsymbol u(s) \times \boldsymbol d_k(s),"
        r"\quad s \in [0, L],\ k = 1, 2, 3",
        printed=equal(Prime(d[k]), Cross(u_vector, d[k])), check=kinematics.ON_FRAMES,
    )  # fmt: skip


def _monotone() -> Statement:
    six = range(1, 7)
    return Statement(
        id="intro-strains-monotone", section=SECTION, label="-",
        claim="As the loads increase the strains increase monotonically towards a finite limit.",
        latex=r"\frac{d}{d\tau} \frac{\varepsilon_k(\tau\mathsf m, \tau\mathsf n)}"
        r"{\varepsilon_k(\mathsf m, \mathsf n)} > 0, \quad \lim_{\tau \to \infty}"
        r"\varepsilon_k(\tau\mathsf m, \tau\mathsf n) = \frac{\varepsilon_k}{Q^{1/2}}",
        printed=positive(Partial(u[mu], m[nu])),
        read_as=Every(
            *(positive(Partial(g[i] / e[i], tau)) for i in six),
            *(equal(LimitOf(g[i], tau, sp.oo), e[i] / radius) for i in six),
        ),
        check=rules.RAY,
        reading="All loads increase in proportion (tau times a fixed load), and a strain increases "
        "in size, measured from rest; one that is zero stays zero. Where one load grows and the "
        "others are held, its own strain increases and others may decrease: with p = 1, iota = 0 "
        "and all other constants 1, at m = (3, 4, 0), n = 0 the flexure u_1 = 1/2 falls with m_2 "
        "at the rate -1/15, and with iota > 0 a twisting couple m_3 > 0 lowers v_3.",
    )  # fmt: skip


def _constraints() -> tuple[Statement, ...]:
    return (
        Statement(
            id="intro-unshearable", section=SECTION, label="-", introduces=True,
            claim="The constraint that forbids shear.",
            latex=r"\boldsymbol r'(s) = v_3(s) \boldsymbol d_3(s), \quad s \in [0, L]",
            printed=equal(Prime(r_vector), v[3] * d[3]), check=kinematics.unshearable(),
        ),
        Statement(
            id="intro-unshearable-inextensible", section=SECTION, label="-", introduces=True,
            claim="The constraint that forbids shear and stretch.",
            latex=r"\boldsymbol r'(s) = \boldsymbol d_3(s), \quad s \in [0, L]",
            printed=equal(Prime(r_vector), d[3]), check=kinematics.unshearable_inextensible(),
        ),
    )  # fmt: skip


def _properties() -> tuple[Statement, ...]:
    hemitropic = ForAll(INSIDE, equal(W(R(psi) * u, R(psi) * v), W(u, v)))
    monotone = PositiveDefinite(hessian, sp.Tuple(u, v))
    condition = chain(1 + iota**2 / beta**2, "<", eta**2)
    return (
        Statement(
            id="intro-moduli-interpretation", section=SECTION, label="-",
            claim="All constants but one are read off small-strain moduli.",
            latex=r"\gamma\alpha^2,\ \gamma\beta^2,\ \gamma\zeta^2,\ \gamma\eta^2,\ \gamma\iota",
            printed=sp.Tuple(*(gamma * c for c in (alpha**2, beta**2, zeta**2, eta**2, iota))),
            check=Routed(constitutive.MODULI, constants.MODULI),
            reading="Each constant but p enters a small-strain modulus, but the five moduli do not "
            "fix the six constants: (gamma, alpha, beta, zeta, eta, iota) and (4 gamma, alpha/2, "
            "beta/2, zeta/2, eta/2, iota/4) have the same moduli and different strain limits. One "
            "limit, such as 1/alpha, is needed besides.",
        ),
        Statement(
            id="intro-properties-all-loads", section=SECTION, label="-",
            claim="Orientation is preserved, the rod is hemitropic and the law is monotone, for "
            "all contact forces and couples.",
            latex=r"v_3 > 0, \quad W(\boldsymbol{\mathsf R}_\psi \mathsf u, \boldsymbol{\mathsf R}"
            r"_\psi \mathsf v) = W(\mathsf u, \mathsf v), \quad D^2 W \text{ positive definite}",
            printed=Every(positive(v[3]), hemitropic, monotone),
            read_as=Every(Implies(condition, positive(v[3])), hemitropic, monotone),
            check=rules.PROPERTIES,
            reading="Hemitropy and monotonicity hold for all constants; orientation only if 1 + "
            "iota^2/beta^2 < eta^2 (eq:matconst1), and in the strong sense only for a small enough "
            "radius (eq:matconst2). Without it a compression inverts the rod: with p = 1, eta = "
            "1/2, iota = 0, the others 1, and n_3 = -1, v_3 = -1/3.",
        ),
    )  # fmt: skip


def _couples() -> tuple[Statement, ...]:
    return (
        Statement(
            id="intro-poynting-chirality", section=SECTION, label="-",
            claim="An isolated couple whose chirality is opposite to the rod's elongates it.",
            latex=r"\mathsf n = 0,\ \iota m_3 < 0 \implies |\boldsymbol r'| = v_3 > 1",
            printed=Implies(chain(iota * m[3], "<", 0), chain(v[3], ">", 1)),
            check=Routed(rules.ELONGATION, states.POYNTING),
            note="For every isolated couple, with bending as well: only its twisting component "
            "counts, and v_1 = v_2 = 0. A couple of the rod's own chirality has v_3 < 1.",
        ),
        Statement(
            id="intro-helix-two-parameters", section=SECTION, label="-",
            claim="The helical states under isolated couples are a family of two parameters.",
            latex=r"(M, \theta), \quad M = |\boldsymbol m|",
            printed=sp.Tuple(couple, theta), check=Routed(rules.FAMILY, states.FAMILY),
            reading="Counted up to rigid motions of the rod and turns of its directors about d_3: "
            "the printed family has the third free constant psi(0), which by hemitropy changes "
            "neither the center line nor the energy. M_1 = -M sin(theta) in the paper's letters.",
        ),
    )  # fmt: skip
