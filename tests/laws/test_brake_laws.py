"""What pads, rigging, orifices and brakes must obey, whatever their numbers."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.brake.constant_friction import ConstantFriction, constant_friction
from railgrip.brake.dynamic_brake import DynamicBrake, dynamic_brake_limit
from railgrip.brake.filling import (
    Distributor,
    LinearFilling,
    distributor_rate,
    linear_fill_rate,
)
from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950
from railgrip.brake.orifice import orifice_flow
from railgrip.brake.piecewise_friction import PiecewiseFriction, piecewise_friction
from railgrip.brake.rigging import Rigging, clamp_force, hysteresis
from railgrip.brake.track_brake import TrackBrake, track_brake_force
from railgrip.core.formulas.piecewise_linear import hinges_from_points

FORCES = st.floats(0.0, 2e5)
SPEEDS = st.floats(0.0, 100.0)
TEMPERATURES = st.floats(-40.0, 900.0)
PRESSURES = st.floats(0.0, 1e6)
ORGANIC = PiecewiseFriction(
    0.37,
    hinges_from_points([(150.0, 1.0), (350.0, 0.8)]),
    hinges_from_points([(0.0, 1.08), (10.0, 1.0), (15.0, 1.0), (55.0, 0.88)]),
    hinges_from_points([(10e3, 1.04), (25e3, 1.0), (40e3, 0.96)]),
)
TREAD = Rigging(346e-4, 0.95, -300.0, 5.0, 0.95, -500.0, 1.0)


@given(FORCES, SPEEDS, TEMPERATURES)
def test_pad_friction_is_positive_and_below_its_cold_slow_value(
    force: float, speed: float, temperature: float
) -> None:
    assert constant_friction(ConstantFriction(0.35), force, speed, temperature) == 0.35
    block = karwatzki_1950(KarwatzkiParameters(), force, speed, temperature)
    assert 0.055 < block <= 0.44 * (1.0 + 1e-12)
    pad = piecewise_friction(ORGANIC, force, speed, temperature)
    assert 0.37 * 0.8 * 0.88 * 0.96 - 1e-12 <= pad <= 0.37 * 1.08 * 1.04 + 1e-12


@given(FORCES, SPEEDS)
def test_a_block_bites_less_with_force_and_speed(force: float, speed: float) -> None:
    here = karwatzki_1950(KarwatzkiParameters(), force, speed, 20.0)
    assert karwatzki_1950(KarwatzkiParameters(), force + 1e3, speed, 20.0) < here
    assert karwatzki_1950(KarwatzkiParameters(), force, speed + 1.0, 20.0) < here


def test_the_reference_point_of_a_pad() -> None:
    assert piecewise_friction(ORGANIC, 25e3, 15.0, 100.0) == pytest.approx(0.37, rel=1e-12)


@given(PRESSURES)
def test_clamp_force_rises_from_zero(pressure: float) -> None:
    force = clamp_force(TREAD, pressure)
    assert force >= 0.0
    assert clamp_force(TREAD, pressure + 1e3) >= force
    assert clamp_force(TREAD._replace(units=2.0), pressure) == 2.0 * force


@pytest.mark.parametrize("pressure", [0.0, 0.05e5, 0.09e5])
def test_no_clamp_force_below_the_springs(pressure: float) -> None:
    assert clamp_force(TREAD, pressure) == 0.0


def play(forces: list[float], share: float) -> float:
    """Force after a path of nominal forces."""
    force = 0.0
    for nominal in forces:
        force = hysteresis(force, nominal, share)
    return force


@given(st.lists(FORCES, min_size=1), st.floats(0.0, 0.3))
def test_the_caliper_stays_within_its_play(forces: list[float], share: float) -> None:
    force = play(forces, share)
    assert forces[-1] <= force <= forces[-1] * (1.0 + share)
    assert hysteresis(force, forces[-1], share) == force


@given(st.lists(FORCES), FORCES, FORCES, st.floats(0.0, 1.0), st.floats(0.0, 0.3))
def test_the_caliper_knows_the_way_and_not_the_pace(
    forces: list[float], start: float, end: float, part: float, share: float
) -> None:
    between = min(max(start + part * (end - start), min(start, end)), max(start, end))
    assert play([*forces, start, end], share) == play([*forces, start, between, end], share)


@given(st.lists(FORCES), FORCES)
def test_rising_force_is_followed_at_once(forces: list[float], rise: float) -> None:
    top = max([0.0, *forces]) * 1.3 + rise
    assert play([*forces, top], 0.06) == top


@given(PRESSURES, PRESSURES)
def test_air_flows_downhill_and_the_same_both_ways(one: float, other: float) -> None:
    flow = orifice_flow(one, other)
    assert flow * (one - other) >= 0.0
    assert orifice_flow(other, one) == -flow
    assert abs(flow) <= max(one, other) + 1e5
    assert orifice_flow(one, one) == 0.0


@given(PRESSURES, PRESSURES, st.floats(0.0, 1e5))
def test_more_difference_means_no_less_flow(one: float, other: float, more: float) -> None:
    assert orifice_flow(one + more, other) >= orifice_flow(one, other) - 1e-6
    assert orifice_flow(one, other + more) <= orifice_flow(one, other) + 1e-6


@pytest.mark.parametrize("edge", [3.75e5, 0.5 * 5e5 - 1e5])
def test_the_flow_has_no_jump_at_its_joints(edge: float) -> None:
    below, above = orifice_flow(4e5, edge - 1e-3), orifice_flow(4e5, edge + 1e-3)
    assert below == pytest.approx(above, abs=0.1)


def test_the_flow_is_sonic_below_half_the_pressure() -> None:
    assert orifice_flow(4e5, 1.0e5) == orifice_flow(4e5, 0.0) == pytest.approx(5e5)


def test_the_flow_is_proportional_below_a_quarter_of_a_bar() -> None:
    at_a_quarter = 2e5 * (4.75 * 0.25) ** 0.5
    assert orifice_flow(4e5, 3.75e5) == pytest.approx(at_a_quarter, rel=1e-12)
    assert orifice_flow(4e5, 3.76e5) == pytest.approx(0.96 * at_a_quarter, rel=1e-12)
    assert orifice_flow(4e5, 3.9e5) == pytest.approx(0.4 * at_a_quarter, rel=1e-12)


@given(PRESSURES, PRESSURES, st.floats(1e-3, 1.0))
def test_a_ramp_ends_on_its_target(pressure: float, target: float, dt: float) -> None:
    filling = LinearFilling(1.5e5, 1.0e5)
    rate = linear_fill_rate(filling, pressure, target, dt)
    assert -1.0e5 <= rate <= 1.5e5
    after = pressure + rate * dt
    assert min(pressure, target) - 1e-9 <= after <= max(pressure, target) + 1e-9


@given(PRESSURES, PRESSURES)
def test_a_distributor_goes_towards_its_target(pressure: float, target: float) -> None:
    made = Distributor(0.2, 3.0, 0.38e5, 0.1)
    rate = distributor_rate(made, pressure, target)
    assert rate * (target - pressure) >= 0.0
    assert distributor_rate(made, target, target) == 0.0


@given(st.floats(-10.0, 120.0))
def test_the_dynamic_brake_keeps_its_limits(speed: float) -> None:
    brake = DynamicBrake(30e3, 500e3, 2.8, 1.4)
    force = dynamic_brake_limit(brake, speed)
    assert 0.0 <= force <= 30e3
    assert force * speed <= 500e3 * (1.0 + 1e-12)
    if speed <= 1.4:
        assert force == 0.0


def test_a_dynamic_brake_without_a_fade_is_switched_off_at_once() -> None:
    brake = DynamicBrake(30e3, 500e3, 2.0, 2.0)
    assert dynamic_brake_limit(brake, 2.0) == 0.0
    assert dynamic_brake_limit(brake, 2.001) == 30e3


@given(st.floats(0.0, 100.0))
def test_the_track_brake_weakens_with_speed_and_lets_go(speed: float) -> None:
    brake = TrackBrake(80e3, release_speed=5.0)
    force = track_brake_force(brake, speed)
    assert force == 0.0 if speed <= 5.0 else 0.0 < force < 16e3
    if speed > 5.0:
        assert track_brake_force(brake, speed + 1.0) < force
