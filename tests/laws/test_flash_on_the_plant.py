"""The plant's flash temperature is the formula's, told again from force, load and speeds."""

from __future__ import annotations

import numpy as np
import pytest
from tests.conftest import Shipped

import railgrip as rg
from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    flash_conductance,
    flash_temperature,
    friction_power,
)
from railgrip.core.formulas.patch import hertz_1882


def retold(result: rg.Result, axle: int, row: int) -> float:
    """Flash temperature of one wheel at a moment, from the traces and Hertz's patch."""

    def at(name: str) -> float:
        return float(result[name].values[0, axle, row])

    place = result.scenario.train.axles()[axle]
    train_speed = float(result["train_speed"].values[0, row])
    across = place.axle.tread_radius_transverse or np.inf
    patch = hertz_1882(at("wheel_load") / 2, place.axle.wheel_radius, across, 0.3, 210e9, 0.28)
    power = friction_power(at("wheel_speed"), train_speed, at("contact_force") / 2)
    wheel, rail = (
        flash_conductance(STEEL_ERTZ_2002, patch.a, patch.b, speed)
        for speed in (at("wheel_speed"), train_speed)
    )
    return flash_temperature(wheel, rail, power).rise


@pytest.mark.parametrize(("name", "controller"), [("detergent_160", "conventional"),
                                                  ("leaves_160", "none")])  # fmt: skip
def test_it_is_the_formula_on_the_patch_of_the_moment(
    shipped: Shipped, name: str, controller: str
) -> None:
    """1 % for the load, whose part in the resting heat flow is left out, and the tick's mean."""
    result = rg.simulate(rg.load(name).with_({"wsp.controller": controller}))
    flash = result["flash_temperature"].values[0]
    axle = int(np.unravel_index(np.nanargmax(flash), flash.shape)[0])
    rows = np.flatnonzero(flash[axle] > 0.3 * np.nanmax(flash[axle]))[::7]
    again = np.array([retold(result, axle, row) for row in rows])
    error = again / flash[axle, rows] - 1.0
    assert rows.size >= 30
    assert np.median(np.abs(error)) < 0.01


def test_the_greatest_is_the_greatest_of_the_course(shipped: Shipped) -> None:
    result = rg.simulate(rg.load("detergent_160").with_({"run.trace": 0.01}))
    flash = np.nanmax(result["flash_temperature"].values[0], axis=1)
    assert flash == pytest.approx(result["axle_greatest_flash"].values[0], rel=1e-12)


def test_a_lock_counts_as_fast_above_30_kmh_only(shipped: Shipped) -> None:
    locked = rg.simulate(rg.load("leaves_160").with_({"wsp.controller": "none"}))
    fast, longest = (locked[f"axle_longest_{name}lock"].values[0] for name in ("fast_", ""))
    worst = int(np.argmax(longest))
    speed = locked["train_speed"].values[0]
    ended = float(locked["time"].values[np.flatnonzero(speed > 30 / 3.6)[-1]])
    standing = float(locked["time"].values[np.flatnonzero(speed > 0.3)[-1]])
    assert longest[worst] - fast[worst] == pytest.approx(standing - ended, abs=0.05)
    protected = rg.simulate(rg.load("leaves_160"))
    assert float(protected["axle_longest_fast_lock"].values[0].max()) <= 0.4
