"""The LaTeX document: it carries every verdict, is the same twice, and compiles."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from rodproof.codegen import document
from rodproof.codegen.document import tex
from rodproof.derivations import chapters, ledger
from rodproof.derivations.records import Evidence


@pytest.fixture(scope="module")
def evidence() -> tuple[Evidence, ...]:
    return ledger.check(ledger.statements(), jobs=2)


def test_every_statement_and_step_is_in_it(tmp_path: Path, evidence: tuple[Evidence, ...]) -> None:
    source, errata = (path.read_text() for path in document.write(tmp_path, evidence))
    for e in evidence:
        assert rf"\sid{{{tex.escape(e.id)}}}" in source
        assert (f"`{e.id}`" in errata) == (e.verdict in ("refuted", "reading"))
    for label in chapters.labels():
        assert rf"\label{{{label}}}" in source


def test_the_same_bytes_twice(tmp_path: Path, evidence: tuple[Evidence, ...]) -> None:
    first = [p.read_bytes() for p in document.write(tmp_path / "a", evidence)]
    assert first == [p.read_bytes() for p in document.write(tmp_path / "b", evidence)]


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="TeX is not installed")
def test_it_compiles_without_errors_or_overfull_lines(
    tmp_path: Path, evidence: tuple[Evidence, ...]
) -> None:
    document.write(tmp_path, evidence)
    for _ in range(2):
        done = subprocess.run(
            ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "derivation.tex"],
            cwd=tmp_path, capture_output=True, text=True, errors="replace", check=False,
        )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:]
    assert "undefined" not in done.stdout.lower()
    assert "invalid in math mode" not in done.stdout
    wide = [float(w) for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", done.stdout)]
    assert all(w < 10 for w in wide), wide


@pytest.mark.parametrize(
    ("plain", "wanted"),
    [
        ("a 100 % safe & plain_text", r"a 100 \% safe \& "),
        ("`Q*^{p/2}` is", r"$Q^{*\,p/2}$ is"),
        ("`gamma >= 0`", r"$\gamma  \geq  0$"),
    ],
)
def test_prose(plain: str, wanted: str) -> None:
    assert wanted.split("$")[0] in tex.prose(plain)
    assert tex.prose(plain).count("$") % 2 == 0
