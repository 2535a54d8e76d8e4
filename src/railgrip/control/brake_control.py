"""Brake control: a central unit, local units with their friction estimate, above the WSP.

The central unit asks for a deceleration, watches it and corrects all brakes alike; each local unit
turns its share into cylinder pressure with the friction that it estimates. Both act on what the
brakes are asked for; beneath them the wheel-slide protection keeps its valves.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.control import brake_control_table as t
from railgrip.control.brake_control_table import BrakeControlParameters, brake_state_size
from railgrip.control.central_unit import ask, correct, gradient_force
from railgrip.control.contract import FloatArray
from railgrip.control.local_units import achieved_share, estimate_axle, set_pressure, watch_brake

GREATEST_REDISTRIBUTION = 1.5
"""Sound brakes take over so much at most, over their own share."""


def _begin(setup: FloatArray, state: FloatArray, measured: FloatArray) -> None:
    for axle in range(measured.shape[0]):
        own = t.FIRST_AXLE + axle * t.N_AXLE
        state[own + t.RING] = measured[axle, t.DISC_TEMPERATURE]
        state[own + t.HUB] = measured[axle, t.DISC_TEMPERATURE]
        clamp = setup[axle, t.CLAMP_PER_PRESSURE] * setup[axle, t.FULL_PRESSURE]
        clamp = (clamp + setup[axle, t.CLAMP_OFFSET]) * setup[axle, t.CLAMP_PER_BLOCK]
        state[own + t.CLAMP] = max(clamp, 0.0)
        state[own + t.ESTIMATE] = setup[axle, t.MODEL]


def brake_control_kernel(
    parameters: FloatArray,
    rules: FloatArray,
    setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance brake control by one period.

    Parameters
    ----------
    parameters : ndarray
        `BrakeControlParameters` as an array.
    rules : ndarray (rule, `limit_rules.N_RULE`)
        Bounds and weights of the estimate, and when they hold.
    setup, measured, command : ndarray (axle, column)
        As `brake_control_table` numbers them; the command is written.
    state : ndarray
        See `brake_state_size`; zero before the first call.
    dt : float
        Period [s].
    """
    n_axles = measured.shape[0]
    if state[t.COUNT] == 0.0:
        _begin(setup, state, measured)
    asked = ask(parameters, state, measured, dt)
    achieved = achieved_share(setup, state, measured)
    correction = correct(parameters, state, measured, asked, achieved, dt)
    demanded = measured[0, t.BRAKE_DEMAND] * parameters[t.FULL_DECELERATION]
    wanted = asked * (1.0 + correction) + gradient_force(parameters, measured)
    factor = max(wanted, 0.0) / demanded if demanded > 0.0 else 1.0
    is_passed_on = parameters[t.ESTIMATOR] == t.ALWAYS or (
        parameters[t.ESTIMATOR] == t.PAST_THRESHOLD and state[t.IS_PAST] > 0.0
    )
    sound = 0.0
    total = 0.0
    failed = 0.0
    for axle in range(n_axles):
        if setup[axle, t.BRAKED] > 0.0:
            is_failed = watch_brake(setup, state, measured, axle, parameters[t.FILLING], dt)
            failed += is_failed
            total += setup[axle, t.FULL_FORCE]
            sound += setup[axle, t.FULL_FORCE] * (1.0 - is_failed)
            is_own = int(setup[axle, t.ESTIMATE_AXLE]) == axle
            if is_own and parameters[t.ESTIMATOR] != t.OFF:
                estimate_axle(parameters, rules, setup, state, measured, axle, dt)
    state[t.N_FAILED] = failed
    if parameters[t.REDISTRIBUTES] > 0.0 and failed > 0.0:
        factor *= min(total / max(sound, 1.0), GREATEST_REDISTRIBUTION)
    limited = 0.0
    braked = 0.0
    for axle in range(n_axles):
        command[axle, t.FORCE_FACTOR] = factor
        command[axle, t.PRESSURE_FACTOR] = 1.0
        command[axle, t.ESTIMATED_FRICTION] = 0.0
        if setup[axle, t.BRAKED] > 0.0:
            braked += 1.0
            limited += set_pressure(parameters, setup, state, measured, command, axle, is_passed_on)
    state[t.SHARE_LIMITED] = limited / max(braked, 1.0)
    command[0, t.CORRECTION_OUT] = correction
    state[t.COUNT] += 1.0


class BrakeControlState(NamedTuple):
    """Memory of the plain form.

    Parameters
    ----------
    values, command : ndarray
        The kernel's state and its last command.
    """

    values: FloatArray
    command: FloatArray


class BrakeControl:
    """Brake control in plain Python: the kernel that the engine compiles, called as it is.

    Parameters
    ----------
    parameters : BrakeControlParameters
        Of central and local units.
    rules : ndarray (rule, `limit_rules.N_RULE`)
        From `limit_rules.rule_numbers`.
    setup : ndarray (axle, column)
        What is known of the brakes; columns in `brake_control_table`.

    Examples
    --------
    >>> from railgrip.control.limit_rules import LimitRule, rule_numbers
    >>> setup = np.zeros((1, t.N_SETUP))
    >>> setup[0, [t.FULL_PRESSURE, t.FULL_FORCE, t.CLAMP_PER_PRESSURE]] = 3e5, 8.1e3, 0.3
    >>> setup[0, [t.CLAMP_PER_BLOCK, t.NOMINAL_TREAD, t.BRAKED]] = 1, 0.3, 1
    >>> setup[0, [t.MODEL, t.DISC]] = 0.3, 65
    >>> rules = np.array([rule_numbers(LimitRule())])
    >>> control = BrakeControl(BrakeControlParameters(dead_time=0.0), rules, setup)
    >>> measured = np.zeros((1, t.N_MEASURED))
    >>> measured[0, [t.BELIEVED_TREAD, t.LEARNED_FRICTION, t.BRAKE_DEMAND]] = 0.3, 0.9, 0.5
    >>> command = control.step(control.reset(), measured, 0.05)
    >>> round(float(command[0, t.PRESSURE_FACTOR]), 4)
    1.1111
    """

    kernel = staticmethod(brake_control_kernel)

    def __init__(
        self, parameters: BrakeControlParameters, rules: FloatArray, setup: FloatArray
    ) -> None:
        self.parameters = parameters
        self.rules = np.ascontiguousarray(rules)
        self.setup = setup
        self._array = np.array(parameters, dtype=np.float64)

    def reset(self) -> BrakeControlState:
        """Return a new state."""
        n_axles = len(self.setup)
        command = np.zeros((n_axles, t.N_COMMAND))
        command[:, : t.ESTIMATED_FRICTION] = 1.0
        return BrakeControlState(np.zeros(brake_state_size(n_axles)), command)

    def step(self, state: BrakeControlState, measured: FloatArray, dt: float) -> Any:
        """Return the command (axle, column) for the next period."""
        self.kernel(self._array, self.rules, self.setup, state.values, measured, state.command, dt)
        return state.command.copy()
