"""Slip of each axle against the thresholds of its controller."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from railgrip.report.plots.style import (
    LINES,
    MANY,
    PALETTE,
    axle_lines,
    beside,
    colours,
    figure,
    styled,
    vehicle_panels,
)
from railgrip.report.thresholds import thresholds
from railgrip.report.view import Array, View


def slip(view: View, given: Mapping[str, float] | None = None) -> Figure:
    """Draw the slip of each axle, vehicle by vehicle, with the thresholds as grey lines."""
    values = view.slip * 100
    top = max(10.0, 1.08 * float(np.nanmax(values, initial=0.0)))
    limits = thresholds(view, given)
    words = "Slip, (reference − wheel)/reference speed"
    if not view.has_reference:
        words = "Slip, (train − wheel)/train speed"
    with styled():
        if len(view.axles) > MANY:
            return _many(view, values, limits, words, top)
        made, panels = vehicle_panels(view, words)
        paint = colours(len(view.vehicles))
        for vehicle, (axes,) in enumerate(panels):
            mine = [k for k, owner in enumerate(view.vehicle_of) if owner == vehicle]
            for place, k in enumerate(mine):
                colour = PALETTE[place % len(PALETTE)]
                axes.plot(view.time, values[k], color=colour, lw=0.9, label=view.axles[k])
            drawn = _thresholds(axes, view, limits)
            axes.set_title(view.vehicles[vehicle], color=paint[vehicle], weight="bold")
            axes.set(xlabel="Time, s", ylabel="Slip, %")
            axes.set_ylim(min(-2.0, float(np.nanmin(values, initial=0.0))), top)
            beside(axes, handles=[line for line in axes.lines if line not in drawn])
        if limits:
            made.legend(handles=drawn, loc="upper right", ncols=3)
    return made


def _many(view: View, values: Array, limits: Mapping[str, Array], words: str, top: float) -> Figure:
    made = figure(view, words)
    axes = made.add_subplot()
    axle_lines(axes, view, view.time, values)
    _thresholds(axes, view, limits)
    axes.set(xlabel="Time, s", ylabel="Slip, %", ylim=(-2.0, top))
    beside(axes)
    return made


def _thresholds(axes: Axes, view: View, limits: Mapping[str, Array]) -> list[Line2D]:
    drawn = []
    for k, (name, curve) in enumerate(limits.items()):
        style = LINES[1:][k % 3]
        drawn += axes.plot(view.time, curve * 100, color="#555555", ls=style, lw=1.0, label=name)
    return drawn
