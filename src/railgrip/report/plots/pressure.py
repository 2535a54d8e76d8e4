"""Cylinder pressure, and under it what the dump valves did."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from railgrip.report.plots.style import (
    MANY,
    PALETTE,
    VALVE_COLOURS,
    axle_lines,
    beside,
    colours,
    figure,
    styled,
    vehicle_panels,
)
from railgrip.report.view import Array, View


def pressure(view: View) -> Figure:
    """Draw the cylinder pressures with the dump-valve states as coloured strips."""
    bar = view.get("brake_cylinder_pressure") / 1e5
    valves = view.get("dump_valve") if view.has("dump_valve") else np.zeros_like(bar)
    words = "Brake cylinder pressure and dump valves"
    with styled():
        if len(view.axles) > MANY:
            return _many(view, bar, valves, words)
        made, panels = vehicle_panels(view, words, (3.0, 1.0), 3.0)
        paint = colours(len(view.vehicles))
        for vehicle, (upper, lower) in enumerate(panels):
            mine = [k for k, owner in enumerate(view.vehicle_of) if owner == vehicle]
            for place, k in enumerate(mine):
                colour = PALETTE[place % len(PALETTE)]
                upper.plot(view.time, bar[k], color=colour, lw=0.9, label=view.axles[k])
            upper.set_title(view.vehicles[vehicle], color=paint[vehicle], weight="bold")
            upper.set(ylabel="Pressure, bar", ylim=(0, 1.08 * max(0.1, float(np.nanmax(bar)))))
            upper.tick_params(labelbottom=False)
            beside(upper)
            strips(lower, view, valves, mine)
            lower.set(xlabel="Time, s")
        _key(made)
    return made


def strips(axes: Axes, view: View, valves: Array, axles: list[int]) -> None:
    """Draw one coloured strip per axle: FILL, HOLD, VENT."""
    end = float(view.time[-1]) if len(view.time) else 1.0
    axes.imshow(
        valves[axles],
        aspect="auto",
        interpolation="nearest",
        extent=(0.0, end, len(axles), 0),
        cmap=ListedColormap(list(VALVE_COLOURS.values())),
        norm=BoundaryNorm([-0.5, 0.5, 1.5, 2.5], 3),
    )
    if len(axles) <= 8:
        axes.set_yticks(np.arange(len(axles)) + 0.5, [view.places[k] for k in axles])
    axes.tick_params(axis="y", labelsize=6.5, length=0)
    axes.grid(visible=False)


def _many(view: View, bar: Array, valves: Array, words: str) -> Figure:
    made = figure(view, words, (9.5, 7.0))
    upper, lower = made.subplots(2, 1, sharex=True, height_ratios=[2, 3])
    axle_lines(upper, view, view.time, bar)
    upper.set(ylabel="Pressure, bar")
    upper.set_ylim(bottom=0)
    beside(upper)
    strips(lower, view, valves, list(range(len(view.axles))))
    lower.set(xlabel="Time, s", ylabel="Axle, counted from the front")
    _key(made)
    return made


def _key(made: Figure) -> None:
    handles = [Patch(color=colour, label=name) for name, colour in VALVE_COLOURS.items()]
    made.legend(handles=handles, loc="upper right", ncols=3, title="Dump valve")
