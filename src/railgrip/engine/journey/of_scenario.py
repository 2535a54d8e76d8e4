"""The journey without slip that belongs to a scenario's trip: its train as one mass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from pydantic import ValidationError

from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.lower_train import lower_train
from railgrip.scenario.explain import problems_of
from railgrip.scenario.journey import Journey
from railgrip.scenario.point_train import Effort, PointTrain, Regeneration
from railgrip.scenario.scenario import Scenario
from railgrip.scenario.trip import Trip

Array = NDArray[np.float64]

SERVICE = 0.7
"""Share of the full service deceleration that braking curves have, if nothing else is said."""


def journey_of(scenario: Scenario) -> Journey:
    """Return the journey without slip that a trip is compared with: its train as one mass.

    Parameters
    ----------
    scenario : Scenario
        With a table ``trip``.
    """
    trip, line = trip_of(scenario), scenario.line.use
    train = point_train_of(scenario)
    service = train.max_deceleration or 0.0
    try:
        return Journey(
            title=scenario.title, train=train, line=line, stop=trip.stop,
            braking=trip.braking if trip.braking is not None else SERVICE * service,
            gradient_under="train", curve_resistance=True, coasting=trip.coasting,
            supervision=trip.supervision,
        )  # fmt: skip
    except ValidationError as error:
        raise RailgripError(problems_of(error, Journey)) from None


def point_train_of(scenario: Scenario) -> PointTrain:
    """Return the train of a scenario as one mass: the same effort, resistance, brake and load.

    Raises
    ------
    RailgripError
        ``train: has no [traction]``, ``train.max_speed: is missing``.

    Examples
    --------
    >>> import railgrip as rg
    >>> train = point_train_of(rg.load("dry_emergency"))
    >>> train.mass, round(train.rotating, 3)
    (220000.0, 0.1)
    """
    train = scenario.train
    if train.traction is None or train.max_speed is None:
        what, where = (
            ("has no [traction]", "train")
            if train.traction is None
            else ("is missing", "train.max_speed")
        )
        raise RailgripError(Problem(where, what, cure="a train that can drive: 'emu_four_car'"))
    table, _ = lower_train(scenario)

    def column(name: str) -> Array:
        values: Array = table[1:, at.AXLE_PARAMETERS.split().index(name)]
        return values

    def of_train(name: str) -> float:
        return float(table[0, at.TRAIN_PARAMETERS.split().index(name)])

    mass = of_train("TRAIN_MASS")
    rotating = float(column("ROTATING_MASS").sum()) / mass
    motors = train.dynamic_brake
    return PointTrain(
        title=train.title, source=train.source, mass=mass, rotating=rotating, length=train.length,
        max_speed=train.max_speed,
        resistance={  # type: ignore[arg-type]
            "constant": of_train("RESISTANCE_CONSTANT"), "linear": of_train("RESISTANCE_LINEAR"),
            "quadratic": of_train("RESISTANCE_QUADRATIC"),
        },
        effort=Effort(force=float(column("TRACTION_MAX").sum()),
                      power=float(column("TRACTION_POWER").sum())),
        max_acceleration=trip_of(scenario).max_acceleration if scenario.trip else None,
        max_deceleration=float(column("FULL_FORCE").sum()) / (mass * (1.0 + rotating)),
        regeneration=Regeneration(
            force=float(column("DYNAMIC_MAX").sum()), power=float(column("DYNAMIC_POWER").sum()),
            fade_start=motors.fade_start if motors else 0.0,
            fade_end=motors.fade_end if motors else 0.0,
        ),
    )  # fmt: skip


def trip_of(scenario: Scenario) -> Trip:
    """Return the trip of a scenario that must have one."""
    if scenario.trip is None:
        raise RailgripError(Problem("trip", "is missing", cure="a table [trip]"))
    return scenario.trip
