"""Pulses of heat into one point of the tread or of the rail.

A point of the tread is heated once per revolution, a point of the rail once per passing wheel
(figures 2 and 3 of EP 2 231 448).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.heat_inputs import course, one_number, rising
from railgrip.laboratory.inputs import as_floats

Array = NDArray[np.float64]


@dataclass(frozen=True)
class HeatPulses:
    """Pulses of heat into one point, one after the other.

    Parameters
    ----------
    start : ndarray, shape (n,)
        When each begins, rising [s].
    duration : ndarray, shape (n,)
        How long each lasts, > 0, to the start of the next at most [s].
    flux : ndarray, shape (n,)
        Heat flux into the body during the pulse, constant [W/m²].

    Raises
    ------
    RailgripError
        "start, duration and flux need the same number of pulses", "the pulses overlap or run
        backwards" or "a pulse is not a finite number".
    """

    start: Array
    duration: Array
    flux: Array

    def __post_init__(self) -> None:
        for name in ("start", "duration", "flux"):
            values = np.atleast_1d(as_floats(name, getattr(self, name)))
            object.__setattr__(self, name, values)
            if not np.all(np.isfinite(values)):
                raise RailgripError(Problem(name, "a pulse is not a finite number"))
        if not self.start.shape == self.duration.shape == self.flux.shape or self.start.ndim != 1:
            sizes = f"{self.start.size}, {self.duration.size}, {self.flux.size}"
            what = "start, duration and flux need the same number of pulses"
            raise RailgripError(Problem("pulses", what, got=sizes))
        is_ordered = np.all(self.start[1:] >= self.end[:-1] - 1e-12 * np.abs(self.end[:-1]))
        if not (np.all(self.duration > 0.0) and is_ordered):
            raise RailgripError(
                Problem(
                    "pulses",
                    "the pulses overlap or run backwards",
                    cure="durations above zero, each start after the end before it",
                )
            )

    @property
    def end(self) -> Array:
        """When each pulse ends [s]."""
        return self.start + self.duration


def wheel_pulses(
    time: ArrayLike,
    wheel_speed: ArrayLike,
    wheel_power: ArrayLike,
    circumference: float,
    length: float,
    width: float,
) -> HeatPulses:
    """Pulses into a point of the tread: once per revolution for length/wheel speed.

    Parameters
    ----------
    time : array_like, shape (n,)
        Rising; the point comes into the contact at the first [s].
    wheel_speed, wheel_power : array_like, shape (n,) or scalar
        Speed at the tread [m/s] and friction power into this wheel, its share [W], both ≥ 0.
    circumference : float
        U = 2πr, > length [m].
    length, width : float
        Of the patch, l = 2a and b = 2b of the ellipse, > 0 [m].

    Returns
    -------
    HeatPulses
        Flux P/(l·b), duration l/v; one a revolution until the wheel stands or the course ends. A
        pulse in which the course ends lasts as long as at its first speed.

    Raises
    ------
    RailgripError
        "the time must rise", "the wheel does not turn", "the patch does not fit the wheel", and
        "must be zero or more, and finite" and the like with the name in front.

    Notes
    -----
    Period U/v, pause T(1 − l/U). Speed and power are taken constant during a pulse.
    Known wrong for a locked wheel: it heats one point only, see `flash_conductance`.

    Examples
    --------
    >>> pulses = wheel_pulses([0.0, 0.3], [30.0, 30.0], [15e3, 15e3], 3.0, 12e-3, 20e-3)
    >>> pulses.start.round(3).tolist(), (1e3 * pulses.duration).round(3).tolist()
    ([0.0, 0.1, 0.2, 0.3], [0.4, 0.4, 0.4, 0.4])
    """
    t = rising("time", time)
    v = course("wheel_speed", wheel_speed, t.size, least=0.0)
    power = course("wheel_power", wheel_power, t.size, least=0.0)
    _refuse_bad_patch(length, width)
    one_number("circumference", circumference, "m", least=0.0, is_above=True)
    if not length < circumference:
        got = f"length {length} m, circumference {circumference} m"
        raise RailgripError(Problem("length", "the patch does not fit the wheel", got=got))
    way = np.concatenate([[0.0], np.cumsum(0.5 * (v[1:] + v[:-1]) * np.diff(t))])
    if not way[-1] > 0.0:
        raise RailgripError(
            Problem("wheel_speed", "the wheel does not turn", got="0 m/s", allowed="above 0 m/s")
        )
    turns = np.arange(math.floor(way[-1] / circumference * (1.0 + 1e-12)) + 1) * circumference
    # where the wheel stands the way does not grow, and its inverse takes the first such time
    _, first = np.unique(way, return_index=True)
    start = np.interp(turns, way[first], t[first])
    end = np.interp(turns + length, way[first], t[first])
    leaves, begun = turns + length <= way[-1], np.interp(start, t, v)
    is_heated = leaves | (begun > 0.0)
    duration = np.where(leaves, end - start, length / np.where(begun > 0.0, begun, 1.0))
    flux = np.interp(start, t, power) / (length * width)
    return HeatPulses(start[is_heated], duration[is_heated], flux[is_heated])


def rail_pulses(
    wheel_places: ArrayLike,
    train_speed: float,
    rail_powers: ArrayLike,
    length: float,
    width: float,
) -> HeatPulses:
    """Pulses into a point of the rail: one per passing wheel, length/train speed long.

    Parameters
    ----------
    wheel_places : array_like, shape (n,)
        Distance of each wheel behind the first, rising from 0; the patches must not overlap [m].
    train_speed : float
        > 0, constant while the train passes [m/s].
    rail_powers : array_like, shape (n,) or scalar
        Friction power of each wheel that goes into the rail, ≥ 0 [W].
    length, width : float
        Of the patch, > 0 [m].

    Returns
    -------
    HeatPulses
        One a wheel, in their order.

    Raises
    ------
    RailgripError
        "the train does not move", "one value for each wheel, or one for all", and those of
        `HeatPulses`.

    Examples
    --------
    >>> pulses = rail_pulses([0.0, 2.5, 19.0, 21.5], 25.0, 10e3, 12e-3, 20e-3)
    >>> pulses.start.tolist()
    [0.0, 0.1, 0.76, 0.86]
    """
    if one_number("train_speed", train_speed, "m/s", least=0.0) == 0.0:
        raise RailgripError(
            Problem(
                "train_speed",
                "the train does not move",
                got=f"{train_speed:g} m/s",
                allowed="above 0 m/s",
            )
        )
    _refuse_bad_patch(length, width)
    start = np.atleast_1d(as_floats("wheel places", wheel_places)) / train_speed
    powers = course("rail_powers", rail_powers, start.size, of="wheel", least=0.0)
    return HeatPulses(start, np.full(start.shape, length / train_speed), powers / (length * width))


def _refuse_bad_patch(length: float, width: float) -> None:
    one_number("length", length, "m", least=0.0, is_above=True)
    one_number("width", width, "m", least=0.0, is_above=True)
