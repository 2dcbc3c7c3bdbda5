"""``rodproof run`` in a folder of its own, with a measurement of a handful of points."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from typer.testing import CliRunner

from rodproof.codegen import places
from rodproof.codegen.cli import app
from rodproof.codegen.measure import survey
from rodproof.codegen.measure.subjects import subject

TINY = replace(survey.settings(quick=True), batches=1, points=2, rounds=1, timed_points=8)


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(places, "checkout", lambda: places.Places(tmp_path))
    monkeypatch.setattr(survey, "settings", lambda *, quick: TINY)
    monkeypatch.setattr(survey, "subjects", lambda: tuple(map(subject, ("full_rod", "thrust"))))
    return tmp_path


def test_run_does_all_and_says_where(here: Path) -> None:
    result = CliRunner().invoke(app, ["run", "--json"], catch_exceptions=False)
    assert result.exit_code == 0, result.stderr
    rows = json.loads(result.stdout)
    stages = [row["stage"] for row in rows]
    assert [stage for stage in dict.fromkeys(stages) if stage != "refuted"] == [
        *("derived", "checked", "generated", "documented", "measured", "drawn")
    ]
    assert "rodproof check constants-hypothesis" in [row["where"] for row in rows]
    for row in rows:
        if row["stage"] in ("generated", "documented", "measured", "drawn"):
            assert row["where"]
            assert all((here / name).is_file() for name in row["where"].split())
    drawn = " ".join(row["where"] for row in rows if row["stage"] == "drawn").split()
    made = (here / "docs" / "report").rglob("*.[sp][vn]g")
    assert sorted(drawn) == sorted(str(path.relative_to(here)) for path in made)
    assert not list(here.rglob("*.part"))


def test_outside_a_checkout_it_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(places, "__file__", str(tmp_path / "codegen" / "places.py"))
    result = CliRunner().invoke(app, ["run"], catch_exceptions=False)
    assert result.exit_code == 2
    assert "not a checkout of rodproof" in result.stderr
    assert result.stdout == ""
