"""Section 5.1, mathematical perspectives: end conditions, dynamics, dissipation, as printed."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import dynamics as rules
from rodproof.derivations.checks import ends
from rodproof.derivations.checks.dynamics import H, H_t, m_s, n_s, r_tt, u_t, v_t, w
from rodproof.derivations.checks.routes import materials
from rodproof.derivations.notation import (
    Every,
    Partial,
    Summed,
    W,
    Wstar,
    chain,
    equal,
    k,
    m,
    mu,
    n,
    u,
    v,
)
from rodproof.derivations.proof.prover import Identity
from rodproof.derivations.proof.routed import Routed
from rodproof.derivations.records import Statement
from rodproof.derivations.theory.dissipation import (
    a,
    b,
    second_time,
    time,
    viscosity_m,
    viscosity_n,
)
from rodproof.derivations.theory.dynamics import J1, J2, rho_A
from rodproof.derivations.theory.euler import N

SECTION = "5.1"


def statements() -> tuple[Statement, ...]:
    """The statements of the section, in the order of the paper."""
    return (*_ends(), *_momentum(), *_dissipation(), *_laws())


def _resultant(i: int) -> sp.Expr:
    """A component of m(1) + (r(1) - o) x n(1) - m(0)."""
    j, h = i % 3 + 1, (i + 1) % 3 + 1
    lever = (ends.r_b[j] - ends.o[j]) * ends.n_b[h] - (ends.r_b[h] - ends.o[h]) * ends.n_b[j]
    return ends.m_b[i] + lever - ends.m_a[i]


def _ends() -> tuple[Statement, ...]:
    return (
        Statement(
            id="bc-fixed-end", section=SECTION, label="-",
            claim="With the end s = 0 clamped, d_k(0) = g_k, the sheared state is not present: "
            "its d_3 is at an angle to the force, while the straight state meets the condition.",
            latex=r"0 < \boldsymbol d_3(0) \cdot \boldsymbol g_3 = \cos\hat\theta < 1 = "
            r"\boldsymbol d_3(0) \cdot \boldsymbol g_3 |_{\theta = 0}",
            printed=chain(0, "<", ends.tilt_sheared, "<", 1, "=", ends.tilt_straight),
            check=Identity(ends.TILTS),
            note="The other conditions, m(1) = 0 and n(1) = N g_3, hold on both branches. That "
            "says nothing of states with bending, which the clamp may have.",
        ),
        Statement(
            id="bc-resultant-couple", section=SECTION, label="-",
            claim="With r(0) = o and a zero resultant couple about o both branches are present.",
            latex=r"\boldsymbol r(0) = \boldsymbol o, \quad \boldsymbol m(1) + (\boldsymbol r(1)"
            r" - \boldsymbol o) \times \boldsymbol n(1) - \boldsymbol m(0) = \boldsymbol 0, \quad"
            r" \boldsymbol n(1) = N \boldsymbol g_3",
            printed=Every(
                *(equal(ends.r_a[i], ends.o[i]) for i in (1, 2, 3)),
                *(equal(_resultant(i), 0) for i in (1, 2, 3)),
                equal(ends.n_b[1], 0), equal(ends.n_b[2], 0), equal(ends.n_b[3], N),
            ),
            check=ends.OnBranches(),
            note="True, but the condition on the couple selects nothing: m + r x n is constant "
            "along every equilibrium without body loads, so with r(0) = o every one of them "
            "meets it. It replaces a boundary condition by an identity.",
        ),
    )  # fmt: skip


def _momentum() -> tuple[Statement, ...]:
    centers = (
        "The center line runs through the centers of mass of the sections. Otherwise the first "
        "moments S_mu of the mass add {}"
    )
    return (
        Statement(
            id="dynamic-linear-momentum", section=SECTION, label="eq:linmom",
            claim="Balance of linear momentum.",
            latex=r"(\rho A) \partial_t^2 \boldsymbol r = \partial_s \boldsymbol n",
            printed=equal(rho_A * r_tt[k], n_s[k]), check=Identity(rules.MOVING),
            reading=centers.format(
                "S_mu d_mu,tt on the left. The paper asks for principal axes of inertia only."
            ),
        ),
        Statement(
            id="dynamic-angular-momentum", section=SECTION, label="eq:angmom",
            claim="Balance of angular momentum.",
            latex=r"\partial_t [(\rho \boldsymbol J) \boldsymbol w] = \partial_s \boldsymbol m"
            r" + \partial_s \boldsymbol r \times \boldsymbol n",
            printed=Every(
                *(
                    equal(H_t[i], m_s[i] + v[j] * n[h] - v[h] * n[j])
                    for i, j, h in ((1, 2, 3), (2, 3, 1), (3, 1, 2))
                )
            ),
            check=Identity(rules.MOVING),
            reading=centers.format("(S_mu d_mu) x r_tt on the left. The vector w, which the paper "
                                   "does not define, is the angular velocity, d_k,t = w x d_k."),
        ),
        Statement(
            id="angular-momentum-meaning", section=SECTION, label="-",
            claim="(rho J) w is the angular momentum of the section relative to r; in principal "
            "axes its components are J_1 w_1, J_2 w_2, (J_1 + J_2) w_3.",
            latex=r"\int \rho\, (\boldsymbol\chi - \boldsymbol r) \times \partial_t"
            r"(\boldsymbol\chi - \boldsymbol r)\,dA = J_1 w_1 \boldsymbol d_1 + J_2 w_2"
            r" \boldsymbol d_2 + (J_1 + J_2) w_3 \boldsymbol d_3",
            printed=Every(
                equal(H[1], J1 * w[1]), equal(H[2], J2 * w[2]), equal(H[3], (J1 + J2) * w[3])
            ),
            check=Identity(rules.MOVING_ANYWHERE),
            note="J_1 and J_2 are the second moments of the mass about d_1 and d_2. This one needs "
            "no center of mass.",
        ),
    )  # fmt: skip


def _dissipation() -> tuple[Statement, ...]:
    squares = viscosity_m * Summed(u_t[k] ** 2, k) + viscosity_n * Summed(v_t[k] ** 2, k)
    return (
        Statement(
            id="dissipation-nonnegative", section=SECTION, label="-",
            claim="Each dissipative mechanism comes with a nonnegative dissipation rate.",
            latex=r"\xi_{KV} = \mu |\mathsf u_t|^2 + \nu |\mathsf v_t|^2 \geq 0, \quad"
            r" \xi_{SR} = \mathsf m \cdot \mathsf u_t + \mathsf n \cdot \mathsf v_t - W_t \geq 0",
            printed=Every(
                equal(rules.dissipated_kv, squares),
                chain(rules.dissipated_kv, ">=", 0), chain(rules.dissipated_sr, ">=", 0),
            ),
            check=rules.Dissipates(),
            reading="Read of the two laws of the section, per length, with W of the actual strains "
            "as stored energy, v measured from rest in the first law, and one and the same time "
            "in both its relations (as printed). With two different times it is false: see "
            "extra-strain-rate-two-times.",
        ),
        Statement(
            id="extra-strain-rate-two-times", section=SECTION, label="-",
            claim="With times tau_u for the couple and tau_v for the force the strain-rate law "
            "dissipates in every process if and only if they are equal: near the strain limit the "
            "least rate has the sign of -(tau_u - tau_v)^2.",
            latex=r"\lim_{Q \to 1} \frac{\mathsf z \cdot T^{-1} D^2W \mathsf z}{c} = "
            r"-\frac{(\tau_u - \tau_v)^2}{4 \tau_u^2 \tau_v}",
            printed=equal(rules.loss_at_limit, -((a - b) ** 2) / (4 * a**2 * b)),
            check=Identity(rules.TWO_TIMES),
            note="In equal parts of bending and shear; D^2 W = g K + c w w^T with w = K eps and "
            "g/c = (1 - x^p) x^{2-p} -> 0. Already at small strain a chiral rod needs "
            "4 tau_u tau_v beta^2 eta^2 >= iota^2 (tau_u + tau_v)^2.",
        ),
        Statement(
            id="dissipation-static-limit", section=SECTION, label="-",
            claim="In statics both laws reduce to the constitutive relations of the rod.",
            latex=r"\mathsf u = \frac{\partial W^*}{\partial \mathsf m},\; \mathsf v = "
            r"\frac{\partial W^*}{\partial \mathsf n}; \quad \mathsf m = \frac{\partial W}"
            r"{\partial \mathsf u},\; \mathsf n = \frac{\partial W}{\partial \mathsf v}",
            printed=_statics(v[mu], v[3]), correction=_statics(v[mu], v[3] - 1),
            check=rules.Statics(),
            note="The static limit of the first law as printed gives v = 0 without load: a rod of "
            "length zero. The same slip as in strain-rate-v; the other three limits are right.",
        ),
    )  # fmt: skip


def _statics(shear: sp.Expr, dilatation: sp.Expr) -> Every:
    """The four relations without rates; the second of them for the strains given."""
    return Every(
        *(equal(u[i], Partial(Wstar(m, n), m[i])) for i in (1, 2, 3)),
        *(equal(shear.subs(mu, i), Partial(Wstar(m, n), n[i])) for i in (1, 2)),
        equal(dilatation, Partial(Wstar(m, n), n[3])),
        *(equal(m[i], Partial(W(u, v), u[i])) for i in (1, 2, 3)),
        *(equal(n[i], Partial(W(u, v), v[i])) for i in (1, 2, 3)),
    )


def _laws() -> tuple[Statement, ...]:
    first, second = Identity(rules.STRAIN_RATE), Identity(rules.KELVIN_VOIGT)

    def ahead(rest: int) -> Every:
        strains = (v[1], v[2], v[3] - rest)
        return Every(
            *(
                equal(strain + time * v_t[i], Partial(Wstar(m, n), n[i]))
                for i, strain in enumerate(strains, 1)
            )
        )

    return (
        Statement(
            id="strain-rate-u",
            section=SECTION,
            label="eq:implicitdiss",
            introduces=True,
            claim="Strain-rate law for u.",
            latex=r"\mathsf u + \alpha \partial_t \mathsf u = \frac{\partial W^*}"
            r"{\partial \mathsf m}(\mathsf m, \mathsf n)",
            printed=equal(u[k] + time * u_t[k], Partial(Wstar(m, n), m[k])),
            check=first,
            reading="alpha is a relaxation time here, and not the length alpha of Section 3.1, "
            "which W* contains as well: with that one the two terms on the left differ in "
            "dimension.",
        ),
        Statement(
            id="strain-rate-v",
            section=SECTION,
            label="eq:implicitdiss",
            introduces=True,
            claim="Strain-rate law for v.",
            latex=r"\mathsf v + \alpha \partial_t \mathsf v = \frac{\partial W^*}"
            r"{\partial \mathsf n}(\mathsf m, \mathsf n)",
            printed=ahead(0),
            correction=ahead(1),
            check=first,
            note="The gradient of W* is (v_1, v_2, v_3 - 1). As printed, an unloaded rod at rest "
            "would shrink to length zero. alpha is a time, as in the relation for u; a second time "
            "beta in its place, as the list of constants suggests, would break the second law "
            "(extra-strain-rate-two-times).",
        ),
        Statement(
            id="kelvin-voigt-m",
            section=SECTION,
            label="eq:kelvinvoight",
            introduces=True,
            claim="Kelvin-Voigt law for the contact couple.",
            latex=r"\mathsf m = \frac{\partial W}{\partial \mathsf u}(\mathsf u, \mathsf v)"
            r" + \mu \partial_t \mathsf u",
            printed=equal(m[k], Partial(W(u, v), u[k]) + viscosity_m * u_t[k]),
            check=second,
        ),
        Statement(
            id="kelvin-voigt-n",
            section=SECTION,
            label="eq:kelvinvoight",
            introduces=True,
            claim="Kelvin-Voigt law for the contact force.",
            latex=r"\mathsf n = \frac{\partial W}{\partial \mathsf v}(\mathsf u, \mathsf v)"
            r" + \nu \partial_t \mathsf v",
            printed=equal(n[k], Partial(W(u, v), v[k]) + viscosity_n * v_t[k]),
            check=second,
        ),
        Statement(
            id="dissipation-constants",
            section=SECTION,
            label="-",
            introduces=True,
            claim="Ranges of the constants of the two laws.",
            latex=r"\alpha, \beta, \mu, \nu \geq 0",
            printed=Every(
                *(chain(c, ">=", 0) for c in (time, second_time, viscosity_m, viscosity_n))
            ),
            read_as=Every(*(chain(c, ">=", 0) for c in (time, viscosity_m, viscosity_n))),
            check=Routed(rules.DissipativeConstants(), materials.RANGES),
            reading="beta stands in neither law. The constants that occur are alpha, mu, nu >= 0, "
            "and that is what a nonnegative dissipation needs. If beta was meant as the time in "
            "the relation for v, beta >= 0 is not enough: beta must equal alpha.",
        ),
    )
