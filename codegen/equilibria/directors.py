"""Equilibrium in directors: a quaternion for the frame, the couple in it, no chart to leave.

State: q0 to q3 (the directors are the columns of R(q), for every quaternion but zero), m1 to m3
(the couple in the directors), r1 to r3 (the center line in the fixed basis) and, where a body force
acts, n1 to n3 (the force in the fixed basis). From the derived objects:

    q' from u = 2 Im(q^-1 q'), q . q' = 0       (kinematics.flexure_and_twist)
    r' = v_k d_k                                (kinematics.rotation)
    m_k' d_k + u x m + r' x n + l = 0           (balance, seen from the directors)
    n' = -f

The derivative of a vector's components in the directors by q is a product with W, the matrix of
u = W q': d(R^T a) = (R^T a) x (W dq).
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.codegen.equilibria.system import SOFT, SOFT_NAMES, Piece, cross_matrix, named, piece
from rodproof.codegen.kernel import Assignment, symbol
from rodproof.derivations.symbols import LOADS, STRAINS
from rodproof.derivations.theory import balance, kinematics

QUATERNION = tuple(q.name for q in kinematics.quaternion)
COUPLE, FORCE = (tuple(s.name for s in part) for part in (LOADS[:3], LOADS[3:]))
FLEXURE, STRETCH = (tuple(s.name for s in part) for part in (STRAINS[:3], STRAINS[3:]))
BODY_COUPLE = ("b1", "b2", "b3")
#: d_k . g_i as names d1_k, d2_k, d3_k.
FRAME = tuple(f"d{k}_{i}" for k in (1, 2, 3) for i in (1, 2, 3))
ROTATION = sp.Matrix(3, 3, lambda i, k: symbol(FRAME[3 * k + i]))
#: What a column of the Jacobian is the derivative by.
BY_Q, BY_M, BY_N = QUATERNION, COUPLE, ("g1", "g2", "g3")

q = kinematics.quaternion
m, n = LOADS[:3], LOADS[3:]
u, v = STRAINS[:3], STRAINS[3:]
body = sp.symbols(BODY_COUPLE, real=True)
per_norm = symbol("per_norm")


def pieces() -> tuple[Piece, ...]:
    """The functions of the module, in the order of use."""
    return (_frame(), _in_directors(), _rates(), *_jacobian())


@cache
def angular_rates() -> sp.ImmutableMatrix:
    """W: the flexure and twist of a moving frame are W q'."""
    rates = sp.Matrix(kinematics.flexure_and_twist())
    return sp.ImmutableMatrix(rates.jacobian(kinematics.quaternion_rate).applyfunc(sp.cancel))


@cache
def quaternion_rates() -> sp.ImmutableMatrix:
    """The q' with W q' = u that keeps the norm: 4 by 3, times u."""
    rows = angular_rates().col_join(sp.Matrix([list(q)]))
    inverse = rows.to_DM().to_field().inv().to_Matrix()
    return sp.ImmutableMatrix(inverse[:, :3].applyfunc(sp.cancel))


@cache
def rates() -> tuple[sp.Expr, ...]:
    """q', m', r' in the names of the state, the frame, the force, the body couple, the strains."""
    turned = balance.in_the_frame((sp.S.Zero,) * 3, m, u)  # u x m
    lever = sp.Matrix(v).cross(sp.Matrix(n))
    couple = [-a - b - c for a, b, c in zip(turned, lever, body, strict=True)]
    return (*(quaternion_rates() * sp.Matrix(u)), *couple, *(ROTATION * sp.Matrix(v)))


def _frame() -> Piece:
    """R(q) with products of the quaternion formed once."""
    R = kinematics.rotation() * kinematics.norm_squared
    products = {q[i] * q[j]: symbol(f"q{i}{j}") for i in range(4) for j in range(i, 4)}
    body = (
        *(Assignment(name.name, product) for product, name in products.items()),
        Assignment(per_norm.name, (1 / kinematics.norm_squared).xreplace(products)),
    )
    entry = R.applyfunc(lambda e: per_norm * sp.expand(sp.cancel(e)).xreplace(products))
    return piece(
        "frame",
        "The directors' components d_k . g_i, all of d_1 first: the columns of R(q), any |q| > 0.",
        {"q": QUATERNION},
        body,
        {(3 * k + i,): entry[i, k] for k in range(3) for i in range(3)},
    )


