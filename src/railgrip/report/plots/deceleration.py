"""Deceleration of the train."""

from __future__ import annotations

from matplotlib.figure import Figure

from railgrip.report.plots.style import PALETTE, beside, figure, styled
from railgrip.report.view import View


def deceleration(view: View) -> Figure:
    """Draw the train's deceleration, its mean and the driver's demand."""
    with styled():
        made = figure(view, "Deceleration")
        axes = made.add_subplot()
        values = -view.get("acceleration")
        axes.plot(view.time, values, color="black", lw=1.2, label="train")
        mean = view.number("mean_deceleration")
        if mean == mean:
            axes.axhline(mean, color=PALETTE[0], ls="--", lw=1.0, label=f"mean {mean:.2f} m/s²")
        if view.has("brake_demand"):
            low, high = axes.get_ylim()
            share = view.get("brake_demand")
            axes.fill_between(
                view.time,
                0,
                share,
                transform=axes.get_xaxis_transform(),
                color="#999999",
                alpha=0.12,
                lw=0,
                step="post",
                label="demand\n(full height: full)",
            )
            axes.set_ylim(min(low, 0.0), high)
        axes.set(xlabel="Time, s", ylabel="Deceleration, m/s²")
        axes.margins(x=0.01)
        beside(axes)
    return made
