"""Train, reference and wheel speeds."""

from __future__ import annotations

from matplotlib.figure import Figure

from railgrip.report.plots.style import along, axle_lines, beside, figure, styled
from railgrip.report.view import View


def speeds(view: View, over: str = "time") -> Figure:
    """Draw train, reference and wheel speeds over ``time`` or ``distance``."""
    with styled():
        made = figure(view, f"Speeds over {over}")
        axes = made.add_subplot()
        x, label = along(view, over)
        axle_lines(axes, view, x, view.get("wheel_speed") * 3.6)
        if view.has_reference:
            reference = view.get("reference_speed") * 3.6
            axes.plot(x, reference, color="#555555", ls=(0, (4, 2)), lw=1.0, label="reference")
        axes.plot(x, view.get("train_speed") * 3.6, color="black", lw=1.8, label="train")
        axes.set(xlabel=label, ylabel="Speed, km/h")
        axes.set_ylim(bottom=0)
        axes.margins(x=0.01)
        beside(axes)
    return made
