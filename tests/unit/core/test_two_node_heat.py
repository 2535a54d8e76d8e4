"""Heat of a disc: equilibrium, conservation, signs."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.core.formulas.two_node_heat import (
    DiscHeat,
    film_coefficient,
    heat_capacity,
    two_node_heat_rates,
)

DISC = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
SEALED = DISC._replace(surface=0.0)
TEMPERATURES = st.floats(-20.0, 700.0)


def test_a_cold_disc_stays_cold() -> None:
    assert two_node_heat_rates(DISC, 20.0, 20.0, 0.0, 50.0) == (0.0, 0.0)


@given(TEMPERATURES, TEMPERATURES, st.floats(0.0, 1e6))
def test_without_surface_the_heat_of_both_nodes_is_the_share_of_the_power(
    ring: float, hub: float, power: float
) -> None:
    ring_rate, hub_rate = two_node_heat_rates(SEALED, ring, hub, power, 50.0)
    stored = 65.0 * heat_capacity(ring) * ring_rate + 55.0 * heat_capacity(hub) * hub_rate
    assert stored == pytest.approx(0.9 * power, rel=1e-9, abs=1e-6)


@given(st.floats(21.0, 700.0), st.floats(0.0, 200.0))
def test_a_hot_ring_cools_and_wind_helps(temperature: float, film: float) -> None:
    still, _ = two_node_heat_rates(DISC, temperature, temperature, 0.0, film)
    windy, _ = two_node_heat_rates(DISC, temperature, temperature, 0.0, film + 10.0)
    assert windy < still < 0.0


def test_radiation_of_a_black_plate_at_500_kelvin() -> None:
    # 5.670374e-8 · (500⁴ − 293.15⁴) = 3125.2 W/m², from one square metre and 100 kg
    disc = DiscHeat(100.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 20.0)
    rate, _ = two_node_heat_rates(disc, 226.85, 20.0, 0.0, 0.0)
    assert rate * 100.0 * (460.0 + 0.35 * 206.85) == pytest.approx(-3125.2, abs=0.1)


def test_the_film_grows_with_the_speed() -> None:
    assert film_coefficient(9.0, 3.0, 0.0) == 9.0
    assert film_coefficient(9.0, 3.0, 40.0) == pytest.approx(9.0 + 3.0 * 40.0**0.8, rel=1e-6)
