"""What the axles measure, and what they are commanded, between the tables and the state.

The tables have a row an axle; in the state the axles stand side by side, which makes the loops over
them packed arithmetic.
"""

from __future__ import annotations

from railgrip.control.axle_alarm import axle_alarm
from railgrip.control.contract import (
    ALARM,
    BRAKED,
    CYLINDER_PRESSURE,
    DUMP_VALVE,
    DYNAMIC_FORCE,
    DYNAMIC_SHARE,
    IS_SLIDING,
    MOTORED,
    REFERENCE_SPEED,
    SANDING,
    WHEEL_SPEED,
    FloatArray,
)
from railgrip.control.conventional_state import (
    DYNAMIC,
    DYNAMIC_PERMITTED,
    IS_BRAKED,
    IS_MOTORED,
    PRESSURE,
    READING,
    REFERENCE,
    SLIDES,
    VALVE,
)
from railgrip.control.sanding_request import wants_sand
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups, in_group


def take_setup(axle_setup: FloatArray, state: FloatArray) -> None:
    """Put into the state which axles have a brake, which a motor."""
    for axle in range(axle_setup.shape[0]):
        base = axle_base(axle)
        state[base + IS_BRAKED] = axle_setup[axle, BRAKED]
        state[base + IS_MOTORED] = axle_setup[axle, MOTORED]


def take_measured(state: FloatArray, measured: FloatArray) -> None:
    """Put into the state what the sensors say."""
    n_axles = measured.shape[0]
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            axle = group * GROUP + i
            state[base + READING] = measured[axle, WHEEL_SPEED]
            state[base + PRESSURE] = measured[axle, CYLINDER_PRESSURE]
            state[base + DYNAMIC] = measured[axle, DYNAMIC_FORCE]


def take_command(state: FloatArray, command: FloatArray) -> None:
    """Put into the state what others than `give_command` have commanded."""
    for axle in range(command.shape[0]):
        base = axle_base(axle)
        state[base + VALVE] = command[axle, DUMP_VALVE]
        state[base + DYNAMIC_PERMITTED] = command[axle, DYNAMIC_SHARE]


def give_command(state: FloatArray, command: FloatArray) -> None:
    """Write the command of every axle out of the state."""
    n_axles = command.shape[0]
    reference = state[REFERENCE]
    # a loop for each column: of several in one LLVM packs none
    give(state, VALVE, command, DUMP_VALVE)
    give(state, DYNAMIC_PERMITTED, command, DYNAMIC_SHARE)
    give(state, SLIDES, command, IS_SLIDING)
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            command[group * GROUP + i, SANDING] = wants_sand(state, base)
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            command[group * GROUP + i, ALARM] = axle_alarm(state, base)
    for axle in range(n_axles):
        command[axle, REFERENCE_SPEED] = reference


def give(state: FloatArray, field: int, command: FloatArray, column: int) -> None:
    """Write one column of the command out of the state."""
    n_axles = command.shape[0]
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            command[group * GROUP + i, column] = state[base + field]
