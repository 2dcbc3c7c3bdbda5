"""The files of the site: complete, closed in themselves, the same twice, nothing from elsewhere."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from typer.testing import CliRunner

from rodproof.codegen import places, site
from rodproof.codegen.cli import app
from rodproof.codegen.document import tex
from rodproof.codegen.site import mathml
from rodproof.derivations import chapters, ledger
from rodproof.derivations.latex import block
from rodproof.derivations.records import Evidence


class Reader(HTMLParser):
    """The ids of a page, what it links to and what it loads."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.ids: list[str] = []
        self.links: list[str] = []
        self.loads: list[str] = []
        self.feed(page.read_text("utf-8"))

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attrs}
        self.ids += [found["id"]] if "id" in found else []
        if tag == "a" and "href" in found:
            self.links.append(found["href"])
        elif "src" in found or "href" in found:
            self.loads.append(found.get("src") or found["href"])


def test_a_page_for_each_statement(pages: Path, evidence: tuple[Evidence, ...]) -> None:
    assert {path.stem for path in (pages / "statement").iterdir()} == {e.id for e in evidence}
    rows = json.loads((pages / "verdicts.json").read_text())
    assert [(row["id"], row["verdict"]) for row in rows] == [(e.id, e.verdict) for e in evidence]
    wrong = next(e for e in evidence if e.verdict == "refuted")
    text = (pages / "statement" / f"{wrong.id}.html").read_text()
    for part in ("As printed", "Counterexample", "Corrected", "Second route", "12 broken twins"):
        assert part in text
    assert "1.5 × 10<sup>−67</sup>" in text


def test_every_link_leads_somewhere_and_no_id_is_there_twice(pages: Path) -> None:
    read = {path: Reader(path) for path in pages.rglob("*.html")}
    beside = ("derivation.tex", "errata.md")  # written into the same folder by `document`
    for path, found in read.items():
        assert len(found.ids) == len(set(found.ids)), path
        for link in (*found.links, *found.loads):
            assert not re.match(r"\w+:|//", link), (path, link)
            file, _, anchor = link.partition("#")
            target = (path.parent / file).resolve() if file else path
            assert target.exists() or target.name in beside, (path, link)
            if anchor and "=" not in anchor:
                assert anchor in read[target].ids, (path, link)


def test_no_style_or_script_asks_for_the_network(pages: Path) -> None:
    for path in pages.iterdir():
        if path.suffix in (".css", ".js", ".html"):
            assert not re.search(r"url\(|@import|fetch\(|https?://", path.read_text()), path.name


def test_the_same_bytes_twice_and_no_page_too_many(
    pages: Path, evidence: tuple[Evidence, ...]
) -> None:
    stray = pages / "statement" / "gone.html"
    before = {path: path.read_bytes() for path in pages.rglob("*") if path.is_file()}
    stray.write_text("")
    site.write(pages, evidence)
    assert {path: path.read_bytes() for path in pages.rglob("*") if path.is_file()} == before


def test_every_formula_converts() -> None:
    sources = {s.latex for s in ledger.statements() if s.latex}
    sources |= {block(s.correction) for s in ledger.statements() if s.correction is not None}
    steps = [step for label in chapters.labels() for step in chapters.derive(label).steps]
    sources |= {block(step.formula) for step in steps}
    assert [source for source in sorted(sources) if "<code" in mathml.display(source)] == []


@pytest.mark.parametrize("source", [r"\begin{aligned} a", "a_b_c", r"\frac{1", "a & b", "}"])
def test_what_does_not_convert_is_shown_as_source(source: str) -> None:
    assert mathml.display(source) == f'<code class="latex">{source.replace("&", "&amp;")}</code>'


def test_the_pieces_of_a_formula() -> None:
    table = mathml.display(
        r"\begin{aligned}a &= \begin{bmatrix} b \\ c \end{bmatrix} \\ &< d\end{aligned}"
    )
    assert table.count("<mtr>") == 4
    assert 'class="aligned"' in table
    assert "𝒏" in mathml.display(r"\boldsymbol n")
    assert "<munder>" in mathml.display(r"\lim_{x \to 0} x")
    assert '<mi>sin</mi><mspace width="0.167em" /><mi>θ</mi>' in mathml.inline(r"\sin\theta")


def test_prose_keeps_its_words_and_sets_its_formulas() -> None:
    found = mathml.prose("if 100 % of `Q*^{p/2}` <b> is_not gamma")
    assert "100 % of" in found and "<b>" not in found
    assert found.count("<math") >= 2
    assert tex.unescape(tex.escape("a_b {x} 100% ~ ^ \\ & $5 #")) == "a_b {x} 100% ~ ^ \\ & $5 #"


def test_open_shows_the_page_or_says_where_it_is(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shown: list[str] = []
    monkeypatch.setattr(places, "checkout", lambda: places.Places(tmp_path))
    monkeypatch.setattr("webbrowser.open", lambda url: bool(shown.append(url)))
    missing = CliRunner().invoke(app, ["open"])
    assert missing.exit_code == 2 and "rodproof document" in missing.stderr
    page = tmp_path / "docs" / "site" / "index.html"
    page.parent.mkdir(parents=True)
    page.touch()
    assert CliRunner().invoke(app, ["open"]).stdout == f"{page}\n"
    assert shown == [page.as_uri()]
