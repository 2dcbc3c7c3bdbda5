"""Section 5.2, modeling perspectives: tangent stiffness and dsDNA, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import dna as rules
from rodproof.derivations.checks.routes import materials
from rodproof.derivations.notation import (
    Every,
    Iff,
    LimitOf,
    Partial,
    chain,
    equal,
    positive,
    u,
    v,
)
from rodproof.derivations.proof.exactly import exactly
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory.constitutive import y
from rodproof.derivations.theory.dna import nm, pN, tension

SECTION = "5.2"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (_stiffening(), *_dsdna(), *_what_follows())


def _stiffening() -> Statement:
    k = rules.stiffness
    return Statement(
        id="tangent-stiffness", section=SECTION, label="-",
        claim="The model's tangent stiffness along a ray rises from gamma without bound.",
        latex=r"\frac{dy}{dx} \to \gamma\ (y \to 0), \quad \frac{d}{dy}\frac{dy}{dx} > 0, \quad"
        r" \frac{dy}{dx} \sim \frac{y^{p + 1}}{\gamma^p}\ (y \to \infty)",
        **exactly(Identity(rules.SLOPES), Every(
            equal(LimitOf(k, y, sp.Integer(0)), gamma), positive(Partial(k, y)),
            equal(LimitOf(k * gamma**p / y ** (p + 1), y, sp.oo), 1),
        )),
        note="x and y are the strain and load radii: dy/dx = (gamma^p + y^p)^{1 + 1/p}/gamma^p. "
        "It is the model that is proved to stiffen so; that the named materials do is an "
        "observation.",
    )  # fmt: skip


def _dsdna() -> tuple[Statement, ...]:
    along = {
        u: LimitOf(u[3] / tension, tension, sp.Integer(0)),
        v: LimitOf((v[3] - 1) / tension, tension, sp.Integer(0)),
    }
    rows = (
        ("dna-bending", "bending", "Bending modulus of dsDNA.", gamma * alpha**2, 185 * pN * nm**2,
         r"\gamma_D \alpha_D^2 = 185\ \mathrm{pN\,nm^2}",
         "With k_B T = 4.1 pN nm a persistence length of 45 nm."),
        ("dna-twisting", "twisting", "Twisting modulus of dsDNA.", gamma * beta**2,
         447 * pN * nm**2, r"\gamma_D \beta_D^2 = 447\ \mathrm{pN\,nm^2}",
         "With k_B T = 4.1 pN nm a persistence length of 109 nm."),
        ("dna-stretching", "stretching", "Stretch modulus of dsDNA.", gamma * eta**2, 1000 * pN,
         r"\gamma_D \eta_D^2 = 1000\ \mathrm{pN}", "A modulus at constant twist."),
        ("dna-coupling", "coupling", "Twist-stretch coupling of dsDNA.", gamma * iota,
         -70 * pN * nm, r"\gamma_D \iota_D = -70\ \mathrm{pN\,nm}",
         "Negative: dsDNA overwinds under tension; see extra-dna-overwinds."),
    )  # fmt: skip
    return (
        Statement(
            id="dna-force-range",
            section=SECTION,
            label="-",
            claim="With these constants the model describes dsDNA up to tensions of about 50 pN.",
            latex=r"\lim_{N \to 0} \frac{v_3 - 1}{N} = \frac{447}{442100\ \mathrm{pN}}, \quad"
            r" \lim_{N \to 0} \frac{u_3}{N} = \frac{70}{442100\ \mathrm{pN\,nm}}",
            printed=Every(
                equal(along[v], sp.Rational(447, 442100) / pN),
                equal(along[u], sp.Rational(70, 442100) / (pN * nm)),
            ),
            check=Identity(rules.DSDNA),
            reading="That is a finding of experiments. What the four numbers say of the model is "
            "its linear answer to a tension: at 50 pN a stretch of 5.1 % and a twist of 0.0079 "
            "rad/nm. The constants gamma and p, which say where the answer leaves the line, are "
            "not given, and the linear range must be assumed to reach 50 pN.",
        ),
        *(
            Statement(
                id=name,
                section=SECTION,
                label="eq:DNA",
                introduces=True,
                claim=claim,
                latex=latex,
                printed=equal(modulus, value),
                check=Routed(rules.Datum(which), materials.DATUM),
                note=note,
            )
            for name, which, claim, modulus, value, latex, note in rows
        ),
        Statement(
            id="dna-unshearable",
            section=SECTION,
            label="-",
            introduces=True,
            claim="The rod is taken to be unshearable.",
            latex=r"v_1 = v_2 = 0 = \lim_{\zeta \to \infty} v_\mu",
            **exactly(
                rules.STIFF_IN_SHEAR,
                Every(*(equal(LimitOf(v[i], zeta, sp.oo), 0) for i in (1, 2))),
            ),
            note="No rod of the family is unshearable, as zeta is finite; it is the limit "
            "zeta -> oo of the law at given loads. The shear force then is a reaction.",
        ),
    )


def _what_follows() -> tuple[Statement, ...]:
    moduli = sp.Tuple(gamma * alpha**2, gamma * beta**2, gamma * iota, gamma * eta**2)
    gap = gamma**2 * (beta**2 * eta**2 - iota**2)
    return (
        Statement(
            id="dna-constants-given",
            section=SECTION,
            label="-",
            claim="The values for dsDNA give the constants alpha, beta, gamma, iota, eta and p.",
            latex=r"\alpha, \beta, \gamma, \iota, \eta, p \ \text{given by (eq:DNA)}",
            printed=sp.Tuple(alpha, beta, gamma, iota, eta, p),
            check=Routed(rules.Determined(), materials.FIXED),
            correction=moduli,
            note="Four equations for six constants: they fix the four moduli and none of the "
            "constants. p does not occur, and gamma is fixed by a strain limit only.",
        ),
        Statement(
            id="extra-dna-hypothesis",
            section=SECTION,
            label="-",
            claim="The values for dsDNA meet the coupling hypothesis, whatever gamma and p.",
            latex=r"\gamma_D^2(\beta_D^2\eta_D^2 - \iota_D^2) = 442100\ \mathrm{pN^2\,nm^2} > 0",
            printed=chain(gap, "=", 442100 * pN**2 * nm**2, ">", 0),
            check=Identity(rules.DSDNA),
            note="The hypothesis printed in Section 3.1, alpha^2 beta^2 - iota^2 > 0, compares "
            "nm^4 with nm^2.",
        ),
        Statement(
            id="extra-dna-overwinds",
            section=SECTION,
            label="-",
            claim="The rod with these constants overwinds under every tension, as dsDNA does.",
            latex=r"N > 0 \implies u_3 > 0",
            **exactly(Identity(rules.DSDNA), positive(u[3])),
            note="For a right-handed molecule u_3 > 0 adds turns. It is iota < 0 that does it.",
        ),
        Statement(
            id="extra-dna-orientation",
            section=SECTION,
            label="-",
            claim="v_3 > 0 under all loads, by the paper's condition, if and only if gamma is "
            "below 442100/447 pN (989 pN).",
            latex=r"1 + \frac{\iota_D^2}{\beta_D^2} < \eta_D^2 \iff \gamma_D < \tfrac{442100}{447}"
            r"\ \mathrm{pN}",
            printed=Iff(
                positive(eta**2 - 1 - iota**2 / beta**2),
                positive(sp.Rational(442100, 447) * pN - gamma),
            ),
            check=Routed(rules.SameSign(rules.DSDNA), materials.ORIENTATION),
        ),
    )
