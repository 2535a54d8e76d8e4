"""What a run amounts to, in the units and words of a brake engineer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from railgrip.core.status import RunStatus, sentence
from railgrip.report.units import shown, written
from railgrip.report.view import View, dataset_of

if TYPE_CHECKING:
    from collections.abc import Sequence


class Metric(NamedTuple):
    """One figure of a run.

    Attributes
    ----------
    name, label : str
        Name in files; name in words.
    value : float
        In `unit`; NaN where the run has none.
    unit : str
        The engineer's unit.
    text : str
        Value with unit, and the axle it belongs to.
    """

    name: str
    label: str
    value: float
    unit: str
    text: str


class Source(NamedTuple):
    """Where a metric comes from: a variable and how its axles are put together."""

    label: str
    variable: str
    over_axles: str = ""  # "", "greatest" or "sum"


SOURCES: dict[str, Source] = {
    "initial_speed": Source("Initial speed", "initial_speed"),
    "covered_distance": Source("Distance covered", "covered_distance"),
    "final_speed": Source("Speed at the end", "final_speed"),
    "stopping_distance": Source("Stopping distance", "stopping_distance"),
    "deceleration_distance": Source("Deceleration distance", "deceleration_distance"),
    "stopping_time": Source("Stopping time", "stopping_time"),
    "build_up_time": Source("Equivalent build-up time", "build_up_time"),
    "mean_deceleration": Source("Mean deceleration", "mean_deceleration"),
    "adhesion_utilisation": Source("Adhesion utilisation", "adhesion_utilisation"),
    "slide_activity": Source("Slide activity", "slide_activity"),
    "greatest_slip": Source("Greatest slip", "axle_greatest_slip", "greatest"),
    "slide_time": Source("Longest time sliding", "axle_slide_time", "greatest"),
    "greatest_spin": Source("Greatest spin", "axle_greatest_spin", "greatest"),
    "spin_time": Source("Longest time spinning", "axle_spin_time", "greatest"),
    "locked_time": Source("Longest lock", "axle_longest_lock", "greatest"),
    "fast_lock": Source("Longest lock above 30 km/h", "axle_longest_fast_lock", "greatest"),
    "locked_time_total": Source("Locked in all, worst axle", "axle_locked_time", "greatest"),
    "slid_distance": Source("Slid distance, worst axle", "axle_slid_distance", "greatest"),
    "slid_energy": Source("Slid energy, worst axle", "axle_slid_energy", "greatest"),
    "flat_length": Source("Wheel flat, estimate", "axle_flat_length", "greatest"),
    "flash_temperature": Source(
        "Greatest flash temperature rise", "axle_greatest_flash", "greatest"
    ),
    "disc_temperature": Source(
        "Greatest disc temperature", "axle_greatest_disc_temperature", "greatest"
    ),
    "air_used": Source("Air used", "air_used"),
    "valve_cycles": Source("Dump valve cycles, all axles", "axle_valve_cycles", "sum"),
    "energy_balance": Source("Energy balance error", "energy_balance"),
}
"""Every metric by its name, in the order of the report."""

OF_A_STOP = {
    "stopping_distance", "deceleration_distance", "stopping_time", "build_up_time",
    "mean_deceleration", "slide_activity",
}  # fmt: skip
"""What a run that drives and does not stop has not."""

AXLE_COLUMNS: dict[str, str] = {
    "axle_greatest_slip": "Greatest slip",
    "axle_slide_time": "Sliding",
    "axle_greatest_spin": "Greatest spin",
    "axle_spin_time": "Spinning",
    "axle_locked_time": "Locked",
    "axle_longest_lock": "Longest lock",
    "axle_slid_distance": "Slid distance",
    "axle_slid_energy": "Slid energy",
    "axle_flat_length": "Flat (estimate)",
    "axle_greatest_flash": "Flash rise",
    "axle_greatest_disc_temperature": "Disc",
    "axle_valve_cycles": "Valve cycles",
}


def si_value(view: View, name: str) -> tuple[float, str]:
    """Return the value of a metric in SI and the axle it belongs to, NaN where there is none."""
    source = SOURCES[name]
    if not view.has(source.variable):
        return float("nan"), ""
    if not source.over_axles:
        return view.number(source.variable), ""
    values = view.get(source.variable)
    if source.over_axles == "sum":
        return float(np.nansum(values)), ""
    worst = int(np.nanargmax(values))
    return float(values[worst]), view.axles[worst] if values[worst] > 0 else ""


def metrics(result: Any, run: int = 0) -> list[Metric]:
    """Return the figures of a run in the engineer's units.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave.
    run : int
        Which run of the batch.

    Returns
    -------
    list of Metric
        Only those the result carries, in the order of the report.

    Raises
    ------
    RailgripError
        ``run: there is no run 3; allowed: 0 to 0``

    Examples
    --------
    >>> import xarray as xr
    >>> data = xr.Dataset({"stopping_distance": ("run", [1007.04])})
    >>> metrics(data)[0].text
    '1007.0 m'
    """
    view = View(dataset_of(result), run)
    drives_on = view.has("covered_distance") and not view.has("stopping_distance")
    found = []
    for name, source in SOURCES.items():
        if source.variable not in view.dataset or (drives_on and name in OF_A_STOP):
            continue
        value, axle = si_value(view, name)
        how = shown(source.variable)
        text = written(value * how.factor, how) + (f" ({axle})" if axle else "")
        found.append(Metric(name, source.label, value * how.factor, how.unit, text))
    return found


def status_sentence(result: Any, run: int = 0) -> str:
    """Return how the run ended, as a sentence.

    Examples
    --------
    >>> import xarray as xr
    >>> status_sentence(xr.Dataset({"status": ("run", [1])}))
    'The train came to a stand.'
    """
    number = View(dataset_of(result), run).number("status")
    if number != number:
        return ""
    said = str(dataset_of(result).attrs.get("failure", ""))
    failed = int(number) == RunStatus.CONTROLLER_FAILED
    return said if failed and said else sentence(RunStatus(int(number)))


class AxleTable(NamedTuple):
    """Outcomes axle by axle: `rows` (axle label, values) under `heads` with `units`."""

    heads: list[str]
    units: list[str]
    rows: list[tuple[str, list[float]]]
    texts: list[list[str]]


def axle_table(result: Any, run: int = 0) -> AxleTable:
    """Return the outcomes of each axle in the engineer's units."""
    view = View(dataset_of(result), run)
    names = [name for name in AXLE_COLUMNS if name in view.dataset]
    hows = [shown(name) for name in names]
    columns: Sequence[Any] = [
        view.get(name) * how.factor for name, how in zip(names, hows, strict=True)
    ]
    rows, texts = [], []
    for k, label in enumerate(view.axles):
        values = [float(column[k]) for column in columns]
        rows.append((label, values))
        plain = [how._replace(unit="") for how in hows]
        texts.append([written(v, how) for v, how in zip(values, plain, strict=True)])
    heads = [AXLE_COLUMNS[name] for name in names]
    return AxleTable(heads, [how.unit for how in hows], rows, texts)
