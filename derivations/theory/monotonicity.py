"""Section 3.4 from first principles: the tangent of the law, at every strain and at rest.

With gamma = 1, radii x = Q^{1/2}, y = (Q*)^{1/2} and X = x^p, Y = y^p the law reads

    sigma = F(x) K eps,   F = (1 - X)^{-1/p},        eps = f(y) K^{-1} sigma,   f = (1 + Y)^{-1/p}.

Problem: find D^2 W = d sigma/d eps and D^2 W* = d eps/d sigma for every strain with Q < 1, rest
included, and decide their definiteness. Differentiating sigma, with grad Q = 2 K eps,

    D^2 W  = F/(1 - X) [(1 - X) K + (X/Q) (K eps)(K eps)^T]                              (strains)
    D^2 W* = f/(1 + Y) [K^{-1} + Y (K^{-1} - (K^{-1} sigma)(K^{-1} sigma)^T/Q*)]         (loads)

These structures are claims, proved entry by entry against plain differentiation. At rest the
ray quotient sigma(h eps)/h tends to K eps, so D^2 W(rest) = K for every p > 0; and as
|(K eps)_i (K eps)_j| <= Q (K_ii K_jj)^{1/2} (Cauchy-Schwarz), the second term is at most
X (K_ii K_jj)^{1/2} and vanishes at rest although Q^{p/2 - 1} is infinite there for p < 2.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.symbols import LOADS, STRAINS, gamma, p
from rodproof.derivations.theory.constitutive import (
    STRAIN_FROM_REST,
    compliance,
    compliance_at_rest,
    dual_form,
    loads,
    quadratic_form,
    stiffness,
    stiffness_at_rest,
)

h = sp.Symbol("h", positive=True)

#: A second strain (a, b), the argument of the quadratic form of the Hessian.
DIRECTION: tuple[sp.Symbol, ...] = sp.symbols("a1:4 b1:4", real=True)


@cache
def unit_loads() -> tuple[sp.Expr, ...]:
    """The loads as functions of the strains, with gamma = 1."""
    return tuple(e.subs(gamma, 1) for e in loads())


@cache
def hessian() -> sp.ImmutableMatrix:
    """D^2 W with gamma = 1 away from rest, the loads differentiated entry by entry."""
    return sp.ImmutableMatrix(stiffness().subs(gamma, 1))


@cache
def inverse_hessian() -> sp.ImmutableMatrix:
    """D^2 W* with gamma = 1 away from zero load, the strains differentiated entry by entry."""
    return sp.ImmutableMatrix(compliance().subs(gamma, 1))


@cache
def load_direction() -> sp.ImmutableMatrix:
    """K eps, the direction of the load."""
    return sp.ImmutableMatrix(stiffness_at_rest() * sp.Matrix(STRAIN_FROM_REST))


@cache
def strain_direction() -> sp.ImmutableMatrix:
    """K^{-1} sigma, the direction of the strain."""
    return sp.ImmutableMatrix(compliance_at_rest() * sp.Matrix(LOADS))


@cache
def hessian_factor() -> sp.Expr:
    """F/(1 - X), what stands before the bracket of D^2 W; positive for Q < 1."""
    return (1 - quadratic_form() ** (p / 2)) ** (-1 / p - 1)


@cache
def hessian_core() -> sp.ImmutableMatrix:
    """(1 - X) K + (X/Q) (K eps)(K eps)^T: K weighed by a positive number, and a square."""
    Q = quadratic_form()
    k = load_direction()
    return sp.ImmutableMatrix((1 - Q ** (p / 2)) * stiffness_at_rest() + Q ** (p / 2 - 1) * k * k.T)


@cache
def inverse_factor() -> sp.Expr:
    """f/(1 + Y), what stands before the bracket of D^2 W*; always positive."""
    return (1 + dual_form() ** (p / 2)) ** (-1 / p - 1)


@cache
def inverse_core() -> sp.ImmutableMatrix:
    """K^{-1} + Y (K^{-1} - (K^{-1} sigma)(K^{-1} sigma)^T/Q*): the bracket is semidefinite."""
    form, k = dual_form(), strain_direction()
    bracket = compliance_at_rest() - k * k.T / form
    return sp.ImmutableMatrix(compliance_at_rest() + form ** (p / 2) * bracket)


def form_of(matrix: sp.ImmutableMatrix) -> sp.Expr:
    """The quadratic form of a matrix at the direction (a, b)."""
    w = sp.Matrix(DIRECTION)
    return (w.T * matrix * w)[0, 0]


@cache
def rest_form() -> sp.Expr:
    """(a, b) . K (a, b), the form Q as a form: homogeneous, no component shifted by one."""
    return form_of(stiffness_at_rest())


@cache
def along_ray(expr: sp.Expr) -> sp.Expr:
    """An expression in the strains at rest + h eps."""
    shifted = {s: h * s for s in STRAINS[:5]}
    return expr.xreplace({**shifted, STRAINS[5]: 1 + h * STRAIN_FROM_REST[5]})


@cache
def rest_quotient(load: sp.Expr, strain: int) -> sp.Expr:
    """load(h e_j)/h along the j-th strain; its limit at h -> 0 is the derivative at rest.

    load: a component of the gradient of W as an expression in the strains, zero at rest.
    """
    at = dict.fromkeys(STRAINS, sp.Integer(0))
    at[STRAINS[5]] = sp.Integer(1)
    at[STRAINS[strain]] += h
    return load.subs(at) / h


# -- two states ----------------------------------------------------------------------------------

#: Strains of two states A and B, and the radii x = Q^{1/2}, y = (Q*)^{1/2} of each.
STATE_A: tuple[sp.Symbol, ...] = sp.symbols("uA1:4 vA1:4", real=True)
STATE_B: tuple[sp.Symbol, ...] = sp.symbols("uB1:4 vB1:4", real=True)


def strain_radius(state: tuple[sp.Symbol, ...]) -> sp.Expr:
    """x = Q^{1/2} of a state."""
    return sp.sqrt(quadratic_form().xreplace(dict(zip(STRAINS, state, strict=True))))


def load_radius(state: tuple[sp.Symbol, ...]) -> sp.Expr:
    """y = x (1 - x^p)^{-1/p} of a state, increasing in x (gamma = 1)."""
    x = strain_radius(state)
    return x * (1 - x**p) ** (-1 / p)


def work_of_increments() -> sp.Expr:
    """(sigma_B - sigma_A) . (eps_B - eps_A) for the loads that belong to two strains."""
    first, second = (
        dict(zip(STRAINS, STATE_A, strict=True)),
        dict(zip(STRAINS, STATE_B, strict=True)),
    )
    return sp.Add(
        *(
            (load.xreplace(second) - load.xreplace(first)) * (b - a)
            for load, a, b in zip(unit_loads(), STATE_A, STATE_B, strict=True)
        )
    )


def increment_gap() -> sp.Expr:
    """(y_A/x_A + y_B/x_B) (x_A x_B - eps_A . K eps_B).

    By this the work of the increments exceeds (x_B - x_A)(y_B - y_A): with sigma = (y/x) K eps
    both sides expand to the same. The second factor is not negative by Cauchy-Schwarz in K.
    """
    K = stiffness_at_rest()
    a, b = (sp.Matrix([*state[:5], state[5] - 1]) for state in (STATE_A, STATE_B))
    secants = sp.Add(*(load_radius(s) / strain_radius(s) for s in (STATE_A, STATE_B)))
    return secants * (strain_radius(STATE_A) * strain_radius(STATE_B) - (a.T * K * b)[0, 0])
