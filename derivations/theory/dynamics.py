"""Section 5.1, balance of momentum from first principles: a section as a body that moves.

The material point x = (x_1, x_2) of the section at s is at chi = r + x_1 d_1 + x_2 d_2, and the
directors turn with the angular velocity w: d_k,t = w x d_k. With <.> for the integral of the
mass density over the section, and any part [a, b] of the rod as the body,

    d/dt int <chi_t> ds = n(b) - n(a),
    d/dt int <chi x chi_t> ds = (m + r x n)(b) - (m + r x n)(a).

Problem: the two local balances, and what they become for particular moments of the mass. All
vectors are columns of components in the directors, where (y_k d_k)_t has the components
y_k,t + (w x y)_k. Only moments up to the second order occur: rho A = <1>, S_mu = <x_mu>,
J_1 = <x_2^2>, J_2 = <x_1^2>, J_12 = <x_1 x_2>.
"""

from __future__ import annotations

from functools import cache

import sympy as sp

x1, x2 = sp.symbols("x1 x2", real=True)
rho_A = sp.Symbol("rho_A", positive=True)
J1, J2 = sp.symbols("J1 J2", positive=True)
S1, S2, J12 = sp.symbols("S1 S2 J12", real=True)
spin = sp.Matrix(sp.symbols("w1:4", real=True))  # w
spin_t = sp.Matrix(sp.symbols("w_t1:4", real=True))  # w_t; its components are those of w, derived
acceleration = sp.Matrix(sp.symbols("r_tt1:4", real=True))

_MOMENTS = {(0, 0): rho_A, (1, 0): S1, (0, 1): S2, (2, 0): J2, (0, 2): J1, (1, 1): J12}
_PLACE = sp.Matrix([x1, x2, 0])

#: The center line through the centers of mass, the directors along principal axes.
CENTRAL = {S1: sp.Integer(0), S2: sp.Integer(0), J12: sp.Integer(0)}


def over_section(expr: sp.Expr) -> sp.Expr:
    """The integral over the section of a polynomial in x_1, x_2 times the mass density."""
    terms = sp.Poly(sp.expand(expr), x1, x2).terms()
    return sp.Add(*(c * _MOMENTS[monom] for monom, c in terms))


@cache
def relative_velocity() -> sp.Matrix:
    """(chi - r)_t = w x (x_1 d_1 + x_2 d_2)."""
    return sp.ImmutableMatrix(spin.cross(_PLACE))


@cache
def point_acceleration() -> sp.Matrix:
    """chi_tt = r_tt + w_t x (chi - r) + w x (w x (chi - r))."""
    turning = spin_t.cross(_PLACE) + spin.cross(spin.cross(_PLACE))
    return sp.ImmutableMatrix(acceleration + turning)


@cache
def force_slope() -> sp.Matrix:
    """n_s = <chi_tt>: the balance of linear momentum, localised."""
    return sp.ImmutableMatrix(point_acceleration().applyfunc(over_section))


@cache
def couple_rate() -> sp.Matrix:
    """m_s + r_s x n = <(chi - r) x chi_tt>: the balance about o less r x (the linear one)."""
    return sp.ImmutableMatrix(_PLACE.cross(point_acceleration()).applyfunc(over_section))


@cache
def section_momentum() -> sp.Matrix:
    """(rho J) w = <(chi - r) x (chi - r)_t>: angular momentum of the motion relative to r."""
    return sp.ImmutableMatrix(_PLACE.cross(relative_velocity()).applyfunc(over_section))


@cache
def section_momentum_rate() -> sp.Matrix:
    """The time derivative of that vector: its components are derived and turned."""
    h = section_momentum()
    slopes = sum((h.diff(w) * rate for w, rate in zip(spin, spin_t, strict=True)), sp.zeros(3, 1))
    return sp.ImmutableMatrix(slopes + spin.cross(h))
