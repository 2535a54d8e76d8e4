"""The adaptive supervisor: figure 2 of the source, one step a tick.

Two rules answer its three questions (306, 310, 314). *Forces* is the source's own: mean force in
macro-slip against F0, and against the mean force in micro-slip. *Lookout* keeps the leading axles
in macro-slip and compares the last of them with the first: where sliding cleans the rail the
follower reaches more force on the same spot a moment later; where it does not, it reaches as much.
Until the first decision the axles behind may be held in a middle range: a first slide right down to
macro-slip costs a stop on leaves more than all that follows.
"""

from __future__ import annotations

from railgrip.control.adaptive_parameters import (
    ALWAYS,
    CLEAN_RETURN,
    CLEAN_STAY,
    DECIDE,
    DECIDE_DISTANCE,
    EARLY_DISTANCE,
    IS_SYMMETRIC,
    K_AXLE,
    K_SYSTEM,
    LEAST_AXLES,
    LOOKOUT,
    N_TEST,
    RETURN_MARGIN,
    RETURN_TO,
    RULE,
    START,
    TEST_DISTANCE,
    TEST_PAUSE,
    TEST_TIME,
)
from railgrip.control.adaptive_state import (
    F0,
    FOLLOWER_FORCE,
    HAS_PASSED,
    HAVE_CHANGED,
    IS_DECIDED,
    IS_LEAD,
    IS_TESTED,
    LEADER_FORCE,
    LEADER_SLID,
    MACRO_F0,
    MACRO_FORCE,
    MACRO_SLID,
    MEAN,
    MICRO_FORCE,
    N_MACRO,
    N_MICRO,
    RANGE,
    RANGE_CLOCK,
    SLID,
    STATE,
    TEST_CLOCK,
    TEST_NUMBER,
    TESTED_AT,
)
from railgrip.control.adaptive_states import (
    AVERAGE,
    AVERAGE_RANGES,
    AXLE_TO_MICRO,
    CHOOSE_TEST,
    COMPARE_RANGES,
    HAS_SLID,
    IS_MACRO_BETTER,
    JUDGE_AXLE,
    START_MACRO,
    START_MICRO,
    STORE_F0,
    SUM_UP,
    SUM_UP_RANGES,
    TEST,
)
from railgrip.control.contract import MACRO, MICRO, FloatArray
from railgrip.control.state_layout import axle_base


def supervise(parameters: FloatArray, state: FloatArray, n_axles: int, dt: float) -> None:
    """Do what the present state says and go to the next one.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    n_axles : int
        Number of axles.
    dt : float
        Time since the last call, [s].
    """
    now = state[STATE]
    if now <= IS_MACRO_BETTER:
        after = _step_in_macro(parameters, state, n_axles, now)
    else:
        after = _step_in_micro(parameters, state, n_axles, now, dt)
    state[STATE] = after


def _step_in_macro(parameters: FloatArray, state: FloatArray, n_axles: int, now: float) -> float:
    """Do what 301 … 306 say and return the next state."""
    after = now
    if now == START_MACRO:
        is_decided = state[IS_DECIDED] > 0.0
        set_all(state, n_axles, MACRO if is_decided else parameters[START])
        after = STORE_F0
    elif now == STORE_F0:
        if state[N_MACRO] >= min(parameters[LEAST_AXLES], n_axles):
            after = AVERAGE
    elif now == AVERAGE:
        after = SUM_UP
    elif now == SUM_UP:
        after = HAS_SLID
    elif now == HAS_SLID:
        after = IS_MACRO_BETTER if has_slid(parameters, state, n_axles) else SUM_UP
    elif now == IS_MACRO_BETTER:
        after = START_MICRO
        if is_macro_better(parameters, state):
            was_decided = state[IS_DECIDED] > 0.0
            after = parameters[RETURN_TO] if was_decided else START_MACRO
        state[IS_DECIDED] = 1.0
    return after


