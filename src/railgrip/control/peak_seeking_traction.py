"""Peak-seeking traction: each motored axle is held at the peak of its adhesion curve.

The force of the rail is observed (`adhesion_kalman`), the torque leads the slip speed to a target,
and the target climbs to the peak of the curve by its observed slope (`peak_search`). Brakes work as
under `conventional_wsp`.
"""

from __future__ import annotations

from typing import Any

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_state import REFERENCE, SPEED
from railgrip.control.driving_reference import is_driving
from railgrip.control.peak_search import seek_peak, slip_aimed_at
from railgrip.control.plain_form import KernelController
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.traction_common import (
    acts_on,
    agree,
    brake_conventionally,
    command_motor,
    lead_slip,
    observe_while_driving,
    traction_initial,
)
from railgrip.control.traction_parameters import TARGET_START, PeakSeekingParameters
from railgrip.control.traction_state import DOUBT_OF_SLOPE, LOOKING, SHARE, TARGET
from railgrip.core.errors import Problem, RailgripError

HELD_SHARE = 0.5
"""Of the target: with less slip something else limits the wheel, and the curve does not show."""


def peak_seeking_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: every axle aims at the same slip, the slope unknown."""
    traction_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        base = axle_base(axle)
        state[base + TARGET] = parameters[TARGET_START]
        state[base + DOUBT_OF_SLOPE] = 0.1


def hold_at_peak(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    axle: int, dt: float,
) -> float:  # fmt: skip
    """Return the share of the demanded motor force that is permitted, 0..1; see `lead_slip`."""
    base = axle_base(axle)
    slip = state[base + SPEED] - state[REFERENCE]
    is_free = state[LOOKING] == axle + 1.0
    is_held = state[base + SHARE] < 0.999 and slip > HELD_SHARE * state[base + TARGET]
    seek_peak(parameters, state, base, slip, is_held and not is_free, dt)
    aim = slip_aimed_at(parameters, state, base, axle)
    return lead_slip(parameters, axle_setup, state, measured, axle, aim)


def peak_seeking_kernel(
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
            share = hold_at_peak(parameters, axle_setup, state, measured, axle, dt)
        command_motor(parameters, state, command, axle, share, dt)
    agree(axle_setup, state, command, measured.shape[0])


class PeakSeekingTraction(KernelController):
    """Peak-seeking traction as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : PeakSeekingParameters, optional
        The ordinary protection's (`ConventionalParameters`), `Driving` and `PeakSearch`.
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "dither: must lie between 0 and 1 …", and the like.

    Examples
    --------
    >>> PeakSeekingTraction().parameters.target_start
    0.6
    """

    kernel = staticmethod(peak_seeking_kernel)
    initial = staticmethod(peak_seeking_initial)
    state_size = staticmethod(state_size)

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        parameters = PeakSeekingParameters() if parameters is None else parameters
        check_search(parameters)
        super().__init__(parameters, period)


_POSITIVE = (
    "target_start", "target_least", "target_greatest", "slip_gain", "dither_time",
    "search_mean_time", "observer_lag", "force_error", "search_rate", "search_slope",
    "speed_noise", "force_drift",
)  # fmt: skip


def check_search(parameters: Any) -> None:
    """Refuse what no vehicle can mean."""
    wrong = [
        Problem(name, "must be positive", got=f"{getattr(parameters, name):g}")
        for name in _POSITIVE
        if not getattr(parameters, name) > 0.0
    ]
    if not 0.0 < parameters.dither < 1.0:
        got = f"{parameters.dither:g}"
        wrong.append(Problem("dither", "must lie between 0 and 1", got=got))
    if wrong:
        raise RailgripError(wrong)
