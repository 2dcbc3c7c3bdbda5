"""Every command and snippet of the guide and the README is run, and what it shows is what comes.

In a fenced block marked ``console`` lines after ``$ `` are commands; the lines below are their
output, where ``...`` stands for anything. ``$ cat FILE`` of a file that is not there makes it. The
blocks marked ``python`` of a page are one session (with ``>>>``) or are executed as they stand; one
that begins with ``# needs: NAME`` runs where that library is installed.
"""

from __future__ import annotations

import doctest
import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parent.parent.parent
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs" / "guide").glob("*.md"))]
LOOSE = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE


@dataclass(frozen=True)
class Block:
    """A fenced block: its language and its text."""

    language: str
    text: str


def blocks(page: str) -> Iterator[Block]:
    for token in MarkdownIt("commonmark").parse(page):
        if token.type == "fence":
            yield Block(token.info.strip(), token.content)


def commands(text: str) -> Iterator[tuple[str, str]]:
    """Each command with the output shown below it."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition("\n")
        yield command, shown


def agree(shown: str, printed: str) -> bool:
    """Whether the output is what the page shows, spaces at the ends of lines aside."""
    return doctest.OutputChecker().check_output(shown.strip(), printed.strip(), LOOSE)


def run_console(text: str, folder: Path) -> None:
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "NO_COLOR": "1"}
    for command, shown in commands(text):
        made = re.fullmatch(r"cat (\S+)", command)
        if made and not (folder / made[1]).exists():
            (folder / made[1]).write_text(shown)
            continue
        done = subprocess.run(
            ["bash", "-c", command], cwd=folder, env=environment, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False,
        )  # fmt: skip
        assert done.returncode == 0, f"$ {command}\n{done.stdout}"
        assert agree(shown, done.stdout), f"$ {command}\nshown:\n{shown}\nprinted:\n{done.stdout}"


def run_python(text: str, names: dict[str, Any], page: str) -> None:
    needed = re.match(r"# needs: (\w+)", text)
    if needed and importlib.util.find_spec(needed[1]) is None:
        return
    if ">>>" not in text:
        exec(compile(text, page, "exec"), names)
        return
    test = doctest.DocTestParser().get_doctest(text, names, page, page, 0)
    runner = doctest.DocTestRunner(optionflags=LOOSE)
    runner.run(test, clear_globs=False)
    names.update(test.globs)
    assert runner.summarize(verbose=False).failed == 0


# A cluster of dask.distributed may close its connections after the page is done with it.
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_what_a_page_shows_is_what_comes(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    names: dict[str, Any] = {"__name__": "__page__"}
    for block in blocks(page.read_text("utf-8")):
        if block.language == "console":
            run_console(block.text, tmp_path)
        if block.language == "python":
            run_python(block.text, names, page.name)


@pytest.mark.parametrize("page", PAGES, ids=lambda path: str(path.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    targets = re.findall(r"\]\(([^)#:]+)\)", page.read_text("utf-8"))
    assert [target for target in targets if not (page.parent / target).exists()] == []


def test_the_harness_sees_a_wrong_page(tmp_path: Path) -> None:
    with pytest.raises(AssertionError):
        run_console("$ echo one\ntwo\n", tmp_path)
    with pytest.raises(AssertionError):
        run_console("$ false\n", tmp_path)
    with pytest.raises(AssertionError):
        run_python(">>> 1 + 1\n3\n", {}, "page")
    run_console("$ cat new.txt\nhello\n$ wc -w new.txt\n1 new.txt\n", tmp_path)
