"""A search for parameters in pictures: how it went on, or the trade-off that it found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from railgrip.report.metrics import SOURCES
from railgrip.report.plots.style import styled

PENALISED = 3.0
"""Scores above it belong to sets that broke a limit; the picture ends there."""


def search(scores: Sequence[float]) -> Figure:
    """Draw the score of every trial and the best so far, 1 being the untuned controller.

    Parameters
    ----------
    scores : sequence of float
        In the order of the trials.
    """
    with styled():
        made = Figure(figsize=(8.0, 4.0), layout="constrained")
        axes = made.add_subplot()
        number = np.arange(1, len(scores) + 1)
        shown = np.where(np.array(scores) < PENALISED, scores, np.nan)
        axes.plot(number, shown, "o", ms=4, alpha=0.5, label="tried")
        axes.step(number, np.minimum.accumulate(scores), where="post", label="best so far")
        axes.axhline(1.0, color="0.4", ls="--", lw=1.0, label="untuned")
        axes.set(xlabel="Trial", ylabel="Score, untuned = 1", title="Search for parameters")
        low = min(1.0, *scores)
        axes.set_ylim(low - 0.05, min(PENALISED, max(1.2, float(np.nanmax(shown, initial=1.2)))))
        axes.legend()
    return made


def front(
    metrics: Sequence[str], tried: Sequence[Sequence[float]], best: Sequence[Sequence[float]]
) -> Figure:
    """Draw the trade-off of the first two metrics, each over that of the untuned controller.

    Parameters
    ----------
    metrics : sequence of str
        Names of the metrics.
    tried, best : sequence of scores
        All trials, and those on the front.
    """
    with styled():
        made = Figure(figsize=(6.0, 5.0), layout="constrained")
        axes = made.add_subplot()
        rows = np.array([row[:2] for row in tried])
        rows = rows[(rows < PENALISED).all(axis=1)]
        axes.plot(rows[:, 0], rows[:, 1], "o", ms=4, alpha=0.4, label="tried")
        edge = np.array(sorted(tuple(row[:2]) for row in best))
        axes.plot(edge[:, 0], edge[:, 1], "s-", ms=5, label="front")
        axes.plot(1.0, 1.0, "k*", ms=11, label="untuned")
        words = [SOURCES[name].label for name in metrics[:2]]
        axes.set(xlabel=f"{words[0]}, untuned = 1", ylabel=f"{words[1]}, untuned = 1")
        axes.set_title("Trade-off of the tuned controller")
        axes.legend()
    return made
