"""Section 4 confirmed by solving problems: integrals, boundary values, continuation, energies.

Nothing here knows a closed form. The generated right-hand sides (`generated.equilibria.directors`)
are integrated and solved with SciPy; what comes out is then held against the closed-form states.

The rod of the paper's second end conditions: r(0) = o, no couple at either end (which makes the
resultant couple about o vanish), force N g_3. Turns about g_3 and about d_3 are fixed by starting
in the plane of g_1 and g_3. The first: clamped at s = 0, no couple at s = 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import solve_bvp, solve_ivp
from scipy.optimize import brentq

from rodproof.codegen.scene import CONSTANT_NAMES
from rodproof.generated.equilibria import directors, states

Array = np.ndarray[Any, np.dtype[Any]]

SOFT = states.Constants(
    alpha=0.7, beta=1.1, zeta=0.5, eta=1.6, iota=-0.4, gamma=2.3, p=3.3
)  # softer in shear than in extension, chiral
TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}
COUPLE = slice(4, 7)
LINE = slice(7, 10)


def law(constants: states.Constants) -> directors.Constants:
    """The same rod for the module of directors."""
    return directors.Constants(**{name: getattr(constants, name) for name in CONSTANT_NAMES})


# -- initial values ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Stay:
    """How far an integration from a state's initial data leaves the state, and how far its first
    integrals move: m + r x n, m_3 and W* + n_3, each over its size."""

    kind: str
    length: float
    calls: int
    away: float
    moment: float
    twisting_couple: float
    energy: float


def stay(state: states.State, constants: states.Constants, length: float = 4.0) -> Stay:
    """Integrates from s = 0 over the length, and compares at 33 places."""
    s = np.linspace(0, length, 33)
    force = (0.0, 0.0, float(state.thrust))
    start = state.rows(0.0)
    found = integrate(start, force, constants, s)
    wanted = np.stack([state.rows(x) for x in s], axis=1)
    scale = np.maximum(np.abs(wanted).max(axis=1), 1)[:, None]
    return Stay(
        state.kind,
        length,
        found.nfev,
        float((np.abs(found.y - wanted) / scale).max()),
        *first_integrals(found.y, force, constants),
    )


def integrate(start: Array, force: Any, constants: states.Constants, s: Array) -> Any:
    """`solve_ivp` of the directors at the places s."""
    c = law(constants)

    def rates(at: float, x: Array) -> Array:
        return directors.rates(at, x, c, force)

    return solve_ivp(rates, (s[0], s[-1]), start, t_eval=s, **TIGHT)


def first_integrals(x: Array, force: Any, constants: states.Constants) -> tuple[float, ...]:
    """The drift of m + r x n, of m_3 and of W*(m, n) + n_3 along rows x (10, places)."""
    m, n = directors.loads(0, x, force)
    in_space = np.einsum("ik...,k...->i...", directors.frame(x), m)
    moment = in_space + np.cross(x[LINE].T, force).T
    energy = states.complementary_energy(m, n, constants) + n[2]
    return tuple(
        float(np.abs((value.T - value.T[0]).T).max() / max(np.abs(value).max(), 1))
        for value in (moment, m[2], energy)
    )


# -- boundary values -----------------------------------------------------------------------------


@dataclass(frozen=True)
class Solved:
    """A boundary-value problem by `solve_bvp`: its end conditions, what it started from and found.

    theta is the largest and least angle of d_3 with g_3 along the rod.
    """

    ends: str
    started: float
    theta: tuple[float, float]
    residual: float
    height: float
    energy: float
    nodes: int


def solve(thrust: float, constants: states.Constants, started: float, ends: str = "free") -> Solved:
    """The rod of length 1 from the guess of a constant angle; RuntimeError if it fails."""
    c, force = law(constants), (0.0, 0.0, thrust)
    mesh = np.linspace(0, 1, 9)
    guess = np.zeros((10, mesh.size))
    guess[0], guess[2] = np.cos(started / 2), np.sin(started / 2)
    guess[7], guess[9] = np.sin(started) * mesh, np.cos(started) * mesh
    conditions = free if ends == "free" else clamped
    found = solve_bvp(
        lambda s, x: directors.rates(s, x, c, force),
        lambda a, b: conditions(a, b)[0],
        mesh,
        guess,
        fun_jac=lambda s, x: directors.jacobian(s, x, c, force),
        bc_jac=lambda a, b: conditions(a, b)[1:],
        tol=1e-9,
    )
    if not found.success:
        raise RuntimeError(found.message)
    cosine = np.clip(directors.frame(found.y)[2, 2], -1, 1)
    m, n = directors.loads(0, found.y, force)
    energy = -states.complementary_energy(m, n, constants) - n[2]
    return Solved(
        ends,
        started,
        (float(np.arccos(cosine).min()), float(np.arccos(cosine).max())),
        float(found.rms_residuals.max()),
        float(found.y[9, -1] - found.y[9, 0]),
        float(np.sum(np.diff(found.x) * (energy[1:] + energy[:-1])) / 2),
        found.x.size,
    )


def free(a: Array, b: Array) -> tuple[Array, Array, Array]:
    """No end couples, r(0) = o, a start in the plane: values, and derivatives by a and b."""
    norm = a[0] ** 2 + a[2] ** 2 - 1
    values = np.array([norm, a[1], a[3], *a[COUPLE], *a[LINE], b[5]])
    by_a, by_b = np.zeros((10, 10)), np.zeros((10, 10))
    by_a[0, 0], by_a[0, 2] = 2 * a[0], 2 * a[2]
    for row, column in enumerate((1, 3, 4, 5, 6, 7, 8, 9), start=1):
        by_a[row, column] = 1
    by_b[9, 5] = 1
    return values, by_a, by_b


def clamped(a: Array, b: Array) -> tuple[Array, Array, Array]:
    """d_k(0) = g_k, r(0) = o, m(1) = 0."""
    values = np.array([a[0] - 1, a[1], a[2], a[3], *a[LINE], *b[COUPLE]])
    by_a, by_b = np.zeros((10, 10)), np.zeros((10, 10))
    for row, column in enumerate((0, 1, 2, 3, 7, 8, 9)):
        by_a[row, column] = 1
    for row, column in enumerate((4, 5, 6), start=7):
        by_b[row, column] = 1
    return values, by_a, by_b


# -- continuation --------------------------------------------------------------------------------


def shoot(theta: float, thrust: float, constants: states.Constants) -> tuple[float, Array]:
    """m_2(1) of the rod that starts without couple at the angle theta, and its derivative by theta
    and N, from the variational equations x' = f, V' = f_x V with the generated Jacobian."""
    c = law(constants)
    start = np.zeros((13, 3))
    half = theta / 2
    start[[0, 2, 12], 0] = np.cos(half), np.sin(half), thrust
    start[[0, 2], 1] = -np.sin(half) / 2, np.cos(half) / 2
    start[12, 2] = 1

    def rates(s: float, flat: Array) -> Array:
        x = flat.reshape(13, 3)
        moved = np.empty_like(x)
        moved[:, 0] = directors.rates(s, x[:, 0], c)
        moved[:, 1:] = directors.jacobian(s, x[:, 0], c) @ x[:, 1:]
        return moved.ravel()

    end = solve_ivp(rates, (0, 1), start.ravel(), **TIGHT).y[:, -1].reshape(13, 3)
    return float(end[5, 0]), end[5, 1:]


@dataclass(frozen=True)
class Found:
    """Where the straight branch loses its only neighbour: by continuation in N, then by bisection
    of the derivative of m_2(1) by theta(0); and the threshold as derived."""

    thrust: float
    derived: float
    steps: int

    @property
    def apart(self) -> float:
        return abs(self.thrust - self.derived) / self.derived


def bifurcation(constants: states.Constants) -> Found:
    """Follows theta = 0 from a small thrust upwards until the derivative changes its sign."""

    def slope(thrust: float) -> float:
        return float(shoot(0.0, thrust, constants)[1][0])

    steps, low, high = 0, 0.0, 0.05 * constants.gamma
    while slope(high) > 0:
        steps, low, high = steps + 1, high, 1.3 * high
    root = brentq(slope, low, high, xtol=1e-14 * high, rtol=1e-14)
    return Found(float(root), states.threshold(constants), steps)


def sheared_branch(
    constants: states.Constants, start: Found, steps: int = 6, reach: float = 0.2
) -> list[tuple[float, float]]:
    """(N, theta) along the branch that leaves at ``start``: pseudo-arclength, Newton correction.

    The first tangent is along theta, the null direction there; N counts in units of the threshold.
    """
    point = np.array([0.0, 1.0])  # theta, N over the threshold
    tangent = np.array([1.0, 0.0])
    found = []
    for _ in range(steps):
        guess = point + reach * tangent
        x = guess.copy()
        for _ in range(20):
            value, slopes = shoot(x[0], x[1] * start.thrust, constants)
            matrix = np.array([slopes * [1, start.thrust], tangent])
            step = np.linalg.solve(matrix, np.array([value, float(tangent @ (x - guess))]))
            x -= step
            if np.abs(step).max() < 1e-12:
                break
        tangent = (x - point) / np.linalg.norm(x - point)
        point = x
        found.append((float(x[1] * start.thrust), float(x[0])))
    return found


# -- all of it -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Confirmation:
    """Section 4 by solving: each number beside the closed form's."""

    constants: dict[str, float]
    stays: tuple[Stay, ...]
    bifurcation: Found
    branch: tuple[dict[str, float], ...]
    solved: tuple[Solved, ...]
    energies: tuple[dict[str, float], ...]


