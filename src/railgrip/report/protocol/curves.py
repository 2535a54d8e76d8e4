"""The few curves of a run that a protocol draws, thinned to what a page can show."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.control.contract import VENT
from railgrip.report.view import Array, View

POINTS = 120
"""Points of a curve: a protocol holds hundreds of runs."""


class Curves(NamedTuple):
    """One run, in the units of the page: km/h, s, m, %, bar.

    Attributes
    ----------
    time, distance : list of float
        Axes of all others.
    train, reference, slowest, fastest : list of float
        Speeds; of the slowest and the fastest wheel.
    slip : list of float
        Of the axle that slides most, against the reference speed.
    pressure, least_pressure, venting : list of float
        Mean and least cylinder pressure; share of the valves that vent.
    used, available : list of float
        Mean adhesion over the axles.
    reservoir : list of float
        Least reservoir pressure; empty without reservoirs.
    ended_well : bool
        Whether the train did what was asked.
    """

    time: list[float]
    distance: list[float]
    train: list[float]
    reference: list[float]
    slowest: list[float]
    fastest: list[float]
    slip: list[float]
    pressure: list[float]
    least_pressure: list[float]
    venting: list[float]
    used: list[float]
    available: list[float]
    reservoir: list[float]
    ended_well: bool


def curves_of(view: View, ended_well: bool) -> Curves:
    """Return the curves of a run.

    Parameters
    ----------
    view : View
        The run, with traces.
    ended_well : bool
        Whether the train did what was asked.
    """
    n = len(view.time)
    places = np.unique(np.linspace(0, n - 1, min(POINTS, n)).astype(int))
    widths = np.diff(np.append(places, n))

    def peak(values: Array, least: bool = False) -> Array:
        """Return the least or greatest of each stretch, so that no peak is thinned away."""
        pick = np.fmin if least else np.fmax
        return np.asarray(pick.reduceat(values, places))

    def mean(values: Array) -> Array:
        return np.add.reduceat(np.nan_to_num(values), places) / widths

    wheel = view.get("wheel_speed")
    pressure = view.get("brake_cylinder_pressure") * 1e-5
    vents = (view.get("dump_valve") == VENT).mean(axis=0)
    reservoir = (
        _short(peak(np.nanmin(view.get("reservoir_pressure"), axis=0) * 1e-5, least=True), 2)
        if view.has("reservoir_pressure")
        else []
    )
    return Curves(
        time=_short(view.time[places], 2),
        distance=_short(view.distance[places], 1),
        train=_short(view.get("train_speed")[places] * 3.6, 1),
        reference=_short(view.get("reference_speed")[places] * 3.6, 1),
        slowest=_short(peak(wheel.min(axis=0), least=True) * 3.6, 1),
        fastest=_short(peak(wheel.max(axis=0)) * 3.6, 1),
        slip=_short(peak(np.nan_to_num(view.slip[view.worst_axle])) * 100, 1),
        pressure=_short(mean(pressure.mean(axis=0)), 2),
        least_pressure=_short(peak(pressure.min(axis=0), least=True), 2),
        venting=_short(mean(vents) * 100, 1),
        used=_short(mean(np.nanmean(view.get("adhesion_used"), axis=0)), 4),
        available=_short(mean(np.nanmean(view.get("adhesion_available"), axis=0)), 4),
        reservoir=reservoir,
        ended_well=ended_well,
    )


def _short(values: Any, decimals: int) -> list[float]:
    return [round(float(value), decimals) for value in values]
