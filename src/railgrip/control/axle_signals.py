"""What the axles measure, and what they are commanded, between the tables and the state.

The tables have a row an axle; in the state the axles stand side by side, which makes the loops over
them packed arithmetic.
"""

from __future__ import annotations

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
    ALARM_NOW,
    DYNAMIC,
    DYNAMIC_PERMITTED,
    IS_BRAKED,
    IS_MOTORED,
    PRESSURE,
    READING,
    REFERENCE,
    SANDS,
    SLIDES,
    VALVE,
)
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups, in_group


def take_setup(axle_setup: FloatArray, state: FloatArray) -> None:
    """Put into the state which axles have a brake, which a motor."""
    for axle in range(axle_setup.shape[0]):
        base = axle_base(axle)
        state[base + IS_BRAKED] = axle_setup[axle, BRAKED]
        state[base + IS_MOTORED] = axle_setup[axle, MOTORED]


def take_measured(state: FloatArray, measured: FloatArray) -> None:
    """Put into the state what the sensors say."""
    _take(state, READING, measured, WHEEL_SPEED)
    _take(state, PRESSURE, measured, CYLINDER_PRESSURE)
    _take(state, DYNAMIC, measured, DYNAMIC_FORCE)


def take_command(state: FloatArray, command: FloatArray) -> None:
    """Put into the state what has been commanded since the last step."""
    _take(state, VALVE, command, DUMP_VALVE)
    _take(state, DYNAMIC_PERMITTED, command, DYNAMIC_SHARE)


def give_command(state: FloatArray, command: FloatArray) -> None:
    """Write the command of every axle out of the state."""
    _give(state, VALVE, command, DUMP_VALVE)
    _give(state, DYNAMIC_PERMITTED, command, DYNAMIC_SHARE)
    _give(state, SANDS, command, SANDING)
    _give(state, SLIDES, command, IS_SLIDING)
    _give(state, ALARM_NOW, command, ALARM)
    for axle in range(command.shape[0]):
        command[axle, REFERENCE_SPEED] = state[REFERENCE]


def _take(state: FloatArray, field: int, table: FloatArray, column: int) -> None:
    n_axles = table.shape[0]
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            state[base + field] = table[group * GROUP + i, column]


def _give(state: FloatArray, field: int, table: FloatArray, column: int) -> None:
    n_axles = table.shape[0]
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            table[group * GROUP + i, column] = state[base + field]
