"""Every form that is measured: ours, the textbook's, and what SymPy and mpmath give today.

A form binds a scene's function to one set of constants, as a user would before a loop; the bound
call is what is timed. What it returns is turned into components only afterwards. The forms know
the scene as well as we do: lost components, fixed constants and the law of a constrained rod are
put in before they begin.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import mpmath
import numpy as np
import sympy as sp

from rodproof.codegen import lower
from rodproof.codegen.live import substitution
from rodproof.codegen.measure.forms import Textbook
from rodproof.codegen.measure.inputs import Array, Batch
from rodproof.codegen.measure.subjects import Subject
from rodproof.derivations.symbols import LOADS, STRAINS, alpha, beta, eta, gamma, iota, p, zeta
from rodproof.derivations.theory import constitutive

ORDER = (alpha, beta, zeta, eta, iota, gamma, p)  # of Batch.constants
ENERGIES = ("stored_energy", "complementary_energy")
TWO_F_ONE = "; energies at general p by mpmath's 2F1 (NumPy has none)"

#: A bound call: what ``prepare`` made of the points in, whatever the form returns out.
Call = Callable[..., Any]
Bind = Callable[[Subject, str, tuple[float, ...]], Call]
#: Makes the arguments of a bound call of (3, N) and (3, N); the last says that N is one, to be
#: given without its axis where the form can do that.
Prepare = Callable[[Subject, str, Array, Array, bool], Sequence[Any]]
#: The components of an answer, or None where the form gave none.
Answer = list[Any] | None


@dataclass(frozen=True)
class Form:
    """A way to compute a scene's functions, and what it is in words.

    ``loops`` says whether it can do a function only in a Python loop over the points. ``quick``:
    also measured when in a hurry.
    """

    name: str
    words: str
    bind: Bind
    prepare: Prepare
    dtype: type[np.floating] = np.float64
    loops: Callable[[Subject, str], bool] = lambda subject, function: False
    quick: bool = False


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
            _blocks,
            quick=True,
        ),
        Form(
            "lambdify",
            f"SymPy's lambdify of the derivation{TWO_F_ONE}",
            _lambdify(cse=False),
            _rows,
            loops=_needs_2f1,
        ),
        Form(
            "lambdify cse",
            f"the same with cse=True{TWO_F_ONE}",
            _lambdify(cse=True),
            _rows,
            loops=_needs_2f1,
            quick=True,
        ),
        *(
            Form(
                f"mpmath {digits}",
                f"lambdify to mpmath with cse=True, at {digits} digits",
                _mpmath(digits),
                _rows,
                loops=lambda subject, function: True,
            )
            for digits in (15, 30, 50)
        ),
    )


def form_of(name: str) -> Form:
    """The form of that name."""
    return next(form for form in all_forms() if form.name == name)


def answers(form: Form, subject: Subject, function: str, batch: Batch) -> list[Answer]:
    """The measured components at every point; None where the form refuses or fails."""
    first, second = batch.first.astype(form.dtype), batch.second.astype(form.dtype)
    try:
        law = form.bind(subject, function, batch.constants)
        raw = law(*form.prepare(subject, function, first, second, False))
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
    if isinstance(raw, _Points):
        return raw.points
    parts = raw if isinstance(raw, tuple) else (raw,)
    rows = [  # lambdify: a component may be a single number
        np.reshape(np.broadcast_to(part, np.shape(part) or (size,)), (-1, size)) for part in parts
    ]
    return [list(column) for column in np.concatenate(rows).T]


@dataclass(frozen=True)
class _Points:
    """What a form that goes point by point returns."""

    points: list[Answer]


def _arrays(
    subject: Subject, function: str, first: Array, second: Array, single: bool
) -> Sequence[Any]:
    """The arrays of the generated function; a single point in doubles as tuples of numbers."""
    arrays = subject.arguments(function, first, second)
    if not single or first.dtype != np.float64:
        return arrays
    return [tuple(a[:, 0].tolist()) if a.ndim > 1 else a.item() for a in arrays]


def _blocks(
    subject: Subject, function: str, first: Array, second: Array, single: bool
) -> Sequence[Any]:
    return first, second


def _rows(
    subject: Subject, function: str, first: Array, second: Array, single: bool
) -> Sequence[Any]:
    """The live components, as plain numbers for a single point."""
    rows = [np.ascontiguousarray(row) for row in (*first, *second)]
    return [rows[i].item() if single else rows[i] for i in subject.loads]


def _generated(subject: Subject, function: str, values: tuple[float, ...]) -> Call:
    constants = subject.record(values)
    law, out = getattr(subject.module, function), None

    def call(*arrays: Any) -> Any:
        nonlocal out
        answer = law(*arrays, constants, out=out)
        if np.ndim(arrays[0]) and np.shape(arrays[0])[-1] > 3:  # a block is filled again
            out = answer
        return answer

    return call


def _textbook(subject: Subject, function: str, values: tuple[float, ...]) -> Call:
    book = Textbook(subject.loads, subject.strains, subject.scene.fixed.get("p") == 2)
    law = getattr(book, function)
    return lambda first, second: law(first, second, values)


def _needs_2f1(subject: Subject, function: str) -> bool:
    return function in ENERGIES and subject.scene.fixed.get("p") != 2


def _lambdify(*, cse: bool) -> Bind:
    def bind(subject: Subject, function: str, values: tuple[float, ...]) -> Call:
        if _needs_2f1(subject, function):  # NumPy has no 2F1: what a user can do without SciPy
            return _pointwise(_law(subject, function, "mpmath", cse), values)
        law = _law(subject, function, "numpy", cse)
        return lambda *rows: law(*rows, *values)

    return bind


def _mpmath(digits: int) -> Bind:
    def bind(subject: Subject, function: str, values: tuple[float, ...]) -> Call:
        law = _pointwise(_law(subject, function, "mpmath", True), values)

        def call(*rows: Any) -> _Points:
            with mpmath.workdps(digits):
                return law(*rows)

        return call

    return bind


def _pointwise(law: Callable[..., Any], values: tuple[float, ...]) -> Callable[..., _Points]:
    def call(*rows: Any) -> _Points:
        constants = [mpmath.mpf(value) for value in values]
        columns = zip(*(np.atleast_1d(row).tolist() for row in rows), strict=True)
        return _Points([_try(law, map(mpmath.mpf, column), constants) for column in columns])

    return call


def _try(law: Callable[..., Any], column: Iterable[Any], constants: Iterable[Any]) -> Answer:
    try:
        answer = law(*column, *constants)
    except (ArithmeticError, ValueError):
        return None
    found = list(answer) if isinstance(answer, tuple) else [answer]
    return None if any(isinstance(entry, mpmath.mpc) for entry in found) else found


def _law(subject: Subject, function: str, module: str, cse: bool) -> Callable[..., Any]:
    """The lambdified function; the stiffness at loads by the strains, as a user has to."""
    if function != "stiffness_at_loads":
        return _compiled(subject, function, module, cse)
    strains, stiffness = (
        _compiled(subject, name, module, cse) for name in ("strains", "stiffness")
    )
    places = [subject.strains.index(i) for i in subject.loads]

    def both(*numbers: Any) -> Any:
        caused = strains(*numbers)
        return stiffness(*(caused[k] for k in places), *numbers[len(places) :])

    return both


@cache
def _compiled(subject: Subject, function: str, module: str, cse: bool) -> Callable[..., Any]:
    """Lambdify the derived expression: live components, then the constants of a batch."""
    whole = LOADS if subject.side(function) == "loads" else STRAINS
    arguments = [whole[i] for i in subject.loads]
    known = substitution(subject.scene)
    expression = tuple(sp.sympify(e).xreplace(known) for e in _expressions(subject, function))
    compiled: Callable[..., Any] = sp.lambdify((*arguments, *ORDER), expression, module, cse=cse)
    return compiled


def _expressions(subject: Subject, function: str) -> list[Any]:
    """What the function returns, before the scene is put in."""
    Q, dual = constitutive.quadratic_form(), constitutive.dual_form()
    parameters = (1 / p, 2 / p), (1 + 2 / p,)
    match function:
        case "stored_energy" if not _needs_2f1(subject, function):
            return [constitutive.ELEMENTARY[sp.Integer(2)][0].subs(constitutive.x, sp.sqrt(Q))]
        case "complementary_energy" if not _needs_2f1(subject, function):
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
            return [*_expressions(subject, "strains"), gap]
        case "loads":
            return [constitutive.loads()[i] for i in subject.loads]
        case "loads_and_stiffness":
            return [*_expressions(subject, "loads"), *_expressions(subject, "stiffness")]
        case "stiffness" | "compliance":
            matrix = getattr(constitutive, function)()
            return [matrix[i, j] for i in subject.loads for j in subject.loads]
    raise ValueError(f"{function}: no expression of the derivation")
