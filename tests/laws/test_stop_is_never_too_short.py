"""On level rail without resistance no stop beats the adhesion: v²/(2 τ g).

The train's mass M is pushed by the contact forces only, each at most τ times its wheel load, and
the loads sum to M g: so the deceleration is at most τ g, whatever wheels, brakes and protection do.
Tolerance 1e-9: the bound is exact, whole numbers of steps or not.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tests.conftest import Coach

import railgrip as rg
from railgrip.core import registry
from railgrip.core.constants import GRAVITY


def shortest(speed: float, adhesion: float) -> float:
    return speed**2 / (2 * adhesion * GRAVITY)


def stop(coach: Coach, adhesion: float, speed: float, **more: object) -> float:
    scenario = coach(adhesion, speed=speed, **more)
    found = rg.simulate(scenario, traces=False)["stopping_distance"].values[0]
    assert found >= shortest(speed, adhesion) * (1 - 1e-9)
    return float(found)


@settings(max_examples=25)
@given(
    adhesion=st.floats(0.02, 0.5),
    speed=st.floats(10.0, 70.0),
    controller=st.sampled_from(["none", "conventional"]),
    height=st.floats(0.8, 2.5),
    ratio=st.floats(2.0, 12.0),
)
def test_never_shorter_than_the_adhesion_allows(
    coach: Coach, adhesion: float, speed: float, controller: str, height: float, ratio: float
) -> None:
    stop(
        coach, adhesion, speed, controller=controller, start=0.0, length=400e3, time_limit=3000.0,
        brake={"rigging_ratio": ratio, "fill_time": 0.05},
        train={"vehicle": [tall(height)]},
    )  # fmt: skip


def tall(height: float) -> dict[str, object]:
    """A vehicle whose load shifts more in braking the higher its body sits."""
    axle = {"count": 2, "rotating_mass": 800.0, "wheel_radius": 0.45, "brake": "disc"}
    bogie = {"count": 2, "wheelbase": 2.5, "mass": 6e3, "axle": [axle]}
    return {
        "length": 26.0, "tare": 44e3, "pivot_distance": 19.0, "body_height": height,
        "bogie": [bogie],
    }  # fmt: skip


@pytest.mark.parametrize("creep_law", registry.names("railgrip.laws"))
def test_by_every_creep_law(coach: Coach, creep_law: str) -> None:
    stop(coach, 0.08, 40.0, creep_law=creep_law)


def test_locked_wheels_on_constant_friction_come_close(coach: Coach) -> None:
    """Locked at once, friction not falling: within 2 % of 1 007 m (0.1, 160 km/h).

    The rest is the time to fill and to lock, and the wheels' own energy. A bound that no run
    came near would prove nothing.
    """
    found = stop(coach, 0.1, 160 / 3.6, brake={"fill_time": 0.05})
    assert found == pytest.approx(1007.0, rel=0.02)


def test_the_bound_is_reached_in_every_moment(coach: Coach) -> None:
    """Locked wheels: the deceleration is τ g within 1e-3, and never more than τ g."""
    result = rg.simulate(coach(0.1, speed=40.0, brake={"fill_time": 0.05}))
    locked = (result["wheel_speed"].values[0] == 0.0).all(axis=0)
    moving = result["train_speed"].values[0] > 1.0
    deceleration = -result["acceleration"].values[0][locked & moving][1:]
    assert deceleration.max() <= 0.1 * GRAVITY * (1 + 1e-9)
    assert np.median(deceleration) == pytest.approx(0.1 * GRAVITY, rel=1e-3)
