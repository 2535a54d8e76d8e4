"""Sensors that fail on driven wheels, and what their motors do then.

A driven wheel whose sensor stands or stays at the very same reading while its motor pulls shows
nothing. Its motor then gives what the most careful believed neighbour is permitted, less a caution,
because nobody sees it spin; without any believed driven wheel it gives nothing.

Known wrong when: an axle has seized. It looks as a dead sensor does, and is told as one.
"""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import (
    BOGIE,
    DYNAMIC_FORCE,
    DYNAMIC_SHARE,
    MOTORED,
    VEHICLE,
    FloatArray,
)
from railgrip.control.conventional_parameters import DEAD_TIME
from railgrip.control.conventional_state import (
    DEAD_CLOCK,
    IS_FAULTY,
    LAST_STEP,
    REFERENCE,
    SPEED,
    STRANGE_CLOCK,
)
from railgrip.control.faulty_axle import CAUTION
from railgrip.control.state_layout import axle_base

PULLING: Final = 2.0e3  # N: with so much motor force no wheel keeps its very speed
STANDING, MOVING = 0.05, 0.3
"""A wheel slower than the first under its motor, while the train is faster than the second, m/s."""
PASSING: Final = 0.5
"""A wheel so fast, m/s, passes a tooth in far less than the time in which it may read the same."""
STRANGE_AFTER: Final = 0.6  # s


def watch_driven_sensors(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    dt: float,
) -> None:  # fmt: skip
    """Note in the state which driven wheels are not believed; the wheels have been read.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract.
    dt : float
        Period, [s].
    """
    for axle in range(measured.shape[0]):
        base = axle_base(axle)
        clock = base + STRANGE_CLOCK
        speed = state[base + SPEED]
        stands = speed < STANDING and state[REFERENCE] > MOVING
        stays = speed > PASSING and state[base + LAST_STEP] == 0.0
        is_pulling = -measured[axle, DYNAMIC_FORCE] > PULLING
        if axle_setup[axle, MOTORED] > 0.0 and is_pulling and (stands or stays):
            state[clock] += dt
        elif state[clock] < STRANGE_AFTER:
            state[clock] = 0.0
        if state[clock] >= STRANGE_AFTER:
            state[base + IS_FAULTY] = 1.0
            state[base + DEAD_CLOCK] = parameters[DEAD_TIME]
        if not (stands or stays):
            state[clock] = 0.0


def drive_as_neighbours(
    axle_setup: FloatArray, state: FloatArray, command: FloatArray, n_axles: int
) -> None:
    """Give every motor whose wheel is not believed a cautious share of its neighbours'.

    Parameters
    ----------
    axle_setup, state, command : ndarray
        As in the controller contract; the other axles' commands are already written.
    n_axles : int
        Number of axles.

    Examples
    --------
    >>> import numpy as np
    >>> from railgrip.control.contract import N_COMMAND, N_SETUP
    >>> from railgrip.control.state_layout import state_size
    >>> setup, state = np.ones((2, N_SETUP)), np.zeros(state_size(2))
    >>> state[axle_base(1) + IS_FAULTY] = 1.0
    >>> command = np.zeros((2, N_COMMAND))
    >>> command[0, DYNAMIC_SHARE] = 0.4
    >>> drive_as_neighbours(setup, state, command, 2)
    >>> round(float(command[1, DYNAMIC_SHARE]), 2)
    0.3
    """
    for axle in range(n_axles):
        if axle_setup[axle, MOTORED] == 0.0 or state[axle_base(axle) + IS_FAULTY] == 0.0:
            continue
        share = _least_share(axle_setup, state, command, n_axles, axle, BOGIE)
        if share < 0.0:
            share = _least_share(axle_setup, state, command, n_axles, axle, VEHICLE)
        if share < 0.0:
            share = _least_share(axle_setup, state, command, n_axles, axle, -1)
        command[axle, DYNAMIC_SHARE] = CAUTION * share if share >= 0.0 else 0.0


def _least_share(
    axle_setup: FloatArray, state: FloatArray, command: FloatArray, n_axles: int, axle: int,
    among: int,
) -> float:  # fmt: skip
    """Return the least share of believed driven axles in the same bogie, vehicle, train (-1)."""
    least = 2.0
    for other in range(n_axles):
        is_near = among < 0 or axle_setup[other, among] == axle_setup[axle, among]
        is_believed = state[axle_base(other) + IS_FAULTY] == 0.0
        if is_near and is_believed and axle_setup[other, MOTORED] > 0.0:
            least = min(least, command[other, DYNAMIC_SHARE])
    return float(least) if least <= 1.0 else -1.0
