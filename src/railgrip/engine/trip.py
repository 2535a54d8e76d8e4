"""A trip on the plant: leg after leg from stop to stop, each a run of the engine."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.status import RunStatus
from railgrip.engine import layout as at
from railgrip.engine.journey.coasting import FLAT_OUT_NUMBERS, coasting_of
from railgrip.engine.journey.drive import JourneyRun, drive
from railgrip.engine.journey.legs import Leg, legs
from railgrip.engine.journey.of_scenario import journey_of, trip_of
from railgrip.engine.left_behind import Left, what_is_left
from railgrip.engine.lower_train import lower_train
from railgrip.engine.plan import DriverPlan
from railgrip.engine.result import Result
from railgrip.engine.simulate import overrides, prepare, run_prepared
from railgrip.scenario.journey import Journey
from railgrip.scenario.point_train import PointTrain
from railgrip.scenario.run import DemandPoint, DrivePoint
from railgrip.scenario.scenario import Scenario

Array = NDArray[np.float64]

BEYOND = 2000.0
"""The line goes on for so long behind its end, m: a train that slides needs room."""
PATIENCE = 4.0
"""A leg that takes so many times its time on dry rail, and five minutes, is given up."""
LONGEST = 7200.0
"""Greatest time of one leg, s."""
TRACE = 0.5
"""Between two points of a trip's traces, s."""


class TripLeg(NamedTuple):
    """From one stop to the next.

    Attributes
    ----------
    begin, stop : float
        Positions of the two stops, m.
    run : Result
        All that the plant did, with its traces.
    time : float
        From the departure to the stand, s; infinite if it did not come to a stand.
    planned : float
        Timetable, s.
    past_stop : float
        Where the front came to stand, beyond the stop, m; negative: short of it.
    sand : float
        Laid in this leg, kg.
    """

    begin: float
    stop: float
    run: Result
    time: float
    planned: float
    past_stop: float
    sand: float


class TripRun(NamedTuple):
    """A whole trip, and the same on dry rail without slip."""

    scenario: Scenario
    journey: Journey
    fast: JourneyRun
    legs: list[TripLeg]

    @property
    def running_time(self) -> float:
        """Without dwells, s."""
        return float(sum(leg.time for leg in self.legs))

    @property
    def delay(self) -> float:
        """Behind the timetable at the last stop, s; early trains wait, so it is never negative."""
        late = 0.0
        for leg in self.legs:
            late = max(0.0, late + leg.time - leg.planned)
        return late

    def total(self, name: str) -> float:
        """Return an outcome of the runs, summed over axles and legs."""
        return float(sum(np.nansum(leg.run.data[name].values) for leg in self.legs))


def drive_trip(scenario: Scenario) -> TripRun:
    """Drive a scenario's train from stop to stop on the plant.

    Parameters
    ----------
    scenario : Scenario
        With a table ``trip``, a train with traction, and a line with speed limits.

    Returns
    -------
    run : TripRun
        One run of the engine for each leg. Discs and the rail under the train are as the leg
        before left them; the discs have cooled at the stop.

    Raises
    ------
    RailgripError
        ``trip: is missing``; ``train: has no [traction]``; what a journey without slip cannot do.

    Notes
    -----
    A leg ends when the train stands. Where it overruns its stop, the next leg still begins at the
    stop. The driver does what `railgrip.engine.driver` says; wheel-slide protection, traction
    control, brake control, faults and rail are those of the scenario.

    Examples
    --------
    >>> import railgrip as rg
    >>> scenario = rg.load("dry_emergency").with_(
    ...     {"line.use": "fribourg_bern", "trip": {"stop": [{"at": 0}, {"at": 4000}]}})
    >>> run = drive_trip(scenario)
    >>> bool(abs(run.legs[0].past_stop) < 1.0), run.legs[0].run.status.name
    (True, 'STOPPED')
    """
    journey = journey_of(scenario)
    trip = trip_of(scenario)
    law = coasting_of(journey) if trip.coasting is not None else None
    fast = drive(journey, law) if law is not None else drive(journey)
    table, _ = lower_train(scenario)
    found, left, late = list[TripLeg](), None, 0.0
    ways = zip(legs(journey), fast.running_times, journey.stops()[1:], strict=True)
    for k, (leg, dry, stop) in enumerate(ways):
        numbers = law.setup(leg)[0] if law is not None else FLAT_OUT_NUMBERS
        done = _drive_leg(scenario, journey.train, table, leg, k, numbers, float(dry), left)
        found.append(done)
        late += done.time - done.planned
        stand = stop.dwell + max(-late, 0.0) if np.isfinite(late) else stop.dwell
        late = max(late, 0.0)
        left = what_is_left(done.run, table, stand)
    return TripRun(scenario, journey, fast, found)


