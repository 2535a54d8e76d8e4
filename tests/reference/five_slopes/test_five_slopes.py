"""The five slopes of Čáp's comparison, recomputed."""

from __future__ import annotations

import pytest

from railgrip.contact.cap_2000 import cap_2000_simple_slope, cap_2000_slope
from railgrip.contact.carter_slope import carter_1926_slope
from railgrip.contact.kalker_slope import kalker_1967_simple_slope, kalker_1967_slope
from railgrip.contact.surface_stiffness import SURFACE_STIFFNESS, stiffness_slope
from railgrip.scenario.contact_pair import contact_of_pair

LOAD, WHEEL, HEAD = 100e3, 0.5, 0.3


def test_the_slopes_evaluated_elsewhere() -> None:
    contact = contact_of_pair("cap_2000", LOAD)
    a, b = contact.a, contact.b
    assert cap_2000_slope(LOAD, WHEEL, HEAD) == pytest.approx(16605e3, rel=1e-6)
    assert cap_2000_simple_slope(LOAD, WHEEL) == pytest.approx(16650e3, rel=1e-6)
    assert carter_1926_slope(LOAD, WHEEL) == pytest.approx(10323.76e3, rel=1e-6)
    assert kalker_1967_slope(a, b, 210e9) == pytest.approx(15062.80e3, rel=1e-6)
    assert kalker_1967_simple_slope(LOAD) == pytest.approx(16244.44e3, rel=1e-6)
    assert stiffness_slope(a, b, SURFACE_STIFFNESS) == pytest.approx(15744.6e3, rel=1e-5)
