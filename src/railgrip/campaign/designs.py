"""Studies: every design under every condition, all on the same draws, compared."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import numpy as np

from railgrip.campaign.campaign_file import CampaignFile
from railgrip.campaign.campaign_parts import Design
from railgrip.campaign.statistics import Estimate, difference, mean, quantile, quantile_difference
from railgrip.campaign.store import Store

ALONE = Design(name="all")
HIGH = 0.99
"""Quantile that designs are compared at besides their means."""


class Cell(NamedTuple):
    """One design under one condition: a campaign of its own, in a folder of its own."""

    design: str
    condition: str
    campaign: CampaignFile
    folder: Path


class Compared(NamedTuple):
    """What a design makes of a figure, and how that differs from the first design.

    Attributes
    ----------
    design, condition : str
        Names.
    runs : int
        That have the figure.
    mean, high : Estimate
        Mean and 99 % quantile, SI.
    over_first : Estimate or None
        Mean difference from the first design, over the same draws.
    high_over_first : Estimate or None
        Difference of the 99 % quantiles, with the paired bootstrap's interval.
    """

    design: str
    condition: str
    runs: int
    mean: Estimate
    high: Estimate
    over_first: Estimate | None
    high_over_first: Estimate | None


def cells(campaign: CampaignFile, folder: Path) -> list[Cell]:
    """Return the campaigns of a study; a single one where it has no designs and conditions."""
    if not campaign.design and not campaign.condition:
        return [Cell("", "", campaign, folder)]
    found = []
    for condition in campaign.condition or (ALONE,):
        for design in campaign.design or (ALONE,):
            own = campaign.model_copy(
                update={
                    "changes": {**campaign.changes, **condition.changes, **design.changes},
                    "design": (),
                    "condition": (),
                    "title": f"{campaign.title}: {design.name}, {condition.name}",
                }
            )
            place = folder / f"{condition.name}--{design.name}"
            found.append(Cell(design.name, condition.name, own, place))
    return found


def compare(done: list[tuple[Cell, Store]], figure: str) -> list[Compared]:
    """Return the figure of every cell, each design beside the first one of its condition."""
    rows = []
    first: dict[str, np.ndarray] = {}
    for cell, store in done:
        values = np.asarray(store.read(["run", figure])[figure], dtype=float)
        base = first.setdefault(cell.condition, values)
        shared = min(len(base), len(values))
        over = high_over = None
        if base is not values:
            over = difference(base[:shared], values[:shared])
            high_over = quantile_difference(base[:shared], values[:shared], HIGH)
        finite = values[np.isfinite(values)]
        rows.append(
            Compared(cell.design, cell.condition, len(finite), mean(finite),
                     quantile(finite, HIGH), over, high_over)
        )  # fmt: skip
    return rows
