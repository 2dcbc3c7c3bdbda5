"""The derived equations in mpmath, at any precision: what the generated modules must agree with.

Nothing of the generator is used: the theory's own expressions are evaluated.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from types import ModuleType
from typing import Any

import mpmath
import pytest
import sympy as sp

from rodproof.derivations.symbols import CONSTANTS, LOADS
from rodproof.derivations.theory import constitutive, euler, kinematics
from rodproof.derivations.theory.frames import phi, psi, theta


@pytest.fixture(scope="session")
def exact() -> ModuleType:
    """This module, for the tests of the folder."""
    return sys.modules[__name__]


Numbers = Sequence[Any]
DIGITS = 60
ctx = mpmath.mp.clone()
ctx.dps = DIGITS


@cache
def evaluator(expressions: tuple[sp.Expr, ...], symbols: tuple[sp.Symbol, ...]) -> Callable:
    """Expressions as a function of numbers, in mpmath."""
    found = sp.lambdify(symbols, list(expressions), modules=[ctx_functions(), "mpmath"])
    return lambda *numbers: found(*map(ctx.mpf, numbers))


def ctx_functions() -> dict[str, Any]:
    return {name: getattr(ctx, name) for name in ("sin", "cos", "sqrt", "exp", "log")}


def law(loads: Numbers, constants: Mapping[str, float], *, linear: bool = False) -> Numbers:
    """(u, v) under (m, n)."""
    rows = constitutive.law_of_strains()
    if linear:
        matrix = constitutive.compliance_at_rest() / CONSTANTS[2]  # gamma
        rows = tuple(matrix * sp.Matrix(LOADS))
    values = [*loads, *(constants[c.name] for c in CONSTANTS)]
    strain = evaluator(rows, (*LOADS, *CONSTANTS))(*values)
    return [*strain[:5], 1 + strain[5]]


def rotation(q: Numbers) -> Any:
    entries = evaluator(tuple(kinematics.rotation()), kinematics.quaternion)(*q)
    return ctx.matrix(3, 3) + ctx.matrix([entries[:3], entries[3:6], entries[6:]])


def cross(a: Numbers, b: Numbers) -> list:
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def director_rates(
    state: Numbers,
    constants: Mapping[str, float],
    force: Numbers,
    body_couple: Numbers = (0, 0, 0),
    *,
    linear: bool = False,
) -> list:
    """q', m', r' in a way of their own: q' = q u/2 by the product of quaternions, vectors in the
    fixed basis: m = R m_k, m' = -r' x n - l, m_k' = R^T m' - u x m."""
    x = [ctx.mpf(a) for a in state]
    q, m = x[:4], x[4:7]
    R = rotation(q)
    n = list(R.T * ctx.matrix([ctx.mpf(f) for f in force]))
    strains = law([*m, *n], constants, linear=linear)
    u, v = strains[:3], strains[3:]
    qv = q[1:]
    q_rate = [-ctx.fdot(qv, u) / 2]
    q_rate += [(q[0] * a + c) / 2 for a, c in zip(u, cross(qv, u), strict=True)]
    r_rate = list(R * ctx.matrix(v))
    m_rate = [-a - ctx.mpf(b) for a, b in zip(cross(r_rate, force), body_couple, strict=True)]
    seen = list(R.T * ctx.matrix(m_rate))
    return [*q_rate, *(a - b for a, b in zip(seen, cross(u, m), strict=True)), *r_rate]


def euler_rates(
    state: Numbers, constants: Mapping[str, float], thrust: Any, *, linear: bool = False
) -> list:
    """The nine rates as the solution of the derived reduced system and the derived tangent.

    The scalars u, v, u_3, v_3 of the system come from the law in the directors.
    """
    x = [ctx.mpf(a) for a in state]
    angles, M, N = x[:3], x[3:6], ctx.mpf(thrust)
    unknown = (*euler.ANGLES, *euler.COUPLE, euler.N)
    loads = evaluator((*euler.couple(), *euler.force()), unknown)(*angles, *M, N)
    strains = law(loads, constants, linear=linear)
    big = max(range(2), key=lambda i: abs(loads[i]))
    shear = max((3, 4), key=lambda i: abs(loads[i]))
    bend = strains[big] / loads[big]
    slip = strains[shear] / loads[shear]
    scalars = (
        euler.u_scalar,
        euler.v_scalar,
        sp.Symbol("u3", real=True),
        sp.Symbol("v3", real=True),
    )
    system = sp.Matrix(euler.reduced_system())
    rates = tuple(euler.RATES.values())
    jacobian = system.jacobian(rates[:3]).row_join(system.jacobian(rates[3:]))
    known = (*unknown, *scalars)
    values = [*angles, *M, N, bend, slip, strains[2], strains[5]]
    # The angles' rates first: the law's equations are linear in them; then the couple's.
    zero = dict.fromkeys(rates, sp.S.Zero)
    A = evaluator(tuple(jacobian[:3, :3]), known)(*values)
    b = evaluator(tuple(-system[:3, :].xreplace(zero)), known)(*values)
    turn = list(ctx.lu_solve(ctx.matrix([A[:3], A[3:6], A[6:]]), ctx.matrix(b)))
    balance = tuple(system[3:, :].xreplace(dict.fromkeys(rates[3:], sp.S.Zero)))
    couple = evaluator(balance, (*known, *rates[:3]))(*values, *turn)
    tangent = evaluator(tuple(euler.tangent()), (phi, theta, psi, euler.N, *scalars))
    line = tangent(*angles, N, bend, slip, strains[2], strains[5])
    return [*turn, *(-c for c in couple), *line]


def jacobian(rates: Callable[[Numbers], Numbers], state: Numbers) -> list[list]:
    """d rates/d state by differences of mpmath numbers: exact to twenty digits and more."""
    columns = []
    for j, x in enumerate(state):
        step = ctx.mpf(10) ** -20 * max(1, abs(x))
        moved = [[ctx.mpf(a) for a in state] for _ in range(2)]
        moved[0][j] += step
        moved[1][j] -= step
        up, down = (rates(m) for m in moved)
        columns.append([(a - b) / (2 * step) for a, b in zip(up, down, strict=True)])
    return [list(row) for row in zip(*columns, strict=True)]
