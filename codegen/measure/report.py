"""From stored data to pages and pictures; nothing is measured here."""

from __future__ import annotations

from pathlib import Path

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import atlas, atlas_plot, atlas_table, plot, records, table
from rodproof.codegen.measure.integrators.report import report as report_integrators


def report(data: Path, folder: Path) -> list[Path]:
    """Write the page and the plots of the measurement stored at ``data``."""
    measurement = records.load(data)
    page = folder / "measurement.md"
    plots = [path for scene in measurement.scenes for path in plot.draw(measurement, scene, folder)]
    write_text(page, table.page(measurement))
    return [page, *plots]


def report_atlas(data: Path, folder: Path) -> list[Path]:
    """Write the page and the maps of the stability atlas stored at ``data``."""
    found = atlas.load(data)
    page = folder / "atlas.md"
    maps = [path for scene in found.scenes for path in atlas_plot.draw(found, scene, folder)]
    write_text(page, atlas_table.page(found))
    return [page, *maps]


#: What a folder may hold, and who draws it; and a word by which the file is told, if alone.
KNOWN = {
    "measurement.json": (report, '"times"'),
    "atlas.json": (report_atlas, '"charts"'),
    "integrators.json": (report_integrators, '"references"'),
}


def drawn(data: Path, folder: Path) -> list[Path]:
    """Pages and pictures of one stored file, or of all that a folder holds."""
    if data.is_dir():
        found = [(data / name, draw) for name, (draw, _) in KNOWN.items()]
        found = [(source, draw) for source, draw in found if source.is_file()]
        if not found:
            raise ValueError(f"{data}: holds nothing measured; run `rodproof measure`")
        return [path for source, draw in found for path in draw(source, folder)]
    text = data.read_text("utf-8") if data.is_file() else ""
    draw = next((draw for draw, word in KNOWN.values() if word in text), report)
    return draw(data, folder)
