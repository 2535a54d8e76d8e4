"""Several computers of the protection in one train: each steps on the rows of its own axles.

The kernel calls one controller for the train. For units it calls `mixed_step`, which hands each
unit a table of its axles and puts its commands back; what a unit cannot see it cannot use.
"""

from __future__ import annotations

import warnings
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from numba.core.errors import NumbaExperimentalFeatureWarning

from railgrip.compiler import inlined, numba, with_compiled_callees
from railgrip.control import contract as ctl
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.controllers import Compiled, compiled, find_controller, plain_step
from railgrip.engine.plan import FloatArray, IntArray
from railgrip.engine.plug_ins import CONTROLLER_INITIAL, CONTROLLER_STEP, call_step, controller_step
from railgrip.scenario.scenario import Scenario

# What the parameters of a mixture begin with: the number of units, then for each of them
AXLES = 0  # where its list of axles begins
N_AXLES = 1
PARAMETERS = 2  # where its parameters begin
N_PARAMETERS = 3
STATE = 4  # where its part of the state begins: ticks to wait, setup, measured, command, own
N_STATE = 5
EVERY = 6  # steps of the mixture between two of its own
N_HEAD = 7

# What the plain form keeps of each unit
OWN, WAIT, LAST = range(3)

N_TABLES = ctl.N_SETUP + ctl.N_MEASURED + ctl.N_COMMAND


class Unit(NamedTuple):
    """One computer: its controller, its axles from the front, its steps of the mixture's."""

    controller: Any
    axles: IntArray
    every: int


class Mixture(NamedTuple):
    """The units of a train, stepped at the shortest of their periods [s]."""

    units: tuple[Unit, ...]
    period: float

    def reset(self, setup: ctl.Setup) -> list[list[Any]]:
        """Return for each unit its state, the steps until its turn, and its last command."""
        table = ctl.setup_array(setup)
        return [
            [
                unit.controller.reset(setup_of(table[unit.axles], setup.period * unit.every)),
                0,
                ctl.command_array(len(unit.axles)),
            ]
            for unit in self.units
        ]


def setup_of(table: FloatArray, period: float) -> ctl.Setup:
    """Return what a unit is told of its axles: their rows, bogies and vehicles counted anew."""
    own = table.copy()
    _renumber(own, ctl.BOGIE)
    _renumber(own, ctl.VEHICLE)
    return ctl.Setup(
        n_axles=len(own),
        period=period,
        wheel_radius=own[:, ctl.BELIEVED_RADIUS],
        motored=own[:, ctl.MOTORED] > 0,
        braked=own[:, ctl.BRAKED] > 0,
        axle_load=own[:, ctl.AXLE_LOAD],
        axles=ctl.AxleData(*own[:, ctl.ROTATING_MASS : ctl.BOGIE].T),
        bogie=own[:, ctl.BOGIE],
        vehicle=own[:, ctl.VEHICLE],
    )


def step_mixture(
    whole: Mixture, states: list[list[Any]], measured: FloatArray, dt: float
) -> FloatArray:
    """Step the units whose turn it is; the others' commands stand."""
    columns = ctl.command_array(len(measured))
    for unit, state in zip(whole.units, states, strict=True):
        if state[WAIT] == 0:
            seen = measured[unit.axles]
            state[LAST] = plain_step(unit.controller, state[OWN], seen, dt * unit.every)
            state[WAIT] = unit.every
        state[WAIT] -= 1
        columns[unit.axles] = state[LAST]
    return columns


def protection(scenario: Scenario) -> Any:
    """Return the controller of a scenario, or the mixture of those of its units.

    Raises
    ------
    RailgripError
        As `find_controller`; "wsp.unit[1].controller: its period is no multiple …".
    """
    wsp, step = scenario.wsp, scenario.run.step
    if not wsp.unit:
        return find_controller(wsp, step)
    found = [find_controller(one, step, f"wsp.unit[{i}]") for i, one in enumerate(wsp.unit)]
    axles = [one.places(scenario.train) for one in wsp.unit]
    return mixture(found, axles)


def mixture(controllers: list[Any], axles: list[tuple[int, ...]]) -> Mixture:
    """Return the mixture of controllers, each on its axles."""
    # no protection follows the step of the run, which every other period is a multiple of
    period = min(float(controller.period) for controller in controllers)
    units = []
    for i, (controller, own) in enumerate(zip(controllers, axles, strict=True)):
        every = controller.period / period
        if abs(every - round(every)) > 1e-6:
            what = "its period is no multiple of the shortest period of the units"
            got = f"{controller.period * 1e3:g} ms, shortest {period * 1e3:g} ms"
            raise RailgripError(Problem(f"wsp.unit[{i}].controller", what, got=got))
        units.append(Unit(controller, np.array(own, dtype=np.int64), round(every)))
    return Mixture(tuple(units), period)


def compiled_form(controller: Any, n_axles: int) -> Compiled | None:
    """Return a controller or a mixture for the kernel; None where a part is plain Python."""
    if isinstance(controller, Mixture):
        parts = [compiled_form(unit.controller, len(unit.axles)) for unit in controller.units]
        forms = [part for part in parts if part is not None]
        return _mixed(controller, forms) if len(forms) == len(parts) else None
    return compiled(controller, n_axles) if hasattr(controller, "kernel") else None


