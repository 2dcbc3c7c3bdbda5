"""The law as a textbook has it, transcribed to NumPy by hand and without a thought for rounding.

It is here to be compared with, not to be used. Arrays have components first; every function takes
the seven constants as the tuple ``k`` = (alpha, beta, zeta, eta, iota, gamma, p).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]
Tuple = tuple[float, ...]

#: Nodes and weights on [0, 1] for the energies, which have no elementary form for general p.
NODES, WEIGHTS = (
    (a + b) / 2 for a, b in zip(np.polynomial.legendre.leggauss(48), (1, 0), strict=True)
)


def strain_form(u: Array, v: Array, k: Tuple) -> Array:
    """Q."""
    alpha, beta, zeta, eta, iota, _, _ = k
    stretch = v[2] - 1
    return (
        alpha**2 * (u[0] ** 2 + u[1] ** 2)
        + beta**2 * u[2] ** 2
        + zeta**2 * (v[0] ** 2 + v[1] ** 2)
        + eta**2 * stretch**2
        + 2 * iota * u[2] * stretch
    )


def load_form(m: Array, n: Array, k: Tuple) -> Array:
    """Q*."""
    alpha, beta, zeta, eta, iota, _, _ = k
    twist = eta**2 * m[2] ** 2 - 2 * iota * m[2] * n[2] + beta**2 * n[2] ** 2
    return (
        (m[0] ** 2 + m[1] ** 2) / alpha**2
        + (n[0] ** 2 + n[1] ** 2) / zeta**2
        + twist / (beta**2 * eta**2 - iota**2)
    )


def strains(m: Array, n: Array, k: Tuple) -> Array:
    """(u, v) of (m, n)."""
    gamma, p = k[5:]
    factor = (gamma**p + load_form(m, n, k) ** (p / 2)) ** (-1 / p)
    return factor * (compliance_at_rest(k) @ np.concatenate([m, n])) + np.eye(6)[:, 5:]


def loads(u: Array, v: Array, k: Tuple) -> Array:
    """(m, n) of (u, v)."""
    gamma, p = k[5:]
    factor = gamma * (1 - strain_form(u, v, k) ** (p / 2)) ** (-1 / p)
    return factor * (stiffness_at_rest(k) @ strain_from_rest(u, v))


def stored_energy(u: Array, v: Array, k: Tuple) -> Array:
    """W = gamma Q int_0^1 t (1 - (t^2 Q)^{p/2})^{-1/p} dt, by 48 Gauss points."""
    gamma, p = k[5:]
    q = strain_form(u, v, k)
    ray = [
        w * t * (1 - (t**2 * q) ** (p / 2)) ** (-1 / p) for t, w in zip(NODES, WEIGHTS, strict=True)
    ]
    return gamma * q * np.sum(ray, axis=0)


def complementary_energy(m: Array, n: Array, k: Tuple) -> Array:
    """W* = Q* int_0^1 t (gamma^p + (t^2 Q*)^{p/2})^{-1/p} dt, by 48 Gauss points."""
    gamma, p = k[5:]
    q = load_form(m, n, k)
    ray = [
        w * t * (gamma**p + (t**2 * q) ** (p / 2)) ** (-1 / p)
        for t, w in zip(NODES, WEIGHTS, strict=True)
    ]
    return q * np.sum(ray, axis=0)


def stiffness(u: Array, v: Array, k: Tuple) -> Array:
    """D^2 W."""
    gamma, p = k[5:]
    q = strain_form(u, v, k)
    K = stiffness_at_rest(k)
    force = K @ strain_from_rest(u, v)
    rank_one = q ** (p / 2 - 1) / (1 - q ** (p / 2)) * force[:, None] * force[None, :]
    return gamma * (1 - q ** (p / 2)) ** (-1 / p) * (K[:, :, None] + rank_one)


def compliance(m: Array, n: Array, k: Tuple) -> Array:
    """D^2 W*."""
    gamma, p = k[5:]
    q = load_form(m, n, k)
    inverse = compliance_at_rest(k)
    strain = inverse @ np.concatenate([m, n])
    whole = gamma**p + q ** (p / 2)
    rank_one = q ** (p / 2 - 1) / whole * strain[:, None] * strain[None, :]
    return whole ** (-1 / p) * (inverse[:, :, None] - rank_one)


def strain_from_rest(u: Array, v: Array) -> Array:
    """(u, v - e3)."""
    return np.concatenate([u, v]) - np.eye(6)[:, 5:]


def stiffness_at_rest(k: Tuple) -> Array:
    """K, the stiffness at rest divided by gamma."""
    alpha, beta, zeta, eta, iota, _, _ = k
    K = np.diag([alpha**2, alpha**2, beta**2, zeta**2, zeta**2, eta**2])
    K[2, 5] = K[5, 2] = iota
    return K


def compliance_at_rest(k: Tuple) -> Array:
    """K^{-1}."""
    alpha, beta, zeta, eta, iota, _, _ = k
    gap = beta**2 * eta**2 - iota**2
    C = np.diag([alpha**-2, alpha**-2, eta**2 / gap, zeta**-2, zeta**-2, beta**2 / gap])
    C[2, 5] = C[5, 2] = -iota / gap
    return C
