"""What protection and brake do in answer: brakes back, reference speed, alarms, standstill."""

from __future__ import annotations

import numpy as np

from railgrip.campaign.programme.measures import (
    FAST,
    Measured,
    asked_pressure,
    longest_time,
    sound_axles,
)
from railgrip.control.contract import VENT
from railgrip.core.status import RunStatus

MONITORED = 50.0 / 3.6  # m/s: from here wheel rotation must be monitored
RETURNED = 1.5  # times the adhesion of a moment ago: adhesion has returned
BACK = 0.8  # of the pressure asked for: the brake is back
EMPTY = 0.1  # of the pressure asked for: the axle has no brake
CREEPING = 10.0 / 3.6  # m/s: below, the reference speed is not judged


def reapplication_time(run: Measured) -> float:
    """Return the mean time from a return of adhesion until the brake is back, [s].

    Returns of adhesion under released axles whose brake came back before adhesion fell again.
    """
    view = run.view
    available = view.get("adhesion_available")
    share = view.get("brake_cylinder_pressure") / np.maximum(asked_pressure(run), 1e4)
    step = max(1, round(0.2 / (view.time[1] - view.time[0])))
    motors = np.abs(run.view.get("dynamic_force")).max(axis=1) > 0.0
    times = []
    for axle in [i for i in sound_axles(run) if not motors[i]]:
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
    asked = asked_pressure(run)
    share = view.get("brake_cylinder_pressure") / np.maximum(asked, 1e4)
    braked = [i for i in sound_axles(run) if run.scenario.train.axles()[i].axle.brake is not None]
    released = (share < EMPTY) & (asked > 5e4) & (view.get("train_speed") > FAST)
    by_motor = view.get("dynamic_force") > 1e3
    return longest_time((released & ~by_motor)[braked], view.time)


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
    return float((run.view.get("alarm")[sound_axles(run)] > 0.0).any(axis=1).sum())


def least_vent_speed(run: Measured) -> float:
    """Return the least speed at which the protection vents a valve, [m/s]; NaN if it never does."""
    view = run.view
    vents = (view.get("dump_valve")[sound_axles(run)] == VENT).any(axis=0)
    speeds = view.get("train_speed")[vents]
    return float(speeds.min()) if len(speeds) else float("nan")


def unbraked_at_stand(run: Measured) -> float:
    """Return how many braked axles have less than half the pressure asked for at the end."""
    view = run.view
    if view.number("status") != RunStatus.STOPPED:
        return float("nan")
    pressure, asked = view.get("brake_cylinder_pressure"), asked_pressure(run)
    braked = [i for i in sound_axles(run) if run.scenario.train.axles()[i].axle.brake is not None]
    return float((pressure[braked, -1] < 0.5 * asked[braked, -1]).sum())


def creep_at_stand(run: Measured) -> float:
    """Return how far the train moves after it has stood, [m]."""
    if run.view.number("status") != RunStatus.STOPPED:
        return float("nan")
    position = run.view.get("train_position")
    stood = np.flatnonzero(np.abs(run.view.get("train_speed")) < 1e-3)
    return float(np.abs(position[-1] - position[stood[0]])) if len(stood) else 0.0
