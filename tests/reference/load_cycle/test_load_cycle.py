"""The mean force under a swinging load, against limits in closed form and other integrations."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp
from scipy.special import gamma, hyp2f1

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import rolling_contact
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.laboratory.deformed_curve import deformed_curve
from railgrip.laboratory.resultant import along_the_resultant

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
SLOPE = BASE.shear_modulus * BASE.a * BASE.b * BASE.c11
LENGTH = 8.0 * BASE.a / (3.0 * math.pi)
SPEED = 20.0
EVEN = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
POLACH = along_the_resultant(polach_2005)
SHEN = along_the_resultant(shen_hedrick_elkins_1983)


def mean_power(amplitude: float, power: float) -> float:
    """⟨(1 + A sin θ)^p⟩ over a cycle."""
    return float(hyp2f1(-0.5 * power, 0.5 * (1.0 - power), 1.0, amplitude**2))


def slope_ratio(amplitude: float, frequency: float) -> float:
    creepage = [1e-8, 2e-8]
    case = {"speed": SPEED, "creepage": creepage}
    still = deformed_curve(SHEN, BASE, EVEN, **case).initial_slope
    swung = deformed_curve(SHEN, BASE, EVEN, **case, amplitude=amplitude, frequency=frequency)
    return swung.initial_slope / still


def sliding_ratio(
    amplitude: float, wavelength: float, relaxation: str = "constant_length"
) -> float:
    curve = deformed_curve(
        SHEN, BASE, EVEN, speed=SPEED, creepage=[0.05, 1.0],
        amplitude=amplitude, frequency=SPEED / wavelength, relaxation=relaxation,
    )  # fmt: skip
    return float(curve.adhesion[-1] / EVEN.static_friction)


def steady(share: float, creepage: float) -> float:
    return polach_2005(
        DRY_POLACH_2005, share * BASE.load, share ** (2 / 3) * SLOPE, creepage * SPEED, creepage
    )


@pytest.mark.parametrize(("amplitude", "tolerance"), [(0.3, 1e-6), (0.8, 1e-6), (2.0, 3e-5)])
@pytest.mark.parametrize("creepage", [1e-4, 3e-3, 0.03])
def test_a_slow_load_gives_the_mean_of_the_steady_forces(
    amplitude: float, tolerance: float, creepage: float
) -> None:
    def load(phase: float) -> float:
        return max(0.0, 1.0 + amplitude * math.sin(phase))

    edge = math.asin(min(1.0, 1.0 / amplitude))
    span = (-edge, math.pi + edge)
    mean_load = quad(load, *span, epsabs=1e-12)[0] / (2.0 * math.pi)
    expected = quad(lambda phase: steady(load(phase) / mean_load, creepage), *span, epsrel=1e-11)
    curve = deformed_curve(
        POLACH, BASE, DRY_POLACH_2005, speed=SPEED, creepage=[creepage], amplitude=amplitude
    )
    assert curve.force[0] == pytest.approx(expected[0] / (2.0 * math.pi), rel=tolerance)


@pytest.mark.parametrize("amplitude", [0.1, 0.5, 0.9, 1.0])
def test_the_slope_under_a_slow_load(amplitude: float) -> None:
    assert slope_ratio(amplitude, 0.0) == pytest.approx(mean_power(amplitude, 2 / 3), rel=1e-6)


def test_the_slope_under_a_slow_load_that_just_lifts_the_wheel() -> None:
    closed = 2 ** (2 / 3) * gamma(7 / 6) / (math.sqrt(math.pi) * gamma(5 / 3))
    assert slope_ratio(1.0, 0.0) == pytest.approx(closed, rel=1e-6)
    assert closed == pytest.approx(0.92037, abs=1e-5)


@pytest.mark.parametrize("amplitude", [0.1, 0.5, 0.8])
def test_the_slope_under_a_fast_load(amplitude: float) -> None:
    frozen = mean_power(amplitude, 1 / 3) / mean_power(amplitude, -1 / 3)
    assert slope_ratio(amplitude, 99.0 * SPEED / BASE.a) == pytest.approx(frozen, rel=1e-4)


@pytest.mark.parametrize("amplitude", [0.2, 0.5, 0.9])
def test_a_fast_load_leaves_a_sliding_wheel_the_least_load(amplitude: float) -> None:
    assert sliding_ratio(amplitude, 0.0101 * BASE.a) == pytest.approx(1.0 - amplitude, abs=0.01)


@pytest.mark.parametrize("amplitude", [0.2, 0.5, 0.9])
def test_what_a_sliding_wheel_loses_to_a_long_wave(amplitude: float) -> None:
    rise = 0.75 * ((1.0 + amplitude) ** (4 / 3) - (1.0 - amplitude) ** (4 / 3))
    lost = 1.0 - sliding_ratio(amplitude, 500.0 * LENGTH)
    assert lost == pytest.approx(rise / 500.0, rel=0.02)


@pytest.mark.parametrize("wavelength", [0.02, 0.1, 1.0])
def test_a_sliding_spring_loses_nothing(wavelength: float) -> None:
    assert sliding_ratio(0.5, wavelength, "constant_stiffness") == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("wavelength", [0.01, 0.05, 0.3])
def test_without_sliding_against_runge_and_kutta(wavelength: float) -> None:
    creepage, amplitude = 5e-4, 0.5

    def change(x: float, force: np.ndarray) -> np.ndarray:
        share = 1.0 + amplitude * math.sin(2.0 * math.pi * x / wavelength)
        return (steady(share, creepage) - force) / (LENGTH * share ** (1 / 3))

    # with its integral as a second unknown
    def both(x: float, state: np.ndarray) -> list[float]:
        return [float(change(x, state[0])), float(state[0])]

    settled = wavelength * math.ceil(40.0 * LENGTH / wavelength)
    start = solve_ivp(both, (0.0, settled), [0.0, 0.0], rtol=1e-10, atol=1e-8).y[0, -1]
    cycle = solve_ivp(
        both, (settled, settled + wavelength), [start, 0.0], rtol=1e-10, atol=1e-8
    ).y[:, -1]  # fmt: skip
    assert cycle[0] == pytest.approx(start, rel=1e-8)
    curve = deformed_curve(
        POLACH, BASE, DRY_POLACH_2005, speed=SPEED, creepage=[creepage],
        amplitude=amplitude, frequency=SPEED / wavelength,
    )  # fmt: skip
    assert curve.force[0] == pytest.approx(cycle[1] / wavelength, rel=1e-5)


def explicit_mean(creepage: float, amplitude: float, length_at: Callable[..., np.ndarray]) -> float:
    """Mean of the second of two cycles in tiny steps along a wave of 0.05 m, as (1,) arrays."""
    count, wavelength = 200_000, 0.05
    shares = 1.0 + amplitude * np.sin(2.0 * math.pi * np.arange(count) / count)
    forces = np.array([steady(share, creepage) for share in shares.tolist()])
    limits = shares * BASE.load * falling_friction(DRY_POLACH_2005, creepage * SPEED)
    rates = (wavelength / count / length_at(shares, forces, creepage)).tolist()
    force, total = 0.0, 0.0
    for _ in range(12):
        total = 0.0
        for goal, limit, rate in zip(forces.tolist(), limits.tolist(), rates, strict=True):
            force = min(force + rate * (goal - force), limit)
            total += force
    return total / count


def constant_length(shares: np.ndarray, forces: np.ndarray, creepage: float) -> np.ndarray:
    return LENGTH * np.cbrt(shares)


def constant_stiffness(shares: np.ndarray, forces: np.ndarray, creepage: float) -> np.ndarray:
    own_share = 0.5 * (DRY_POLACH_2005.adhesion_reduction + DRY_POLACH_2005.slip_reduction)
    chord = forces / (creepage * SLOPE * own_share * shares ** (2 / 3))
    return LENGTH * np.cbrt(shares) * chord


@pytest.mark.parametrize("creepage", [4e-3, 0.03])
@pytest.mark.parametrize("length_at", [constant_length, constant_stiffness])
def test_with_sliding_against_tiny_explicit_steps(
    creepage: float, length_at: Callable[..., np.ndarray]
) -> None:
    curve = deformed_curve(
        POLACH, BASE, DRY_POLACH_2005, speed=SPEED, creepage=[creepage],
        amplitude=0.8, frequency=SPEED / 0.05, relaxation=length_at.__name__,
    )  # fmt: skip
    expected = explicit_mean(creepage, 0.8, length_at)
    assert curve.force[0] == pytest.approx(expected, rel=2e-5)
