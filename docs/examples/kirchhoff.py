"""Kirchhoff's rod: the couple bends and twists; tension does no work and stays out."""

import numpy as np

from rodproof.generated.scenes import kirchhoff

c = kirchhoff.Constants(alpha=0.7, beta=1.1, gamma=2.3, p=3.3)
m = np.array([[0.0, 5.0, 50.0], [0, 0, 0], [0.4, 0.4, 0.4]])
u = kirchhoff.strains(m, c)
print("flexure:", u[0].round(4), "of at most", round(1 / 0.7, 4))
print("twist:", u[2].round(4), "as the flexure takes up the strain that is left")
assert np.allclose(kirchhoff.loads(u, c), m)
