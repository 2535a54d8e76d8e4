"""The ordinary WSP with a range of slip of its own for each axle: macro or micro.

The parts are those of `conventional_wsp`; only the two thresholds differ from axle to axle. With
all axles in macro-slip it commands, bit for bit, what the conventional WSP commands.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.adaptive_state import HAVE_CHANGED, NEEDED_ACCURACY, RANGE
from railgrip.control.axle_protection import protect_axles
from railgrip.control.contract import MICRO, MIDDLE, SLIP_RANGE, FloatArray
from railgrip.control.conventional_parameters import (
    SLIP_LOWER,
    SLIP_UPPER,
    ConventionalParameters,
)
from railgrip.control.conventional_state import LOWER_SHARE, UPPER_SHARE
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.faulty_axle import follow_neighbours
from railgrip.control.side_by_side import count_equal, give
from railgrip.control.state_layout import GROUP, group_base, groups
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


def by_range(state: FloatArray, base: int, micro: float, middle: float, macro: float) -> float:
    """Return the one of three values that belongs to an axle's range of slip."""
    slip_range = state[base + RANGE]
    return choose(slip_range == MICRO, micro, choose(slip_range == MIDDLE, middle, macro))


def set_bands(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Put into the state the band of every axle, by its range, and how exact the narrowest is.

    Parameters
    ----------
    parameters, state : ndarray
        With the ordinary WSP's, then those of `RangeBands`; as in the controller contract.
    n_axles : int
        Number of axles.
    """
    n_micro = 0
    n_middle = 0
    for group in range(groups(n_axles)):
        first = group_base(group)
        n_micro += count_equal(state, first + RANGE, MICRO)
        n_middle += count_equal(state, first + RANGE, MIDDLE)
        for base in range(first, first + GROUP):
            state[base + LOWER_SHARE] = by_range(
                state, base, parameters[MICRO_LOWER], parameters[MIDDLE_LOWER],
                parameters[SLIP_LOWER],
            )  # fmt: skip
            state[base + UPPER_SHARE] = by_range(
                state, base, parameters[MICRO_UPPER], parameters[MIDDLE_UPPER],
                parameters[SLIP_UPPER],
            )  # fmt: skip
    accuracy = parameters[SLIP_LOWER]
    if n_micro > 0:
        accuracy = min(accuracy, parameters[MICRO_LOWER])
    if n_middle > 0:
        accuracy = min(accuracy, parameters[MIDDLE_LOWER])
    state[NEEDED_ACCURACY] = accuracy
    state[HAVE_CHANGED] = 0.0


def observe_in_ranges(
    parameters: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    dt: float,
) -> None:
    """Update wheels and reference speed, as exactly as the narrowest range in use needs."""
    observe_train(parameters, state, measured, state[NEEDED_ACCURACY], dt)
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
    protect_axles(parameters, state, command, dt)
    give_ranges(state, command)
    follow_neighbours(axle_setup, state, measured, command)


def give_ranges(state: FloatArray, command: FloatArray) -> None:
    """Write the range of slip of every axle."""
    for group in range(groups(command.shape[0])):
        give(command, group * GROUP, SLIP_RANGE, state, group_base(group) + RANGE)


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