def confirm(constants: states.Constants = SOFT) -> Confirmation:
    """Everything, in some seconds."""
    start = bifurcation(constants)
    thrust = 2 * start.derived
    followed = [
        states.straight(thrust, constants),
        states.straight(thrust, constants, turned=True),
        states.sheared(thrust, constants),
        states.twisted(2.0, constants),
        states.helix(2.0, 0.7, constants),
        states.circle(2.0, constants),
    ]
    branch = [
        {"thrust": N, "theta": theta, "derived": float(states.sheared_angle(N, constants))}
        for N, theta in sheared_branch(constants, start)
    ]
    angle = float(states.sheared_angle(thrust, constants))
    problems = [(0.0, "free"), (angle + 0.1, "free"), (angle, "clamped")]
    return Confirmation(
        {name: getattr(constants, name) for name in CONSTANT_NAMES},
        tuple(stay(state, constants) for state in followed),
        start,
        tuple(branch),
        tuple(solve(thrust, constants, guess, ends) for guess, ends in problems),
        tuple(_energies(start.derived, factor, constants) for factor in (1.01, 1.1, 2.0, 10.0)),
    )


def _energies(threshold: float, factor: float, c: states.Constants) -> dict[str, float]:
    """Both energies above the threshold."""
    N = factor * threshold
    straight, sheared = states.straight(N, c).energy, states.sheared(N, c).energy
    return {"thrust": N, "straight": float(straight), "sheared": float(sheared)}


