"""What is measured on board of a train, or of a simulated one."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError

Array = NDArray[np.float64]


class Measurements(NamedTuple):
    """What was measured on board.

    Attributes
    ----------
    time : ndarray (time)
        Evenly spaced, [s].
    wheel_speed, brake_cylinder_pressure, dynamic_force : ndarray (axle, time)
        Speed at the tread [m/s]; gauge pressure [Pa]; motor force at the tread, braking
        positive [N].
    train_speed, deceleration : ndarray (time)
        Of the train, as its reference speed and its acceleration sensor tell, [m/s], [m/s²].
    """

    time: Array
    wheel_speed: Array
    brake_cylinder_pressure: Array
    dynamic_force: Array
    train_speed: Array
    deceleration: Array


def measurements_of(result: Any, run: int = 0) -> Measurements:
    """Return what a simulated train measures: sensors for speeds, the plant for the rest.

    Parameters
    ----------
    result : Result
        With curves.
    run : int
        Which run.
    """
    data = result.data.isel(run=run)
    known = np.isfinite(data["train_speed"].values)

    def of(name: str) -> Array:
        return np.asarray(data[name].values[..., known], dtype=np.float64)

    return Measurements(
        np.asarray(data["time"].values[known], dtype=np.float64), of("measured_speed"),
        of("brake_cylinder_pressure"), of("dynamic_force"), of("reference_speed"),
        -of("acceleration"),
    )  # fmt: skip


def check(measured: Measurements, n_axles: int) -> None:
    """Refuse measurements that are not evenly spaced, or of another train."""
    steps = np.diff(measured.time)
    if len(steps) < 10 or steps.max() - steps.min() > 1e-3 * steps.mean():
        raise RailgripError(Problem("time", "must be evenly spaced, at least ten samples"))
    found = len(measured.wheel_speed)
    if found != n_axles:
        raise RailgripError(
            Problem("wheel_speed", f"has {found} axles", allowed=f"{n_axles}, as the train")
        )
