"""Lower a scenario whose numbers are arrays over runs: one lowering for a whole batch.

The arithmetic of `engine.lower_train` works on arrays as it works on numbers. What does not (a
patch by Hertz, the calibration of an orifice) is brought here to functions of one number each,
which are read from splines with fixed nodes, so that a run gets the same number in any company.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from railgrip.brake import filling
from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.core.formulas.patch import hertz_1882
from railgrip.engine import layout as at
from railgrip.engine import lower_train as one
from railgrip.engine.lower import _row
from railgrip.engine.plan import FloatArray, Overrides, Plan
from railgrip.scenario.scenario import Scenario

NODES = 129
"""Of a spline; over ±30 % it is exact to 1e-9 where the function is smooth."""
REACH = 0.3
"""Share of its middle to either side that a spline covers."""


@cache
def _spline(function: Callable[[float], float], middle: float) -> Any:
    from scipy.interpolate import CubicSpline

    nodes = middle * np.linspace(1.0 - REACH, 1.0 + REACH, NODES)
    return CubicSpline(nodes, [function(float(node)) for node in nodes])


def along(function: Callable[[float], float], values: Any, middle: float) -> Any:
    """Return a slow smooth function of one number for every value: by spline near the middle."""
    values = np.asarray(values, dtype=float)
    if not values.ndim:
        return function(float(values))
    result = np.asarray(_spline(function, middle)(values), dtype=float)
    for i in np.flatnonzero(np.abs(values / middle - 1.0) > REACH):
        result[i] = function(float(values[i]))
    return result


def is_array(value: Any) -> bool:
    """Whether a number is one for each run."""
    return isinstance(value, np.ndarray) and value.ndim > 0


def vary(plan: Plan, scenario: Scenario, many: Scenario, number: Any) -> tuple[Plan, Overrides]:
    """Return plan and overrides of a batch whose numbers differ from run to run.

    Parameters
    ----------
    plan : Plan
        Of the scenario.
    scenario : Scenario
        With numbers.
    many : Scenario
        The same with arrays (run) in the places of some numbers.
    number : int array (run)
        Each run's number in its campaign.

    Raises
    ------
    TypeError, ValueError
        Where something is decided by the number, so that a batch cannot share it.
    """
    runs = len(number)
    places: list[int] = []
    columns: list[FloatArray] = []

    def note(block: int, names: str, values: dict[str, Any]) -> None:
        for i, name in enumerate(names.split()):
            if is_array(values[name]):
                places.append(block * at.N_PARAMETERS + i)
                columns.append(values[name])

    note(0, at.TRAIN_PARAMETERS, one._train_values(many))
    loads = one.static_loads(many)
    gains = [gain for vehicle in one._transfers(many) for gain in vehicle]
    for i in range(many.train.n_axles):
        note(1 + i, at.AXLE_PARAMETERS, _axle(scenario, many, i, loads[i], gains[i]))
    value = np.stack(columns, axis=1) if columns else np.zeros((runs, 0))
    target = np.array(places, dtype=np.int64)
    changed = plan._replace(
        way=plan.way._replace(**_way(many, runs)),
        faults=plan.faults._replace(happens=_happens(plan, many, runs)),
        formation=plan.formation._replace(vehicle_share=_shares(many, runs)),
    )
    return changed, Overrides(target, np.ascontiguousarray(value), number)


def _axle(scenario: Scenario, many: Scenario, i: int, load: Any, gain: Any) -> dict[str, Any]:
    place, axle = scenario.train.axles()[i], many.train.axles()[i].axle
    isolated: Any = axle.isolated
    if is_array(isolated):
        many = _with_axle(many, i, isolated=False)
    values, _ = _axle_values(scenario, many, i)
    values |= {"STATIC_LOAD": load, "LOAD_TRANSFER": gain}
    geometry = one.contact_geometry(many, i)
    if any(is_array(number) for number in (load, *geometry)):
        values |= _contact(load, gain, geometry, place.axle.wheel_radius)
    else:
        values |= one._contact_values(many, i, load, gain)
    if is_array(isolated):
        for name, number in one.UNBRAKED.items():
            values[name] = np.where(isolated, number, values[name])
    return values


def _with_axle(scenario: Scenario, i: int, **changes: Any) -> Scenario:
    from railgrip.scenario.places import replaced

    place = scenario.train.axles()[i]
    for name, value in changes.items():
        steps = ("train", "vehicle", place.vehicle, "bogie", place.bogie, "axle", place.number)
        scenario = replaced(scenario, (*steps, name), value)
    return scenario


def _axle_values(scenario: Scenario, many: Scenario, i: int) -> tuple[dict[str, Any], Any]:
    """Return the numbers of an axle; orifices are calibrated by splines over the pressure."""
    name = many.train.axles()[i].axle.brake
    brake = many.train.brakes[name] if name is not None else None
    if brake is None or name is None or brake.fill != "orifice":
        return one._axle_values(many, i)
    # with the filling of a straight line everything else comes out; then the orifices
    plain = brake.model_copy(update={"fill": "linear"})
    train = many.train.model_copy(update={"brakes": {**many.train.brakes, name: plain}})
    values, row = one._axle_values(many.model_copy(update={"train": train}), i)
    times = (brake.fill_time, brake.release_time, brake.inshot)
    pressure = values["FULL_PRESSURE"]
    if any(is_array(number) for number in (pressure, *times)):
        if is_array(brake.inshot) or brake.inshot != 0.0:
            raise TypeError("an inshot is calibrated run by run")
        middle = scenario.train.brakes[name].cylinder_pressure
        fill = along(_fill_per_second, pressure, middle) / brake.fill_time
        release = along(_release_per_second, pressure, middle) / brake.release_time
        filled = {"FILL_RATE": fill, "INSHOT_RATE": fill, "INSHOT_PRESSURE": 0.0}
        values |= {**filled, "RELEASE_RATE": release}
    else:
        values |= one._filling_values(brake, pressure)
    valve = one._valve_values(many, brake)
    return {**values, **valve}, row


def _fill_per_second(pressure: float) -> float:
    return filling.distributor(pressure, 1.0, 1.0).fill_rate


def _release_per_second(pressure: float) -> float:
    return filling.distributor(pressure, 1.0, 1.0).release_rate


def _contact(load: Any, gain: Any, geometry: tuple[Any, ...], radius: float) -> dict[str, Any]:
    """Hertz: a patch grows with load^(1/3), and Kalker's slope with its area."""
    if is_array(geometry[1]):
        raise TypeError("the profile of the tread decides the patch run by run")
    functions = _contact_of(*geometry[1:])
    a, slope, still, moving = (along(function, geometry[0], radius) for function in functions)
    grown = np.cbrt(load / 2.0)
    flash = (still * grown**2, moving * grown**3)
    return one.contact_numbers(a * grown, slope * grown**2, flash, load, gain)


