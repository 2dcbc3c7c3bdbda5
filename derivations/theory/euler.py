"""Section 4.1 from first principles: the directors by three angles, and equilibrium under N g_3.

The directors are the columns of R = R_3(phi) R_2(theta) R_3(psi) in a fixed basis g_k; the
intermediate frame e_k stops before the last turn. With ' = d/ds and angles that depend on s:

    Darboux vector      u = 1/2 sum_k d_k x d_k'              (kinematics)
    force balance       n' = 0, n(1) = N g_3                  (so n = N g_3)
    couple balance      m' + r' x n = 0,  r' = v_k d_k        (r' is the tangent of the centre line)
    law (gamma = 1)     (u, v - d_3) = f K^{-1} (m, n),  f = (1 + Q*^{p/2})^{-1/p}

Problem: the strains in terms of the angles, the components of n, m in both frames, the balance of
couples projected on e_k, and the system that closes in (phi, theta, psi, M_1, M_2, M_3).

Rates are symbols here: `along` is d/ds by the chain rule, with phi' etc. for the derivatives. All
vectors are columns in the basis g_k unless a name says otherwise. From Section 3.4 on gamma = 1.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import TypeAlias

import sympy as sp

from rodproof.derivations.symbols import LOADS, STRAINS, alpha, gamma, p, v3, zeta
from rodproof.derivations.theory.constitutive import (
    compliance_at_rest,
    dual_form,
    law_of_strains,
)
from rodproof.derivations.theory.frames import dot, euler_frame, phi, psi, rotation_about, theta

Vector: TypeAlias = sp.ImmutableMatrix
Components = tuple[sp.Expr, sp.Expr, sp.Expr]

N = sp.Symbol("N", real=True)  # the force is N g_3; tension for N cos(theta) > 0
M1, M2, M3 = sp.symbols("M1:4", real=True)  # the couple in the intermediate frame
ANGLES: tuple[sp.Symbol, ...] = (phi, theta, psi)
COUPLE: tuple[sp.Symbol, ...] = (M1, M2, M3)

#: The rates: the derivative along s of each unknown of the reduced system.
phi_s, theta_s, psi_s = sp.symbols("varphi_s theta_s psi_s", real=True)
M1_s, M2_s, M3_s = sp.symbols("M1_s M2_s M3_s", real=True)
RATES: Mapping[sp.Symbol, sp.Symbol] = dict(
    zip((*ANGLES, *COUPLE), (phi_s, theta_s, psi_s, M1_s, M2_s, M3_s), strict=True)
)

G3: Vector = sp.ImmutableMatrix([0, 0, 1])


def along(expr: sp.Expr) -> sp.Expr:
    """d/ds by the chain rule: every unknown moves at its rate, everything else is constant."""
    return sp.Add(*(sp.diff(expr, x) * rate for x, rate in RATES.items()))


def along_vector(vector: Vector) -> Vector:
    """d/ds of a column in the fixed basis."""
    return vector.applyfunc(along)


# -- frames ------------------------------------------------------------------------------------


@cache
def directors() -> tuple[Vector, Vector, Vector]:
    """(d_1, d_2, d_3), the columns of R_3(phi) R_2(theta) R_3(psi)."""
    d1, d2, d3 = euler_frame()
    return Vector(d1), Vector(d2), Vector(d3)


@cache
def intermediate_frame() -> tuple[Vector, Vector, Vector]:
    """(e_1, e_2, e_3), the columns of R_3(phi) R_2(theta): right-handed, with e_3 = d_3."""
    R = rotation_about(3, phi) * rotation_about(2, theta)
    return Vector(R[:, 0]), Vector(R[:, 1]), Vector(R[:, 2])


def reduce_squares(expr: sp.Expr) -> sp.Expr:
    """A polynomial in the sines and cosines of the angles with every sin^2 written 1 - cos^2.

    A normal form: two such polynomials agree for all angles exactly if they reduce to the same.
    """
    pairs = [(sp.sin(angle), sp.cos(angle)) for angle in ANGLES]
    generators = [function for pair in pairs for function in pair]
    total = []
    for powers, coefficient in sp.Poly(expr, *generators).terms():
        factors = [coefficient]
        for (sine, cosine), k, j in zip(pairs, powers[::2], powers[1::2], strict=True):
            factors += [sine ** (k % 2), cosine**j, (1 - cosine**2) ** (k // 2)]
        total.append(sp.Mul(*factors))
    return sp.expand(sp.Add(*total))


def in_frame(vector: Vector, frame: tuple[Vector, Vector, Vector]) -> Components:
    """The components of a vector in an orthonormal frame."""
    a, b, c = (reduce_squares(dot(vector, axis)) for axis in frame)
    return a, b, c


def from_components(
    components: tuple[sp.Expr, ...], frame: tuple[Vector, Vector, Vector]
) -> Vector:
    """The vector with these components in the frame."""
    return Vector(sum((c * e for c, e in zip(components, frame, strict=True)), sp.zeros(3, 1)))


@cache
def darboux(frame: tuple[Vector, Vector, Vector]) -> Vector:
    """1/2 sum_k a_k x a_k', the angular rate of a frame: the only u with a_k' = u x a_k."""
    total = sum((a.cross(along_vector(a)) for a in frame), sp.zeros(3, 1))
    return Vector((total / 2).applyfunc(reduce_squares))


@cache
def curvatures() -> Components:
    """(u_1, u_2, u_3): the Darboux vector of the directors, in the directors."""
    return in_frame(darboux(directors()), directors())


@cache
def frame_rates() -> Components:
    """The Darboux vector of the intermediate frame, in that frame."""
    return in_frame(darboux(intermediate_frame()), intermediate_frame())


# -- loads in the two frames --------------------------------------------------------------------


@cache
def force() -> Components:
    """(n_1, n_2, n_3): the force N g_3 in the directors."""
    return in_frame(Vector(N * G3), directors())


@cache
def force_in_frame() -> Components:
    """(N_1, N_2, N_3): the force N g_3 in the intermediate frame."""
    return in_frame(Vector(N * G3), intermediate_frame())


@cache
def couple_in_frame() -> Components:
    """(M_1, M_2, M_3) from the components m_k in the directors."""
    return in_frame(from_components(LOADS[:3], directors()), intermediate_frame())


@cache
def couple() -> Components:
    """(m_1, m_2, m_3) from the components M_k in the intermediate frame."""
    return in_frame(from_components(COUPLE, intermediate_frame()), directors())


# -- the law in the reduced variables (gamma = 1) -----------------------------------------------


@cache
def reduced_loads() -> Mapping[sp.Symbol, sp.Expr]:
    """The six loads in (psi, theta, M_1, M_2, M_3, N): what to substitute in the law."""
    return dict(zip(LOADS, (*couple(), *force()), strict=True))


@cache
def dual_form_reduced() -> sp.Expr:
    """Q*(m, n) in (theta, M_1, M_2, M_3, N): psi drops out, as the law is transversely isotropic.

    The law has the same stiffness for both directions across d_3, so Q* may be evaluated in
    any frame that shares d_3: in e_k instead of d_k, that is at psi = 0.
    """
    at = dict(zip(LOADS, (*COUPLE, *force_in_frame()), strict=True))
    return dual_form().xreplace(at)


@cache
def factor() -> sp.Expr:
    """f = (1 + Q*^{p/2})^{-1/p} in the reduced variables; 0 < f <= 1."""
    return (1 + dual_form_reduced() ** (p / 2)) ** (-1 / p)


@cache
def bending_factor() -> sp.Expr:
    """The scalar u with u_mu = u m_mu."""
    return factor() * compliance_at_rest()[0, 0]


@cache
def shear_factor() -> sp.Expr:
    """The scalar v with v_mu = v n_mu."""
    return factor() * compliance_at_rest()[3, 3]


def _third(row: int) -> sp.Expr:
    loads = sp.Matrix([*COUPLE, *force_in_frame()])
    return (compliance_at_rest()[row, :] * loads)[0, 0]


@cache
def twist() -> sp.Expr:
    """u_3 in (theta, M_1, M_2, M_3, N)."""
    return factor() * _third(2)


@cache
def dilatation() -> sp.Expr:
    """v_3 in (theta, M_1, M_2, M_3, N)."""
    return 1 + factor() * _third(5)


@cache
def strains_from_loads() -> tuple[sp.Expr, ...]:
    """The law with gamma = 1 in (m, n): (u_1, u_2, u_3, v_1, v_2, v_3), v_3 not shifted."""
    law = tuple(e.subs(gamma, 1) for e in law_of_strains())
    return (*law[:5], 1 + law[5])


# -- equilibrium --------------------------------------------------------------------------------

#: The scalar factors of the law and the third strains as symbols, where the law itself is not
#: needed: v = u alpha^2/zeta^2, since both are f times a compliance.
u_scalar, v_scalar = sp.symbols("u v", positive=True)
SHEAR_OVER_BENDING = alpha**2 / zeta**2


@cache
def tangent() -> Vector:
    """r' = v_k d_k in the fixed basis, with v_mu = v n_mu; in the symbols v and v_3."""
    n1, n2, _ = force()
    vector = from_components((v_scalar * n1, v_scalar * n2, v3), directors())
    return vector.applyfunc(reduce_squares)


