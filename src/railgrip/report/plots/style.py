"""How every figure looks: colours that colour-blind readers tell apart, legends beside the data."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager
from typing import Any

import numpy as np
from matplotlib import colormaps, rc_context
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from railgrip.report.view import Array, View

PALETTE = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito (2008), Color Universal Design; black is kept for the train, yellow left out."""

VALVE_COLOURS = {"FILL": "#DDE6EC", "HOLD": "#E69F00", "VENT": "#B2182B"}
MANY = 24
"""Above this number of axles, the range over all of them is drawn instead of each."""

LINES = ("-", "--", "-.", ":")
STYLE = {
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "grid.color": "#E3E3E3",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.1,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "figure.constrained_layout.use": True,
    "figure.titlesize": 11.0,
    "savefig.dpi": 150,
    "svg.hashsalt": "railgrip",
    "path.simplify_threshold": 0.3,
}


def styled() -> AbstractContextManager[None]:
    """Return a context in which figures are made and saved, leaving the user's settings alone."""
    # a plain dict is what the function takes; its stub asks for the type of each key
    return rc_context(rc=STYLE)  # type: ignore[arg-type]


def colours(count: int) -> list[str]:
    """Return one colour for each of `count` vehicles, a scale where the palette is too short."""
    if count <= len(PALETTE):
        return list(PALETTE[:count])
    scale = colormaps["viridis"]
    return [to_hex(scale(x)) for x in np.linspace(0.0, 0.9, count)]


def figure(view: View, words: str, size: tuple[float, float] = (9.0, 4.6)) -> Figure:
    """Return an empty figure with the run's title."""
    made = Figure(figsize=size)
    made.suptitle(f"{words}\n", x=0.01, ha="left", weight="bold")
    below = 1.0 - 0.27 / size[1]  # the second line of the heading, which the layout keeps free
    made.text(0.01, below, view.title, ha="left", va="top", fontsize=8.5, color="#555555")
    return made


def beside(axes: Axes, **more: Any) -> None:
    """Put the legend to the right of the data."""
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, **more)


def along(view: View, over: str) -> tuple[Array, str]:
    """Return the x values and their label: over ``time`` or ``distance``."""
    if over == "distance":
        return view.distance, "Distance from the start, m"
    return view.time, "Time, s"


def axle_lines(axes: Axes, view: View, x: Array, values: Array, **more: Any) -> None:
    """Draw one line per axle in its vehicle's colour, or the range and the worst of many."""
    if len(view.axles) > MANY:
        band(axes, x, values)
        worst = view.worst_axle
        label = f"worst axle {view.axles[worst]}"
        axes.plot(x, values[worst], color=PALETTE[1], label=label, **more)
        return
    paint = colours(len(view.vehicles))
    seen: set[int] = set()
    for k, vehicle in enumerate(view.vehicle_of):
        label = "" if vehicle in seen else f"axles of {view.vehicles[vehicle]}"
        seen.add(vehicle)
        axes.plot(x, values[k], color=paint[vehicle], lw=0.8, alpha=0.9, label=label, **more)


def band(axes: Axes, x: Array, values: Array, colour: str = PALETTE[0], words: str = "") -> None:
    """Draw the range over all axles and their middle one."""
    filled = np.where(np.isfinite(values), values, np.nan)
    known = np.isfinite(filled).any(axis=0)
    x, filled = x[known], filled[:, known]
    low, high = np.nanmin(filled, axis=0), np.nanmax(filled, axis=0)
    name = words or f"all {len(values)} axles"
    axes.fill_between(x, low, high, color=colour, alpha=0.22, lw=0, label=f"{name}: least–greatest")
    axes.plot(x, np.nanmedian(filled, axis=0), color=colour, lw=1.0, label=f"{name}: median")


def vehicle_panels(
    view: View, words: str, rows_each: Sequence[float] = (1.0,), height: float = 2.4
) -> tuple[Figure, list[list[Axes]]]:
    """Return a figure with one column of panels for each vehicle, two vehicles a row."""
    count = len(view.vehicles)
    columns = 1 if count == 1 else 2
    rows = -(-count // columns)
    made = figure(view, words, (9.5, 0.9 + height * rows))
    grid = made.add_gridspec(rows, columns)
    panels: list[list[Axes]] = []
    first: Axes | None = None
    for k in range(count):
        inner = grid[k // columns, k % columns].subgridspec(
            len(rows_each), 1, height_ratios=list(rows_each), hspace=0.04
        )
        column: list[Axes] = []
        for row in range(len(rows_each)):
            share_y = panels[0][row] if panels and row == 0 else None  # strips have own labels
            axes = made.add_subplot(inner[row], sharex=first, sharey=share_y)
            first = first or axes
            column.append(axes)
        panels.append(column)
    return made, panels
