"""Every way of figure 2, one at a time, from a state that is written by hand."""

import numpy as np
import pytest

from railgrip.control import adaptive_states as at
from railgrip.control import adaptive_supervisor as sup
from railgrip.control.adaptive_parameters import ALWAYS, FORCES, AdaptiveParameters
from railgrip.control.adaptive_state import (
    F0,
    FOLLOWER_FORCE,
    HAS_PASSED,
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
    TESTED_AT,
)
from railgrip.control.contract import MACRO, MICRO, MIDDLE
from railgrip.control.state_layout import axle_base, state_size
from railgrip.core.errors import RailgripError

N = 4
DT = 0.02
SOURCE = {"rule": FORCES, "lead_axles": 0.0, "start": MACRO}


class Bench:
    """A supervisor of four axles whose sums are given."""

    def __init__(self, number, slip_range=MACRO, **parameters):
        self.parameters = np.array(AdaptiveParameters(**parameters))
        self.state = np.zeros(state_size(N))
        self.system(STATE, number)
        for axle in range(N):
            self.state[axle_base(axle) + RANGE] = slip_range
            self.axle(axle, RANGE_CLOCK, 9.0)

    def system(self, place, value):
        self.state[place] = value

    def axle(self, axle, place, value):
        self.state[axle_base(axle) + place] = value

    def of(self, axle, place):
        return self.state[axle_base(axle) + place]

    def step(self):
        sup.supervise(self.parameters, self.state, N, DT)
        return self.state[STATE]

    @property
    def ranges(self):
        return [self.state[axle_base(axle) + RANGE] for axle in range(N)]


def lookout(bench, leader, follower, slid=20.0):
    for place, value in ((LEADER_FORCE, leader), (FOLLOWER_FORCE, follower), (LEADER_SLID, slid)):
        bench.system(place, value)
    return bench


def sums(bench, macro=(0, 0.0), micro=(0, 0.0), f0=0.0, slid=0.0):
    for place, value in (
        (N_MACRO, macro[0]), (MACRO_FORCE, macro[1]), (N_MICRO, micro[0]), (MICRO_FORCE, micro[1]),
        (MACRO_F0, f0), (MACRO_SLID, slid),
    ):  # fmt: skip
        bench.system(place, value)
    return bench


