"""How the figures of a run are measured, from its outcomes and its curves."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.control.contract import VENT
from railgrip.core.status import ENDED_WELL, RunStatus
from railgrip.report.metrics import si_value
from railgrip.report.view import View
from railgrip.scenario import Scenario

Array = NDArray[np.float64]

JUDGED_AXLES = 4
"""Initial adhesion is judged on so many braked wheelsets from the front."""
FAST = 30.0 / 3.6  # m/s: below, a lock counts for less
MONITORED = 50.0 / 3.6  # m/s: from here wheel rotation must be monitored
SLIDES = 0.02  # slip from which a wheel slides
DEEP = 0.5
RETURNED = 1.5  # times the adhesion of a moment ago: adhesion has returned
BACK = 0.8  # of the pressure asked for: the brake is back
EMPTY = 0.1  # of the pressure asked for: the axle has no brake
ACTIVE = 60.0 / 3.6  # m/s: down to here slide activity counts
CREEPING = 10.0 / 3.6  # m/s: below, the reference speed is not judged


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


def initial_adhesion(run: Measured) -> float:
    """Return the adhesion that the first four braked wheelsets use in their first second of slide.

    NaN where none of them slides.
    """
    view = run.view
    braked = [i for i, p in enumerate(run.scenario.train.axles()) if p.axle.brake is not None]
    slip, used = 1.0 - view.get("wheel_speed") / np.maximum(view.get("train_speed"), 0.1), []
    for axle in braked[:JUDGED_AXLES]:
        slides = np.flatnonzero(slip[axle] > SLIDES)
        if len(slides):
            first = view.time[slides[0]]
            second = (view.time >= first) & (view.time < first + 1.0)
            used.append(float(np.nanmean(view.get("adhesion_used")[axle, second])))
    return float(np.mean(used)) if used else float("nan")


def vehicle_activity(run: Measured) -> float:
    """Return the slide activity of the first vehicle, whose wheelsets meet the spray first.

    Share of the time from the brake command down to 60 km/h in which at least half of its wheels
    run below 0.9 of the train's speed (TB/T 3009-2019, abstract).
    """
    view = run.view
    axles = [i for i, place in enumerate(run.scenario.train.axles()) if place.vehicle == 0]
    train = view.get("train_speed")
    counts = (train > ACTIVE) & (view.get("brake_demand") > 0.0)
    slide = view.get("wheel_speed")[axles] < 0.9 * train
    return float((slide.mean(axis=0) >= 0.5)[counts].mean()) if counts.any() else float("nan")


def overload(run: Measured) -> float:
    """Return the share of the time above 60 km/h in which the first vehicle asks too much.

    At least half of its wheels are then asked for more adhesion than their rail has. Unlike slide
    activity it does not depend on how deep a protection lets wheels slide.
    """
    view = run.view
    axles = [i for i, place in enumerate(run.scenario.train.axles()) if place.vehicle == 0]
    counts = (view.get("train_speed") > ACTIVE) & (view.get("brake_demand") > 0.0)
    over = view.get("adhesion_asked")[axles] > view.get("adhesion_available")[axles]
    return float((over.mean(axis=0) >= 0.5)[counts].mean()) if counts.any() else float("nan")


def fast_lock(run: Measured) -> float:
    """Return the longest lock above 30 km/h of an axle that no fault was given to, [s]."""
    return float(run.view.get("axle_longest_fast_lock")[_sound(run)].max(initial=0.0))


def deep_slip(run: Measured) -> float:
    """Return the longest time beyond slip 0.5 above 30 km/h of a sound axle, [s]."""
    train = run.view.get("train_speed")
    deep = (run.view.get("wheel_speed") < (1.0 - DEEP) * train) & (train > FAST)
    return _longest(deep[_sound(run)], run.view.time)


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


def reapplication_time(run: Measured) -> float:
    """Return the mean time from a return of adhesion until the brake is back, [s].

    Returns of adhesion under released axles whose brake came back before adhesion fell again.
    """
    view = run.view
    available = view.get("adhesion_available")
    share = view.get("brake_cylinder_pressure") / np.maximum(_asked_pressure(run), 1e4)
    step = max(1, round(0.2 / (view.time[1] - view.time[0])))
    motors = np.abs(run.view.get("dynamic_force")).max(axis=1) > 0.0
    times = []
    for axle in [i for i in _sound(run) if not motors[i]]:
        a, p = available[axle], share[axle]
        rises = (a[step:] > RETURNED * a[:-step]) & (p[step:] < BACK)
        starts = np.flatnonzero(rises[1:] & ~rises[:-1]) + 1 + step
        for begin in starts:
            fallen = np.flatnonzero(a[begin:] < a[begin] / RETURNED)
            until = begin + (fallen[0] if len(fallen) else len(a) - begin)
            back = np.flatnonzero(p[begin:until] >= BACK)
            if len(back):
                times.append(view.time[begin + back[0]] - view.time[begin])
    return float(np.mean(times)) if times else float("nan")


def released_time(run: Measured) -> float:
    """Return the longest time for which a sound braked axle had no brake though one was asked."""
    view = run.view
    asked = _asked_pressure(run)
    share = view.get("brake_cylinder_pressure") / np.maximum(asked, 1e4)
    braked = [i for i in _sound(run) if run.scenario.train.axles()[i].axle.brake is not None]
    released = (share < EMPTY) & (asked > 5e4) & (view.get("train_speed") > FAST)
    by_motor = view.get("dynamic_force") > 1e3
    return _longest((released & ~by_motor)[braked], view.time)


def reference_error(run: Measured) -> float:
    """Return the greatest difference between reference and true speed above 10 km/h, [m/s]."""
    train, reference = run.view.get("train_speed"), run.view.get("reference_speed")
    fast = train > CREEPING
    return float(np.abs(reference - train)[fast].max(initial=0.0))


def alarm_delay(run: Measured) -> float:
    """Return the time until a faulty axle is reported, [s]: from the fault, or from 50 km/h.

    Infinite where it never is; NaN where no single axle is faulty or the train is too slow.
    """
    labels = [place.label for place in run.scenario.train.axles()]
    faulty = [(labels.index(f.axle), f.begin) for f in run.scenario.fault if f.axle in labels]
    fast = np.flatnonzero(run.view.get("train_speed") >= MONITORED)
    if not faulty or not len(fast):
        return float("nan")
    delays = []
    for axle, begin in faulty:
        since = max(begin, float(run.view.time[fast[0]]))
        told = np.flatnonzero((run.view.get("alarm")[axle] > 0.0) & (run.view.time >= since))
        delays.append(float(run.view.time[told[0]]) - since if len(told) else float("inf"))
    return max(delays)


def false_alarms(run: Measured) -> float:
    """Return how many sound axles wheel rotation monitoring reported."""
    return float((run.view.get("alarm")[_sound(run)] > 0.0).any(axis=1).sum())


def least_vent_speed(run: Measured) -> float:
    """Return the least speed at which the protection vents a valve, [m/s]; NaN if it never does."""
    view = run.view
    vents = (view.get("dump_valve")[_sound(run)] == VENT).any(axis=0)
    speeds = view.get("train_speed")[vents]
    return float(speeds.min()) if len(speeds) else float("nan")


def unbraked_at_stand(run: Measured) -> float:
    """Return how many braked axles have less than half the pressure asked for at the end."""
    view = run.view
    if view.number("status") != RunStatus.STOPPED:
        return float("nan")
    pressure, asked = view.get("brake_cylinder_pressure"), _asked_pressure(run)
    braked = [i for i in _sound(run) if run.scenario.train.axles()[i].axle.brake is not None]
    return float((pressure[braked, -1] < 0.5 * asked[braked, -1]).sum())


def creep_at_stand(run: Measured) -> float:
    """Return how far the train moves after it has stood, [m]."""
    if run.view.number("status") != RunStatus.STOPPED:
        return float("nan")
    position = run.view.get("train_position")
    stood = np.flatnonzero(np.abs(run.view.get("train_speed")) < 1e-3)
    return float(np.abs(position[-1] - position[stood[0]])) if len(stood) else 0.0


def range_switches(run: Measured) -> float:
    """Return how often the slip range of an axle changes, the mean over the axles."""
    if not run.view.has("slip_range"):
        return float("nan")
    ranges = run.view.get("slip_range")
    return float((np.diff(ranges, axis=1) != 0.0).sum() / len(ranges))


def _asked_pressure(run: Measured) -> Array:
    """Return the cylinder pressure that the driver asks for (axle, time), [Pa]."""
    brakes = run.scenario.train.brakes
    names = [place.axle.brake for place in run.scenario.train.axles()]
    full = np.array([brakes[name].cylinder_pressure if name else 0.0 for name in names])
    return full[:, None] * run.view.get("brake_demand")[None, :]


def _sound(run: Measured) -> list[int]:
    """Return the axles that no fault was given to; all of them where all are faulty."""
    faulty = {fault.axle for fault in run.scenario.fault}
    axles = [i for i, place in enumerate(run.scenario.train.axles()) if place.label not in faulty]
    return axles or list(range(run.scenario.train.n_axles))


def _longest(rows: Array | NDArray[np.bool_], time: Array) -> float:
    """Return the longest time for which any row is true without a break, [s]."""
    longest = 0
    for row in rows:
        ends = np.flatnonzero(np.diff(np.concatenate(([0], row.astype(int), [0]))))
        longest = max(longest, int((ends[1::2] - ends[::2]).max(initial=0)))
    return longest * float(time[1] - time[0]) if len(time) > 1 else 0.0
