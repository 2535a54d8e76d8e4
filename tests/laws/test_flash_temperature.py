"""What every flash temperature must obey, from a locked wheel to 100 m/s."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    ThermalMaterial,
    flash_conductance,
    flash_temperature,
    friction_power,
)
from railgrip.laboratory.contact_temperature import flux_rises, surface_temperatures
from railgrip.laboratory.sliding_contact import SlidingContact

AXES = st.floats(2e-3, 15e-3)
SPEEDS = st.floats(0.0, 100.0)
POWERS = st.floats(0.0, 1e6)


def conductance(a: float, b: float, speed: float) -> float:
    return flash_conductance(STEEL_ERTZ_2002, a, b, speed)


@given(a=AXES, b=AXES, wheel=SPEEDS, rail=SPEEDS, power=POWERS)
def test_all_heat_goes_somewhere_and_none_is_made(
    a: float, b: float, wheel: float, rail: float, power: float
) -> None:
    """Each body takes its conductance times the common rise: together the friction power."""
    wheels, rails = conductance(a, b, wheel), conductance(a, b, rail)
    flash = flash_temperature(wheels, rails, power)
    assert 0.0 < flash.wheel_share < 1.0
    assert flash.rise * (wheels + rails) == pytest.approx(power, rel=1e-12)
    assert flash.rise * wheels == pytest.approx(flash.wheel_share * power, rel=1e-12)


@given(a=AXES, b=AXES, speed=SPEEDS, faster=st.floats(1.0, 3.0))
def test_a_faster_surface_takes_up_more(a: float, b: float, speed: float, faster: float) -> None:
    assert conductance(a, b, speed * faster) >= conductance(a, b, speed) * (1.0 - 1e-14)


@given(a=AXES, b=AXES, speed=SPEEDS, power=POWERS)
def test_equal_bodies_at_equal_speeds_share_equally(
    a: float, b: float, speed: float, power: float
) -> None:
    same = conductance(a, b, speed)
    assert flash_temperature(same, same, power).wheel_share == 0.5


@given(a=AXES, b=AXES, step=st.floats(1e-12, 1e-6))
def test_a_wheel_that_locks_is_no_special_case(a: float, b: float, step: float) -> None:
    locked, slow = conductance(a, b, 0.0), conductance(a, b, step)
    assert slow == pytest.approx(locked, rel=2e-3)
    assert np.isfinite(locked)
    assert locked > 0.0


@given(wheel=SPEEDS, rail=SPEEDS, force=st.floats(-1e5, 1e5))
def test_friction_power_is_never_negative(wheel: float, rail: float, force: float) -> None:
    assert friction_power(wheel, rail, force) >= 0.0
    assert friction_power(wheel, rail, force) == friction_power(rail, wheel, -force)


@given(
    conductivity=st.floats(20.0, 80.0), a=AXES, b=AXES, speed=st.floats(1.0, 100.0),
    scale=st.floats(0.5, 2.0),
)  # fmt: skip
def test_patch_speed_and_material_scale_together(
    conductivity: float, a: float, b: float, speed: float, scale: float
) -> None:
    """With lengths × s and speed/s the Peclet number stays, so the conductance grows with s."""
    steel = ThermalMaterial(conductivity, 7850.0, 450.0)
    once = flash_conductance(steel, a, b, speed)
    grown = flash_conductance(steel, a * scale, b * scale, speed / scale)
    assert grown == pytest.approx(scale * once, rel=1e-9)


@settings(max_examples=20, deadline=None)
@given(wheel=st.floats(5.0, 60.0), rail=st.floats(5.0, 60.0))
def test_the_heat_over_the_patch_is_the_friction_power(wheel: float, rail: float) -> None:
    contact = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, wheel, rail)
    x = np.linspace(-1.0, 1.0, 401) * contact.a
    y = np.linspace(-1.0, 1.0, 401) * contact.b
    flux = surface_temperatures(contact, x[None, :], y[:, None]).heat_flux
    total = np.trapezoid(np.trapezoid(flux, x, axis=1), y)
    assert total == pytest.approx(contact.power, rel=1e-3)


@settings(max_examples=20, deadline=None)
@given(wheel=st.floats(5.0, 60.0), rail=st.floats(5.0, 60.0))
def test_both_surfaces_are_equally_hot_in_the_patch_and_not_behind_it(
    wheel: float, rail: float
) -> None:
    """1e-3: the shares know the resting part of Greenwood's joint, the strips do not."""
    contact = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, wheel, rail)
    x = np.linspace(-1.5, 1.0, 26) * contact.a
    found = surface_temperatures(contact, x)
    assert found.wheel == pytest.approx(found.rail, rel=1e-3)
    assert (found.wheel[x < -contact.a] == 20.0).all()


def test_any_distribution_gives_hertz_again() -> None:
    contact = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, 30.0, 31.0)
    x = np.linspace(-1.0, 1.0, 2001) * contact.a
    flux = contact.heat_flux * np.sqrt(np.maximum(1.0 - (x / contact.a) ** 2, 0.0))
    wheel, rail = flux_rises(contact, x, flux)
    expected = surface_temperatures(contact, x)
    assert wheel == pytest.approx(expected.wheel - 20.0, abs=2e-3 * expected.wheel.max())
    assert rail == pytest.approx(expected.rail - 20.0, abs=2e-3 * expected.rail.max())