@cache
def couple_balance() -> Components:
    """(m' + r' x n) . e_k for m = M_k e_k, n = N g_3; zero in equilibrium.

    In the symbols v, v_3 and the rates; the e_k turn with s and are differentiated with M_k.
    """
    m = from_components(COUPLE, intermediate_frame())
    return in_frame(Vector(along_vector(m) + tangent().cross(N * G3)), intermediate_frame())


@cache
def law_in_frame() -> Components:
    """(u . e_1 - u M_1, u . e_2 - u M_2, u . e_3 - u_3) with u the Darboux vector of the
    directors: kinematics minus law, zero for every state of the rod."""
    a, b, c = in_frame(darboux(directors()), intermediate_frame())
    return a - u_scalar * M1, b - u_scalar * M2, c - STRAINS[2]


@cache
def reduced_law() -> Mapping[sp.Symbol, sp.Expr]:
    """u, v, u_3, v_3 as functions of (theta, M_1, M_2, M_3, N): closes the reduced system."""
    return {
        u_scalar: bending_factor(),
        v_scalar: shear_factor(),
        STRAINS[2]: twist(),
        v3: dilatation(),
    }


@cache
def reduced_system() -> tuple[sp.Expr, ...]:
    """The six equations, each `expression = 0`, in the unknowns, their rates and u, v, u_3, v_3.

    Three of kinematics and law, three of balance. `reduced_law` says what u, v, u_3, v_3 are.
    """
    return (*law_in_frame(), *couple_balance())


