"""Equilibrium in Euler angles under the force N g_3: the paper's reduced system, for any gamma.

State: phi, theta, psi, M1 to M3 (the couple in the intermediate frame e_k) and, if wanted, r1 to r3
(the center line in the fixed basis). The law is the same in e_k as in the directors (transverse
isotropy), so with loads and strains in e_k, from the derived objects:

    phi', theta', psi' from the Darboux vector of the directors in e_k       (euler.darboux)
    M_k' e_k + omega x M + r' x N g_3 = 0, omega the rate of e_k             (balance, frame_rates)
    r' = V_k e_k
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.codegen.equilibria.system import SOFT, SOFT_NAMES, Piece, named, piece
from rodproof.codegen.kernel import Assignment, symbol
from rodproof.derivations.symbols import STRAINS
from rodproof.derivations.theory import balance, euler
from rodproof.derivations.theory.frames import phi, theta

COUPLE = tuple(s.name for s in euler.COUPLE)
FLEXURE, STRETCH = (tuple(s.name for s in part) for part in (STRAINS[:3], STRAINS[3:]))
U, V = STRAINS[:3], STRAINS[3:]
turn = symbol("turn")  # phi'
sines = {
    sp.sin(theta): symbol("sin_theta"),
    sp.cos(theta): symbol("cos_theta"),
    sp.sin(phi): symbol("sin_phi"),
    sp.cos(phi): symbol("cos_phi"),
}
ARGUMENTS = {
    "angles": ("sin_theta", "cos_theta", "sin_phi", "cos_phi"), "couple": COUPLE,
    "thrust": (euler.N.name,), "u": FLEXURE, "v": STRETCH,
}  # fmt: skip
#: What a column of the Jacobian is the derivative by, and its place in the state.
COLUMNS = {phi: 0, theta: 1, **{M: 3 + k for k, M in enumerate(euler.COUPLE)}}


def pieces() -> tuple[Piece, ...]:
    """The functions of the module, in the order of use."""
    return (_force(), _rates(), _jacobian())


@cache
def angle_rates() -> tuple[sp.Expr, ...]:
    """phi', theta', psi' from (U_1, U_2, u_3), the strains in e_k; phi' by its name after it."""
    spin = euler.in_frame(euler.darboux(euler.directors()), euler.intermediate_frame())
    equations = sp.Matrix([a - b for a, b in zip(spin, U, strict=True)])
    unknown = (euler.phi_s, euler.theta_s, euler.psi_s)
    matrix = equations.jacobian(list(unknown))
    (found,) = sp.linsolve(
        (matrix, -equations.xreplace(dict.fromkeys(unknown, sp.S.Zero))), *unknown
    )
    first, second, third = (sp.simplify(e) for e in found)
    return first, second, sp.simplify(third.xreplace({U[0]: -turn * sp.sin(theta)}))


@cache
def rates() -> tuple[sp.Expr, ...]:
    """The rates of the nine rows, in the state, the strains in e_k and ``turn`` for phi'."""
    _, second, third = angle_rates()
    moving = {euler.phi_s: turn, euler.theta_s: second}
    omega = tuple(e.xreplace(moving) for e in euler.frame_rates())
    turned = balance.in_the_frame((sp.S.Zero,) * 3, euler.COUPLE, omega)
    lever = sp.Matrix(V).cross(sp.Matrix(euler.force_in_frame()))
    couple = [-a - b for a, b in zip(turned, lever, strict=True)]
    tangent = euler.from_components(V, euler.intermediate_frame())
    return tuple(map(_by_isotropy, (turn, second, third, *couple, *tangent)))


def _by_isotropy(rate: sp.Expr) -> sp.Expr:
    """Without what vanishes as U_mu = u M_mu and V_mu = v N_mu: V_2, and M_3' altogether."""
    law = dict(zip(U[:2], (euler.u_scalar * M for M in euler.COUPLE[:2]), strict=True))
    law |= dict(zip(V[:2], (euler.v_scalar * n for n in euler.force_in_frame()[:2]), strict=True))
    law |= {turn: angle_rates()[0].xreplace(law)}
    if sp.expand(rate.xreplace(law)) == 0:
        return sp.S.Zero
    return rate.xreplace({x: e for x, e in law.items() if e == 0})


def _force() -> Piece:
    return piece(
        "force",
        "The force N g_3 in the intermediate frame.",
        {"angles": ARGUMENTS["angles"], "thrust": ARGUMENTS["thrust"]},
        (),
        {(k,): e.xreplace(sines) for k, e in enumerate(euler.force_in_frame())},
    )


def _rates() -> Piece:
    return piece(
        "rates",
        "phi', theta', psi', M', r'; u and v are the strains in the intermediate frame.",
        ARGUMENTS,
        (Assignment(turn.name, angle_rates()[0].xreplace(sines)),),
        {(i,): e.xreplace(sines) for i, e in enumerate(rates())},
    )


def jacobian_matrix() -> tuple[tuple[Assignment, ...], sp.Matrix]:
    """The derivative of the nine rates by phi, theta, M, and the assignments it is written in."""
    columns = tuple(COLUMNS)
    names = tuple(c.name.removeprefix("var") for c in columns)
    loads = sp.Matrix([*euler.COUPLE, *euler.force_in_frame()])
    strains = [*U, *V]
    body, strained = named(FLEXURE + STRETCH, SOFT * loads.jacobian(columns), names)
    first = sp.Matrix([angle_rates()[0]])
    own = first.jacobian(strains) * strained + first.jacobian(columns)
    own = own.xreplace({U[0]: -turn * sp.sin(theta)})
    turns, turned = named(("turn",), own, names)
    known = sp.Matrix(rates())
    matrix = (
        known.jacobian(columns)
        + known.jacobian(strains) * strained
        + known.jacobian([turn]) * turned
    )
    every = (Assignment(turn.name, angle_rates()[0]), *body, *turns)
    return tuple(Assignment(a.name, a.expr.xreplace(sines)) for a in every), matrix.xreplace(sines)


def _jacobian() -> Piece:
    body, matrix = jacobian_matrix()
    places = tuple(COLUMNS.values())
    return piece(
        "by_state",
        "Entries of the derivative of the rates by phi, theta and M.",
        {**ARGUMENTS, "soft": SOFT_NAMES},
        body,
        {
            (i, place): matrix[i, j]
            for j, place in enumerate(places)
            for i in range(9)
            if matrix[i, j] != 0
        },
        "BY_STATE",
    )
