"""The multiple unit of EN 14531-1's example, from its TOML file to its published figures."""

import pytest

from railgrip.core.errors import RailgripError
from railgrip.scenario import library
from railgrip.scenario.train import Train
from railgrip.train.en14531 import mean_resistance, stopping_distance

SPEED = 100 / 3.6


@pytest.fixture
def train():
    return Train.model_validate(library.fetch("train", "emu_en14531"))


def mean_force(train, axle):
    brake = train.brakes[axle.brake]
    radius = brake.friction_radius or axle.wheel_radius
    lever = 2 * radius / (2 * axle.wheel_radius)
    return brake.units * brake.greatest_clamp_force * brake.pad.friction * lever


def test_force_of_each_axle(train):
    # EN 14531-1, simplified example; the file's numbers have at most three digits.
    forces = [mean_force(train, place.axle) for place in train.axles()]
    tread, disc = 16073.5, 9104.2
    expected = [tread, tread, disc, disc, disc, disc, tread, tread]
    assert forces == pytest.approx(expected, abs=0.06)


def test_stop_from_100_kmh_is_497_8_m(train):
    axles = [place.axle for place in train.axles()]
    brakes = [train.brakes[axle.brake] for axle in axles]
    resistance = train.resistance
    stop = stopping_distance(
        SPEED,
        [mean_force(train, axle) for axle in axles],
        [brake.dead_time + brake.fill_time / 2 for brake in brakes],
        dynamic_mass=train.tare + sum(axle.rotating_mass for axle in axles),
        external_force=mean_resistance(
            SPEED,
            constant=resistance.constant,
            linear=resistance.linear,
            quadratic=resistance.quadratic,
        ),
    )
    assert stop.response_time == pytest.approx(1.682, abs=5e-4)
    assert stop.distance == pytest.approx(497.8, abs=0.1)


def test_slowing_and_stopping_add_up():
    # Without response time, 30 → 10 m/s and 10 → 0 m/s make 30 → 0 m/s.
    def distance(v0, v1):
        return stopping_distance(v0, [1e5], [0.0], dynamic_mass=1e5, final_speed=v1).distance

    assert distance(30, 10) + distance(10, 0) == pytest.approx(distance(30, 0))


def test_mean_resistance_is_the_mean_over_the_distance():
    # Distance-weighted mean by stepping an even deceleration, 1 m/s².
    steps = 20_000
    v0, v1, a, b, c = 40.0, 10.0, 3000.0, 110.0, 7.0
    total = (v0**2 - v1**2) / 2
    speeds = [(v0**2 - 2 * total * (k + 0.5) / steps) ** 0.5 for k in range(steps)]
    mean = sum(a + b * v + c * v * v for v in speeds) / steps
    formula = mean_resistance(v0, constant=a, linear=b, quadratic=c, final_speed=v1)
    assert formula == pytest.approx(mean, rel=1e-6)


def test_a_train_that_the_brake_does_not_hold_is_refused():
    with pytest.raises(RailgripError, match="do not hold the train; got a total force of -100 N"):
        stopping_distance(20.0, [900.0], [1.0], dynamic_mass=1e4, external_force=-1000.0)


def test_forces_and_times_must_match():
    with pytest.raises(RailgripError, match="one value for each brake force; got 1 for 2 forces"):
        stopping_distance(20.0, [900.0, 900.0], [1.0], dynamic_mass=1e4)
