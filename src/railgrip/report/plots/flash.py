"""Flash temperature: how much hotter wheel and rail get in the contact."""

from __future__ import annotations

from matplotlib.figure import Figure

from railgrip.report.plots.style import axle_lines, beside, figure, styled
from railgrip.report.view import View


def flash(view: View) -> Figure:
    """Draw the flash temperature rise of every axle."""
    with styled():
        made = figure(view, "Flash temperature: rise of the surfaces in the contact")
        axes = made.add_subplot()
        axle_lines(axes, view, view.time, view.get("flash_temperature"))
        axes.set(xlabel="Time, s", ylabel="Rise, K")
        axes.set_ylim(bottom=0.0)
        axes.margins(x=0.01)
        beside(axes)
    return made
