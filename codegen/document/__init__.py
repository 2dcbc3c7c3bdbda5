"""Documents of the derivation, written from the same objects as the code and the verdicts."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rodproof.codegen.document import article, errata
from rodproof.codegen.files import write_text
from rodproof.derivations.records import Evidence


def write(folder: Path, evidence: Sequence[Evidence]) -> list[Path]:
    """Write `derivation.tex` and `errata.md` into `folder`; the files written.

    Each file is written whole or not at all.
    """
    texts = {
        folder / "derivation.tex": article.render(evidence),
        folder / "errata.md": errata.render(evidence),
    }
    for path, text in texts.items():
        write_text(path, text)
    return list(texts)
