"""The derivation as chapters: what a reader follows, each step proved where it stands.

Chapters hold no mathematics of their own. They arrange what `theory` derives into steps, each
with the rule used, the formula reached in the paper's notation, and the check that proves it.
"""

from __future__ import annotations

import difflib
import importlib
from collections.abc import Mapping
from functools import cache

from rodproof.derivations.records import Derivation

#: Modules with a `derivations()` function, in reading order.
_MODULES = ("constitutive", "energies", "tangents")


class UnknownDerivation(ValueError):
    """A label that no chapter has; the message names the nearest ones."""


@cache
def _all() -> Mapping[str, Derivation]:
    found = {}
    for name in _MODULES:
        module = importlib.import_module(f"rodproof.derivations.chapters.{name}")
        found |= {d.label: d for d in module.derivations()}
    return found


def labels() -> tuple[str, ...]:
    """The labels of all derivations, in reading order."""
    return tuple(_all())


def derive(label: str) -> Derivation:
    """The derivation with this label. Raises UnknownDerivation."""
    if label not in _all():
        near = difflib.get_close_matches(label, labels(), n=3, cutoff=0.3)
        hint = f"; nearest: {', '.join(near)}" if near else ""
        raise UnknownDerivation(f"there is no derivation {label!r}{hint}")
    return _all()[label]
