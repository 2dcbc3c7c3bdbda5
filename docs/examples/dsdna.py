"""DNA under tension: it untwists or overwinds as it stretches, and stiffens near its limit."""

import numpy as np

from rodproof.generated.scenes import dsdna

c = dsdna.Constants.of_moduli(gamma=300.0, p=2.0)  # pN; the moduli are those of the scene
force = np.linspace(0, 60, 7)  # pN
u, v3 = dsdna.strains(np.zeros((3, 1)), force, c)
print("extension in %:", (100 * (v3 - 1)).round(2))
print("twist in degrees a nm:", np.degrees(u[2]).round(3))
assert u[2, -1] > 0  # iota < 0: tension overwinds
