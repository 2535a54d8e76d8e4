"""The optimum of a whole journey: a supplement spread so that a second is worth the same."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.optimum import grid as units
from railgrip.campaign.optimum.leg import LegProblem, Profile
from railgrip.campaign.optimum.mapped import ROUNDS, by_the_map, with_means
from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

_TRIES = 25
_CLOSE = 1e-5
"""A price is found when its times together miss the asked one by less than this share."""


class OptimalRun(NamedTuple):
    """The run of least energy for a time.

    Attributes
    ----------
    position, speed, time : array (node)
        m, m/s, s; dwells are in the time.
    traction, motor_brake, friction : array (node - 1)
        Forces at the wheel between the nodes, N; 0 where one leg ends and the next begins.
    energy : float
        Net at the pantograph, with the auxiliaries, J.
    running_times, least_times : array (leg)
        Without dwells, s: of this run, and the least possible.
    prices : array (leg)
        What a second more would save in each leg, W; nan where it is the fastest run.
    asked : float
        Running time asked for, s.
    is_optimal : bool
        False where a leg has no optimum for its time that was found (see ``early``), or where the
        train has an efficiency map.
    """

    position: Array
    speed: Array
    time: Array
    traction: Array
    motor_brake: Array
    friction: Array
    energy: float
    running_times: Array
    least_times: Array
    prices: Array
    asked: float
    is_optimal: bool

    @property
    def running_time(self) -> float:
        """Without dwells, s."""
        return float(self.running_times.sum())

    @property
    def early(self) -> float:
        """How long before the time asked for it arrives, s: 0 but where no slower run was found."""
        early = self.asked - self.running_time
        return early if early > 1e-6 * self.asked else 0.0


def optimum(journey: Journey, time: float | None = None, step: float | None = None) -> OptimalRun:
    """Return the run of least energy for a running time.

    Parameters
    ----------
    journey : Journey
        Train, line and stops. Speed limits, gradients (under front or train), tunnels, regeneration
        and the train's length count. With an efficiency map the run is the optimum of the mean
        efficiencies on it (``is_optimal`` false); its energy counts the map.
    time : float, optional
        Running time without dwells, from the least possible, [s]; absent: what the journey asks
        for by ``time`` or ``supplement``.
    step : float, optional
        Distance of the nodes, [m]; absent: leg/5000, from 2 to 10 m.

    Returns
    -------
    run : OptimalRun
        Between several stops the supplement is spread so that a second is worth the same in all.
        ``run.early`` and ``run.is_optimal`` tell where the time could not be used up.

    Raises
    ------
    RailgripError
        ``time: is impossible on this line with this train; got 900.0 s; allowed: from 996.6 s``

    Notes
    -----
    Minimised is ∫ (F_traction/η − η_r F_motor) ds over v(s), with the conditions of
    :mod:`railgrip.campaign.optimum.conditions`. On a grid the square of the speed is linear
    between nodes, forces are constant, and resistance and limits of power are taken at the mean
    square, so that energy and time are off by the square of the step.

    References
    ----------
    .. [1] A. Albrecht, P. Howlett, P. Pudney, X. Vu, P. Zhou, "The key principles of optimal train
       control – Part 1", Transportation Research B 94 (2016) 482–508,
       doi 10.1016/j.trb.2015.07.023: the necessary conditions.
    .. [2] S. Mehrotra, "On the implementation of a primal-dual interior point method", SIAM J.
       Optim. 2 (1992) 575–601, doi 10.1137/0802028: the step towards complementarity.

    Checked by tests/reference/gpops (440.14 kWh, 0.05 %) and tests/reference/collocation.

    Examples
    --------
    >>> run = optimum(Journey(train="flirt_tpf", line="st_gallen_wil"), time=1100.0)
    >>> round(run.energy / 3.6e6)
    84
    """
    if journey.train.efficiency.map is not None:
        return _mapped(journey, time, step)
    legs = _legs(journey, step)
    least = np.array([leg.least_time for leg in legs])
    total = _asked(journey, float(least.sum())) if time is None else float(time)
    if len(legs) == 1 or total <= least.sum() * (1.0 + 1e-9):
        times = least * max(total / least.sum(), 1.0) if len(legs) > 1 else np.array([total])
        if total < least.sum() * (1.0 - 1e-4):
            raise RailgripError(
                Problem(
                    "time", "is impossible on this line with this train",
                    got=f"{total:.1f} s", allowed=f"from {least.sum():.1f} s",
                )
            )  # fmt: skip
    else:
        times = spread(legs, total)
    runs = [leg.for_time(float(t)) for leg, t in zip(legs, times, strict=True)]
    return _joined(journey, legs, runs, max(total, float(least.sum())))


def _mapped(journey: Journey, time: float | None, step: float | None) -> OptimalRun:
    chain = journey.train.efficiency
    means, run = (chain.traction, chain.regeneration), None
    for _ in range(1 + ROUNDS):
        run = optimum(with_means(journey, means), time, step)
        means, energy = by_the_map(journey, run)
    assert run is not None
    return run._replace(energy=energy, is_optimal=False)


def spread(legs: list[LegProblem], total: float) -> Array:
    """Return the times of several legs, s: together ``total``, a second worth the same in all.

    The price of time is bracketed from that of an even spread and found by false position; what
    is left over lies between the times of the two prices next to it.
    """
    least = np.array([leg.least_time for leg in legs])
    even = least * total / least.sum()
    first = [leg.for_time(float(t)).price for leg, t in zip(legs, even, strict=True)]
    price = float(np.median(first))

    def times_at(price: float) -> Array:
        return np.array([leg.time_of(leg.for_price(price).square) for leg in legs])

    # a higher price makes faster; the fastest runs are those of an endless one
    slow: tuple[float, Array] | None = None
    fast: tuple[float, Array] = (1e12, least)
    for _ in range(_TRIES):
        found = times_at(price)
        if found.sum() > total:
            slow = (price, found)
        else:
            fast = (price, found)
        if slow is None:
            price *= 0.5
        elif fast[0] == 1e12:
            price *= 2.0
        else:
            late, early = slow[1].sum() - total, total - fast[1].sum()
            if min(late, early) < _CLOSE * total:
                break
            # kept off the ends, so that the bracket shrinks from both sides
            part = min(max(late / (late + early), 0.1), 0.9)
            price = float(slow[0] * (fast[0] / slow[0]) ** part)
    if slow is None:  # beyond the slowest run that any price asks for
        return np.asarray(fast[1] * total / fast[1].sum())
    late, early = slow[1].sum() - total, total - fast[1].sum()
    part = late / (late + early) if late + early > 0.0 else 0.0
    return np.asarray(np.maximum(slow[1] + part * (fast[1] - slow[1]), least))


def _legs(journey: Journey, step: float | None) -> list[LegProblem]:
    stops = journey.stops()
    last = len(stops) - 2
    return [
        LegProblem(
            journey, here.at, there.at,
            journey.passing_speed if k == 0 else 0.0,
            journey.passing_speed if k == last else 0.0,
            step,
        )
        for k, (here, there) in enumerate(pairwise(stops))
    ]  # fmt: skip


def _asked(journey: Journey, least: float) -> float:
    if journey.time is not None:
        return journey.time
    return least * (1.0 + (journey.supplement or 0.0))


def _joined(
    journey: Journey, legs: list[LegProblem], runs: list[Profile], asked: float
) -> OptimalRun:
    columns: list[list[Array]] = [[], [], [], [], [], []]
    clock, energy = 0.0, 0.0
    times = []
    for leg, run, stop in zip(legs, runs, journey.stops()[1:], strict=True):
        speed = np.sqrt(run.square) * units.SPEED
        passing = 2.0 * np.diff(leg.position) / (speed[1:] + speed[:-1])
        time = clock + np.concatenate([[0.0], np.cumsum(passing)])
        forces = [leg.traction_of(run), run.motor, run.friction]
        gap = [np.zeros(1)] if columns[0] else []
        for column, part in zip(columns[3:], forces, strict=True):
            column.extend([*gap, np.maximum(part, 0.0) * leg.mass])
        for column, part in zip(columns, (leg.position, speed, time), strict=False):
            column.append(part)
        times.append(float(time[-1] - clock))
        clock = float(time[-1]) + stop.dwell
        energy += leg.energy_of(run)
    energy += journey.train.auxiliaries * clock / journey.train.efficiency.converter
    position, speed, time, traction, motor, friction = (np.concatenate(c) for c in columns)
    least = np.array([leg.least_time for leg in legs])
    prices = np.array([run.price for run in runs])
    return OptimalRun(
        position, speed, time, traction, motor, friction, energy, np.array(times), least, prices,
        asked, all(run.is_optimal for run in runs),
    )  # fmt: skip
