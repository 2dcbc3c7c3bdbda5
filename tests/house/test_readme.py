"""What the README shows is what happens."""

from __future__ import annotations

import doctest
import re
from pathlib import Path

from typer.main import get_command

from rodproof.codegen.cli import app


def test_its_python_runs(root: Path) -> None:
    failed, tried = doctest.testfile(str(root / "README.md"), module_relative=False)
    assert tried >= 6
    assert failed == 0


def test_it_names_every_command(root: Path) -> None:
    text = (root / "README.md").read_text()
    named = set(re.findall(r"`rodproof (\w+)", text))
    assert set(get_command(app).commands) == named  # type: ignore[attr-defined]


def test_its_links_and_pictures_exist(root: Path) -> None:
    text = (root / "README.md").read_text()
    targets = re.findall(r"\]\(([^)]+)\)", text)
    assert targets
    assert [target for target in targets if not (root / target).exists()] == []


def test_its_make_targets_exist(root: Path) -> None:
    makefile = (root / "Makefile").read_text()
    for target in re.findall(r"`make (\w+)`", (root / "README.md").read_text()):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
