"""The closed-form states: what of their module follows from the derivation.

Every state has constant strains in the intermediate frame, whose axis g_3 carries the load; so one
record holds them all: the angle, how fast the frame turns, and the strains in it.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from rodproof.codegen.equilibria.system import Piece, piece
from rodproof.codegen.targets.printer import Printer
from rodproof.derivations.symbols import STRAINS
from rodproof.derivations.theory import constitutive, euler, thrust
from rodproof.derivations.theory.frames import phi, psi, theta

ANGLES = ("phi", "theta", "psi")
SINES = tuple(f"sin_{name}" for name in ANGLES)
COSINES = tuple(f"cos_{name}" for name in ANGLES)
named = {
    f(angle): sp.Symbol(name, real=True)
    for f, names in ((sp.sin, SINES), (sp.cos, COSINES))
    for angle, name in zip((phi, theta, psi), names, strict=True)
}


def pieces() -> tuple[Piece, ...]:
    """The directors from the angles, and g_3 in the intermediate frame."""
    d = euler.directors()
    axis = (e / euler.N for e in euler.force_in_frame())
    return (
        piece(
            "frame",
            "The directors' components g_i . d_k, all of g_1 first.",
            {"sines": SINES, "cosines": COSINES},
            (),
            {(3 * i + k,): d[k][i].xreplace(named) for i in range(3) for k in range(3)},
        ),
        piece(
            "axis",
            "The components of g_3 in the intermediate frame.",
            {"sine": (SINES[1],), "cosine": (COSINES[1],)},
            (),
            {(k,): e.xreplace(named) for k, e in enumerate(axis)},
        ),
    )


def fields() -> Mapping[str, str]:
    """The formulas of the template, printed."""
    exact = Printer({})
    a, b = thrust.shear_compliance(), thrust.axial_compliance()
    c = thrust.softness()
    short = sp.symbols("a c")
    last = short[0] / (short[1] * (short[1] + 1))
    if (
        sp.cancel(c - (a - b)) != 0
        or sp.cancel(
            thrust.limiting_cosine() ** 2 - last.subs(dict(zip(short, (a, c), strict=True)))
        )
        != 0
    ):
        raise ArithmeticError("the short forms are not the derived ones")
    inverse = constitutive.compliance_at_rest()
    tangent = euler.from_components(STRAINS[3:], euler.intermediate_frame())
    tangent = tangent.xreplace({phi: sp.S.Zero}).xreplace(named)
    own = {"v1": "self.v[0]", "v2": "self.v[1]", "v3": "self.v[2]"}
    own |= {SINES[1]: "self.sine", COSINES[1]: "self.cosine"}
    return {
        "a": exact.text(a),
        "b": exact.text(b),
        "c": "a - b",
        "limit": exact.text(last),
        "bend_over_twist": exact.text(sp.cancel(inverse[0, 0] / inverse[2, 2])),
        "across": Printer(own).text(tangent[0]),
        "along": Printer(own).text(tangent[2]),
    }
