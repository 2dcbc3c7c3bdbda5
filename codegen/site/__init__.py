"""The page that people look at: static HTML that opens from the file system, without network."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from rodproof.codegen.files import write_text
from rodproof.codegen.site import pages
from rodproof.derivations.records import Evidence

_ASSETS = Path(__file__).parent / "assets"
_OWNED = ("statement", "scene")  # folders in which every page is the site's


def write(folder: Path, evidence: Sequence[Evidence]) -> Path:
    """Write the site into `folder`, and the same evidence as `verdicts.json`; its first page.

    Everything is rendered before anything is written; each file is written whole or not at all.
    The reports and the guide shown are those that lie in `report` and `guide` beside the folder.
    """
    texts = pages.render(evidence, folder.parent)
    texts |= {path.name: path.read_text("utf-8") for path in sorted(_ASSETS.iterdir())}
    texts["verdicts.json"] = data(evidence)
    for name, text in texts.items():
        write_text(folder / name, text)
    _drop_strays(folder, texts)
    return folder / "index.html"


def data(evidence: Sequence[Evidence]) -> str:
    """The evidence as JSON, without what differs from run to run."""
    rows = [{k: v for k, v in row.as_row().items() if k != "seconds"} for row in evidence]
    return json.dumps(rows, indent=1, ensure_ascii=False) + "\n"


def _drop_strays(folder: Path, texts: dict[str, str]) -> None:
    """Pages of statements and scenes that are no more."""
    for owned in _OWNED:
        for path in (folder / owned).glob("*.html"):
            if f"{owned}/{path.name}" not in texts:
                path.unlink()
