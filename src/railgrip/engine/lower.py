"""From a scenario to flat arrays: the last place where names and models are known."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from railgrip.control import contract as ctl
from railgrip.control.rotation_monitoring import RotationMonitoring
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.creep_laws import find_creep_law
from railgrip.engine.lower_brake_control import lower_brake_control
from railgrip.engine.lower_train import ENDLESS, lower_train, static_loads
from railgrip.engine.plan import Faults, FloatArray, Formation, IntArray, Plan, Timing, Way
from railgrip.scenario.fault import FAULT_KINDS
from railgrip.scenario.line import Line
from railgrip.scenario.rail import FrictionState, RailCondition
from railgrip.scenario.run import DrivePoint
from railgrip.scenario.scenario import Scenario

FIELD_STEP = 0.5
"""Spacing of the random field along the line, m: one field for every step, speed and train."""
FORGOTTEN = 10.0
"""Correlation lengths after which a field remembers 5e-5 of how it began."""
LEAST_CELL = FIELD_STEP
"""Shortest rail cell, m; a cell is a whole number of field steps."""
ELEVATION_STEP = 1.0
"""Spacing of heights along the line, m."""
MONITOR_PERIOD = 0.1
"""Wheel rotation monitoring works in seconds; it looks so often, s."""
FASTEST = 600 / 3.6
"""Speed that a driven train without a permitted one is prepared for, m/s."""
NEVER = 2**62
"""A tick that does not come."""


def lower(scenario: Scenario, control_period: float, parameters: FloatArray) -> Plan:
    """Return the plan of a batch of runs of this scenario.

    Parameters
    ----------
    scenario : Scenario
        Complete and checked.
    control_period : float
        Of the controller [s]; a multiple of the step.
    parameters : float array
        Of the controller.

    Raises
    ------
    RailgripError
        Where time or rail cannot be cut into ticks and cells: "a delay must be shorter …"; where
        the creep law cannot be tabulated.
    """
    table, brakes = lower_train(scenario)
    way = _way(scenario)
    creep_law, creep_tables = find_creep_law(scenario, way.conditions[0])
    faults = _faults(scenario)
    return Plan(
        way=way,
        timing=_timing(scenario, control_period, faults),
        formation=_formation(scenario, table, brakes),
        faults=faults,
        n_axles=np.uint64(scenario.train.n_axles),
        creep_law=creep_law,
        creep_tables=creep_tables,
        parameters=table,
        controller_parameters=parameters,
        monitor_parameters=np.array(RotationMonitoring(), dtype=float),
        brake_control=lower_brake_control(scenario, table),
    )


def _ticks(scenario: Scenario, where: str, time: float) -> int:
    ticks = round(time / scenario.run.step)
    if ticks >= at.MAX_DELAY:
        raise RailgripError(
            Problem(
                where,
                f"a delay must be shorter than {at.MAX_DELAY} steps",
                got=f"{time * 1e3:g} ms at a step of {scenario.run.step * 1e3:g} ms",
                cure="a larger run.step",
            )
        )
    return int(ticks)


def _kept(scenario: Scenario, sensor_delay: int, valve_delay: int, faults: Faults) -> int:
    """Return how many ticks the longest delay reaches back, up to a power of two less one."""
    added = int(faults.ticks.max(initial=0))
    if added > 0:
        _ticks(
            scenario, "fault.delay and the valve's own", (valve_delay + added) * scenario.run.step
        )
    # a frozen sensor looks one tick back
    longest = max(sensor_delay, valve_delay + added, 1)
    return int(2 ** longest.bit_length() - 1)


def _timing(scenario: Scenario, control_period: float, faults: Faults) -> Timing:
    run, train = scenario.run, scenario.train
    every = control_period / run.step
    if abs(every - round(every)) > 1e-6 or every < 0.5:
        raise RailgripError(
            Problem(
                "run.step",
                "the controller's period must be a multiple of the step",
                got=f"step {run.step * 1e3:g} ms, period {control_period * 1e3:g} ms",
            )
        )
    points, drive = run.demand, run.drive or (DrivePoint(level=0.0),)
    ticks = np.array([round(point.at / run.step) for point in points], dtype=np.int64)
    braking = [tick for tick, point in zip(ticks, points, strict=True) if point.level > 0]
    valve = train.dump_valve
    sander = train.sander
    sensor_delay = _ticks(scenario, "train.sensor.delay", train.sensor.delay)
    where = "train.dump_valve"
    vent_delay = _ticks(scenario, f"{where}.vent_delay", valve.vent_delay if valve else 0.0)
    fill_delay = _ticks(scenario, f"{where}.fill_delay", valve.fill_delay if valve else 0.0)
    return Timing(
        tick=run.step,
        limit=round((run.duration or run.time_limit) / run.step),
        after_stop=round(run.after_stop / run.step),
        trace_every=round(run.trace / run.step),
        control_every=round(every),
        monitor_every=round(every) * max(1, round(MONITOR_PERIOD / control_period)),
        demand_tick=ticks,
        demand_level=np.array([point.level for point in points]),
        demand_emergency=np.array([float(point.emergency) for point in points]),
        first_brake_tick=int(braking[0]) if braking else NEVER,
        drive_tick=np.array([round(point.at / run.step) for point in drive], dtype=np.int64),
        drive_level=np.array([point.level for point in drive]),
        goes_on=int(run.duration is not None),
        sensor_delay=sensor_delay,
        sensor_teeth=float(train.sensor.teeth),
        sensor_timer=train.sensor.timer,
        vent_delay=vent_delay,
        fill_delay=fill_delay,
        kept=_kept(scenario, sensor_delay, max(vent_delay, fill_delay), faults),
        sand_delay=sander.delay if sander else 0.0,
        sand_cut_out=sander.cut_out_speed if sander else 0.0,
    )


def _formation(scenario: Scenario, table: FloatArray, brakes: FloatArray) -> Formation:
    train = scenario.train
    axles = train.axles()
    n_vehicles = len(train.vehicle)
    masses = np.array([v.tare + p for v, p in zip(train.vehicle, scenario.payloads(), strict=True)])
    air = train.reservoir
    setup = np.zeros((len(axles), ctl.N_SETUP), order="F")
    has_motors = train.dynamic_brake is not None or train.traction is not None
    for i, place in enumerate(axles):
        setup[i, ctl.BELIEVED_RADIUS] = place.axle.believed_radius
        setup[i, ctl.MOTORED] = place.axle.motor and has_motors
        brake = train.brakes[place.axle.brake] if place.axle.brake is not None else None
        is_continuous = brake is not None and brake.fill == "lag"
        setup[i, ctl.CONTINUOUS] = is_continuous
        setup[i, ctl.BRAKED] = is_continuous or (brake is not None and train.dump_valve is not None)
        _put_forces(setup[i], table[1 + i], brake is not None and not place.axle.isolated)
    places = [(place.vehicle, place.bogie) for place in axles]
    bogies = sorted(set(places))
    setup[:, ctl.BOGIE] = [bogies.index(place) for place in places]
    setup[:, ctl.VEHICLE] = [place.vehicle for place in axles]
    setup[:, ctl.AXLE_LOAD] = static_loads(scenario)
    in_emergency = train.dynamic_brake.in_emergency if train.dynamic_brake else True
    return Formation(
        vehicle_of_axle=np.array([place.vehicle for place in axles], dtype=np.int64),
        inverter_of_axle=_inverters(scenario),
        vehicle_front=np.array(train.vehicle_fronts()),
        vehicle_length=np.array([vehicle.length for vehicle in train.vehicle]),
        vehicle_share=(masses / masses.sum())[None],
        reservoir_volume=np.full(n_vehicles, air.volume if air else 1.0),
        reservoir_pressure=np.full(n_vehicles, air.pressure if air else ENDLESS),
        reservoir_recharge=np.full(n_vehicles, air.recharge if air else 0.0),
        brakes=brakes,
        dynamic_in_emergency=int(in_emergency),
        has_sander=int(train.sander is not None),
        has_shared_inverter=int(train.traction is not None and train.traction.inverter != "axle"),
        axle_setup=setup,
    )


def _put_forces(row: FloatArray, values: FloatArray, is_braked: bool) -> None:
    """Tell a controller the forces of one axle, as the vehicle knows them."""
    names = at.AXLE_PARAMETERS.split()

    def value(name: str) -> float:
        return float(values[names.index(name)])

    row[ctl.ROTATING_MASS] = value("ROTATING_MASS")
    if is_braked:
        row[ctl.FULL_FORCE] = value("FULL_FORCE")
        row[ctl.FULL_PRESSURE] = value("FULL_PRESSURE")
        row[ctl.FIRST_PRESSURE] = -value("CLAMP_OFFSET") / value("CLAMP_PER_PRESSURE")
    row[ctl.BRAKING_EFFORT] = value("DYNAMIC_MAX")
    row[ctl.BRAKING_POWER] = value("DYNAMIC_POWER")
    row[ctl.TRACTIVE_EFFORT] = value("TRACTION_MAX")
    row[ctl.TRACTIVE_POWER] = value("TRACTION_POWER")


def _faults(scenario: Scenario) -> Faults:
    step = scenario.run.step
    labels = [place.label for place in scenario.train.axles()]
    rows = [
        (axle, i, fault)
        for i, fault in enumerate(scenario.fault)
        for axle in (range(len(labels)) if fault.axle == "all" else [labels.index(fault.axle)])
    ]
    found = [fault for _, _, fault in rows]
    ends = [NEVER if math.isinf(fault.end) else round(fault.end / step) for fault in found]
    delays = [
        _ticks(scenario, f"fault[{i}].delay", fault.value) if fault.kind == "valve_delayed" else 0
        for _, i, fault in rows
    ]
    return Faults(
        axle=np.array([axle for axle, _, _ in rows], dtype=np.int64),
        kind=np.array([FAULT_KINDS.index(fault.kind) for fault in found], dtype=np.int64),
        begin=np.array([round(fault.begin / step) for fault in found], dtype=np.int64),
        end=np.array(ends, dtype=np.int64),
        value=np.array([fault.value for fault in found], dtype=np.float64),
        ticks=np.array(delays, dtype=np.int64),
        happens=np.array([[int(fault.happens) for fault in found]], dtype=np.int64),
    )


def _inverters(scenario: Scenario) -> IntArray:
    """Return for each axle the first axle that the same inverter feeds."""
    traction = scenario.train.traction
    kind = traction.inverter if traction is not None else "axle"
    first: dict[tuple[int, ...], int] = {}
    found = []
    for i, place in enumerate(scenario.train.axles()):
        own = {
            "axle": (i,),
            "bogie": (place.vehicle, place.bogie),
            "vehicle": (place.vehicle,),
        }[kind]
        found.append(first.setdefault(own, i) if place.axle.motor else i)
    return np.array(found, dtype=np.int64)


def _way(scenario: Scenario) -> Way:
    line, rail, run = scenario.line.use, scenario.rail, scenario.run
    length = cell_length(scenario)
    origin = math.floor(scenario.line.start - scenario.train.length) - 10.0
    conditions, of_cell = _conditions(scenario, origin, length)
    elevation, curve_work = _profile(line, origin)
    field = rail.random
    seed = run.seed if field is None or field.seed is None else field.seed
    sander = scenario.train.sander
    return Way(
        origin=origin,
        end=line.length,
        cell_length=length,
        condition_of_cell=of_cell,
        conditions=conditions,
        elevation_step=ELEVATION_STEP,
        elevation=elevation,
        curve_work=curve_work,
        is_level=int(not elevation.any() and not curve_work.any()),
        is_random=int(field is not None),
        nodes_per_cell=round(length / FIELD_STEP),
        first_node=round(origin / FIELD_STEP),
        cells_to_forget=math.ceil(FORGOTTEN * field.correlation_length / length) if field else 0,
        correlation=math.exp(-FIELD_STEP / field.correlation_length) if field else 0.0,
        relative_spread=np.array([field.spread / field.mean if field else 0.0]),
        seed=seed,
        sand_friction=sander.rail_friction if sander else 0.0,
        effective_sand=sander.dose if sander else 1.0,
    )


def cell_length(scenario: Scenario) -> float:
    """Return the length of a rail cell: no wheel may pass more than one a tick."""
    fastest = scenario.run.speed
    if scenario.run.drive:
        fastest = max(fastest, scenario.train.max_speed or FASTEST)
    longest_tick = 1.25 * fastest * scenario.run.step
    return LEAST_CELL * max(1, math.ceil(longest_tick / LEAST_CELL))


def _state(state: FrictionState) -> list[float]:
    return [
        state.static_friction,
        state.friction_ratio,
        state.friction_decay,
        state.adhesion_reduction,
        state.slip_reduction,
    ]


def _row(condition: RailCondition) -> list[float]:
    return [*_state(condition.contaminated), *_state(condition.clean), condition.cleaning]


def _conditions(scenario: Scenario, origin: float, length: float) -> tuple[FloatArray, IntArray]:
    rail = scenario.rail
    base = _row(rail.condition)
    if rail.random is not None:
        base[0] = rail.random.mean
    rows = [base, *(_row(patch.condition) for patch in rail.patch)]
    n_cells = math.ceil((scenario.line.use.length - origin) / length) + 8
    centres = origin + (np.arange(n_cells) + 0.5) * length
    of_cell = np.zeros(n_cells, dtype=np.int64)
    for i, patch in enumerate(rail.patch):
        of_cell[(centres >= patch.begin) & (centres < patch.end)] = i + 1
    return np.array(rows)[None], of_cell


def _profile(line: Line, origin: float) -> tuple[FloatArray, FloatArray]:
    """Return height and work of curve resistance over weight along the line."""
    places: FloatArray = np.array(
        origin + ELEVATION_STEP * np.arange(math.ceil(line.length - origin) + 3), dtype=np.float64
    )
    height = _integral([(p.at, p.value) for p in line.gradient], places)
    bends: list[tuple[float, float]] = []
    for curve in line.curve:
        bends += [(curve.begin, curve_resistance(curve.radius)), (curve.end, 0.0)]
    return height, _integral(bends, places)


def curve_resistance(radius: float) -> float:
    """Return curve resistance over weight (Röckl's formula).

    650/(R − 55) ‰ from 300 m radius up, 500/(R − 30) ‰ below, the radius floored at 60 m.

    Examples
    --------
    >>> round(curve_resistance(500.0) * 1e3, 3)
    1.461
    """
    if radius >= 300.0:
        return 0.650 / (radius - 55.0)
    return 0.500 / (max(radius, 60.0) - 30.0)


def _integral(steps: list[tuple[float, float]], places: FloatArray) -> FloatArray:
    """Integrate a step function exactly at the places; before the first step it is zero."""
    if not steps:
        return np.zeros_like(places)
    at_place = np.array([place for place, _ in steps])
    value = np.array([number for _, number in steps])
    total = np.concatenate([[0.0], np.cumsum(value[:-1] * np.diff(at_place))])
    i = np.searchsorted(at_place, places, side="right") - 1
    inside = i >= 0
    result: FloatArray = np.zeros_like(places)
    result[inside] = total[i[inside]] + value[i[inside]] * (places[inside] - at_place[i[inside]])
    return result


def ring_cells(plan: Plan, train_length: float, whole_line: bool) -> int:
    """Return the number of rail cells to hold: a power of two."""
    needed = (train_length + 10.0) / plan.way.cell_length + 8
    if whole_line:
        needed = max(needed, len(plan.way.condition_of_cell) + 8)
    return 1 << math.ceil(math.log2(needed))


def controller_setup(scenario: Scenario, period: float) -> ctl.Setup:
    """Return what a controller is told about this train."""
    table: Any = _formation(scenario, *lower_train(scenario)).axle_setup
    return ctl.Setup(
        n_axles=scenario.train.n_axles,
        period=period,
        wheel_radius=table[:, ctl.BELIEVED_RADIUS],
        motored=table[:, ctl.MOTORED] > 0,
        braked=table[:, ctl.BRAKED] > 0,
        axle_load=table[:, ctl.AXLE_LOAD],
        axles=ctl.AxleData(*table[:, ctl.ROTATING_MASS : ctl.BOGIE].T),
        bogie=table[:, ctl.BOGIE],
        vehicle=table[:, ctl.VEHICLE],
    )
