"""How deep and how long wheels slide."""

from __future__ import annotations

import numpy as np

from railgrip.campaign.programme.measures import FAST, Measured, longest_time, sound_axles

JUDGED_AXLES = 4
"""Initial adhesion is judged on so many braked wheelsets from the front."""
SLIDES = 0.02  # slip from which a wheel slides
DEEP = 0.5
ACTIVE = 60.0 / 3.6  # m/s: down to here slide activity counts


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
    return float(run.view.get("axle_longest_fast_lock")[sound_axles(run)].max(initial=0.0))


def deep_slip(run: Measured) -> float:
    """Return the longest time beyond slip 0.5 above 30 km/h of a sound axle, [s]."""
    train = run.view.get("train_speed")
    deep = (run.view.get("wheel_speed") < (1.0 - DEEP) * train) & (train > FAST)
    return longest_time(deep[sound_axles(run)], run.view.time)


def range_switches(run: Measured) -> float:
    """Return how often the slip range of an axle changes, the mean over the axles."""
    if not run.view.has("slip_range"):
        return float("nan")
    ranges = run.view.get("slip_range")
    return float((np.diff(ranges, axis=1) != 0.0).sum() / len(ranges))
