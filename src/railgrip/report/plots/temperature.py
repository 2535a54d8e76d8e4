"""Temperatures of the brake discs or treads."""

from __future__ import annotations

from matplotlib.figure import Figure

from railgrip.report.plots.style import MANY, axle_lines, beside, colours, figure, styled
from railgrip.report.view import View


def temperature(view: View) -> Figure:
    """Draw ring (or tread) temperatures, and the hubs' as dotted lines."""
    with styled():
        made = figure(view, "Brake disc (or tread) temperatures; dotted: hub")
        axes = made.add_subplot()
        axle_lines(axes, view, view.time, view.get("disc_temperature"))
        if view.has("hub_temperature") and len(view.axles) <= MANY:
            paint = colours(len(view.vehicles))
            for k, hub in enumerate(view.get("hub_temperature")):
                axes.plot(view.time, hub, color=paint[view.vehicle_of[k]], ls=":", lw=0.8)
        axes.set(xlabel="Time, s", ylabel="Temperature, °C")
        axes.margins(x=0.01)
        beside(axes)
    return made
