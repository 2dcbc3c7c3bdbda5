"""Second route of the reference: extrapolated midpoint rule, the frame as a quaternion.

The equations are those of the rotating frame, written out by hand:

    q' = q u/2,   m' = -u x m - v x n,   r' = R(q) v,   n = R(q)^T N g_3

(the quaternion product of q and the pure quaternion u), and the law by components. The modified
midpoint rule with 2, 4, 6, ... substeps has an error in even powers of the substep; Neville's
scheme takes it to zero (Gragg, Bulirsch and Stoer).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import flint

from rodproof.codegen.measure.integrators.precision import End, digits, middle, pace
from rodproof.codegen.measure.integrators.problems import COUPLE, PHI, PSI, Problem

DIGITS, COLUMNS, TOLERANCE = 30, 10, 1e-21

Rates = Callable[[Sequence[Any]], list[Any]]


def end(problem: Problem, most: int, rates: Rates | None = None) -> End:
    """The far end of the rod; raises TooLong after ``most`` steps."""
    with digits(DIGITS):
        law = rates or equations(problem)
        x, left, h, steps = start(problem), flint.arb(problem.length), 0.05, 0
        while left > 0:
            pace(problem.name, steps, 1 - float(left) / problem.length, most)
            tried = min(flint.arb(h), left, key=float)
            found, error = extrapolated(law, x, tried)
            steps += 1
            if error <= TOLERANCE:
                x, left = found, middle(left - tried)
            growth = 0.9 * (TOLERANCE / max(error, 1e-60)) ** (1 / (2 * COLUMNS - 1))
            h = float(tried) * min(4.0, max(0.1, growth))
        return End(tuple(x[7:]), tuple(columns(x[:4])), steps)


def start(problem: Problem) -> list[Any]:
    """Quaternion of the three turns, couple in the directors, and place at s = 0."""
    arb = flint.arb
    half, total, apart = arb(problem.tilt) / 2, (arb(PHI) + arb(PSI)) / 2, (arb(PHI) - arb(PSI)) / 2
    q = [
        half.cos() * total.cos(),
        -half.sin() * apart.sin(),
        half.sin() * apart.cos(),
        half.cos() * total.sin(),
    ]
    M1, M2, M3 = (arb(M) for M in COUPLE)
    sine, cosine = arb(PSI).sin(), arb(PSI).cos()
    m = [cosine * M1 + sine * M2, cosine * M2 - sine * M1, M3]
    return [middle(a) for a in (*q, *m, arb(0), arb(0), arb(0))]


def equations(problem: Problem) -> Rates:
    """The rates of (q, m, r) for this rod."""
    c = {name: flint.arb(value) for name, value in problem.constants().items()}
    N, p, gamma_p = flint.arb(problem.thrust), c["p"], c["gamma"] ** c["p"]
    bend, shear = 1 / (c["alpha"] * c["alpha"]), 1 / (c["zeta"] * c["zeta"])
    twist, dilate, couple = c["beta"] ** 2, c["eta"] ** 2, c["iota"]
    gap = twist * dilate - couple**2

    def law(m: Sequence[Any], n: Sequence[Any]) -> tuple[list[Any], list[Any]]:
        u3, v3 = (dilate * m[2] - couple * n[2]) / gap, (twist * n[2] - couple * m[2]) / gap
        f = 1 / c["gamma"]
        if not problem.linear:
            across = bend * (m[0] * m[0] + m[1] * m[1]) + shear * (n[0] * n[0] + n[1] * n[1])
            y = (across + m[2] * u3 + n[2] * v3).sqrt()
            f = 1 / (gamma_p + y**p) ** (1 / p)
        f_bend, f_shear = f * bend, f * shear
        return [f_bend * m[0], f_bend * m[1], f * u3], [f_shear * n[0], f_shear * n[1], 1 + f * v3]

    def rates(x: Sequence[Any]) -> list[Any]:
        a, b, c_, d = x[:4]
        m, R = x[4:7], columns(x[:4])
        n = [N * R[2], N * R[5], N * R[8]]
        (u1, u2, u3), v = law(m, n)
        return [
            -(b * u1 + c_ * u2 + d * u3) / 2,
            (a * u1 + c_ * u3 - d * u2) / 2,
            (a * u2 + d * u1 - b * u3) / 2,
            (a * u3 + b * u2 - c_ * u1) / 2,
            u3 * m[1] - u2 * m[2] + v[2] * n[1] - v[1] * n[2],
            u1 * m[2] - u3 * m[0] + v[0] * n[2] - v[2] * n[0],
            u2 * m[0] - u1 * m[1] + v[1] * n[0] - v[0] * n[1],
            *(R[i] * v[0] + R[3 + i] * v[1] + R[6 + i] * v[2] for i in range(3)),
        ]

    return rates


def columns(q: Sequence[Any]) -> list[Any]:
    """d_1, d_2, d_3 one after the other, from a quaternion of norm one."""
    a, b, c, d = q
    return [
        1 - 2 * (c * c + d * d), 2 * (b * c + a * d), 2 * (b * d - a * c),
        2 * (b * c - a * d), 1 - 2 * (b * b + d * d), 2 * (c * d + a * b),
        2 * (b * d + a * c), 2 * (c * d - a * b), 1 - 2 * (b * b + c * c),
    ]  # fmt: skip


def extrapolated(rates: Rates, x: Sequence[Any], h: Any) -> tuple[list[Any], float]:
    """The state after a step h, and the last correction beside the size of the state."""
    first = rates(x)
    table: list[list[Any]] = []
    for k in range(COLUMNS):
        substeps = 2 * (k + 1)
        row = [midpoint(rates, x, first, h, substeps)]
        for j in range(k):
            share = (flint.arb(substeps) / (2 * (k - j))) ** 2 - 1
            better = [b + (b - a) / share for a, b in zip(table[j], row[j], strict=True)]
            row.append(better)
        before, table = table, row
    found, other = table[-1], before[-1]
    sizes = [1.0] * 4 + [max(_size(found[4:7]), 1e-30)] * 3 + [max(1.0, _size(found[7:]))] * 3
    error = max(
        abs(float((a - b).mid())) / size for a, b, size in zip(found, other, sizes, strict=True)
    )
    return [middle(a) for a in found], error


def midpoint(
    rates: Rates, x: Sequence[Any], first: Sequence[Any], h: Any, substeps: int
) -> list[Any]:
    """The modified midpoint rule over a step h."""
    small = h / substeps
    before = list(x)
    now = [a + small * b for a, b in zip(x, first, strict=True)]
    for _ in range(substeps - 1):
        rate = rates(now)
        before, now = now, [middle(a + 2 * small * b) for a, b in zip(before, rate, strict=True)]
    last = rates(now)
    return [(a + b + small * c) / 2 for a, b, c in zip(now, before, last, strict=True)]


def _size(values: Sequence[Any]) -> float:
    return max(abs(float(value.mid())) for value in values)
