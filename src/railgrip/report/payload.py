"""A run as compact JSON for the page: thinned traces, two bytes a number."""

from __future__ import annotations

import base64
from typing import Any, Protocol

import numpy as np

from railgrip.report.thin import Thinner
from railgrip.report.thresholds import thresholds
from railgrip.report.units import shown
from railgrip.report.view import Array, View

TRAIN = ("train_speed", "reference_speed", "acceleration", "brake_demand")
AXLE = (
    "wheel_speed",
    "brake_cylinder_pressure",
    "adhesion_used",
    "adhesion_available",
    "adhesion_asked",
    "dynamic_force",
    "flash_temperature",
    "disc_temperature",
    "dump_valve",
    "unit_reference_speed",
)
AXLE_COMPARED = (*AXLE, "rail_friction", "contact_force")
RAIL = ("rail_friction_before", "rail_friction_after", "rail_energy", "rail_sand")
GHOST_TRAIN = ("train_speed", "reference_speed", "acceleration")
GHOST_AXLE = ("wheel_speed", "brake_cylinder_pressure", "flash_temperature")
MISSING = 65535
GHOST_POINTS = 1500
COMPARED_LETTERS = 3.2e6
"""Of base64 that a page of several runs spends on their axles' curves."""


class Overlay(Protocol):
    """What a measured stop must offer to be drawn over a run; arrays in SI on one time axis."""

    @property
    def title(self) -> str:
        """Name in legends."""

    @property
    def time(self) -> Array:
        """Time on the run's own time axis, s."""

    @property
    def distance(self) -> Array:
        """Distance on the run's own distance axis, m."""

    @property
    def train(self) -> dict[str, Array]:
        """Signal name → values."""

    @property
    def axles(self) -> dict[str, dict[str, Array]]:
        """Signal name → axle label → values."""


def packed(values: Array) -> dict[str, Any]:
    """Return values as base64 of 16-bit steps between their least and greatest.

    Examples
    --------
    >>> packed(np.array([1.0, 1.0]))
    {'n': 2, 'low': 1.0}
    """
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return {"n": len(values), "low": None}
    low, high = float(finite.min()), float(finite.max())
    if low == high and len(finite) == len(values):
        return {"n": len(values), "low": _short(low)}
    step = (high - low) / (MISSING - 1) or 1.0
    counts = np.where(np.isfinite(values), np.round((values - low) / step), MISSING)
    return {"low": low, "step": step, "u16": _base64(counts.astype("<u2"))}


def plain(values: Array) -> dict[str, Any]:
    """Return values as base64 of 32-bit floats, for axes that must keep their order."""
    return {"f32": _base64(values.astype("<f4"))}


def _base64(values: np.ndarray[Any, Any]) -> str:
    return base64.b64encode(values.tobytes()).decode("ascii")


def _short(value: float) -> float:
    return float(f"{value:.6g}")


def payload(
    view: View, ghosts: dict[str, View] | None = None, measured: Overlay | None = None
) -> dict[str, Any]:
    """Return all that the page draws, in the engineer's units; nothing of a run without traces."""
    if not view.has("train_speed"):
        return {}
    page = whole_run(view, 1.3e6, AXLE, 600)
    page["ghosts"] = []
    for name, other in (ghosts or {}).items():
        less = Thinner(len(other.time), GHOST_POINTS)
        page["ghosts"].append({"name": name, **_run(other, less, GHOST_TRAIN, GHOST_AXLE)})
    if measured is not None:
        page["ghosts"].append(_measured(measured))
    return page


def compared_runs(views: dict[str, View]) -> dict[str, Any]:
    """Return whole runs side by side: any of them can be looked at, the others lie behind it."""
    if not all(view.has("train_speed") for view in views.values()):
        return {}
    budget = max(0.35e6, COMPARED_LETTERS / len(views))
    return {
        "runs": [
            {"name": name, **whole_run(view, budget, AXLE_COMPARED, 400)}
            for name, view in views.items()
        ]
    }


def whole_run(view: View, letters: float, axle: tuple[str, ...], fewest: int) -> dict[str, Any]:
    """Return a run with all that belongs to it, in about so many letters of base64 at 16 axles."""
    axle_signals = [name for name in axle if view.has(name)]
    per_point = len(view.axles) * len(axle_signals) * 2 * 4 / 3
    budget = letters + 40e3 * max(0, len(view.axles) - 16)
    thin = Thinner(len(view.time), int(np.clip(budget / max(per_point, 1.0), fewest, 6000)))
    page = _run(view, thin, TRAIN, tuple(axle_signals))
    page |= {
        "vehicles": view.vehicles,
        "vehicle_of": view.vehicle_of,
        "places": view.places,
        "worst": view.worst_axle if view.has("wheel_speed") else 0,
        "vehicle": {},
        "rail": _rail(view),
        "thresholds": [
            {"name": name, "values": packed(thin(curve * 100))}
            for name, curve in thresholds(view).items()
        ],
    }
    if view.has("reservoir_pressure"):
        bars = view.get("reservoir_pressure") / 1e5
        page["vehicle"]["reservoir_pressure"] = [packed(thin(bar)) for bar in bars]
    return page


def _run(
    view: View, thin: Thinner, train: tuple[str, ...], axle: tuple[str, ...]
) -> dict[str, Any]:
    def shown_values(name: str) -> Array:
        values = view.get(name) * shown(name).factor
        if name == "contact_force":
            return -values  # of the brake, as it is read: against the train's way is positive
        return np.abs(values) if name == "adhesion_used" else values

    return {
        "axles": view.axles,
        "time": plain(thin.axis(view.time)),
        "distance": plain(thin.axis(view.distance)),
        "train": {
            name: packed(thin(shown_values(name)))
            for name in train
            if view.has(name) and (name != "reference_speed" or view.has_reference)
        },
        "axle": {
            name: [packed(thin(row)) for row in shown_values(name)]
            for name in axle
            if view.has(name)
        },
    }


def _measured(stop: Overlay) -> dict[str, Any]:
    thin = Thinner(len(stop.time), 2 * GHOST_POINTS)

    def pack(name: str, values: Array) -> dict[str, Any]:
        return packed(thin(values * shown(name).factor))

    labels = list(dict.fromkeys(label for rows in stop.axles.values() for label in rows))
    nothing = np.full(len(stop.time), np.nan)
    return {
        "name": stop.title,
        "measured": True,
        "axles": labels,
        "time": plain(thin.axis(stop.time)),
        "distance": plain(thin.axis(stop.distance)),
        "train": {name: pack(name, values) for name, values in stop.train.items()},
        "axle": {
            name: [pack(name, rows.get(label, nothing)) for label in labels]
            for name, rows in stop.axles.items()
        },
    }


def _rail(view: View) -> dict[str, Any]:
    present = [name for name in RAIL if view.has(name) and (view.get(name) > 0).any()]
    if not present or not view.has("train_position"):
        return {}
    x = np.asarray(view.dataset["cell"].values, dtype=np.float64) - view.start
    energy = view.get("rail_energy") if view.has("rail_energy") else np.zeros_like(x)
    touched = np.flatnonzero(energy > 0)
    first = touched[0] if len(touched) else int(np.searchsorted(x, 0.0))
    run_over = np.flatnonzero(x <= view.distance[-1] + 20.0)
    last = run_over[-1] if len(run_over) else len(x) - 1
    part = slice(max(0, first - 5), last + 1)
    thin = Thinner(len(x[part]), 4000)
    return {
        "x": plain(thin.axis(x[part])),
        **{name: packed(thin(view.get(name)[part] * shown(name).factor)) for name in present},
    }
