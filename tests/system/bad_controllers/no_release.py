"""Deliberately bad: the reference speed falls by a fixed 1.8 m/s² and no axle is ever released."""

from railgrip.control.conventional_state import OFFSET, PRESSURE_GAIN
from railgrip.control.conventional_wsp import ConventionalWSP, conventional_kernel


def kernel(parameters, axle_setup, state, measured, command, dt):
    state[PRESSURE_GAIN] = 0.0
    state[OFFSET] = 1.8
    conventional_kernel(parameters, axle_setup, state, measured, command, dt)


class NoRelease(ConventionalWSP):
    kernel = staticmethod(kernel)

    def __init__(self, parameters=None, *, period=0.01):
        super().__init__(parameters, period=period)
        super().__init__(self.parameters._replace(drift_rate=0.0), period=period)
