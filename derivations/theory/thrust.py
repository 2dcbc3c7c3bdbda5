"""Section 4.2 from first principles: a rod under end thrust alone.

Problem: n = N g_3 and m = 0 along the whole rod (L = gamma = 1). Find all states of equilibrium.

The law gives the strains from the components of N g_3 in the directors; what is left of the
balance laws is r' x n = 0. With the polar angle theta of d_3, x = cos theta and

    a = 1/zeta^2,   b = beta^2/(beta^2 eta^2 - iota^2),   c = a - b,   w(x) = a - c x^2,

the factor of the law is F = (1 + |N|^p w^{p/2})^{-1/p}, v_3 = 1 + b F N x, the shear strain along
the force's shear component is a F times it, and balance is N sin theta (1 - c F N x) = 0. Its
second factor is, for N x > 0, the equation

    N^{-p} = c^p x^p - w(x)^{p/2},

which is explicit in N: every sheared state is found from its angle in closed form, for every p.
Nothing here is copied from the printed formulas; they are held against this module.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.symbols import LOADS, p
from rodproof.derivations.theory import constitutive
from rodproof.derivations.theory.frames import euler_frame, phi, psi, theta

N = sp.Symbol("N", real=True)
x = sp.Symbol("x", positive=True)  # cos theta on the branch of sheared states
s = sp.Symbol("s", real=True)

# -- the law under a pure force ---------------------------------------------------------------


@cache
def force_components(
    thrust: sp.Expr = N, polar: sp.Expr = theta, twist: sp.Expr = psi
) -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """The components of N g_3 in the directors: N times the third entries of d_1, d_2, d_3."""
    return tuple(thrust * d[2] for d in euler_frame(phi, polar, twist))


@cache
def dual_form(thrust: sp.Expr = N, polar: sp.Expr = theta) -> sp.Expr:
    """Q* at m = 0 and n = N g_3; the form is hemitropic, so psi may be taken as 0."""
    load = (*[sp.Integer(0)] * 3, *force_components(thrust, polar, sp.Integer(0)))
    return constitutive.dual_form().xreplace(dict(zip(LOADS, load, strict=True)))


@cache
def law_factor(thrust: sp.Expr = N, polar: sp.Expr = theta) -> sp.Expr:
    """F = (1 + Q*^{p/2})^{-1/p}."""
    return (1 + dual_form(thrust, polar) ** (p / 2)) ** (-1 / p)


@cache
def strains_from_rest(
    thrust: sp.Expr = N, polar: sp.Expr = theta, twist: sp.Expr = psi
) -> tuple[sp.Expr, ...]:
    """(u_1, u_2, u_3, v_1, v_2, v_3 - 1) at m = 0 and n = N g_3: F K^{-1} (0, n)."""
    load = sp.Matrix([0, 0, 0, *force_components(thrust, polar, twist)])
    factor = law_factor(thrust, polar)
    return tuple(factor * row for row in constitutive.compliance_at_rest() * load)


def shear_scalar(thrust: sp.Expr = N, polar: sp.Expr = theta) -> sp.Expr:
    """v, the factor between shear forces and shear strains."""
    return law_factor(thrust, polar) * shear_compliance()


@cache
def tangent(
    thrust: sp.Expr = N, polar: sp.Expr = theta, twist: sp.Expr = psi, azimuth: sp.Expr = phi
) -> sp.Matrix:
    """r' = v_k d_k in the fixed basis."""
    strains = strains_from_rest(thrust, polar, twist)
    v = (strains[3], strains[4], 1 + strains[5])
    frame = euler_frame(azimuth, polar, twist)
    return sum((c * d for c, d in zip(v, frame, strict=True)), sp.zeros(3, 1))


def unbalanced_couple(
    thrust: sp.Expr = N, polar: sp.Expr = theta, twist: sp.Expr = psi, azimuth: sp.Expr = phi
) -> sp.Matrix:
    """(r' x n) . e_k: what must vanish, as m = 0. Only the second component can differ from 0."""
    force = sp.Matrix([0, 0, thrust])
    couple = tangent(thrust, polar, twist, azimuth).cross(force)
    basis = euler_frame(azimuth, polar, sp.Integer(0))
    return sp.Matrix([couple.dot(e) for e in basis])


# -- the short names --------------------------------------------------------------------------


@cache
def shear_compliance() -> sp.Expr:
    """a = 1/zeta^2."""
    return constitutive.compliance_at_rest()[3, 3]


@cache
def axial_compliance() -> sp.Expr:
    """b = beta^2/(beta^2 eta^2 - iota^2)."""
    return constitutive.compliance_at_rest()[5, 5]


