"""An axle whose speed is not known brakes as its neighbours do, and does not lock for it.

Left to the driver's full demand it would stand still on low adhesion until the train stops. Its
neighbour in the bogie runs over the same rail a tenth of a second apart and carries about as much,
so what the neighbour's valve does is the best guess there is.

Known wrong when: the neighbour brakes otherwise (another load, a tread brake beside discs), or all
sensors of a vehicle fail: then the brake stays on, as without a protection.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.axle_signals import take_command
from railgrip.control.contract import (
    BOGIE,
    BRAKED,
    CYLINDER_PRESSURE,
    DUMP_VALVE,
    DYNAMIC_SHARE,
    FILL,
    FRICTION_SHARE,
    HOLD,
    MOTORED,
    VEHICLE,
    VENT,
    FloatArray,
)
from railgrip.control.conventional_state import FREED_AXLE, IS_FAULTY, SLIDES
from railgrip.control.lone_leader import runs_free
from railgrip.control.side_by_side import count_equal
from railgrip.control.state_layout import axle_base, group_base, groups, n_places

CAUTION: Final = 0.75
"""A follower behind a sliding neighbour takes no more than this share of its pressure: it does not
see its own slide, and a wheel that has once locked needs far less brake to turn again."""
MORE_PRESSURE: Final = 2.0e4
"""With so much more pressure than it may have, Pa, a follower vents."""


def follow_neighbours(
    axle_setup: FloatArray, state: FloatArray, measured: FloatArray, command: FloatArray
) -> None:
    """Give every axle whose sensor is not believed the command of its most released neighbour.

    Parameters
    ----------
    axle_setup, state, measured, command : ndarray
        As in the controller contract; the other axles' commands are already written.

    Notes
    -----
    Neighbours are the believed axles of the same bogie, or of the vehicle if there is none. An
    axle that is let run free to show the train's speed is no neighbour.

    Examples
    --------
    Of four axles the second is not believed, its neighbour in the bogie vents:

    >>> import numpy as np
    >>> from railgrip.control.contract import N_COMMAND, N_MEASURED, N_SETUP
    >>> from railgrip.control.state_layout import state_size
    >>> setup, state = np.ones((4, N_SETUP)), np.zeros(state_size(4))
    >>> setup[:, BOGIE] = [0, 0, 1, 1]
    >>> state[axle_base(1) + IS_FAULTY] = 1.0
    >>> command = np.zeros((4, N_COMMAND))
    >>> command[0, DUMP_VALVE] = VENT
    >>> follow_neighbours(setup, state, np.zeros((4, N_MEASURED)), command)
    >>> float(command[1, DUMP_VALVE])
    2.0
    """
    n_axles = measured.shape[0]
    if count_faulty(state, n_axles) == 0:
        return
    for axle in range(n_axles):
        if state[axle_base(axle) + IS_FAULTY] > 0.0:
            like = most_released(axle_setup, state, measured, command, axle, BOGIE)
            if like < 0:
                like = most_released(axle_setup, state, measured, command, axle, VEHICLE)
            if like >= 0:
                is_sliding = state[axle_base(like) + SLIDES] > 0.0
                _follow(axle_setup, measured, command, axle, like, is_sliding)
            if runs_free(state, axle_base(axle)) and axle_setup[axle, BRAKED] > 0.0:
                command[axle, DUMP_VALVE] = VENT
                command[axle, DYNAMIC_SHARE] = 0.0
    take_command(state, command)


def count_faulty(state: FloatArray, n_axles: int) -> int:
    """Return how many axles have a sensor that is not believed."""
    n_faulty = n_axles - n_places(n_axles)  # empty places count as faulty
    for group in range(groups(n_axles)):
        n_faulty += count_equal(state, group_base(group) + IS_FAULTY, 1.0)
    return n_faulty


def most_released(
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    axle: int,
    among: int,
) -> int:
    """Return the believed axle of the same bogie (or vehicle) that brakes least; -1 for none.

    First counts the valve, then the share of the motor, then the cylinder's pressure.
    """
    found = -1
    for other in range(measured.shape[0]):
        is_neighbour = (
            axle_setup[other, among] == axle_setup[axle, among]
            and state[axle_base(other) + IS_FAULTY] == 0.0
            and state[FREED_AXLE] != other + 1.0
            and axle_setup[other, BRAKED] + axle_setup[other, MOTORED] > 0.0
        )
        if is_neighbour and (found < 0 or _is_freer(measured, command, other, found)):
            found = other
    return found


def _is_freer(measured: FloatArray, command: FloatArray, one: int, than: int) -> bool:
    if command[one, DUMP_VALVE] != command[than, DUMP_VALVE]:
        return bool(command[one, DUMP_VALVE] > command[than, DUMP_VALVE])
    if command[one, FRICTION_SHARE] != command[than, FRICTION_SHARE]:
        return bool(command[one, FRICTION_SHARE] < command[than, FRICTION_SHARE])
    return bool(measured[one, CYLINDER_PRESSURE] < measured[than, CYLINDER_PRESSURE])


def _follow(
    axle_setup: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    axle: int,
    like: int,
    is_sliding: bool,
) -> None:
    valve = command[like, DUMP_VALVE]
    share = CAUTION if is_sliding else 1.0
    more = measured[axle, CYLINDER_PRESSURE] - share * measured[like, CYLINDER_PRESSURE]
    if more > MORE_PRESSURE:
        valve = VENT
    elif is_sliding and more > 0.0:
        valve = max(valve, HOLD)
    command[axle, DUMP_VALVE] = valve if axle_setup[axle, BRAKED] > 0.0 else FILL
    command[axle, FRICTION_SHARE] = command[like, FRICTION_SHARE]
    if axle_setup[axle, MOTORED] > 0.0:
        by_valve = 1.0 if valve == FILL else 0.0
        is_alike = axle_setup[like, MOTORED] > 0.0
        command[axle, DYNAMIC_SHARE] = command[like, DYNAMIC_SHARE] if is_alike else by_valve
