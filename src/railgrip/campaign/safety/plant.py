"""The same stops stepped in time by the engine, with sensors, valves and rail."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.safety.case import SafetyCase
from railgrip.campaign.safety.draws import Trains
from railgrip.campaign.safety.formula import nominal_trains
from railgrip.campaign.safety.train_layout import Layout
from railgrip.core.errors import RailgripError
from railgrip.core.status import RunStatus
from railgrip.engine import layout as at
from railgrip.engine.lower_train import lower_train
from railgrip.engine.simulate import simulate
from railgrip.scenario import Scenario

FloatArray = NDArray[np.float64]
CANNOT_STOP = (RunStatus.TIME_LIMIT, RunStatus.END_OF_TRACK)
"""Ends that count as an endless stop: the train brakes too little."""


class Plant:
    """Stops a train from one speed on the plant.

    Parameters
    ----------
    case, layout, speed
        As for `railgrip.campaign.safety.formula.Formula`.
    wet : bool
        On the case's wet rail with slide protection, each run on its own random rail if it has one.
    threads : int
        Threads that share the runs.
    """

    def __init__(
        self, case: SafetyCase, layout: Layout, speed: float, *, wet: bool = False, threads: int = 1
    ) -> None:
        self.layout, self.speed, self.threads = layout, speed, threads
        self.scenario = case.scenario(speed, wet=wet)
        self.uncontrolled = case.without_control().scenario(speed, wet=wet)
        self.table, _ = lower_train(self.scenario)

    def distance(self, trains: Trains) -> tuple[FloatArray, FloatArray]:
        """Return stopping distance m and equivalent build-up time s of each train, (runs,)."""
        distance, response = np.empty(len(trains.mass)), np.empty(len(trains.mass))
        for scenario, runs in (
            (self.scenario, trains.is_controlled),
            (self.uncontrolled, ~trains.is_controlled),
        ):
            if runs.any():
                distance[runs], response[runs] = self._stop(scenario, trains.chosen(runs))
        return distance, response

    def _stop(self, scenario: Scenario, trains: Trains) -> tuple[FloatArray, FloatArray]:
        result = simulate(
            scenario, runs=len(trains.mass), variations=self.variations(trains), traces=False,
            threads=self.threads,
        )  # fmt: skip
        status = result.data["status"].values
        ended = status == RunStatus.STOPPED
        endless = np.isin(status, [int(one) for one in CANNOT_STOP])
        if not np.all(ended | endless):
            raise RailgripError(f"a run of the plant failed: {result.sentence}")
        distance = np.where(ended, result.data["stopping_distance"].values, np.inf)
        return distance, result.data["build_up_time"].values

    def nominal(self) -> tuple[float, float]:
        """Return distance and build-up time with nothing failed and nothing scattering."""
        distance, response = self.distance(nominal_trains(self.layout))
        return float(distance[0]), float(response[0])

    def variations(self, trains: Trains) -> dict[Any, FloatArray]:
        """Return the engine's numbers that differ from run to run."""
        b, first = self.layout.brakes, at.FIRST_PARAMETER
        train = self.table[0]
        found: dict[Any, FloatArray] = {
            "TRAIN_MASS": train[at.TRAIN_MASS - first] * trains.mass,
            "RESISTANCE_CONSTANT": train[at.RESISTANCE_CONSTANT - first] * trains.resistance,
            "RESISTANCE_LINEAR": train[at.RESISTANCE_LINEAR - first] * trains.resistance,
            "RESISTANCE_QUADRATIC": train[at.RESISTANCE_QUADRATIC - first] * trains.resistance,
            "DECELERATION_SCALE": trains.deceleration_scale,
            "DECELERATION_OFFSET": trains.deceleration_offset,
        }
        for axle in range(len(self.table) - 1):
            load = self.table[1 + axle, at.STATIC_LOAD - first]
            found["STATIC_LOAD", axle] = load * trains.mass
        for i, number in enumerate(b.axle):
            axle, row = int(number), self.table[1 + int(number)]
            worn = trains.radius[:, i] / b.radius[i]
            lever = np.ones_like(worn) if b.lever[i] == b.radius[i] else 1.0 / worn
            clamp = trains.efficiency[:, i]
            faster = b.fill[i] / trains.fill[:, i]
            more = trains.pressure[:, i] / b.pressure[i]
            found["WHEEL_RADIUS", axle] = trains.radius[:, i]
            found["PAD_FACTOR", axle] = trains.friction[:, i] * trains.works[:, i]
            found["TREAD_PER_CLAMP", axle] = row[at.TREAD_PER_CLAMP - first] * lever
            if self.scenario.brake_control is not None:  # it believes the wheels to be new
                found["BELIEVED_RATIO", axle] = lever
            found["START_TEMPERATURE", axle] = trains.disc_temperature[:, i]
            found["TEMPERATURE_ERROR", axle] = trains.temperature_error[:, i]
            found["RUBBING_RATIO", axle] = row[at.RUBBING_RATIO - first] * lever
            found["CLAMP_PER_PRESSURE", axle] = b.slope[i] * clamp
            found["CLAMP_OFFSET", axle] = b.spring[i] * clamp + b.offset[i]
            found["FULL_PRESSURE", axle] = trains.pressure[:, i]
            found["PER_FULL_PRESSURE", axle] = 1.0 / trains.pressure[:, i]
            found["DEMAND_DELAY", axle] = trains.dead[:, i]
            # a linear filling rises at a rate, the others approach their pressure
            is_linear = self.is_linear(i)
            found["FILL_RATE", axle] = (
                row[at.FILL_RATE - first] * faster * (more if is_linear else 1.0)
            )
            found["INSHOT_RATE", axle] = row[at.INSHOT_RATE - first] * faster
        return found

    def is_linear(self, i: int) -> bool:
        """Whether the cylinder of a braked axle fills linearly."""
        return self.scenario.train.brakes[self.layout.brakes.name[i]].fill == "linear"
