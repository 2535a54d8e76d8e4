"""A measurement of a pad → stops in SI for the fit, and a sentence for what was left out."""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.signal import butter, sosfiltfilt

from railgrip.core.errors import Problem, RailgripError
from railgrip.io.measured.columns import Column, read_columns
from railgrip.io.measured.pad_channels import (
    QUANTITIES,
    PadChannel,
    PadChannelMap,
    read_pad_channels,
)
from railgrip.io.measured.stop_checks import odd_one_out, what_is_wrong, whole_file_problems
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit import PadStops
from railgrip.scenario.conversion import conversion
from railgrip.scenario.files import printable

Signals = dict[str, FloatArray]


class PadMeasurement(NamedTuple):
    """What a file gave.

    Attributes
    ----------
    stops : PadStops
        Samples that count.
    labels : list of str
        Name of each stop.
    problems : list of Problem
        What was left out or looks wrong.
    rows : int
        How many rows were read.
    """

    stops: PadStops
    labels: list[str]
    problems: list[Problem]
    rows: int


def read_pad_stops(
    path: str | os.PathLike[str],
    channels: PadChannelMap | str | os.PathLike[str],
    progress: Callable[[int], None] | None = None,
) -> PadMeasurement:
    """Read measured stops of a pad.

    Parameters
    ----------
    path : path
        CSV, Parquet, MDF4 or TDMS.
    channels : PadChannelMap or path
        Which channel is what.
    progress : callable, optional
        Told the number of rows read so far.

    Returns
    -------
    PadMeasurement
        Stops that can be used; a problem for each that cannot, and for each channel that cannot.

    Raises
    ------
    RailgripError
        What stands in the way of all: ``stops.csv: has no channel 'mu'; known: …``, ``stops.mf4:
        clamp_force: the file says 'kN', the map 'N'``, ``stops.csv: holds no stop that can be
        used``, followed by why.
    """
    where = printable(str(path), 300)
    wanted = channels if isinstance(channels, PadChannelMap) else read_pad_channels(channels)
    columns = read_columns(path, wanted, progress)
    _refuse_other_units(where, wanted, columns)
    time, signals, notes = _on_one_clock(where, wanted, columns)
    notes += whole_file_problems(signals)
    stops, labels, more = _stops(where, wanted, time, signals)
    notes += more
    if not labels:
        raise RailgripError([Problem(where, "holds no stop that can be used"), *notes])
    return PadMeasurement(stops, labels, notes, len(time))


def _refuse_other_units(where: str, wanted: PadChannelMap, columns: dict[str, Column]) -> None:
    """Refuse channels whose unit in the file is another than in the map."""
    problems = []
    for channel in wanted.channel:
        told = columns[channel.signal].unit.strip()
        target = QUANTITIES[channel.signal]
        there = conversion(told, target) if told else None
        ours = conversion(channel.unit, target)
        if there is not None and ours is not None and not np.allclose(there, ours, rtol=1e-6):
            what = f"the file says '{printable(told)}', the map '{channel.unit}'"
            problems.append(Problem(f"{where}: {channel.signal}", what, cure="mend the map"))
    if problems:
        raise RailgripError(problems)


def _on_one_clock(
    where: str, wanted: PadChannelMap, columns: dict[str, Column]
) -> tuple[FloatArray, Signals, list[Problem]]:
    """Return all channels in SI on the clock of the friction, gaps as NaN."""
    first = next(one for one in ("pad_friction", "brake_torque", "brake_force") if one in columns)
    factor, offset = wanted.time.si()
    clock = columns[first].time * factor + offset
    signals: Signals = {}
    problems = []
    for channel in wanted.channel:
        column = columns[channel.signal]
        scale, base = channel.si()
        values = column.values * scale + base
        if len(column.time) != len(clock) or not np.array_equal(column.time, columns[first].time):
            values = _moved(column.time * factor + offset, values, clock, channel)
        signals[channel.signal] = values
        missing = int(np.isnan(values).sum())
        if missing:
            got = f"{missing} of {len(values)} samples"
            problems.append(Problem(channel.signal, "has gaps; they were left out", got))
    if not np.isfinite(clock).all():
        raise RailgripError(Problem(where, "the time has gaps"))
    return clock, signals, problems


def _moved(
    time: FloatArray, values: FloatArray, clock: FloatArray, channel: PadChannel
) -> FloatArray:
    good = np.isfinite(time) & np.isfinite(values)
    time, values = time[good], values[good]
    if len(time) < 2:
        return np.full(len(clock), np.nan)
    order = np.argsort(time, kind="stable")
    if channel.signal == "stop":
        place = np.clip(np.searchsorted(time[order], clock, side="right") - 1, 0, None)
        return np.asarray(values[order][place])
    return np.interp(clock, time[order], values[order], left=np.nan, right=np.nan)


