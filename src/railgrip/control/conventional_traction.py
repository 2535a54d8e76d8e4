"""Conventional traction anti-slip: torque is cut on a spin, and comes back by a step and a ramp.

A wheel spins when its slip speed, foreseen a little, passes a threshold, or when it gains speed
much faster than the train. Then its torque is cut at once; when the wheel adheres again a share of
the torque at which it broke away comes back, and the rest on a slow ramp. Brakes work as under
`conventional_wsp`.
"""

from __future__ import annotations

from typing import Any

from railgrip.control.contract import DYNAMIC_FORCE, FloatArray
from railgrip.control.conventional_parameters import LEAD_TIME
from railgrip.control.conventional_state import ACCELERATION, DECELERATION, REFERENCE, SPEED
from railgrip.control.driving_reference import is_driving
from railgrip.control.plain_form import KernelController
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.traction_common import (
    acts_on,
    agree,
    brake_conventionally,
    command_motor,
    demanded_force,
    observe_while_driving,
    traction_initial,
)
from railgrip.control.traction_parameters import (
    CUT_TIME,
    RAMP_TIME,
    SPIN_ACCELERATION,
    SPIN_LOWER,
    SPIN_LOWER_FLOOR,
    SPIN_UPPER,
    SPIN_UPPER_FLOOR,
    STEP_TO,
    ConventionalTractionParameters,
)
from railgrip.control.traction_state import IS_CUT, SHARE, SHARE_AT_SPIN
from railgrip.core.errors import Problem, RailgripError

SLOW = 0.8
"""Below it a wheel passes too few teeth for its acceleration to be believed, m/s."""
RETURNING = -0.3
"""A wheel that loses so much on the train, m/s², is on its way back: the cut ends, torque waits."""


def ease_torque(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    axle: int, dt: float,
) -> float:  # fmt: skip
    """Return the share of the demanded motor force that is permitted, 0..1.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract.
    axle : int
        Row of the axle.
    dt : float
        Period, [s].
    """
    base = axle_base(axle)
    reference = state[REFERENCE]
    lower = threshold(parameters[SPIN_LOWER], parameters[SPIN_LOWER_FLOOR], reference)
    upper = threshold(parameters[SPIN_UPPER], parameters[SPIN_UPPER_FLOOR], reference)
    spin = state[base + SPEED] - reference
    relative = state[base + ACCELERATION] + state[DECELERATION]
    if state[base + SPEED] < SLOW:
        relative = 0.0
    foreseen = spin + parameters[LEAD_TIME] * relative
    is_spinning = foreseen > upper or (spin > lower and relative > parameters[SPIN_ACCELERATION])
    share: float = state[base + SHARE]
    if state[base + IS_CUT] == 0.0:
        if not is_spinning:
            return float(min(1.0, share + dt / parameters[RAMP_TIME]))
        # while torque still builds up, what acts is less than what is permitted
        demand = demanded_force(axle_setup, state, measured, axle)
        if demand > 0.0:
            share = min(share, max(-measured[axle, DYNAMIC_FORCE], 0.0) / demand)
        state[base + IS_CUT] = 1.0
        state[base + SHARE_AT_SPIN] = share
    if spin < lower and relative < parameters[SPIN_ACCELERATION]:
        state[base + IS_CUT] = 0.0
        return float(min(1.0, max(share, parameters[STEP_TO] * state[base + SHARE_AT_SPIN])))
    if relative < RETURNING:
        return share
    return float(max(0.0, share - dt / parameters[CUT_TIME] * state[base + SHARE_AT_SPIN]))


def conventional_traction_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the control by one period; arguments as in the controller contract."""
    if not is_driving(measured):
        brake_conventionally(parameters, axle_setup, state, measured, command, dt)
        return
    observe_while_driving(parameters, axle_setup, state, measured, dt)
    for axle in range(measured.shape[0]):
        share = 1.0
        if acts_on(axle_setup, state, axle):
            share = ease_torque(parameters, axle_setup, state, measured, axle, dt)
        command_motor(parameters, state, command, axle, share, dt)
    agree(axle_setup, state, command, measured.shape[0])


class ConventionalTraction(KernelController):
    """Conventional traction anti-slip as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : ConventionalTractionParameters, optional
        The ordinary protection's (`ConventionalParameters`), `Driving` and `Easing`.
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "spin_lower: must lie between 0 and spin_upper …", and the like.

    Examples
    --------
    >>> ConventionalTraction().parameters.step_to
    0.8
    """

    kernel = staticmethod(conventional_traction_kernel)
    initial = staticmethod(traction_initial)
    state_size = staticmethod(state_size)

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        parameters = ConventionalTractionParameters() if parameters is None else parameters
        _check(parameters)
        super().__init__(parameters, period)


def _check(parameters: Any) -> None:
    """Refuse what no vehicle can mean."""
    band = 0.0 < parameters.spin_lower < parameters.spin_upper
    floors = 0.0 < parameters.spin_lower_floor < parameters.spin_upper_floor
    demands = {
        "spin_lower": (band, "must lie between 0 and spin_upper"),
        "spin_lower_floor": (floors, "must lie between 0 and spin_upper_floor"),
        "step_to": (0.0 <= parameters.step_to <= 1.0, "must lie between 0 and 1"),
        "cut_time": (parameters.cut_time > 0.0, "must be positive"),
        "ramp_time": (parameters.ramp_time > 0.0, "must be positive"),
        "speed_noise": (parameters.speed_noise > 0.0, "must be positive"),
        "force_drift": (parameters.force_drift > 0.0, "must be positive"),
    }
    wrong = [
        Problem(name, what, got=f"{getattr(parameters, name):g}")
        for name, (is_right, what) in demands.items()
        if not is_right
    ]
    if wrong:
        raise RailgripError(wrong)
