"""The pictures show what the modules say, and are the same bytes each time."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg

from rodproof.codegen import pictures
from rodproof.codegen.pictures import curves, rods
from rodproof.generated.equilibria import states

NAMES = ("states", "bifurcation", "poynting", "dna")


def test_same_bytes_twice(tmp_path: Path) -> None:
    first, second = (
        {path.name: path.read_bytes() for path in pictures.draw(tmp_path / name)} for name in "ab"
    )
    assert first == second
    assert set(first) == {f"{name}.{ending}" for name in NAMES for ending in ("svg", "png")}


def test_branches_leave_at_their_thresholds() -> None:
    """Each marked point is a derived threshold, each curve starts there and is in balance."""
    (panel,) = curves.bifurcation().axes
    marks = [line.get_xdata()[0] for line in panel.lines if line.get_marker() == "o"]
    powers = [float(text.get_text().strip("$").split("=")[1]) for text in panel.legend_.texts]
    constants = [states.Constants(**curves.SOFT, p=p) for p in sorted(powers)]
    assert marks == [states.threshold(c) for c in constants]
    upper = [line for line in panel.lines if line.get_label().startswith("$p")]
    for line, c in zip(upper, constants, strict=True):
        thrust, angle = line.get_data()
        assert thrust[0] == states.threshold(c) and angle[0] == 0
        rise = np.diff(angle)
        assert (rise[:300] > 0).all() and (rise > -1e-13).all()
        assert 0.5 < angle[-1] / np.degrees(states.limiting_angle(c)) < 1 + 1e-12


def curved(panel: Axes) -> list[np.ndarray]:
    """The values of the curves; straight lines have two points."""
    return [line.get_ydata() for line in panel.lines if len(line.get_xdata()) > 2]


def test_chirality_decides_whether_a_couple_lengthens() -> None:
    length, twist = curves.poynting().axes
    right, none, left = curved(length)
    assert right[-1] < 1 < left[-1] and (none == 1).all()
    assert right == pytest.approx(left[::-1], rel=1e-15)
    assert all(np.abs(values).max() < 1.2 for values in curved(twist))


def test_tension_stretches_and_overwinds_dna() -> None:
    for panel in curves.dna().axes:
        for line in panel.lines:
            assert line.get_ydata()[0] == 0 and (np.diff(line.get_ydata()) > 0).all()


def test_every_state_is_drawn_with_its_sections() -> None:
    figure = rods.states_figure()
    FigureCanvasAgg(figure).draw()
    kinds = [text.get_text() for text in figure.texts if text.get_fontsize() == 11]
    assert kinds == list(rods.LOOKS)
    for panel, (_, count, _) in zip(figure.axes, rods.LOOKS.values(), strict=True):
        discs, *directors = panel.collections[:3]
        assert len(discs.get_paths()) == count
        assert [len(lines.get_segments()) for lines in directors] == [count, count]
