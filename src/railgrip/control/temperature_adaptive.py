"""Temperature-controlled adhesion under the adaptive supervisor.

Heat cleans a rail that can be cleaned; on leaves it changes nothing, and the slip that heats most
is the worst. So the supervisor (`adaptive_supervisor`) decides from the forces that are observed:
axles in macro-slip are led to the slip that their admissible temperature rise asks for
(`temperature_controlled`), in micro-slip to no more than a small one, and until the first decision
to one between. For braking and for driving.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from railgrip.control.adaptive_parameters import LEAD_AXLES, Supervision, check_supervision
from railgrip.control.adaptive_round import begin_supervision, time_to_look
from railgrip.control.adaptive_state import FACTOR as SIGNAL_FACTOR
from railgrip.control.adaptive_state import HAVE_CHANGED, NEEDED_ACCURACY, RANGE, STATE
from railgrip.control.adaptive_supervisor import supervise
from railgrip.control.axle_protection import freed_place
from railgrip.control.contract import (
    MICRO,
    WSP_STATE,
    FloatArray,
)
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    IS_BRAKED,
    IS_FAULTY,
    IS_MOTORED,
    REFERENCE,
    SAFETY_FILL,
    SPEED,
)
from railgrip.control.driving_reference import is_driving
from railgrip.control.force_weighing import OBSERVED_AFTER, add_up, weigh_axle, weighing
from railgrip.control.parameter_sets import joined
from railgrip.control.plain_form import KernelController
from railgrip.control.side_by_side import count_equal
from railgrip.control.slip_ranges import N_RANGED, by_range, give_ranges
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups, state_size
from railgrip.control.temperature_controlled import (
    check_temperature,
    follow_believed,
    lead_axles,
    observe_forces,
    temperature_initial,
)
from railgrip.control.temperature_parameters import ACCURACY, GREATEST_SLIP, TemperatureOnly
from railgrip.control.temperature_state import FRICTION, SLIP_LIMIT
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


def temperature_adaptive_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: of temperature control, then of the supervisor."""
    temperature_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    supervision = parameters[SUPERVISION:]
    for axle in range(n_axles):
        state[axle_base(axle) + SIGNAL_FACTOR] = 1.0
    begin_supervision(supervision, state, n_axles, supervision[LEAD_AXLES])
    limit_slips(parameters, state, n_axles)


def weigh_forces(
    supervision: FloatArray, state: FloatArray, n_axles: int, sign: float, dt: float
) -> None:
    """Weigh what every axle reaches by the force of the rail, driving (sign 1) or braking (-1)."""
    same = weighing(supervision, state[REFERENCE], OBSERVED_AFTER, dt)
    reference, deceleration = state[REFERENCE], state[DECELERATION]
    freed = freed_place(state)
    is_braking = sign < 0.0
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            can_brake = is_braking & (state[base + IS_BRAKED] > 0.0)
            is_sound = (state[base + IS_FAULTY] == 0.0) & (state[base + SAFETY_FILL] == 0.0)
            works = ((state[base + IS_MOTORED] > 0.0) | can_brake) & is_sound & (base != freed)
            force = sign * state[base + FRICTION]
            slip_speed = sign * (state[base + SPEED] - reference)
            growth = sign * (state[base + ACCELERATION] + deceleration)
            weigh_axle(same, state, base, works, force, slip_speed, growth, dt)
    add_up(supervision, state, n_axles)


def limit_slips(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Put into the state the greatest slip of every axle, and how exact the narrowest range is."""
    n_micro = 0
    for group in range(groups(n_axles)):
        first = group_base(group)
        n_micro += count_equal(state, first + RANGE, MICRO)
        for base in range(first, first + GROUP):
            state[base + SLIP_LIMIT] = by_range(
                state, base, parameters[MICRO_SLIP], parameters[MIDDLE_SLIP],
                parameters[GREATEST_SLIP],
            )  # fmt: skip
    accuracy = parameters[ACCURACY]
    state[NEEDED_ACCURACY] = min(accuracy, parameters[MICRO_ACCURACY]) if n_micro > 0 else accuracy
    state[HAVE_CHANGED] = 0.0


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
    observe_forces(parameters, axle_setup, state, measured, state[NEEDED_ACCURACY], dt)
    supervision = parameters[SUPERVISION:]
    look = time_to_look(supervision, state, dt)
    if look > 0.0:
        sign = 1.0 if is_driving(measured) else -1.0
        weigh_forces(supervision, state, n_axles, sign, look)
        command[0, WSP_STATE] = state[STATE]
        supervise(supervision, state, n_axles, look)
        if state[HAVE_CHANGED] > 0.0:
            limit_slips(parameters, state, n_axles)
    lead_axles(parameters, axle_setup, state, measured, command, dt)
    give_ranges(state, command)
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
    state_size = staticmethod(state_size)

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
