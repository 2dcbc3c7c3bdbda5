"""The maps of the stability atlas as pictures: a scene a picture, a function a row.

Side by side stand the textbook's form and ours on each map. The classes go from pale to dark, so
that they are told apart without colours too.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from rodproof.codegen.files import write_bytes
from rodproof.codegen.measure.atlas import NO_NUMBER, NOTHING, Atlas, Chart, Mark
from rodproof.codegen.measure.spots import MAPS

#: Upper ends in ulps beyond what is inherent, and what a reader is told; then what is no number.
ENDS = (8.0, 1e3, 1e6, 1e12)
CLASSES = (
    ("right: at most 8 ulps", "#e3eef9"),
    ("up to 1e3", "#fbd98b"),
    ("up to 1e6", "#f39c4a"),
    ("up to 1e12", "#d1495b"),
    ("no digit left", "#7b1e5b"),
    ("nan, infinity or no answer", "#17111f"),
    ("refused, as it should be", "#9aa5a8"),
    ("no number could hold it", "#ffffff"),
)
WRONG_NUMBER, REFUSAL, EMPTY = 5, 6, 7
SETTINGS: Any = {"font.size": 7.5, "axes.titlesize": 8, "axes.linewidth": 0.5}


def draw(atlas: Atlas, scene: str, folder: Path) -> list[Path]:
    """Write ``atlas-SCENE.png``."""
    charts = [chart for chart in atlas.charts if chart.scene == scene]
    functions = list(dict.fromkeys(chart.function for chart in charts))
    with matplotlib.rc_context(SETTINGS):
        figure = Figure(figsize=(13.5, 1.1 + 1.75 * len(functions)), layout="constrained")
        grid = figure.subplots(len(functions), 2 * len(MAPS), squeeze=False)
        for row, function in zip(grid, functions, strict=True):
            for k, name in enumerate(MAPS):
                (chart,) = (c for c in charts if (c.function, c.chart) == (function, name))
                _panel(row[2 * k], chart, chart.textbook, "textbook")
                _panel(row[2 * k + 1], chart, chart.ours, "generated")
                row[2 * k].set_ylabel(chart.up)
                row[2 * k + 1].set_yticklabels([])
            row[0].annotate(
                function,
                (-0.62, 0.5),
                xycoords="axes fraction",
                rotation=90,
                ha="center",
                va="center",
                fontsize=10,
                fontweight="bold",
            )
        handles = [
            Patch(facecolor=colour, edgecolor="#888888", lw=0.5, label=words)
            for words, colour in CLASSES
        ]
        figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
        figure.suptitle(f"{scene}: error beyond what is inherent, in doubles", fontsize=12)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=100, metadata={"Software": None})
    return [_written(folder / f"atlas-{scene}.png", buffer.getvalue())]


def _panel(panel: Axes, chart: Chart, marks: Sequence[Sequence[Mark]], title: str) -> None:
    kinds = np.array([[_class(mark) for mark in row] for row in marks])
    colours = ListedColormap([colour for _, colour in CLASSES])
    panel.pcolormesh(kinds, cmap=colours, vmin=-0.5, vmax=len(CLASSES) - 0.5)
    panel.set_title(title)
    panel.set_xlabel(chart.across, labelpad=1)
    for axis, labels in ((panel.xaxis, chart.columns), (panel.yaxis, chart.rows)):
        step = max(1, -(-len(labels) // 6))
        shown = sorted({*range(0, len(labels) - step // 2, step), len(labels) - 1})
        axis.set_ticks([k + 0.5 for k in shown], [labels[k] for k in shown])
        axis.set_tick_params(length=2, pad=1, labelsize=6.5)
    panel.tick_params(axis="x", rotation=60)


def _class(mark: Mark) -> int:
    if isinstance(mark, float | int):
        return sum(mark > end for end in ENDS)
    return {NOTHING: EMPTY, NO_NUMBER: WRONG_NUMBER}.get(mark, REFUSAL)


def _written(path: Path, data: bytes) -> Path:
    write_bytes(path, data)
    return path
