"""Laws along the resultant, and what an angle of attack and a swinging load do to any curve."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.contact.angle_of_attack import WheelAttitude
from railgrip.contact.carter_1926 import carter_1926
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import (
    Creepage,
    CreepForce,
    RollingContact,
    rolling_contact,
)
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.laboratory.creep_curve import CreepCurve
from railgrip.laboratory.deformed_curve import RELAXATIONS, deformed_curve
from railgrip.laboratory.resultant import RollingLaw, along_the_resultant

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
PLANT_LAWS = [polach_2005, freibauer_1983, shen_hedrick_elkins_1983, carter_1926]
every_plant_law = pytest.mark.parametrize("law", PLANT_LAWS, ids=lambda law: law.__name__)


def rational(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """A law of rolling contact that owes nothing to the plant's: F = F_lin/(1 + |F_lin|/μQ)."""
    stiff = contact.shear_modulus * contact.a * contact.b
    x = stiff * contact.c11 * creepage.longitudinal
    y = stiff * contact.c22 * creepage.lateral
    slip_speed = speed * math.sqrt(creepage.longitudinal**2 + creepage.lateral**2)
    limit = falling_friction(rail, slip_speed) * contact.load
    share = limit / (limit + math.sqrt(x * x + y * y))
    return CreepForce(share * x, share * y, 0.0)


POLACH, SHEN = (along_the_resultant(law) for law in (polach_2005, shen_hedrick_elkins_1983))
ROLLING_LAWS = [rational, POLACH, SHEN]
every_rolling_law = pytest.mark.parametrize("law", ROLLING_LAWS, ids=lambda law: law.__name__)
every_relaxation = pytest.mark.parametrize("relaxation", RELAXATIONS)

SIGNED = st.just(0.0) | st.floats(1e-9, 1.0) | st.floats(-1.0, -1e-9)
CREEPAGES = st.builds(Creepage, SIGNED, SIGNED, SIGNED)
RAILS = st.sampled_from([DRY_POLACH_2005, WET_POLACH_2005, RailFriction(0.05, 0.4, 0.2, 1.0, 0.4)])
SPEEDS = st.floats(0.5, 100.0)
AMPLITUDES = st.floats(0.05, 3.0)
ANGLES = st.floats(5e-4, 0.03)
WAVES = st.floats(-2.5, 1.5).map(lambda power: 10.0**power)
POINTS = np.geomspace(1e-6, 1.0, 241)
NUMERICAL = 1e-4
"""Of the undisturbed peak: what 512 steps of the cycle and the points of the curve leave
(3.6e-5 was met)."""


