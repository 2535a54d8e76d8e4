"""The contact patch from above: pressure, traction, stick and slip, slip speed, heat."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from railgrip.laboratory.patch_map import PatchMap
from railgrip.report.plots.style import styled
from railgrip.report.view import Array

_STICK, _SLIP = "#9CC7E4", "#F2B8A0"
_ARROWS = 11


def map_figure(
    found: PatchMap, speed: float, rises: Array | None = None, *, title: str = ""
) -> Figure:
    """Draw maps of a patch, rolling to the right, all at one scale.

    Parameters
    ----------
    found : PatchMap
        From `railgrip.laboratory.patch_map`.
    speed : float
        Speed of the train [m/s].
    rises : ndarray, optional
        Flash rise of the wheel's surface, from `railgrip.laboratory.patch_temperature` [K].
    title : str
        Second line of the heading.

    Returns
    -------
    matplotlib.figure.Figure
        Pressure; traction; stick and slip; slip speed; friction heat; flash rise, if given.
    """
    slip_speed = speed * np.hypot(found.slip_x, found.slip_y)
    # FASTSIM's slip has no bound at the trailing edge: a few cells must not take all the colours
    some = slip_speed[found.is_slipping]
    most = 3.0 * float(np.median(some)) if some.size else math.inf
    traction = 1e-6 * np.hypot(found.traction_x, found.traction_y)
    with styled():
        made = Figure(figsize=(12.0, 6.6))
        made.suptitle("The contact patch from above\n", x=0.01, ha="left", weight="bold")
        made.text(0.01, 1 - 0.27 / 6.6, title, ha="left", va="top", fontsize=8.5, color="#555555")
        panels: Any = made.subplots(2, 3, sharex=True, sharey=True)
        _field(panels[0, 0], found, 1e-6 * found.pressure, "Pressure, MPa", "cividis")
        _field(panels[0, 1], found, traction, "Traction, MPa", "cividis")
        _zones(panels[0, 2], found)
        _field(panels[1, 0], found, slip_speed, "Slip speed, m/s", "viridis", most)
        _field(panels[1, 1], found, 1e-6 * found.heat_flux, "Friction heat, MW/m²", "inferno")
        if rises is None:
            panels[1, 2].set_title("No map of the flash rise: a surface is too slow")
        else:
            _field(panels[1, 2], found, rises, "Flash rise of the wheel's surface, K", "inferno")
        for axes in panels.flat:
            axes.set_aspect("equal")
            axes.grid(False)
        for axes in panels[1]:
            axes.set_xlabel("Along the track, mm (rolling →)")
        for axes in panels[:, 0]:
            axes.set_ylabel("Across the track, mm")
    return made


def _field(
    axes: Axes,
    found: PatchMap,
    values: Array,
    words: str,
    colours: str,
    most: float = math.inf,
) -> None:
    shown = np.ma.masked_where(~found.is_inside, values)
    top = float(min(shown.max(), most)) or 1.0
    drawn = axes.pcolormesh(
        *_corners(found), shown, cmap=colours, vmin=0.0, vmax=top, rasterized=True
    )
    axes.set_title(words)
    axes.figure.colorbar(drawn, ax=axes, shrink=0.85, extend="max" if shown.max() > top else None)


def _zones(axes: Axes, found: PatchMap) -> None:
    zones = np.ma.masked_where(~found.is_inside, found.is_slipping)
    colours = ListedColormap([_STICK, _SLIP])
    axes.pcolormesh(*_corners(found), zones, cmap=colours, vmin=0, vmax=1, rasterized=True)
    some = _spread(found)
    x, y, along, across = (
        array.ravel()[some] for array in (found.x, found.y, found.traction_x, found.traction_y)
    )
    longest = float(np.hypot(along, across).max()) or 1.0
    axes.quiver(1e3 * x, 1e3 * y, along / longest, across / longest, scale=14, width=0.005)
    area = _areas(found)
    share = float(area[found.is_slipping].sum() / area[found.is_inside].sum())
    axes.set_title(f"Traction on the wheel; {100 * share:.0f} % of the patch slips")
    patches = [Patch(color=_STICK, label="stick"), Patch(color=_SLIP, label="slip")]
    axes.legend(handles=patches, loc="upper right", bbox_to_anchor=(1.02, 1.02), handlelength=1.0)


def _corners(found: PatchMap) -> tuple[Array, Array]:
    """Corners of the cells [mm], halfway between their centres."""
    padded = [np.pad(1e3 * c, 1, mode="reflect", reflect_type="odd") for c in (found.x, found.y)]
    x, y = (0.25 * (p[:-1, :-1] + p[1:, :-1] + p[:-1, 1:] + p[1:, 1:]) for p in padded)
    return x, y


def _areas(found: PatchMap) -> Array:
    """Areas of the cells, by their diagonals: FASTSIM's are narrow at the edges."""
    x, y = _corners(found)
    return 0.5 * np.abs(
        (x[1:, 1:] - x[:-1, :-1]) * (y[1:, :-1] - y[:-1, 1:])
        - (x[1:, :-1] - x[:-1, 1:]) * (y[1:, 1:] - y[:-1, :-1])
    )


def _spread(found: PatchMap) -> list[int]:
    """Cells for arrows: those nearest to the points of an even grid over the patch."""
    x, y = (np.where(found.is_inside, c, np.inf).ravel() for c in (found.x, found.y))
    reach = [float(np.max(np.abs(c[np.isfinite(c)]))) for c in (x, y)]
    even = (2.0 * np.arange(_ARROWS) + 1.0) / _ARROWS - 1.0
    chosen = set()
    for u, v in ((u, v) for u in even for v in even if u * u + v * v < 0.9):
        chosen.add(int(np.argmin((x / reach[0] - u) ** 2 + (y / reach[1] - v) ** 2)))
    return sorted(chosen)
