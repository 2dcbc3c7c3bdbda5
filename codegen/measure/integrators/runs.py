"""One integration: a rod, its equations, a method and a tolerance; how right, how fast, how dear.

Everything goes as a user of SciPy would have it: `solve_ivp` with the generated right-hand side
and, for the implicit methods, the generated Jacobian; rtol = atol = the tolerance.
"""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from rodproof.codegen.measure.integrators.problems import COUPLE, PHI, PSI, Problem
from rodproof.codegen.measure.integrators.reference import Reference
from rodproof.generated.equilibria import directors, euler_angles
from rodproof.generated.scenes import full_rod

Array = np.ndarray[Any, np.dtype[Any]]

EQUATIONS = ("directors", "euler angles")
METHODS = ("RK45", "DOP853", "LSODA", "Radau", "BDF")
IMPLICIT = frozenset({"LSODA", "Radau", "BDF"})
TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13)
#: Calls of the right-hand side and the Jacobian until a run counts as stalled.
BUDGET = 10_000
#: A run that is over sooner than this is timed again, and the fastest counts.
SHORT, ROUNDS = 0.1, 3
#: How a run can end.
DONE, STALLED, REFUSED, GAVE_UP, SKIPPED = "done", "stalled", "refused", "gave up", "skipped"


class OutOfCalls(Exception):
    """The budget of calls is spent."""


@dataclass(frozen=True)
class Run:
    """What one integration came to.

    outcome: "done"; "stalled", out of calls; "refused", where the equations have no answer at the
    start, as Euler angles at theta = 0; "gave up", where no step was small enough or one led to a
    state that the equations refuse; "skipped", where a looser tolerance stalled. calls, jacobians,
    steps: counts; seconds: the fastest of the rounds. error: the larger of that of r beside
    max(length, |r|) and that of the frame (the angle between the frames, in radians), against the
    reference. drift: the largest over the steps of the three first integrals, each beside its own
    size: the couple about d_3, the couple about the force, and W* + n_3.
    """

    problem: str
    equations: str
    method: str
    tolerance: float
    outcome: str
    why: str = ""
    seconds: float | None = None
    calls: int = 0
    jacobians: int = 0
    steps: int = 0
    error: float | None = None
    error_r: float | None = None
    error_frame: float | None = None
    drift: float | None = None


@dataclass(frozen=True)
class Equations:
    """A form of the equations for one rod.

    place, frame and loads read a state: r (3, ...), the directors as columns (3, 3, ...), and
    (m, n) in the directors or in another frame that shares d_3.
    """

    start: Array
    rates: Callable[[float, Array], Array]
    jacobian: Callable[[float, Array], Array]
    place: Callable[[Array], Array]
    frame: Callable[[Array], Array]
    loads: Callable[[Array], tuple[Array, Array]]


def equations(name: str, problem: Problem) -> Equations:
    """The generated equations of that name."""
    return _by_directors(problem) if name == "directors" else _by_angles(problem)


def _by_directors(problem: Problem) -> Equations:
    c = directors.Constants(**problem.constants())
    force = np.array([0.0, 0.0, problem.thrust])
    half, total, apart = problem.tilt / 2, (PHI + PSI) / 2, (PHI - PSI) / 2
    start = [
        math.cos(half) * math.cos(total),
        -math.sin(half) * math.sin(apart),
        math.sin(half) * math.cos(apart),
        math.cos(half) * math.sin(total),
        math.cos(PSI) * COUPLE[0] + math.sin(PSI) * COUPLE[1],
        math.cos(PSI) * COUPLE[1] - math.sin(PSI) * COUPLE[0],
        COUPLE[2],
        *(0.0, 0.0, 0.0),
    ]
    linear = problem.linear
    return Equations(
        start=np.array(start),
        rates=lambda s, x: directors.rates(s, x, c, force, linear=linear),
        jacobian=lambda s, x: directors.jacobian(s, x, c, force, linear=linear),
        place=lambda x: x[7:10],
        frame=directors.frame,
        loads=lambda x: directors.loads(0.0, x, force),
    )


def _by_angles(problem: Problem) -> Equations:
    c, N, linear = euler_angles.Constants(**problem.constants()), problem.thrust, problem.linear
    return Equations(
        start=np.array([PHI, problem.tilt, PSI, *COUPLE, 0.0, 0.0, 0.0]),
        rates=lambda s, x: euler_angles.rates(s, x, c, N, linear=linear),
        jacobian=lambda s, x: euler_angles.jacobian(s, x, c, N, linear=linear),
        place=lambda x: x[6:9],
        frame=_frame_of_angles,
        loads=lambda x: (x[3:6], N * np.array([-np.sin(x[1]), 0 * x[1], np.cos(x[1])])),
    )


def _frame_of_angles(x: Array) -> Array:
    """R_3(phi) R_2(theta) R_3(psi)."""
    (sf, st, sp), (cf, ct, cp) = np.sin(x[:3]), np.cos(x[:3])
    return np.array([
        [cf * ct * cp - sf * sp, -cf * ct * sp - sf * cp, cf * st],
        [sf * ct * cp + cf * sp, -sf * ct * sp + cf * cp, sf * st],
        [-st * cp, st * sp, ct],
    ])  # fmt: skip


