"""A measured stop against a simulated one: laid together in time, and what differs."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS
from railgrip.io.measured.aligning import command_time, crossing_time, simulated_stop
from railgrip.io.measured.stop import MeasuredStop

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

STANDING = 0.5 / 3.6
"""Below this speed, m/s, a train counts as standing: sensors hardly see less."""

SHOWN = {"m/s": ("km/h", 3.6), "Pa": ("bar", 1e-5), "N": ("kN", 1e-3), "degC": ("°C", 1.0)}


class Difference(NamedTuple):
    """One line of the comparison.

    Attributes
    ----------
    name, label : str
        In files; in words.
    simulated, measured : float
        In `unit`; NaN where only the difference means something.
    difference : float
        Simulated less measured.
    unit : str
        The engineer's unit.
    """

    name: str
    label: str
    simulated: float
    measured: float
    difference: float
    unit: str


@dataclass(frozen=True)
class MeasuredComparison:
    """A measured stop on the axes of a simulated one, and the table of differences.

    Parameters
    ----------
    stop : MeasuredStop
        On the simulation's time axis.
    distance : array
        On the simulation's distance axis, m.
    rows : list of Difference
        The table.
    """

    stop: MeasuredStop
    distance: Array
    rows: list[Difference]

    @property
    def title(self) -> str:
        """Name in legends."""
        return self.stop.title

    @property
    def time(self) -> Array:
        """Time on the simulation's axis, s."""
        return self.stop.time

    @property
    def train(self) -> dict[str, Array]:
        """Signal name → values."""
        return self.stop.train

    @property
    def axles(self) -> dict[str, dict[str, Array]]:
        """Signal name → axle label → values."""
        return self.stop.axles


def compare_measured(
    result: Any,
    measured: MeasuredStop,
    *,
    run: int = 0,
    brake_command: float | None = None,
    speed_crossing: float | None = None,
) -> MeasuredComparison:
    """Lay a measured stop over a simulated one and return what differs.

    Parameters
    ----------
    result : Result or xarray.Dataset
        The simulated stop, with traces.
    measured : MeasuredStop
        The measured one.
    run : int
        Which run of the batch.
    brake_command, speed_crossing : float, optional
        Measured time of the brake command, s, or the speed, m/s, that both fall through at the
        same time; what the channel map says if neither is given, and at last the first moment of
        a measured ``brake_demand``.

    Returns
    -------
    MeasuredComparison
        To be read, or given to `railgrip.report.html.write_report`.

    Raises
    ------
    RailgripError
        ``align: nothing says where the stops are laid together; try: [align] brake_command = …``

    Notes
    -----
    Distance, time and mean deceleration are counted from the common moment until both stops have
    fallen to the same speed: a stand, or the least speed that both reach. Mean deceleration is
    (v0² − v1²)/2s of each stop, with its own v0.
    """
    data = getattr(result, "data", result) if not hasattr(result, "data_vars") else result
    simulated = simulated_stop(data, run)
    if brake_command is None and speed_crossing is None:
        brake_command, speed_crossing = measured.brake_command, measured.speed_crossing
    if speed_crossing is not None:
        there = crossing_time(measured, speed_crossing)
        here = crossing_time(simulated, speed_crossing)
    else:
        there = command_time(measured) if brake_command is None else float(brake_command)
        here = command_time(simulated)
    if not measured.time[0] <= there <= measured.time[-1]:
        got = f"{there:g} s"
        allowed = f"{measured.time[0]:g} to {measured.time[-1]:g} s"
        raise RailgripError(Problem("align.brake_command", "is not in the record", got, allowed))
    _check_axles(measured, [str(label) for label in data["axle"].values])
    before = np.interp(there, measured.time, measured.distance)
    ahead = np.interp(here, simulated.time, simulated.distance)
    laid = replace(measured, time=measured.time - there + here)
    rows = [*_stop_rows(simulated, laid, here), *_trace_rows(simulated, laid, here)]
    return MeasuredComparison(laid, np.asarray(measured.distance - before + ahead), rows)


def _check_axles(measured: MeasuredStop, known: list[str]) -> None:
    labels = dict.fromkeys(label for rows in measured.axles.values() for label in rows)
    wrong = [label for label in labels if label not in known]
    if wrong:
        raise RailgripError([unknown_name("channel", "axle", label, known) for label in wrong[:10]])


def _stop_rows(simulated: MeasuredStop, laid: MeasuredStop, start: float) -> list[Difference]:
    both = (simulated, laid)
    after = [stop.train["train_speed"][stop.time >= start] for stop in both]
    least = max([STANDING, *(float(speed.min()) * (1 + 1e-9) for speed in after)])
    first = [float(np.interp(start, stop.time, stop.train["train_speed"])) for stop in both]
    fast = [v * 3.6 for v in first]
    rows = [_row("start_speed", "Speed at the common moment", fast, "km/h")]
    if min(first) <= least:
        return rows
    until = "to a stand" if least == STANDING else f"down to {least * 3.6:.1f} km/h"
    ends = [crossing_time(_from(stop, start), least) for stop in both]
    run = [
        float(np.interp(end, s.time, s.distance) - np.interp(start, s.time, s.distance))
        for s, end in zip(both, ends, strict=True)
    ]
    mean = [(v**2 - least**2) / (2 * s) for v, s in zip(first, run, strict=True)]
    return [
        *rows,
        _row("stopping_distance", f"Distance {until}", run, "m"),
        _row("stopping_time", f"Time {until}", [end - start for end in ends], "s"),
        _row("mean_deceleration", "Mean deceleration", mean, "m/s²"),
    ]


def _from(stop: MeasuredStop, start: float) -> MeasuredStop:
    """Return the stop from a moment on, so that crossings before it do not count."""
    kept = stop.time >= start
    speed = stop.train["train_speed"][kept]
    return replace(stop, time=stop.time[kept], train={"train_speed": speed})


def _row(name: str, label: str, both: list[float], unit: str) -> Difference:
    simulated, measured = both
    return Difference(name, label, simulated, measured, simulated - measured, unit)


def _trace_rows(simulated: MeasuredStop, laid: MeasuredStop, start: float) -> list[Difference]:
    """Return greatest and rms difference of each signal, where both were recorded."""
    at = simulated.time[simulated.time >= start]
    theirs, ours = laid.resampled(at), simulated.resampled(at)
    rows = []
    for name, values in theirs.train.items():
        if name in ours.train and name not in ("train_position", "brake_demand"):
            rows += _spread(name, name.replace("_", " "), ours.train[name] - values)
    for name, measured in theirs.axles.items():
        for label, values in measured.items():
            if name in ours.axles and label in ours.axles[name]:
                words = f"{name.replace('_', ' ')} {label}"
                rows += _spread(f"{name}:{label}", words, ours.axles[name][label] - values)
    return rows


def _spread(name: str, words: str, difference: Array) -> list[Difference]:
    known = difference[np.isfinite(difference)]
    if not len(known):
        return []
    si = SIGNALS[name.partition(":")[0]].unit
    unit, factor = SHOWN.get(si, ("" if si == "1" else si.replace("^2", "²"), 1.0))
    greatest = float(known[np.argmax(np.abs(known))]) * factor
    rms = float(np.sqrt(np.mean(known**2))) * factor
    nothing = float("nan")
    words = words[0].upper() + words[1:]
    kinds = (("greatest", greatest), ("rms", rms))
    return [
        Difference(f"{name}_{kind}", f"{words}: {kind} difference", nothing, nothing, value, unit)
        for kind, value in kinds
    ]
