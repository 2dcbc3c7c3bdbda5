"""The rods that are integrated: from one end, where all is known, to the other.

A rod of a length in arc length s, clamped at s = 0 with the directors R_3(phi) R_2(theta) R_3(psi)
and the couple M in the frame R_3(phi) R_2(theta), pulled by the dead force N g_3. The equilibrium
equations make this an initial value problem; r(0) = 0. All constants but p are kept, and gamma = 1
is the unit of force.
"""

from __future__ import annotations

from dataclasses import dataclass

#: Generic values: chiral, of different moduli; lengths in one unit, which is that of the rod.
CONSTANTS = {"alpha": 0.7, "beta": 1.1, "zeta": 0.9, "eta": 1.6, "iota": -0.4, "gamma": 1.0}
PHI, PSI = 0.2, 0.3
COUPLE = (0.3, -0.2, 0.4)

THRUSTS = (1e-3, 1.0, 1e3, 1e6)
TILTS = (1.0, 1e-3, 1e-6, 0.0)
#: Thrusts for the two laws side by side.
LADDER = tuple(10.0**k for k in range(-3, 7))


@dataclass(frozen=True)
class Problem:
    """One rod: length, thrust N, polar angle theta at the start, p; linear: without the limit."""

    length: float
    thrust: float
    tilt: float
    p: float
    linear: bool = False

    @property
    def name(self) -> str:
        law = "linear" if self.linear else f"p={self.p:g}"
        return f"L={self.length:g} N={self.thrust:g} theta={self.tilt:g} {law}"

    def constants(self) -> dict[str, float]:
        """The seven constants of the rod."""
        return {**CONSTANTS, "p": self.p}


def grid(*, quick: bool) -> tuple[Problem, ...]:
    """Thrust against start angle at p = 3 and against p at theta = 1, and the linear law."""
    if quick:
        few = [Problem(1.0, N, tilt, 3.0) for N in (1.0, 1e6) for tilt in (1.0, 0.0)]
        return (*few, Problem(1.0, 1.0, 1.0, 50.0), Problem(1.0, 30.0, 1.0, 3.0, linear=True))
    short = [
        *(Problem(1.0, N, tilt, 3.0) for N in THRUSTS for tilt in TILTS),
        *(Problem(1.0, N, 1.0, p) for N in THRUSTS for p in (0.5, 50.0)),
        *(Problem(1.0, N, 1.0, 3.0, linear) for N in LADDER for linear in (False, True)),
    ]
    long = [
        *(Problem(100.0, N, tilt, 3.0) for N in THRUSTS for tilt in (1.0, 1e-6, 0.0)),
        *(Problem(100.0, N, 1.0, p) for N in (1.0, 1e6) for p in (0.5, 50.0)),
        *(Problem(100.0, N, 1.0, 3.0, linear=True) for N in THRUSTS),
    ]
    return tuple(dict.fromkeys((*short, *long)))
