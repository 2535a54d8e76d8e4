"""No wheel-slide protection: what the protected train is compared with."""

from __future__ import annotations

from typing import NamedTuple

from railgrip.control.contract import (
    REFERENCE_SPEED,
    WHEEL_SPEED,
    Command,
    FloatArray,
    Measured,
    Setup,
    command_array,
    command_from_array,
    measured_array,
    setup_array,
)


def no_protection_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Believe the fastest wheel and leave all valves filling; arguments as in the contract."""
    fastest = 0.0
    for axle in range(measured.shape[0]):
        fastest = max(fastest, measured[axle, WHEEL_SPEED])
    for axle in range(measured.shape[0]):
        command[axle, REFERENCE_SPEED] = fastest


class NoParameters(NamedTuple):
    """It has none."""


class NoProtection:
    """A train whose valves stay open: wheels lock where the rail gives less than the brake asks.

    Examples
    --------
    >>> NoProtection().period
    0.01
    """

    kernel = staticmethod(no_protection_kernel)

    def __init__(self, parameters: NoParameters | None = None, *, period: float = 0.01) -> None:
        self.parameters = NoParameters() if parameters is None else parameters
        self.period = period

    @staticmethod
    def state_size(n_axles: int) -> int:
        """Return 0: nothing is remembered."""
        return 0 * n_axles

    def reset(self, setup: Setup) -> tuple[FloatArray, FloatArray]:
        """Return the setup and the command that stands for ever."""
        return setup_array(setup), command_array(setup.n_axles)

    def step(self, state: tuple[FloatArray, FloatArray], measured: Measured, dt: float) -> Command:
        """Return the same command again."""
        axle_setup, command = state
        nothing = axle_setup[:0, 0]
        no_protection_kernel(nothing, axle_setup, nothing, measured_array(measured), command, dt)
        return command_from_array(command)
