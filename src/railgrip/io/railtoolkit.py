"""Reads trains and rolling stock of railtoolkit (YAML, schema 2022.05)."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from railgrip.io.checked import checked
from railgrip.io.railtoolkit_document import document_of, refuse
from railgrip.scenario.point_train import PointTrain

_PER_MILLE = 9.81e-3
_WIND = 15 / 3.6
"""Head wind that the air resistance counts in, m/s."""
_HUNDRED = 100 / 3.6
_BRAKING = {False: 0.225, True: 0.375}
"""Deceleration of freight and passenger trains where a file names none, m/s²."""
_PASSENGER = ("passenger", "multiple unit")
_PULLING = ("traction unit", "multiple unit")


def read_railtoolkit_train(
    path: str | os.PathLike[str],
    formation: Sequence[str] | None = None,
    vehicles: Sequence[str | os.PathLike[str]] = (),
) -> PointTrain:
    """Return a train that is put together from vehicles.

    Parameters
    ----------
    path : str or path
        A rolling stock file with ``vehicles`` and, unless a formation is given, ``trains``.
    formation : sequence of str, optional
        Ids of the vehicles from the front; absent: the first train of the file.
    vehicles : sequence of paths
        Further files in which vehicles of the formation stand.

    Returns
    -------
    train : PointTrain
        Loaded to the load limit; the tractive effort holds from entry to entry ("held").

    Raises
    ------
    RailgripError
        ``train.yaml: formation: vehicle 'Facs125' unknown; known: DB_V90, Facs124``

    Notes
    -----
    With coefficients in ‰, the mass m_t on driven axles, and V = v/(100 km/h), W = 15 km/h/(100
    km/h): traction and multiple units g/1000 [base m_t + rolling (m − m_t) + air m (V + W)²] with
    their empty mass m; passenger coaches g/1000 m [base + rolling V + air (V + W)²] and freight
    wagons g/1000 m [base + air V²] with their loaded mass (formulas of Wende, Sauthoff, Strahl).
    Rotating masses are weighted by the empty masses.

    References
    ----------
    .. [1] railtoolkit, TrainRuns.jl and rolling-stock-data, schema 2022.05.
    .. [2] D. Wende, "Fahrdynamik des Schienenverkehrs", Teubner 2003, pp. 151–153.

    Examples
    --------
    >>> from railgrip.data import path
    >>> train = read_railtoolkit_train(path("point_trains", "local"))
    >>> train.mass, round(train.resistance.constant)
    (88000.0, 1704)
    """
    file = Path(path)
    document = document_of(file, "rolling-stock")
    known = _vehicles(document, file)
    for other in vehicles:
        known |= _vehicles(document_of(Path(other), "rolling-stock"), Path(other))
    title = ""
    if formation is None:
        trains = document.get("trains")
        if not isinstance(trains, list) or not trains or not isinstance(trains[0], dict):
            refuse(file, "trains", "is missing", cure="name a formation")
        formation, title = trains[0].get("formation") or (), str(trains[0].get("name", ""))
    if not isinstance(formation, Sequence) or isinstance(formation, str):
        refuse(file, "formation", "must be a list of vehicles")
    missing = [word for word in map(str, formation) if word not in known]
    if missing or not formation:
        refuse(
            file, "formation", f"vehicle '{missing[0]}' unknown" if missing else "is empty",
            allowed=", ".join(sorted(known)),
        )  # fmt: skip
    return checked(PointTrain, _train(file, title, [known[str(word)] for word in formation]), file)


def _train(file: Path, title: str, cars: list[dict[str, Any]]) -> dict[str, Any]:
    def number(car: dict[str, Any], key: str, default: float | None = None) -> float:
        value = car.get(key, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or abs(value) > 1e9:
            refuse(file, f"vehicle {car.get('id')}.{key}", "must be a number", got=repr(value))
        return float(value)

    is_passenger = any(car.get("vehicle_type") in _PASSENGER for car in cars)
    mass = loaded = turning = constant = linear = steep = 0.0
    for car in cars:
        empty = 1e3 * number(car, "mass")
        full = empty + 1e3 * number(car, "load_limit", 0.0)
        base, rolling = number(car, "base_resistance", 0.0), number(car, "rolling_resistance", 0.0)
        air = number(car, "air_resistance", 0.0) / _HUNDRED**2
        if car.get("vehicle_type") in _PULLING:
            driven = 1e3 * number(car, "mass_traction", empty / 1e3)
            constant += base * driven + rolling * (empty - driven) + air * empty * _WIND**2
            linear += 2.0 * air * empty * _WIND
            steep += air * empty
        elif is_passenger:
            constant += (base + air * _WIND**2) * full
            linear += (rolling / _HUNDRED + 2.0 * air * _WIND) * full
            steep += air * full
        else:
            constant += base * full
            steep += air * full
        mass, loaded = mass + empty, loaded + full
        turning += (number(car, "rotation_mass", 1.06) - 1.0) * empty
    efforts = Counter(id(car) for car in cars if car.get("tractive_effort"))
    pulling = {id(car): car for car in cars if car.get("tractive_effort")}
    if len(pulling) != 1:
        refuse(file, "tractive_effort", "must stand at one kind of vehicle", got=f"{len(pulling)}")
    ((key, engine),) = pulling.items()
    rows = engine["tractive_effort"]
    if (
        not isinstance(rows, list)
        or any(not isinstance(row, list) or len(row) != 2 for row in rows)
        or any(isinstance(x, bool) or not isinstance(x, int | float) for row in rows for x in row)
    ):
        refuse(file, "tractive_effort", "must hold pairs of speed and force")
    braking = [-number(car, "a_braking") for car in cars if "a_braking" in car]
    return {
        "title": title or str(engine.get("name", "")),
        "source": "railtoolkit, schema 2022.05",
        "mass": loaded,
        "rotating": turning / mass,
        "length": sum(number(car, "length", 0.0) for car in cars),
        "max_speed": min(number(car, "speed_limit") for car in cars) / 3.6,
        "resistance": {
            "constant": _PER_MILLE * constant,
            "linear": _PER_MILLE * linear,
            "quadratic": _PER_MILLE * steep,
        },
        "effort": {
            "table": [{"speed": v / 3.6, "force": efforts[key] * force} for v, force in rows],
            "between": "held",
        },
        "max_deceleration": min(braking, default=_BRAKING[is_passenger]),
    }


def _vehicles(document: dict[str, Any], file: Path) -> dict[str, dict[str, Any]]:
    cars = document.get("vehicles")
    if not isinstance(cars, list) or not all(isinstance(car, dict) for car in cars):
        refuse(file, "vehicles", "is missing")
    return {str(car.get("id")): car for car in cars}
