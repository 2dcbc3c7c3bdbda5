"""How strains grow with loads, and what an isolated couple does: the claims of the introduction.

Problem 1: multiply the loads (m, n) by tau > 0. By the law the strains from rest are
f(tau y) tau K^{-1} sigma with f(y) = (gamma^p + y^p)^{-1/p}: all six grow by one common factor.

Problem 2: a couple m fixed in space and no force (n = 0, so m' = 0). Let theta be the angle of d_3
with m and M = |m|. Then m_3 = M cos theta, the bending couple is M sin theta, and n = 0 leaves
v_1 = v_2 = 0. Since u = f m/alpha^2 + (...) d_3, the third director precesses about m at the rate
omega = f M/alpha^2, d_3' = u x d_3 = omega (m/M) x d_3, with theta constant: r' = v_3 d_3 draws a
helix about m whose curvature and torsion are omega sin theta/v_3 and omega cos theta/v_3.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.symbols import LOADS, STRAINS, m1, m2, m3, n1, n2, n3, v3
from rodproof.derivations.theory.constitutive import law_of_strains, stiffness_at_rest
from rodproof.derivations.theory.frames import theta

tau = sp.Symbol("tau", positive=True)
couple = sp.Symbol("M", positive=True)
phase = sp.Symbol("psi_0", real=True)

NO_FORCE = dict.fromkeys((n1, n2, n3), sp.Integer(0))


@cache
def strains_at_multiple() -> tuple[sp.Expr, ...]:
    """The six strains from rest under tau times the loads."""
    scaled = {load: tau * load for load in LOADS}
    return tuple(e.xreplace(scaled) for e in law_of_strains())


@cache
def strains_of_couple() -> tuple[sp.Expr, ...]:
    """The six strains u1, u2, u3, v1, v2, v3 under a couple alone."""
    at = [e.xreplace(NO_FORCE) for e in law_of_strains()]
    return (*at[:5], 1 + at[5])


@cache
def strains_of_spinning_couple() -> tuple[sp.Expr, ...]:
    """The same with m = M (sin theta cos psi_0, sin theta sin psi_0, cos theta)."""
    components = {
        m1: couple * sp.sin(theta) * sp.cos(phase),
        m2: couple * sp.sin(theta) * sp.sin(phase),
        m3: couple * sp.cos(theta),
    }
    return tuple(e.subs(components, simultaneous=True) for e in strains_of_couple())


@cache
def helix() -> tuple[sp.Expr, sp.Expr, sp.Expr]:
    """(curvature, torsion) of the center line and its stretch, as functions of M and theta."""
    at = strains_of_spinning_couple()
    flexure = at[0].subs(phase, 0)  # (u_1^2 + u_2^2)^{1/2} = omega sin theta
    precession = flexure / sp.sin(theta)
    stretch = at[5].subs(phase, 0)
    return flexure / stretch, precession * sp.cos(theta) / stretch, stretch


@cache
def tangent_stiffness_split() -> tuple[sp.ImmutableMatrix, sp.ImmutableMatrix]:
    """K and (K eps)(K eps)^T: the two positive matrices of which D^2 W is a combination."""
    K = stiffness_at_rest()
    eps = sp.Matrix((*STRAINS[:5], v3 - 1))
    image = K * eps
    return K, sp.ImmutableMatrix(image * image.T)
