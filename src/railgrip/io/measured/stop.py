"""A measured stop in SI."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

STEPPED = frozenset({"dump_valve", "is_sliding", "alarm"})
"""Signals that jump: between two samples they keep the earlier value."""


@dataclass(frozen=True)
class MeasuredStop:
    """A measured stop in SI.

    Parameters
    ----------
    title : str
        Name in legends and tables.
    time : array
        Ascending, s.
    train : dict
        Signal name → values (time); holds at least ``train_speed``.
    axles : dict
        Signal name → axle label → values (time).
    brake_command, speed_crossing : float, optional
        Where it is laid over a simulated stop: time, s, or speed, m/s.
    """

    title: str
    time: Array
    train: dict[str, Array]
    axles: dict[str, dict[str, Array]] = field(default_factory=dict)
    brake_command: float | None = None
    speed_crossing: float | None = None

    @property
    def distance(self) -> Array:
        """Distance from the first sample: measured position, else the integral of the speed."""
        if "train_position" in self.train:
            position = self.train["train_position"]
            return np.asarray(position - position[0])
        speed = self.train["train_speed"]
        pieces = np.diff(self.time) * (speed[1:] + speed[:-1]) / 2
        return np.concatenate([[0.0], np.cumsum(pieces)])

    def resampled(self, time: Array) -> MeasuredStop:
        """Return the stop at other times, NaN where nothing was measured.

        Examples
        --------
        >>> stop = MeasuredStop("a", np.array([0.0, 2.0]), {"train_speed": np.array([10.0, 8.0])})
        >>> stop.resampled(np.array([1.0, 3.0])).train["train_speed"].tolist()
        [9.0, nan]
        """

        def at(name: str, values: Array) -> Array:
            if name in STEPPED:
                before = np.searchsorted(self.time, time, side="right") - 1
                inside = (time >= self.time[0]) & (time <= self.time[-1])
                return np.where(inside, values[np.maximum(before, 0)], np.nan)
            return np.interp(time, self.time, values, left=np.nan, right=np.nan)

        return replace(
            self,
            time=time,
            train={name: at(name, values) for name, values in self.train.items()},
            axles={
                name: {label: at(name, values) for label, values in rows.items()}
                for name, rows in self.axles.items()
            },
        )
