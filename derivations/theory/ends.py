"""Section 5.1, conditions at the ends, for equilibria under n = N g_3 without body loads.

From m' + r' x n = 0 and n' = 0 the vector m + r x n is constant along the rod. Problem: what the
two sets of conditions of the paper say of a general equilibrium, and of the two branches under
pure thrust (m = 0): theta = 0, and the sheared one with v_3 = v N cos(theta), 0 < theta < pi/2.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.symbols import v3
from rodproof.derivations.theory import euler
from rodproof.derivations.theory.frames import theta

origin = sp.Matrix(sp.symbols("o1:4", real=True))
first_couple = sp.Matrix(sp.symbols("m_a1:4", real=True))  # m(0)
last_place = sp.Matrix(sp.symbols("r_b1:4", real=True))  # r(1)
force = sp.Matrix([0, 0, euler.N])


any_force = sp.Matrix(sp.symbols("n_b1:4", real=True))


@cache
def last_couple() -> sp.Matrix:
    """m(1) of any equilibrium with r(0) = o: m(1) + (r(1) - o) x n = m(0)."""
    return sp.ImmutableMatrix(first_couple - (last_place - origin).cross(any_force))


@cache
def straight() -> sp.Matrix:
    """r(1) - r(0) on the branch theta = 0: r' is constant."""
    return sp.ImmutableMatrix(euler.tangent().xreplace({sp.sin(theta): 0, sp.cos(theta): 1}))


@cache
def sheared() -> sp.Matrix:
    """r(1) - r(0) on the sheared branch, where v_3 = v N cos(theta)."""
    condition = {v3: euler.v_scalar * euler.N * sp.cos(theta)}
    tangent = euler.tangent().xreplace(condition)
    return sp.ImmutableMatrix(tangent.applyfunc(euler.reduce_squares))


@cache
def tilt() -> sp.Expr:
    """d_3 . g_3, the cosine of the angle between the section's normal and the force."""
    return euler.directors()[2][2]
