"""Every form that is measured: ours, the textbook's, and what SymPy and mpmath give today.

A form binds a function to one set of constants, as a user would before a loop; the bound call is
what is timed. What it returns is turned into components only afterwards.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath
import numpy as np
import sympy as sp

from rodproof.codegen.measure import forms
from rodproof.codegen.measure.errors import SIDES
from rodproof.codegen.measure.inputs import Array, Batch
from rodproof.codegen.measure.records import FUNCTIONS
from rodproof.derivations.symbols import LOADS, STRAINS, alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory import constitutive
from rodproof.generated.scenes import full_rod

ORDER = (alpha, beta, zeta, eta, iota, gamma, p)  # of Batch.constants
ENERGIES = ("stored_energy", "complementary_energy")
TWO_F_ONE = "; energies by mpmath's 2F1 (NumPy has none)"

#: A bound call: two blocks of three components in, whatever the form returns out.
Call = Callable[[Array, Array], Any]
Bind = Callable[[str, tuple[float, ...]], Call]
#: The components of an answer, or None where the form gave none.
Answer = list[Any] | None


@dataclass(frozen=True)
class Form:
    """A way to compute the six functions, and what it is in words.

    ``by_point`` names the functions that it can only do in a Python loop over the points.
    """

    name: str
    words: str
    bind: Bind
    dtype: type[np.floating] = np.float64
    by_point: tuple[str, ...] = ()


def all_forms() -> tuple[Form, ...]:
    """In the order of the report; the first is the one that ratios refer to."""
    return (
        Form("stable float64", "the generated scene full_rod", _generated),
        Form("stable float32", "the same on single-precision arrays", _generated, np.float32),
        Form("textbook", "the formulas by hand in NumPy; energies by 48 Gauss points", _textbook),
        Form(
            "lambdify", f"SymPy's lambdify of the derivation{TWO_F_ONE}", _plain, by_point=ENERGIES
        ),
        Form("lambdify cse", f"the same with cse=True{TWO_F_ONE}", _cse, by_point=ENERGIES),
        *(
            Form(
                f"mpmath {digits}",
                f"lambdify to mpmath with cse=True, at {digits} digits",
                _mpmath(digits),
                by_point=FUNCTIONS,
            )
            for digits in (15, 30, 50)
        ),
    )


def answers(form: Form, function: str, batch: Batch) -> list[Answer]:
    """The components at every point; None for a point that the form refuses or fails at."""
    first, second = batch.first.astype(form.dtype), batch.second.astype(form.dtype)
    try:
        raw = form.bind(function, batch.constants)(first, second)
    except (ArithmeticError, ValueError):
        if batch.size == 1:
            return [None]
        return [answers(form, function, batch.column(i))[0] for i in range(batch.size)]
    return components(raw, batch.size)


def components(raw: Any, size: int) -> list[Answer]:
    """What a bound call returned, as the components of each point."""
    if isinstance(raw, _Points):
        return raw.points
    if isinstance(raw, tuple) and len(raw) == 2:  # (u, v) or (m, n)
        raw = np.concatenate(raw)
    if isinstance(raw, tuple):  # lambdify: components may be single numbers
        raw = np.stack([np.broadcast_to(row, (size,)) for row in raw])
    return [list(column) for column in np.reshape(raw, (-1, size)).T]


@dataclass(frozen=True)
class _Points:
    """What a form that goes point by point returns."""

    points: list[Answer]


def _generated(function: str, values: tuple[float, ...]) -> Call:
    constants = full_rod.Constants(*values)
    law = getattr(full_rod, function)
    return lambda first, second: law(first, second, constants)


def _textbook(function: str, values: tuple[float, ...]) -> Call:
    law = getattr(forms, function)
    return lambda first, second: law(first, second, values)


def _plain(function: str, values: tuple[float, ...]) -> Call:
    return _lambdified(function, values, cse=False)


def _cse(function: str, values: tuple[float, ...]) -> Call:
    return _lambdified(function, values, cse=True)


def _lambdified(function: str, values: tuple[float, ...], *, cse: bool) -> Call:
    if function in ENERGIES:  # NumPy has no 2F1: what a user can do without SciPy
        return _pointwise(_compiled(function, "mpmath", cse), values)
    law = _compiled(function, "numpy", cse)
    return lambda first, second: law(*first, *second, *values)


def _mpmath(digits: int) -> Bind:
    def bind(function: str, values: tuple[float, ...]) -> Call:
        law = _pointwise(_compiled(function, "mpmath", True), values)

        def call(first: Array, second: Array) -> _Points:
            with mpmath.workdps(digits):
                return law(first, second)

        return call

    return bind


def _pointwise(
    law: Callable[..., Any], values: tuple[float, ...]
) -> Callable[[Array, Array], _Points]:
    def call(first: Array, second: Array) -> _Points:
        constants = [mpmath.mpf(value) for value in values]
        columns = np.concatenate([first, second]).T.tolist()
        return _Points([_try(law, map(mpmath.mpf, column), constants) for column in columns])

    return call


def _try(law: Callable[..., Any], column: Iterable[Any], constants: Iterable[Any]) -> Answer:
    try:
        answer = law(*column, *constants)
    except (ArithmeticError, ValueError):
        return None
    return list(answer) if isinstance(answer, tuple) else [answer]


@cache
def _compiled(function: str, module: str, cse: bool) -> Callable[..., Any]:
    """Lambdify the derived expression with the constants in the order of a batch."""
    arguments = LOADS if SIDES[function] == "loads" else STRAINS
    expression = _expression(function)
    compiled: Callable[..., Any] = sp.lambdify((*arguments, *ORDER), expression, module, cse=cse)
    return compiled


@cache
def _expression(function: str) -> Any:
    Q, dual = constitutive.quadratic_form(), constitutive.dual_form()
    parameters = (1 / p, 2 / p), (1 + 2 / p,)
    match function:
        case "stored_energy":
            return gamma * Q / 2 * sp.hyper(*parameters, Q ** (p / 2))
        case "complementary_energy":
            return dual / (2 * gamma) * sp.hyper(*parameters, -(dual ** (p / 2)) / gamma**p)
        case "strains":
            *rest, stretch = constitutive.strains()
            return (*rest, 1 + stretch)
        case "loads":
            return constitutive.loads()
        case "stiffness":
            return tuple(constitutive.stiffness())
        case "compliance":
            return tuple(constitutive.compliance())
    raise ValueError(f"{function}: not one of the six functions")
