"""Temperature-controlled adhesion under the adaptive supervisor.

Heat cleans a rail that can be cleaned; on leaves it changes nothing, and the slip that heats most
is the worst. So the supervisor (`adaptive_supervisor`) decides from the forces that are observed:
axles in macro-slip are led to the slip that their admissible temperature rise asks for
(`temperature_controlled`), in micro-slip to no more than a small one, and until the first decision
to one between. For braking and for driving.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from railgrip.control.adaptive_parameters import (
    LEAD_AXLES,
    Supervision,
    check_supervision,
)
from railgrip.control.adaptive_round import begin_supervision, time_to_look
from railgrip.control.adaptive_state import (
    FACTOR,
    STATE,
    adaptive_state_size,
    axle_place,
    system_place,
)
from railgrip.control.adaptive_supervisor import supervise
from railgrip.control.contract import (
    BRAKED,
    MICRO,
    MIDDLE,
    MOTORED,
    REFERENCE_SPEED,
    SLIP_RANGE,
    WSP_STATE,
    FloatArray,
)
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    FREED_AXLE,
    IS_FAULTY,
    REFERENCE,
    SAFETY_FILL,
    SPEED,
    axle_base,
)
from railgrip.control.conventional_state import state_size as conventional_state_size
from railgrip.control.driving_reference import is_driving
from railgrip.control.observed_forces import clear_sums, leave_out, weigh_axle
from railgrip.control.parameter_sets import joined
from railgrip.control.plain_form import KernelController
from railgrip.control.slip_ranges import N_RANGED, range_place
from railgrip.control.temperature_axle import brake_axle, drive_axle
from railgrip.control.temperature_controlled import (
    check_temperature,
    follow_believed,
    observe_forces,
    temperature_initial,
)
from railgrip.control.temperature_parameters import (
    ACCURACY,
    GREATEST_SLIP,
    TemperatureOnly,
)
from railgrip.control.temperature_state import (
    FRICTION,
    own_base,
)
from railgrip.control.temperature_state import state_size as temperature_state_size
from railgrip.core.errors import Problem, RailgripError


class SlipLimits(NamedTuple):
    """Greatest slip in the lower ranges; in macro-slip the temperature decides.

    Parameters
    ----------
    micro_slip, middle_slip : float
        In micro-slip, and while it is not yet decided.
    micro_accuracy : float
        How exactly the train speed must be known while an axle is in micro-slip, as a slip.
    """

    micro_slip: float = 0.015
    middle_slip: float = 0.06
    micro_accuracy: float = 0.008


TemperatureAdaptiveParameters: Any = joined(
    "TemperatureAdaptiveParameters",
    ConventionalParameters,
    TemperatureOnly,
    SlipLimits,
    Supervision,
)
"""Those of temperature control come first, the supervisor's last."""

_place = TemperatureAdaptiveParameters._fields.index
MICRO_SLIP: Final = _place("micro_slip")
MIDDLE_SLIP: Final = _place("middle_slip")
MICRO_ACCURACY: Final = _place("micro_accuracy")
SUPERVISION: Final = _place("supervise_every") - N_RANGED
"""Seen from here on, the parameters of `Supervision` stand where `adaptive_parameters` has them."""
N_PARAMETERS: Final = len(TemperatureAdaptiveParameters._fields)


def adaptive_part(n_axles: int) -> int:
    """Return from where on the state is seen so that the places of `adaptive_state` hold in it."""
    return temperature_state_size(n_axles) - conventional_state_size(n_axles)


def axle_parameters_place(n_axles: int) -> int:
    """Return where the state holds a copy of the parameters, with the slip limit of one axle."""
    return adaptive_part(n_axles) + adaptive_state_size(n_axles)


def temperature_adaptive_state_size(n_axles: int) -> int:
    """Return the length of the state array.

    Examples
    --------
    >>> temperature_adaptive_state_size(4) > temperature_state_size(4)
    True
    """
    return axle_parameters_place(n_axles) + N_PARAMETERS