def _step_in_micro(
    parameters: FloatArray, state: FloatArray, n_axles: int, now: float, dt: float
) -> float:
    """Do what 307 … 314 say and return the next state."""
    after = now
    if now == START_MICRO:
        set_all(state, n_axles, MICRO)
        state[TEST_CLOCK] = 0.0
        after = CHOOSE_TEST
    elif now == CHOOSE_TEST:
        state[TEST_CLOCK] += dt
        if parameters[RULE] == LOOKOUT or state[TEST_CLOCK] > parameters[TEST_PAUSE]:
            n_chosen = choose_tests(parameters, state, n_axles)
            state[TEST_CLOCK] = 0.0
            after = TEST if n_chosen > 0 else AVERAGE_RANGES
    elif now == TEST:
        state[TEST_CLOCK] += dt
        if parameters[DECIDE] == ALWAYS and are_macro_axles_better(parameters, state):
            after = START_MACRO
        elif is_test_over(parameters, state, n_axles):
            after = JUDGE_AXLE
    elif now == JUDGE_AXLE:
        state[HAS_PASSED] = 1.0 if judge_tests(parameters, state, n_axles) else 0.0
        after = AVERAGE_RANGES if state[HAS_PASSED] > 0.0 else AXLE_TO_MICRO
    elif now == AXLE_TO_MICRO:
        end_tests(parameters, state, n_axles)
        after = AVERAGE_RANGES
    elif now == AVERAGE_RANGES:
        after = SUM_UP_RANGES
    elif now == SUM_UP_RANGES:
        after = COMPARE_RANGES
    elif now == COMPARE_RANGES:
        after = compare_ranges(parameters, state)
    return after


def set_range(state: FloatArray, axle: int, slip_range: float) -> None:
    """Hold an axle in a range; if that is a change, its means begin anew."""
    place = axle_base(axle) + RANGE
    if state[place] != slip_range:
        state[place] = slip_range
        state[axle_base(axle) + RANGE_CLOCK] = 0.0
        state[HAVE_CHANGED] = 1.0


def set_all(state: FloatArray, n_axles: int, slip_range: float) -> None:
    """Hold every axle in a range (301, 307); leading test axles stay in macro-slip."""
    for axle in range(n_axles):
        base = axle_base(axle)
        is_lead = state[base + IS_LEAD] > 0.0
        set_range(state, axle, MACRO if is_lead else slip_range)
        state[base + SLID] = 0.0
        state[base + IS_TESTED] = 0.0


def has_slid(parameters: FloatArray, state: FloatArray, n_axles: int) -> bool:
    """Return whether the slid distance is enough for a decision on the system (305)."""
    distance = parameters[DECIDE_DISTANCE]
    n_counted = state[N_MACRO]
    is_enough: bool = (
        n_counted >= min(parameters[LEAST_AXLES], n_axles)
        and state[MACRO_SLID] >= distance * n_counted
    )
    if parameters[RULE] == LOOKOUT:
        slid = state[LEADER_SLID]
        gains = rail_gets_clean(state, parameters[CLEAN_RETURN])
        is_enough = state[FOLLOWER_FORCE] > 0.0 and slid >= distance
        is_enough = is_enough or (gains and slid >= parameters[EARLY_DISTANCE])
    return is_enough


def is_macro_better(parameters: FloatArray, state: FloatArray) -> bool:
    """Return whether the system stays in macro-slip (306)."""
    if parameters[RULE] == LOOKOUT:
        return rail_gets_clean(state, parameters[CLEAN_STAY])
    is_better: bool = state[MACRO_FORCE] > parameters[K_SYSTEM] * state[MACRO_F0]
    return is_better


def rail_gets_clean(state: FloatArray, factor: float) -> bool:
    """Return whether the follower reaches more force than the leader by a factor."""
    gains: bool = state[FOLLOWER_FORCE] > factor * state[LEADER_FORCE] > 0.0
    return gains


def choose_tests(parameters: FloatArray, state: FloatArray, n_axles: int) -> int:
    """Begin a test (308) and return the number of test axles."""
    state[TEST_NUMBER] += 1.0
    n_chosen = 0
    if parameters[RULE] == LOOKOUT:
        for axle in range(n_axles):
            base = axle_base(axle)
            if state[base + IS_LEAD] > 0.0:
                begin_test(state, axle)
                n_chosen += 1
        return n_chosen
    while n_chosen < parameters[N_TEST]:
        axle = tested_longest_ago(state, n_axles)
        if axle < 0:
            return n_chosen
        begin_test(state, axle)
        n_chosen += 1
    return n_chosen


