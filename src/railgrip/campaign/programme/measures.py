"""How the figures of a run are measured, from its outcomes and its curves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.status import ENDED_WELL, RunStatus
from railgrip.report.metrics import si_value
from railgrip.report.view import View
from railgrip.scenario import Scenario

Array = NDArray[np.float64]
FAST = 30.0 / 3.6  # m/s: below, a lock counts for less


class Measured(NamedTuple):
    """One run, and what it is measured against.

    Attributes
    ----------
    view : View
        The run, with curves.
    scenario : Scenario
        What was run.
    reference : float
        Mean corrected distance of the test on dry rail that this one is compared with, [m]; NaN
        where there is none.
    cost_per_flat, flat_from : float
        Of the profile.
    """

    view: View
    scenario: Scenario
    reference: float = float("nan")
    cost_per_flat: float = 0.0
    flat_from: float = 0.03


def outcome(run: Measured, name: str) -> float:
    """Return a figure of the report, in SI; NaN for a distance of a train that never stopped."""
    return si_value(run.view, name)[0]


def corrected_distance(run: Measured) -> float:
    """Return the deceleration distance at nominal speed on the level, [m].

    Notes
    -----
    s' = v²/(2 (v₁²/(2 s) − g i m/m_dyn)): v nominal and v₁ true initial speed, s the deceleration
    distance run, i the mean gradient of the way (rising positive: it helped by g i). Infinite for a
    train that was to stop and did not.
    """
    if run.scenario.run.duration is None and run.view.number("status") != RunStatus.STOPPED:
        return float("inf")
    distance = run.view.number("deceleration_distance")
    speed = run.view.number("initial_speed")
    if not distance > 0.0:
        return float("nan")
    rotating = sum(place.axle.rotating_mass for place in run.scenario.train.axles())
    share = run.scenario.mass / (run.scenario.mass + rotating)
    way = float(np.ptp(run.view.get("train_position")))
    helped = run.view.number("energy_gradient") / (run.scenario.mass * way)
    deceleration = speed**2 / (2.0 * distance) - helped * share
    return run.scenario.run.speed**2 / (2.0 * deceleration) if deceleration > 0.0 else float("inf")


def extension(run: Measured) -> float:
    """Return by how much the corrected distance is longer than on dry rail."""
    return corrected_distance(run) / run.reference - 1.0


def k_wet(run: Measured) -> float:
    """Return 100/(100 + increase in %) (SUBSET-040)."""
    return 1.0 / (1.0 + extension(run))


def ended_well(run: Measured) -> float:
    """Return 1 where the train did what was asked: it stopped, or ran for its time; else 0."""
    return float(RunStatus(int(run.view.number("status"))) in ENDED_WELL)


def flat_cost(run: Measured) -> float:
    """Return the number of flats that must be turned off, times the cost of one."""
    return float((run.view.get("axle_flat_length") > run.flat_from).sum()) * run.cost_per_flat


def air_per_axle(run: Measured) -> float:
    """Return the air that the brake used, an axle, [m³ at 1 bar]."""
    return run.view.number("air_used") / run.scenario.train.n_axles


def least_reservoir(run: Measured) -> float:
    """Return the least pressure of any reservoir, [Pa]; NaN without reservoirs."""
    if not run.view.has("reservoir_pressure"):
        return float("nan")
    return float(np.nanmin(run.view.get("reservoir_pressure")))


def asked_pressure(run: Measured) -> Array:
    """Return the cylinder pressure that the driver asks for (axle, time), [Pa]."""
    brakes = run.scenario.train.brakes
    names = [place.axle.brake for place in run.scenario.train.axles()]
    full = np.array([brakes[name].cylinder_pressure if name else 0.0 for name in names])
    return full[:, None] * run.view.get("brake_demand")[None, :]


def sound_axles(run: Measured) -> list[int]:
    """Return the axles that no fault was given to; all of them where all are faulty."""
    faulty = {fault.axle for fault in run.scenario.fault}
    axles = [i for i, place in enumerate(run.scenario.train.axles()) if place.label not in faulty]
    return axles or list(range(run.scenario.train.n_axles))


def longest_time(rows: Array | NDArray[np.bool_], time: Array) -> float:
    """Return the longest time for which any row is true without a break, [s]."""
    longest = 0
    for row in rows:
        ends = np.flatnonzero(np.diff(np.concatenate(([0], row.astype(int), [0]))))
        longest = max(longest, int((ends[1::2] - ends[::2]).max(initial=0)))
    return longest * float(time[1] - time[0]) if len(time) > 1 else 0.0
