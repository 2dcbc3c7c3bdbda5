"""The symbols of the theory and the hypotheses on them.

Seven constants describe the rod (paper, Section 3.1):

==========  =========  ==================================================================
symbol      unit       meaning
==========  =========  ==================================================================
``alpha``   length     1/alpha bounds the flexure; gamma alpha^2 is the bending modulus
``beta``    length     gamma beta^2 is the twisting modulus
``gamma``   force      force scale at which the law leaves its linear range
``zeta``    1          1/zeta bounds the shear; gamma zeta^2 is the shearing modulus
``eta``     1          gamma eta^2 is the dilatational modulus
``iota``    length     couples twist to dilatation; its sign is the rod's chirality
``p``       1          sharpness of the passage from the linear range to the limit
==========  =========  ==================================================================

Strains are the components of u (1/length) and v (dimensionless) in the directors, loads those
of the contact couple m (force x length) and the contact force n (force).
"""

from __future__ import annotations

import sympy as sp

alpha, beta, gamma, zeta, eta, p = sp.symbols("alpha beta gamma zeta eta p", positive=True)
iota = sp.Symbol("iota", real=True)

u1, u2, u3, v1, v2, v3 = sp.symbols("u1:4 v1:4", real=True)
m1, m2, m3, n1, n2, n3 = sp.symbols("m1:4 n1:4", real=True)

CONSTANTS: tuple[sp.Symbol, ...] = (alpha, beta, gamma, zeta, eta, iota, p)
STRAINS: tuple[sp.Symbol, ...] = (u1, u2, u3, v1, v2, v3)
LOADS: tuple[sp.Symbol, ...] = (m1, m2, m3, n1, n2, n3)

#: beta^2 eta^2 - iota^2, the determinant of the twist-dilatation block; positive by hypothesis. The
#: paper prints alpha^2 beta^2 - iota^2 > 0 in its place (statement ``constants-hypothesis``).
chiral_gap: sp.Expr = beta**2 * eta**2 - iota**2
