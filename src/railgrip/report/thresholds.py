"""The slip thresholds of a controller, for drawing."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from railgrip.report.view import Array, View


def thresholds(view: View, given: Mapping[str, float] | None = None) -> dict[str, Array]:
    """Return each threshold as a slip over time, a share.

    Parameters
    ----------
    view : View
        The run.
    given : mapping, optional
        Parameter name → value; without it those of the dataset's attribute
        ``wsp_parameters``, else of the scenario, are taken. ``slip_speed_…`` are speeds in
        m/s, other ``slip_…`` are shares between 0 and 1; the rest is not drawn.
        ``slip_speed_upper_floor`` is the floor of ``slip_upper``.

    Returns
    -------
    dict
        Parameter name in words → slip (time).

    Notes
    -----
    A slip speed becomes a slip by division by the reference speed, so it is a curve.
    """
    speeds, shares = _sorted(given if given is not None else _of(view))
    reference = view.get("reference_speed" if view.has_reference else "train_speed")
    known = np.where(reference > 3 / 3.6, reference, np.nan)
    drawn: dict[str, Array] = {}
    for name, share in shares.items():
        floor = speeds.pop(name.replace("slip_", "slip_speed_", 1) + "_floor", 0.0)
        curve = np.maximum(share, floor / known)
        drawn[name.replace("_", " ")] = np.where(curve < 1, curve, np.nan)
    for name, speed in speeds.items():
        curve = speed / known
        drawn[name.replace("_", " ")] = np.where(curve < 1, curve, np.nan)
    return drawn


def _sorted(parameters: Mapping[str, Any]) -> tuple[dict[str, float], dict[str, float]]:
    """Return the parameters that are slip speeds, and those that are shares."""
    speeds: dict[str, float] = {}
    shares: dict[str, float] = {}
    for name, value in parameters.items():
        if not isinstance(value, int | float) or isinstance(value, bool) or value <= 0:
            continue
        if name.startswith("slip_speed"):
            speeds[name] = float(value)
        elif name.startswith("slip_") and value < 1:
            shares[name] = float(value)
    return speeds, shares


def _of(view: View) -> Mapping[str, Any]:
    raw = view.dataset.attrs.get("wsp_parameters")
    if raw:
        read = json.loads(raw) if isinstance(raw, str) else raw
        return read if isinstance(read, Mapping) else {}
    wsp = view.scenario.get("wsp")
    parameters = wsp.get("parameters") if isinstance(wsp, Mapping) else None
    return parameters if isinstance(parameters, Mapping) else {}
