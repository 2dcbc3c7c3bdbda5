"""A rod under a couple and a force: strains, energies, stiffness."""

import numpy as np

from rodproof.generated.scenes import full_rod as rod

c = rod.Constants(alpha=0.7, beta=1.1, zeta=0.9, eta=1.6, iota=-0.4, gamma=2.3, p=3.3)
m = np.array([0.1, 0.2, 0.3])[:, None] * np.linspace(0, 10, 5)  # five points at once
n = np.array([0.0, 0.0, 1.0])[:, None]

u, v = rod.strains(m, n, c)
work = np.sum(m * u, axis=0) + np.sum(n * (v - [[0], [0], [1]]), axis=0)
energies = rod.stored_energy(u, v, c) + rod.complementary_energy(m, n, c)
assert np.allclose(energies, work)  # Legendre
assert rod.stiffness(u, v, c).shape == (6, 6, 5)
print("bending grows less than the couple:", u[0].round(3))
