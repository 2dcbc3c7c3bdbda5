"""First route of the reference: Taylor series of high order, the frame as three directors.

All vectors stand in the fixed basis, where the balance reads as it is derived in
`derivations.theory.balance` with no body load:

    d_k' = u x d_k,   m' = -r' x n,   n = N g_3,   r' = v_k d_k,   m_k = m . d_k,   n_k = n . d_k

and the law gives (u, v - e_3) = (gamma^p + Q*^{p/2})^{-1/p} K^{-1} (m, n) with the derived K^{-1}.
A step has the Taylor polynomial of the solution, coefficient after coefficient: the rates of a
polynomial that is right up to s^k are right up to s^k, and their integral up to s^{k+1}. No
Runge-Kutta step, no quaternion, and no line of a generated module is used.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import flint
import sympy as sp

from rodproof.codegen.measure.integrators.precision import End, digits, middle, pace
from rodproof.codegen.measure.integrators.problems import COUPLE, PHI, PSI, Problem
from rodproof.derivations.symbols import CONSTANTS
from rodproof.derivations.theory.constitutive import compliance_at_rest

DIGITS, ORDER, TOLERANCE = 32, 26, 1e-23

Series = Any  # flint.arb_series
Vector = Sequence[Any]


def end(problem: Problem, most: int) -> End:
    """The far end of the rod; raises TooLong after ``most`` steps."""
    with digits(DIGITS, ORDER):
        law = Law(problem)
        x, left, steps = start(problem), flint.arb(problem.length), 0
        while left > 0:
            pace(problem.name, steps, 1 - float(left) / problem.length, most)
            coefficients = polynomial(x, law)
            h = min(step(coefficients, x), left, key=float)
            x = [middle(horner(row, h)) for row in coefficients]
            left, steps = middle(left - h), steps + 1
        return End(tuple(x[12:]), tuple(x[:9]), steps)


def start(problem: Problem) -> list[Any]:
    """Directors, couple and place at s = 0 in the fixed basis."""
    arb = flint.arb
    phi, theta, psi = arb(PHI), arb(problem.tilt), arb(PSI)
    (sf, cf), (st, ct), (sp_, cp) = ((a.sin(), a.cos()) for a in (phi, theta, psi))
    e1, e2, e3 = (cf * ct, sf * ct, -st), (-sf, cf, arb(0)), (cf * st, sf * st, ct)
    d1 = [cp * a + sp_ * b for a, b in zip(e1, e2, strict=True)]
    d2 = [cp * b - sp_ * a for a, b in zip(e1, e2, strict=True)]
    frame = zip(e1, e2, e3, strict=True)
    m = [sum((arb(M) * a for M, a in zip(COUPLE, row, strict=True)), arb(0)) for row in frame]
    return [middle(a) for a in (*d1, *d2, *e3, *m, arb(0), arb(0), arb(0))]


class Law:
    """Rates of the state as series; the constants as the floats that the modules are given."""

    def __init__(self, problem: Problem) -> None:
        constants = problem.constants()
        values = [flint.arb(constants[c.name]) for c in CONSTANTS]
        self.compliance = sp.lambdify(CONSTANTS, compliance_at_rest().tolist())(*values)
        self.gamma, self.p = flint.arb(constants["gamma"]), flint.arb(problem.p)
        self.linear, self.N = problem.linear, flint.arb(problem.thrust)

    def strains(self, load: Vector) -> tuple[Vector, Vector]:
        """u and v, in the directors."""
        rest = [_dot(row, load) for row in self.compliance]
        if self.linear:
            factor = 1 / self.gamma
        else:
            y = _dot(rest, load)  # Q*
            size = self.gamma**self.p + ((self.p / 2) * y.log()).exp()
            factor = (-(1 / self.p) * size.log()).exp()
        strain = [factor * a for a in rest]
        return strain[:3], [*strain[3:5], 1 + strain[5]]

    def rates(self, x: Sequence[Series]) -> list[Series]:
        """The derivative of the state along s."""
        d, m, zero = (x[0:3], x[3:6], x[6:9]), x[9:12], 0 * x[0]
        load = [*(_dot(m, axis) for axis in d), *(self.N * axis[2] for axis in d)]
        in_d = self.strains(load)
        u, tangent = (
            [_dot(components, [axis[i] for axis in d]) for i in range(3)] for components in in_d
        )
        turned = [entry for axis in d for entry in cross(u, axis)]
        moment = cross(tangent, (zero, zero, zero + self.N))
        return [*turned, *(-a for a in moment), *tangent]


def polynomial(x: Sequence[Any], law: Law) -> list[list[Any]]:
    """The Taylor coefficients of the solution that starts at x, up to the order of the context."""
    rows = [[a] for a in x]
    for k in range(ORDER):
        flint.ctx.cap = k + 1
        rates = law.rates([flint.arb_series(row) for row in rows])
        for row, rate in zip(rows, rates, strict=True):
            row.append(rate[k] / (k + 1))
    return rows


def step(coefficients: Sequence[Sequence[Any]], x: Sequence[Any]) -> Any:
    """How far the last two terms of the series stay below the tolerance."""
    sizes = [_size(x[:9]), _size(x[9:12]), max(1.0, _size(x[12:]))]
    reach = []
    for k in (ORDER - 1, ORDER):
        parts = [[row[k] for row in coefficients[part]] for part in (_D, _M, _R)]
        term = max(_size(part) / size for part, size in zip(parts, sizes, strict=True))
        reach.append((TOLERANCE / max(term, 1e-280)) ** (1 / k))
    return flint.arb(0.9 * min(reach))


_D, _M, _R = slice(0, 9), slice(9, 12), slice(12, 15)


def _size(values: Sequence[Any]) -> float:
    return max(abs(float(value.mid())) for value in values)


def horner(row: Sequence[Any], h: Any) -> Any:
    """The polynomial with these coefficients at h."""
    total = row[-1]
    for coefficient in reversed(row[:-1]):
        total = total * h + coefficient
    return total


def cross(a: Vector, b: Vector) -> list[Any]:
    """The vector product."""
    return [a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3] for i in range(3)]


def _dot(a: Vector, b: Vector) -> Any:
    pairs = [(x, y) for x, y in zip(a, b, strict=True) if not (isinstance(x, int) and x == 0)]
    total = pairs[0][0] * pairs[0][1]
    for x, y in pairs[1:]:
        total = total + x * y
    return total
