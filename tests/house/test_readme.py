"""The README names every command, and only what is there (its snippets run in tests/guide)."""

from __future__ import annotations

import re
from pathlib import Path

from typer.main import get_command

from rodproof.codegen.cli import app


def test_it_names_every_command(root: Path) -> None:
    text = (root / "README.md").read_text()
    named = set(re.findall(r"`rodproof (\w+)", text))
    assert set(get_command(app).commands) == named  # type: ignore[attr-defined]


def test_its_make_targets_exist(root: Path) -> None:
    makefile = (root / "Makefile").read_text()
    for target in re.findall(r"`make (\w+)`", (root / "README.md").read_text()):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target
