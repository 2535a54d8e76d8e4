"""Run a scenario: once, or many times side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np

from railgrip.control import brake_control_table as table
from railgrip.control import contract as ctl
from railgrip.control.brake_control_table import brake_state_size
from railgrip.control.rotation_monitoring import rotation_state_size
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.status import RunStatus
from railgrip.engine import kernel
from railgrip.engine import layout as at
from railgrip.engine.controllers import (
    Compiled,
    no_kernel,
    plain_step,
)
from railgrip.engine.driver import DRIVER_STATES
from railgrip.engine.lower import controller_setup, lower, ring_cells
from railgrip.engine.lower_train import lower_train
from railgrip.engine.mixture import Mixture, compiled_form, protection, step_mixture
from railgrip.engine.plan import FloatArray, Memory, Outcome, Overrides, Plan
from railgrip.engine.plug_ins import CREEP_LAW, creep_law, first_class
from railgrip.engine.records import AXLE_OUTCOMES, AXLE_TRACES, TRAIN_OUTCOMES, TRAIN_TRACES
from railgrip.engine.result import Result
from railgrip.scenario.scenario import Scenario

CHUNK = 4096
"""Runs handed to the kernel at a time: enough to fill the lanes, short enough to interrupt."""
LINE = 8
"""Numbers in a cache line."""

Variations = Mapping[str, Any]
"""Numbers that differ from run to run: name of the layout, or (name, axle) → one for each run."""


class Prepared(NamedTuple):
    """A scenario ready for the kernel."""

    scenario: Scenario
    plan: Plan
    controller: Any
    compiled: Compiled
    creep_law: Any
    is_plain: bool
    failures: dict[int, str]
    """Run → what its controller raised; filled while plain ones run."""


def _no_law(
    static: float, ratio: float, decay: float, adhesion: float, slip: float,
    load: float, slope: float, slip_speed: float, creepage: float,
) -> float:  # fmt: skip
    return 0.0


def prepare(scenario: Scenario, controller: Any = None) -> Prepared:
    """Return a scenario with its controller compiled and its numbers laid out.

    Parameters
    ----------
    scenario : Scenario
        What to run.
    controller : controller, optional
        Used in place of the one that the scenario names.
    """
    controller = protection(scenario) if controller is None else controller
    form = compiled_form(controller, scenario.train.n_axles)
    chosen = no_kernel() if form is None else form
    plan = lower(scenario, float(controller.period), chosen.parameters)
    law = first_class(_no_law, CREEP_LAW)
    if plan.creep_law == at.LAW_CUSTOM:
        law = creep_law(registry.resolve("railgrip.laws", scenario.run.creep_law, "run.creep_law"))
    return Prepared(scenario, plan, controller, chosen, law, form is None, {})


def memory(prepared: Prepared, lanes: int, whole_line: bool) -> Memory:
    """Return the memory of a batch: its size does not depend on the number of runs."""
    plan = prepared.plan
    n_axles = prepared.scenario.train.n_axles
    n_vehicles = len(plan.formation.vehicle_front)
    ring = ring_cells(plan, prepared.scenario.train.length, whole_line) * lanes
    return Memory(
        lanes=_aligned((1 + n_axles) * at.N_VARS * lanes),
        reservoirs=_aligned(n_vehicles * lanes),
        ring_energy=_aligned(ring),
        ring_factor=np.ones(ring),
        ring_sand=_aligned(ring),
        controller_state=_aligned((lanes, max(prepared.compiled.state_size, 1))),
        measured=_aligned((lanes, ctl.N_MEASURED, n_axles)),
        command=_aligned((lanes, ctl.N_COMMAND, n_axles)),
        monitor_state=_aligned((lanes, rotation_state_size(n_axles))),
        alarm=_aligned((lanes, n_axles)),
        brake_state=_aligned((lanes, brake_state_size(n_axles) if plan.brake_control.every else 0)),
        brake_measured=_aligned((lanes, n_axles, table.N_MEASURED)),
        brake_command=_aligned((lanes, n_axles, table.N_COMMAND)),
        driver_state=_aligned((lanes, DRIVER_STATES)),
        demand_history=_aligned((lanes, 1 + int(plan.driver.late.max(initial=0)))),
    )


def _aligned(shape: int | tuple[int, ...]) -> FloatArray:
    """Return zeros that begin where a cache line does: vectors across two lines are slower."""
    size = int(np.prod(shape))
    room = np.zeros(size + LINE)
    first = -room.ctypes.data % (8 * LINE) // 8
    return room[first : first + size].reshape(shape)


def outcome(prepared: Prepared, n_runs: int, traced: bool) -> Outcome:
    """Return empty tables for so many runs."""
    timing = prepared.plan.timing
    n_axles = prepared.scenario.train.n_axles
    n_vehicles = len(prepared.plan.formation.vehicle_front)
    rows = timing.limit // timing.trace_every + 2 if traced else 0
    n_traced = n_runs if traced else 0
    return Outcome(
        train=np.full((n_runs, len(TRAIN_OUTCOMES)), np.nan),
        axle=np.full((n_runs, n_axles, len(AXLE_OUTCOMES)), np.nan),
        # rows that no run reaches are never touched, so they cost no memory
        trace_train=np.empty((n_traced, rows, len(TRAIN_TRACES))),
        trace_axle=np.empty((n_traced, rows, n_axles, len(AXLE_TRACES))),
        trace_vehicle=np.empty((n_traced, rows, n_vehicles)),
    )


def overrides(prepared: Prepared, variations: Variations, n_runs: int) -> Overrides:
    """Return the numbers that differ from run to run, by their places in the plan.

    Raises
    ------
    RailgripError
        For a name that the layout does not know, or a wrong number of values.
    """
    train_names, axle_names = at.TRAIN_PARAMETERS.split(), at.AXLE_PARAMETERS.split()
    index: list[int] = []
    columns: list[FloatArray] = []
    for key, values in variations.items():
        name, axles = key if isinstance(key, tuple) else (key, None)
        column = np.asarray(values, dtype=float)
        if column.shape != (n_runs,) or not np.isfinite(column).all():
            raise RailgripError(
                Problem(str(name), "needs one finite number for each run",
                        got=f"shape {column.shape}", allowed=f"({n_runs},)")
            )  # fmt: skip
        n_axles = prepared.scenario.train.n_axles
        if axles is not None and (name in train_names or not 0 <= int(axles) < n_axles):
            raise RailgripError(
                Problem(
                    str(name),
                    "has no such axle",
                    got=f"{axles}",
                    allowed=f"0 to {n_axles - 1}, for quantities of axles",
                )
            )
        if name in train_names:
            index.append(train_names.index(name))
            columns.append(column)
        elif name in axle_names:
            every = range(prepared.scenario.train.n_axles) if axles is None else [axles]
            for axle in every:
                index.append((1 + axle) * at.N_PARAMETERS + axle_names.index(name))
                columns.append(column)
        else:
            raise RailgripError(unknown_name("", "quantity", name, train_names + axle_names))
    value = np.stack(columns, axis=1) if columns else np.zeros((n_runs, 0))
    number = np.arange(n_runs, dtype=np.int64)
    return Overrides(np.array(index, dtype=np.int64), np.ascontiguousarray(value), number)


def nominal_numbers(scenario: Scenario) -> dict[str, Any]:
    """Return the numbers that a scenario's runs begin with, for variations around them.

    Parameters
    ----------
    scenario : Scenario
        Complete and checked.

    Returns
    -------
    dict
        Name of the layout → number of the train, or array (axle).

    Examples
    --------
    >>> import railgrip as rg
    >>> numbers = nominal_numbers(rg.load("dry_emergency"))
    >>> float(numbers["TRAIN_MASS"]), float(numbers["PAD_FACTOR"][3])
    (220000.0, 1.0)
    """
    table, _ = lower_train(scenario)
    of_train = dict(zip(at.TRAIN_PARAMETERS.split(), table[0], strict=False))
    return of_train | dict(zip(at.AXLE_PARAMETERS.split(), table[1:].T.copy(), strict=True))


def simulate(
    scenario: Scenario,
    *,
    runs: int = 1,
    variations: Variations | None = None,
    traces: bool | None = None,
    threads: int = 1,
    controller: Any = None,
    progress: Callable[[int], None] | None = None,
) -> Result:
    """Run a scenario and return what happened.

    Parameters
    ----------
    scenario : Scenario
        What to run.
    runs : int
        How many runs, ≥ 1. Run i sees the i-th random rail; without a random field and without
        variations all are equal.
    variations : mapping, optional
        Numbers that differ from run to run, named as in `railgrip.engine.layout`:
        ``{"INITIAL_SPEED": [...], ("STATIC_LOAD", 3): [...]}``.
    traces : bool, optional
        Keep the way of every run; default: for a single run only.
    threads : int
        Threads that share the runs; the bits do not depend on it.
    controller : controller, optional
        Used in place of the one that the scenario names.
    progress : callable, optional
        Called with the number of runs that have just ended.

    Returns
    -------
    Result

    Raises
    ------
    RailgripError
        What in the scenario cannot be run, and what to try.

    Notes
    -----
    Every run ends with a status (`railgrip.core.status`); a batch goes on past a failed run.

    Examples
    --------
    >>> import railgrip as rg
    >>> result = rg.simulate(rg.load("dry_emergency"))
    >>> result.status.name
    'STOPPED'
    """
    if runs < 1 or threads < 1:
        raise RailgripError(
            Problem("", "runs and threads must be at least 1", got=f"{runs} and {threads}")
        )
    prepared = prepare(scenario, controller)
    traced = runs == 1 if traces is None else traces
    changes = overrides(prepared, variations or {}, runs)
    return run_prepared(prepared, changes, traced, threads, progress)


def run_prepared(
    prepared: Prepared,
    changes: Overrides,
    traced: bool,
    threads: int = 1,
    progress: Callable[[int], None] | None = None,
) -> Result:
    """Run what `prepare` has laid out, with the numbers that differ from run to run."""
    out, rail = compute(prepared, changes, traced, threads, progress)
    parameters: Any = getattr(prepared.controller, "parameters", None)
    named = dict(parameters._asdict()) if hasattr(parameters, "_asdict") else {}
    return Result.from_arrays(prepared.scenario, prepared.plan, out, rail, named, prepared.failures)


def compute(
    prepared: Prepared,
    changes: Overrides,
    traced: bool = False,
    threads: int = 1,
    progress: Callable[[int], None] | None = None,
) -> tuple[Outcome, Memory | None]:
    """Return the bare tables of a batch, and the rail of a single run that is traced."""
    out = outcome(prepared, len(changes.number), traced)
    if not prepared.is_plain:
        return out, _run_compiled(prepared, changes, out, threads, traced, progress)
    return out, _run_plain(prepared, changes, out, traced, progress)


def _chunks(runs: int, threads: int) -> Iterator[tuple[int, int]]:
    # lanes idle at the end of every chunk, so it must be many runs long
    size = min(CHUNK, max(8 * at.LANES, -(-runs // (4 * threads))))
    for first in range(0, runs, size):
        yield first, min(first + size, runs)


def _run_compiled(
    prepared: Prepared, changes: Overrides, out: Outcome, threads: int, traced: bool, progress: Any
) -> Memory | None:
    runs = len(out.train)
    # A few runs are cheaper one by one than in lanes that mostly idle.
    run_kernel, lanes = (kernel.run_single, 1) if runs < 4 else (kernel.run_lanes, at.LANES)

    def work(bounds: tuple[int, int]) -> Memory:
        own = memory(prepared, lanes, traced and lanes == 1)
        run_kernel(
            own, prepared.plan, changes, out, bounds[0], bounds[1], prepared.compiled.step,
            prepared.compiled.initial, prepared.creep_law,
        )  # fmt: skip
        if progress is not None:
            progress(bounds[1] - bounds[0])
        return own

    if threads == 1:
        last = [work(bounds) for bounds in _chunks(runs, threads)][-1]
    else:
        with ThreadPoolExecutor(threads) as pool:
            last = list(pool.map(work, _chunks(runs, threads)))[-1]
    return last if traced and runs == 1 else None


def _run_plain(
    prepared: Prepared, changes: Overrides, out: Outcome, traced: bool, progress: Any
) -> Memory | None:
    """Step a controller that is any Python object, run after run."""
    plan = prepared.plan
    own = memory(prepared, 1, traced)
    every = plan.timing.control_every
    period = every * plan.timing.tick
    setup = controller_setup(prepared.scenario, period)
    step = step_mixture if isinstance(prepared.controller, Mixture) else plain_step
    for run in range(len(out.train)):
        kernel.begin_single(own, plan, changes, run)
        state = prepared.controller.reset(setup)
        moment = 0
        while kernel.before_control_single(own, plan, out, moment) == RunStatus.RUNNING:
            if moment % every == 0:
                try:
                    own.command[0] = step(prepared.controller, state, own.measured[0].T, period).T
                except RailgripError as error:
                    # no command at all: the run ends with its status, its way is kept
                    own.command[0, ctl.DUMP_VALVE] = np.nan
                    prepared.failures[run] = str(error)
            kernel.after_control_single(own, plan, moment, prepared.creep_law)
            moment += 1
        if progress is not None:
            progress(1)
    return own if traced and len(out.train) == 1 else None