def _in_directors() -> Piece:
    vector = sp.symbols("a1:4", real=True)
    seen = ROTATION.T * sp.Matrix(vector)
    return piece(
        "in_directors",
        "The components in the directors of a vector given in the fixed basis.",
        {"d": FRAME, "a": tuple(a.name for a in vector)},
        (),
        {(k,): seen[k] for k in range(3)},
    )


ARGUMENTS = {
    "q": QUATERNION, "m": COUPLE, "d": FRAME, "n": FORCE, "b": BODY_COUPLE, "u": FLEXURE,
    "v": STRETCH,
}  # fmt: skip


def _rates() -> Piece:
    return piece(
        "rates",
        "q', m', r'; n and b are the force and the body couple in the directors.",
        ARGUMENTS,
        (),
        {(i,): e for i, e in enumerate(rates())},
        statements=("extra-balance-in-directors",),
    )


def jacobian_matrix() -> tuple[tuple[Assignment, ...], sp.Matrix]:
    """d(q', m', r')/d(q, m, r, n in the fixed basis), and the assignments that it is written in."""
    square = kinematics.norm_squared
    turns = tuple(symbol(f"w{i}") for i in range(4))
    per = [Assignment(per_norm.name, 1 / square)]
    per += [Assignment(w.name, 2 * x * per_norm) for w, x in zip(turns, q, strict=True)]
    table = {x / square: w / 2 for x, w in zip(q, turns, strict=True)}
    W = angular_rates().applyfunc(lambda e: _reduced(e, table))
    force_q, n_q = named(FORCE, cross_matrix(n) * W, BY_Q)
    couple_q, b_q = named(BODY_COUPLE, cross_matrix(body) * W, BY_Q)
    n_g = ROTATION.T
    strains = FLEXURE + STRETCH
    by_q, e_q = named(strains, SOFT[:, 3:] * n_q, BY_Q)
    by_n, e_n = named(strains, SOFT[:, 3:] * n_g, BY_N)
    e_m = SOFT[:, :3]
    of_strains = {"q": e_q, "m": e_m, "n": e_n}
    known = sp.Matrix(rates())
    partial = known.jacobian([*u, *v])
    blocks = {
        by: partial * strain + _direct(known, by, n_q, b_q, W) for by, strain in of_strains.items()
    }
    empty = sp.zeros(10, 3)
    whole = blocks["q"].row_join(blocks["m"]).row_join(empty).row_join(blocks["n"])
    return (*per, *force_q, *couple_q, *by_q, *by_n), whole


def _reduced(entry: sp.Expr, table: dict[sp.Expr, sp.Expr]) -> sp.Expr:
    """An entry of W, a multiple of some q_i/|q|^2, in the names of these."""
    for x, w in table.items():
        ratio = sp.cancel(entry / x)
        if ratio.is_number:
            return ratio * w
    raise ArithmeticError(f"{entry} is no multiple of a component over the norm squared")


def _direct(known: sp.Matrix, by: str, n_q: sp.Matrix, b_q: sp.Matrix, W: sp.Matrix) -> sp.Matrix:
    """The derivative at constant strains: through q, m, n and b, and the frame in r' = R v."""
    by_force = known.jacobian(list(n))
    if by == "m":
        return known.jacobian(list(m))
    if by == "n":
        return by_force * ROTATION.T
    through_frame = sp.zeros(7, 4).col_join(-ROTATION * cross_matrix(v) * W)
    own = known.jacobian(list(q))  # in q' = ... only: the frame stands as names
    return own + by_force * n_q + known.jacobian(list(body)) * b_q + through_frame


def _jacobian() -> tuple[Piece, Piece]:
    """One function for the columns of q and m, one for those of the force."""
    body, matrix = jacobian_matrix()
    arguments = {**ARGUMENTS, "soft": SOFT_NAMES}
    entries = {(i, j): matrix[i, j] for j in range(13) for i in range(10) if matrix[i, j] != 0}
    by_state = {ij: e for ij, e in entries.items() if ij[1] < 10}
    by_force = {ij: e for ij, e in entries.items() if ij[1] >= 10}
    words = "Entries of the derivative of q', m', r' by"
    return (
        piece("by_state", f"{words} q and m.", arguments, body, by_state, "BY_STATE"),
        piece("by_force", f"{words} the force.", arguments, body, by_force, "BY_FORCE"),
    )
