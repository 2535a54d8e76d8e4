"""The rail before and after the train."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from railgrip.report.plots.style import PALETTE, beside, figure, styled
from railgrip.report.view import View


def rail(view: View) -> Figure:
    """Draw the rail's friction before and after, the energy it received and the sand on it."""
    x = np.asarray(view.dataset["cell"].values, dtype=np.float64) - view.start
    sand = view.has("rail_sand") and bool((view.get("rail_sand") > 0).any())
    with styled():
        made = figure(view, "Rail condition along the line", (9.0, 6.4 if sand else 5.2))
        panels = made.subplots(3 if sand else 2, 1, sharex=True)
        friction, energy = panels[0], panels[1]
        before, after = view.get("rail_friction_before"), view.get("rail_friction_after")
        friction.fill_between(x, before, after, color=PALETTE[2], alpha=0.2, lw=0)
        friction.step(x, after, color=PALETTE[2], where="mid", label="after the train")
        friction.step(x, before, color="black", where="mid", lw=0.9, label="before the train")
        friction.set(ylabel="Rail friction, no unit")
        friction.set_ylim(bottom=0)
        energy.fill_between(
            x,
            0,
            view.get("rail_energy") / 1e3,
            color=PALETTE[1],
            alpha=0.7,
            lw=0,
            step="mid",
            label="received",
        )
        energy.set(ylabel="Friction energy, kJ/m")
        energy.set_ylim(bottom=0)
        if sand:
            panels[2].fill_between(
                x, 0, view.get("rail_sand") * 1e3, color=PALETTE[4], lw=0, step="mid", label="laid"
            )
            panels[2].set(ylabel="Sand, g/m")
        for axes in panels:
            axes.axvline(0.0, color="#999999", lw=0.8, ls=":")
            axes.axvline(view.distance[-1], color="#999999", lw=0.8, ls=":")
            beside(axes)
        ends = max(30.0, 0.03 * float(view.distance[-1]))
        panels[-1].set_xlim(max(x[0], -ends - _length(view)), view.distance[-1] + ends)
        panels[-1].set_xlabel("Distance from where the train's front started, m (dotted: to stop)")
    return made


def _length(view: View) -> float:
    """How far behind the front the rail received anything, m."""
    x = np.asarray(view.dataset["cell"].values, dtype=np.float64) - view.start
    touched = x[view.get("rail_energy") > 0]
    return max(0.0, -float(touched[0])) if len(touched) else 0.0
