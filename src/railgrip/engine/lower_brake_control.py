"""Brake control of a scenario as flat arrays."""

from __future__ import annotations

from typing import Any

import numpy as np

from railgrip.control import brake_control_table as to
from railgrip.control.brake_control_table import BrakeControlParameters
from railgrip.control.limit_rules import N_RULE, NEW, WORN, rule_numbers
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.piecewise_linear import Hinges, hinges_from_points
from railgrip.engine import layout as at
from railgrip.engine.lower_limit_rules import lower_rule
from railgrip.engine.plan import BrakeControlPlan, FloatArray
from railgrip.scenario import brake_control as described
from railgrip.scenario.brakes import FrictionBrake
from railgrip.scenario.friction import ConstantPad, Pad, PiecewisePad
from railgrip.scenario.scenario import Scenario

UNLIMITED = 1e9
"""A jerk that nothing reaches, m/s³."""
_WHEN = {"always": to.ALWAYS, "past_threshold": to.PAST_THRESHOLD}
_DISC = (
    "RING_MASS", "HUB_MASS", "CONDUCTANCE", "DISC_SURFACE", "HEAT_SHARE", "FILM_STILL",
    "FILM_WIND", "EMISSIVITY", "AMBIENT",
)  # fmt: skip


def lower_brake_control(scenario: Scenario, table: FloatArray) -> BrakeControlPlan:
    """Return the brake control of a scenario; `every` is 0 where it has none.

    Parameters
    ----------
    scenario : Scenario
        Complete and checked.
    table : float array (1 + axles, N_PARAMETERS)
        From `lower_train`.

    Raises
    ------
    RailgripError
        "brake_control.period: must be a multiple of the step", "… needs a piecewise or constant
        pad", "… no axle has a friction brake".
    """
    layer = scenario.brake_control
    if layer is None:
        nothing = np.zeros((0, 0))
        return BrakeControlPlan(0, 0.0, 0.0, 0.0, np.zeros(0), nothing, nothing)
    every = layer.period / scenario.run.step
    if abs(every - round(every)) > 1e-6:
        raise RailgripError(
            Problem(
                "brake_control.period",
                "must be a multiple of the step",
                got=f"{layer.period:g} s, step {scenario.run.step:g} s",
            )
        )
    setup = _setup(scenario, layer, table)
    estimator = layer.estimator
    rules = [rule_numbers(lower_rule(rule)) for rule in estimator.rule] if estimator else []
    return BrakeControlPlan(
        every=round(every),
        period=layer.period,
        sensor_lag=estimator.sensor_lag if estimator else 0.0,
        stop_position=layer.stop_at or 0.0,
        parameters=np.array(_parameters(scenario, layer, table, setup), dtype=float),
        rules=np.array(rules).reshape(len(rules), N_RULE),
        setup=setup,
    )


def _column(table: FloatArray, name: str) -> FloatArray:
    column: FloatArray = table[1:, at.AXLE_PARAMETERS.split().index(name)]
    return column


def _setup(scenario: Scenario, layer: described.BrakeControlLayer, table: FloatArray) -> FloatArray:
    axles = scenario.train.axles()
    setup = np.zeros((len(axles), to.N_SETUP))
    first: dict[Any, int] = {}
    worn = layer.estimator is not None and layer.estimator.pads_are == "worn"
    for i, place in enumerate(axles):
        if place.axle.brake is None:
            continue
        brake = scenario.train.brakes[place.axle.brake]
        row = setup[i]
        whole = layer.estimator is not None and layer.estimator.per == "train"
        unit: Any = {
            "axle": (i,),
            "bogie": (place.vehicle, place.bogie),
            "vehicle": (place.vehicle,),
        }[layer.local_unit]
        # brakes with other pads in one unit have an estimate of their own
        unit = ("train",) if whole else unit
        row[to.ESTIMATE_AXLE] = first.setdefault((*unit, brake.pad), i)
        for column, name in (
            (to.FULL_PRESSURE, "FULL_PRESSURE"),
            (to.FULL_FORCE, "FULL_FORCE"),
            (to.CLAMP_PER_PRESSURE, "CLAMP_PER_PRESSURE"),
            (to.CLAMP_OFFSET, "CLAMP_OFFSET"),
            (to.CLAMP_PER_BLOCK, "CLAMP_PER_BLOCK"),
            (to.NOMINAL_TREAD, "TREAD_PER_CLAMP"),
        ):
            row[column] = _column(table, name)[i]
        row[to.PADS] = WORN if worn else NEW
        row[to.BRAKED] = 1.0
        row[to.DISC : to.DISC + len(_DISC)] = [_column(table, name)[i] for name in _DISC]
        row[to.MODEL :] = _model(layer.estimator, brake, row)
    if not first:
        raise RailgripError(
            Problem("brake_control", "has nothing to do: no axle has a friction brake")
        )
    return setup


