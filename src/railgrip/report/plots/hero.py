"""A slide and its protection: one axle without and with wheel-slide protection."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from railgrip.report.plots.style import PALETTE, styled
from railgrip.report.view import View, dataset_of


def hero(unprotected: Any, protected: Any, axle: str | None = None) -> Figure:
    """Draw the same axle without and with protection, speeds above, cylinder pressure below.

    Parameters
    ----------
    unprotected, protected : Result or xarray.Dataset
        The same stop, without and with a controller.
    axle : str, optional
        Label of the axle; the one that slid most without protection if not given.

    Returns
    -------
    matplotlib.figure.Figure
        Two columns on one time axis.
    """
    views = [View(dataset_of(unprotected)), View(dataset_of(protected))]
    label = axle if axle is not None else views[0].axles[views[0].worst_axle]
    with styled():
        made = Figure(figsize=(10.0, 4.4))
        panels = made.subplots(2, 2, sharex=True, sharey="row", height_ratios=[3, 1])
        names = ("Without wheel-slide protection", "With wheel-slide protection")
        for column, (view, name) in enumerate(zip(views, names, strict=True)):
            k = view.axles.index(label)
            _speeds(panels[0][column], view, k)
            _pressure(panels[1][column], view, k)
            panels[0][column].set_title(_headline(view, k, name), fontsize=9.5)
        panels[0][0].set_ylabel("Speed, km/h")
        panels[1][0].set_ylabel("Cylinder, bar")
        panels[0][0].set_ylim(bottom=0)
        panels[1][0].set_ylim(bottom=0)
        handles, labels = panels[0][0].get_legend_handles_labels()
        made.legend(handles, labels, loc="outside lower center", ncols=4)
    return made


def _speeds(axes: Axes, view: View, k: int) -> None:
    train, wheel = view.get("train_speed") * 3.6, view.get("wheel_speed")[k] * 3.6
    axes.fill_between(view.time, wheel, train, color=PALETTE[4], alpha=0.3, lw=0, label="sliding")
    locked = (wheel < 0.05 * train) & (train > 1.0)
    axes.fill_between(
        view.time,
        0,
        1,
        where=locked.tolist(),
        transform=axes.get_xaxis_transform(),
        color="#B2182B",
        alpha=0.10,
        lw=0,
        label="locked",
    )
    axes.plot(view.time, train, color="black", lw=1.8, label="train")
    axes.plot(view.time, wheel, color=PALETTE[0], lw=1.3, label=f"wheel {view.axles[k]}")
    axes.margins(x=0)


def _pressure(axes: Axes, view: View, k: int) -> None:
    bar = view.get("brake_cylinder_pressure")[k] / 1e5
    axes.plot(view.time, bar, color=PALETTE[2], lw=1.1)
    axes.fill_between(view.time, 0, bar, color=PALETTE[2], alpha=0.15, lw=0)
    axes.set_xlabel("Time, s")
    axes.margins(x=0)


def _headline(view: View, k: int, name: str) -> str:
    locked = view.get("axle_locked_time")[k] if view.has("axle_locked_time") else np.nan
    words = "never locked" if locked == 0 else f"wheel locked for {locked:.1f} s"
    distance = view.number("stopping_distance")
    return f"{name}:\n{distance:.0f} m to the stop, {words}"
