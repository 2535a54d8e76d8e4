"""Parameters of the adaptive supervisor, and where each stands in the controller's array."""

from __future__ import annotations

import math
from typing import Any, Final, NamedTuple

from railgrip.control.contract import MACRO, MICRO, MIDDLE
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.parameter_sets import joined
from railgrip.control.slip_ranges import N_RANGED, RangeBands
from railgrip.core.errors import Problem, RailgripError

FORCES: Final = 0.0
LOOKOUT: Final = 1.0
PRESSURE: Final = 0.0
RAIL_FORCE: Final = 1.0
UNSCALED: Final = 0.0
BY_LOAD: Final = 1.0
AFTER_TEST: Final = 0.0
ALWAYS: Final = 1.0


class Supervision(NamedTuple):
    """Everything that can be tuned in the supervisor, SI; docs/adaptive.md tells what each does.

    "trial" marks starting values of an independent trial, "study" values fixed on the tuning seeds
    of studies/adaptive_slip.py; numbers in brackets of other parameters are states of figure 2.

    Parameters
    ----------
    supervise_every : float
        Control periods from one look of the supervisor to the next; its decisions take seconds, so
        it need not look in each (illustrative).
    rule : float
        1, lookout: the leading axles stay in macro-slip and tell whether sliding cleans the rail.
        0, forces: the source's comparisons (306, 310, 314).
    start : float
        Range at the start and the order that follows from it: 2 macro, 1 micro (reverse order), 1.5
        as macro, but until the first decision the axles are held in the range between.
    lead_axles : float
        How many axles at the head of the train are test axles for good; with the lookout the last
        of them is compared with the first. 0 for the source's flow.
    n_test : float
        How many other axles are tested at a time, >= 0 (forces only).
    k_system, k_axle : float
        Factor on F0 in 306 and in 310 (trial).
    return_margin : float
        How much more the macro axles' mean must be than the micro axles' in 314 (trial).
    clean_stay, clean_return : float
        Force of the following over the leading test axle above which sliding cleans enough: to
        stay in macro (306), to return to it (310, 314) (study).
    decide, return_to : float
        314 is asked 0: after a test, 1: always. After 306 the flow goes to 301 or 302.
    is_symmetric : float
        1: all axles to micro when the micro axles' mean exceeds the macro axles' (claim 7).
    signal : float
        0: brake cylinder pressure, with the dynamic brake's share; 1: force of the rail, which is
        that less what the wheel's inertia takes.
    scale : float
        0: signals as they are; 1: over the axle's load.
    motored_factor : float
        Given factor on the signal of motored axles.
    breakaway_slip, breakaway_floor : float
        Slip beyond which an axle breaks away, least slip speed [m/s] (trial).
    breakaway_growth : float
        How much more than the train the wheel must decelerate then, [m/s²] (trial).
    adhesion_share : float
        Share of that slip below which the axle adheres again (trial: 0.8 % of 1.5 %).
    f0_filter : float
        Time constant of the force that is stored as F0, [s] (illustrative).
    mean_time : float
        Time constant of the mean force FB, [s] (trial: 1.5; study).
    restart_after : float
        FB and slid distance begin anew so long after a change of range, [s] (trial).
    decide_distance, test_distance : float
        Slid distance for a decision in 305 and for the end of a test in 309, [m] (trial: 5; study).
    early_distance : float
        Slid distance after which the lookout may already decide for macro, [m] (study).
    test_time, test_pause : float
        Longest test, pause before the next, [s] (trial).
    least_axles : float
        Axles with an F0 that the system's decision needs (trial).

    Examples
    --------
    >>> Supervision().lead_axles
    2.0
    """

    supervise_every: float = 2.0
    rule: float = LOOKOUT
    start: float = MIDDLE
    lead_axles: float = 2.0
    n_test: float = 1.0
    k_system: float = 0.8
    k_axle: float = 0.9
    return_margin: float = 1.05
    clean_stay: float = 1.1
    clean_return: float = 1.2
    decide: float = AFTER_TEST
    return_to: float = 301.0
    is_symmetric: float = 0.0
    signal: float = RAIL_FORCE
    scale: float = UNSCALED
    motored_factor: float = 1.0
    breakaway_slip: float = 0.015
    breakaway_floor: float = 0.15
    breakaway_growth: float = 0.3
    adhesion_share: float = 0.5
    f0_filter: float = 0.05
    mean_time: float = 1.2
    restart_after: float = 1.5
    decide_distance: float = 8.0
    test_distance: float = 3.0
    early_distance: float = 1.0
    test_time: float = 8.0
    test_pause: float = 1.5
    least_axles: float = 3.0


