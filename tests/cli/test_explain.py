"""Derivations as text, LaTeX and data say the same things."""

from __future__ import annotations

import json

import pytest
from typer.testing import CliRunner

from rodproof.codegen import explain
from rodproof.codegen.cli import app
from rodproof.derivations import chapters

LABELS = chapters.labels()


@pytest.mark.parametrize("label", LABELS)
def test_every_step_is_there_in_every_format(label: str) -> None:
    derivation = chapters.derive(label)
    text, latex = explain.text([derivation]), explain.latex([derivation])
    (data,) = explain.data([derivation])
    assert text.startswith(derivation.title)
    for number, (step, row) in enumerate(zip(derivation.steps, data["steps"], strict=True), 1):
        assert f"\n{number}. {step.title}" in text
        assert all(statement in text for statement in step.statements)
        assert row["statements"] == list(step.statements)
        assert row["latex"]
    assert latex.count(r"\begin{equation}") == len(derivation.steps)


def test_text_speaks_the_notation_and_not_python() -> None:
    text = explain.text([chapters.derive(label) for label in LABELS])
    for name in (
        "Chain(",
        "Every(",
        "Implies(",
        "Iff(",
        "PositiveDefinite(",
        "Partial(",
        "Matrix(",
    ):
        assert name not in text
    assert "u[3] = d Wstar(m, n)/d m[3] = " in text


def test_derive_names_what_is_asked_for() -> None:
    runner = CliRunner()
    one = runner.invoke(app, ["derive", "strains"]).stdout
    assert "[strains]" in one
    assert "[inverse]" not in one
    everything = json.loads(runner.invoke(app, ["derive", "--json"]).stdout)
    assert [row["label"] for row in everything] == list(LABELS)
