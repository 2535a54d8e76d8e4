"""The block of the wagon, by hand."""

from __future__ import annotations

import pytest

from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950


@pytest.mark.parametrize(
    ("force_kn", "speed_kmh", "friction"),
    [(0.0, 0.0, 0.44), (20.0, 100.0, 121.0 / 490.0), (40.0, 150.0, 44.0 / 225.0)],
)
def test_the_friction_of_the_wagons_block(
    force_kn: float, speed_kmh: float, friction: float
) -> None:
    found = karwatzki_1950(KarwatzkiParameters(), force_kn * 1e3, speed_kmh / 3.6, 20.0)
    assert found == pytest.approx(friction, rel=1e-12)
