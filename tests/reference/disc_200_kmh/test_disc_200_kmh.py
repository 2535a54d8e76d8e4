"""Energy of one stop into one disc."""

from __future__ import annotations

import math

import pytest

from railgrip.core.formulas.two_node_heat import DiscHeat, two_node_heat_rates

ENERGY = 0.5 * 7000.0 * (200.0 / 3.6) ** 2


def rise_after_a_stop(disc: DiscHeat, film: float) -> tuple[float, float]:
    """Rise of ring and hub after 60 s of linearly falling power."""
    ring = hub = disc.ambient
    steps = 6000
    for step in range(steps):
        power = 2.0 * ENERGY / 60.0 * (1.0 - (step + 0.5) / steps)
        middle = two_node_heat_rates(disc, ring, hub, power, film)
        half = (ring + 0.005 * middle[0], hub + 0.005 * middle[1])
        rates = two_node_heat_rates(disc, *half, power, film)
        ring, hub = ring + 0.01 * rates[0], hub + 0.01 * rates[1]
    return ring - disc.ambient, hub - disc.ambient


def test_the_quoted_bulk_rise() -> None:
    # so great a conductance makes one lump of 125 kg of the two nodes
    disc = DiscHeat(65.0, 60.0, 2e5, 2.0, 0.9, 9.0, 3.0, 0.0, 20.0)
    ring, hub = rise_after_a_stop(disc, film=0.0)
    assert ring == pytest.approx(156.0, rel=0.03)
    by_hand = (-460.0 + math.sqrt(460.0**2 + 0.7 * 0.9 * ENERGY / 125.0)) / 0.35
    assert (65.0 * ring + 60.0 * hub) / 125.0 == pytest.approx(by_hand, rel=1e-5)


def test_the_ring_alone_is_hotter_and_the_air_cools_it() -> None:
    disc = DiscHeat(65.0, 60.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
    ring, hub = rise_after_a_stop(disc, film=0.0)
    cooled, _ = rise_after_a_stop(disc, film=60.0)
    assert ring > 200.0 > hub > 0.0
    assert cooled < ring
