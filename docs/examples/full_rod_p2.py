"""p = 2: the law in square roots. At a large load the rod nears its limit like 1/load^2."""

import numpy as np

from rodproof.generated.scenes import full_rod_p2 as rod

c = rod.Constants(alpha=0.7, beta=1.1, zeta=0.9, eta=1.6, iota=-0.4, gamma=2.3)
tension = np.array([1e1, 1e2, 1e3])
u, v = rod.strains(np.zeros((3, 1)), np.multiply.outer([0, 0, 1], tension), c)
stretch = v[2] - 1
bound = 1.1 / np.sqrt((1.1 * 1.6) ** 2 - 0.4**2)  # beta/(beta^2 eta^2 - iota^2)^(1/2)
left = bound - stretch
print("distance from the largest stretch:", left)
assert np.isclose(left[1] / left[2], 100, rtol=0.01)
