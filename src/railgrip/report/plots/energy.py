"""Where the kinetic energy went, as bars."""

from __future__ import annotations

from matplotlib.figure import Figure

from railgrip.report.energy import energy_table
from railgrip.report.plots.style import PALETTE, figure, styled
from railgrip.report.view import View


def energy(view: View) -> Figure:
    """Draw each term of the energy balance with its share of the initial kinetic energy."""
    rows = [row for row in energy_table(view.dataset, view.run) if row.name != "unexplained"]
    initial = view.number("energy_kinetic_initial")
    with styled():
        made = figure(view, f"Energy balance: {initial / 1e6:.1f} MJ at the start", (9.0, 3.6))
        axes = made.add_subplot()
        names = [row.label for row in rows]
        drawn = axes.barh(names, [row.energy / 1e6 for row in rows], color=PALETTE[0], height=0.6)
        shares = [f" {row.energy / 1e6:.2f} MJ ({row.share * 100:.1f} %)" for row in rows]
        axes.bar_label(drawn, shares, fontsize=8)
        axes.margins(x=0.22)
        axes.invert_yaxis()
        axes.grid(visible=False, axis="y")
        axes.set(xlabel="Energy taken from the train, MJ")
        error = view.number("energy_balance")
        if error == error:
            axes.set_title(f"Balance error {error:.1e} of the initial energy", fontsize=8)
    return made
