"""The states in space: the center line, the sections across the third director, the directors."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d import Axes3D
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from rodproof.codegen.pictures.curves import SOFT
from rodproof.generated.equilibria import states

Array = np.ndarray[Any, np.dtype[Any]]
#: The radius of the discs over the extent of the center line, how many are drawn, how large.
LOOKS = {
    "straight": (0.1, 11, 0.98), "sheared": (0.1, 11, 0.98), "twisted": (0.1, 15, 0.98),
    "helix": (0.065, 22, 0.98), "circle": (0.07, 24, 0.68),
}  # fmt: skip
LINE, FIRST, SECOND, SECTION, LOAD = "#22313f", "#c1272d", "#0b6e99", "#d9dde2", "#444444"


def states_figure() -> Figure:
    """Straight, sheared, twisted, helical and circular, each with its load."""
    c = states.Constants(**SOFT, p=3.0)
    thrust = 2.0 * states.threshold(c)
    ring = states.circle(1.0, c)
    shown: list[tuple[states.State, float]] = [
        (states.straight(thrust, c), 4.0),
        (states.sheared(thrust, c), 4.0 * float(states.straight(thrust, c).along) / 2),
        (states.twisted(1.2, c), 5.0),
        (states.helix(1.0, 1.0, c), 13.0),
        (ring, 2 * np.pi / abs(float(ring.precession)) * 0.97),
    ]
    figure = Figure(figsize=(11, 4.2))
    for k, (state, length) in enumerate(shown):
        panel = figure.add_axes((0.2 * k - 0.07, -0.09, 0.34, 1.14), projection="3d")
        assert isinstance(panel, Axes3D)
        rod(panel, state, length)
        figure.text(0.2 * k + 0.1, 0.94, state.kind, ha="center", fontsize=11)
        figure.text(0.2 * k + 0.1, 0.03, said(state), ha="center", fontsize=8.5, color="#444444")
    return figure


def said(state: states.State) -> str:
    """The load, and the angle where it is not plain."""
    held = rf"$N = {float(state.thrust):.2f}\,\gamma$"
    if state.thrust == 0:
        held = rf"$M = {float(state.couple):.2f}\,\gamma\beta$"
    angle = np.degrees(float(state.theta))
    return held + (rf", $\theta = {angle:.0f}$°" if state.kind in ("sheared", "helix") else "")


def rod(panel: Axes3D, state: states.State, length: float) -> None:
    """One state: sections as discs, their first and second directors, the center line."""
    line = state.center_line(np.linspace(0, length, 400))
    extent = float(np.ptp(line, axis=1).max())
    thick, count, zoom = LOOKS[state.kind]
    size, reach = thick * extent, 0.3 * extent
    stations = np.linspace(0, length, count)
    places, frames = state.center_line(stations), state.directors(stations)
    turn = np.linspace(0, 2 * np.pi, 40)
    discs, first, second = [], [], []
    for place, frame in zip(places.T, np.moveaxis(frames, -1, 0), strict=True):
        edge = np.outer(np.cos(turn), frame[:, 0]) + np.outer(np.sin(turn), frame[:, 1])
        discs.append(place + size * edge)
        first.append([place, place + 1.7 * size * frame[:, 0]])
        second.append([place, place + 1.7 * size * frame[:, 1]])
    panel.add_collection3d(
        Poly3DCollection(discs, facecolor=SECTION, edgecolor="#8d97a3", linewidth=0.6, alpha=0.9)
    )
    panel.plot(*line, color=LINE, lw=2.0, zorder=6)
    panel.add_collection3d(Line3DCollection(first, colors=FIRST, linewidths=1.5, zorder=7))
    panel.add_collection3d(Line3DCollection(second, colors=SECOND, linewidths=1.5, zorder=7))
    _load(panel, line[:, -1], reach, state)
    for artist in (*panel.collections, *panel.lines):
        artist.set_clip_on(False)
    top = line[:, -1] + [0, 0, reach]
    _frame(panel, np.concatenate([*discs, line.T, top[None]]), zoom)


def _load(panel: Axes3D, tip: Array, reach: float, state: states.State) -> None:
    """The axis of the load at the end: one head for a force, two for a couple."""
    for part in (1.0,) if state.couple == 0 else (1.0, 0.72):
        panel.quiver(
            *tip, 0, 0, part * reach, color=LOAD, lw=1.5, arrow_length_ratio=0.22 / part, zorder=8
        )


def _frame(panel: Axes3D, points: Array, zoom: float) -> None:
    """Equal scales on all axes, no box, as large as goes."""
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = (low + high) / 2, 0.5 * np.maximum(high - low, 0.45 * (high - low).max())
    for axis, at, by in zip("xyz", middle, half, strict=True):
        getattr(panel, f"set_{axis}lim")(at - by, at + by)
    panel.set_box_aspect(tuple(half / half.max()), zoom=zoom)
    panel.view_init(elev=18, azim=-62)
    panel.patch.set_alpha(0)
    panel.set_axis_off()
