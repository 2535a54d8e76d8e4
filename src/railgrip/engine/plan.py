"""What a kernel needs to know beside the lanes: constant over a batch, shared by all its runs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


class Way(NamedTuple):
    """The line and its rail, cut into cells.

    Attributes
    ----------
    origin : float
        Position of cell 0's near edge on the line, [m].
    end : float
        Position of the line's end, [m].
    cell_length : float
        [m].
    condition_of_cell : int array (cell)
        Row of `conditions` for each cell.
    conditions : float array (1 or run, condition, 11)
        Contaminated friction state (5), clean one (5), cleaning rate [m/J]; the same for every run,
        or each run its own.
    elevation_step : float
        Spacing of `elevation` and `curve_work` along the line from `origin`, [m].
    elevation, curve_work : float array
        Height [m]; running integral of the curve resistance over weight [m].
    is_level : int
        1 where both are zero throughout.
    is_random, nodes_per_cell, first_node, cells_to_forget
        Random field: on or off; its nodes in a cell; number of the first, counted from the line's
        beginning; cells after which it has forgotten how it began.
    correlation, relative_spread, seed
        From node to node; standard deviation over mean (1 or run); key.
    sand_friction, effective_sand : float
        See track.sanding.
    earlier_energy, earlier_sand : float array (cell)
        What an earlier run has left in the cells from 0 on, [J/m], [kg/m]; empty: fresh rail.
    """

    origin: float
    end: float
    cell_length: float
    condition_of_cell: IntArray
    conditions: FloatArray
    elevation_step: float
    elevation: FloatArray
    curve_work: FloatArray
    is_level: int
    is_random: int
    nodes_per_cell: int
    first_node: int
    cells_to_forget: int
    correlation: float
    relative_spread: FloatArray
    seed: int
    sand_friction: float
    effective_sand: float
    earlier_energy: FloatArray = np.zeros(0)
    earlier_sand: FloatArray = np.zeros(0)


class Timing(NamedTuple):
    """Time in ticks, and what is sampled.

    So many ticks of measured speeds and valve commands are ``kept``, less one: a power of two that
    covers the delays, and no more, since every place in use wants its room in the cache.
    """

    tick: float
    limit: int
    after_stop: int
    trace_every: int
    control_every: int
    monitor_every: int
    demand_tick: IntArray
    demand_level: FloatArray
    demand_emergency: FloatArray
    first_brake_tick: int
    drive_tick: IntArray
    drive_level: FloatArray
    goes_on: int
    sensor_delay: int
    sensor_teeth: float
    sensor_timer: float
    vent_delay: int
    fill_delay: int
    kept: int
    sand_delay: float
    sand_cut_out: float


class Formation(NamedTuple):
    """How the axles hang together: vehicle of each axle, and the vehicles' reservoirs and mass.

    ``vehicle_share`` (1 or run, vehicle) is each vehicle's share of the mass.
    """

    vehicle_of_axle: IntArray
    inverter_of_axle: IntArray
    vehicle_front: FloatArray
    vehicle_length: FloatArray
    vehicle_share: FloatArray
    reservoir_volume: FloatArray
    reservoir_pressure: FloatArray
    reservoir_recharge: FloatArray
    brakes: FloatArray
    dynamic_in_emergency: int
    has_sander: int
    has_shared_inverter: int
    axle_setup: FloatArray


class Faults(NamedTuple):
    """What breaks: one row a fault and axle.

    Attributes
    ----------
    axle, kind : int array
        Axle from the front; number of the kind (see engine.faults).
    begin, end : int array
        Ticks between which it acts.
    value : float array
        Noise, factor or delay.
    ticks : int array
        The delay in ticks.
    happens : int array (1 or run, fault)
        Whether it happens at all.
    """

    axle: IntArray
    kind: IntArray
    begin: IntArray
    end: IntArray
    value: FloatArray
    ticks: IntArray
    happens: IntArray


class CreepTables(NamedTuple):
    """The creep law of each axle, where it stands in a table; see `laboratory.creep_table`.

    Attributes
    ----------
    curves : float array (axle, curve, cells + 2)
        Coefficients.
    axes : float array (axle, 5)
        `laboratory.creep_grid.GridAxis` of each.
    error : float
        The greatest of any axle, in shares of μQ [-].
    """

    curves: FloatArray
    axes: FloatArray
    error: float


class BrakeControlPlan(NamedTuple):
    """Brake control above the protection; see `control.brake_control`.

    Attributes
    ----------
    every : int
        Ticks between two calls; 0: there is none.
    period, sensor_lag, stop_position : float
        [s]; of the disc temperature sensors [s]; where to stop [m].
    parameters, rules, setup : float arrays
        As the kernel takes them.
    """

    every: int
    period: float
    sensor_lag: float
    stop_position: float
    parameters: FloatArray
    rules: FloatArray
    setup: FloatArray


class DriverPlan(NamedTuple):
    """The automatic driver of a trip; see `engine.driver`.

    Attributes
    ----------
    every : int
        Ticks between two decisions; 0: the driver follows the demands over time.
    late : int array (axle)
        Ticks after which a brake demand reaches each axle.
    bounds, squares, falls : float arrays
        Highest square of speed along the leg, as `engine.journey.profile.ceiling` gives it.
    numbers : float array
        Of train and driver, by the places in `engine.driver`.
    law : float array
        Parameters of `engine.journey.coasting.coasting_demand`.
    discs : float array (axle, 2)
        Temperatures of friction ring and hub at the departure, [°C]; empty: the run's own.
    """

    every: int
    late: IntArray
    bounds: FloatArray
    squares: FloatArray
    falls: FloatArray
    numbers: FloatArray
    law: FloatArray
    discs: FloatArray = np.zeros((0, 2))


NO_DRIVER = DriverPlan(0, np.zeros(0, dtype=np.int64), *(np.zeros(0) for _ in range(5)))


class Plan(NamedTuple):
    """All of it, for the kernel."""

    way: Way
    timing: Timing
    formation: Formation
    faults: Faults
    n_axles: np.uint64
    creep_law: int
    creep_tables: CreepTables
    parameters: FloatArray
    """(1 + axles, N_PARAMETERS): row 0 the train, then each axle."""
    controller_parameters: FloatArray
    monitor_parameters: FloatArray
    brake_control: BrakeControlPlan
    driver: DriverPlan = NO_DRIVER


class Overrides(NamedTuple):
    """Numbers that differ from run to run.

    Attributes
    ----------
    target : int array (k)
        Places in `Plan.parameters`, flattened.
    value : float array (run, k)
        Their values for each run.
    number : int array (run)
        Each run's number in the whole of a campaign: its random rail and noise follow from it.
    """

    target: IntArray
    value: FloatArray
    number: IntArray


class Memory(NamedTuple):
    """What a batch writes into while it runs; its size does not depend on the number of runs."""

    lanes: FloatArray
    reservoirs: FloatArray
    ring_energy: FloatArray
    ring_factor: FloatArray
    ring_sand: FloatArray
    controller_state: FloatArray
    measured: FloatArray  # (lane, column, axle)
    command: FloatArray  # (lane, column, axle)
    monitor_state: FloatArray
    alarm: FloatArray
    brake_state: FloatArray
    brake_measured: FloatArray
    brake_command: FloatArray
    driver_state: FloatArray
    demand_history: FloatArray


class Outcome(NamedTuple):
    """What is kept of each run, and of its way if traces are asked for."""

    train: FloatArray
    axle: FloatArray
    trace_train: FloatArray
    trace_axle: FloatArray
    trace_vehicle: FloatArray
