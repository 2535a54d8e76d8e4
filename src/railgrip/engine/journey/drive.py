"""Drives a journey: legs from stop to stop, each marched by the kernel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey import kernel
from railgrip.engine.journey.forces import train_arrays
from railgrip.engine.journey.legs import Leg, braking_of, legs
from railgrip.engine.journey.profile import Sections
from railgrip.engine.journey.steps import SCRATCH
from railgrip.engine.plug_ins import first_class
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]
MOST_ROWS = 400_000


class DrivingLaw(NamedTuple):
    """A driving law: what to demand below the permitted speed.

    ``demand`` is a plain function of position, speed, parameters, state and demand. It fills
    ``demand[0]`` with the share of the tractive effort (0 to 1, or `HOLD` of `forces`: as much as
    holds the speed), ``demand[1]`` with a deceleration by the brake, m/s², and the rest with the
    new state; it must not change ``state``. The kernel locates where a demand changes. Permitted
    speed and braking curve have priority over it.
    """

    demand: Callable[..., None]
    setup: Callable[[Leg], tuple[Array, Array]]
    """Leg → parameters and first state."""


def full_power(position: float, speed: float, parameters: Any, state: Any, demand: Any) -> None:
    """Demand all the tractive effort, always: the fastest run."""
    demand[0] = 1.0
    demand[1] = 0.0


FLAT_OUT = DrivingLaw(full_power, lambda leg: (np.zeros(1), np.zeros(0)))
"""Full power to the permitted speed, then to the braking curve."""


class Intervention(NamedTuple):
    """A stretch on which the supervision braked.

    Parameters
    ----------
    brake : str
        ``service``, ``emergency``, or ``service, emergency`` where the first was not enough.
    begin, end : (float, float, float)
        Time [s], position [m], speed [m/s] where it began and ended.
    target : float
        Position of the target that it protected, or nan for a speed limit, [m].
    """

    brake: str
    begin: tuple[float, float, float]
    end: tuple[float, float, float]
    target: float


@dataclass(frozen=True)
class JourneyRun:
    """What became of a journey.

    Attributes
    ----------
    journey : Journey
        What was asked.
    trace : dict of array
        ``time`` s, ``position`` m, ``speed`` m/s, ``traction``, ``motor_brake``, ``friction`` N and
        ``permitted`` m/s, at the ends of the steps.
    running_times : array (leg)
        Without dwells, s.
    energy : dict of float
        J: at the wheel ``traction``, ``motor_brake``, ``friction``, ``resistance``, ``grade``;
        ``dc_link`` and ``pantograph`` net, with the auxiliaries.
    switchings : int
        Changes between traction and none.
    told : list of (int, Leg)
        What the driving law was told, each with the first row of the trace for which it held.
    interventions : list of Intervention
        Where the supervision braked.
    """

    journey: Journey
    trace: dict[str, Array]
    running_times: Array
    energy: dict[str, float]
    switchings: int
    told: list[tuple[int, Leg]] = field(default_factory=list)
    interventions: list[Intervention] = field(default_factory=list)

    @property
    def running_time(self) -> float:
        """Without dwells, s."""
        return float(self.running_times.sum())


def drive(journey: Journey, law: DrivingLaw = FLAT_OUT) -> JourneyRun:
    """Drive a journey without slip.

    Parameters
    ----------
    journey : Journey
        Train, line and stops; needs a deceleration of the braking curves.
    law : DrivingLaw
        What to demand below the permitted speed; full power if nothing else is said.

    Returns
    -------
    run : JourneyRun
        Trace, times and energy.

    Raises
    ------
    RailgripError
        ``the train cannot climb here and stalls; got a stand at 4321 m; try: …``

    Examples
    --------
    >>> from railgrip.scenario.journey import Journey
    >>> run = drive(Journey(train="local", line="const", passing_speed=0.0))
    >>> round(run.running_time, 1)
    393.4
    """
    if journey.supervision is not None and journey.supervision.mode == "intervene":
        from railgrip.engine.journey.intervening import drive_supervised  # it drives by this module

        return drive_supervised(journey, law)
    deceleration = braking_of(journey)
    train, sections = train_arrays(journey.train), Sections(journey)
    called = first_class(law.demand, kernel.LAW)
    totals, traces, times = np.zeros(kernel.TOTALS), [], []
    clock, told, row = 0.0, list[tuple[int, Leg]](), 0
    speed = journey.passing_speed
    for leg, there in zip(legs(journey), journey.stops()[1:], strict=True):
        check_passing(speed, leg.ceiling)
        parameters, state = law.setup(leg)
        rows = np.zeros((rows_for(leg.ceiling, sections, journey), kernel.COLUMNS))
        end = np.zeros(4)
        status = kernel.march(
            train, sections.position, sections.slope, sections.slope_change, sections.drag,
            *leg.ceiling, called, parameters, state, speed, journey.step, np.inf,
            rows, totals, np.zeros(SCRATCH + 2 * (2 + state.size)), end,
        )  # fmt: skip
        check_end(status, end, deceleration)
        part = rows[: int(end[0])]
        part[:, kernel.TIME] += clock
        told.append((row, leg))
        row += len(part)
        traces.append(part)
        times.append(end[1])
        clock += end[1] + there.dwell
        speed = 0.0
    return run_of(journey, np.concatenate(traces), np.array(times), totals, told)


def check_passing(speed: float, lid: tuple[Array, ...]) -> None:
    """Refuse a speed at a leg's beginning that is not permitted there."""
    if speed**2 > lid[1][0] * (1 + 1e-6):
        what = "is above what is permitted there, or what the authority leaves"
        raise RailgripError(Problem("passing_speed", what, got=f"{speed:g} m/s"))


