"""When a point is heated, and what cannot be a course, a patch or a train."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.heat_pulses import HeatPulses, rail_pulses, wheel_pulses
from railgrip.laboratory.temperature_cycle import pulse_rises

PATCH = {"length": 12e-3, "width": 20e-3}


def test_contact_and_pause_make_one_revolution() -> None:
    """T_on = l/v, pause T(1 − l/U), as the patent has them."""
    pulses = wheel_pulses([0.0, 1.0], 30.0, 15e3, 3.0, **PATCH)
    period = 3.0 / 30.0
    assert pulses.duration == pytest.approx(12e-3 / 30.0)
    pauses = pulses.start[1:] - pulses.end[:-1]
    assert pauses == pytest.approx(period * (1.0 - 12e-3 / 3.0))
    assert pulses.flux == pytest.approx(15e3 / (12e-3 * 20e-3))


@pytest.mark.parametrize("end", [10.0, 10.2, 25.0])
def test_a_stop_to_a_stand_ends_with_its_last_revolution(end: float) -> None:
    """From 30 m/s in 10 s: 150 m are 50 turns of 3 m, and the wheel stands as the 51st begins."""
    time = np.array([0.0, 10.0] if end == 10.0 else [0.0, 10.0, end])
    speed = np.maximum(30.0 - 3.0 * time, 0.0)
    pulses = wheel_pulses(time, speed, 1e3 * speed, 3.0, **PATCH)
    assert pulses.start.size == 50
    assert np.isfinite(pulse_rises(pulses, 13290.0, time)).all()
    assert pulse_rises(pulses, 13290.0, time).min() >= 0.0


def test_a_wheel_may_start_from_a_stand_and_stand_in_between() -> None:
    pulses = wheel_pulses([0.0, 1.0, 2.0, 3.0, 4.0, 5.0], [0.0, 9.0, 0.0, 0.0, 9.0, 9.0],
                          1e3, 3.0, **PATCH)  # fmt: skip
    assert (pulses.duration > 0.0).all()
    assert (pulses.start[1:] >= pulses.end[:-1]).all()


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"time": [0.0, 0.0]}, "time: the time must rise"),
        ({"wheel_speed": [30.0, 30.0, 30.0]}, "wheel_speed: one value for each time"),
        ({"wheel_speed": -1.0}, "wheel_speed: must be zero or more, and finite; got -1"),
        ({"wheel_speed": 0.0}, "wheel_speed: the wheel does not turn"),
        ({"wheel_power": math.nan}, "wheel_power: must be zero or more, and finite; got nan"),
        ({"circumference": 0.01}, "length: the patch does not fit the wheel"),
        ({"circumference": math.nan}, "circumference: must be positive and finite"),
        ({"width": 0.0}, "width: must be positive and finite; got 0 m"),
    ],
)
def test_a_bad_course_of_a_wheel_gets_a_sentence(changes: dict[str, Any], says: str) -> None:
    given = {"time": [0.0, 1.0], "wheel_speed": 30.0, "wheel_power": 1e3, "circumference": 3.0}
    with pytest.raises(RailgripError) as caught:
        wheel_pulses(**(given | PATCH | changes))
    assert says in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"train_speed": 0.0}, "train_speed: the train does not move"),
        ({"rail_powers": [1.0, 2.0, 3.0]}, "rail_powers: one value for each wheel"),
        ({"wheel_places": [0.0, -2.5]}, "pulses: the pulses overlap or run backwards"),
        ({"wheel_places": [0.0, 5e-3]}, "pulses: the pulses overlap or run backwards"),
        ({"wheel_places": [0.0, math.nan]}, "start: a pulse is not a finite number"),
        ({"length": math.inf}, "length: must be positive and finite"),
    ],
)
def test_a_bad_train_gets_a_sentence(changes: dict[str, Any], says: str) -> None:
    given = {"wheel_places": [0.0, 2.5], "train_speed": 25.0, "rail_powers": 1e3}
    with pytest.raises(RailgripError) as caught:
        rail_pulses(**(given | PATCH | changes))
    assert says in str(caught.value)


def test_pulses_by_hand_need_the_same_number() -> None:
    with pytest.raises(RailgripError, match="the same number of pulses; got 2, 1, 2"):
        HeatPulses(np.array([0.0, 1.0]), np.array([0.5]), np.array([1.0, 1.0]))


@pytest.mark.parametrize(("beta", "times"), [(0.0, [1.0]), ("hot", [1.0]), (1e4, [math.nan])])
def test_rises_need_an_effusivity_and_times(beta: Any, times: list[float]) -> None:
    with pytest.raises(RailgripError):
        pulse_rises(HeatPulses(np.array(0.0), np.array(1e-3), np.array(1e8)), beta, times)


def test_no_pulse_and_no_time_are_no_trouble() -> None:
    none = HeatPulses(np.array([]), np.array([]), np.array([]))
    assert pulse_rises(none, 1e4, [1.0]).tolist() == [0.0]
    three = HeatPulses(np.arange(3.0), np.full(3, 0.1), np.ones(3))
    assert pulse_rises(three, 1e4, []).size == 0
