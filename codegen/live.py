"""Which of the six components a scene keeps, and the arrays that hold them.

Three components of a kind make an array with a leading axis of three, two an array with a leading
axis of two, and one an array without; the last is called after its component.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from rodproof.codegen.scene import LOAD_NAMES, Scene
from rodproof.derivations.symbols import CONSTANTS as CONSTANT_SYMBOLS
from rodproof.derivations.symbols import LOADS, STRAINS, iota, p
from rodproof.derivations.theory import constitutive as theory
from rodproof.derivations.theory import constrained


@dataclass(frozen=True)
class Group:
    """An array, its leading shape and the components (of six) it holds."""

    array: str
    components: tuple[int, ...]

    @property
    def head(self) -> tuple[int, ...]:
        return (len(self.components),) if len(self.components) > 1 else ()

    def place(self, component: int) -> tuple[int, ...]:
        """The index of a component in the array."""
        return (self.components.index(component),) if self.head else ()


@dataclass(frozen=True)
class Live:
    """The components that are inputs, ``loads``, and those that the loads strain, ``strains``."""

    loads: tuple[int, ...]
    strains: tuple[int, ...]


def live(scene: Scene) -> Live:
    """The components of a scene."""
    kept = constrained.kept(scene.constraints)
    given = [LOAD_NAMES.index(name) for name in scene.loads]
    loads = tuple(i for i in kept if i in given) if given else kept
    rest = theory.compliance_at_rest().subs(
        {iota: 0} if constrained.achiral(scene.constraints) else {}
    )
    return Live(loads, tuple(i for i in kept if any(rest[i, j] != 0 for j in loads)))


def groups(letters: str, components: tuple[int, ...]) -> tuple[Group, ...]:
    """The arrays for components; ``letters`` is "mn" for loads and "uv" for strains."""
    found = []
    for letter, three in zip(letters, ((0, 1, 2), (3, 4, 5)), strict=True):
        inside = tuple(i for i in three if i in components)
        if inside:
            single = f"{letter}{inside[0] % 3 + 1}"
            found.append(Group(letter if len(inside) > 1 else single, inside))
    return tuple(found)


def substitution(scene: Scene) -> dict[sp.Expr, sp.Expr]:
    """What a scene says: lost loads and strains, iota = 0, p = 2, other constants fixed at one."""
    at = live(scene)
    known: dict[sp.Expr, sp.Expr] = {}
    for i in range(6):
        if i not in at.loads:
            known[LOADS[i]] = sp.S.Zero
            known[STRAINS[i]] = sp.S.One if i == 5 else sp.S.Zero
    if constrained.achiral(scene.constraints):
        known[iota] = sp.S.Zero
    for c in CONSTANT_SYMBOLS:
        if c == p and scene.fixed.get("p") == 2:
            known[p] = sp.Integer(2)
        elif c not in (p, iota) and scene.fixed.get(c.name) == 1:
            known[c] = sp.S.One
    return known
