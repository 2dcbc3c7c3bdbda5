"""The front of error against time, one panel a function, drawn from a stored measurement."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rodproof.codegen.files import write_bytes
from rodproof.codegen.measure.records import FUNCTIONS, Measurement

#: Errors outside are drawn on the edge: below lies what a double cannot show, above no number.
LEAST, MOST = 1e-3, 1e17
NO_NUMBER = 1e18

STYLES: dict[str, tuple[str, str]] = {
    "stable float64": ("#c1272d", "o"),
    "stable float32": ("#e8927c", "o"),
    "textbook": ("#0b6e99", "s"),
    "lambdify": ("#8a8a8a", "^"),
    "lambdify cse": ("#4a4a4a", "v"),
    "mpmath 15": ("#b8a3d0", "D"),
    "mpmath 30": ("#8e6bb5", "D"),
    "mpmath 50": ("#5b3a86", "D"),
}
SETTINGS: Any = {
    "svg.hashsalt": "rodproof",
    "font.size": 8.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


@dataclass(frozen=True)
class Mark:
    """A form on a panel: time per point, worst and median error in ulps of a double."""

    form: str
    time: float
    worst: float
    median: float


def draw(measurement: Measurement, sample: str, folder: Path) -> list[Path]:
    """Write ``front-SAMPLE.svg`` and ``.png``."""
    with matplotlib.rc_context(SETTINGS):
        figure = Figure(figsize=(10, 6.6), layout="constrained")
        grid = figure.subplots(2, 3, sharex=True, sharey=True)
        for panel, function in zip(grid.flat, FUNCTIONS, strict=True):
            _panel(panel, function, marks(measurement, function, sample))
        for panel in grid[1]:
            panel.set_xlabel("time per point, ns")
        handles, labels = grid[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
        figure.suptitle(_title(measurement, sample))
        figure.supylabel("error, ulps of a double: mark = worst, tick = median")
        return [
            _saved(figure, folder / f"front-{sample}.svg", {"Date": None}),
            _saved(figure, folder / f"front-{sample}.png", {"Software": None}),
        ]


def marks(measurement: Measurement, function: str, sample: str) -> list[Mark]:
    """What is known of each form, in the order of the styles."""
    found = []
    for form in STYLES:
        error = measurement.error(function, form, sample)
        time = measurement.time(function, form, measurement.settings.timed_points)
        if error and time:
            worst = NO_NUMBER if error.failures or error.worst is None else error.worst
            median = NO_NUMBER if error.median is None else error.median
            found.append(Mark(form, time.nanoseconds, worst, median))
    return found


def front(found: list[Mark]) -> list[Mark]:
    """The marks that no other beats in both time and worst error, fastest first."""
    best: list[Mark] = []
    for mark in sorted(found, key=lambda mark: (mark.time, mark.worst)):
        if not best or mark.worst < best[-1].worst:
            best.append(mark)
    return best


def _panel(panel: Axes, function: str, found: list[Mark]) -> None:
    panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, NO_NUMBER * 5), title=function)
    panel.set_yticks([10.0**k for k in range(-3, 16, 3)])
    panel.axhspan(MOST, NO_NUMBER * 5, color="#f4e3e1", lw=0)
    panel.axhline(1, color="#dddddd", lw=0.8, zorder=0)
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
    edge = front(found)
    panel.step(
        [m.time for m in edge],
        [_clip(m.worst) for m in edge],
        where="post",
        color="#cccccc",
        lw=1.2,
        zorder=1,
    )
    for mark in found:
        colour, marker = STYLES[mark.form]
        worst, median = _clip(mark.worst), _clip(mark.median)
        panel.plot([mark.time] * 2, [median, worst], color=colour, lw=1, alpha=0.6, zorder=2)
        panel.plot(mark.time, median, marker="_", color=colour, ms=7, zorder=2)
        panel.plot(
            mark.time,
            worst,
            marker=marker,
            color=colour,
            ms=6.5,
            ls="none",
            label=mark.form,
            zorder=3,
        )


def _clip(error: float) -> float:
    return max(error, LEAST) if error < NO_NUMBER else NO_NUMBER


def _title(measurement: Measurement, sample: str) -> str:
    machine, asked = measurement.machine, measurement.settings
    points = asked.batches * asked.points
    return (
        f"full_rod on {sample} inputs: error at {points} points, time on blocks of "
        f"{asked.timed_points}\n{machine.processor}, one thread, Python {machine.python}, "
        f"NumPy {machine.numpy}"
    )


def _saved(figure: Figure, path: Path, metadata: dict[str, None]) -> Path:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=path.suffix[1:], dpi=130, metadata=metadata)
    write_bytes(path, buffer.getvalue())
    return path
