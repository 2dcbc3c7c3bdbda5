"""The generated module in other dress, made at run time: without guards, and components last.

They say what the guards and the layout cost (`rodproof measure --peers`).
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from types import ModuleType
from typing import Any

import numpy as np

from rodproof.codegen import generate
from rodproof.codegen.measure import compiled
from rodproof.codegen.measure.form import Call, Code, Form
from rodproof.codegen.measure.inputs import Array
from rodproof.codegen.scene import CONSTANT_NAMES, LOAD_NAMES, Scene

BARE, LAST = "stable bare", "stable last"
#: The points that are timed lie in these; the first component is not nought.
REACH, LEAST = 0.25, 1e-2


def forms() -> tuple[Form, ...]:
    """The full rod, general and at p = 2, in both dresses."""
    return (
        Form(
            BARE,
            "the generated module for ranges that need no guard, out= given",
            lambda code, values: compiled.reusing(_module(BARE, code, values), code, values),
            _as_given,
            can=_can,
        ),
        Form(
            LAST,
            "the generated module with components last, out= given",
            lambda code, values: _rows_first(
                compiled.reusing(_module(LAST, code, values), code, values)
            ),
            lambda code, first, second, single: (first.T.copy(), second.T.copy()),
            can=_can,
        ),
    )


def _can(code: Code) -> bool:
    return code.subject.name in (compiled.FULL, compiled.SQUARE)


def _as_given(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    return first, second


def _bare(code: Code, values: tuple[float, ...]) -> Scene:
    """The scene with ranges around the constants and the points that are timed."""
    own = code.subject.scene
    order = ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p")
    given = dict(zip(order, values, strict=True))
    ranges = {n: tuple(sorted((0.99 * given[n], 1.01 * given[n]))) for n in CONSTANT_NAMES}
    over = LOAD_NAMES if code.subject.side(code.function) == "loads" else None
    names = over or ("u1", "u2", "u3", "v1", "v2", "v3")
    ranges |= dict.fromkeys(names, (-REACH, REACH)) | {names[0]: (LEAST, REACH)}
    ranges |= {} if over else {"v3": (1 - REACH, 1 + REACH)}
    open_ = {n: (float(a), float(b)) for n, (a, b) in ranges.items() if n not in own.fixed}
    return replace(own, functions=(code.function,), ranges=open_)


def _rows_first(law: Call) -> Call:
    def call(*arrays: Array) -> Any:
        parts = law(*arrays)
        parts = parts if isinstance(parts, tuple) else (parts,)
        return tuple(np.moveaxis(part, 0, -1) for part in parts)

    return call


@cache
def _module(dress: str, code: Code, values: tuple[float, ...]) -> ModuleType:
    """The scene's module, executed without a file."""
    own = _bare(code, values) if dress == BARE else replace(code.subject.scene, layout="last")
    name = f"{__name__}.{dress.replace(' ', '_')}_{code.name}"
    module = sys.modules[name] = ModuleType(name)
    exec(compile(generate.render(own), name, "exec"), module.__dict__)
    return module
