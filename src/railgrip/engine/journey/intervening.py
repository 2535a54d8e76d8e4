"""A journey whose supervision brakes where it must."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from railgrip.control.etcs.limit_table import EBI, SBI
from railgrip.control.etcs.supervised_way import SupervisedWay, excess
from railgrip.engine.journey import kernel
from railgrip.engine.journey.drive import DrivingLaw, Intervention, JourneyRun
from railgrip.engine.journey.legs import Leg
from railgrip.engine.journey.marching import Authority, March, Part
from railgrip.engine.journey.profile import ceiling
from railgrip.engine.journey.pursuing import Pursuit
from railgrip.engine.journey.supervised_braking import Moment, SupervisedBraking
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

EXCESS = 1e-9
"""A speed that is above a limit by no more than this is not, m/s."""


def marched(journey: Journey, law: DrivingLaw, authority: Authority) -> JourneyRun:
    """Drive a journey in parts: behind a leading train, with a supervision that brakes, or both."""
    if authority.record is not None and authority.record.period == 0.0:
        return Pursuit(journey, law, authority).run()
    if journey.supervision is None or journey.supervision.mode != "intervene":
        return March(journey, law, authority).run()
    return drive_supervised(journey, law, authority)


def drive_supervised(
    journey: Journey, law: DrivingLaw, authority: Authority | None = None
) -> JourneyRun:
    """Drive a journey whose supervision brakes where an intervention limit is passed.

    Parameters
    ----------
    journey : Journey
        With a table ``supervision``.
    law : DrivingLaw
        What to demand below the driver's own braking curve.
    authority : Authority, optional
        Behind a leading train; absent: the line is free.

    Returns
    -------
    run : JourneyRun
        Its ``interventions`` say where which brake was applied.

    Notes
    -----
    Past SBI the service brake is applied until the permitted speed, and the driver's own curve,
    are kept to; past EBI, past the end of authority, and where the supervision cannot command the
    service brake, the emergency brake to a stand. From then on the driver keeps below the
    permitted speed before that target.

    Checked by tests/laws/test_supervised_journeys.py.

    Examples
    --------
    >>> brake = [{"value": 0.8}]
    >>> train = {"length": 100.0, "emergency": brake, "service": brake, "emergency_time": 2.0,
    ...          "service_time": 3.0, "service_brake_interface": True}
    >>> late = Journey(train="flirt_tpf", line="reference", braking=1.1,
    ...                supervision={"mode": "intervene", "train": train})
    >>> from railgrip.engine.journey.drive import FLAT_OUT
    >>> run = drive_supervised(late, FLAT_OUT)
    >>> [(one.brake, round(one.target), round(one.begin[1])) for one in run.interventions]
    [('service', 8550, 7410), ('service', 13760, 12620), ('service', 48581, 47441)]
    """
    march = _SupervisedMarch(journey, law, authority or Authority())
    run = march.run()
    run.interventions.extend(march.interventions)
    return run


class _SupervisedMarch(March):
    """The march, ended for a while by each intervention."""

    def __init__(self, journey: Journey, law: DrivingLaw, authority: Authority) -> None:
        super().__init__(journey, law, authority)
        self.interventions: list[Intervention] = []
        self.heeded: SupervisedWay | None = None

    def ceiling(
        self, known: float, end: float, stop: float, final: float
    ) -> tuple[Array, Array, Array]:
        """Return the driver's own ceiling; after an intervention the permitted speed counts."""
        assert self.onboard is not None
        aim = final if end == stop else 0.0
        if self.heeded is not None:
            target = self.heeded.tables[0].target
            end_now = min(known, stop + self.onboard.own.past_stop)
            is_renewed = target.is_end_of_authority and target.position < end_now
            if is_renewed or target.position <= self.place:
                self.heeded = None
        if self.heeded is None:
            return ceiling(self.journey, self.place, end, aim, self.deceleration)
        return self.onboard.ceiling(self.heeded, self.place, end, aim)

    def go(self, told: Leg, parameters: Array, until: float, end: float) -> bool:
        """March on up to the first intervention, and through it."""
        assert self.onboard is not None
        way = self.onboard.way(told.authority, told.end, told.is_stop)
        part = self.part(told, parameters, until)
        passed = _first_excess(way, part)
        if passed is None:
            return self.take(part, end)
        if passed > self.clock:
            self.accept(self.part(told, parameters, passed - self.clock))
        self._brake(told, way)
        return True

    def _brake(self, told: Leg, way: SupervisedWay) -> None:
        assert self.onboard is not None
        onboard = self.onboard

        def way_at(time: float) -> SupervisedWay:
            return onboard.way(self.authority.end(time), told.end, told.is_stop)

        begin = Moment(self.clock, self.place, self.speed)
        limit = EBI if float(excess(way, begin.place, begin.speed)[EBI, 0]) > -EXCESS else SBI
        decisive = way.deciding(begin.place, limit)
        pull = float(self.traces[-1][-1, kernel.TRACTION]) if self.traces else 0.0
        braking = SupervisedBraking(self, told, way_at, decisive, pull)
        end, rows, brake = braking.run(begin, limit == EBI)
        self.traces.append(rows)
        self.clock, self.place, self.speed = end
        at = math.nan if decisive is None else decisive.target.position
        self.interventions.append(Intervention(brake, begin, end, at))
        self.heeded = None if decisive is None else SupervisedWay(way.limits, (decisive,))


def _first_excess(way: SupervisedWay, part: Part) -> float | None:
    """Return the first moment at which an intervention limit is passed, [s]."""
    time, place, speed = (part.rows[:, k] for k in (kernel.TIME, kernel.POSITION, kernel.SPEED))
    above = excess(way, place, speed)[[SBI, EBI]].max(axis=0) > EXCESS
    if not above.any():
        return None
    k = int(np.argmax(above))
    if k == 0:
        return float(time[0])
    span = time[k] - time[k - 1]
    rate = (speed[k] - speed[k - 1]) / span

    def over(seconds: float) -> float:
        fast = speed[k - 1] + rate * seconds
        here = place[k - 1] + (speed[k - 1] + 0.5 * rate * seconds) * seconds
        return float(excess(way, here, fast)[[SBI, EBI]].max())

    if over(span) <= 0.0:
        return float(time[k])
    return float(time[k - 1] + brentq(over, 0.0, span, xtol=1e-9))
