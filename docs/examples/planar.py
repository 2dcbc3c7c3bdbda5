"""A planar cantilever: the moment of a transverse end force bends and shears it."""

import numpy as np

from rodproof.generated.scenes import planar

c = planar.Constants(alpha=0.7, zeta=0.9, eta=1.6, gamma=2.3, p=3.3)
s = np.linspace(0, 1, 101)
force = 2.0
u2, v = planar.strains(force * (1 - s), [[force], [0.0]], c)  # n = (n1, n3), v = (v1, v3)
angle = np.concatenate([[0], np.cumsum((u2[1:] + u2[:-1]) / 2 * np.diff(s))])
print("angle at the end:", angle[-1].round(3), "shear:", v[0, 0].round(3))
assert planar.stiffness(u2, v, c).shape == (3, 3, 101)
assert abs(u2).max() < 1 / 0.7  # the limit 1/alpha