def rows(found: Confirmation) -> list[tuple[str, str, str, str]]:
    """What was asked, what the closed form says, what solving gave, how far apart, as text."""
    start = found.bifurcation
    told = [
        (f"integrate the {s.kind} state over {s.length:g}, {s.calls} calls", "stays", "stays",
         f"{s.away:.1e}") for s in found.stays
    ]  # fmt: skip
    told += [
        (f"its first integrals ({s.kind})", "kept", "kept",
         f"{max(s.moment, s.twisting_couple, s.energy):.1e}") for s in found.stays
    ]  # fmt: skip
    told.append(("threshold, by continuation in N", repr(start.derived), repr(start.thrust),
                 f"{start.apart:.1e}"))  # fmt: skip
    told += [
        (f"sheared branch at N = {b['thrust']:.4f}, by pseudo-arclength", f"{b['derived']:.15f}",
         f"{b['theta']:.15f}", f"{abs(b['theta'] - b['derived']):.1e}") for b in found.branch
    ]  # fmt: skip
    straight, sheared = (found.energies[2][kind] for kind in ("straight", "sheared"))
    for s in found.solved:
        upright = s.theta[1] < 1e-6
        wanted = straight if upright else sheared
        branch = "straight" if upright else "sheared"
        problem = f"{s.ends} ends from theta = {s.started:.3f}: {branch}, energy"
        apart = abs(s.energy - wanted)
        told.append((problem, f"{wanted:.12f}", f"{s.energy:.12f}", f"{apart:.1e}"))
    told += [
        (f"energies at N = {e['thrust']:.4f}, straight and sheared", f"{e['straight']:.10f}",
         f"{e['sheared']:.10f}", f"{e['straight'] - e['sheared']:.1e}") for e in found.energies
    ]  # fmt: skip
    return told
