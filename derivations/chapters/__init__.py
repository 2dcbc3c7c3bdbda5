"""The derivation as chapters: what a reader follows, each step proved where it stands.

Chapters hold no mathematics of their own. They arrange what `theory` derives into steps, each
with the rule used, the formula reached in the paper's notation, and the check that proves it.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from functools import cache

from rodproof.derivations import ledger
from rodproof.derivations.records import Derivation

#: Module -> the section it belongs to and the labels of its derivations, in reading order. Only
#: the module that is asked for is loaded.
_MODULES: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "kinematics": (("1", "2.1", "2.2"), ("kinematics", "balance")),
    "constitutive": (
        ("1", "3.1"),
        ("quadratic-forms", "strains", "inverse", "strain-limit", "small-strain"),
    ),
    "energies": (("3.1",), ("stored-energy", "duality", "closed-forms")),
    "tangents": (("3.1", "3.4"), ("hessian",)),
    "orientation": (("3.2", "3.3"), ("orientation", "symmetry")),
    "monotonicity": (("3.4",), ("monotonicity",)),
    "euler": (("4", "4.1"), ("euler-angles", "reduced-equations")),
    "thrust": (("4.2",), ("straight-states", "sheared-states")),
    "couple": (("4.3",), ("twisted-states", "helical-states")),
    "dynamics": (("5.1", "5.2"), ("motion", "dissipation")),
}


class UnknownDerivation(ValueError):
    """A label that no chapter has; the message names the nearest ones."""


@cache
def _chapter(module: str) -> Mapping[str, Derivation]:
    loaded = importlib.import_module(f"rodproof.derivations.chapters.{module}")
    return {d.label: d for d in loaded.derivations()}


def labels() -> tuple[str, ...]:
    """The labels of all derivations, in reading order."""
    return tuple(label for _, found in _MODULES.values() for label in found)


def derive(label: str) -> Derivation:
    """The derivation with this label. Raises UnknownDerivation."""
    for module, (_, found) in _MODULES.items():
        if label in found:
            return _chapter(module)[label]
    raise UnknownDerivation(ledger.unknown("derivation", label, labels()))


def settling(statement: str, section: str) -> tuple[tuple[Derivation, int], ...]:
    """The steps that settle a statement, as (derivation, number of the step from 1)."""
    return tuple(
        (derivation, number)
        for module, (sections, _) in _MODULES.items()
        if section in sections
        for derivation in _chapter(module).values()
        for number, step in enumerate(derivation.steps, 1)
        if statement in step.statements
    )
