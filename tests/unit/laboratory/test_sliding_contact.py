"""A sliding contact: its power and flux, and the sentence for a number that cannot be."""

from __future__ import annotations

import math
from typing import Any

import pytest

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
from railgrip.laboratory.sliding_contact import SlidingContact

GIVEN: dict[str, Any] = {
    "load": 100e3, "a": 5.88e-3, "b": 10.54e-3, "friction": 0.3, "wheel_speed": 29.5,
    "train_speed": 30.5,
}  # fmt: skip


def test_power_and_flux_follow_from_load_friction_and_slip() -> None:
    contact = SlidingContact(**GIVEN)
    assert contact.power == pytest.approx(30e3)
    # an ellipsoid over the patch: two thirds of the height times the area
    volume = 2.0 / 3.0 * contact.heat_flux * math.pi * contact.a * contact.b
    assert volume == pytest.approx(contact.power)


def test_braking_and_driving_by_as_much_heat_as_much() -> None:
    braking = SlidingContact(**GIVEN)
    driving = SlidingContact(**(GIVEN | {"wheel_speed": 30.5, "train_speed": 29.5}))
    assert driving.flash().rise == pytest.approx(braking.flash().rise, rel=1e-12)
    assert driving.flash().wheel_share == pytest.approx(1.0 - braking.flash().wheel_share)


def test_a_contact_at_rest_has_no_heat_and_no_trouble() -> None:
    still = SlidingContact(**(GIVEN | {"wheel_speed": 0, "train_speed": 0}))
    assert still.flash().rise == 0.0
    assert still.touch_temperature() == 20.0


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"load": 0.0}, "load: must be positive and finite; got 0 N"),
        ({"load": -1e3}, "load: must be positive and finite; got -1000 N"),
        ({"load": "heavy"}, "the load must be a number"),
        ({"a": math.nan}, "a: must be positive and finite; got nan m"),
        ({"friction": -0.1}, "friction: must be zero or more, and finite; got -0.1"),
        ({"wheel_speed": -1.0}, "wheel_speed: must be zero or more, and finite; got -1 m/s"),
        ({"train_speed": [1.0, 2.0]}, "train_speed: must be one number"),
        ({"rail_temperature": math.inf}, "rail_temperature: must be a finite number; got inf °C"),
        ({"rail": STEEL_ERTZ_2002._replace(conductivity=0.0)}, "the conductivity must be"),
    ],
)  # fmt: skip
def test_what_cannot_be_gets_a_sentence(changes: dict[str, Any], says: str) -> None:
    with pytest.raises(RailgripError) as caught:
        SlidingContact(**(GIVEN | changes))
    assert says in str(caught.value)
