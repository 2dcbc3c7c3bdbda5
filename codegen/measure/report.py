"""From a stored measurement to its page and plots; nothing is measured here."""

from __future__ import annotations

from pathlib import Path

from rodproof.codegen.files import write_text
from rodproof.codegen.measure import plot, records, table
from rodproof.codegen.measure.integrators.report import report as report_integrators

DRAWN = ("ordinary", "extreme")


def report(data: Path, folder: Path) -> list[Path]:
    """Write the page and the plots of the measurement stored at ``data``."""
    measurement = records.load(data)
    page = folder / "measurement.md"
    plots = [path for sample in DRAWN for path in plot.draw(measurement, sample, folder)]
    write_text(page, table.page(measurement))
    return [page, *plots]


def written(data: Path, folder: Path) -> list[Path]:
    """Pages and pictures of a stored measurement or study of integrators, or of all in a folder."""
    if data.is_dir():
        stored = {"measurement.json": report, "integrators.json": report_integrators}
        found = [(data / name, draw) for name, draw in stored.items() if (data / name).is_file()]
        if not found:
            raise ValueError(f"{data}: holds nothing measured; run `rodproof measure`")
        return [path for source, draw in found for path in draw(source, folder)]
    study = data.is_file() and '"references"' in data.read_text("utf-8")
    return report_integrators(data, folder) if study else report(data, folder)
