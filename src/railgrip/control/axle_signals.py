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
    SAND,
    SLIDES,
    VALVE,
    WRONG,
)
from railgrip.control.sanding_request import wants_sand
from railgrip.control.side_by_side import give, give_all, take
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups


def take_setup(axle_setup: FloatArray, state: FloatArray) -> None:
    """Put into the state which axles have a brake, which a motor."""
    for axle in range(axle_setup.shape[0]):
        base = axle_base(axle)
        state[base + IS_BRAKED] = axle_setup[axle, BRAKED]
        state[base + IS_MOTORED] = axle_setup[axle, MOTORED]


def take_measured(state: FloatArray, measured: FloatArray) -> None:
    """Put into the state what the sensors say."""
    for group in range(groups(measured.shape[0])):
        base, axle = group_base(group), group * GROUP
        take(state, base + READING, measured, axle, WHEEL_SPEED)
        take(state, base + PRESSURE, measured, axle, CYLINDER_PRESSURE)
        take(state, base + DYNAMIC, measured, axle, DYNAMIC_FORCE)


def take_command(state: FloatArray, command: FloatArray) -> None:
    """Put into the state what others than `give_command` have commanded."""
    for axle in range(command.shape[0]):
        base = axle_base(axle)
        state[base + VALVE] = command[axle, DUMP_VALVE]
        state[base + DYNAMIC_PERMITTED] = command[axle, DYNAMIC_SHARE]


def note_signals(state: FloatArray, base: int) -> None:
    """Put into the state what else is told of an axle: its wish for sand, what is wrong with it."""
    state[base + SAND] = wants_sand(state, base)
    state[base + WRONG] = axle_alarm(state, base)


def give_command(state: FloatArray, command: FloatArray) -> None:
    """Write the command of every axle out of the state."""
    for group in range(groups(command.shape[0])):
        base, axle = group_base(group), group * GROUP
        give(command, axle, DUMP_VALVE, state, base + VALVE)
        give(command, axle, DYNAMIC_SHARE, state, base + DYNAMIC_PERMITTED)
        give(command, axle, IS_SLIDING, state, base + SLIDES)
        give(command, axle, SANDING, state, base + SAND)
        give(command, axle, ALARM, state, base + WRONG)
        give_all(command, axle, REFERENCE_SPEED, state[REFERENCE])
