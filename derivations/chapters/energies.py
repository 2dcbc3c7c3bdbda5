"""The two energies: work, Legendre-Fenchel duality, closed forms (Section 3.1)."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks import constitutive as rules
from rodproof.derivations.checks import energies
from rodproof.derivations.notation import Q, W, equal, t, u, v
from rodproof.derivations.records import Derivation, Step
from rodproof.derivations.symbols import gamma, p
from rodproof.derivations.theory import constitutive as theory


def derivations() -> tuple[Derivation, ...]:
    """The derivations of this chapter, in reading order."""
    return (_stored(), _duality(), _closed_forms())


def _stored() -> Derivation:
    integrand = (1 - t ** (p / 2)) ** (-1 / p)
    return Derivation(
        label="stored-energy",
        title="The stored energy as the work of the loads",
        problem="Find `W` with `(m, n) = dW/d(u, v)` and `W = 0` at rest.",
        steps=(
            Step(
                "Work along a ray",
                "`int_0^1 sigma(tau eps) . eps d tau` with `t = tau^2 Q`; the "
                "gradient of the result is the law, so the work does not depend on the path.",
                equal(W(u, v), gamma * sp.Integral(integrand, (t, 0, Q(u, v))) / 2),
                rules.STORED_POTENTIAL,
                ("w-definition", "w-gradient"),
            ),
        ),
    )


def _duality() -> Derivation:
    x, y = theory.x, theory.y
    return Derivation(
        label="duality",
        title="Legendre-Fenchel duality",
        problem="Show that `W` and `W*` are conjugate: `W + W* = m . u + n . (v - e_3)` at strains "
        "and loads that belong to each other, and `W + W* > m . u + n . (v - e_3)` at all others.",
        steps=(
            Step(
                "Equality",
                "In the radii, with `yhat` the load at a strain: "
                "`d/dy [W(x(y)) + W*(y) - x(y) y] = (yhat(x) - y) dx/dy = 0`, "
                "and all three vanish at zero.",
                equal(energies.STORED(x) + energies.COMPLEMENTARY(y), x * y),
                energies.YOUNG,
            ),
            Step(
                "Strictness",
                "The load grows with the strain: `W` is strictly convex in `x`, so "
                "Young's inequality is strict elsewhere; Cauchy-Schwarz in the inner product of "
                "`K` gives `m . u + n . (v - e_3) <= x y`.",
                sp.Gt(sp.Derivative(energies.LOAD(x), x), 0),
                energies.CONVEX,
            ),
        ),
    )


def _closed_forms() -> Derivation:
    x, y = theory.x, theory.y
    general = (
        Step(
            "Stored energy, any `p`",
            "Integrate the binomial series of `(1 - r^p)^{-1/p} r` term by term; "
            "`(2/p)_k/(1 + 2/p)_k = 2/(2 + p k)`.",
            equal(energies.STORED(x), theory.stored_energy_closed()),
            energies.SERIES_STORED,
        ),
        Step(
            "Complementary energy, any `p`",
            "The same series in `-(r/gamma)^p`; analytic continuation carries it beyond "
            "`y = gamma`.",
            equal(energies.COMPLEMENTARY(y), theory.complementary_energy_closed()),
            energies.SERIES_COMPLEMENTARY,
        ),
    )
    special = tuple(
        Step(
            f"Elementary: `p = {power}`",
            "Differentiate: the slopes are the load at `x` and the strain at `y`, and "
            "both vanish at zero.",
            sp.Tuple(
                equal(energies.STORED(x), stored), equal(energies.COMPLEMENTARY(y), complementary)
            ),
            energies.Elementary(power),
        )
        for power, (stored, complementary) in theory.ELEMENTARY.items()
    )
    return Derivation(
        label="closed-forms",
        title="Closed forms of both energies",
        problem="Evaluate the integrals. By Chebyshev's theorem on binomial differentials "
        "`int r (1 - r^p)^{-1/p} dr` is elementary for rational `p` exactly if `1/p` or `2/p` is "
        "an integer: `p = 2, 1, 2/3, 1/2`, that is `p = 2/k`. For `p > 1` it is an incomplete "
        "beta function.",
        steps=(*general, *special),
    )
