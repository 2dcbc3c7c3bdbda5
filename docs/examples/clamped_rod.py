"""A clamped rod under a dead end force and a dead end couple, by SciPy's `solve_bvp`.

It needs this file, NumPy, SciPy and a copy of one generated module beside it:

    cp generated/equilibria/directors.py docs/examples/clamped_rod.py elsewhere/
    cd elsewhere && python clamped_rod.py

The rod is clamped at s = 0, d_k(0) = g_k. At s = 1 it carries n(1) = force and m(1) = couple, both
fixed in space, so the components of the couple in the directors depend on the solution. The loads
grow in steps to several times gamma, and the flexure stays below its limit 1/alpha. The right-hand
side and the end conditions have their exact Jacobians.
"""

import directors
import numpy as np
from scipy.integrate import solve_bvp, solve_ivp

ROD = directors.Constants(alpha=0.5, beta=0.6, zeta=0.9, eta=1.3, iota=-0.3, gamma=1.0, p=3.3)
FORCE, COUPLE = np.array([1.5, 0.6, 0.4]), np.array([0.0, 0.1, 0.3])


def ends(a, b, couple):
    """Clamped at s = 0; at s = 1 the couple in space, R m, is the given one."""
    return np.concatenate([a[:4] - [1, 0, 0, 0], a[7:10], directors.frame(b) @ b[4:7] - couple])


def ends_jacobian(a, b):
    """Its derivatives by a and b; R(q) m turns with q at 2 Im(dq q^-1)/|q|^2."""
    by_a, by_b = np.zeros((10, 10)), np.zeros((10, 10))
    by_a[:4, :4], by_a[4:7, 7:10] = np.eye(4), np.eye(3)
    q0, q1, q2, q3 = b[:4]
    turn = np.array([[-q1, q0, -q3, q2], [-q2, q3, q0, -q1], [-q3, -q2, q1, q0]])
    frame = directors.frame(b)
    by_b[7:, :4] = np.cross(2 * turn / (b[:4] @ b[:4]), frame @ b[4:7], axis=0)
    by_b[7:, 4:7] = frame
    return by_a, by_b


def solve(load, mesh, guess, exact=True):
    """The rod under this share of the loads; with SciPy's differences if not ``exact``."""
    force, couple = load * FORCE, load * COUPLE
    calls = [0]

    def rates(s, x):
        calls[0] += 1
        return directors.rates(s, x, ROD, force)

    jacobians = {
        "fun_jac": lambda s, x: directors.jacobian(s, x, ROD, force),
        "bc_jac": ends_jacobian,
    }
    found = solve_bvp(
        rates, lambda a, b: ends(a, b, couple), mesh, guess, tol=1e-8, max_nodes=20000,
        **(jacobians if exact else {}),
    )  # fmt: skip
    assert found.success, found.message
    return found, calls[0]


if __name__ == "__main__":
    mesh = np.linspace(0, 1, 11)
    guess = np.zeros((10, mesh.size))
    guess[0], guess[9] = 1, mesh  # straight, unloaded
    for load in (0.25, 0.5, 1.0, 2.0, 4.0):
        found, calls = solve(load, mesh, guess)
        _, without = solve(load, mesh, guess, exact=False)
        x, guess = found.y, found.sol(mesh)
        assert np.abs(ends(x[:, 0], x[:, -1], load * COUPLE)).max() < 1e-8
        # Another way: the same rod as an initial-value problem from what was found at the clamp.
        again = solve_ivp(
            lambda s, y, f=load * FORCE: directors.rates(s, y, ROD, f), (0, 1), x[:, 0],
            method="DOP853", rtol=1e-11, atol=1e-12,
        )  # fmt: skip
        apart = np.abs(again.y[:, -1] - x[:, -1]).max()
        assert apart < 1e-6
        m, n = directors.loads(found.x, x, load * FORCE)
        u, v = directors.strains(m, n, ROD)
        print(
            f"load {load:4}: end at {x[7:10, -1].round(4)}, flexure up to"
            f" {np.hypot(u[0], u[1]).max():.3f} of {1 / ROD.alpha:g}, {found.x.size} nodes,"
            f" {calls} calls ({without} without the Jacobian), integrated again {apart:.0e} away"
        )
