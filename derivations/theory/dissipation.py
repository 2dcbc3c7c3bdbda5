"""Section 5.1, two viscous laws: their static limits and what they dissipate.

With the stored energy W(eps) and the power m . u_t + n . v_t of the loads, an isothermal process
dissipates xi = sigma . eps_t - W_t = (sigma - DW(eps)) . eps_t. Problem: the sign of xi for

    Kelvin-Voigt:   sigma = DW(eps) + DR(eps_t),  R = (mu |u_t|^2 + nu |v_t|^2)/2,
    strain rate:    eps + T eps_t = DW*(sigma),   T = diag(a, a, a, b, b, b).

The first dissipates 2 R. In the second sigma = DW(eps + T eps_t), since DW* is the inverse of DW.
With e = eps, f = eps + T eps_t, DW(e) = g_e K e, x_e = |e|_K and y_e = g_e x_e, equal times give

    a xi = (g_f K f - g_e K e) . (f - e)
         = (y_f - y_e)(x_f - x_e) + (g_e + g_f)(x_e x_f - e . K f) >= 0

as y increases with x and by the inequality of Cauchy and Schwarz; it holds at rest and for every
p > 0. With a != b it fails: near the strain limit D^2 W = g K + c w w^T, w = K eps, is dominated
by its last term, and z . T^{-1} w and z . w can have opposite signs.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.exact.field import Field
from rodproof.derivations.symbols import STRAINS, alpha, p, zeta
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory.constitutive import x

#: Letters of Section 5.1, which the paper uses anew: alpha and beta are times here.
time = sp.Symbol("alpha", nonnegative=True)
second_time = sp.Symbol("beta", nonnegative=True)
viscosity_m = sp.Symbol("mu", nonnegative=True)
viscosity_n = sp.Symbol("nu", nonnegative=True)
a, b = sp.symbols("tau_u tau_v", positive=True)

RATES = sp.symbols("u_t1:4 v_t1:4", real=True)


@cache
def rayleigh() -> sp.Expr:
    """R, half of what the Kelvin-Voigt law dissipates."""
    squares = [rate**2 for rate in RATES]
    return (viscosity_m * sp.Add(*squares[:3]) + viscosity_n * sp.Add(*squares[3:])) / 2


@cache
def kelvin_voigt() -> tuple[sp.Expr, ...]:
    """The loads of the Kelvin-Voigt law."""
    pairs = zip(constitutive.loads(), RATES, strict=True)
    return tuple(load + sp.diff(rayleigh(), rate) for load, rate in pairs)


@cache
def kelvin_voigt_rate() -> sp.Expr:
    """xi = (sigma - DW) . eps_t."""
    viscous = [sp.diff(rayleigh(), rate) for rate in RATES]
    return sp.expand(sp.Add(*(f * rate for f, rate in zip(viscous, RATES, strict=True))))


@cache
def strain_rate() -> tuple[sp.Expr, ...]:
    """The strains from rest of the strain-rate law with one time, eps = DW*(sigma) - T eps_t."""
    pairs = zip(constitutive.strains(), RATES, strict=True)
    return tuple(strain - time * rate for strain, rate in pairs)


xe, xf, product = sp.symbols("x_e x_f e_K_f", real=True)
ge, gf = sp.symbols("g_e g_f", positive=True)


@cache
def strain_rate_dissipation() -> sp.Expr:
    """a xi for equal times, in x_e, x_f, g_e, g_f and the product e . K f."""
    # (g_f K f - g_e K e) . (f - e), term by term
    return gf * xf**2 - gf * product - ge * product + ge * xe**2


@cache
def monotone_part() -> sp.Expr:
    """(y_f - y_e)(x_f - x_e) with y = g x."""
    return (gf * xf - ge * xe) * (xf - xe)


@cache
def angle_part() -> sp.Expr:
    """(g_e + g_f)(x_e x_f - e . K f)."""
    return (ge + gf) * (xe * xf - product)


@cache
def radial_slope() -> sp.Expr:
    """dy/dx of the radial law."""
    return sp.diff(constitutive.radial_law().load, x)


@cache
def tangent_parts() -> tuple[sp.Expr, sp.Expr]:
    """g = y/x and c = g'/x in D^2 W = g K + c w w^T: the gradient of x is w/x."""
    g = constitutive.radial_law().load / x
    return g, sp.diff(g, x) / x


#: A strain of bending and shear of radius x, in equal parts.
MIXED = {
    **dict.fromkeys(STRAINS, sp.Integer(0)),
    STRAINS[0]: x / (sp.sqrt(2) * alpha), STRAINS[3]: x / (sp.sqrt(2) * zeta),
    STRAINS[5]: sp.Integer(1),
}  # fmt: skip


@cache
def loss() -> sp.Expr:
    """z . T^{-1} D^2 W z/c in the limit Q -> 1 at MIXED, for a rate T^{-1} z that dissipates least.

    z is chosen with w_1 z_1 = 1 and w_4 z_4 = -(1 + b/a)/2, between the zeros of the two factors.
    g/c = (1 - x^p) x^{2-p} is continuous at x = 1 and vanishes there.
    """
    w = (alpha**2 * MIXED[STRAINS[0]], zeta**2 * MIXED[STRAINS[3]])
    z = (1 / w[0], -(1 + b / a) / (2 * w[1]))
    elastic = alpha**2 * z[0] ** 2 / a + zeta**2 * z[1] ** 2 / b  # z . T^{-1} K z
    coupled = (w[0] * z[0] + w[1] * z[1]) * (w[0] * z[0] / a + w[1] * z[1] / b)
    return (tangent_ratio() * elastic + coupled).subs(x, 1)


@cache
def tangent_ratio() -> sp.Expr:
    """g/c = (1 - x^p) x^{2-p}, from g = gamma (1 - x^p)^{-1/p} and c = g'/x."""
    g, c = tangent_parts()
    ratio = (1 - x**p) * x ** (2 - p)
    assert Field((1 - x**p,)).equal(g / c, ratio)
    return ratio