def _drive_leg(
    scenario: Scenario, train: PointTrain, table: Array, leg: Leg, number: int, law: Array,
    dry: float, left: Left | None,
) -> TripLeg:  # fmt: skip
    prepared = prepare(_leg_scenario(scenario, leg.begin, dry, number))
    driver = _driver(scenario, train, table, leg, law)
    # the driver takes the place of demands over time
    timing = prepared.plan.timing._replace(
        demand_tick=np.zeros(0, dtype=np.int64), demand_level=np.zeros(0),
        demand_emergency=np.zeros(0), first_brake_tick=0,  # time counts from the departure
    )  # fmt: skip
    way = prepared.plan.way
    if left is not None:
        way, driver = left.lay(way), driver._replace(discs=left.discs)
    prepared = prepared._replace(plan=prepared.plan._replace(driver=driver, timing=timing, way=way))
    run = run_prepared(prepared, overrides(prepared, {}, 1), True)
    ended = run.status == RunStatus.STOPPED
    return TripLeg(
        begin=leg.begin,
        stop=leg.end,
        run=run,
        time=float(run.data["stopping_time"][0]) if ended else np.inf,
        planned=dry * (1.0 + trip_of(scenario).supplement),
        past_stop=float(run.data["covered_distance"][0]) + leg.begin - leg.end,
        sand=_sand(run) - float(way.earlier_sand.sum()) * way.cell_length,
    )


def _sand(run: Result) -> float:
    """Return the sand on the rail, kg."""
    laid = run.data["rail_sand"]
    cells = laid["cell"].values
    return float(np.nansum(laid.values)) * float(cells[1] - cells[0])


def _driver(
    scenario: Scenario, train: PointTrain, table: Array, leg: Leg, law: Array
) -> DriverPlan:
    """Return what the driver knows: the leg, and the train as its papers say."""
    trip, step, names = trip_of(scenario), scenario.run.step, at.AXLE_PARAMETERS.split()
    delays = table[1:, names.index("DEMAND_DELAY")]
    full_brake = float(table[1:, names.index("FULL_FORCE")].sum())
    numbers = np.array([
        train.dynamic_mass, full_brake, train.effort.force, train.effort.power, trip.gain,
        _foresight(scenario, delays),
        np.inf if trip.max_acceleration is None else trip.max_acceleration,
    ], dtype=float)  # fmt: skip
    return DriverPlan(
        every=max(1, round(trip.period / step)),
        late=np.round(delays / step).astype(np.int64),
        bounds=leg.ceiling[0],
        squares=leg.ceiling[1],
        falls=leg.ceiling[2],
        numbers=numbers,
        law=law,
    )


def _leg_scenario(scenario: Scenario, start: float, dry: float, number: int) -> Scenario:
    line = scenario.line.use
    longer = line.model_copy(update={"length": line.length + BEYOND})
    run = scenario.run.model_copy(
        update={
            "speed": 0.0,
            "demand": (DemandPoint(level=0.0),),
            "drive": (DrivePoint(level=1.0),),
            "duration": None,
            "time_limit": min(PATIENCE * dry + 300.0, LONGEST),
            "trace": TRACE,
            "seed": scenario.run.seed + number,
        }
    )
    rail, field = scenario.rail, scenario.rail.random
    if field is not None and field.seed is None:  # the line's, whatever the leg
        own = field.model_copy(update={"seed": scenario.run.seed})
        rail = rail.model_copy(update={"random": own})
    route = scenario.line.model_copy(update={"use": longer, "start": start})
    return scenario.model_copy(update={"run": run, "line": route, "rail": rail, "trip": None})


def _foresight(scenario: Scenario, delays: Array) -> float:
    """Return how long the brakes take to half their force, in the mean over the axles, s."""
    own = trip_of(scenario).foresight
    if own is not None:
        return own
    times = []
    for place, delay in zip(scenario.train.axles(), delays, strict=True):
        if place.axle.brake is not None:
            brake = scenario.train.brakes[place.axle.brake]
            filling = brake.lag if brake.fill == "lag" else 0.5 * brake.fill_time
            times.append(float(delay) + filling)
    return float(np.mean(times)) if times else 0.0
