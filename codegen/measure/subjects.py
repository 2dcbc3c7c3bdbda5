"""A scene as it is measured: its module, what of the full rod it keeps, and its measured parts."""

from __future__ import annotations

import hashlib
import importlib
from collections.abc import Sequence
from dataclasses import dataclass, fields
from functools import cache, cached_property
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from rodproof.codegen import scene as scenes
from rodproof.codegen.live import groups, live
from rodproof.codegen.scene import CONSTANT_NAMES, FUNCTIONS_OF_LOADS, Scene

Array = NDArray[np.floating]
Side = Literal["loads", "strains"]

#: What the error of a function is taken of, where others are measured for the rest of its answer
#: (the tests hold that they are the same to the bit).
PARTS = {"strains_and_gap": "limit_gap", "loads_and_stiffness": "stiffness"}


@dataclass(frozen=True, eq=False)
class Subject:
    """A committed scene with its generated module.

    Points are whole, six components; those that the scene does not have are at rest. Constants
    are all seven; those that it does not have are one, iota zero.
    """

    scene: Scene

    @property
    def name(self) -> str:
        return self.scene.name

    @property
    def module(self) -> ModuleType:
        return importlib.import_module(f"rodproof.generated.scenes.{self.name}")

    @property
    def digest(self) -> str:
        """Of the module's text: its version."""
        text = Path(str(self.module.__file__)).read_bytes()
        return hashlib.sha256(text).hexdigest()[:16]

    @property
    def functions(self) -> tuple[str, ...]:
        return self.scene.functions

    @cached_property
    def constants(self) -> tuple[str, ...]:
        """The constants that are given at run time."""
        given = {field.name for field in fields(self.module.Constants) if field.init}
        return tuple(name for name in CONSTANT_NAMES if name in given)

    @cached_property
    def coupled(self) -> bool:
        return "iota" in self.constants

    @cached_property
    def loads(self) -> tuple[int, ...]:
        return live(self.scene).loads

    @cached_property
    def strains(self) -> tuple[int, ...]:
        return live(self.scene).strains

    def side(self, function: str) -> Side:
        return "loads" if function in FUNCTIONS_OF_LOADS else "strains"

    def restricted(self, values: Sequence[float]) -> tuple[float, ...]:
        """The seven constants with those that the scene fixes or does not have put in."""
        given = self.constants
        none = {"iota": 0.0, "p": 2.0}
        return tuple(
            value if name in given else self.scene.fixed.get(name, none.get(name, 1.0))
            for name, value in zip(CONSTANT_NAMES, values, strict=True)
        )

    def record(self, values: Sequence[float], module: ModuleType | None = None) -> Any:
        """The own record of constants of a module, this one's; ValueError where it refuses them."""
        named = dict(zip(CONSTANT_NAMES, values, strict=True))
        return (module or self.module).Constants(**{name: named[name] for name in self.constants})

    def arguments(self, function: str, first: Array, second: Array) -> list[Array]:
        """The whole point in the arrays that the module's function takes."""
        whole = np.concatenate([first, second])
        parts = groups("mn" if self.side(function) == "loads" else "uv", self.loads)
        return [
            np.ascontiguousarray(whole[list(g.components)]) if g.head else whole[g.components[0]]
            for g in parts
        ]

    def places(self, function: str) -> tuple[int, ...]:
        """Where the measured part stands among the six or 36 numbers of the full rod, or in one."""
        function = PARTS.get(function, function)
        if function in ("strains", "loads"):
            return self.strains if function == "strains" else self.loads
        if function in ("stiffness", "compliance", "stiffness_at_loads"):
            return tuple(6 * i + j for i in self.loads for j in self.loads)
        return (0,)

    def measured(self, function: str, components: Sequence[Any]) -> list[Any]:
        """The measured part of all the numbers that the function returns: the last ones."""
        return list(components[-len(self.places(function)) :])


@cache
def subject(name: str) -> Subject:
    """The subject of a committed scene."""
    return Subject(scenes.committed(name))


def subjects() -> tuple[Subject, ...]:
    """Every committed scene, the full rod first."""
    return tuple(subject(name) for name in scenes.committed_names())