def _stops(
    where: str, wanted: PadChannelMap, time: FloatArray, signals: Signals
) -> tuple[PadStops, list[str], list[Problem]]:
    problems: list[Problem] = []
    good: list[tuple[str, FloatArray, Signals]] = []
    for label, piece in _pieces(wanted, time, signals, problems):
        some = {name: values[piece] for name, values in signals.items()}
        quantities = _quantities(wanted, some)
        reason = what_is_wrong(label, time[piece], quantities, wanted.stops)
        if isinstance(reason, Problem):
            problems.append(reason)
            continue
        counted = {name: values[reason] for name, values in quantities.items()}
        good.append((label, *_resampled(wanted, time[piece][reason], counted)))
    odd = odd_one_out([quantities for _, _, quantities in good], [label for label, _, _ in good])
    problems += odd.values()
    good = [one for k, one in enumerate(good) if k not in odd]
    number = np.concatenate(
        [np.full(len(t), k) for k, (_, t, _) in enumerate(good)] or [np.empty(0)]
    )
    flat = [np.concatenate([t for _, t, _ in good] or [np.empty(0)])]
    for name in ("friction", "temperature", "speed", "clamp_force"):
        flat.append(np.concatenate([q[name] for _, _, q in good] or [np.empty(0)]))
    return PadStops(number.astype(int), *flat), [label for label, _, _ in good], problems


def _pieces(
    wanted: PadChannelMap, time: FloatArray, signals: Signals, problems: list[Problem]
) -> list[tuple[str, slice]]:
    """Cut where the number of the stop changes, the clock jumps or the brake was released."""
    step = np.diff(time)
    usual = float(np.median(step[step > 0])) if (step > 0).any() else 1.0
    back = np.flatnonzero(step <= 0)
    for k in back[:10]:
        got = f"{time[k + 1]:.6g} s after {time[k]:.6g} s"
        problems.append(Problem("time", f"the clock jumps back after row {k + 1}", got))
    if len(back) > 10:
        problems.append(Problem("time", f"the clock jumps back {len(back) - 10} more times"))
    cuts = (step <= 0) | (step > max(wanted.stops.gap, 3 * usual))
    number = signals.get("stop")
    if number is not None:
        cuts |= np.diff(number) != 0
    elif "clamp_force" in signals:
        braking = np.abs(np.nan_to_num(signals["clamp_force"])) >= wanted.stops.least_force
        cuts |= np.diff(braking.astype(int)) == 1
    edges = [0, *(np.flatnonzero(cuts) + 1).tolist(), len(time)]
    named: dict[str, int] = {}
    pieces = []
    for k, (begin, end) in enumerate(pairwise(edges)):
        label = f"stop {k + 1}" if number is None else f"stop {number[begin]:g}"
        named[label] = named.get(label, 0) + 1
        shown = label if named[label] == 1 else f"{label} part {named[label]}"
        pieces.append((shown, slice(begin, end)))
    return pieces


def _quantities(wanted: PadChannelMap, signals: Signals) -> Signals:
    """Return friction, temperature, speed and clamp force of a piece; NaN where not measured."""
    count = len(next(iter(signals.values())))
    nothing = np.full(count, np.nan)
    radius = wanted.pad.friction_radius or 0.0
    lever = 2.0 * radius / (wanted.pad.wheel_diameter or 1.0)
    force = signals.get("clamp_force", nothing)
    speed = signals.get("rubbing_speed")
    if speed is None:
        speed = signals["train_speed"] * lever if "train_speed" in signals else nothing
    friction = signals.get("pad_friction")
    if friction is None:
        pressing = np.where(np.abs(force) > 1.0, force, np.nan)
        if "brake_torque" in signals:
            friction = signals["brake_torque"] / (pressing * radius)
        else:
            friction = signals["brake_force"] / (pressing * lever)
    # a rig that turns the other way has both the speed and the torque negative
    if np.nanmedian(np.append(speed, np.nan)[:count] if np.isfinite(speed).any() else [1.0]) < 0:
        speed, friction = -speed, -friction
    return {"friction": friction, "temperature": signals.get("disc_temperature", nothing),
            "speed": speed, "clamp_force": force}  # fmt: skip


def _resampled(
    wanted: PadChannelMap, time: FloatArray, quantities: Signals
) -> tuple[FloatArray, Signals]:
    """Filter and thin a stop: means over the new interval, so that nothing is folded down."""
    step = float(np.median(np.diff(time)))
    if wanted.stops.low_pass and wanted.stops.low_pass < 0.45 / step and len(time) > 30:
        sections = butter(2, wanted.stops.low_pass * 2 * step, output="sos")
        quantities = {
            name: np.asarray(sosfiltfilt(sections, values)) if np.isfinite(values).all() else values
            for name, values in quantities.items()
        }
    if not wanted.stops.rate or wanted.stops.rate >= 1.0 / step:
        return time, quantities
    place = np.floor((time - time[0]) * wanted.stops.rate + 1e-9).astype(int)
    _, place = np.unique(place, return_inverse=True)
    counts = np.bincount(place)
    return np.bincount(place, time) / counts, {
        name: np.bincount(place, values) / counts for name, values in quantities.items()
    }