def _model(
    estimator: described.Estimator | None, brake: FrictionBrake, row: FloatArray
) -> list[float]:
    pad: Pad = brake.pad
    if estimator is not None and estimator.pad is not None:
        pad = estimator.pad
    if isinstance(pad, ConstantPad):
        return [pad.friction, *Hinges(1.0), *Hinges(1.0), *Hinges(1.0)]
    if isinstance(pad, PiecewisePad):
        used = estimator.functions if estimator is not None else ()
        curves = {
            "temperature": pad.temperature, "speed": pad.speed, "clamp_force": pad.clamp_force,
        }  # fmt: skip
        numbers = [pad.reference_friction]
        for name, points in curves.items():
            numbers += hinges_from_points(points) if name in used else Hinges(1.0)
        return numbers
    if estimator is not None:
        raise RailgripError(
            Problem(
                "brake_control.estimator.pad",
                "the estimate needs a piecewise or constant pad",
                got=f"law '{pad.law}' of the train's brake",
                cure="name what is known of the pads, e.g. pad = 'll_block'",
            )
        )
    full = row[to.CLAMP_PER_PRESSURE] * row[to.FULL_PRESSURE] + row[to.CLAMP_OFFSET]
    friction = float(row[to.FULL_FORCE] / (full * row[to.NOMINAL_TREAD]))
    return [friction, *Hinges(1.0), *Hinges(1.0), *Hinges(1.0)]


def _parameters(
    scenario: Scenario,
    layer: described.BrakeControlLayer,
    table: FloatArray,
    setup: FloatArray,
) -> BrakeControlParameters:
    estimator, control = layer.estimator, layer.deceleration
    braked = setup[:, to.BRAKED] > 0.0
    force = setup[braked, to.FULL_FORCE]
    mass = scenario.mass + float(_column(table, "ROTATING_MASS").sum())
    names = at.TRAIN_PARAMETERS.split()
    resistance = [
        float(table[0, names.index(f"RESISTANCE_{part}")])
        for part in ("CONSTANT", "LINEAR", "QUADRATIC")
    ]
    dead = float(np.average(_column(table, "DEMAND_DELAY")[braked], weights=force))
    lag = max(float(np.average(_filling_lags(scenario, braked), weights=force)), 0.01)
    if dead > 60 * layer.period:
        raise RailgripError(
            Problem(
                "brake_control.period",
                "must be at least a sixtieth of the brakes' dead time",
                got=f"{layer.period:g} s, dead time {dead:g} s",
            )
        )
    parameters = BrakeControlParameters(
        estimator=to.OFF if estimator is None else _WHEN[estimator.passed_on],
        temperature_source=to.FROM_MODEL
        if estimator is not None and estimator.temperature == "model"
        else to.FROM_SENSOR,
        adapts=to.CHARACTERISTIC if layer.adapts == "characteristic" else to.COEFFICIENT,
        threshold_service=layer.threshold.service,
        threshold_emergency=layer.threshold.emergency,
        degraded_share=layer.threshold.degraded_share,
        jerk_service=layer.jerk_service or UNLIMITED,
        jerk_emergency=layer.jerk_emergency or UNLIMITED,
        gradient_compensation=layer.gradient_compensation,
        full_deceleration=float(force.sum()) / mass,
        resistance_constant=resistance[0] / mass,
        resistance_linear=resistance[1] / mass,
        resistance_quadratic=resistance[2] / mass,
        dead_time=dead,
        filling=dead + 6.0 * lag,
        # the first share of pressure means nothing yet
        settling=dead + 2.0 * layer.period,
        reserve=layer.pressure_reserve,
        redistributes=float(layer.redistributes),
        stops=float(layer.stop_at is not None),
        response=layer.response,
        least_stopping_speed=layer.least_stopping_speed,
    )
    if control is None:
        return parameters
    return parameters._replace(
        controller=_WHEN[control.acts],
        proportional=control.proportional,
        integral=control.integral,
        greatest_correction=control.greatest,
        correction_rate=control.rate,
        delay=control.delay,
        measuring_lag=control.measuring_lag,
        settling=parameters.settling if control.settling is None else control.settling,
    )


def _filling_lags(scenario: Scenario, braked: Any) -> list[float]:
    """Return the time constant by which each brake's filling is described."""
    found = []
    for place, is_braked in zip(scenario.train.axles(), braked, strict=True):
        if is_braked:
            assert place.axle.brake is not None
            brake = scenario.train.brakes[place.axle.brake]
            share = {"linear": 0.5 * brake.fill_time, "orifice": brake.fill_time / 3}
            found.append(share.get(brake.fill, brake.lag))
    return found
