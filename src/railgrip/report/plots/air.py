"""Reservoir pressure and the air used."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from railgrip.report.plots.style import MANY, PALETTE, band, beside, colours, figure, styled
from railgrip.report.view import View


def air(view: View) -> Figure:
    """Draw the reservoirs' pressures, vehicle by vehicle."""
    bar = view.get("reservoir_pressure") / 1e5
    with styled():
        used = view.number("air_used") * 1e3
        amount = f", {used:.0f} Nl used" if used == used else ""
        made = figure(view, f"Brake reservoirs{amount}")
        axes = made.add_subplot()
        if len(bar) > MANY // 2:
            band(axes, view.time, bar, words=f"all {len(bar)} vehicles")
            lowest = int(np.argmin(bar[:, -1]))
            label = f"lowest, {view.vehicles[lowest]}"
            axes.plot(view.time, bar[lowest], color=PALETTE[1], label=label)
        else:
            for name, colour, line in zip(view.vehicles, colours(len(bar)), bar, strict=True):
                axes.plot(view.time, line, color=colour, label=name)
        axes.set(xlabel="Time, s", ylabel="Reservoir pressure, bar")
        low = float(np.nanmin(bar))
        axes.set_ylim(max(0.0, low - 0.5), float(np.nanmax(bar)) + 0.2)
        axes.margins(x=0.01)
        beside(axes)
    return made
