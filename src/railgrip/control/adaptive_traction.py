"""Adaptive traction: the supervisor of macro- and micro-slip over driven wheels.

The source says of its supervisor that it serves "anti-slide or traction control" (303, 312). Axles
in macro-slip spin deep, which cleans the rail where it can be cleaned; axles in micro-slip seek the
peak of their adhesion curve (`peak_seeking_traction`). Which is better is judged by the tractive
forces that are observed, as the adaptive protection does when braking. Brakes work as under
`conventional_wsp`.
"""

from __future__ import annotations

from typing import Any

from railgrip.control.adaptive_parameters import SCALE, UNSCALED, check_supervision
from railgrip.control.adaptive_round import begin_supervision, time_to_look
from railgrip.control.adaptive_state import F0, FACTOR, IS_ARMED, RANGE, STATE
from railgrip.control.adaptive_supervisor import supervise
from railgrip.control.contract import MACRO, MICRO, SLIP_RANGE, WSP_STATE, FloatArray
from railgrip.control.conventional_state import ACCELERATION, DECELERATION, REFERENCE, SPEED
from railgrip.control.driving_reference import is_driving
from railgrip.control.force_weighing import OBSERVED_AFTER, add_up, leave_out, weigh_axle, weighing
from railgrip.control.peak_seeking_traction import check_search, hold_at_peak, peak_seeking_initial
from railgrip.control.plain_form import KernelController
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.traction_common import (
    acts_on,
    agree,
    brake_conventionally,
    command_motor,
    lead_slip,
    observe_while_driving,
)
from railgrip.control.traction_parameters import (
    MACRO_SLIP,
    MACRO_SLIP_FLOOR,
    SUPERVISION,
    AdaptiveTractionParameters,
)
from railgrip.control.traction_state import FORCE, LOAD, LOOKING, SHARE
from railgrip.core.errors import Problem, RailgripError

WHOLE = 0.999
"""From this share of the demand on the motor is not limited."""
ADHERING = 0.1
"""Slip speed below which a driven wheel adheres, m/s."""


def adaptive_traction_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: of the peak seeker, then of the supervisor."""
    peak_seeking_initial(parameters, axle_setup, state, measured)
    supervision = parameters[SUPERVISION:]
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        factor = 1.0
        if supervision[SCALE] != UNSCALED:
            factor = state[axle_base(0) + LOAD] / state[axle_base(axle) + LOAD]
        state[axle_base(axle) + FACTOR] = factor
    begin_supervision(supervision, state, n_axles, 0.0)


def look_at_forces(
    supervision: FloatArray, axle_setup: FloatArray, state: FloatArray, n_axles: int, dt: float
) -> None:
    """Weigh what every motored axle reaches; one that runs free tells nothing.

    Parameters
    ----------
    supervision : ndarray
        Those of `Supervision` at the places that `adaptive_parameters` has for them.
    axle_setup, state : ndarray
        As in the controller contract.
    n_axles : int
        Number of axles.
    dt : float
        Time since the last look, [s].
    """
    same = weighing(supervision, state[REFERENCE], OBSERVED_AFTER, dt)
    for axle in range(n_axles):
        base = axle_base(axle)
        is_free = state[LOOKING] == axle + 1.0
        works = acts_on(axle_setup, state, axle) and not is_free
        spin = state[base + SPEED] - state[REFERENCE]
        if works and state[base + SHARE] >= WHOLE and spin < ADHERING:
            # the effort bounds its force, not the rail: what it once had says nothing of this rail
            state[base + F0] = 0.0
            state[base + IS_ARMED] = 1.0
        growth = state[base + ACCELERATION] + state[DECELERATION]
        weigh_axle(same, state, base, works, state[base + FORCE], spin, growth, dt)
    add_up(supervision, state, n_axles)


def spin_deep(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    axle: int,
) -> float:  # fmt: skip
    """Return the share of the demanded motor force that holds an axle in macro-slip, 0..1."""
    aim = threshold(parameters[MACRO_SLIP], parameters[MACRO_SLIP_FLOOR], state[REFERENCE])
    return lead_slip(parameters, axle_setup, state, measured, axle, aim)


def adaptive_traction_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the control by one period; arguments as in the controller contract."""
    n_axles = measured.shape[0]
    if not is_driving(measured):
        brake_conventionally(parameters, axle_setup, state, measured, command, dt)
        command[0, WSP_STATE] = 0.0
        for axle in range(n_axles):
            leave_out(state, axle)
            command[axle, SLIP_RANGE] = 0.0
        return
    observe_while_driving(parameters, axle_setup, state, measured, dt)
    supervision = parameters[SUPERVISION:]
    look = time_to_look(supervision, state, dt)
    if look > 0.0:
        look_at_forces(supervision, axle_setup, state, n_axles, look)
        command[0, WSP_STATE] = state[STATE]
        supervise(supervision, state, n_axles, look)
    for axle in range(n_axles):
        share = 1.0
        if acts_on(axle_setup, state, axle):
            if state[axle_base(axle) + RANGE] == MICRO:
                share = hold_at_peak(parameters, axle_setup, state, measured, axle, dt)
            else:
                share = spin_deep(parameters, axle_setup, state, measured, axle)
        command_motor(parameters, state, command, axle, share, dt)
        command[axle, SLIP_RANGE] = state[axle_base(axle) + RANGE]
    agree(axle_setup, state, command, n_axles)


class AdaptiveTraction(KernelController):
    """Adaptive traction as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : AdaptiveTractionParameters, optional
        Those of the peak seeker, `DeepSlip`, and the supervisor's (`Supervision`).
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "start: must be 1 (micro) or 2 (macro) …", as `PeakSeekingTraction` and
        `check_supervision`.

    Examples
    --------
    >>> AdaptiveTraction().parameters.rule
    0.0
    """

    kernel = staticmethod(adaptive_traction_kernel)
    initial = staticmethod(adaptive_traction_initial)
    state_size = staticmethod(state_size)

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        parameters = AdaptiveTractionParameters() if parameters is None else parameters
        check_search(parameters)
        check_supervision(parameters)
        _check(parameters)
        super().__init__(parameters, period)


def _check(parameters: Any) -> None:
    """Refuse what no driven train can mean."""
    demands = {
        "start": (parameters.start in (MICRO, MACRO), "must be 1 (micro) or 2 (macro)"),
        "macro_slip": (0.0 < parameters.macro_slip < 1.0, "must lie between 0 and 1"),
        "macro_slip_floor": (parameters.macro_slip_floor > 0.0, "must be positive"),
    }
    wrong = [
        Problem(name, what, got=f"{getattr(parameters, name):g}")
        for name, (is_right, what) in demands.items()
        if not is_right
    ]
    if wrong:
        raise RailgripError(wrong)
