"""Without coupling a tension stretches and does not twist."""

from rodproof.generated.scenes import achiral

c = achiral.Constants(alpha=0.7, beta=1.1, zeta=0.9, eta=1.6, gamma=2.3, p=3.3)
u, v = achiral.strains([0, 0, 0], [0, 0, 4.0], c)
print("v3 under tension:", v[2].round(4))
assert not u.any()
assert achiral.compliance([0, 0, 0.3], [0, 0, 0], c)[2, 5] == 0
