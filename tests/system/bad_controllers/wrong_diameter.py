"""Subtly bad: one wheel is believed 5 % larger than it is, and nothing compensates for it."""

from railgrip.control.contract import WHEEL_SPEED
from railgrip.control.conventional_wsp import (
    ConventionalWSP,
    conventional_initial,
    conventional_kernel,
)

WRONG = 2
FACTOR = 1.05


def initial(parameters, axle_setup, state, measured):
    if measured.shape[0] > WRONG:
        measured[WRONG, WHEEL_SPEED] *= FACTOR
    conventional_initial(parameters, axle_setup, state, measured)
    if measured.shape[0] > WRONG:
        measured[WRONG, WHEEL_SPEED] /= FACTOR


def kernel(parameters, axle_setup, state, measured, command, dt):
    if measured.shape[0] > WRONG:
        measured[WRONG, WHEEL_SPEED] *= FACTOR
    conventional_kernel(parameters, axle_setup, state, measured, command, dt)
    if measured.shape[0] > WRONG:
        measured[WRONG, WHEEL_SPEED] /= FACTOR


class WrongDiameter(ConventionalWSP):
    kernel = staticmethod(kernel)
    initial = staticmethod(initial)

    def __init__(self, parameters=None, *, period=0.01):
        super().__init__(parameters, period=period)
        super().__init__(self.parameters._replace(diameter_bound=0.0), period=period)
