"""Adaptive wheel-slide protection: a supervisor that holds the axles in macro- or in micro-slip.

Sliding helps on some rail (water and detergent: it is rubbed off) and harms on other (leaves: the
film stays, friction falls with slip). The supervisor finds out from the forces that the axles
reach, without data of the vehicle or of the rail. Under it works the ordinary WSP.

References
----------
Patent text "Dispositivo y procedimiento para el control antideslizante adaptativo", figures 2 and
4, claims 1-11. Using it in a vehicle may need its owner's consent.
"""

from __future__ import annotations

from typing import Any

from railgrip.control.adaptive_forces import weigh_axles
from railgrip.control.adaptive_parameters import (
    BY_LOAD,
    LEAD_AXLES,
    MOTORED_FACTOR,
    SCALE,
    AdaptiveParameters,
    check_supervision,
)
from railgrip.control.adaptive_round import begin_supervision, time_to_look
from railgrip.control.adaptive_state import FACTOR, HAVE_CHANGED, STATE
from railgrip.control.adaptive_supervisor import supervise
from railgrip.control.contract import AXLE_LOAD, MOTORED, WSP_STATE, FloatArray
from railgrip.control.conventional_wsp import conventional_initial
from railgrip.control.plain_form import KernelController
from railgrip.control.slip_ranges import (
    check_bands,
    observe_in_ranges,
    protect_in_ranges,
    set_bands,
)
from railgrip.control.state_layout import axle_base, state_size


def adaptive_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start (INIT in figure 4)."""
    conventional_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        factor = parameters[MOTORED_FACTOR] if axle_setup[axle, MOTORED] > 0.0 else 1.0
        if parameters[SCALE] == BY_LOAD:
            factor *= axle_setup[0, AXLE_LOAD] / axle_setup[axle, AXLE_LOAD]
        state[axle_base(axle) + FACTOR] = factor
    begin_supervision(parameters, state, n_axles, parameters[LEAD_AXLES])
    set_bands(parameters, state, n_axles)


def adaptive_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the protection by one period; arguments as in the controller contract."""
    n_axles = measured.shape[0]
    observe_in_ranges(parameters, state, measured, dt)
    look = time_to_look(parameters, state, dt)
    if look > 0.0:
        weigh_axles(parameters, state, n_axles, look)
        command[0, WSP_STATE] = state[STATE]
        supervise(parameters, state, n_axles, look)
        if state[HAVE_CHANGED] > 0.0:
            set_bands(parameters, state, n_axles)
    protect_in_ranges(parameters, axle_setup, state, measured, command, dt)


class AdaptiveWSP(KernelController):
    """Adaptive macro/micro protection as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : AdaptiveParameters, optional
        Those of the ordinary WSP, `RangeBands` and `Supervision`.
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        As `check_bands` and `check_supervision`.

    Examples
    --------
    >>> AdaptiveWSP().parameters.rule
    1.0
    """

    kernel = staticmethod(adaptive_kernel)
    initial = staticmethod(adaptive_initial)
    state_size = staticmethod(state_size)

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        parameters = AdaptiveParameters() if parameters is None else parameters
        check_bands(parameters, parameters)
        check_supervision(parameters)
        super().__init__(parameters, period)
