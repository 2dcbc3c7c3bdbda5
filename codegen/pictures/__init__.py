"""Pictures of what the rod does, drawn from the generated modules; the same bytes each time."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

from rodproof.codegen.files import write_bytes

SETTINGS: Any = {
    "svg.hashsalt": "rodproof",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
    "legend.frameon": False,
    "mathtext.fontset": "cm",
}


def draw(folder: Path) -> list[Path]:
    """Write every picture as SVG and PNG: states, bifurcation, poynting, dna."""
    from rodproof.codegen.pictures import curves, rods

    makers: dict[str, Callable[[], Figure]] = {
        "states": rods.states_figure,
        "bifurcation": curves.bifurcation,
        "poynting": curves.poynting,
        "dna": curves.dna,
    }
    written = []
    with matplotlib.rc_context(SETTINGS):
        for name, make in makers.items():
            figure = make()
            for ending, metadata in (("svg", {"Date": None}), ("png", {"Software": None})):
                buffer = io.BytesIO()
                figure.savefig(buffer, format=ending, dpi=150, metadata=metadata)
                written.append(folder / f"{name}.{ending}")
                write_bytes(written[-1], buffer.getvalue())
    return written
