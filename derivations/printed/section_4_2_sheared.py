"""Section 4.2 on sheared states: the condition for them, the moduli, threshold and existence."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.routes import thrust
from rodproof.derivations.checks.thrust import domains
from rodproof.derivations.checks.thrust.branch import (
    OnTheBranch,
    SharpSign,
)  # fmt: skip
from rodproof.derivations.checks.thrust.equations import (
    COUPLE_BALANCE,
    Equation,
    LinkByLink,
)
from rodproof.derivations.checks.thrust.moduli import (
    Necessary,
    SameSides,
    SameSign,
    b,
    c,
    condition_1_follows,
    condition_2_follows,
    kappa,
)  # fmt: skip
from rodproof.derivations.checks.thrust.points import N_thresh, scalar_v
from rodproof.derivations.checks.thrust.states import (  # fmt: skip
    Both,
    InAllStates,
    Jointly,
)
from rodproof.derivations.notation import (
    Every,
    Iff,
    Implies,
    LimitOf,
    chain,
    equal,
    n,
    positive,
    v,
)  # fmt: skip
from rodproof.derivations.printed import section_4_2_branch
from rodproof.derivations.printed import section_4_2_terms as terms
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.symbols import beta, eta, iota, p, v3, zeta
from rodproof.derivations.theory.frames import theta
from rodproof.derivations.theory.thrust import N


def statements() -> tuple[Statement, ...]:
    """The statements about sheared states, in the order of the paper, and more about them."""
    return (
        *_sheared_condition(),
        *_conditions_on_the_moduli(),
        *_threshold_and_existence(),
        *section_4_2_branch.statements(),
    )


def _sheared_condition() -> tuple[Statement, ...]:
    condition = equal(v[3], scalar_v * N * terms.cosine)
    on_branch = InAllStates((domains.BRANCH, domains.MIRRORED_BRANCH))
    sheared = Identity(domains.SHEARED)
    every_thrust = InAllStates(domains.PUSHED_OR_PULLED)
    return (
        terms.statement(
            "sheared-condition", "Condition of the sheared states.",
            r"v_3 = v N \cos\theta, \quad \theta \in (0, \pi)",
            Every(condition, positive(terms.sine)), on_branch, label="eq:TTcase2", introduces=True,
        ),
        terms.statement(
            "sheared-tension-positive",
            "In a sheared state the tension is N cos theta and positive, as v and v_3 are.",
            r"n_3 = N \cos\theta > 0",
            chain(n[3], "=", N * terms.cosine, ">", 0), LinkByLink((every_thrust, sheared)),
            note="Uses v_3 > 0 as Section 2 demands it; with v_3 < 0 there would be states with "
            "n_3 < 0 where zeta is large.",
        ),
        terms.statement(
            "sheared-tensile-state", "In a sheared state v_3 exceeds 1.", "v_3 - 1 > 0",
            positive(v[3] - 1),
            Routed(SharpSign(domains.SHEARED, zeta, sp.Integer(0)), thrust.TENSILE),
            note="m_3 = 0, so that v_3 - 1 has the sign of n_3.",
        ),
        terms.statement(
            "sheared-subcase-N-positive",
            "In a sheared state theta is below pi/2 exactly if N is positive.",
            r"\theta \in (0, \tfrac{\pi}{2}) \iff N > 0",
            Iff(positive(terms.cosine), positive(N)),
            Routed(SameSides(domains.SHEARED), thrust.SIGNS),
        ),
        terms.statement(
            "sheared-v3-first", "v_3 of a sheared state through the law.",
            rf"v_3 = {terms.F_TEX} \frac{{n_3}}{{\zeta^2}}",
            equal(v[3], terms.F * n[3] / zeta**2), on_branch,
        ),
        terms.statement(
            "sheared-v3-second", "The same as a multiple of v_3 - 1.",
            rf"{terms.F_TEX} \frac{{n_3}}{{\zeta^2}} = "
            rf"\frac{{{terms.D_TEX}}}{{\beta^2 \zeta^2}} (v_3 - 1)",
            equal(terms.F * n[3] / zeta**2, terms.D / (beta**2 * zeta**2) * (v[3] - 1)),
            every_thrust,
            note="Holds for every N and theta, sheared in equilibrium or not.",
        ),
        terms.statement(
            "sheared-v3-value", "Value of v_3 - 1 in a sheared state.",
            rf"v_3 - 1 = {terms.K_TEX}^{{-1}}",
            equal(v[3] - 1, 1 / terms.K), on_branch, label="eq:TTv3",
            note="It does not depend on N or p.",
        ),
    )  # fmt: skip


def _conditions_on_the_moduli() -> tuple[Statement, ...]:
    sheared = equal(v3, scalar_v * N * terms.cosine)
    valued = equal(v3 - 1, 1 / terms.K)
    first, second, third = positive(terms.K), positive(terms.A - terms.B), chain(
        eta**2, ">", zeta**2 + iota**2 / beta**2)  # fmt: skip
    limited = chain(1 / terms.K, "<", terms.root_b)
    in_powers = chain(terms.K**p * beta ** (2 * p) / terms.D**p, ">", beta**p / terms.D ** (p / 2))
    k_tex = rf"\frac{{{terms.D_TEX}}}{{\beta^2 \zeta^2}} - 1 > 0"
    pulled = domains.PUSHED_OR_PULLED[0]

    def derived(claim: sp.Basic) -> Equation:
        left, right = claim.sides
        return Equation(pulled.interpret(left - right), pulled)

    return (
        terms.statement(
            "moduli-condition-1-necessary",
            "A sheared state can only exist if the first condition on the moduli holds.",
            rf"v_3 = v N \cos\theta \implies {k_tex}",
            Implies(sheared, first),
            Routed(
                Necessary(
                    Equation(domains.sheared_residual(), pulled), terms.CONDITION_1,
                    condition_1_follows,
                    "F n_3 = 1/c and v_3 = a/c > 0, F > 0 by the law; so c > 0",
                ),
                thrust.FIRST_NEEDED,
            ),
            note="If the difference is 0 there is no sheared state either: v_3 = v_3 - 1.",
        ),
        terms.statement(
            "moduli-condition-1", "Three forms of the first condition on the moduli.",
            rf"{k_tex} \iff {terms.A_TEX} - {terms.B_TEX} > 0 \iff \eta^2 > \zeta^2 + "
            r"\frac{\iota^2}{\beta^2}",
            Iff(first, second, third), Routed(terms.CONDITION_1, thrust.FIRST), label="eq:TTin1",
        ),
        terms.statement(
            "moduli-condition-2-necessary",
            "A sheared state can only exist if its v_3 - 1 is below the limit of the straight one.",
            rf"v_3 - 1 = {terms.K_TEX}^{{-1}} \implies {terms.K_TEX}^{{-1}} < {terms.ROOT_TEX}",
            Implies(valued, limited),
            Routed(
                Necessary(derived(equal(v3 - 1, 1 / kappa)), terms.CONDITION_2, condition_2_follows,
                          "(v_3 - 1)^2 < b for every load, by exact identities and signs"),
                thrust.SECOND_NEEDED,
            ),
            note="The paper expects it; it is true, by the strain limit: v_3 - 1 < "
            "beta (beta^2 eta^2 - iota^2)^{-1/2} in every state.",
        ),
        terms.statement(
            "moduli-condition-2", "Second condition on the moduli.",
            rf"{terms.K_TEX}^{{-1}} < {terms.ROOT_TEX}", limited,
            Routed(terms.CONDITION_2, thrust.SECOND), label="eq:TTin2", introduces=True,
            note="Meant together with condition 1; without it the left side is negative.",
        ),
        terms.statement(
            "moduli-condition-2-iff", "The second condition with powers p.",
            rf"{terms.K_TEX}^{{-1}} < {terms.ROOT_TEX} \iff {terms.K_TEX}^p "
            rf"\frac{{\beta^{{2p}}}}{{({terms.D_TEX})^p}} > "
            rf"\frac{{\beta^p}}{{({terms.D_TEX})^{{p/2}}}}",
            Iff(limited, in_powers),
            Routed(SameSign(needed=(1 / sp.sqrt(b), 1 / c), hypothesis=c), thrust.SECOND),
            reading="Condition 1 holds. Without it the first inequality is true and the second "
            "need not be, or its power is undefined: p = 2, beta = eta = 1, iota = 0, zeta = 2 "
            "gives -4/3 < 1 and 9/16 < 1.",
            read_as=Implies(first, Iff(limited, in_powers)),
        ),
    )  # fmt: skip


def _threshold_and_existence() -> tuple[Statement, ...]:
    branch = OnTheBranch((domains.BRANCH,))
    power = terms.K**p * beta ** (2 * p) / terms.D**p - beta**p / terms.D ** (p / 2)
    dilatation = terms.F * terms.B * N * terms.cosine
    return (
        terms.statement(
            "sheared-branch",
            "The sheared states are a branch that leaves the straight ones at N_thresh.",
            r"N \sin\theta\,(v_3 - v N \cos\theta) = 0, \quad "
            r"\lim_{\theta \to 0} N = N_{thresh} \ \text{along}\ \theta = \hat\theta(N)",
            Every(
                equal(N * terms.sine * (v[3] - scalar_v * N * terms.cosine), 0),
                equal(LimitOf(N, theta, sp.Integer(0)), N_thresh),
            ),
            Both((Jointly((COUPLE_BALANCE, OnTheBranch((domains.BRANCH,)))),
                  OnTheBranch((domains.BRANCH_FROM_ZERO,), named=frozenset((N_thresh,))))),
            note="N increases with the angle from N_thresh to infinity, so that the branch is a "
            "continuous graph over N > N_thresh and meets theta = 0 only at N_thresh. The straight "
            "branch satisfies the equation for every N; at N = 0 it is unstressed, not tensile.",
        ),
        terms.statement(
            "n-thresh", "Definition of the threshold thrust.",
            rf"N_{{thresh}}^{{-p}} = {terms.K_TEX}^p \frac{{\beta^{{2p}}}}{{({terms.D_TEX})^p}} - "
            rf"\frac{{\beta^p}}{{({terms.D_TEX})^{{p/2}}}}",
            equal(N_thresh ** (-p), power), branch, label="eq:N0def", introduces=True,
            note="Positive exactly under conditions 1 and 2.",
        ),
        terms.statement(
            "sheared-existence",
            "Above the threshold exactly one angle in (0, pi/2) gives a sheared state.",
            rf"v_3 - 1 = {terms.F_TEX} {terms.B_TEX} N \cos\theta = {terms.K_TEX}^{{-1}}, \quad "
            r"\theta = \hat\theta(N)",
            chain(v[3] - 1, "=", dilatation, "=", 1 / terms.K), branch,
            note="At and below the threshold there is none: extra-threshold-sharp.",
        ),
        terms.statement(
            "sheared-v3-of-theta", "v_3 - 1 as a function of thrust and angle.",
            rf"v_3 - 1 = {terms.F_TEX} {terms.B_TEX} N \cos\theta",
            equal(v[3] - 1, dilatation), InAllStates(domains.PUSHED_OR_PULLED),
            label="eq:TTv3def",
        ),
    )  # fmt: skip
