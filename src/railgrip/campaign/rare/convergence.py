"""How a quantile and its interval settle as the sample grows."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.campaign.rare.estimate import RareResult
from railgrip.campaign.rare.proposal import Sample
from railgrip.campaign.rare.quantiles import Interval, curve, intervals

SHARES = (0.125, 0.25, 0.5, 1.0)
"""Shares of the sample that are looked at."""


class Stage(NamedTuple):
    """The quantile after so many runs of the sample."""

    runs: int
    quantile: Interval


def convergence(found: RareResult, level: int) -> list[Stage]:
    """Return a quantile from growing shares of the sample, of each component alike.

    Parameters
    ----------
    found : RareResult
        From `rare_quantiles`.
    level : int
        Which of its probabilities, from 0.
    """
    sample = found.sample
    rank, size = np.zeros(len(found.result)), np.zeros(len(found.result))
    for number in np.unique(sample.component):
        own = np.flatnonzero(sample.component == number)
        rank[own], size[own] = np.arange(len(own)), len(own)
    stages = []
    for share in SHARES:
        kept = rank < np.maximum(np.ceil(share * size), 2)
        scale = size / np.maximum(np.ceil(share * size), 2)
        part = Sample(
            sample.normals[kept], sample.state[kept], sample.position[kept],
            (sample.weight * scale)[kept], sample.component[kept],
        )  # fmt: skip
        made = curve(found.result[kept], part, found.states)
        rows = intervals(made, found.probability[level : level + 1], found.states.left_out)
        stages.append(Stage(int(kept.sum()), rows[0]))
    return stages