def begin_test(state: FloatArray, axle: int) -> None:
    """Put an axle into its test phase, in macro-slip."""
    base = axle_base(axle)
    set_range(state, axle, MACRO)
    state[base + SLID] = 0.0
    state[base + IS_TESTED] = 1.0
    state[base + TESTED_AT] = state[TEST_NUMBER]


def tested_longest_ago(state: FloatArray, n_axles: int) -> int:
    """Return the micro axle tested longest ago, the first of several; -1 for none."""
    chosen = -1
    oldest = 0.0
    for axle in range(n_axles):
        base = axle_base(axle)
        is_fit = state[base + RANGE] == MICRO and state[base + RANGE_CLOCK] > 0.0
        if is_fit and (chosen < 0 or state[base + TESTED_AT] < oldest):
            chosen = axle
            oldest = state[base + TESTED_AT]
    return chosen


def is_test_over(parameters: FloatArray, state: FloatArray, n_axles: int) -> bool:
    """Return whether every test axle has slid far enough, or time is up (309)."""
    if state[TEST_CLOCK] > parameters[TEST_TIME]:
        return True
    if parameters[RULE] == LOOKOUT:
        has_led: bool = state[LEADER_SLID] >= parameters[TEST_DISTANCE]
        return has_led
    for axle in range(n_axles):
        base = axle_base(axle)
        if state[base + IS_TESTED] > 0.0 and state[base + SLID] < parameters[TEST_DISTANCE]:
            return False
    return True


def judge_tests(parameters: FloatArray, state: FloatArray, n_axles: int) -> bool:
    """Return whether every test axle is better off in macro-slip (310)."""
    if parameters[RULE] == LOOKOUT:
        return rail_gets_clean(state, parameters[CLEAN_RETURN])
    for axle in range(n_axles):
        base = axle_base(axle)
        if state[base + IS_TESTED] > 0.0 and not is_axle_better(parameters, state, base):
            return False
    return True


def is_axle_better(parameters: FloatArray, state: FloatArray, base: int) -> bool:
    """Return whether a test axle's mean force passes its F0; one that never broke away does not."""
    is_better: bool = state[base + MEAN] > parameters[K_AXLE] * state[base + F0] > 0.0
    return is_better


def end_tests(parameters: FloatArray, state: FloatArray, n_axles: int) -> None:
    """Put the test axles that are not better off back into micro-slip (311)."""
    for axle in range(n_axles):
        base = axle_base(axle)
        if state[base + IS_TESTED] > 0.0 and state[base + IS_LEAD] == 0.0:
            if not is_axle_better(parameters, state, base):
                set_range(state, axle, MICRO)
            state[base + IS_TESTED] = 0.0


def are_macro_axles_better(parameters: FloatArray, state: FloatArray) -> bool:
    """Return whether the system goes back to macro-slip (314)."""
    if parameters[RULE] == LOOKOUT:
        return rail_gets_clean(state, parameters[CLEAN_RETURN])
    macro = state[MACRO_FORCE] * state[N_MICRO]
    micro = state[MICRO_FORCE] * state[N_MACRO]
    are_better: bool = macro > parameters[RETURN_MARGIN] * micro > 0.0
    return are_better


def compare_ranges(parameters: FloatArray, state: FloatArray) -> float:
    """Return the state after 314: back to macro, all to micro (claim 7), or the next test."""
    if are_macro_axles_better(parameters, state):
        return START_MACRO
    if parameters[IS_SYMMETRIC] > 0.0 and parameters[RULE] != LOOKOUT:
        macro = state[MACRO_FORCE] * state[N_MICRO]
        micro = state[MICRO_FORCE] * state[N_MACRO]
        if micro > parameters[RETURN_MARGIN] * macro > 0.0:
            return START_MICRO
    return CHOOSE_TEST
