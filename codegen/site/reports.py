"""The measured reports as parts of a page: Markdown to HTML, with the plots where they lie."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup


@dataclass(frozen=True)
class Report:
    """A report, by the name of its file, as HTML."""

    name: str
    body: Markup


def reports(folder: Path, link: str) -> tuple[Report, ...]:
    """The Markdown reports of a folder; ``link`` leads from the page to the folder."""
    return tuple(
        Report(path.stem, _html(path.read_text("utf-8"), link))
        for path in sorted(folder.glob("*.md"))
    )


def _html(text: str, link: str) -> Markup:
    reader = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = reader.parse(text)
    for token in tokens:
        _fit(token, link)
    body = reader.renderer.render(tokens, reader.options, {})
    body = body.replace("<table>", '<div class="scroll"><table class="numbers">')
    return Markup(body.replace("</table>", "</table></div>"))


def _fit(token: Token, link: str) -> None:
    """Headings one level down, since the page has its own; pictures and links from the page."""
    if token.type in ("heading_open", "heading_close"):
        token.tag = f"h{int(token.tag[1]) + 1}"
    for child in token.children or ():
        for name in ("src", "href"):
            target = str(child.attrs.get(name, ""))
            if target and ":" not in target and not target.startswith("#"):
                child.attrs[name] = f"{link}/{target}"