def temperature_adaptive_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: of temperature control, then of the supervisor."""
    temperature_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    copy = axle_parameters_place(n_axles)
    for i in range(N_PARAMETERS):
        state[copy + i] = parameters[i]
    supervision = parameters[SUPERVISION:]
    adaptive = state[adaptive_part(n_axles) :]
    for axle in range(n_axles):
        adaptive[axle_place(axle, n_axles) + FACTOR] = 1.0
    begin_supervision(supervision, adaptive, n_axles, supervision[LEAD_AXLES])


def weigh_forces(
    supervision: FloatArray, axle_setup: FloatArray, state: FloatArray, adaptive: FloatArray,
    n_axles: int, sign: float, dt: float,
) -> None:  # fmt: skip
    """Weigh what every axle reaches by the force of the rail, driving (sign 1) or braking (-1)."""
    clear_sums(adaptive, n_axles)
    n_lead = 0.0
    for axle in range(n_axles):
        base = axle_base(axle)
        works = axle_setup[axle, MOTORED] + (axle_setup[axle, BRAKED] if sign < 0.0 else 0.0)
        is_sound = state[base + IS_FAULTY] == 0.0 and state[base + SAFETY_FILL] == 0.0
        if works == 0.0 or not is_sound or state[FREED_AXLE] == axle + 1.0:
            leave_out(adaptive, axle, n_axles)
            continue
        force = sign * state[own_base(n_axles, axle) + FRICTION]
        slip_speed = sign * (state[base + SPEED] - state[REFERENCE])
        growth = sign * (state[base + ACCELERATION] + state[DECELERATION])
        n_lead = weigh_axle(
            supervision, adaptive, axle, n_axles, n_lead, force, slip_speed, growth,
            state[REFERENCE], dt,
        )  # fmt: skip


def greatest_slip(parameters: FloatArray, slip_range: float) -> float:
    """Return the slip that an axle in a range is led to at most."""
    limit: float = parameters[GREATEST_SLIP]
    if slip_range == MICRO:
        limit = parameters[MICRO_SLIP]
    elif slip_range == MIDDLE:
        limit = parameters[MIDDLE_SLIP]
    return limit


def temperature_adaptive_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the control by one period; arguments as in the controller contract."""
    n_axles = measured.shape[0]
    adaptive = state[adaptive_part(n_axles) :]
    accuracy = parameters[ACCURACY]
    for axle in range(n_axles):
        if adaptive[range_place(axle, n_axles)] == MICRO:
            accuracy = min(accuracy, parameters[MICRO_ACCURACY])
    observe_forces(parameters, axle_setup, state, measured, accuracy, dt)
    driving = is_driving(measured)
    supervision = parameters[SUPERVISION:]
    look = time_to_look(supervision, adaptive, n_axles, dt)
    if look > 0.0:
        sign = 1.0 if driving else -1.0
        weigh_forces(supervision, axle_setup, state, adaptive, n_axles, sign, look)
        command[0, WSP_STATE] = adaptive[system_place(n_axles) + STATE]
        supervise(supervision, adaptive, n_axles, look)
    own_parameters = state[axle_parameters_place(n_axles) :]
    for axle in range(n_axles):
        slip_range = adaptive[range_place(axle, n_axles)]
        own_parameters[GREATEST_SLIP] = greatest_slip(parameters, slip_range)
        if driving:
            drive_axle(own_parameters, axle_setup, state, measured, command, axle, dt)
        else:
            brake_axle(own_parameters, axle_setup, state, measured, command, axle, dt)
        command[axle, REFERENCE_SPEED] = state[REFERENCE]
        command[axle, SLIP_RANGE] = slip_range
    follow_believed(axle_setup, state, measured, command)


class TemperatureAdaptive(KernelController):
    """Temperature control under the adaptive supervisor, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : TemperatureAdaptiveParameters, optional
        Those of temperature control, `SlipLimits`, and the supervisor's (`Supervision`).
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "micro_slip: must lie between 0 and middle_slip …", as `TemperatureControlled` and
        `check_supervision`.

    Examples
    --------
    >>> TemperatureAdaptive().parameters.micro_slip
    0.015
    """

    kernel = staticmethod(temperature_adaptive_kernel)
    initial = staticmethod(temperature_adaptive_initial)
    state_size = staticmethod(temperature_adaptive_state_size)

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        parameters = TemperatureAdaptiveParameters() if parameters is None else parameters
        check_temperature(parameters, period)
        check_supervision(parameters)
        if not 0.0 < parameters.micro_slip <= parameters.middle_slip < 1.0:
            got = f"{parameters.micro_slip:g} and {parameters.middle_slip:g}"
            raise RailgripError(
                Problem(
                    "micro_slip", "must lie between 0 and middle_slip, and that below 1", got=got
                )
            )
        super().__init__(parameters, period)