AdaptiveParameters = joined("AdaptiveParameters", ConventionalParameters, RangeBands, Supervision)
"""Parameters of `AdaptiveWSP`: those of the ordinary WSP, `RangeBands`, `Supervision`."""

_CODES: Final = {
    "rule": (FORCES, LOOKOUT),
    "start": (MICRO, MIDDLE, MACRO),
    "decide": (AFTER_TEST, ALWAYS),
    "return_to": (301.0, 302.0),
    "is_symmetric": (0.0, 1.0),
    "signal": (PRESSURE, RAIL_FORCE),
    "scale": (UNSCALED, BY_LOAD),
}
_COUNTS: Final = ("supervise_every", "lead_axles", "n_test", "least_axles")


def check_supervision(parameters: Any) -> None:
    """Refuse parameters that are no number, none of the codes, or contradict each other.

    Raises
    ------
    RailgripError
        "rule: is none of its codes; got 3; allowed: 0, 1", and the like, all at once.
    """
    problems = []
    for name in Supervision._fields:
        value = getattr(parameters, name)
        got = f"{value:g}"
        codes = _CODES.get(name)
        if codes is not None and value not in codes:
            known = ", ".join(f"{code:g}" for code in codes)
            problems.append(Problem(name, "is none of its codes", got=got, allowed=known))
        elif not 0.0 <= value < math.inf:
            problems.append(Problem(name, "must be a number of at least 0", got=got))
        elif name in _COUNTS and value != round(value):
            problems.append(Problem(name, "must be a whole number", got=got))
    if not parameters.deceleration_per_pressure > 0.0:
        got = f"{parameters.deceleration_per_pressure:g}"
        problems.append(Problem("deceleration_per_pressure", "must be more than 0", got=got))
    if parameters.rule == LOOKOUT and parameters.lead_axles < 2.0:
        problems.append(
            Problem(
                "lead_axles",
                "must be at least 2 for the lookout",
                got=f"{parameters.lead_axles:g}",
                cure="set rule = 0 for the source's comparison of forces",
            )
        )
    if problems:
        raise RailgripError(problems)


def _place(name: str) -> int:
    return N_RANGED + Supervision._fields.index(name)


SUPERVISE_EVERY: Final = _place("supervise_every")
RULE: Final = _place("rule")
START: Final = _place("start")
LEAD_AXLES: Final = _place("lead_axles")
N_TEST: Final = _place("n_test")
K_SYSTEM: Final = _place("k_system")
K_AXLE: Final = _place("k_axle")
RETURN_MARGIN: Final = _place("return_margin")
CLEAN_STAY: Final = _place("clean_stay")
CLEAN_RETURN: Final = _place("clean_return")
DECIDE: Final = _place("decide")
RETURN_TO: Final = _place("return_to")
IS_SYMMETRIC: Final = _place("is_symmetric")
SIGNAL: Final = _place("signal")
SCALE: Final = _place("scale")
MOTORED_FACTOR: Final = _place("motored_factor")
BREAKAWAY_SLIP: Final = _place("breakaway_slip")
BREAKAWAY_FLOOR: Final = _place("breakaway_floor")
BREAKAWAY_GROWTH: Final = _place("breakaway_growth")
ADHESION_SHARE: Final = _place("adhesion_share")
F0_FILTER: Final = _place("f0_filter")
MEAN_TIME: Final = _place("mean_time")
RESTART_AFTER: Final = _place("restart_after")
DECIDE_DISTANCE: Final = _place("decide_distance")
TEST_DISTANCE: Final = _place("test_distance")
EARLY_DISTANCE: Final = _place("early_distance")
TEST_TIME: Final = _place("test_time")
TEST_PAUSE: Final = _place("test_pause")
LEAST_AXLES: Final = _place("least_axles")
