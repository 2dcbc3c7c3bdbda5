"""Curves: the bifurcation under thrust, the Poynting effect under a couple, DNA under tension."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rodproof.generated.equilibria import states
from rodproof.generated.scenes import dsdna

RED, BLUE, GREY = "#c1272d", "#0b6e99", "#8a8a8a"
#: A rod that shears under a thrust; lengths and forces in units of beta and gamma.
SOFT = {"alpha": 0.8, "beta": 1.0, "zeta": 0.55, "eta": 1.4, "iota": -0.4, "gamma": 1.0}
#: A rod of either chirality.
PLAIN = {"alpha": 0.8, "beta": 1.0, "zeta": 0.9, "eta": 1.0, "gamma": 1.0}


def shades(count: int) -> list[Any]:
    """Colours from light to dark."""
    return [colormaps["viridis_r"](x) for x in np.linspace(0.12, 0.95, count)]


def bifurcation() -> Figure:
    """theta against N for several p: the straight states, and the sheared ones beyond a mark."""
    figure = Figure(figsize=(7.4, 4.2), layout="constrained")
    panel = figure.subplots()
    powers = (0.5, 0.7, 1, 2, 50)
    rods = [states.Constants(**SOFT, p=p) for p in powers]
    first = min(states.threshold(c) for c in rods)
    most = 5.0
    panel.plot([0, first], [0, 0], color="black", lw=1.6)
    panel.plot([first, most], [0, 0], color="black", lw=1.2, ls=(0, (4, 3)))
    for c, p, colour in zip(rods, powers, shades(len(powers)), strict=True):
        start = states.threshold(c)
        thrust = start * (1 + np.geomspace(1e-9, max(most / start - 1, 1e-3), 600))
        angle = np.degrees(states.sheared_angle(thrust, c))
        for sign in (1, -1):
            panel.plot(
                [start, *thrust], [0, *(sign * angle)], color=colour, lw=1.7,
                label=f"$p = {p:g}$" if sign == 1 else None,
            )  # fmt: skip
        panel.plot(start, 0, "o", color=colour, ms=6, mec="white", zorder=5)
    last = np.degrees(states.limiting_angle(rods[0]))
    for sign in (1, -1):
        panel.axhline(sign * last, color=GREY, lw=0.8, ls=":")
    panel.text(0.05, last + 1.5, f"limit for every $p$: {last:.1f}°", color=GREY, va="bottom")
    panel.text(most, -8, "straight: not the lowest energy", ha="right", fontsize=8, color="#444444")
    panel.set(
        xlim=(0, most), ylim=(-75, 75), xlabel=r"thrust $N/\gamma$ (tension)",
        ylabel=r"angle $\theta$ of the section's normal and the force, degrees",
        title="Pulled hard enough, the straight rod shears",
    )  # fmt: skip
    panel.set_yticks(range(-60, 61, 20))
    panel.legend(loc="upper left", bbox_to_anchor=(1, 0.9), handlelength=1.4, reverse=True)
    return figure


def poynting() -> Figure:
    """Length and twist against the couple, for both chiralities and none."""
    figure = Figure(figsize=(8.6, 3.7), layout="constrained")
    length, twist = figure.subplots(1, 2)
    couple = np.linspace(-6, 6, 601)
    for iota, colour, name in (
        (0.5, BLUE, r"$\iota = +0.5$"), (0.0, GREY, r"$\iota = 0$"), (-0.5, RED, r"$\iota = -0.5$"),
    ):  # fmt: skip
        c = states.Constants(**PLAIN, iota=iota, p=3.0)
        twisted = states.twisted(couple, c)
        length.plot(couple, twisted.along, color=colour, lw=1.8, label=name)
        twist.plot(couple, twisted.u[2], color=colour, lw=1.8, label=name)
        gap = c.beta**2 * c.eta**2 - iota**2
        slope = -iota / (gap * c.gamma)
        near = np.array([-1.1, 1.1])
        length.plot(near, 1 + slope * near, color=colour, lw=0.8, ls="--")
        twist.plot(near, c.eta**2 / (gap * c.gamma) * near, color=colour, lw=0.8, ls="--")
    length.set(
        xlabel=r"couple $M/(\gamma\beta)$", ylabel="length over length at rest",
        title="Poynting effect: a couple changes the length",
    )  # fmt: skip
    twist.set(
        xlabel=r"couple $M/(\gamma\beta)$", ylabel=r"twist $\beta\,u_3$",
        title="The twist has a limit too", ylim=(-1.5, 1.5),
    )  # fmt: skip
    length.legend(loc="center left", bbox_to_anchor=(0, 0.66), handlelength=1.4)
    twist.text(1.4, -0.9, "dashed: the linear rod", color="#444444", fontsize=8)
    twist.text(2.4, 1.22, r"$\iota = \pm 0.5$", color=RED)
    twist.text(2.4, 0.8, r"$\iota = 0$", color=GREY)
    for panel in (length, twist):
        _cross(panel)
    return figure


def _cross(panel: Axes) -> None:
    panel.axvline(0, color="#dddddd", lw=0.8, zorder=0)
    panel.axhline(1 if panel.get_ylim()[0] > 0 else 0, color="#dddddd", lw=0.8, zorder=0)


def dna() -> Figure:
    """Extension and overwinding of dsDNA; the moduli are measured, gamma and p are free."""
    figure = Figure(figsize=(8.6, 3.7), layout="constrained")
    extension, winding = figure.subplots(1, 2)
    force = np.linspace(0, 150, 301)
    for gamma, colour in zip((10.0, 30.0, 100.0), shades(3), strict=True):
        for p, style, width in ((2.0, "-", 1.8), (10.0, (0, (1, 1)), 1.3)):
            if (gamma, p) == (100.0, 10.0):
                continue  # the linear rod, to the eye
            c = dsdna.Constants.of_moduli(gamma=gamma, p=p)
            u, v3 = dsdna.strains(np.zeros((3, 1)), force, c)
            name = rf"$\gamma = {gamma:g}$ pN, $p = {p:g}$"
            extension.plot(force, 100 * (v3 - 1), color=colour, ls=style, lw=width, label=name)
            winding.plot(force, np.degrees(u[2]), color=colour, ls=style, lw=width)
    c = dsdna.Constants.of_moduli(gamma=1e9, p=2.0)  # within these forces the linear rod
    u, v3 = dsdna.strains(np.zeros((3, 1)), force, c)
    extension.plot(force, 100 * (v3 - 1), color="black", lw=0.8, ls="--", label="linear rod")
    winding.plot(force, np.degrees(u[2]), color="black", lw=0.8, ls="--")
    for panel in (extension, winding):
        panel.axvspan(65, 150, color="#f3f0ea", lw=0, zorder=0)
        panel.set(xlabel="force, pN", xlim=(0, 150), ylim=(0, None))
    extension.text(67, 0.4, "overstretching, not in this model", fontsize=7.5, color="#8a7f6a")
    extension.set(ylabel="extension, %", title="dsDNA stretches")
    winding.set(ylabel="twist beyond rest, degrees a nm", title="and overwinds, as $\\iota < 0$")
    extension.legend(loc="upper left", fontsize=7.5, handlelength=1.8)
    return figure