TAKEN = [
    (at.START_MACRO, at.STORE_F0, lambda: Bench(301.0)),
    (at.STORE_F0, at.STORE_F0, lambda: sums(Bench(302.0), macro=(2, 2.0))),
    (at.STORE_F0, at.AVERAGE, lambda: sums(Bench(302.0), macro=(3, 3.0))),
    (at.AVERAGE, at.SUM_UP, lambda: Bench(303.0)),
    (at.SUM_UP, at.HAS_SLID, lambda: Bench(304.0)),
    (at.HAS_SLID, at.SUM_UP, lambda: lookout(Bench(305.0), 1.0, 1.15, slid=7.9)),
    (at.HAS_SLID, at.SUM_UP, lambda: lookout(Bench(305.0), 1.0, 1.3, slid=0.9)),
    (at.HAS_SLID, at.IS_MACRO_BETTER, lambda: lookout(Bench(305.0), 1.0, 1.3, slid=1.1)),
    (at.HAS_SLID, at.SUM_UP, lambda: lookout(Bench(305.0), 1.0, 0.0)),
    (at.HAS_SLID, at.IS_MACRO_BETTER, lambda: lookout(Bench(305.0), 1.0, 1.0, slid=8.1)),
    (at.HAS_SLID, at.SUM_UP, lambda: sums(Bench(305.0, **SOURCE), (4, 4.0), slid=31.0)),
    (at.HAS_SLID, at.SUM_UP, lambda: sums(Bench(305.0, **SOURCE), (2, 2.0), slid=99.0)),
    (at.HAS_SLID, at.IS_MACRO_BETTER, lambda: sums(Bench(305.0, **SOURCE), (4, 4.0), slid=33.0)),
    (at.IS_MACRO_BETTER, at.START_MACRO, lambda: lookout(Bench(306.0), 1.0, 1.2)),
    (at.IS_MACRO_BETTER, at.START_MICRO, lambda: lookout(Bench(306.0), 1.0, 1.05)),
    (
        at.IS_MACRO_BETTER,
        at.START_MACRO,
        lambda: sums(Bench(306.0, **SOURCE), (4, 3.3), f0=4.0),
    ),
    (
        at.IS_MACRO_BETTER,
        at.STORE_F0,
        lambda: decided(sums(Bench(306.0, return_to=302.0, **SOURCE), (4, 3.3), f0=4.0)),
    ),
    (
        at.IS_MACRO_BETTER,
        at.START_MICRO,
        lambda: sums(Bench(306.0, **SOURCE), (4, 3.1), f0=4.0),
    ),
    (at.START_MICRO, at.CHOOSE_TEST, lambda: Bench(307.0)),
    (at.CHOOSE_TEST, at.TEST, lambda: lead(Bench(308.0))),
    (at.CHOOSE_TEST, at.CHOOSE_TEST, lambda: Bench(308.0, MICRO, **SOURCE)),
    (at.CHOOSE_TEST, at.TEST, lambda: Bench(308.0, MICRO, test_pause=0.0, **SOURCE)),
    (at.CHOOSE_TEST, at.AVERAGE_RANGES, lambda: Bench(308.0, MACRO, test_pause=0.0, **SOURCE)),
    (
        at.CHOOSE_TEST,
        at.AVERAGE_RANGES,
        lambda: Bench(308.0, MICRO, test_pause=0.0, n_test=0.0, **SOURCE),
    ),
    (at.TEST, at.TEST, lambda: lookout(Bench(309.0), 1.0, 2.0, slid=2.9)),
    (at.TEST, at.JUDGE_AXLE, lambda: lookout(Bench(309.0), 1.0, 2.0, slid=3.1)),
    (at.TEST, at.JUDGE_AXLE, lambda: late(lookout(Bench(309.0), 1.0, 2.0, slid=0.1))),
    (at.TEST, at.TEST, lambda: on_trial(Bench(309.0, **SOURCE), slid=2.9)),
    (at.TEST, at.JUDGE_AXLE, lambda: on_trial(Bench(309.0, **SOURCE), slid=3.1)),
    (
        at.TEST,
        at.START_MACRO,
        lambda: sums(Bench(309.0, decide=ALWAYS, **SOURCE), (1, 1.2), (3, 3.0)),
    ),
    (at.JUDGE_AXLE, at.AVERAGE_RANGES, lambda: lookout(Bench(310.0), 1.0, 1.3)),
    (at.JUDGE_AXLE, at.AXLE_TO_MICRO, lambda: lookout(Bench(310.0), 1.0, 1.15)),
    (at.JUDGE_AXLE, at.AVERAGE_RANGES, lambda: on_trial(Bench(310.0, **SOURCE), force=0.95)),
    (at.JUDGE_AXLE, at.AXLE_TO_MICRO, lambda: on_trial(Bench(310.0, **SOURCE), force=0.85)),
    (at.AXLE_TO_MICRO, at.AVERAGE_RANGES, lambda: Bench(311.0)),
    (at.AVERAGE_RANGES, at.SUM_UP_RANGES, lambda: Bench(312.0)),
    (at.SUM_UP_RANGES, at.COMPARE_RANGES, lambda: Bench(313.0)),
    (at.COMPARE_RANGES, at.START_MACRO, lambda: lookout(Bench(314.0), 1.0, 1.3)),
    (at.COMPARE_RANGES, at.CHOOSE_TEST, lambda: lookout(Bench(314.0), 1.0, 1.15)),
    (at.COMPARE_RANGES, at.START_MACRO, lambda: sums(Bench(314.0, **SOURCE), (1, 1.1), (3, 3.0))),
    (at.COMPARE_RANGES, at.CHOOSE_TEST, lambda: sums(Bench(314.0, **SOURCE), (1, 1.0), (3, 3.0))),
    (at.COMPARE_RANGES, at.CHOOSE_TEST, lambda: sums(Bench(314.0, **SOURCE), (0, 0.0), (4, 4.0))),
    (at.COMPARE_RANGES, at.CHOOSE_TEST, lambda: sums(Bench(314.0, **SOURCE), (4, 4.0), (0, 0.0))),
    (
        at.COMPARE_RANGES,
        at.START_MICRO,
        lambda: sums(Bench(314.0, is_symmetric=1.0, **SOURCE), (1, 0.9), (3, 3.0)),
    ),
]


def lead(bench):
    for axle in (0, 1):
        bench.axle(axle, IS_LEAD, 1.0)
    return bench


def on_trial(bench, slid=0.0, force=0.0):
    for place, value in ((IS_TESTED, 1.0), (SLID, slid), (MEAN, force), (F0, 1.0)):
        bench.axle(2, place, value)
    return bench


