"""The undisturbed curve as a case of the deformed one, and what is refused."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
import pytest

from railgrip.contact.angle_of_attack import WheelAttitude, attack_creepage
from railgrip.contact.dynamic_load import load_share
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.core.errors import RailgripError
from railgrip.laboratory.curve_of_law import curve_of_plant_law
from railgrip.laboratory.deformed_curve import deformed_curve
from railgrip.laboratory.resultant import along_the_resultant

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
LAW = along_the_resultant(polach_2005)
POINTS = np.geomspace(1e-5, 1.0, 51)


def test_undisturbed_it_is_the_curve_of_the_law() -> None:
    slope = BASE.shear_modulus * BASE.a * BASE.b * BASE.c11
    plain = curve_of_plant_law(
        polach_2005, DRY_POLACH_2005, load=BASE.load, slope=slope, speed=20.0, creepage=POINTS
    )
    curve = deformed_curve(LAW, BASE, DRY_POLACH_2005, speed=20.0, creepage=POINTS)
    assert curve.force == pytest.approx(plain.force, rel=1e-12)


def test_a_frequency_without_amplitude_does_nothing() -> None:
    still = deformed_curve(LAW, BASE, DRY_POLACH_2005, speed=20.0, creepage=POINTS)
    hum = deformed_curve(LAW, BASE, DRY_POLACH_2005, speed=20.0, creepage=POINTS, frequency=500.0)
    assert hum.force == pytest.approx(still.force, rel=1e-12)


def test_the_creepages_of_a_yawed_cone() -> None:
    creepage = attack_creepage(WheelAttitude(0.01, 0.025, 0.46), 0.02)
    assert creepage.lateral == pytest.approx(math.sin(0.01), rel=1e-15)
    assert creepage.spin == pytest.approx((0.02 + math.cos(0.01)) * math.sin(0.025) / 0.46)
    assert attack_creepage(WheelAttitude(0.0, 0.3, math.inf), 0.02) == Creepage(0.02, 0.0, 0.0)


@pytest.mark.parametrize("amplitude", [0.0, 0.5, 1.0, 1.001, 2.0, 30.0])
def test_a_wheel_carries_its_load_however_it_bounces(amplitude: float) -> None:
    phases = (np.arange(20000) + 0.5) * (2.0 * math.pi / 20000)
    shares = [load_share(amplitude, phase) for phase in phases.tolist()]
    assert np.mean(shares) == pytest.approx(1.0, abs=1e-7)
    assert min(shares) >= 0.0


def test_laws_are_made_once() -> None:
    assert along_the_resultant(polach_2005) is LAW


def uncompilable(contact: Any, rail: Any, speed: float, creepage: Any) -> Any:
    return {"no": object()}[contact]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"speed": 0.0}, "speed: must be positive"),
        ({"speed": -20.0}, "speed: must be positive and finite; got -20.0 m/s"),
        ({"amplitude": -0.1}, "amplitude: must not be negative and finite; got -0.1"),
        ({"amplitude": math.nan}, "amplitude: must not be negative"),
        ({"frequency": -1.0}, "frequency: must not be negative and finite; got -1.0 Hz"),
        ({"frequency": math.inf}, "frequency: must not be negative and finite; got inf Hz"),
        ({"frequency": 1e6}, "frequency: the wave is shorter than a hundredth of the patch"),
        ({"creepage": []}, "creepage: must have at least one point"),
        ({"steps": 0}, "steps: must be at least 1"),
        ({"relaxation": "constant_lenght"}, "did you mean 'constant_length'"),
        ({"attitude": WheelAttitude(math.nan, 0.0, 0.46)}, "angle_of_attack: must lie between"),
        ({"attitude": WheelAttitude(0.0, 2.0, 0.46)}, "contact_angle: must lie between"),
        ({"attitude": WheelAttitude(0.0, 0.0, 0.0)}, "wheel_radius: must be positive"),
        ({"law": functools.partial(LAW)}, "law: must be a plain Python function"),
        ({"law": uncompilable}, "law: cannot be compiled"),
    ],
)
def test_bad_input_gets_a_sentence(change: dict[str, Any], words: str) -> None:
    case = {"law": LAW, "contact": BASE, "rail": DRY_POLACH_2005, "speed": 20.0, "creepage": POINTS}
    case.update(change)
    with pytest.raises(RailgripError, match=words):
        deformed_curve(case.pop("law"), case.pop("contact"), case.pop("rail"), **case)