def runs(
    problem: Problem,
    name: str,
    method: str,
    known: Reference,
    tolerances: tuple[float, ...] = TOLERANCES,
    budget: int = BUDGET,
) -> list[Run]:
    """The integrations of one rod by one method, from the loosest tolerance on."""
    form, found = equations(name, problem), []
    stalled = False
    for tolerance in tolerances:
        if stalled:
            found.append(Run(problem.name, name, method, tolerance, SKIPPED))
            continue
        found.append(integrate(problem, name, form, method, tolerance, known, budget))
        stalled = found[-1].outcome == STALLED
    return found


def integrate(
    problem: Problem,
    name: str,
    form: Equations,
    method: str,
    tolerance: float,
    known: Reference,
    budget: int = BUDGET,
) -> Run:
    """One integration, timed and judged."""
    count = _Count(form, budget)
    head = (problem.name, name, method, tolerance)
    started = time.perf_counter()
    try:
        solution = _solve(problem, count, method, tolerance)
        seconds = time.perf_counter() - started
        spent = count.calls, count.jacobians
        for _ in range(ROUNDS - 1 if seconds < SHORT else 0):
            started = time.perf_counter()
            _solve(problem, _Count(form, budget), method, tolerance)
            seconds = min(seconds, time.perf_counter() - started)
    except OutOfCalls:
        seconds = time.perf_counter() - started
        return Run(*head, STALLED, f"{budget} calls", _short(seconds), count.calls, count.jacobians)
    except ValueError as error:  # a state that the equations refuse: the first, or one stepped to
        seconds, why = time.perf_counter() - started, str(error).partition(":")[0]
        if count.calls > 1:
            return Run(*head, GAVE_UP, why, _short(seconds), count.calls, count.jacobians)
        return Run(*head, REFUSED, why, None, count.calls, count.jacobians)
    end = solution.y[:, -1]
    if not (solution.success and np.isfinite(end).all()):
        return Run(*head, GAVE_UP, solution.message, _short(seconds), *spent)
    error_r, error_frame = errors(form, end, known, problem)
    worst = None if error_r is None or error_frame is None else max(error_r, error_frame)
    return Run(
        *head, DONE, "", _short(seconds), *spent, len(solution.t) - 1,
        worst, error_r, error_frame, drift(problem, form, solution.y),
    )  # fmt: skip


class _Count:
    """The equations with their calls counted, until the budget is spent."""

    def __init__(self, form: Equations, budget: int) -> None:
        self.form, self.budget, self.calls, self.jacobians = form, budget, 0, 0

    def rates(self, s: float, x: Array) -> Array:
        self.calls += 1
        self._spend()
        return self.form.rates(s, x)

    def jacobian(self, s: float, x: Array) -> Array:
        self.jacobians += 1
        self._spend()
        return self.form.jacobian(s, x)

    def _spend(self) -> None:
        if self.calls + self.jacobians > self.budget:
            raise OutOfCalls


def _solve(problem: Problem, count: _Count, method: str, tolerance: float) -> Any:
    implicit = {"jac": count.jacobian} if method in IMPLICIT else {}
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")  # what a method does wrong is an outcome
        return solve_ivp(
            count.rates, (0.0, problem.length), count.form.start,
            method=method, rtol=tolerance, atol=tolerance, **implicit,
        )  # fmt: skip


def errors(
    form: Equations, end: Array, known: Reference, problem: Problem
) -> tuple[float | None, float | None]:
    """The errors of r and of the frame at the far end, None without a reference."""
    if known.bound is None:
        return None, None
    r, frame = np.array(known.r), np.array(known.frame).reshape(3, 3).T
    size = max(problem.length, float(np.abs(r).max()))
    away = float(np.abs(form.place(end) - r).max()) / size
    turned = float(np.linalg.norm(form.frame(end) - frame)) / math.sqrt(8)  # sin(angle/2)
    return _short(away), _short(2 * math.asin(min(1.0, turned)))


def drift(problem: Problem, form: Equations, states: Array) -> float | None:
    """How far the first integrals leave their values at the start, each beside its size."""
    chosen = states[:, :: max(1, states.shape[1] // 1000)]
    with np.errstate(all="ignore"):
        m, n = form.loads(chosen)
        energy, size = _energy(problem, m, n), np.abs(m).max()
        about_force = (m * n).sum(axis=0) / problem.thrust
        kept = ((m[2], size), (about_force, size), (energy, np.abs(energy).max() + problem.thrust))
        found = max(float(np.abs(value - value[0]).max() / size) for value, size in kept)
    return _short(found) if math.isfinite(found) else None


def _energy(problem: Problem, m: Array, n: Array) -> Array:
    """W*(m, n) + n_3, constant along a uniform rod under end loads."""
    c = problem.constants()
    if not problem.linear:
        limited: Array = full_rod.complementary_energy(m, n, full_rod.Constants(**c)) + n[2]
        return limited
    stiff = np.diag(
        [c["alpha"] ** 2] * 2 + [c["beta"] ** 2] + [c["zeta"] ** 2] * 2 + [c["eta"] ** 2]
    )
    stiff[2, 5] = stiff[5, 2] = c["iota"]
    load = np.concatenate([m, np.broadcast_to(n, m.shape)])
    linear: Array = (load * np.linalg.solve(c["gamma"] * stiff, load)).sum(axis=0) / 2 + n[2]
    return linear


def _short(value: float) -> float:
    """Four digits, for the file."""
    return float(f"{value:.4g}")
