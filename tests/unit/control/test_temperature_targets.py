"""The relations of temperature control, against formulas and signals known without them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.control import contract as ctl
from railgrip.control.adhesion_window import observe_friction
from railgrip.control.conventional_state import DYNAMIC, SPEED
from railgrip.control.pressure_following import follow_pressure
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.temperature_controlled import TemperatureControlled
from railgrip.control.temperature_limit import limit_factor
from railgrip.control.temperature_parameters import LINEAR, TemperatureParameters
from railgrip.control.temperature_state import FRICTION, MASS
from railgrip.control.temperature_targets import (
    admissible_power,
    force_target,
    friction_speed,
    per_fastest,
    signed_slip,
    slip_target,
)
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    flash_conductance,
    flash_temperature,
)

P = TemperatureParameters(set_point=1.0)
ALONG, ACROSS = P.semi_axis_along, P.semi_axis_across
STILL = flash_conductance(STEEL_ERTZ_2002, ALONG, ACROSS, 0.0) ** 2
MOVING = flash_conductance(STEEL_ERTZ_2002, ALONG, ACROSS, 1.0) ** 2 - STILL
speeds = st.floats(1.0, 80.0)
BASE = axle_base(0)


def power(parameters: Any, wheel: float, train: float) -> float:
    return admissible_power(parameters, STILL, MOVING, wheel, train, 1.0)


@given(speeds, speeds, st.floats(20.0, 500.0))
def test_the_physical_power_heats_both_bodies_by_the_limit(
    wheel: float, train: float, rise: float
) -> None:
    given_power = power(P._replace(rise_wheel=rise, rise_rail=rise), wheel, train)
    bodies = [flash_conductance(STEEL_ERTZ_2002, ALONG, ACROSS, v) for v in (wheel, train)]
    assert flash_temperature(*bodies, given_power / 2).rise == pytest.approx(rise, rel=1e-9)


@given(speeds, speeds)
def test_the_linear_law_is_the_source_s(wheel: float, train: float) -> None:
    """ΔT = k_T (P/A) t with t = l/v, for the wheel and for the rail; the smaller power counts."""
    limits = P._replace(heat_law=LINEAR, rise_wheel=150.0, rise_rail=200.0)
    density = power(limits, wheel, train) / 2 / (4 * ALONG * ACROSS)
    of_wheel, of_rail = (limits.linear_factor * density * 2 * ALONG / v for v in (wheel, train))
    assert of_wheel <= 150.0 * (1 + 1e-12)
    assert of_rail <= 200.0 * (1 + 1e-12)
    assert of_wheel == pytest.approx(150.0) or of_rail == pytest.approx(200.0)


@pytest.mark.parametrize(
    ("wheel", "train", "governs", "idle"),
    [(15.0, 20.0, "rise_wheel", "rise_rail"), (20.0, 15.0, "rise_rail", "rise_wheel")],
    ids=["braking", "driving"],
)
def test_with_equal_limits_the_slower_body_governs(
    wheel: float, train: float, governs: str, idle: str
) -> None:
    linear = P._replace(heat_law=LINEAR)
    both = power(linear, wheel, train)
    assert power(linear._replace(**{idle: 0.0}), wheel, train) == both
    assert power(linear._replace(**{governs: 0.0}), wheel, train) > both


def test_k_t_matches_the_physical_law_at_20_m_per_s() -> None:
    linear = P._replace(heat_law=LINEAR)
    assert power(linear, 20.0, 20.0) == pytest.approx(power(P, 20.0, 20.0), rel=1e-3)


def test_power_grows_with_v_in_the_source_and_with_its_root_in_physics() -> None:
    for law, exponent in ((P, 0.5), (P._replace(heat_law=LINEAR), 1.0)):
        ratio = power(law, 40.0, 40.0) / power(law, 10.0, 10.0)
        assert ratio == pytest.approx(4.0**exponent, rel=1e-3)


def test_without_any_limit_the_slip_target_is_its_bound() -> None:
    free = P._replace(rise_wheel=0.0, rise_rail=0.0)
    speed = friction_speed(free, power(free, 20.0, 20.0), -5e3, 127e3)
    assert slip_target(speed, 1.0 / 20.0, P.greatest_slip, -1.0) == -0.25


def test_floors_keep_a_standing_train_from_being_refused() -> None:
    assert power(P, 0.0, 0.0) > 1e3
    assert signed_slip(0.0, 0.0, per_fastest(P, 0.0)) == 0.0
    assert friction_speed(P, 1e4, 0.0, 100e3) == pytest.approx(1e4 / 1e3)


@given(st.floats(-0.6, 0.0), st.floats(-0.25, 0.0), st.floats(-9e3, 0.0), st.floats(-2.0, 0.0))
def test_one_sign_convention_for_both_directions(
    slip: float, wanted: float, friction: float, acceleration: float
) -> None:
    def force(sign: float) -> float:
        signed = (sign * x for x in (slip, wanted, friction, acceleration))
        return force_target(P, *signed, 1e3, 15e3, 4.0, sign * -15e3, 20.0)

    assert force(1.0) == -force(-1.0)
    assert -15e3 <= force(1.0) <= 0.0


def test_the_limit_follows_its_course() -> None:
    steps = P._replace(course_1=2.0, factor_1=0.5, course_2=4.0, factor_2=2.0, emergency_factor=1.5)
    assert [limit_factor(steps, t, 0.0) for t in (0.0, 2.0, 3.9, 4.0, 9.0)] == [1, 0.5, 0.5, 2, 2]
    ramps = steps._replace(course_ramps=1.0)
    found = [limit_factor(ramps, t, 0.0) for t in (0.0, 1.0, 2.0, 3.0, 9.0)]
    assert found == [1.0, 0.75, 0.5, 1.25, 2.0]
    assert limit_factor(steps, 9.0, 1.0) == 3.0


def observe(state: np.ndarray, sample: int, speed: float) -> None:
    """A window of ten samples, and 8 kN applied."""
    state[BASE + SPEED] = speed
    state[BASE + DYNAMIC] = 8e3
    observe_friction(state, 1, sample, 10, 0.01)


def test_the_window_finds_the_force_of_the_rail() -> None:
    """A wheel of 1 t braked by 8 kN that slows by 2 m/s²: the rail gives 6 kN."""
    state = np.zeros(state_size(1))
    state[BASE + MASS] = 1000.0
    for sample in range(40):
        observe(state, sample, 30.0 - 0.02 * sample)
    assert state[BASE + FRICTION] == pytest.approx(-6e3, rel=1e-9)


def test_the_window_lags_by_half_its_length() -> None:
    state = np.zeros(state_size(1))
    state[BASE + MASS] = 1000.0
    speed, seen = 30.0, []
    for sample in range(100):
        rail = -4e3 if sample < 50 else -8e3
        observe(state, sample, speed)
        seen.append(state[BASE + FRICTION])
        speed += (-8e3 - rail) / 1000.0 * 0.01
    assert seen[49] == pytest.approx(-4e3)
    assert 4 <= int(np.argmax(np.array(seen[50:]) < -6e3)) <= 7


def test_a_valve_leads_a_late_cylinder_to_its_pressure() -> None:
    state = np.zeros(state_size(1))
    pressure, commands, course = 3.0e5, [ctl.HOLD] * 6, []
    for _ in range(300):
        commands.append(follow_pressure(P, state, BASE, True, pressure, 1.2e5, 3.0e5, 0.01))
        if commands[-6] == ctl.VENT:
            pressure -= pressure / 0.3 * 0.01
        elif commands[-6] == ctl.FILL:
            pressure += (3.0e5 - pressure) / 0.43 * 0.01
        course.append(pressure)
    assert min(course) > 1.2e5 - 2 * P.pressure_band
    assert course[-1] == pytest.approx(1.2e5, abs=1.5 * P.pressure_band)
    assert commands[-50:].count(ctl.HOLD) == 50


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"set_point": 0.0}, "set_point: must lie above 0 and up to 1"),
        ({"rise_rail": -1.0}, "rise_wheel: must not be negative; 0 means no limit"),
        ({"course_2": 1.0, "course_1": 2.0}, "course_1: the times of the course must ascend"),
        ({"observer_window": 1.0}, "observer_window: must be 1 to 31 periods"),
        ({"heat_law": 2.0}, "heat_law: must be 0 .physical. or 1 .linear."),
    ],
)
def test_what_no_vehicle_can_mean_is_refused(change: dict[str, float], sentence: str) -> None:
    with pytest.raises(RailgripError, match=sentence):
        TemperatureControlled(P._replace(**change))
