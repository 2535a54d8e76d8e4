"""The plain form of a controller that is written as a kernel: the same function, uncompiled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from railgrip.control.contract import (
    Command,
    FloatArray,
    Initial,
    Kernel,
    Measured,
    Setup,
    command_array,
    command_from_array,
    measured_array,
    setup_array,
)


class KernelState(NamedTuple):
    """Memory of the plain form: the arrays that the kernel works on."""

    axle_setup: FloatArray
    values: FloatArray
    command: FloatArray
    has_started: list[bool]


class KernelController:
    """A controller whose ``step`` calls its ``kernel``; a subclass brings the functions.

    Parameters
    ----------
    parameters : NamedTuple of floats
        Of the controller.
    period : float
        Time between two steps, [s].
    """

    kernel: Kernel
    initial: Initial
    state_size: Callable[[int], int]

    def __init__(self, parameters: Any, period: float) -> None:
        self.parameters = parameters
        self.period = period
        self._parameter_array = np.array(parameters, dtype=np.float64)

    def reset(self, setup: Setup) -> KernelState:
        """Return a new state."""
        return KernelState(
            axle_setup=setup_array(setup),
            values=np.zeros(self.state_size(setup.n_axles)),
            command=command_array(setup.n_axles),
            has_started=[False],
        )

    def step(self, state: KernelState, measured: Measured, dt: float) -> Command:
        """Return the command for the next period."""
        columns = measured_array(measured)
        if not state.has_started[0]:
            self.initial(self._parameter_array, state.axle_setup, state.values, columns)
            state.has_started[0] = True
        self.kernel(
            self._parameter_array, state.axle_setup, state.values, columns, state.command, dt
        )
        return command_from_array(state.command)