@cache
def twist_compliance() -> sp.Expr:
    """The twist per unit tension of the law at rest, -iota/(beta^2 eta^2 - iota^2)."""
    return constitutive.compliance_at_rest()[2, 5]


@cache
def softness() -> sp.Expr:
    """c = a - b: by how much the rod is softer in shear than in extension. Condition 1: c > 0."""
    return sp.together(shear_compliance() - axial_compliance())


@cache
def weight(at: sp.Expr = x) -> sp.Expr:
    """w = Q*/N^2 = a sin^2 theta + b cos^2 theta as a function of x = cos theta."""
    return shear_compliance() * (1 - at**2) + axial_compliance() * at**2


# -- sheared states ---------------------------------------------------------------------------


@cache
def dilatation_when_sheared() -> sp.Expr:
    """v_3 - 1 where v_3 = v N cos theta: with y = F N cos theta, a y = 1 + b y gives b y = b/c."""
    y = sp.Symbol("y")
    (solution,) = sp.solve(sp.Eq(shear_compliance() * y, 1 + axial_compliance() * y), y)
    return sp.factor(axial_compliance() * solution)


def stretched_force() -> sp.Expr:
    """F N cos theta in a sheared state, 1/c, whatever N and p."""
    return 1 / softness()


def inverse_thrust_power(at: sp.Expr = x) -> sp.Expr:
    """N^{-p} of the sheared state with cos theta = x.

    1 = c F N x is (1 + N^p w^{p/2}) = (c N x)^p; divided by N^p that is linear in N^{-p}.
    """
    return (softness() * at) ** p - weight(at) ** (p / 2)


def thrust_of_angle(at: sp.Expr = x) -> sp.Expr:
    """N > 0 of the sheared state with cos theta = x."""
    return inverse_thrust_power(at) ** (-1 / p)


def thrust_near_zero(polar: sp.Expr = theta) -> sp.Expr:
    """The same as a function of theta, with Q*/N^2 in sin theta and cos theta."""
    power = (softness() * sp.cos(polar)) ** p - dual_form(sp.Integer(1), polar) ** (p / 2)
    return power ** (-1 / p)


def threshold_power() -> sp.Expr:
    """N_thresh^{-p}: the state with theta = 0 at which the sheared states begin (x = 1)."""
    return inverse_thrust_power(sp.Integer(1))


def threshold() -> sp.Expr:
    """N_thresh."""
    return threshold_power() ** (-1 / p)


@cache
def limiting_cosine() -> sp.Expr:
    """x at which N is infinite: (c x)^p = w^{p/2}, so c^2 x^2 = a - c x^2, linear in x^2."""
    X = sp.Symbol("X")
    a, c = sp.symbols("a c")
    (solution,) = sp.solve(sp.Eq(c**2 * X, a - c * X), X)
    return sp.sqrt(solution.subs({a: shear_compliance(), c: softness()}))


# -- v_3 - 1 as a function of x ---------------------------------------------------------------


def dilatation(thrust: sp.Expr, at: sp.Expr = x) -> sp.Expr:
    """f_N(x): v_3 - 1 under a thrust N > 0 if cos theta = x, balanced or not."""
    factor = (1 + (thrust**2 * weight(at)) ** (p / 2)) ** (-1 / p)
    return factor * axial_compliance() * thrust * at


# -- straight states --------------------------------------------------------------------------


def straight_strain(index: int, thrust: sp.Expr = N) -> sp.Expr:
    """Component `index` of the strain from rest at theta = 0."""
    return strains_from_rest(thrust, sp.Integer(0), sp.Integer(0))[index]


def last_compression() -> sp.Expr:
    """The N < 0 at which the straight state would have v_3 = 0 (where b > 1).

    1 = b F |N| is 1 + b^{p/2} |N|^p = b^p |N|^p, linear in |N|^{-p}.
    """
    b = axial_compliance()
    return -((b**p - b ** (p / 2)) ** (-1 / p))


@cache
def strand_handedness(twist: sp.Expr, radius: sp.Expr, stretch: sp.Expr) -> sp.Expr:
    """(r' x r'') . r''' of a strand at distance `radius` from the axis of a rod twisted by `twist`.

    Positive for a right-handed helix.
    """
    strand = sp.Matrix([radius * sp.cos(twist * s), radius * sp.sin(twist * s), stretch * s])
    d1, d2, d3 = (strand.diff(s, k) for k in (1, 2, 3))
    return sp.trigsimp(d1.cross(d2).dot(d3))
