"""The pages of the site, each a template filled with the records that the rest is made from."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import groupby
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from rodproof.codegen.site import mathml, words
from rodproof.codegen.site.reports import articles
from rodproof.codegen.site.scenes import shown
from rodproof.derivations import chapters
from rodproof.derivations.latex import block
from rodproof.derivations.records import VERDICTS, Derivation, Evidence, Step

#: The pages that the navigation names: file and title.
NAVIGATION = (
    ("index.html", "Overview"),
    ("statements.html", "Statements"),
    ("errata.html", "Errata"),
    ("derivation.html", "Derivation"),
    ("scenes.html", "Scenes"),
    ("report.html", "Report"),
    ("guide.html", "Guide"),
)


@dataclass(frozen=True)
class Section:
    """A section of the paper and how many of its statements have which verdict."""

    number: str
    title: str
    size: int
    counts: tuple[tuple[str, int], ...]


@dataclass(frozen=True)
class Place:
    """A step of a derivation, by where it stands."""

    derivation: Derivation
    number: int

    @property
    def step(self) -> Step:
        return self.derivation.steps[self.number - 1]


def render(evidence: Sequence[Evidence], documents: Path) -> dict[str, str]:
    """The text of every page by its place in the site, which lies in ``documents``."""
    environment = _environment()
    return {
        name: environment.get_template(template).render(
            here=name, root="../" * name.count("/"), **more
        )
        for name, template, more in _pages(evidence, documents)
    }


def _pages(
    evidence: Sequence[Evidence], documents: Path
) -> Iterator[tuple[str, str, dict[str, object]]]:
    """Place, template and contents of each page."""
    derivations = tuple(chapters.derive(label) for label in chapters.labels())
    scenes = shown()
    whole: dict[str, object] = {
        "evidence": evidence,
        "verdicts": {row.id: row for row in evidence},
        "sections": _sections(evidence),
        "counts": _counts(evidence),
        "derivations": derivations,
        "scenes": scenes,
    }
    for name, _ in NAVIGATION[:-2]:
        yield name, name, whole
    for name in ("report", "guide"):
        found = articles(documents / name, f"../{name}")
        yield f"{name}.html", f"{name}.html", {"articles": found}
    for before, row, after in _neighbours(evidence):
        places = tuple(Place(*found) for found in chapters.settling(row.id, row.section))
        more: dict[str, object] = {"row": row, "before": before, "after": after, "places": places}
        yield f"statement/{row.id}.html", "statement.html", more
    for scene in scenes:
        yield f"scene/{scene.scene.name}.html", "scene.html", {"shown": scene}


def _neighbours(
    rows: Sequence[Evidence],
) -> Iterable[tuple[Evidence | None, Evidence, Evidence | None]]:
    return zip((None, *rows[:-1]), rows, (*rows[1:], None), strict=True)


def _sections(evidence: Sequence[Evidence]) -> tuple[Section, ...]:
    found = []
    for number, group in groupby(evidence, key=lambda row: row.section):
        rows = tuple(group)
        found.append(Section(number, words.SECTIONS.get(number, ""), len(rows), _counts(rows)))
    return tuple(found)


def _counts(evidence: Sequence[Evidence]) -> tuple[tuple[str, int], ...]:
    counts = Counter(row.verdict for row in evidence)
    return tuple((verdict, counts[verdict]) for verdict in VERDICTS if counts[verdict])


@cache
def _environment() -> Environment:
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {
        "prose": mathml.prose,
        "formula": mathml.display,
        "block": block,
        "power": _power,
        "sentence": _sentence,
    }
    environment.globals |= {"navigation": NAVIGATION, "words": words}
    return environment


def _power(number: float) -> Markup:
    """2.4e-66 as a reader writes it."""
    if number == 0:
        return Markup("0")
    digits, _, exponent = f"{number:.1e}".partition("e")
    return Markup("{} × 10<sup>{}</sup>").format(digits, str(int(exponent)).replace("-", "−"))


def _sentence(text: str) -> Markup:
    """Prose that ends in a full stop."""
    return mathml.prose(text if text.endswith((".", "!", "?")) else f"{text}.")
