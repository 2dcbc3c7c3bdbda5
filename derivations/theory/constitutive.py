"""Section 3.1 from first principles: one stiffness matrix and one scalar law give everything.

Let eps = (u1, u2, u3, v1, v2, v3 - 1) be the strain measured from rest, sigma = (m, n) the load,
and gamma K the stiffness of the rod at small strain,

    K = diag(alpha^2, alpha^2, [beta^2 iota; iota eta^2] on (u3, v3 - 1), zeta^2, zeta^2).

Problem: given the complementary energy

    W*(m, n) = 1/2 int_0^{Q*} (gamma^p + t^{p/2})^{-1/p} dt,   Q* = sigma . K^{-1} sigma,

find the strains (its gradient), the loads as functions of the strains (the inverse), the stored
energy W (the work done along a ray), both Hessians, the limits of the strains, and closed forms.
Nothing here is copied from the printed formulas; they are held against this module.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from rodproof.derivations.symbols import (
    LOADS,
    STRAINS,
    alpha,
    beta,
    eta,
    gamma,
    iota,
    p,
    v3,
    zeta,
)

#: Order of the six components everywhere: (u1, u2, u3, v1, v2, v3) and (m1, m2, m3, n1, n2, n3).
STRAIN_FROM_REST: tuple[sp.Expr, ...] = (*STRAINS[:5], v3 - 1)

t = sp.Symbol("t", positive=True)
x, y = sp.symbols("x y", positive=True)  # x = Q^(1/2) < 1 and y = (Q*)^(1/2), the two radii


@cache
def stiffness_at_rest() -> sp.ImmutableMatrix:
    """K, the stiffness at rest divided by gamma, in the order (u1, u2, u3, v1, v2, v3)."""
    K = sp.diag(alpha**2, alpha**2, beta**2, zeta**2, zeta**2, eta**2)
    K[2, 5] = K[5, 2] = iota
    return sp.ImmutableMatrix(K)


@cache
def compliance_at_rest() -> sp.ImmutableMatrix:
    """K^{-1}, by elimination in the field of rational functions of the constants."""
    return sp.ImmutableMatrix(stiffness_at_rest().to_DM().to_field().inv().to_Matrix())


@cache
def quadratic_form() -> sp.Expr:
    """Q = eps . K eps, the square of the strain radius x."""
    eps = sp.Matrix(STRAIN_FROM_REST)
    return (eps.T * stiffness_at_rest() * eps)[0, 0]


@cache
def dual_form() -> sp.Expr:
    """Q* = sigma . K^{-1} sigma, the square of the load radius y."""
    sigma = sp.Matrix(LOADS)
    return (sigma.T * compliance_at_rest() * sigma)[0, 0]


def complementary_energy() -> sp.Expr:
    """W* as its defining integral (a SymPy ``Integral`` with the upper limit Q*)."""
    return sp.Integral((gamma**p + t ** (p / 2)) ** (-1 / p), (t, 0, dual_form())) / 2


@cache
def strains() -> tuple[sp.Expr, ...]:
    """The six strains from rest as the gradient of W* (fundamental theorem of calculus)."""
    return tuple(sp.diff(complementary_energy(), load) for load in LOADS)


@cache
def law_of_strains() -> tuple[sp.Expr, ...]:
    """The law in its structural form, (gamma^p + Q*^{p/2})^{-1/p} K^{-1} sigma.

    What a one-dimensional response x = y (gamma^p + y^p)^{-1/p} becomes in six dimensions; that
    it is the gradient of W* is the content of statement ``wstar-gradient``.
    """
    factor = (gamma**p + dual_form() ** (p / 2)) ** (-1 / p)
    return tuple(factor * row for row in compliance_at_rest() * sp.Matrix(LOADS))


@dataclass(frozen=True)
class RadialLaw:
    """The scalar law between the radii, and its inverse: x = strain(y), y = load(x)."""

    strain: sp.Expr
    load: sp.Expr


@cache
def radial_law() -> RadialLaw:
    """x = y (gamma^p + y^p)^{-1/p}, solved for y.

    eps = f K^{-1} sigma gives Q = f^2 Q*, so x = f(y) y. With X = x^p, Y = y^p, G = gamma^p that
    is X (G + Y) = Y, linear in Y.
    """
    strain = y * (gamma**p + y**p) ** (-1 / p)
    X, Y, G = sp.symbols("X Y G", positive=True)
    slope, constant = sp.Poly(X * (G + Y) - Y, Y).all_coeffs()
    solution = sp.cancel(-constant / slope)  # = G X/(1 - X)
    load = gamma * x * sp.powsimp((solution / (G * X)).subs(X, x**p)) ** (1 / p)
    return RadialLaw(strain, load)


@cache
def loads() -> tuple[sp.Expr, ...]:
    """The six loads as functions of the strains: sigma = (y/x) K eps with y = load(x)."""
    factor = (radial_law().load / x).subs(x, sp.sqrt(quadratic_form()))
    return tuple(factor * row for row in stiffness_at_rest() * sp.Matrix(STRAIN_FROM_REST))


@cache
def stored_energy() -> sp.Expr:
    """W, the work done by the loads along the ray from rest, int_0^1 sigma(tau eps) . eps dtau.

    On the ray Q becomes tau^2 Q and sigma . eps becomes (y/x)(tau x) tau Q; with t = tau^2 Q,
    dt = 2 tau Q dtau, the integral is 1/2 int_0^Q (y/x)(t^{1/2}) dt.
    """
    integrand = (radial_law().load / x).subs(x, sp.sqrt(t))
    return sp.Integral(integrand, (t, 0, quadratic_form())) / 2


@cache
def stiffness() -> sp.ImmutableMatrix:
    """D^2 W = d(m, n)/d(u, v), differentiated entry by entry."""
    return sp.ImmutableMatrix(6, 6, lambda i, j: sp.diff(loads()[i], STRAINS[j]))


@cache
def compliance() -> sp.ImmutableMatrix:
    """D^2 W* = d(u, v)/d(m, n), differentiated entry by entry."""
    return sp.ImmutableMatrix(6, 6, lambda i, j: sp.diff(strains()[i], LOADS[j]))


@cache
def loads_at_leading_order() -> tuple[sp.Expr, ...]:
    """lim_{h -> 0} sigma(h eps)/h, the linear law near rest.

    sigma(h eps)/h = gamma (1 - h^p Q^{p/2})^{-1/p} K eps, and h^p -> 0 since p > 0.
    """
    h = sp.Symbol("h", positive=True)
    X = h * sp.sqrt(quadratic_form())
    factor = gamma * (1 - X**p) ** (-1 / p)  # = (y/x)(X), proved in step "the inverse law"
    at_rest = factor.xreplace({X**p: sp.Integer(0)})
    return tuple(at_rest * row for row in stiffness_at_rest() * sp.Matrix(STRAIN_FROM_REST))


@dataclass(frozen=True)
class SharpBound:
    """|functional| < bound on all strains with Q < 1, approached at `extremal` (where Q = 1)."""

    bound: sp.Expr
    extremal: tuple[sp.Expr, ...]


@cache
def sharp_bound(*functional: sp.Expr) -> SharpBound:
    """The support function of the ellipsoid Q < 1: sup a . eps = (a . K^{-1} a)^{1/2}.

    Cauchy-Schwarz in the inner product of K: a . eps = (K^{-1} a) . K eps
    <= (a . K^{-1} a)^{1/2} Q^{1/2}, with equality at eps = K^{-1} a/(a . K^{-1} a)^{1/2}.
    """
    a = sp.Matrix(functional)
    image = compliance_at_rest() * a
    bound = sp.sqrt(sp.trigsimp(sp.cancel((a.T * image)[0, 0])))
    return SharpBound(bound, tuple(e / bound for e in image))


def stored_energy_closed() -> sp.Expr:
    """W for any p: gamma x^2/2 2F1(1/p, 2/p; 1 + 2/p; x^p)."""
    return gamma * x**2 / 2 * sp.hyper([1 / p, 2 / p], [1 + 2 / p], x**p)


def complementary_energy_closed() -> sp.Expr:
    """W* for any p: y^2/(2 gamma) 2F1(1/p, 2/p; 1 + 2/p; -(y/gamma)^p)."""
    return y**2 / (2 * gamma) * sp.hyper([1 / p, 2 / p], [1 + 2 / p], -((y / gamma) ** p))


#: Elementary closed forms in the radii: p -> (W(x), W*(y)). By Chebyshev's theorem on
#: int x^m (a + b x^n)^q dx, here m = 1, n = p, q = -1/p, a rational p gives an elementary
#: integral exactly if q, (m+1)/n or their sum is an integer: 1/p or 2/p, so p = 2/k, k = 1, 2, ...
ELEMENTARY: dict[sp.Rational, tuple[sp.Expr, sp.Expr]] = {
    sp.Integer(2): (gamma * (1 - sp.sqrt(1 - x**2)), sp.sqrt(gamma**2 + y**2) - gamma),
    sp.Integer(1): (gamma * (-x - sp.log(1 - x)), y - gamma * sp.log(1 + y / gamma)),
}


@cache
def stiffness_structure() -> sp.ImmutableMatrix:
    """gamma (1 - q)^{-1/p} (K + q/(1 - q) k k^T/Q) with q = Q^{p/2}, k = K eps."""
    q, Q = quadratic_form() ** (p / 2), quadratic_form()
    k = stiffness_at_rest() * sp.Matrix(STRAIN_FROM_REST)
    return sp.ImmutableMatrix(
        gamma * (1 - q) ** (-1 / p) * (stiffness_at_rest() + q / (1 - q) / Q * k * k.T)
    )


@cache
def compliance_structure() -> sp.ImmutableMatrix:
    """(gamma^p + q)^{-1/p} (K^{-1} - q/(gamma^p + q) e e^T/Q*), q = Q*^{p/2}, e = K^{-1} sigma."""
    q, Qstar = dual_form() ** (p / 2), dual_form()
    e = compliance_at_rest() * sp.Matrix(LOADS)
    scale = gamma**p + q
    rank_one = q / scale / Qstar * e * e.T
    return sp.ImmutableMatrix(scale ** (-1 / p) * (compliance_at_rest() - rank_one))
