"""States of the adaptive supervisor and the ways between them: the source's figure 2 as a table.

The numbers are those of figure 2. The supervisor takes one step a tick; a test checks that it takes
no way that is not in this table, and the diagram in the docs is drawn from it.
"""

from __future__ import annotations

from typing import Final, NamedTuple

START_MACRO: Final = 301.0
STORE_F0: Final = 302.0
AVERAGE: Final = 303.0
SUM_UP: Final = 304.0
HAS_SLID: Final = 305.0
IS_MACRO_BETTER: Final = 306.0
START_MICRO: Final = 307.0
CHOOSE_TEST: Final = 308.0
TEST: Final = 309.0
JUDGE_AXLE: Final = 310.0
AXLE_TO_MICRO: Final = 311.0
AVERAGE_RANGES: Final = 312.0
SUM_UP_RANGES: Final = 313.0
COMPARE_RANGES: Final = 314.0

STATES: Final[dict[float, str]] = {
    START_MACRO: "all axles to macro, slid distances to zero",
    STORE_F0: "store F0 at breakaway",
    AVERAGE: "average FB, sum up sRB of each axle",
    SUM_UP: "average F0, FB, sRB over the system",
    HAS_SLID: "slid far enough?",
    IS_MACRO_BETTER: "macro better?",
    START_MICRO: "all axles to micro, test axles excepted",
    CHOOSE_TEST: "choose the test axle, to macro",
    TEST: "test until it has slid enough, or time is up",
    JUDGE_AXLE: "test axle better in macro?",
    AXLE_TO_MICRO: "test axle to micro",
    AVERAGE_RANGES: "average FB of each axle",
    SUM_UP_RANGES: "average over the axles of each range",
    COMPARE_RANGES: "macro axles better than micro axles?",
}
"""Number of a state → what is done or asked in it."""


class Transition(NamedTuple):
    """A way from one state to another, and when it is taken."""

    before: float
    after: float
    when: str


TRANSITIONS: Final = (
    Transition(START_MACRO, STORE_F0, ""),
    Transition(STORE_F0, AVERAGE, "enough axles broke away"),
    Transition(AVERAGE, SUM_UP, ""),
    Transition(SUM_UP, HAS_SLID, ""),
    Transition(HAS_SLID, SUM_UP, "no"),
    Transition(HAS_SLID, IS_MACRO_BETTER, "yes"),
    Transition(IS_MACRO_BETTER, START_MACRO, "yes"),
    Transition(IS_MACRO_BETTER, STORE_F0, "yes, go on summing"),
    Transition(IS_MACRO_BETTER, START_MICRO, "no"),
    Transition(START_MICRO, CHOOSE_TEST, ""),
    Transition(CHOOSE_TEST, TEST, "after the pause"),
    Transition(CHOOSE_TEST, AVERAGE_RANGES, "no axle to test"),
    Transition(TEST, JUDGE_AXLE, "enough"),
    Transition(TEST, START_MACRO, "always: macro better"),
    Transition(JUDGE_AXLE, AVERAGE_RANGES, "yes"),
    Transition(JUDGE_AXLE, AXLE_TO_MICRO, "no"),
    Transition(AXLE_TO_MICRO, AVERAGE_RANGES, ""),
    Transition(AVERAGE_RANGES, SUM_UP_RANGES, ""),
    Transition(SUM_UP_RANGES, COMPARE_RANGES, ""),
    Transition(COMPARE_RANGES, START_MACRO, "yes"),
    Transition(COMPARE_RANGES, START_MICRO, "micro better (claim 7)"),
    Transition(COMPARE_RANGES, CHOOSE_TEST, "no"),
)
"""Every way that the supervisor can take."""
