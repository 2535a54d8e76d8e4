"""The laden wagon stops where the measured one did."""

from __future__ import annotations

import pytest
from tests.conftest import Shipped

MEASURED = 596.0


def test_the_measured_stop(shipped: Shipped) -> None:
    """Within 5 % of 596 m, a single measurement."""
    found = float(shipped("wagon_100")["stopping_distance"].values[0])
    assert found == pytest.approx(MEASURED, rel=0.05)
