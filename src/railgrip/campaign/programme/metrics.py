"""What a run of the programme is judged by: name, words in two languages, unit, and how."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from pydantic_core import PydanticCustomError

from railgrip.campaign.programme import answer_measures, measures, slide_measures
from railgrip.campaign.programme.measures import Measured
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario.quantity import Unit
from railgrip.scenario.units import RATIO

METRE = Unit("m", "m", 1.0, "850 m")
SECOND = Unit("s", "s", 1.0, "0.4 s")
SPEED = Unit("m/s", "km/h", 3.6, "5 km/h")
ENERGY = Unit("J", "kJ", 1e-3, "200 kJ")
AIR = Unit("m^3", "l", 1e3, "500 l")
PRESSURE = Unit("Pa", "bar", 1e-5, "4.5 bar")
RISE = Unit("K", "K", 1.0, "300 K")
CELSIUS = Unit("degC", "°C", 1.0, "350 degC")
FLAT = Unit("m", "mm", 1e3, "30 mm")
PER_CENT = Unit("", "%", 100.0, "25 %")
SQUARE = Unit("m/s^2", "m/s²", 1.0, "1.1 m/s^2")


class JudgingMetric(NamedTuple):
    """One figure of a run.

    Attributes
    ----------
    name, label, label_de : str
        In files; in words.
    unit : Unit
        What it is held and spoken in.
    of : callable
        From what was measured to the figure in SI; NaN where a run has none.
    """

    name: str
    label: str
    label_de: str
    unit: Unit
    of: Callable[[Measured], float]

    def read(self, value: Any, where: str) -> float:
        """Return a limit in SI.

        Raises
        ------
        RailgripError
            ``test.W3.limit.fast_lock.greatest: has no unit; got 0.4; allowed: …``
        """
        allowed = f"a text such as '{self.unit.example}'"
        if self.unit.si and not isinstance(value, str):
            raise RailgripError(Problem(where, "has no unit", got=f"{value}", allowed=allowed))
        try:
            return self.unit.read(value)
        except PydanticCustomError as error:
            what = (error.context or {}).get("what", "cannot be read")
            raise RailgripError(Problem(where, what, got=f"{value}", allowed=allowed)) from None


def _outcome(name: str) -> Callable[[Measured], float]:
    return lambda run: measures.outcome(run, name)


_TABLE: tuple[tuple[str, str, str, Unit, Callable[[Measured], float]], ...] = (
    ("ended_well", "Ended as asked: stopped, or ran its time",
     "Wie verlangt geendet: gehalten, oder die Zeit gefahren", RATIO, measures.ended_well),
    ("stopping_distance", "Stopping distance", "Anhalteweg", METRE, _outcome("stopping_distance")),
    ("corrected_distance", "Deceleration distance, corrected", "Bremsweg, korrigiert", METRE,
     measures.corrected_distance),
    ("extension", "Extension against dry", "Verlängerung gegen trocken", PER_CENT,
     measures.extension),
    ("k_wet", "K_wet of the run", "K_wet des Laufs", RATIO, measures.k_wet),
    ("mean_deceleration", "Mean deceleration", "Mittlere Verzögerung", SQUARE,
     _outcome("mean_deceleration")),
    ("adhesion_utilisation", "Adhesion utilisation", "Kraftschlussausnutzung", PER_CENT,
     _outcome("adhesion_utilisation")),
    ("initial_adhesion", "Initial adhesion, first four axles",
     "Anfangskraftschluss, erste vier Radsätze", RATIO, slide_measures.initial_adhesion),
    ("vehicle_activity", "Slide activity of the first vehicle",
     "Gleitaktivität des ersten Fahrzeugs", PER_CENT, slide_measures.vehicle_activity),
    ("overload", "Time in which the first vehicle asks more than the rail gives",
     "Zeit, in der das erste Fahrzeug mehr verlangt, als die Schiene gibt", PER_CENT,
     slide_measures.overload),
    ("slide_activity", "Slide activity", "Gleitaktivität", PER_CENT, _outcome("slide_activity")),
    ("greatest_slip", "Greatest slip", "Größter Schlupf", PER_CENT, _outcome("greatest_slip")),
    ("fast_lock", "Longest lock above 30 km/h, sound axles",
     "Längstes Blockieren über 30 km/h, gesunde Radsätze", SECOND, slide_measures.fast_lock),
    ("deep_slip", "Longest time beyond slip 0.5 above 30 km/h, sound axles",
     "Längste Zeit über Schlupf 0,5 über 30 km/h, gesunde Radsätze", SECOND,
     slide_measures.deep_slip),
    ("locked_time", "Longest lock", "Längstes Blockieren", SECOND, _outcome("locked_time")),
    ("slid_distance", "Slid distance, worst axle", "Gleitweg, schlechtester Radsatz", METRE,
     _outcome("slid_distance")),
    ("slid_energy", "Slid energy, worst axle", "Gleitarbeit, schlechtester Radsatz", ENERGY,
     _outcome("slid_energy")),
    ("flat_length", "Wheel flat, estimate", "Flachstelle, geschätzt", FLAT,
     _outcome("flat_length")),
    ("flat_cost", "Cost of wheel flats", "Kosten der Flachstellen", RATIO, measures.flat_cost),
    ("air_per_axle", "Air used, an axle", "Luftverbrauch je Radsatz", AIR, measures.air_per_axle),
    ("least_reservoir", "Least reservoir pressure", "Kleinster Behälterdruck", PRESSURE,
     measures.least_reservoir),
    ("reapplication_time", "Brake back after adhesion returns",
     "Bremse wieder da nach Rückkehr des Kraftschlusses", SECOND,
     answer_measures.reapplication_time),
    ("released_time", "Longest time without brake, sound axles",
     "Längste Zeit ohne Bremse, gesunde Radsätze", SECOND, answer_measures.released_time),
    ("reference_error", "Greatest error of the reference speed",
     "Größter Fehler der Referenzgeschwindigkeit", SPEED, answer_measures.reference_error),
    ("alarm_delay", "Alarm of a faulty axle, after 50 km/h",
     "Meldung des gestörten Radsatzes, nach 50 km/h", SECOND, answer_measures.alarm_delay),
    ("false_alarms", "Axles reported without fault", "Radsätze ohne Grund gemeldet", RATIO,
     answer_measures.false_alarms),
    ("least_vent_speed", "Least speed at which a valve vents",
     "Kleinste Geschwindigkeit mit Entlüften", SPEED, answer_measures.least_vent_speed),
    ("unbraked_at_stand", "Axles without brake at a stand", "Radsätze ohne Bremse im Stand", RATIO,
     answer_measures.unbraked_at_stand),
    ("creep_at_stand", "Way after the stop", "Weg nach dem Anhalten", METRE,
     answer_measures.creep_at_stand),
    ("flash_temperature", "Greatest flash temperature rise", "Größte Blitztemperaturerhöhung",
     RISE, _outcome("flash_temperature")),
    ("disc_temperature", "Greatest disc temperature", "Größte Scheibentemperatur", CELSIUS,
     _outcome("disc_temperature")),
    ("range_switches", "Switches of the slip range", "Wechsel des Schlupfbereichs", RATIO,
     slide_measures.range_switches),
    ("valve_cycles", "Dump valve cycles, all axles", "Schaltspiele der Gleitschutzventile", RATIO,
     _outcome("valve_cycles")),
)  # fmt: skip

METRICS: dict[str, JudgingMetric] = {row[0]: JudgingMetric(*row) for row in _TABLE}
"""Every metric that comes with railgrip."""


def all_metrics(own: dict[str, str], folder: Path) -> dict[str, JudgingMetric]:
    """Return the metrics that come with railgrip, and a profile's own.

    Parameters
    ----------
    own : dict
        Name → ``file.py:function``. The function takes the dataset of one run and returns a
        number; its docstring's first line is the label, its attribute ``unit`` (SI, as "s") the
        unit.
    folder : Path
        Where relative file names begin.

    Raises
    ------
    RailgripError
        ``metric.hold: no such file; …``
    """
    found = dict(METRICS)
    for name, place in own.items():
        where = f"metric.{name}"
        if name in METRICS:
            raise RailgripError(Problem(where, "is the name of a metric that railgrip has"))
        function = _function(place, folder, where)
        label = (function.__doc__ or name).strip().splitlines()[0].rstrip(".")
        si = str(getattr(function, "unit", ""))
        unit = Unit(si, si, 1.0, f"1 {si}".rstrip())
        found[name] = JudgingMetric(name, label, label, unit, _guarded(function, where))
    return found


def metric(metrics: dict[str, JudgingMetric], name: str, where: str) -> JudgingMetric:
    """Return a metric by name.

    Raises
    ------
    RailgripError
        ``test.W3.limit: metric 'fast_lok' unknown; known: …; did you mean 'fast_lock'?``
    """
    if name not in metrics:
        raise RailgripError(unknown_name(where, "metric", name, metrics))
    return metrics[name]


def _function(place: str, folder: Path, where: str) -> Callable[[Any], float]:
    file, colon, name = place.rpartition(":")
    path = folder / file
    if not colon or not file.endswith(".py"):
        raise RailgripError(Problem(where, "is not of the form file.py:function", got=f"'{place}'"))
    if not path.is_file():
        raise RailgripError(Problem(where, "no such file", got=str(path)))
    spec = importlib.util.spec_from_file_location(f"railgrip_metric_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise RailgripError(Problem(where, "cannot be loaded", got=str(path)))
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        raise RailgripError(
            Problem(where, "cannot be loaded", got=f"{type(error).__name__}: {error}")
        ) from None
    function = getattr(module, name, None)
    if not callable(function):
        raise RailgripError(Problem(where, f"{path.name} has no function '{name}'"))
    found: Callable[[Any], float] = function
    return found


def _guarded(function: Callable[[Any], float], where: str) -> Callable[[Measured], float]:
    def of(run: Measured) -> float:
        try:
            return float(function(run.view.dataset.isel(run=run.view.run)))
        except Exception as error:
            raise RailgripError(
                Problem(where, "failed", got=f"{type(error).__name__}: {error}")
            ) from None

    return of
