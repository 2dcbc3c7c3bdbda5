"""A couple about the axis: twist, and by the coupling stretch or contraction."""

import numpy as np

from rodproof.generated.scenes import couple

c = couple.Constants(alpha=0.7, beta=1.1, eta=1.6, iota=-0.4, gamma=2.3, p=3.3)
torque = np.linspace(-2, 2, 5)
u, v3 = couple.strains(np.multiply.outer([0, 0, 1], torque), c)
print("u3:", u[2].round(3), "v3:", v3.round(3))
assert v3[-1] > 1 > v3[0]  # iota < 0: winding lengthens
