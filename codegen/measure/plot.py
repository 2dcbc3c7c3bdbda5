"""The fronts of error against time, a picture a scene and a panel a function, from stored data."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rodproof.codegen.files import write_bytes
from rodproof.codegen.measure.fronts import NO_NUMBER, Mark, front, marks
from rodproof.codegen.measure.records import Measurement

#: Errors outside are drawn on the edge: below lies what a double cannot show, above no number.
LEAST, MOST = 1e-3, 1e17
COLUMNS = 3
NAMES = 8  # in a row of the legend

STYLES: dict[str, tuple[str, str]] = {
    "stable float64": ("#c1272d", "o"),
    "stable float32": ("#e8927c", "o"),
    "textbook": ("#0b6e99", "s"),
    "lambdify": ("#8a8a8a", "^"),
    "lambdify cse": ("#4a4a4a", "v"),
    "mpmath 15": ("#b8a3d0", "D"),
    "mpmath 30": ("#8e6bb5", "D"),
    "mpmath 50": ("#5b3a86", "D"),
    "C": ("#2e7d32", "P"),
    "C exp/log": ("#7cb342", "P"),
    "stable numba": ("#c1272d", "*"),
    "numba cse": ("#1b998b", "X"),
    "numexpr": ("#a9825a", "<"),
    "jax": ("#d68910", ">"),
    "casadi": ("#7b5e3b", "p"),
    "symforce": ("#d15b9a", "h"),
}
SETTINGS: Any = {
    "svg.hashsalt": "rodproof",
    "svg.fonttype": "none",
    "font.family": ["DejaVu Sans", "sans-serif"],
    "font.size": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def draw(measurement: Measurement, scene: str, folder: Path) -> list[Path]:
    """Write ``front-SCENE.svg``."""
    functions = measurement.functions(scene)
    height = -(-len(functions) // COLUMNS)
    low = 0.67 + 0.18 * -(-len(measurement.forms) // NAMES)  # inches below the panels
    with matplotlib.rc_context(SETTINGS):
        tall = low + 0.65 + 2.9 * height
        figure = Figure(figsize=(10.5, tall))
        grid = figure.subplots(height, COLUMNS, sharex=True, sharey=True, squeeze=False)
        figure.subplots_adjust(
            left=0.08, right=0.99, bottom=low / tall, top=1 - 0.9 / tall, wspace=0.06, hspace=0.22
        )
        for panel in grid.flat[len(functions) :]:
            panel.set_visible(False)
        for panel, function in zip(grid.flat, functions, strict=False):
            _panel(
                panel,
                function,
                marks(measurement, scene, function, "ordinary"),
                marks(measurement, scene, function, "all"),
            )
        for panel in grid.flat[max(0, len(functions) - COLUMNS) : len(functions)]:
            panel.set_xlabel("time per point, ns")
            panel.tick_params(labelbottom=True)
        known: dict[str, Any] = {}
        for panel in grid.flat:
            handles, labels = panel.get_legend_handles_labels()
            known |= dict(zip(labels, handles, strict=True))
        names = [form for form in measurement.forms if form in known]
        figure.legend(
            [known[name] for name in names], names, loc="lower center", ncols=NAMES, frameon=False
        )
        figure.suptitle(_title(measurement, scene))
        figure.supylabel("worst error, ulps of a double")
        return [_saved(figure, folder / f"front-{scene}.svg")]


def _panel(panel: Axes, function: str, ordinary: list[Mark], every: list[Mark]) -> None:
    panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, NO_NUMBER * 5), title=function)
    panel.set_yticks([10.0**k for k in range(-3, 16, 3)])
    panel.axhspan(MOST, NO_NUMBER * 5, color="#f4e3e1", lw=0)
    panel.axhline(8, color="#dddddd", lw=0.8, zorder=0)
    panel.text(
        0.985,
        0.965,
        "nan, inf or refused",
        transform=panel.transAxes,
        ha="right",
        va="top",
        color="#a05050",
        fontsize=7,
    )
    for found, line in ((ordinary, ":"), (every, "-")):
        edge = front(found)
        panel.step(
            [m.time for m in edge],
            [_clip(m.worst) for m in edge],
            where="post",
            color="#bbbbbb",
            ls=line,
            lw=1.1,
            zorder=1,
        )
    for usual, worst in zip(ordinary, every, strict=True):
        colour, marker = STYLES[usual.form]
        ends = [_clip(usual.worst), _clip(worst.worst)]
        panel.plot([usual.time] * 2, ends, color=colour, lw=1, alpha=0.5, zorder=2)
        panel.plot(usual.time, _clip(usual.median), marker="_", color=colour, ms=6, zorder=2)
        panel.plot(usual.time, ends[0], marker, mfc="white", mec=colour, ms=5.5, zorder=3)
        panel.plot(
            worst.time, ends[1], marker, color=colour, ms=6.5, ls="none", label=usual.form, zorder=4
        )


def _clip(error: float) -> float:
    return max(error, LEAST) if error < NO_NUMBER else NO_NUMBER


def _title(measurement: Measurement, scene: str) -> str:
    machine, asked = measurement.machine, measurement.settings
    points = asked.batches * asked.points
    return (
        f"{scene}: filled marks are all inputs, beyond what is inherent; open ones ordinary inputs,"
        f" ticks their median\n{points} points of each kind, times on blocks of "
        f"{asked.timed_points}; {machine.processor}, one thread, NumPy {machine.numpy}"
    )


def _saved(figure: Figure, path: Path) -> Path:
    buffer = io.BytesIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None})
    write_bytes(path, buffer.getvalue())
    return path
