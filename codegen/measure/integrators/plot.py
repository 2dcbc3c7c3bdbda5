"""Work and precision, one panel a rod; and calls against thrust, the two laws side by side."""

from __future__ import annotations

import io
from pathlib import Path

import matplotlib
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rodproof.codegen.files import write_bytes
from rodproof.codegen.measure.integrators.problems import Problem
from rodproof.codegen.measure.integrators.records import Study
from rodproof.codegen.measure.integrators.runs import DONE, EQUATIONS, METHODS, REFUSED
from rodproof.codegen.measure.plot import SETTINGS

COLOURS = dict(zip(METHODS, ("#0b6e99", "#c1272d", "#2e7d32", "#8e6bb5", "#8a8a8a"), strict=True))
MARKERS = dict(zip(METHODS, ("s", "o", "^", "D", "v"), strict=True))
#: Errors outside are drawn on the edge; above it a run without an answer.
LEAST, NO_ANSWER, TOP = 1e-16, 1e2, 1e3
LOST = "out of calls: x directors, + angles"
#: The tolerance at which the two laws are compared.
LAWS_AT = 1e-6


def draw(study: Study, folder: Path) -> list[Path]:
    """Write the figures of a study, each as SVG and PNG."""
    with matplotlib.rc_context(SETTINGS):
        made = {name: work_precision(study, title, rows) for name, title, rows in figures(study)}
        made["laws"] = laws(study)
        return [
            _saved(figure, folder / f"integrators-{name}{suffix}")
            for name, figure in made.items()
            for suffix in METADATA
        ]


#: What would make the bytes differ from one day or version to the next.
METADATA = {".svg": {"Date": None}, ".png": {"Software": None}}


def _saved(figure: Figure, path: Path) -> Path:
    buffer = io.BytesIO()
    figure.savefig(buffer, format=path.suffix[1:], dpi=110, metadata=METADATA[path.suffix])
    write_bytes(path, buffer.getvalue())
    return path


def figures(study: Study) -> list[tuple[str, str, list[list[Problem]]]]:
    """Name, title and rows of panels of each figure: start angles and powers, short and long."""
    found = []
    for length in sorted({rod.length for rod in study.problems}):
        limited = [rod for rod in study.problems if rod.length == length and not rod.linear]
        of_tilt = [rod for rod in limited if rod.p == 3]
        tilts = sorted({rod.tilt for rod in of_tilt}, reverse=True)
        rows = [_by_thrust([rod for rod in of_tilt if rod.tilt == tilt]) for tilt in tilts]
        found.append((f"start-{length:g}", f"length {length:g}, p = 3", rows))
        powers = sorted({rod.p for rod in limited})
        rows = [_by_thrust([r for r in limited if (r.p, r.tilt) == (p, 1)]) for p in powers]
        thrusts = {rod.thrust for row in rows if {rod.p for rod in row} != {3.0} for rod in row}
        rows = [[rod for rod in row if rod.thrust in thrusts] for row in rows]
        if len(rows) > 1:
            found.append((f"power-{length:g}", f"length {length:g}, start at theta = 1", rows))
    return found


def _by_thrust(rods: list[Problem]) -> list[Problem]:
    chosen = [rod for rod in rods if rod.thrust in (1e-3, 1.0, 1e3, 1e6)]
    return sorted(chosen, key=lambda rod: rod.thrust)


def work_precision(study: Study, title: str, rows: list[list[Problem]]) -> Figure:
    """A figure of panels: error at the far end against time."""
    thrusts = sorted({rod.thrust for row in rows for rod in row})
    height, width = len(rows), len(thrusts)
    size = (2.1 + 2.5 * width, 1.5 + 2.0 * height)
    figure = Figure(figsize=size, layout="constrained")
    grid = figure.subplots(height, width, sharex=True, sharey=True, squeeze=False)
    for axes, row in zip(grid, rows, strict=True):
        of_thrust = {rod.thrust: rod for rod in row}
        for panel, thrust in zip(axes, thrusts, strict=True):
            if thrust in of_thrust:
                _panel(panel, study, of_thrust[thrust])
            else:
                panel.set_visible(False)
    for panel in grid[-1]:
        panel.set_xlabel("time, ms")
    figure.supylabel("error at the far end")
    figure.suptitle(f"Work and precision: {title}; dashed and hollow: Euler angles")
    handles, labels = grid[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels), frameon=False)
    return figure


