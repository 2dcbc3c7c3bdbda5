"""A form: a way to compute a scene's functions, bound to one set of constants as before a loop.

What a bound form returns is turned into components only afterwards. The forms know the scene as
well as we do: lost components, fixed constants and the law of a constrained rod are put in before
they begin.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import sympy as sp

from rodproof.codegen import lower
from rodproof.codegen.live import substitution
from rodproof.codegen.measure.inputs import Array, Batch
from rodproof.codegen.measure.subjects import Subject
from rodproof.derivations.symbols import LOADS, STRAINS, alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory import constitutive

ORDER = (alpha, beta, zeta, eta, iota, gamma, p)  # of Batch.constants
ENERGIES = ("stored_energy", "complementary_energy")


@dataclass(frozen=True)
class Code:
    """What a form is made from: a function of a scene.

    numbers: the constants as numbers in the expressions, where they are not given with each call.
    """

    subject: Subject
    function: str
    numbers: tuple[float, ...] | None = None

    @property
    def name(self) -> str:
        return f"{self.subject.name}_{self.function}"

    @property
    def needs_2f1(self) -> bool:
        """Whether it has no elementary form."""
        return self.function in ENERGIES and self.subject.scene.fixed.get("p") != 2

    @property
    def rows(self) -> tuple[sp.Symbol, ...]:
        """The live components of the point."""
        whole = LOADS if self.subject.side(self.function) == "loads" else STRAINS
        return tuple(whole[i] for i in self.subject.loads)

    @property
    def constants(self) -> tuple[sp.Symbol, ...]:
        """Those given with each call, after the point."""
        return () if self.numbers else ORDER

    def given(self, values: tuple[float, ...]) -> tuple[float, ...]:
        """Of all seven constants, what a call is given."""
        return () if self.numbers else values

    @cached_property
    def components(self) -> tuple[sp.Expr, ...]:
        """What the function returns, as the derivation has it in this scene."""
        known = substitution(self.subject.scene)
        found = [sp.sympify(e).xreplace(known) for e in _expressions(self)]
        exact = {s: sp.Float(v) for s, v in zip(ORDER, self.numbers or (), strict=False)}
        return tuple(e.subs(exact) for e in found) if exact else tuple(found)


def _expressions(code: Code) -> list[Any]:
    """What the function returns, before the scene is put in."""
    Q, dual = constitutive.quadratic_form(), constitutive.dual_form()
    parameters = (1 / p, 2 / p), (1 + 2 / p,)
    subject = code.subject
    match code.function:
        case "stored_energy" if not code.needs_2f1:
            return [constitutive.ELEMENTARY[sp.Integer(2)][0].subs(constitutive.x, sp.sqrt(Q))]
        case "complementary_energy" if not code.needs_2f1:
            return [constitutive.ELEMENTARY[sp.Integer(2)][1].subs(constitutive.y, sp.sqrt(dual))]
        case "stored_energy":
            return [gamma * Q / 2 * sp.hyper(*parameters, Q ** (p / 2))]
        case "complementary_energy":
            return [dual / (2 * gamma) * sp.hyper(*parameters, -(dual ** (p / 2)) / gamma**p)]
        case "strains":
            rest = constitutive.strains()
            return [rest[i] + int(i == 5) for i in subject.strains]
        case "strains_and_gap":
            gap = lower.limit_gap().subs(constitutive.y, sp.sqrt(dual))
            return [*_expressions(Code(subject, "strains")), gap]
        case "loads":
            return [constitutive.loads()[i] for i in subject.loads]
        case "loads_and_stiffness":
            parts = (Code(subject, name) for name in ("loads", "stiffness"))
            return [entry for part in parts for entry in _expressions(part)]
        case "stiffness" | "compliance":
            matrix = getattr(constitutive, code.function)()
            return [matrix[i, j] for i in subject.loads for j in subject.loads]
    raise ValueError(f"{code.function}: no expression of the derivation")


#: A bound call: what ``prepare`` made of the points in, whatever the form returns out.
Call = Callable[..., Any]
#: The call for seven constants.
Bind = Callable[[Code, tuple[float, ...]], Call]
#: Makes the arguments of a bound call of (3, N) and (3, N); the last says that N is one, to be
#: given without its axis where the form can do that.
Prepare = Callable[[Code, Array, Array, bool], Sequence[Any]]
#: The components of an answer, or None where the form gave none.
Answer = list[Any] | None


class NotHere(RuntimeError):
    """A form that cannot be had on this machine, and why."""


@dataclass(frozen=True)
class Form:
    """A way to compute a scene's functions, and what it is in words.

    can: whether it has the function at all. loops: whether only in a Python loop over the points.
    quick: also measured when in a hurry. needs: libraries and compilers that may be missing.
    """

    name: str
    words: str
    bind: Bind
    prepare: Prepare
    dtype: type[np.floating] = np.float64
    can: Callable[[Code], bool] = lambda code: True
    loops: Callable[[Code], bool] = lambda code: False
    quick: bool = False
    needs: tuple[str, ...] = ()


@dataclass(frozen=True)
class Points:
    """What a form that goes point by point returns."""

    points: list[Answer]


def answers(form: Form, subject: Subject, function: str, batch: Batch) -> list[Answer]:
    """The measured components at every point; None where the form refuses or fails."""
    code = Code(subject, function)
    first, second = batch.first.astype(form.dtype), batch.second.astype(form.dtype)
    try:
        law = form.bind(code, batch.constants)
        raw = law(*form.prepare(code, first, second, False))
    except (ArithmeticError, ValueError):
        if batch.size == 1:
            return [None]
        return [answers(form, subject, function, batch.column(i))[0] for i in range(batch.size)]
    return [
        None if whole is None else subject.measured(function, whole)
        for whole in components(raw, batch.size)
    ]


def components(raw: Any, size: int) -> list[Answer]:
    """What a bound call returned, as the components of each point."""
    return raw.points if isinstance(raw, Points) else [list(column) for column in rows(raw, size).T]


def rows(raw: Any, size: int) -> Array:
    """What a bound call returned for a block, a row a component."""
    parts = raw if isinstance(raw, (tuple, list)) else (raw,)
    return np.concatenate(
        [  # lambdify: a component may be a single number
            np.reshape(np.broadcast_to(part, np.shape(part) or (size,)), (-1, size))
            for part in parts
        ]
    )


def live_rows(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    """The live components, as plain numbers for a single point."""
    rows = [np.ascontiguousarray(row) for row in (*first, *second)]
    return [rows[i].item() if single else rows[i] for i in code.subject.loads]


def blocks(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    """The points as they are."""
    return first, second
