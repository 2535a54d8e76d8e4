"""Where a measured and a simulated stop are laid together."""

from __future__ import annotations

from typing import Any

import numpy as np

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.signals import SIGNALS
from railgrip.io.measured.stop import MeasuredStop


def simulated_stop(data: Any, run: int) -> MeasuredStop:
    """Return the simulated stop in the clothes of a measured one, until its end."""
    one = data.isel(run=run) if "run" in data.dims else data
    ended = np.isfinite(np.asarray(one["train_speed"].values, dtype=float))
    if not ended.any():
        raise RailgripError("the simulated stop has no traces; try: run.trace = '20 ms'")
    train, axles = {}, {}
    labels = [str(label) for label in one["axle"].values]
    for name in map(str, one.data_vars):
        dims = SIGNALS[name].dims if name in SIGNALS else ()
        if dims == ("time",):
            train[name] = np.asarray(one[name].values, dtype=float)[ended]
        elif dims == ("axle", "time"):
            values = np.asarray(one[name].transpose("axle", "time").values, dtype=float)
            axles[name] = dict(zip(labels, values[:, ended], strict=True))
    return MeasuredStop("simulated", np.asarray(one["time"].values)[ended], train, axles)


def command_time(stop: MeasuredStop) -> float:
    """Return when the brake was first asked for."""
    demand = stop.train.get("brake_demand")
    if demand is None:
        what = "nothing says where the stops are laid together"
        cure = "[align] brake_command = '12.3 s' or speed_crossing = '140 km/h' in the channel map"
        raise RailgripError(Problem("align", what, cure=cure))
    given = np.flatnonzero(demand > 0)
    if not len(given):
        raise RailgripError(f"the {stop.title} stop never has a brake_demand above 0")
    return float(stop.time[given[0]])


def crossing_time(stop: MeasuredStop, speed: float) -> float:
    """Return when the stop first falls through a speed."""
    values = stop.train["train_speed"]
    falls = np.flatnonzero((values[:-1] >= speed) & (values[1:] < speed))
    if not len(falls):
        got = f"{speed * 3.6:g} km/h"
        allowed = f"between {values.min() * 3.6:.4g} and {values.max() * 3.6:.4g} km/h"
        what = f"the {stop.title} stop does not fall through this speed"
        raise RailgripError(Problem("align.speed_crossing", what, got, allowed))
    k = int(falls[0])
    share = (values[k] - speed) / (values[k] - values[k + 1])
    return float(stop.time[k] + share * (stop.time[k + 1] - stop.time[k]))
