"""Figures of a campaign: exceedance with its band, histogram, tornado."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from railgrip.report.units import Shown

BLUE, GREY = "#0b5fa5", "#8a8f98"


def exceedance(values: Any, band: Sequence[Sequence[float]], thresholds: Any, label: str) -> Figure:
    """Draw how often a figure exceeds each threshold, with the band of its 95 % intervals.

    Parameters
    ----------
    values : array (run)
        In the unit of the label.
    band : sequence of (estimate, low, high)
        For each threshold.
    thresholds : array
        In the same unit.
    label : str
        Of the axis, with unit.
    """
    figure = Figure(figsize=(7, 4.2), layout="constrained")
    axes = figure.subplots()
    share, low, high = np.array(band, dtype=float).T
    least = 0.5 / max(len(values), 1)
    axes.fill_between(
        thresholds, np.maximum(low, least), high, color=BLUE, alpha=0.2, lw=0,
        label="95 % (Clopper and Pearson)",
    )  # fmt: skip
    axes.plot(thresholds, np.where(share > 0, share, np.nan), color=BLUE, label="share of runs")
    axes.set_yscale("log")
    axes.set_ylim(least, 1.3)
    axes.set_xlabel(label)
    axes.set_ylabel("probability to exceed")
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(frameon=False)
    return figure


def histogram(values: Any, label: str) -> Figure:
    """Draw how a figure is spread."""
    figure = Figure(figsize=(7, 3.6), layout="constrained")
    axes = figure.subplots()
    axes.hist(values, bins="auto" if len(values) < 5000 else 80, color=BLUE)
    axes.set_xlabel(label)
    axes.set_ylabel("runs")
    axes.grid(True, axis="y", alpha=0.3)
    return figure


def tornado(
    middle: float, swings: Sequence[tuple[str, float, float]], how: Shown, label: str
) -> Figure:
    """Draw the swing of a figure under each variable, the widest on top; numbers in SI."""
    shown = list(swings)[:15][::-1]
    figure = Figure(figsize=(7, 1.4 + 0.36 * len(shown)), layout="constrained")
    axes = figure.subplots()
    for row, (_, low, high) in enumerate(shown):
        for end, colour in ((low, GREY), (high, BLUE)):
            axes.barh(row, (end - middle) * how.factor, left=middle * how.factor, color=colour)
    axes.axvline(middle * how.factor, color="black", lw=0.8)
    axes.set_yticks(range(len(shown)), [name for name, _, _ in shown])
    axes.set_xlabel(f"{label}; grey: variable at its 5 % quantile, blue: at 95 %")
    axes.grid(True, axis="x", alpha=0.3)
    return figure
