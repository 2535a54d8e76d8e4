"""From the name in a scenario to a controller that the kernel can call, or that Python steps."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.control import contract as ctl
from railgrip.control.controller_file import load_controller_class
from railgrip.control.no_protection import NoProtection
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.engine.plan import FloatArray
from railgrip.engine.plug_ins import (
    CONTROLLER_INITIAL,
    CONTROLLER_STEP,
    controller_step,
    first_class,
)
from railgrip.scenario.wsp import Wsp, WspUnit

WHERE = "wsp.controller"


def find_controller(wsp: Wsp | WspUnit, step: float, where: str = "wsp") -> Any:
    """Return an instance of the controller that a scenario names, with its parameters.

    Parameters
    ----------
    wsp : Wsp or WspUnit
        What the scenario says of it.
    step : float
        Of the run [s]; no protection follows it.
    where : str
        Key path of it, for messages.

    Raises
    ------
    RailgripError
        "wsp.controller: controller 'conventionl' unknown; …", "wsp.parameters: …".
    """
    if wsp.controller == "none":
        return NoProtection(period=step)
    if wsp.controller.endswith(".py"):
        kind: Any = load_controller_class(wsp.controller)
    else:
        kind = registry.resolve("railgrip.controllers", wsp.controller, f"{where}.controller")
    return configured(kind, wsp.parameters, where)


def configured(kind: Any, given: dict[str, float], where: str = "wsp") -> Any:
    """Return an instance of a controller class with some of its parameters set."""
    try:
        default = kind()
    except RailgripError:
        raise
    except Exception as error:
        raise RailgripError(
            Problem(
                WHERE,
                f"{kind.__name__}() cannot be made",
                got=f"{type(error).__name__}: {error}",
                cure="give every argument of __init__ a default",
            )
        ) from error
    if not given:
        return default
    fields = getattr(getattr(default, "parameters", None), "_fields", ())
    wrong = [
        unknown_name(f"{where}.parameters.{name}", "parameter", name, fields)
        for name in given
        if name not in fields
    ]
    if wrong:
        raise RailgripError(wrong)
    return kind(default.parameters._replace(**given))


class Compiled(NamedTuple):
    """A controller for the kernel."""

    step: Any
    initial: Any
    parameters: FloatArray
    state_size: int


def _nothing_to_fill(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Leave the state zero."""


def compiled(controller: Any, n_axles: int) -> Compiled:
    """Return the controller's compiled form.

    Raises
    ------
    RailgripError
        Where Numba cannot compile the kernel, with the line that says why.
    """
    initial = getattr(controller, "initial", _nothing_to_fill)
    try:
        return Compiled(
            step=first_class(controller_step(controller.kernel), CONTROLLER_STEP),
            initial=first_class(initial, CONTROLLER_INITIAL),
            parameters=np.array(tuple(controller.parameters), dtype=float),
            state_size=int(controller.state_size(n_axles)),
        )
    except RailgripError:
        raise
    except Exception as error:
        lines = [line for line in str(error).splitlines() if line.strip()]
        lines = [line for line in lines if not line.startswith("Failed in nopython mode")]
        raise RailgripError(
            Problem(
                WHERE,
                f"{type(controller).__name__}.kernel cannot be compiled",
                got=lines[0] if lines else type(error).__name__,
                cure="leave `kernel` out: the plain form runs without it, slower",
            )
        ) from error


def no_kernel() -> Compiled:
    """Return what stands in for a controller that is stepped from Python."""
    return compiled(NoProtection(), 1)


def plain_step(controller: Any, state: Any, measured: FloatArray, dt: float) -> FloatArray:
    """Step a plain controller on the engine's columns; raise RailgripError if it fails."""
    seen = ctl.Measured(
        wheel_speed=measured[:, ctl.WHEEL_SPEED].copy(),
        brake_cylinder_pressure=measured[:, ctl.CYLINDER_PRESSURE].copy(),
        dynamic_force=measured[:, ctl.DYNAMIC_FORCE].copy(),
        brake_demand=float(measured[0, ctl.BRAKE_DEMAND]),
        emergency=float(measured[0, ctl.EMERGENCY]),
        drive_demand=float(measured[0, ctl.DRIVE_DEMAND]),
    )
    n_axles = len(measured)
    columns = ctl.command_array(n_axles)
    try:
        command = controller.step(state, seen, dt)
        columns[:, ctl.DUMP_VALVE] = command.dump_valve
        columns[:, ctl.DYNAMIC_SHARE] = command.dynamic_share
        columns[:, ctl.SANDING] = command.sanding
        columns[:, ctl.REFERENCE_SPEED] = command.reference_speed
        if command.is_sliding is not None:
            columns[:, ctl.IS_SLIDING] = command.is_sliding
        if command.alarm is not None:
            columns[:, ctl.ALARM] = command.alarm
        if command.slip_range is not None:
            columns[:, ctl.SLIP_RANGE] = command.slip_range
        columns[:, ctl.WSP_STATE] = command.wsp_state
        if command.friction_share is not None:
            columns[:, ctl.FRICTION_SHARE] = command.friction_share
    except Exception as error:
        raise RailgripError(
            Problem(
                WHERE,
                f"{type(controller).__name__}.step failed",
                got=f"{type(error).__name__}: {error}",
                cure="railgrip check on its file",
            )
        ) from error
    return columns
