"""The law between strains and loads: forms, strains, the inverse, limits, moduli (Section 3.1)."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import constitutive as rules
from rodproof.derivations.checks.domains import MIRRORED_FORM, NEAR_REST, ON_LOADS, ON_STRAINS
from rodproof.derivations.notation import (
    Every,
    Partial,
    Q,
    Qstar,
    Wstar,
    chain,
    equal,
    m,
    mu,
    n,
    positive,
    t,
    u,
    v,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.rules import MatrixIdentity
from rodproof.derivations.records import Derivation, Step
from rodproof.derivations.symbols import alpha, beta, chiral_gap, eta, gamma, iota, p, zeta
from rodproof.derivations.theory import constitutive as theory

_strain_factor = (gamma**p + Qstar(m, n) ** (p / 2)) ** (-1 / p)
_load_factor = gamma * (1 - Q(u, v) ** (p / 2)) ** (-1 / p)
K = sp.Symbol("K")
K_inverse = sp.Symbol("K_inverse")


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_forms(), _strains(), _loads(), _limits(), _moduli())


def _forms() -> Derivation:
    stiffness, compliance = theory.stiffness_at_rest(), theory.compliance_at_rest()
    twist = (eta**2 * m[3] ** 2 - 2 * iota * m[3] * n[3] + beta**2 * n[3] ** 2) / chiral_gap
    return Derivation(
        label="quadratic-forms",
        title="Two dual quadratic forms from one stiffness matrix",
        problem="A rod bends equally in all directions of its section, shears equally in all of "
        "them, and couples twist with dilatation. Find the quadratic form of its stiffness at "
        "rest, its dual, and when they are positive definite.",
        steps=(
            Step(
                "The stiffness at rest",
                "Hemitropy leaves five moduli; divide them by gamma. "
                "Order: `u_1, u_2, u_3, v_1, v_2, v_3 - 1`.",
                equal(K, stiffness),
                statements=("small-strain-moduli",),
            ),
            Step(
                "The form Q",
                "`Q = eps . K eps` with `eps = (u, v - e_3)`.",
                equal(
                    Q(u, v),
                    alpha**2 * (u[1] ** 2 + u[2] ** 2)
                    + beta**2 * u[3] ** 2
                    + zeta**2 * (v[1] ** 2 + v[2] ** 2)
                    + eta**2 * (v[3] - 1) ** 2
                    + 2 * iota * u[3] * (v[3] - 1),
                ),
                Identity(ON_STRAINS),
                ("q-form",),
            ),
            Step(
                "When K is positive definite",
                "Sylvester: the leading minors are products of "
                "squares and of the determinant of the twist-dilatation block.",
                positive(chiral_gap),
                rules.COUPLING,
                ("constants-hypothesis", "q-forms-positive-definite"),
            ),
            Step(
                "The inverse of K",
                "Invert the two by two block; the rest is diagonal.",
                equal(K_inverse, compliance),
                MatrixIdentity(lambda: (stiffness * compliance, sp.eye(6)), (chiral_gap,)),
            ),
            Step(
                "The dual form",
                "`Q* = sigma . K^{-1} sigma` with `sigma = (m, n)`.",
                equal(
                    Qstar(m, n),
                    (m[1] ** 2 + m[2] ** 2) / alpha**2 + (n[1] ** 2 + n[2] ** 2) / zeta**2 + twist,
                ),
                Identity(ON_LOADS),
                ("qstar-form",),
            ),
        ),
    )


def _strains() -> Derivation:
    integrand = (gamma**p + t ** (p / 2)) ** (-1 / p)
    energy = Wstar(m, n)
    return Derivation(
        label="strains",
        title="Strains as the gradient of the complementary energy",
        problem="Given `W*` as an integral up to `Q*`, find the strains.",
        steps=(
            Step(
                "The complementary energy",
                "The one constitutive assumption.",
                equal(energy, sp.Integral(integrand, (t, 0, Qstar(m, n))) / 2),
                rules.COMPLEMENTARY_POTENTIAL,
                ("wstar-definition",),
            ),
            *(
                Step(
                    title,
                    "Fundamental theorem of calculus: the integrand at `Q*`, times half "
                    "the derivative of `Q*`.",
                    equal(strain, Partial(energy, load), _strain_factor * row),
                    Identity(ON_LOADS),
                    (name, "wstar-gradient"),
                )
                for title, name, strain, load, row in (
                    ("Flexure", "const-u-mu", u[mu], m[mu], m[mu] / alpha**2),
                    ("Twist", "const-u-3", u[3], m[3], (eta**2 * m[3] - iota * n[3]) / chiral_gap),
                    ("Shear", "const-v-mu", v[mu], n[mu], n[mu] / zeta**2),
                    (
                        "Dilatation",
                        "const-v-3",
                        v[3] - 1,
                        n[3],
                        (-iota * m[3] + beta**2 * n[3]) / chiral_gap,
                    ),
                )
            ),
        ),
    )


def _loads() -> Derivation:
    x, y = theory.x, theory.y
    return Derivation(
        label="inverse",
        title="The inverse law, solved for the loads",
        problem="The strains are `f K^{-1} sigma` with one scalar `f`. Solve for sigma.",
        steps=(
            Step(
                "The law between the radii",
                "Take the norm of `K` on both sides: `x = Q^{1/2}` and `y = Q*^{1/2}` satisfy "
                "`x = f y`.",
                equal(x, y * (gamma**p + y**p) ** (-1 / p)),
                Identity(rules.ON_RADII),
            ),
            Step(
                "Solved for y",
                "`x^p (gamma^p + y^p) = y^p` is linear in `y^p`; both compositions "
                "are the identity, so `[0, oo)` and `[0, 1)` correspond one to one.",
                equal(y, gamma * x * (1 - x**p) ** (-1 / p)),
                rules.INVERSION,
                ("inversion-claim", "inverse-domain"),
            ),
            *(
                Step(
                    title,
                    "`sigma = (y/x) K eps`.",
                    equal(load, _load_factor * row),
                    Identity(ON_STRAINS),
                    (name,),
                )
                for title, name, load, row in (
                    ("Bending couples", "const-m-mu", m[mu], alpha**2 * u[mu]),
                    ("Twisting couple", "const-m-3", m[3], beta**2 * u[3] + iota * (v[3] - 1)),
                    ("Shear forces", "const-n-mu", n[mu], zeta**2 * v[mu]),
                    ("Tension", "const-n-3", n[3], iota * u[3] + eta**2 * (v[3] - 1)),
                )
            ),
            Step(
                "No saturation",
                "Were a strain constant beyond some load, two loads would share "
                "it and no inverse could exist.",
                equal(rules.s(rules.Y), rules.s(2 * rules.Y)),
                rules.SATURATION,
                ("saturation-not-invertible",),
            ),
        ),
    )


def _limits() -> Derivation:
    root = 1 / sp.sqrt(chiral_gap)
    cases = (
        (
            "Flexure",
            "bound-u-perp",
            sp.sqrt(u[1] ** 2 + u[2] ** 2),
            1 / alpha,
            rules.flexure_bound(),
        ),
        ("Twist", "bound-u3", sp.Abs(u[3]), eta * root, rules.twist_bound()),
        ("Shear", "bound-v-perp", sp.sqrt(v[1] ** 2 + v[2] ** 2), 1 / zeta, rules.shear_bound()),
        ("Dilatation", "bound-v3", sp.Abs(v[3] - 1), beta * root, rules.dilatation_bound()),
    )
    return Derivation(
        label="strain-limit",
        title="The strain limit and its sharp bounds",
        problem="Which strains can occur, and how large can each become?",
        steps=(
            Step(
                "The limit",
                "`x^p = y^p/(gamma^p + y^p) < 1`, increasing to 1 with the load.",
                chain(Q(u, v), "<", 1),
                rules.STRAIN_LIMIT,
                ("strain-limit",),
            ),
            *(
                Step(
                    title,
                    "Support function of the ellipsoid `Q < 1`: `sup |a . eps| = "
                    "(a . K^{-1} a)^{1/2}`, at `eps = K^{-1} a/(a . K^{-1} a)^{1/2}` on its "
                    "surface, so never attained.",
                    chain(functional, "<", bound),
                    check,
                    (name,),
                )
                for title, name, functional, bound, check in cases
            ),
        ),
    )


def _moduli() -> Derivation:
    near = Identity(NEAR_REST)
    return Derivation(
        label="small-strain",
        title="The linear law near rest",
        problem="What is the law to leading order in `(u, v - e_3)`?",
        steps=(
            Step(
                "Leading order",
                "`sigma(h eps)/h = gamma (1 - h^p Q^{p/2})^{-1/p} K eps`, and "
                "`h^p -> 0` for every `p > 0`.",
                Every(
                    equal(m[mu], gamma * alpha**2 * u[mu]),
                    equal(m[3], gamma * beta**2 * u[3] + gamma * iota * (v[3] - 1)),
                    equal(n[mu], gamma * zeta**2 * v[mu]),
                    equal(n[3], gamma * iota * u[3] + gamma * eta**2 * (v[3] - 1)),
                ),
                near,
                ("small-strain-m-mu", "small-strain-m-3", "small-strain-n-mu", "small-strain-n-3"),
            ),
            Step(
                "Chirality",
                "Only the coupling changes sign in a mirror.",
                Every(
                    equal(Partial(m[3], v[3]), gamma * iota),
                    equal(Partial(n[3], u[3]), gamma * iota),
                    equal(MIRRORED_FORM, Q(u, v) - 4 * iota * u[3] * (v[3] - 1)),
                ),
                near,
                ("chirality-constant",),
            ),
            Step(
                "Dimensions",
                "`Q` is a number and `gamma^2` has the dimension of `Q*`.",
                sp.Tuple(*(rules.dim(c) for c in (alpha, beta, gamma, zeta, eta, iota, p))),
                None,
                ("constants-dimensions", "seven-dimensionless-parameters"),
            ),
        ),
    )
