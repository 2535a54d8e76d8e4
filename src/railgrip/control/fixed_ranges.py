"""Fixed strategies of slip: all axles macro, all micro, or half and half.

They choose nothing while the train runs; the adaptive protection is measured against them. Half and
half is what the source of the adaptive protection names as the state of the art.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from railgrip.control.adaptive_state import RANGE
from railgrip.control.contract import MACRO, MICRO, FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_wsp import conventional_initial
from railgrip.control.parameter_sets import joined
from railgrip.control.plain_form import KernelController
from railgrip.control.slip_ranges import (
    N_RANGED,
    RangeBands,
    check_bands,
    observe_in_ranges,
    protect_in_ranges,
    set_bands,
)
from railgrip.control.state_layout import axle_base, state_size
from railgrip.core.errors import Problem, RailgripError

ALL_MACRO: Final = 0.0
ALL_MICRO: Final = 1.0
ALTERNATING: Final = 2.0
FRONT_MACRO: Final = 3.0
REAR_MACRO: Final = 4.0


class Arrangement(NamedTuple):
    """Which axles are held in which range.

    Parameters
    ----------
    arrangement : float
        0: all macro; 1: all micro; 2: odd axles macro, even micro, counted from one at the front;
        3: the front half macro; 4: the rear half macro.
    """

    arrangement: float = ALL_MACRO


FixedParameters = joined("FixedParameters", ConventionalParameters, RangeBands, Arrangement)
"""Parameters of the fixed strategies: those of the ordinary WSP, `RangeBands`, `Arrangement`."""


def range_in(arrangement: float, axle: int, n_axles: int) -> float:
    """Return the range of an axle in an arrangement; of an odd number the front has one more.

    Examples
    --------
    >>> [range_in(ALTERNATING, axle, 4) for axle in range(4)]
    [2.0, 1.0, 2.0, 1.0]
    >>> [range_in(REAR_MACRO, axle, 4) for axle in range(4)]
    [1.0, 1.0, 2.0, 2.0]
    """
    is_front = 2 * axle < n_axles
    is_macro = (
        arrangement == ALL_MACRO
        or (arrangement == ALTERNATING and axle % 2 == 0)
        or (arrangement == FRONT_MACRO and is_front)
        or (arrangement == REAR_MACRO and not is_front)
    )
    return MACRO if is_macro else MICRO


def fixed_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start, ranges included."""
    conventional_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    for axle in range(n_axles):
        state[axle_base(axle) + RANGE] = range_in(parameters[N_RANGED], axle, n_axles)
    set_bands(parameters, state, n_axles)


def fixed_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance the protection by one period; arguments as in the controller contract."""
    observe_in_ranges(parameters, state, measured, dt)
    protect_in_ranges(parameters, axle_setup, state, measured, command, dt)


class FixedRanges(KernelController):
    """Ordinary WSP with a range for each axle that never changes; see its three kinds below.

    Parameters
    ----------
    parameters : FixedParameters, optional
        Those of the ordinary WSP, `RangeBands` and `Arrangement`.
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "arrangement: is none; got 7; allowed 0 … 4", and as `check_bands`.
    """

    kernel = staticmethod(fixed_kernel)
    initial = staticmethod(fixed_initial)
    state_size = staticmethod(state_size)
    arrangement = ALL_MACRO

    def __init__(self, parameters: Any = None, *, period: float = 0.01) -> None:
        if parameters is None:
            parameters = FixedParameters(arrangement=self.arrangement)
        check_bands(parameters, parameters)
        if parameters.arrangement not in (0.0, 1.0, 2.0, 3.0, 4.0):
            raise RailgripError(
                Problem("arrangement", "is none", got=f"{parameters.arrangement:g}",
                        allowed="0, 1, 2, 3, 4")
            )  # fmt: skip
        super().__init__(parameters, period)


class MacroSlip(FixedRanges):
    """All axles in macro-slip: the conventional WSP's commands, with the range told.

    Examples
    --------
    >>> MacroSlip().parameters.slip_upper
    0.16
    """


class MicroSlip(FixedRanges):
    """All axles in micro-slip.

    Examples
    --------
    >>> MicroSlip().parameters.micro_upper
    0.02
    """

    arrangement = ALL_MICRO


class MixedSlip(FixedRanges):
    """Half the axles in macro-slip, half in micro-slip; alternating unless told otherwise.

    Examples
    --------
    >>> front = MixedSlip().parameters._replace(arrangement=FRONT_MACRO)
    >>> MixedSlip(front).parameters.arrangement
    3.0
    """

    arrangement = ALTERNATING
