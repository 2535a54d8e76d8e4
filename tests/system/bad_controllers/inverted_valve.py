"""Deliberately bad: fills where it should vent, and vents where it should fill."""

from railgrip.control.contract import DUMP_VALVE, VENT
from railgrip.control.conventional_wsp import ConventionalWSP, conventional_kernel


def kernel(parameters, axle_setup, state, measured, command, dt):
    for axle in range(measured.shape[0]):
        command[axle, DUMP_VALVE] = VENT - command[axle, DUMP_VALVE]
    conventional_kernel(parameters, axle_setup, state, measured, command, dt)
    for axle in range(measured.shape[0]):
        command[axle, DUMP_VALVE] = VENT - command[axle, DUMP_VALVE]


class InvertedValve(ConventionalWSP):
    kernel = staticmethod(kernel)
