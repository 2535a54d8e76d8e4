"""Conventional wheel-slide protection (WSP): each axle in a slip band under one reference speed.

It reads the wheels and keeps a reference speed of the train (`train_observer`), compares each
wheel's slip with a band (`slip_band`) and sets the axle's dump valve, dynamic brake and sand
(`axle_protection`). Macro slip lets wheels slide deep, for rail that sliding cleans; micro slip
keeps them near the peak of the adhesion curve, for rail that sliding does not help.
"""

from __future__ import annotations

from railgrip.control.axle_protection import protect_axles
from railgrip.control.axle_signals import take_setup
from railgrip.control.contract import WHEEL_SPEED, FloatArray
from railgrip.control.conventional_parameters import (
    DEAD_TIME,
    DECELERATION_PER_PRESSURE,
    SLIP_LOWER,
    SLIP_UPPER,
    ConventionalParameters,
)
from railgrip.control.conventional_state import (
    ADHERED_CLOCK,
    DEAD_CLOCK,
    DIAMETER,
    DYNAMIC_PERMITTED,
    FASTEST_LAG,
    IS_FAULTY,
    LAST_READING,
    LOWER_SHARE,
    PRESSURE_GAIN,
    REFERENCE,
    SEEN_SPEED,
    SPEED,
    SPEED_LAG,
    UPPER_SHARE,
    WITNESS_CLOCK,
)
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.faulty_axle import follow_neighbours
from railgrip.control.plain_form import KernelController
from railgrip.control.state_layout import (
    axle_base,
    n_places,
    state_size,
)
from railgrip.control.train_observer import observe_train
from railgrip.control.wheel_speed import GREATEST_SPEED
from railgrip.core.errors import Problem, RailgripError, unknown_name

BANDS = {"macro": (0.08, 0.16), "micro": (0.008, 0.02)}
"""Lower and upper slip of the named bands (trial values)."""

LONG_AGO = 1.0e3  # s: every axle starts as one that has adhered for long


def conventional_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: all axles adhere, the fastest shows the train."""
    take_setup(axle_setup, state)
    fastest = 0.0
    for axle in range(measured.shape[0]):
        base = axle_base(axle)
        reading = measured[axle, WHEEL_SPEED]
        speed = abs(reading) if -GREATEST_SPEED < reading < GREATEST_SPEED else 0.0
        fastest = max(fastest, speed)
        state[base + DIAMETER] = 1.0
        state[base + LOWER_SHARE] = parameters[SLIP_LOWER]
        state[base + UPPER_SHARE] = parameters[SLIP_UPPER]
        state[base + DYNAMIC_PERMITTED] = 1.0
        state[base + ADHERED_CLOCK] = LONG_AGO
        state[base + WITNESS_CLOCK] = LONG_AGO
        state[base + SPEED] = speed
        state[base + SPEED_LAG] = speed
        state[base + LAST_READING] = speed
    for place in range(measured.shape[0], n_places(measured.shape[0])):
        state[axle_base(place) + IS_FAULTY] = 1.0
        state[axle_base(place) + DEAD_CLOCK] = parameters[DEAD_TIME]
    state[REFERENCE] = fastest
    state[FASTEST_LAG] = fastest
    state[SEEN_SPEED] = fastest
    state[PRESSURE_GAIN] = parameters[DECELERATION_PER_PRESSURE]


def conventional_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the WSP by one period; arguments as in the controller contract."""
    observe_train(parameters, state, measured, parameters[SLIP_LOWER], dt)
    learn_diameters(parameters, state, measured, dt)
    protect_axles(parameters, state, command, dt)
    follow_neighbours(axle_setup, state, measured, command)


class ConventionalWSP(KernelController):
    """Conventional WSP as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : ConventionalParameters, optional
        The starting values are the macro band on illustrative trains.
    band : str, optional
        ``"macro"`` or ``"micro"``: sets the two slip thresholds.
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "band: slip band 'mirco' unknown; known: macro, micro; did you mean 'micro'?", or
        "slip_lower: must lie between 0 and slip_upper ...".

    Examples
    --------
    >>> ConventionalWSP(band="micro").parameters.slip_upper
    0.02
    """

    kernel = staticmethod(conventional_kernel)
    initial = staticmethod(conventional_initial)
    state_size = staticmethod(state_size)

    def __init__(
        self,
        parameters: ConventionalParameters | None = None,
        *,
        band: str | None = None,
        period: float = 0.01,
    ) -> None:
        parameters = ConventionalParameters() if parameters is None else parameters
        if band is not None:
            if band not in BANDS:
                raise RailgripError(unknown_name("band", "slip band", band, BANDS))
            lower, upper = BANDS[band]
            parameters = parameters._replace(slip_lower=lower, slip_upper=upper)
        if not 0.0 < parameters.slip_lower < parameters.slip_upper < 1.0:
            raise RailgripError(
                Problem(
                    "slip_lower",
                    "must lie between 0 and slip_upper, and that below 1",
                    got=f"{parameters.slip_lower:g} and {parameters.slip_upper:g}",
                )
            )
        super().__init__(parameters, period)