def decided(bench):
    bench.system(IS_DECIDED, 1.0)
    return bench


def late(bench):
    bench.system(TEST_CLOCK, 8.0)
    return bench


@pytest.mark.parametrize(("before", "after", "make"), TAKEN)
def test_a_way(before, after, make):
    bench = make()
    assert bench.state[STATE] == before
    assert bench.step() == after


def test_the_table_knows_every_way_and_none_besides():
    taken = {(before, after) for before, after, _ in TAKEN if before != after}
    table = [(way.before, way.after) for way in at.TRANSITIONS]
    assert len(set(table)) == len(table)
    assert taken == set(table)
    assert set(at.STATES) == {float(number) for number in range(301, 315)}
    assert {number for way in table for number in way} == set(at.STATES)


def test_all_to_micro_leaves_the_lookout_in_macro():
    bench = lead(Bench(307.0))
    bench.step()
    assert bench.ranges == [MACRO, MACRO, MICRO, MICRO]
    assert [bench.of(axle, RANGE_CLOCK) for axle in range(N)] == [9.0, 9.0, 0.0, 0.0]


def test_until_the_first_decision_the_followers_wait_in_the_middle_range():
    bench = lead(Bench(301.0))
    bench.step()
    assert bench.ranges == [MACRO, MACRO, MIDDLE, MIDDLE]
    bench = decided(lead(Bench(301.0, MIDDLE)))
    bench.step()
    assert bench.ranges == [MACRO] * N


def test_back_to_macro_takes_everyone_and_forgets_the_way_slid():
    bench = decided(Bench(301.0, MICRO))
    bench.axle(1, SLID, 3.0)
    bench.step()
    assert bench.ranges == [MACRO] * N
    assert bench.of(1, SLID) == 0.0


def test_the_axle_tested_longest_ago_is_next():
    bench = Bench(308.0, MICRO, test_pause=0.0, **SOURCE)
    for axle, number in enumerate((5.0, 3.0, 4.0, 0.0)):
        bench.axle(axle, TESTED_AT, number)
    bench.state[axle_base(3) + RANGE] = MACRO  # one that stayed in macro is no test axle
    bench.step()
    assert bench.ranges == [MICRO, MACRO, MICRO, MACRO]


def test_an_axle_that_does_not_brake_is_not_tested():
    bench = Bench(308.0, MICRO, test_pause=0.0, **SOURCE)
    bench.axle(0, RANGE_CLOCK, 0.0)
    bench.step()
    assert bench.ranges == [MICRO, MACRO, MICRO, MICRO]


def test_several_test_axles():
    bench = Bench(308.0, MICRO, test_pause=0.0, **{**SOURCE, "n_test": 3.0})
    bench.step()
    assert bench.ranges == [MACRO, MACRO, MACRO, MICRO]


def test_each_test_axle_decides_for_itself():
    """311: the one that reached less than k F0 goes to micro, the other stays and accumulates."""
    bench = Bench(311.0, MACRO, **SOURCE)
    for axle, force in ((0, 0.8), (1, 1.2)):
        for place, value in ((IS_TESTED, 1.0), (MEAN, force), (F0, 1.0)):
            bench.axle(axle, place, value)
    bench.step()
    assert bench.ranges == [MICRO, MACRO, MACRO, MACRO]


def test_an_axle_that_never_broke_away_does_not_pass():
    bench = on_trial(Bench(310.0, **SOURCE), force=5.0)
    bench.axle(2, F0, 0.0)
    assert bench.step() == at.AXLE_TO_MICRO
    assert bench.state[HAS_PASSED] == 0.0


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"rule": 3.0}, "rule.*got 3.*0, 1"),
        ({"start": 0.0}, r"start.*1, 1\.5, 2"),
        ({"return_to": 303.0}, "return_to.*301, 302"),
        ({"lead_axles": 1.0}, "lead_axles.*at least 2"),
        ({"n_test": 1.5}, "n_test.*whole"),
        ({"mean_time": float("nan")}, "mean_time.*at least 0"),
        ({"deceleration_per_pressure": 0.0}, "deceleration_per_pressure"),
        ({"micro_upper": 0.001}, "micro_lower"),
    ],
)
def test_wrong_parameters_are_refused_in_one_sentence(wrong, words):
    from railgrip.control.adaptive_wsp import AdaptiveWSP

    with pytest.raises(RailgripError, match=words):
        AdaptiveWSP(AdaptiveParameters(**wrong))
