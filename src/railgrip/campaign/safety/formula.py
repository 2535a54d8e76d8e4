"""Deceleration distances by mean values (EN 14531-1), thousands of trains at once."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.safety.case import SafetyCase
from railgrip.campaign.safety.draws import Trains
from railgrip.campaign.safety.train_layout import Layout
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.lower_train import lower_train
from railgrip.train.en14531 import mean_resistance

FloatArray = NDArray[np.float64]


class Formula:
    """Stops a train from one speed by the formula of mean values.

    Parameters
    ----------
    case : SafetyCase
        The train and what scatters.
    layout : Layout
        From `layout_of`.
    speed : float
        Speed at the brake command, m/s.

    Raises
    ------
    RailgripError
        For a train that brakes with motors or magnets in an emergency: the formula here knows
        friction brakes only.

    Notes
    -----
    Mean friction is that of the train's file at its reference; it does not change with speed or
    temperature. Nothing slides.
    """

    def __init__(self, case: SafetyCase, layout: Layout, speed: float) -> None:
        train = case.train
        dynamic = train.dynamic_brake
        if (dynamic is not None and dynamic.in_emergency) or any(
            vehicle.track_brake is not None for vehicle in train.vehicle
        ):
            raise RailgripError(
                Problem("method", "the formula counts friction brakes only", got="formula",
                        cure="method = 'plant'")
            )  # fmt: skip
        table, _ = lower_train(case.scenario(speed))
        first = at.FIRST_PARAMETER
        self.layout, self.speed = layout, speed
        self.mass = float(table[0, at.TRAIN_MASS - first])
        self.rotating = float(table[1:, at.ROTATING_MASS - first].sum())
        self.resistance = mean_resistance(
            speed,
            constant=float(table[0, at.RESISTANCE_CONSTANT - first]),
            linear=float(table[0, at.RESISTANCE_LINEAR - first]),
            quadratic=float(table[0, at.RESISTANCE_QUADRATIC - first]),
        )

    def distance(self, trains: Trains) -> tuple[FloatArray, FloatArray]:
        """Return stopping distance m and equivalent response time s of each train, (runs,)."""
        b = self.layout.brakes
        through = b.slope * trains.pressure + b.spring
        clamp = np.maximum(through * trains.efficiency + b.offset, 0.0)
        lever = np.where(b.lever == b.radius, 1.0, b.lever / trains.radius)
        force = clamp * (b.friction * trains.friction) * lever * trains.works
        times = trains.dead + 0.5 * trains.fill
        total = force.sum(axis=1) + self.resistance * trains.resistance
        mass = self.mass * trains.mass + self.rotating
        with np.errstate(divide="ignore", invalid="ignore"):
            response = (force * times).sum(axis=1) / total
            stop = self.speed * response + 0.5 * self.speed**2 * mass / total
        return np.where(total > 0.0, stop, np.inf), response

    def nominal(self) -> tuple[float, float]:
        """Return distance and response time with nothing failed and nothing scattering."""
        distance, response = self.distance(nominal_trains(self.layout))
        return float(distance[0]), float(response[0])


def nominal_trains(layout: Layout) -> Trains:
    """Return one train exactly as its file says."""
    b: Any = layout.brakes
    one = np.ones((1, len(b.axle)))
    return Trains(
        b.pressure * one, one, one.copy(), b.radius * one, b.fill * one, b.dead * one,
        np.ones(1), np.ones(1), one.astype(bool), b.temperature * one, 0.0 * one,
        np.ones(1), np.zeros(1), np.ones(1, dtype=bool),
    )  # fmt: skip
