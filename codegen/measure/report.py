"""From a stored measurement to its page and plots; nothing is measured here."""

from __future__ import annotations

from pathlib import Path

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import plot, records, table

DRAWN = ("ordinary", "extreme")


def report(data: Path, folder: Path) -> list[Path]:
    """Write the page and the plots of the measurement stored at ``data``."""
    measurement = records.load(data)
    page = folder / "measurement.md"
    plots = [path for sample in DRAWN for path in plot.draw(measurement, sample, folder)]
    write_text(page, table.page(measurement))
    return [page, *plots]