@cache
def force_along_rod() -> Components:
    """n(s) . g_k from n' = 0 and n(1) = N g_3: the end value less the integral of n' over [s, 1].

    Without body force the balance of forces reads n' = -f = 0, so nothing is taken off.
    """
    s, f = sp.Symbol("s", real=True), sp.Integer(0)
    t = sp.Dummy("t", real=True)
    a, b, c = (end - sp.integrate(-f, (t, s, 1)) for end in N * G3)
    return a, b, c


@cache
def couple_rates() -> Mapping[sp.Symbol, sp.Expr]:
    """M_1', M_2', M_3' from the balance of couples, in the rates of the angles."""
    return {
        rate: rate - balance
        for rate, balance in zip((M1_s, M2_s, M3_s), couple_balance(), strict=True)
    }


@cache
def determinant() -> sp.Expr:
    """How the six equations fix the six rates: the determinant of their coefficients.

    Rows as in `reduced_system`, the first with its sign turned (sin(theta) phi' + u M_1).
    """
    rows = sp.Matrix(reduced_system()).jacobian(list(RATES.values()))
    return reduce_squares(-rows.det(method="berkowitz"))


@cache
def load_rates() -> Mapping[sp.Symbol, sp.Expr]:
    """m_k', n_k' in the directors: m' + r' x n = 0 and n' = 0 seen from the turning frame.

    (c_k d_k)' = c_k' d_k + u x c, so m_k' = -(u x m + v x n)_k and n_k' = -(u x n)_k, with u, v
    from the law with gamma = 1. For every force n, without angles.
    """
    strains = strains_from_loads()
    u, v = sp.Matrix(strains[:3]), sp.Matrix(strains[3:])
    m, n = sp.Matrix(LOADS[:3]), sp.Matrix(LOADS[3:])
    rates = [*(-u.cross(m) - v.cross(n)), *(-u.cross(n))]
    return dict(zip(LOADS, rates, strict=True))