@every_plant_law
@given(rail=RAILS, speed=SPEEDS, creepage=CREEPAGES)
def test_a_resultant_is_odd_bounded_and_takes_power(
    law: Any, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    rolling = along_the_resultant(law)
    force = rolling(BASE, rail, speed, creepage)
    mirrored = rolling(BASE, rail, speed, Creepage(*(-each for each in creepage)))
    assert [-each for each in mirrored] == list(force)
    slip_speed = speed * math.hypot(creepage.longitudinal, creepage.lateral)
    limit = falling_friction(rail, slip_speed) * BASE.load
    assert math.hypot(force.longitudinal, force.lateral) <= limit * (1.0 + 1e-12)
    assert sum(each * slip for each, slip in zip(force, creepage, strict=True)) >= 0.0


@every_plant_law
@given(rail=RAILS, speed=SPEEDS, creepage=st.floats(1e-9, 1.0))
def test_a_resultant_along_the_track_is_the_law_of_the_plant(
    law: Any, rail: RailFriction, speed: float, creepage: float
) -> None:
    slope = BASE.shear_modulus * BASE.a * BASE.b * BASE.c11
    force = along_the_resultant(law)(BASE, rail, speed, Creepage(creepage, 0.0, 0.0))
    expected = law(rail, BASE.load, slope, creepage * speed, creepage)
    assert force.longitudinal == pytest.approx(expected, rel=1e-12)
    assert force.lateral == 0.0


@every_plant_law
@given(creepage=CREEPAGES)
def test_a_resultant_begins_with_kalkers_linear_theory(law: Any, creepage: Creepage) -> None:
    rail = RailFriction(0.4, 0.5, 0.3, 1.0, 1.0)
    tiny = Creepage(*(1e-8 * each for each in creepage))
    area = BASE.a * BASE.b
    spin_force = BASE.shear_modulus * area**1.5 * BASE.c23
    force = along_the_resultant(law)(BASE, rail, 20.0, tiny)
    linear = (
        BASE.shear_modulus * area * BASE.c11 * tiny.longitudinal,
        BASE.shear_modulus * area * BASE.c22 * tiny.lateral + spin_force * tiny.spin,
        BASE.shear_modulus * area**2 * BASE.c33 * tiny.spin - spin_force * tiny.lateral,
    )
    assert list(force) == pytest.approx(linear, rel=1e-4, abs=1e-12)


def test_spin_alone_pushes_sideways_and_stays_finite() -> None:
    force = POLACH(BASE, DRY_POLACH_2005, 20.0, Creepage(0.0, 0.0, 0.1))
    assert force.longitudinal == 0.0
    assert 0.0 < force.lateral < 0.55 * BASE.load
    still = POLACH(BASE, DRY_POLACH_2005, 20.0, Creepage(0.0, 0.0, 0.0))
    assert list(still) == [0.0, 0.0, 0.0]


def curve(law: RollingLaw, rail: RailFriction, speed: float, **deformed: Any) -> CreepCurve:
    return deformed_curve(law, BASE, rail, speed=speed, creepage=POINTS, **deformed)


@every_rolling_law
@every_relaxation
@given(
    rail=RAILS, speed=SPEEDS, amplitude=AMPLITUDES, wave=WAVES, angle=ANGLES,
    contact_angle=st.floats(0.0, 0.05),
)  # fmt: skip
@settings(max_examples=20)
def test_peak_and_slope_fall_with_either_and_further_with_both(
    law: RollingLaw, relaxation: str, rail: RailFriction, speed: float, amplitude: float,
    wave: float, angle: float, contact_angle: float,
) -> None:  # fmt: skip
    load = {"amplitude": amplitude, "frequency": speed / wave, "relaxation": relaxation}
    yaw = {"attitude": WheelAttitude(angle, contact_angle, 0.46)}
    still = curve(law, rail, speed)
    yawed, bouncing = curve(law, rail, speed, **yaw), curve(law, rail, speed, **load)
    both = curve(law, rail, speed, **yaw, **load)
    slack = NUMERICAL * still.peak.force
    for less, more in (
        (yawed, still), (bouncing, still), (both, yawed), (both, bouncing),
    ):  # fmt: skip
        assert less.initial_slope < more.initial_slope
        assert less.peak.force < more.peak.force + slack
        assert (less.force <= more.force + slack).all()
        assert less.force.min() >= -slack
    limit = [falling_friction(rail, w) * BASE.load for w in still.slip_speed.tolist()]
    assert (both.force <= np.array(limit) + slack).all()


@every_rolling_law
@pytest.mark.parametrize("amplitude", [0.3, 0.8, 1.5])
@pytest.mark.parametrize("wave", [0.02, 0.1, 1.0, math.inf])
@pytest.mark.parametrize("angle", [0.002, 0.01])
@every_relaxation
def test_the_peak_falls_measurably(
    law: RollingLaw, relaxation: str, amplitude: float, wave: float, angle: float
) -> None:
    load = {"amplitude": amplitude, "frequency": 20.0 / wave, "relaxation": relaxation}
    yaw = {"attitude": WheelAttitude(angle, 0.0, 0.46)}
    peaks = [
        curve(law, DRY_POLACH_2005, 20.0, **deformed).peak.force
        for deformed in ({}, yaw, load, {**yaw, **load})
    ]
    assert max(peaks[1:3]) < peaks[0]
    if law is SHEN and math.isinf(wave):
        assert peaks[3] <= min(peaks[1:3]) * (1.0 + 1e-12)
    else:
        assert peaks[3] < min(peaks[1:3])


def test_a_slow_load_takes_nothing_from_a_yawed_wheel_that_slides_all_over() -> None:
    """From f = 3 on Shen's patch slides fully, and its force μQ is linear in the load."""
    yaw = {"attitude": WheelAttitude(0.03, 0.0, 0.46)}
    yawed = curve(SHEN, DRY_POLACH_2005, 20.0, **yaw)
    both = curve(SHEN, DRY_POLACH_2005, 20.0, **yaw, amplitude=0.3)
    assert both.force == pytest.approx(yawed.force, rel=1e-12)


@every_rolling_law
@every_relaxation
def test_more_amplitude_frequency_and_angle_lower_the_curve_further(
    law: RollingLaw, relaxation: str
) -> None:
    ways: list[list[dict[str, Any]]] = [
        [{"amplitude": a, "frequency": 200.0} for a in (0.0, 0.2, 0.5, 0.9, 1.0, 1.3, 2.5)],
        [{"amplitude": 0.6, "frequency": f} for f in (0.0, 20.0, 100.0, 300.0, 1e3, 4e3)],
        [{"attitude": WheelAttitude(a, 0.0, 0.46)} for a in (0.0, 1e-3, 3e-3, 0.01, 0.03)],
    ]
    for way in ways:
        curves = [
            curve(law, DRY_POLACH_2005, 20.0, relaxation=relaxation, **deformed) for deformed in way
        ]
        slack = NUMERICAL * curves[0].peak.force
        for more, less in pairwise(curves):
            assert less.initial_slope < more.initial_slope
            assert less.peak.force < more.peak.force
            assert (less.force <= more.force + slack).all()


@every_rolling_law
@pytest.mark.parametrize("wave", [0.02, 0.1, math.inf])
def test_the_rising_branch_broadens(law: RollingLaw, wave: float) -> None:
    still = curve(law, DRY_POLACH_2005, 20.0)
    half = 0.5 * still.peak.adhesion
    for relaxation in RELAXATIONS:
        load = {"amplitude": 0.8, "frequency": 20.0 / wave, "relaxation": relaxation}
        yaw = {"attitude": WheelAttitude(0.005, 0.0, 0.46)}
        yawed, bouncing = (curve(law, DRY_POLACH_2005, 20.0, **each) for each in (yaw, load))
        both = curve(law, DRY_POLACH_2005, 20.0, **yaw, **load)
        assert still.creepage_at(half) < min(yawed.creepage_at(half), bouncing.creepage_at(half))
        assert both.creepage_at(half) > max(yawed.creepage_at(half), bouncing.creepage_at(half))
        assert yawed.peak.creepage > still.peak.creepage
        if relaxation == "constant_stiffness":
            assert both.peak.creepage > bouncing.peak.creepage > still.peak.creepage


def test_under_a_short_wave_a_constant_length_moves_the_peak_inwards() -> None:
    still = curve(POLACH, DRY_POLACH_2005, 20.0)
    short = curve(POLACH, DRY_POLACH_2005, 20.0, amplitude=0.5, frequency=20.0 / 0.05)
    assert short.peak.creepage < 0.9 * still.peak.creepage


@given(speed=SPEEDS, wave=WAVES, amplitude=AMPLITUDES)
@settings(max_examples=20)
def test_only_the_wavelength_counts_where_friction_is_constant(
    speed: float, wave: float, amplitude: float
) -> None:
    rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    here, there = (
        curve(rational, rail, v, amplitude=amplitude, frequency=v / wave) for v in (speed, 10.0)
    )
    assert here.force == pytest.approx(there.force, rel=1e-9)
