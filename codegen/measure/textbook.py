"""The law as a textbook has it, transcribed to NumPy by hand and without a thought for rounding.

It is here to be compared with, not to be used. Points are whole, (3, N) and (3, N); a scene's
other components are at rest. The seven constants are the tuple ``k`` = (alpha, beta, zeta, eta,
iota, gamma, p). For p = 2 it takes square roots and closed energies, as one would.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.floating]
Tuple = tuple[float, ...]

#: Nodes and weights on [0, 1] for the energies, which have no elementary form for general p.
NODES, WEIGHTS = (
    (a + b) / 2 for a, b in zip(np.polynomial.legendre.leggauss(48), (1, 0), strict=True)
)


@dataclass(frozen=True)
class Textbook:
    """The formulas on a scene's components: those of its loads, and those that these strain."""

    loads_at: tuple[int, ...] = (0, 1, 2, 3, 4, 5)
    strains_at: tuple[int, ...] = (0, 1, 2, 3, 4, 5)
    square: bool = False

    def strains(self, m: Array, n: Array, k: Tuple) -> tuple[Array, ...]:
        """The strains of (m, n), v3 as it is."""
        rest = self._factor(load_form(m, n, k), k) * self._solved(m, n, k)
        return (rest + np.equal(self.strains_at, 5)[:, None],)

    def strains_and_gap(self, m: Array, n: Array, k: Tuple) -> tuple[Array, ...]:
        """The strains, and 1 - Q^{p/2} of them."""
        (strains,) = self.strains(m, n, k)
        u, v = self._whole(strains)
        return strains, 1 - strain_form(u, v, k) ** (1 if self.square else k[6] / 2)

    def loads(self, u: Array, v: Array, k: Tuple) -> tuple[Array, ...]:
        """The loads of (u, v)."""
        return (self._stretch(strain_form(u, v, k), k) * self._applied(u, v, k),)

    def stored_energy(self, u: Array, v: Array, k: Tuple) -> tuple[Array, ...]:
        """W = gamma Q int_0^1 t (1 - (t^2 Q)^{p/2})^{-1/p} dt, by 48 Gauss points."""
        gamma, p = k[5:]
        q = strain_form(u, v, k)
        if self.square:
            return (gamma * (1 - np.sqrt(1 - q)),)
        ray = [
            w * t * (1 - (t**2 * q) ** (p / 2)) ** (-1 / p)
            for t, w in zip(NODES, WEIGHTS, strict=True)
        ]
        return (gamma * q * np.sum(ray, axis=0),)

    def complementary_energy(self, m: Array, n: Array, k: Tuple) -> tuple[Array, ...]:
        """W* = Q* int_0^1 t (gamma^p + (t^2 Q*)^{p/2})^{-1/p} dt, by 48 Gauss points."""
        gamma, p = k[5:]
        q = load_form(m, n, k)
        if self.square:
            return (np.sqrt(gamma**2 + q) - gamma,)
        ray = [
            w * t * (gamma**p + (t**2 * q) ** (p / 2)) ** (-1 / p)
            for t, w in zip(NODES, WEIGHTS, strict=True)
        ]
        return (q * np.sum(ray, axis=0),)

    def stiffness(self, u: Array, v: Array, k: Tuple) -> tuple[Array, ...]:
        """D^2 W."""
        q, force = strain_form(u, v, k), self._applied(u, v, k)
        half = k[6] / 2
        weight = 1 / (1 - q) if self.square else q ** (half - 1) / (1 - q**half)
        K = block(stiffness_at_rest(k), self.loads_at)
        rank_one = weight * force[:, None] * force[None, :]
        return (self._stretch(q, k) * (K[:, :, None] + rank_one),)

    def loads_and_stiffness(self, u: Array, v: Array, k: Tuple) -> tuple[Array, ...]:
        """Both, one after the other."""
        return *self.loads(u, v, k), *self.stiffness(u, v, k)

    def compliance(self, m: Array, n: Array, k: Tuple) -> tuple[Array, ...]:
        """D^2 W*."""
        gamma, p = k[5:]
        q = load_form(m, n, k)
        inverse = block(compliance_at_rest(k), self.loads_at)
        strain = self._solved(m, n, k)[np.isin(self.strains_at, self.loads_at)]
        weight = 1 / (gamma**2 + q) if self.square else q ** (p / 2 - 1) / (gamma**p + q ** (p / 2))
        rank_one = weight * strain[:, None] * strain[None, :]
        return (self._factor(q, k) * (inverse[:, :, None] - rank_one),)

    def stiffness_at_loads(self, m: Array, n: Array, k: Tuple) -> tuple[Array, ...]:
        """D^2 W at the strains of (m, n)."""
        return self.stiffness(*self._whole(*self.strains(m, n, k)), k)

    def _factor(self, q: Array, k: Tuple) -> Array:
        """Strain over K^{-1} load."""
        gamma, p = k[5:]
        if self.square:
            return 1 / np.sqrt(gamma**2 + q)
        return (gamma**p + q ** (p / 2)) ** (-1 / p)

    def _stretch(self, q: Array, k: Tuple) -> Array:
        """Load over K strain."""
        gamma, p = k[5:]
        if self.square:
            return gamma / np.sqrt(1 - q)
        return gamma * (1 - q ** (p / 2)) ** (-1 / p)

    def _solved(self, m: Array, n: Array, k: Tuple) -> Array:
        load = np.concatenate([m, n])[list(self.loads_at)]
        return compliance_at_rest(k)[np.ix_(self.strains_at, self.loads_at)] @ load

    def _applied(self, u: Array, v: Array, k: Tuple) -> Array:
        rest = strain_from_rest(u, v)[list(self.loads_at)]
        return block(stiffness_at_rest(k), self.loads_at) @ rest

    def _whole(self, strains: Array) -> tuple[Array, Array]:
        whole = np.zeros((6, strains.shape[1]))
        whole[5] = 1
        whole[list(self.strains_at)] = strains
        return whole[:3], whole[3:]


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


def block(matrix: Array, at: tuple[int, ...]) -> Array:
    """The rows and columns of some components."""
    return matrix[np.ix_(at, at)]
