"""Every form that is measured: ours, the textbook's, and what SymPy and mpmath give today.

The bound call is what is timed. Compiled peers, which may be missing on a machine, come last.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import mpmath
import numpy as np
import sympy as sp

from rodproof.codegen.measure import compiled
from rodproof.codegen.measure.form import (
    Answer,
    Bind,
    Call,
    Code,
    Form,
    Points,
    blocks,
    live_rows,
)
from rodproof.codegen.measure.inputs import Array
from rodproof.codegen.measure.textbook import Textbook

TWO_F_ONE = "; energies at general p by mpmath's 2F1 (NumPy has none)"


def all_forms() -> tuple[Form, ...]:
    """In the order of the report; the first is the one that ratios refer to."""
    ours = Form(
        "stable float64",
        "the generated module, its results reused through out=",
        _generated,
        _arrays,
        quick=True,
    )
    return (
        ours,
        replace(
            ours,
            name="stable float32",
            words="the same on single-precision arrays",
            dtype=np.float32,
        ),
        Form(
            "textbook",
            "the formulas by hand in NumPy; energies at general p by 48 Gauss points",
            _textbook,
            blocks,
            quick=True,
        ),
        Form(
            "lambdify",
            f"SymPy's lambdify of the derivation{TWO_F_ONE}",
            _lambdify(cse=False),
            live_rows,
            loops=_needs_2f1,
        ),
        Form(
            "lambdify cse",
            f"the same with cse=True{TWO_F_ONE}",
            _lambdify(cse=True),
            live_rows,
            loops=_needs_2f1,
            quick=True,
        ),
        *(
            Form(
                f"mpmath {digits}",
                f"lambdify to mpmath with cse=True, at {digits} digits",
                _mpmath(digits),
                live_rows,
                loops=lambda code: True,
            )
            for digits in (15, 30, 50)
        ),
        *compiled.forms(),
    )


def form_of(name: str) -> Form:
    """The form of that name."""
    return next(form for form in all_forms() if form.name == name)


def _arrays(code: Code, first: Array, second: Array, single: bool) -> Sequence[Any]:
    """The arrays of the generated function; a single point in doubles as tuples of numbers."""
    arrays = code.subject.arguments(code.function, first, second)
    if not single or first.dtype != np.float64:
        return arrays
    return [tuple(a[:, 0].tolist()) if a.ndim > 1 else a.item() for a in arrays]


def _generated(code: Code, values: tuple[float, ...]) -> Call:
    return compiled.reusing(code.subject.module, code, values)


def _textbook(code: Code, values: tuple[float, ...]) -> Call:
    subject = code.subject
    book = Textbook(subject.loads, subject.strains, subject.scene.fixed.get("p") == 2)
    law = getattr(book, code.function)
    return lambda first, second: law(first, second, values)


def _needs_2f1(code: Code) -> bool:
    return code.needs_2f1


def _lambdify(*, cse: bool) -> Bind:
    def bind(code: Code, values: tuple[float, ...]) -> Call:
        given = code.given(values)
        if code.needs_2f1:  # NumPy has no 2F1: what a user can do without SciPy
            return _pointwise(_law(code, "mpmath", cse), given)
        law = _law(code, "numpy", cse)
        return lambda *rows: law(*rows, *given)

    return bind


def _mpmath(digits: int) -> Bind:
    def bind(code: Code, values: tuple[float, ...]) -> Call:
        law = _pointwise(_law(code, "mpmath", True), code.given(values))

        def call(*rows: Any) -> Points:
            with mpmath.workdps(digits):
                return law(*rows)

        return call

    return bind


def _pointwise(law: Callable[..., Any], values: tuple[float, ...]) -> Callable[..., Points]:
    def call(*rows: Any) -> Points:
        constants = [mpmath.mpf(value) for value in values]
        columns = zip(*(np.atleast_1d(row).tolist() for row in rows), strict=True)
        return Points([_try(law, map(mpmath.mpf, column), constants) for column in columns])

    return call


def _try(law: Callable[..., Any], column: Iterable[Any], constants: Iterable[Any]) -> Answer:
    try:
        answer = law(*column, *constants)
    except (ArithmeticError, ValueError):
        return None
    found = list(answer) if isinstance(answer, tuple) else [answer]
    return None if any(isinstance(entry, mpmath.mpc) for entry in found) else found


def _law(code: Code, module: str, cse: bool) -> Callable[..., Any]:
    """The lambdified function; the stiffness at loads by the strains, as a user has to."""
    if code.function != "stiffness_at_loads":
        return _lambdified(code, module, cse)
    subject = code.subject
    strains, stiffness = (
        _lambdified(Code(subject, name, code.numbers), module, cse)
        for name in ("strains", "stiffness")
    )
    places = [subject.strains.index(i) for i in subject.loads]

    def both(*numbers: Any) -> Any:
        caused = strains(*numbers)
        return stiffness(*(caused[k] for k in places), *numbers[len(places) :])

    return both


@cache
def _lambdified(code: Code, module: str, cse: bool) -> Callable[..., Any]:
    """Lambdify the derived expression: live components, then the constants of a batch."""
    made: Callable[..., Any] = sp.lambdify(
        (*code.rows, *code.constants), code.components, module, cse=cse
    )
    return made
