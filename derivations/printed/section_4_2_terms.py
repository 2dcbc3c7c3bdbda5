"""What the printed formulas on sheared states repeat: terms with their LaTeX, conditions."""

from __future__ import annotations

import sympy as sp

from rodproof.derivations.checks.thrust import points
from rodproof.derivations.checks.thrust.moduli import (
    SameSign,
    b,
    c,
)  # fmt: skip
from rodproof.derivations.records import Check, Statement
from rodproof.derivations.symbols import beta, eta, iota, p, zeta
from rodproof.derivations.theory.frames import theta
from rodproof.derivations.theory.thrust import N, x

SECTION = "4.2"

D = beta**2 * eta**2 - iota**2
D_TEX = r"\beta^2 \eta^2 - \iota^2"
K = D / (beta**2 * zeta**2) - 1
K_TEX = rf"\Bigl(\frac{{{D_TEX}}}{{\beta^2 \zeta^2}} - 1\Bigr)"
A, B = 1 / zeta**2, beta**2 / D
A_TEX, B_TEX = r"\frac{1}{\zeta^2}", rf"\frac{{\beta^2}}{{{D_TEX}}}"
sine, cosine = sp.sin(theta), sp.cos(theta)
F = (1 + (A * N**2 * sine**2 + B * N**2 * cosine**2) ** (p / 2)) ** (-1 / p)
F_TEX = (
    rf"\Bigl[1 + \Bigl({A_TEX} N^2 \sin^2\theta + {B_TEX} N^2 \cos^2\theta\Bigr)^{{p/2}}"
    r"\Bigr]^{-1/p}"
)
W = A * (1 - x**2) + B * x**2
W_TEX = rf"{A_TEX}(1 - x^2) + {B_TEX} x^2"
G = N ** (-p) + W ** (p / 2)
G_TEX = rf"\Bigl[N^{{-p}} + \Bigl({W_TEX}\Bigr)^{{p/2}}\Bigr]"
X = ((A - B) ** 2 + A - B) ** sp.Rational(-1, 2)
X_TEX = rf"\Bigl[\Bigl({A_TEX} - {B_TEX}\Bigr)^2 + {A_TEX} - {B_TEX}\Bigr]^{{-1/2}}"
root_b = beta / D ** sp.Rational(1, 2)
ROOT_TEX = rf"\frac{{\beta}}{{({D_TEX})^{{1/2}}}}"
F1 = (N ** (-p) + beta**p / D ** (p / 2)) ** (-1 / p) * B
F1_TEX = rf"\Bigl(N^{{-p}} + \frac{{\beta^p}}{{({D_TEX})^{{p/2}}}}\Bigr)^{{-1/p}} {B_TEX}"
LIMIT_TEX = rf"\cos^{{-1}}\Bigl\{{{X_TEX} \frac{{1}}{{\zeta}}\Bigr\}}"

CONDITION_1 = SameSign(needed=(c, sp.Integer(0)))
CONDITION_2 = SameSign(needed=(c, sp.sqrt(b)), given=points.SOFTER_IN_SHEAR)


def statement(
    name: str, claim: str, latex: str, printed: sp.Basic, check: Check, *, label: str = "-",
    introduces: bool = False, reading: str = "", read_as: sp.Basic | None = None,
    correction: sp.Basic | None = None, note: str = "",
) -> Statement:  # fmt: skip
    """A row of this section."""
    return Statement(
        id=name, section=SECTION, label=label, claim=claim, latex=latex, printed=printed,
        check=check, introduces=introduces, reading=reading, read_as=read_as,
        correction=correction, note=note,
    )  # fmt: skip
