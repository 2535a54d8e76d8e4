"""One axle under the conventional WSP: from its slip to its dump valve, dynamic brake and sand."""

from __future__ import annotations

from railgrip.control.axle_signals import give_command, note_signals
from railgrip.control.contract import FILL, HOLD, VENT, FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters, conventional_of
from railgrip.control.conventional_state import (
    ACCELERATION,
    DECELERATION,
    DYNAMIC,
    DYNAMIC_PERMITTED,
    FREED_AXLE,
    IS_BRAKED,
    IS_FAULTY,
    IS_MOTORED,
    LOWER_SHARE,
    REFERENCE,
    SPEED,
    UPPER_SHARE,
    VALVE,
)
from railgrip.control.dynamic_handover import hand_over
from railgrip.control.safety_timer import watch_release
from railgrip.control.sanding_request import request_sand
from railgrip.control.slip_band import note_slide, threshold, wish
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups
from railgrip.control.stepped_filling import step_filling
from railgrip.core.formulas.choosing import choose


def freed_place(state: FloatArray) -> int:
    """Return where the values of the axle begin that is let run free; -1 for none."""
    freed = int(state[FREED_AXLE])
    return axle_base(freed - 1) if freed > 0 else -1


def protect_axles(
    parameters: FloatArray, state: FloatArray, command: FloatArray, dt: float
) -> None:
    """Write the command of every axle; its thresholds have been put into the state.

    Parameters
    ----------
    parameters, state, command : ndarray
        As in the controller contract.
    dt : float
        Period, [s].
    """
    n_axles = command.shape[0]
    own = conventional_of(parameters)
    reference = state[REFERENCE]
    deceleration = state[DECELERATION]
    freed = freed_place(state)
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            axle = group_base(group) + i
            _protect(own, state, axle, reference, deceleration, axle == freed, dt)
    give_command(state, command)


def _protect(
    parameters: ConventionalParameters,
    state: FloatArray,
    base: int,
    reference: float,
    deceleration: float,
    is_freed: bool,
    dt: float,
) -> None:
    """Put the command of one axle into the state: without branches, for packed arithmetic."""
    lower = threshold(state[base + LOWER_SHARE], parameters.slip_speed_lower_floor, reference)
    upper = threshold(state[base + UPPER_SHARE], parameters.slip_speed_upper_floor, reference)
    works = reference >= parameters.inhibit_speed
    is_believed = state[base + IS_FAULTY] == 0.0
    is_protected = works & is_believed
    slip_speed = choose(is_protected, reference - state[base + SPEED], 0.0)
    relative = state[base + ACCELERATION] + deceleration
    wished = wish(parameters.lead_time, slip_speed, relative, lower, upper)
    wished = choose(is_protected, wished, FILL)
    note_slide(state, base, wished, slip_speed, lower, dt)
    wished = choose(is_protected & is_freed, VENT, wished)
    must_fill = watch_release(parameters, state, base, state[base + VALVE], dt)
    wished = choose(must_fill, FILL, wished)
    valve = step_filling(parameters, state, base, wished, dt)
    is_motored = state[base + IS_MOTORED] > 0.0
    force = state[base + DYNAMIC]
    share = state[base + DYNAMIC_PERMITTED]
    # the motor goes out first, then the valve works
    pulls = (share > 0.0) & (force > parameters.dynamic_least_force)
    valve = choose(is_motored & pulls & (valve == VENT), HOLD, valve)
    after = hand_over(parameters, state, base, wished == VENT, force, share, dt)
    state[base + DYNAMIC_PERMITTED] = choose(is_motored, after, share)
    state[base + VALVE] = choose(state[base + IS_BRAKED] > 0.0, valve, FILL)
    request_sand(parameters, state, base, reference, dt)
    note_signals(state, base)