def _mixed(whole: Mixture, forms: list[Compiled]) -> Compiled:
    head = np.zeros((len(forms), N_HEAD))
    lists = [unit.axles.astype(float) for unit in whole.units]
    parts = [*lists, *(form.parameters for form in forms)]
    begins = 1 + head.size + np.concatenate([[0], np.cumsum([len(part) for part in parts])])
    state = 0
    for i, (unit, form) in enumerate(zip(whole.units, forms, strict=True)):
        n_state = 1 + len(unit.axles) * N_TABLES + form.state_size
        head[i] = (
            begins[i], len(unit.axles), begins[len(forms) + i], len(form.parameters), state,
            n_state, unit.every,
        )  # fmt: skip
        state += n_state
    return Compiled(
        step=mixed_step(tuple(form.step for form in forms)),
        initial=mixed_initial(tuple(form.initial for form in forms)),
        parameters=np.concatenate([[len(forms)], head.ravel(), *parts]),
        state_size=state,
    )


def _take(table: Any, rows: Any, first: int, n: int, into: Any) -> None:
    """Gather the rows of a unit's axles, whose list begins at ``first`` of ``rows``."""
    for i in range(n):
        axle = int(rows[first + i])
        for column in range(table.shape[1]):
            into[i, column] = table[axle, column]


def _renumber(setup: Any, column: int) -> None:
    """Count a unit's bogies or vehicles from 0: it does not know of others."""
    number = 0.0
    before = setup[0, column]
    for i in range(setup.shape[0]):
        number += 1.0 if setup[i, column] != before else 0.0
        before = setup[i, column]
        setup[i, column] = number


@cache
def mixed_step(steps: tuple[Any, ...]) -> Any:
    """Return one kernel that lets each unit step on its own axles."""
    take, call = inlined(_take), inlined(call_step)

    def step(parameters, axle_setup, state, measured, command, dt):  # type: ignore[no-untyped-def]
        for unit in range(len(steps)):
            head = parameters[1 + unit * N_HEAD : 1 + (unit + 1) * N_HEAD]
            n, listed, own = int(head[N_AXLES]), int(head[AXLES]), int(head[STATE])
            if state[own] > 0.0:
                state[own] -= 1.0
                continue
            state[own] = head[EVERY] - 1.0
            seen_at = own + 1 + n * ctl.N_SETUP
            said_at = seen_at + n * ctl.N_MEASURED
            rest = said_at + n * ctl.N_COMMAND
            setup = state[own + 1 : seen_at].reshape((ctl.N_SETUP, n)).T
            seen = state[seen_at:said_at].reshape((ctl.N_MEASURED, n)).T
            said = state[said_at:rest].reshape((ctl.N_COMMAND, n)).T
            first, last = int(head[PARAMETERS]), int(head[PARAMETERS] + head[N_PARAMETERS])
            memory = state[rest : own + int(head[N_STATE])]
            take(measured, parameters, listed, n, seen)
            take(command, parameters, listed, n, said)
            own_parameters = parameters[first:last]
            call(steps[unit], own_parameters, setup, memory, seen, said, dt * head[EVERY])
            for i in range(n):
                axle = int(parameters[listed + i])
                for column in range(ctl.N_COMMAND):
                    command[axle, column] = said[i, column]

    return _as_c(CONTROLLER_STEP, with_compiled_callees(controller_step(step)))


@cache
def mixed_initial(initials: tuple[Any, ...]) -> Any:
    """Return what tells each unit of its own axles, and fills its state."""
    take, renumber = inlined(_take), inlined(_renumber)

    def begin(parameters, axle_setup, state, measured):  # type: ignore[no-untyped-def]
        for unit in range(len(initials)):
            head = parameters[1 + unit * N_HEAD : 1 + (unit + 1) * N_HEAD]
            n, listed, own = int(head[N_AXLES]), int(head[AXLES]), int(head[STATE])
            seen_at = own + 1 + n * ctl.N_SETUP
            said_at = seen_at + n * ctl.N_MEASURED
            rest = said_at + n * ctl.N_COMMAND
            setup = state[own + 1 : seen_at].reshape((ctl.N_SETUP, n)).T
            seen = state[seen_at:said_at].reshape((ctl.N_MEASURED, n)).T
            take(axle_setup, parameters, listed, n, setup)
            renumber(setup, ctl.BOGIE)
            renumber(setup, ctl.VEHICLE)
            take(measured, parameters, listed, n, seen)
            first, last = int(head[PARAMETERS]), int(head[PARAMETERS] + head[N_PARAMETERS])
            initials[unit](
                parameters[first:last], setup, state[rest : own + int(head[N_STATE])], seen
            )

    return _as_c(CONTROLLER_INITIAL, begin)


def _as_c(signature: Any, function: Any) -> Any:
    with warnings.catch_warnings():
        # calling one of several functions by its number is what Numba calls experimental
        warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
        return numba.cfunc(signature, error_model="numpy", _nrt=False)(function)
