"""The source's linear rise, and the speed at which it is the physical one."""

from __future__ import annotations

import math

import pytest

from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, effusivity
from railgrip.core.formulas.linear_temperature_rise import linear_factor, linear_rise

BETA = effusivity(STEEL_ERTZ_2002)
LENGTH, AREA = 12e-3, 12e-3 * 20e-3


def physical(power: float, time: float) -> float:
    """A half-space under a constant flux, half of the heat into each body."""
    return 2.0 * 0.5 * power / AREA * math.sqrt(time / math.pi) / BETA


def test_matched_at_one_speed_it_is_the_physical_rise_there() -> None:
    time = LENGTH / 20.0
    factor = linear_factor(0.5, BETA, time)
    assert linear_rise(factor, 20e3, AREA, time) == pytest.approx(physical(20e3, time), rel=1e-12)


@pytest.mark.parametrize("speed", [5.0, 20.0, 45.0])
def test_elsewhere_it_is_wrong_by_the_root_of_the_speed(speed: float) -> None:
    factor = linear_factor(0.5, BETA, LENGTH / 20.0)
    linear = linear_rise(factor, 20e3, AREA, LENGTH / speed)
    assert linear / physical(20e3, LENGTH / speed) == pytest.approx(math.sqrt(20.0 / speed))
