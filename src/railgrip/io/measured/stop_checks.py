"""What can be wrong with a measured stop, each in one sentence."""

from __future__ import annotations

import numpy as np

from railgrip.core.errors import Problem
from railgrip.io.measured.pad_channels import Cutting
from railgrip.laboratory.inputs import FloatArray

Signals = dict[str, FloatArray]

PLAUSIBLE = {
    "friction": (0.02, 1.2, ""),
    "temperature": (-60.0, 1500.0, "°C"),
    "speed": (0.0, 100.0, "m/s"),
    "clamp_force": (100.0, 500e3, "N"),
}
"""Middle values outside cannot be what the map says."""
MIX_UPS = {
    "friction": ((0.01, "%"),),
    "speed": ((1 / 3.6, "km/h"),),
    "clamp_force": ((1e3, "kN"), (1e-3, "mN")),
}
"""Factors by which one stop differs from the others if its unit is another."""
KELVIN = 273.15
FASTEST = 55.0
"""Rubbing speed of a train at 360 km/h, about [m/s]."""


def whole_file_problems(signals: Signals) -> list[Problem]:
    """Return a problem for each channel that stands still from first to last sample."""
    problems = []
    for name, values in signals.items():
        known = values[np.isfinite(values)]
        if name != "stop" and len(known) > 1 and np.ptp(known) == 0.0:
            what = "stands still throughout; is the sensor connected?"
            problems.append(Problem(name, what, f"{known[0]:.6g} in all samples"))
    return problems


def what_is_wrong(
    label: str, time: FloatArray, quantities: Signals, cutting: Cutting
) -> Problem | np.ndarray:
    """Return why a stop cannot be used, or which of its samples count."""
    force, speed, friction = (quantities[n] for n in ("clamp_force", "speed", "friction"))
    measured = [values for values in quantities.values() if np.isfinite(values).any()]
    kept = np.isfinite(friction)
    for values in measured:
        kept = kept & np.isfinite(values)
    if np.isfinite(force).any():
        greatest = float(np.nanmax(np.abs(force)))
        if greatest < cutting.least_force:
            allowed = f"{cutting.least_force:g} N or more"
            return Problem(label, "has no braking", f"at most {greatest:.4g} N", allowed)
        # while the force builds up, torque and force do not belong to the same moment
        kept &= np.abs(force) > 0.15 * np.nanquantile(np.abs(force), 0.9)
    if np.isfinite(speed).any():
        kept &= np.abs(speed) >= cutting.least_speed
    if kept.sum() < cutting.least_samples:
        got, allowed = f"{int(kept.sum())}", f"{cutting.least_samples} or more"
        return Problem(label, "has too few samples that count", got, allowed)
    for name, values in quantities.items():
        problem = _implausible(label, name, values[kept])
        if problem is not None:
            return problem
    if np.ptp(friction[kept]) == 0.0:
        return Problem(label, "the friction stands still", f"{friction[kept][0]:.6g} throughout")
    # a logarithm is taken of it
    return np.asarray(np.flatnonzero(kept & (friction > 0)))


def _implausible(label: str, name: str, values: FloatArray) -> Problem | None:
    if not np.isfinite(values).all():
        return None
    middle = float(np.median(values))
    low, high, unit = PLAUSIBLE[name]
    words = name.replace("_", " ")
    if middle < 0.0 and name != "temperature":
        cure = "scale = -1 for its channel"
        return Problem(label, f"the {words} is negative while braking", f"{middle:.4g} {unit}",
                       cure=cure)  # fmt: skip
    if low <= middle <= high:
        return None
    got = f"{middle:.4g} {unit}".strip()
    allowed = f"{low:g} to {high:g} {unit}".strip()
    return Problem(label, f"the {words} cannot be right", got, allowed, "another unit in the map")


def odd_one_out(stops: list[Signals], labels: list[str]) -> dict[int, Problem]:
    """Return the stops in which a quantity has another unit than in the others, or stands still.

    Examples
    --------
    >>> force = [20e3 + 500.0 * np.arange(9)] * 5 + [np.linspace(20.0, 24.0, 9)]
    >>> stops = [{"clamp_force": one} for one in force]
    >>> str(odd_one_out(stops, [f"stop {k}" for k in range(6)])[5])[:62]
    'stop 5: the clamp force looks like kN where the others have N;'
    """
    found: dict[int, Problem] = {}
    for name in stops[0] if len(stops) >= 3 else ():
        middles = np.array([float(np.median(one[name])) for one in stops])
        moves = np.array([float(np.ptp(one[name])) for one in stops])
        highs = np.array([float(np.max(one[name])) for one in stops])
        if not np.isfinite(middles).all():
            continue
        for k, middle in enumerate(middles):
            others = np.delete(middles, k)
            problem = _other_unit(labels[k], name, middle, others)
            if name == "speed" and highs[k] < FASTEST:
                problem = None  # it may well be a stop from a higher speed
            if name == "temperature":
                least = float(np.min(stops[k][name]))
                problem = _kelvin(labels[k], least, middle, others, np.delete(highs, k))
            still = name == "temperature" and moves[k] == 0.0 < np.median(moves)
            if problem is None and still:
                problem = Problem(labels[k], "the temperature stands still", f"{middle:.4g} °C")
            if problem is not None:
                found.setdefault(k, problem)
    return found


def _other_unit(label: str, name: str, middle: float, others: FloatArray) -> Problem | None:
    low, high = np.quantile(others, [0.1, 0.9])
    unit = PLAUSIBLE[name][2]
    words = name.replace("_", " ")
    got = f"{middle:.4g} against {low:.4g} to {high:.4g}"
    if low / 2.5 <= middle <= high * 2.5:
        return None
    for factor, other in MIX_UPS.get(name, ()):
        if low / 2.0 <= middle * factor <= high * 2.0:
            what = f"the {words} looks like {other} where the others have {unit or 'plain numbers'}"
            return Problem(label, what, got, cure="convert it, or leave the stop out")
    return None


def _kelvin(
    label: str, least: float, middle: float, others: FloatArray, highs: FloatArray
) -> Problem | None:
    """Return a problem if a stop lies above all others, and among them once 273.15 is taken off."""
    low, high = float(others.min()), float(others.max())
    if least <= highs.max() or not low - 30.0 <= middle - KELVIN <= high + 30.0:
        return None
    what = "the temperature looks like K where the others have °C"
    got = f"{middle:.4g} against {low:.4g} to {high:.4g}"
    return Problem(label, what, got, cure="convert it, or leave the stop out")
