"""Markdown as parts of a page, the reports and the guide; plots are linked where they lie."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup

#: The pages of the guide in the order of reading; others follow.
ORDER = ("README", "verdicts", "scenes", "embedding", "numerics", "scale", "house")


@dataclass(frozen=True)
class Article:
    """A Markdown file, by its name, as HTML."""

    name: str
    body: Markup


def articles(folder: Path, link: str) -> tuple[Article, ...]:
    """The Markdown files of a folder; ``link`` leads from the page to the folder.

    They stand on one page: links from one to the other become places on it.
    """
    paths = sorted(folder.glob("*.md"), key=lambda path: (_rank(path.stem), path.stem))
    names = {path.name for path in paths}
    return tuple(Article(path.stem, _html(path.read_text("utf-8"), link, names)) for path in paths)


def _rank(name: str) -> int:
    return ORDER.index(name) if name in ORDER else len(ORDER)


def _html(text: str, link: str, names: set[str]) -> Markup:
    reader = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = reader.parse(text)
    for token in tokens:
        _fit(token, link, names)
    body = reader.renderer.render(tokens, reader.options, {})
    body = body.replace("<table>", '<div class="scroll"><table class="numbers">')
    return Markup(body.replace("</table>", "</table></div>"))


def _fit(token: Token, link: str, names: set[str]) -> None:
    """Headings one level down, since the page has its own; pictures and links from the page."""
    if token.type in ("heading_open", "heading_close"):
        token.tag = f"h{int(token.tag[1]) + 1}"
    for child in token.children or ():
        for name in ("src", "href"):
            target = str(child.attrs.get(name, ""))
            if target in names:
                child.attrs[name] = f"#{target.removesuffix('.md')}"
            elif target and ":" not in target and not target.startswith("#"):
                child.attrs[name] = f"{link}/{target}"
