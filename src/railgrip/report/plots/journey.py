"""Speed over distance on the gradient, and energy over time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.profile import limits
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]


def altitude(journey: Journey) -> tuple[Array, Array]:
    """Return places and heights of the line, m."""
    line = journey.line
    places = np.array([0.0, *(p.at for p in line.gradient if p.at > 0.0), line.length])
    steps = dict.fromkeys(places.tolist(), 0.0) | {p.at: p.value for p in line.gradient}
    slopes = np.array([steps[place] for place in sorted(steps)][: places.size - 1])
    return places, line.altitude + np.concatenate([[0.0], np.cumsum(slopes * np.diff(places))])


def draw_speeds(
    axes: Any,
    journey: Journey,
    runs: Mapping[str, tuple[Array, Array]],
    curves: tuple[Array, Array, Array] | None = None,
) -> None:
    """Draw the runs (name → positions m, speeds m/s) under the limits and over the altitude.

    ``curves`` are positions with the speeds of braking and coasting-initiation curve.
    """
    stops = journey.stops()
    begin, end = stops[0].at, stops[-1].at
    ground = axes.twinx()
    places, heights = altitude(journey)
    ground.fill_between(places / 1e3, heights, heights.min() - 5.0, color="0.88", lw=0)
    span = max(float(np.ptp(heights)), 20.0)
    ground.set(ylabel="Altitude, m", ylim=(heights.min() - 0.05 * span, heights.min() + 3.0 * span))
    axes.set_zorder(ground.get_zorder() + 1)
    axes.patch.set_visible(False)
    steps = limits(journey)
    at = np.array([place for place, _ in steps] + [end]) / 1e3
    permitted = np.array([speed for _, speed in steps] + [steps[-1][1]]) * 3.6
    axes.step(at, permitted, where="post", color="k", lw=1.0, label="permitted")
    if curves is not None:
        place, braking, coasting = curves
        top = 1.1 * permitted.max()
        axes.plot(place / 1e3, np.where(braking * 3.6 < top, braking * 3.6, np.nan), "--",
                  color="k", lw=0.8, label="braking curve")  # fmt: skip
        axes.plot(place / 1e3, np.where(coasting * 3.6 < top, coasting * 3.6, np.nan), ":",
                  color="0.35", lw=1.2, label="coasting-initiation curve")  # fmt: skip
    for name, (position, speed) in runs.items():
        axes.plot(np.asarray(position) / 1e3, np.asarray(speed) * 3.6, lw=1.4, label=name)
    axes.set(
        xlabel="Position, km", ylabel="Speed, km/h",
        xlim=(begin / 1e3, end / 1e3), ylim=(0.0, 1.12 * permitted.max()),
    )  # fmt: skip
    axes.legend(loc="lower center", ncols=4, frameon=False, bbox_to_anchor=(0.5, 1.0))


def draw_trade_off(axes: Any, curves: Mapping[str, tuple[Array, Array]]) -> None:
    """Draw energy (J) over running time (s), one curve a way of driving."""
    for name, (time, energy) in curves.items():
        axes.plot(np.asarray(time) / 60.0, np.asarray(energy) / 3.6e6, "o-", ms=4, label=name)
    axes.set(xlabel="Running time, min", ylabel="Energy at the pantograph, kWh")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
