"""Adhesion available, asked and used: three different things."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from railgrip.report.plots.style import MANY, PALETTE, band, beside, colours, figure, styled
from railgrip.report.view import Array, View

ASKED = "#555555"


def adhesion(view: View) -> Figure:
    """Draw for each axle what the rail could give, what the brake asked and what came of it."""
    with styled():
        if len(view.axles) > MANY:
            return _many(view)
        counts = [view.vehicle_of.count(k) for k in range(len(view.vehicles))]
        rows, columns = len(counts), max(counts)
        made = figure(view, "Adhesion available, asked and used", (9.5, 1.2 + 1.35 * rows))
        panels = made.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
        paint = colours(rows)
        top = _top(view)
        place = [0] * rows
        for k, vehicle in enumerate(view.vehicle_of):
            axes = panels[vehicle][place[vehicle]]
            place[vehicle] += 1
            _one(axes, view, k)
            axes.set_title(view.axles[k], color=paint[vehicle], fontsize=8)
            axes.set_ylim(0, top)
        for vehicle, used in enumerate(place):
            for axes in panels[vehicle][used:]:
                axes.set_visible(False)
        made.supxlabel("Time, s", fontsize=9)
        made.supylabel("Adhesion, force over wheel load (no unit)", fontsize=9)
        handles, labels = panels[0][0].get_legend_handles_labels()
        made.legend(handles, labels, loc="upper right", ncols=3)
    return made


def _one(axes: Axes, view: View, k: int) -> None:
    available = view.get("adhesion_available")[k]
    axes.fill_between(view.time, 0, available, color=PALETTE[0], alpha=0.18, lw=0)
    axes.plot(view.time, available, color=PALETTE[0], lw=0.9, label="available")
    if view.has("adhesion_asked"):
        asked = view.get("adhesion_asked")[k]
        axes.plot(view.time, asked, color=ASKED, ls=":", lw=1.0, label="asked")
    used = view.get("adhesion_used")[k]
    axes.plot(view.time, np.abs(used), color=PALETTE[1], lw=0.8, label="used")


def _top(view: View) -> float:
    """Upper end of the axis: dry rail may not dwarf the slide."""
    most = [0.0, float(np.nanmax(np.abs(view.get("adhesion_used")), initial=0.0))]
    if view.has("adhesion_asked"):
        most.append(float(np.nanmax(view.get("adhesion_asked"), initial=0.0)))
    available: Array = view.get("adhesion_available")
    greatest = float(np.nanmax(available, initial=0.0))
    return max(0.02, 1.1 * max(*most, min(greatest, 1.6 * max(most))))


def _many(view: View) -> Figure:
    made = figure(view, "Adhesion available and used", (9.5, 6.0))
    upper, lower = made.subplots(2, 1, sharex=True)
    band(upper, view.time, view.get("adhesion_available"), PALETTE[0], "available")
    band(upper, view.time, np.abs(view.get("adhesion_used")), PALETTE[1], "used")
    upper.set(ylabel="Adhesion, no unit", title="All axles", ylim=(0, _top(view)))
    beside(upper)
    worst = view.worst_axle
    _one(lower, view, worst)
    title = f"Worst axle, {view.axles[worst]}"
    lower.set(xlabel="Time, s", ylabel="Adhesion, no unit", title=title, ylim=(0, _top(view)))
    beside(lower)
    return made
