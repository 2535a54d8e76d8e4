"""A hot wheel on a cold rail: where they meet, how they part, and what the rail takes."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import solve_banded

from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002
from railgrip.core.formulas.rail_chill import (
    ELLIPSE_CHILL,
    chill_conductance,
    contact_temperature,
    touch_conductance,
)
from railgrip.laboratory.contact_temperature import surface_temperatures
from railgrip.laboratory.sliding_contact import SlidingContact

A, B, SPEED = 5.88e-3, 10.54e-3, 30.0


def rolling(wheel: float = 150.0, rail: float = 0.0) -> SlidingContact:
    return SlidingContact(100e3, A, B, 0.0, SPEED, SPEED, wheel, rail)


def test_the_rail_takes_82_watts_per_kelvin() -> None:
    touch = touch_conductance(STEEL_ERTZ_2002, A, B, SPEED)
    assert pytest.approx(1.748038, abs=1e-6) == ELLIPSE_CHILL
    assert chill_conductance(touch, touch) == pytest.approx(82.1, rel=1e-3)


def test_equal_steels_meet_in_the_middle() -> None:
    assert rolling().touch_temperature() == pytest.approx(75.0)
    assert contact_temperature(3.0, 1.0, 100.0, 0.0) == pytest.approx(75.0)
    inside = surface_temperatures(rolling(), np.linspace(-0.9, 0.9, 7) * A)
    assert inside.wheel == pytest.approx(75.0)
    assert inside.rail == pytest.approx(75.0)


def test_both_return_as_ertz_writes() -> None:
    behind = np.array([1.5, 3.0, 10.0]) * A
    found = surface_temperatures(rolling(), behind)
    share = 2.0 / np.pi * np.arcsin(np.sqrt(2.0 * A / (A + behind)))
    assert found.rail == pytest.approx(75.0 * share, rel=1e-9)
    assert found.wheel == pytest.approx(150.0 - 75.0 * share, rel=1e-9)


def marched(touching: float, after: float) -> float:
    """Surface of the rail by implicit finite volumes in depth: touched, then insulated."""
    steel = STEEL_ERTZ_2002
    diffusivity = steel.conductivity / (steel.density * steel.specific_heat)
    depth = 40.0 * np.sqrt(diffusivity * (touching + after))
    edges = depth * np.linspace(0.0, 1.0, 4001) ** 3
    size, centre = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    between = 1.0 / np.diff(centre)

    def step(t: np.ndarray, dt: float, held: float | None) -> np.ndarray:
        rate = diffusivity * dt
        lower, upper = rate * between / size[1:], rate * between / size[:-1]
        diagonal = np.ones(size.size)
        diagonal[1:] += lower
        diagonal[:-1] += upper
        right = t.copy()
        if held is not None:
            surface = rate / (centre[0] * size[0])
            diagonal[0] += surface
            right[0] += surface * held
        bands = np.zeros((3, size.size))
        bands[0, 1:], bands[1], bands[2, :-1] = -upper, diagonal, -lower
        return np.asarray(solve_banded((1, 1), bands, right))

    t = np.zeros(size.size)
    for _ in range(400):
        t = step(t, touching / 400, 75.0)
    for _ in range(400):
        t = step(t, after / 400, None)
    return float(t[0])


@pytest.mark.parametrize("lengths", [1.0, 4.0])
def test_the_return_agrees_with_two_half_spaces_marched_in_time(lengths: float) -> None:
    touching = 2.0 * A / SPEED
    found = surface_temperatures(rolling(), A + lengths * 2.0 * A).rail
    assert marched(touching, lengths * touching) == pytest.approx(float(found), abs=0.005 * 75.0)