def _panel(panel: Axes, study: Study, rod: Problem) -> None:
    panel.set(xscale="log", yscale="log", ylim=(LEAST / 3, TOP))
    panel.set_title(f"N = {rod.thrust:g}, theta = {rod.tilt:g}, p = {rod.p:g}", fontsize=8)
    panel.set_yticks([10.0**k for k in range(-15, 1, 3)])
    panel.axhspan(NO_ANSWER / 10, TOP, color="#f4e3e1", lw=0)
    refused = False
    for equations in EQUATIONS:
        ours = equations == EQUATIONS[0]
        look = {"ls": "-" if ours else "--", "lw": 1.1, "ms": 3.6}
        for method in METHODS:
            runs = study.of(rod, equations, method)
            refused = refused or any(run.outcome == REFUSED for run in runs)
            done = [(r.seconds, r.error) for r in runs if r.outcome == DONE and r.seconds]
            points = [(1e3 * s, min(max(e, LEAST), 9.0)) for s, e in done if s and e is not None]
            face = COLOURS[method] if ours else "white"
            panel.plot(
                [x for x, _ in points], [y for _, y in points], color=COLOURS[method],
                marker=MARKERS[method], markerfacecolor=face,
                label=method if ours else None, **look,  # type: ignore[arg-type]
            )  # fmt: skip
            lost = [1e3 * r.seconds for r in runs if r.outcome not in (DONE, REFUSED) and r.seconds]
            panel.plot(
                lost, [NO_ANSWER] * len(lost), ls="none", marker="x" if ours else "+", ms=5,
                color=COLOURS[method],
            )  # fmt: skip
    panel.text(
        0.02, 0.965, "angles refuse theta = 0; x: out of calls" if refused else LOST,
        transform=panel.transAxes, ha="left", va="top", color="#a05050", fontsize=6.5,
    )  # fmt: skip


def laws(study: Study) -> Figure:
    """Calls against thrust at one tolerance, by directors, for rods of length 1 from theta = 1."""
    figure = Figure(figsize=(8.4, 3.9), layout="constrained")
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    tolerance = laws_tolerance(study)
    for panel, linear in zip(panels, (False, True), strict=True):
        rods = ladder(study, linear=linear)
        for method in METHODS:
            runs = [
                (rod.thrust, run)
                for rod in rods
                for run in study.of(rod, EQUATIONS[0], method)
                if run.tolerance == tolerance
            ]
            done = [(N, run.calls) for N, run in runs if run.outcome == DONE]
            panel.plot(
                [N for N, _ in done], [calls for _, calls in done], color=COLOURS[method],
                marker=MARKERS[method], ms=4.5, lw=1.2, label=method,
            )  # fmt: skip
            lost = [N for N, run in runs if run.outcome != DONE]
            budget = study.settings.budget
            panel.plot(lost, [budget] * len(lost), ls="none", marker="x", color=COLOURS[method])
        panel.axhline(study.settings.budget, color="#dddddd", lw=0.8, zorder=0)
        panel.set(xscale="log", yscale="log", xlabel="thrust N in units of gamma")
        panel.set_title("linear law" if linear else "strain-limiting law, p = 3")
    panels[0].set_ylabel(f"calls at tolerance {tolerance:g}")
    panels[0].legend(frameon=False, fontsize=7.5)
    figure.suptitle(
        "The linear rod costs ever more calls under thrust, the limited one does not (x: stalled)"
    )
    return figure


def ladder(study: Study, *, linear: bool) -> list[Problem]:
    """The rods of the two laws side by side, by thrust."""
    return sorted(
        (r for r in study.problems if (r.length, r.tilt, r.p, r.linear) == (1, 1, 3, linear)),
        key=lambda rod: rod.thrust,
    )


def laws_tolerance(study: Study) -> float:
    """The tolerance of the study that is nearest to the one wanted."""
    return min(study.settings.tolerances, key=lambda tol: abs(tol / LAWS_AT - 1))