def rows_for(lid: tuple[Array, ...], sections: Sections, journey: Journey) -> int:
    """Return how many rows of a trace a leg may take."""
    length = lid[0][-1] - lid[0][0]
    rough = length / journey.step / 2.0 + 40 * (lid[1].size + sections.slope.size)
    return int(min(2_000 + rough + 20 * len(journey.train.effort.table), MOST_ROWS))


def check_end(status: int, end: Array, deceleration: float) -> None:
    """Refuse how a march ended where it should not have, with the place."""
    place = f"{end[2]:.0f} m"
    if status == kernel.STALLED:
        raise RailgripError(
            Problem(
                "",
                "the train cannot climb here and stalls",
                got=f"a stand at {place}",
                cure="more tractive effort, less mass, a start with a run-up, or a greater "
                "coasting.least_speed",
            )
        )
    if status == kernel.TOO_WEAK:
        raise RailgripError(
            Problem(
                "braking",
                "is more than the brakes give here",
                got=f"{deceleration:g} m/s² at {place}",
                cure="a smaller deceleration",
            )
        )
    if status == kernel.TOO_LONG:
        raise RailgripError(
            Problem("", "the run takes too many steps", got=f"no arrival before {place}")
        )


def run_of(
    journey: Journey, rows: Array, times: Array, totals: Array, told: list[tuple[int, Leg]]
) -> JourneyRun:
    """Return the run that rows of the trace, running times and totals of its legs make."""
    names = ("time", "position", "speed", "traction", "motor_brake", "friction", "permitted")
    chain, net = journey.train.efficiency, journey.train.regeneration.receptivity
    wheel = dict(
        zip(("traction", "motor_brake", "friction", "resistance", "grade"), totals, strict=False)
    )
    auxiliaries = journey.train.auxiliaries * float(rows[-1, kernel.TIME])
    drawn, returned = totals[kernel.DC_TRACTION] + auxiliaries, totals[kernel.DC_BRAKE]
    energy = {name: float(value) for name, value in wheel.items()}
    energy["auxiliaries"] = auxiliaries
    energy["dc_link"] = float(drawn - returned * net)
    energy["pantograph"] = float(drawn / chain.converter - returned * net * chain.converter)
    return JourneyRun(
        journey,
        {name: rows[:, k].copy() for k, name in enumerate(names)},
        times,
        energy,
        int(totals[kernel.SWITCHINGS]),
        told,
    )
