"""Stiff and extreme cases by name, and what the full rod does there."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np

from rodproof.codegen.measure.errors import RIGHT, truth
from rodproof.codegen.measure.form import answers
from rodproof.codegen.measure.inputs import Batch, inside
from rodproof.codegen.measure.rivals import form_of
from rodproof.codegen.measure.subjects import subject

#: Unit moduli without coupling: x and y are plain lengths.
PLAIN = (1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 2.4)
EDGE = (1.0, 1.0, 1.0, 1.0, 1 - 2.0**-50, 1.0, 2.4)
REST = (0.0,) * 6
#: Ulps that the inputs' own rounding costs, from which on it is said.
LOSS = 1e6
STEP = 5e-324


@dataclass(frozen=True)
class Case:
    """A function of the full rod at a point that says something; v3 is given, not v3 - 1."""

    title: str
    function: str
    constants: tuple[float, ...]
    point: tuple[float, ...]


def _with(**changed: float) -> tuple[float, ...]:
    names = ("alpha", "beta", "zeta", "eta", "iota", "gamma", "p")
    return tuple(changed.get(name, value) for name, value in zip(names, PLAIN, strict=True))


CASES = (
    Case("no load", "strains", PLAIN, REST),
    Case("no load", "compliance", _with(p=0.3), REST),
    Case("at rest, p < 2", "stiffness", _with(p=0.3), (0, 0, 0, 0, 0, 1)),
    Case("the smallest number as load", "strains", PLAIN, (STEP, 0, 0, 0, 0, 0)),
    Case("loads of 1e160", "strains", PLAIN, (1e160, 1e160, 0, 0, 0, -1e160)),
    Case(
        "gamma = 1e-100, p = 1000", "strains", _with(gamma=1e-100, p=1000.0), (0.3, 0, 0, 0, 0, 2)
    ),
    Case("a kink: p = 1000 where y = gamma", "compliance", _with(p=1000.0), (0.6, 0, 0, 0, 0, 0.8)),
    Case("p = 1 + 1e-10", "stored_energy", _with(p=1 + 1e-10), (0.3, 0, 0, 0, 0.9, 1.1)),
    Case("x = 1e-8, p = 1", "stored_energy", _with(p=1.0), (1e-8, 0, 0, 0, 0, 1)),
    Case("Q = 1 - 2e-15", "loads", PLAIN, (1 - 1e-15, 0, 0, 0, 0, 1)),
    Case("Q = 1 - 2e-15", "stiffness", PLAIN, (1 - 1e-15, 0, 0, 0, 0, 1)),
    Case("the load that causes it", "stiffness_at_loads", PLAIN, (1e6, 0, 0, 0, 0, 0)),
    Case("a load of 1e15 gamma", "strains_and_gap", PLAIN, (6e14, 0, 0, 0, 0, 8e14)),
    Case("a load of 1e15 gamma", "stiffness_at_loads", PLAIN, (6e14, 0, 0, 0, 0, 8e14)),
    Case(
        "a load of 1e15 gamma, p = 1000",
        "stiffness_at_loads",
        _with(p=1000.0),
        (6e14, 0, 0, 0, 0, 8e14),
    ),
    Case("1 - iota/(beta eta) = 2^-50", "strains", EDGE, (0.1, 0, 0.5, 0, 0, -0.5)),
    Case("1 - iota/(beta eta) = 2^-50", "loads", EDGE, (0.1, 0, 0.3, 0, 0, 0.7)),
    Case("1 - iota/(beta eta) = 2^-50", "compliance", EDGE, (0.1, 0, 0.5, 0, 0, -0.5)),
    Case("iota = beta eta", "strains", _with(iota=1.0), (1, 0, 0, 0, 0, 0)),
    Case("Q = 1", "loads", PLAIN, (1, 0, 0, 0, 0, 1)),
    Case("Q = 4", "stored_energy", PLAIN, (2, 0, 0, 0, 0, 1)),
    Case("a strain that is no number", "stiffness", PLAIN, (float("nan"), 0, 0, 0, 0, 1)),
)


@dataclass(frozen=True)
class Outcome:
    """What happens: right, inherent loss, refused, or an overflow that is one; and the details."""

    title: str
    function: str
    what: str
    detail: str


def outcomes() -> tuple[Outcome, ...]:
    """What the generated full rod does in each case."""
    return tuple(map(_outcome, CASES))


def _outcome(case: Case) -> Outcome:
    one = subject("full_rod")
    whole = np.array(case.point, dtype=float)
    point = Batch(case.constants, whole[:3, None], whole[3:, None])
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        try:
            law = getattr(one.module, case.function)
            law(*one.arguments(case.function, whole[:3], whole[3:]), one.record(case.constants))
        except ValueError as refusal:
            return Outcome(case.title, case.function, "refused", str(refusal))
    if one.side(case.function) == "strains" and not inside(case.constants, whole):
        return Outcome(case.title, case.function, "wrong", "a number past the limit")
    exact = truth(one, case.function, point, 0, np.float64)
    if not exact.representable:
        said = warned[0].message if warned else "no warning"
        return Outcome(case.title, case.function, "overflow", f"no double holds it: {said}")
    with np.errstate(all="ignore"):
        (answer,) = answers(form_of("stable float64"), one, case.function, point)
    error = exact.error(answer)
    beyond = exact.beyond(error)
    detail = f"error {error:.2g} ulps, {exact.inherent:.2g} inherent"
    kind = "inherent loss" if exact.inherent > LOSS else "right"
    kind = kind if beyond <= RIGHT else "wrong"
    return Outcome(case.title, case.function, kind, detail)
