"""Every step of every derivation proves itself; a wrong step does not."""

from __future__ import annotations

import dataclasses

import pytest

from rodproof.derivations import chapters, ledger
from rodproof.derivations.notation import Chain, equal

STEPS = [
    (label, k) for label in chapters.labels() for k in range(len(chapters.derive(label).steps))
]


@pytest.mark.parametrize(("label", "k"), STEPS)
def test_step(label: str, k: int) -> None:
    step = chapters.derive(label).steps[k]
    if step.check is None:
        return
    found = step.check.decide(step.formula)
    assert found.holds and found.exact, found.method
    confirmation = step.check.confirm(step.formula)
    assert confirmation is None or confirmation.residual < ledger.AGREEMENT


def test_steps_settle_known_statements() -> None:
    known = set(ledger.recorded())
    for label in chapters.labels():
        for step in chapters.derive(label).steps:
            assert set(step.statements) <= known, step.title


def test_the_table_of_labels_is_what_the_modules_have() -> None:
    for module, (sections, found) in chapters._MODULES.items():
        assert tuple(chapters._chapter(module)) == found
        settled = {
            ledger.find((name,))[0].section
            for label in found
            for step in chapters.derive(label).steps
            for name in step.statements
        }
        assert settled <= set(sections)


def test_a_wrong_step_does_not_prove_itself() -> None:
    for step in chapters.derive("strains").steps:
        assert isinstance(step.formula, Chain) and step.check is not None
        wrong = dataclasses.replace(
            step, formula=equal(step.formula.sides[0], -step.formula.sides[-1])
        )
        assert not step.check.decide(wrong.formula, explain=False).holds


def test_unknown_labels_name_the_nearest() -> None:
    with pytest.raises(chapters.UnknownDerivation, match="hessian"):
        chapters.derive("hesian")