@cache
def _contact_of(*shape: float) -> tuple[Callable[[float], float], ...]:
    """Return semi-axis, slope and flash parts under 1 N as functions of the wheel radius."""

    def flash(radius: float) -> tuple[float, float]:
        patch = hertz_1882(1.0, radius, *shape)
        return one.flash_parts(patch.a, patch.b)

    return (
        lambda radius: hertz_1882(1.0, radius, *shape).a,
        lambda radius: kalker_slope(1.0, radius, *shape),
        lambda radius: flash(radius)[0],
        lambda radius: flash(radius)[1],
    )


def _rows(rows: list[list[Any]], runs: int) -> FloatArray:
    """Return (1 or run, row, column) of rows some of whose entries are arrays."""
    if not any(is_array(number) for row in rows for number in row):
        return np.array(rows, dtype=float)[None]
    table = np.empty((runs, len(rows), len(rows[0])))
    for i, row in enumerate(rows):
        for j, number in enumerate(row):
            table[:, i, j] = number
    return table


def _way(many: Scenario, runs: int) -> dict[str, Any]:
    rail, field = many.rail, many.rail.random
    base = _row(rail.condition)
    if field is not None:
        base[0] = field.mean
    spread = np.atleast_1d(np.asarray(field.spread / field.mean if field else 0.0, dtype=float))
    rows: list[list[Any]] = [base, *(_row(patch.condition) for patch in rail.patch)]
    return {"conditions": _rows(rows, runs), "relative_spread": spread}


def _shares(many: Scenario, runs: int) -> FloatArray:
    masses: list[Any] = [
        vehicle.tare + payload
        for vehicle, payload in zip(many.train.vehicle, many.payloads(), strict=True)
    ]
    whole = sum(masses)
    return _rows([[mass / whole for mass in masses]], runs)[:, 0]


def _happens(plan: Plan, many: Scenario, runs: int) -> Any:
    n_axles = many.train.n_axles
    found = [f.happens for f in many.fault for _ in range(n_axles if f.axle == "all" else 1)]
    if not found:
        return plan.faults.happens
    return _rows([found], runs)[:, 0].astype(np.int64)
