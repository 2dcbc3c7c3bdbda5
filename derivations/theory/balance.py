"""Balance of forces and couples, from the action of one part of the rod on its neighbour.

Problem: let n(s) and m(s) be the force and the couple that the part beyond s exerts on the part
before s across the section at s, f and l the body force and couple per unit reference length.
Every segment [a, b] is in equilibrium: the forces on it add up to zero, and so do the couples
about any fixed point o. Find the resultants of the contact actions and the local equations.

At b the rest of the rod lies beyond the segment and acts on it with n(b), m(b). At a it lies
before the segment; by action and reaction it acts with -n(a), -m(a).
"""

from __future__ import annotations

from functools import cache

import sympy as sp

from rodproof.derivations.theory.kinematics import Triple

a, b, s = sp.symbols("a b s", real=True)
origin = sp.Matrix(sp.symbols("o1:4", real=True))

#: A cut: its place, and +1 where what acts on the segment lies beyond it, -1 where before it.
CUTS: tuple[tuple[sp.Symbol, int], ...] = ((b, 1), (a, -1))


def field(name: str, at: sp.Expr) -> sp.Matrix:
    """A vector field along the rod at one place: r, n, m, f or l."""
    return sp.Matrix([sp.Function(f"{name}{i}", real=True)(at) for i in (1, 2, 3)])


def resultant_force() -> sp.Matrix:
    """The contact force on [a, b]: the sum over the cuts."""
    return sum((side * field("n", cut) for cut, side in CUTS), sp.zeros(3, 1))


def resultant_couple() -> sp.Matrix:
    """The contact couple on [a, b] about o: couples, and moments of the forces where they act."""
    return sum(
        (
            side * (field("m", cut) + (field("r", cut) - origin).cross(field("n", cut)))
            for cut, side in CUTS
        ),
        sp.zeros(3, 1),
    )


@cache
def body_loads() -> tuple[Triple, Triple]:
    """(f, l) at s: what the balance of all segments leaves for them, in terms of r, n and m.

    The balance of [a, b] holds for every b, so its derivative by b vanishes: at b, three
    equations for f, then three for l. The place o must drop out.
    """
    force = resultant_force() + _integral(field("f", s))
    couple = resultant_couple() + _integral(
        field("l", s) + (field("r", s) - origin).cross(field("f", s))
    )
    body_force, body_couple = field("f", b), field("l", b)
    found_f = sp.solve(list(force.diff(b)), list(body_force), dict=True)[0]
    remaining = couple.diff(b).subs(found_f)
    found_l = sp.solve(list(remaining), list(body_couple), dict=True)[0]
    triples = tuple(
        tuple(sp.expand(found[component]) for component in vector)
        for vector, found in ((body_force, found_f), (body_couple, found_l))
    )
    if any(e.has(*origin) for e in triples[1]):
        raise ArithmeticError("the balance of couples depends on the point o")
    return triples  # type: ignore[return-value]


def _integral(vector: sp.Matrix) -> sp.Matrix:
    return vector.applyfunc(lambda entry: sp.Integral(entry, (s, a, b)))


def in_the_frame(rates: Triple, components: Triple, u: Triple) -> Triple:
    """The components of x' in the directors, x_k' d_k + x_k u x d_k, from those of x and u."""
    turned = sp.Matrix(u).cross(sp.Matrix(components))
    first, second, third = (rate + turn for rate, turn in zip(rates, turned, strict=True))
    return first, second, third
