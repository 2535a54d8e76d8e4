"""The whole wheel: energy, the closed form of one node, and what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.core.formulas.wheel_heat import ILLUSTRATIVE_WHEEL
from railgrip.laboratory.wheel_bulk import wheel_bulk

TIME = np.linspace(0.0, 60.0, 61)


def test_energy_is_kept_to_rounding_at_any_step() -> None:
    for n in (3, 61):
        time = np.linspace(0.0, 60.0, n)
        course = wheel_bulk(
            ILLUSTRATIVE_WHEEL, time, contact_heat=20e3 * np.exp(-time / 20.0),
            tread_brake_heat=5e3, chill=82.0, film=40.0, start=(60.0, 30.0),
        )  # fmt: skip
        came = course.from_contact + course.from_tread_brake
        assert abs(course.imbalance) < 1e-9 * came
        assert course.to_rail > 0.0
        assert course.to_air > 0.0


def test_one_node_cools_as_an_exponential() -> None:
    """Without web and air the rim follows exp(−G t/(m c))."""
    alone = ILLUSTRATIVE_WHEEL._replace(conductance=0.0)
    course = wheel_bulk(alone, np.linspace(0.0, 600.0, 601), chill=82.0, start=120.0)
    rate = 82.0 / (alone.rim_mass * alone.specific_heat)
    expected = 20.0 + 100.0 * math.exp(-rate * 600.0)
    assert course.rim[-1] == pytest.approx(expected, rel=1e-6)
    assert course.web[-1] == 120.0


def test_the_step_is_of_second_order() -> None:
    def end(n: int) -> float:
        time = np.linspace(0.0, 600.0, n + 1)
        return float(wheel_bulk(ILLUSTRATIVE_WHEEL, time, contact_heat=15e3, chill=82.0).rim[-1])

    exact = end(4096)
    assert abs(end(16) - exact) / abs(end(32) - exact) == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"time": [0.0, 0.0]}, "time: the time must rise"),
        ({"contact_heat": -1.0}, "contact_heat: must be zero or more"),
        ({"chill": [1.0, 2.0]}, "chill: one value for each time"),
        ({"film": math.nan}, "film: must be zero or more"),
        ({"wheel": ILLUSTRATIVE_WHEEL._replace(rim_mass=0.0)}, "wheel.rim_mass: must be positive"),
    ],
)
def test_bad_numbers_get_a_sentence(changes: dict[str, Any], says: str) -> None:
    given: dict[str, Any] = {"wheel": ILLUSTRATIVE_WHEEL, "time": TIME, **changes}
    with pytest.raises(RailgripError) as caught:
        wheel_bulk(given.pop("wheel"), given.pop("time"), **given)
    assert says in str(caught.value)
