"""From a stored study of integrators to its page and plots; nothing is integrated here."""

from __future__ import annotations

from pathlib import Path

from rodproof.codegen.files import write_text
from rodproof.codegen.measure.integrators import page, plot, records


def report(data: Path, folder: Path) -> list[Path]:
    """Write the page and the plots of the study stored at ``data``."""
    study = records.load(data)
    written = folder / "integrators.md"
    plots = plot.draw(study, folder)
    write_text(written, page.page(study))
    return [written, *plots]
