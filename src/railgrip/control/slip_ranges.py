"""The ordinary WSP with a range of slip of its own for each axle: macro or micro.

The parts are those of `conventional_wsp`; only the two thresholds differ from axle to axle. With
all axles in macro-slip it commands, bit for bit, what the conventional WSP commands.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.adaptive_state import RANGE
from railgrip.control.axle_protection import protect_axles
from railgrip.control.axle_signals import give
from railgrip.control.contract import MICRO, MIDDLE, SLIP_RANGE, FloatArray
from railgrip.control.conventional_parameters import (
    SLIP_LOWER,
    SLIP_SPEED_LOWER_FLOOR,
    SLIP_SPEED_UPPER_FLOOR,
    SLIP_UPPER,
    ConventionalParameters,
)
from railgrip.control.conventional_state import BAND_LOWER, BAND_UPPER, REFERENCE
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.faulty_axle import follow_neighbours
from railgrip.control.slip_band import threshold
from railgrip.control.state_layout import group_base, groups, in_group
from railgrip.control.train_observer import observe_train
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.choosing import choose


class RangeBands(NamedTuple):
    """Bands of the lower ranges; that of the macro range is the ordinary WSP's own, SI.

    Parameters
    ----------
    micro_lower, micro_upper : float
        Slip below which the brake fills again and above which it vents in micro-slip, share of the
        reference speed (trial).
    middle_lower, middle_upper : float
        The same in the range between, for axles of which it is not yet decided (study).
    """

    micro_lower: float = 0.008
    micro_upper: float = 0.02
    middle_lower: float = 0.04
    middle_upper: float = 0.08


N_CONVENTIONAL: Final = len(ConventionalParameters._fields)
MICRO_LOWER: Final = N_CONVENTIONAL
MICRO_UPPER: Final = N_CONVENTIONAL + 1
MIDDLE_LOWER: Final = N_CONVENTIONAL + 2
MIDDLE_UPPER: Final = N_CONVENTIONAL + 3
N_RANGED: Final = N_CONVENTIONAL + len(RangeBands._fields)
"""Where the parameters of a controller that builds on this one begin."""


def observe_in_ranges(
    parameters: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    dt: float,
) -> None:
    """Update wheels and reference speed, as exactly as the narrowest range in use needs."""
    n_axles = measured.shape[0]
    n_micro = 0
    n_middle = 0
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            slip_range = state[group_base(group) + i + RANGE]
            n_micro += slip_range == MICRO
            n_middle += slip_range == MIDDLE
    slip_lower = parameters[SLIP_LOWER]
    if n_micro > 0:
        slip_lower = min(slip_lower, parameters[MICRO_LOWER])
    if n_middle > 0:
        slip_lower = min(slip_lower, parameters[MIDDLE_LOWER])
    observe_train(parameters, state, measured, slip_lower, dt)
    learn_diameters(parameters, state, measured, dt)


def protect_in_ranges(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Write the command of every axle, each by the thresholds of its own range."""
    n_axles = measured.shape[0]
    reference = state[REFERENCE]
    lower_floor = parameters[SLIP_SPEED_LOWER_FLOOR]
    upper_floor = parameters[SLIP_SPEED_UPPER_FLOOR]
    macro_lower = threshold(parameters[SLIP_LOWER], lower_floor, reference)
    macro_upper = threshold(parameters[SLIP_UPPER], upper_floor, reference)
    micro_lower = threshold(parameters[MICRO_LOWER], lower_floor, reference)
    micro_upper = threshold(parameters[MICRO_UPPER], upper_floor, reference)
    middle_lower = threshold(parameters[MIDDLE_LOWER], lower_floor, reference)
    middle_upper = threshold(parameters[MIDDLE_UPPER], upper_floor, reference)
    for group in range(groups(n_axles)):
        for i in range(in_group(group, n_axles)):
            base = group_base(group) + i
            is_middle = state[base + RANGE] == MIDDLE
            is_micro = state[base + RANGE] == MICRO
            lower = choose(is_middle, middle_lower, macro_lower)
            upper = choose(is_middle, middle_upper, macro_upper)
            state[base + BAND_LOWER] = choose(is_micro, micro_lower, lower)
            state[base + BAND_UPPER] = choose(is_micro, micro_upper, upper)
    protect_axles(parameters, state, command, dt)
    give(state, RANGE, command, SLIP_RANGE)
    follow_neighbours(axle_setup, state, measured, command)


def check_bands(parameters: ConventionalParameters, lower: RangeBands) -> None:
    """Refuse thresholds that contradict each other.

    Raises
    ------
    RailgripError
        "slip_lower: must lie between 0 and slip_upper ...", the same for the other ranges.
    """
    bands = (
        ("slip", parameters.slip_lower, parameters.slip_upper),
        ("micro", lower.micro_lower, lower.micro_upper),
        ("middle", lower.middle_lower, lower.middle_upper),
    )
    for name, least, greatest in bands:
        if not 0.0 < least < greatest < 1.0:
            raise RailgripError(
                Problem(
                    f"{name}_lower",
                    f"must lie between 0 and {name}_upper, and that below 1",
                    got=f"{least:g} and {greatest:g}",
                )
            )
