"""A force at an angle: the section shears towards it, and the coupling twists the rod."""

import numpy as np

from rodproof.generated.scenes import thrust

c = thrust.Constants(beta=1.1, zeta=0.9, eta=1.6, iota=-0.4, gamma=2.3, p=3.3)
angle = np.linspace(0, np.pi / 2, 4)
n = -3.0 * np.array([np.sin(angle), 0 * angle, np.cos(angle)])  # thrust: compressive at angle 0
u3, v = thrust.strains(n, c)
print("v3:", v[2].round(3), "v1:", v[0].round(3), "u3:", u3.round(3))
assert v[2, 0] < 1 and abs(u3[-1]) < 1e-12
