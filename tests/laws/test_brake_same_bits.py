"""One law, plain or compiled for many lanes: the same bits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import pytest

from railgrip.brake.constant_friction import ConstantFriction, constant_friction
from railgrip.brake.dynamic_brake import DynamicBrake, dynamic_brake_limit
from railgrip.brake.filling import Distributor, distributor_rate
from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950
from railgrip.brake.orifice import orifice_flow
from railgrip.brake.piecewise_friction import PiecewiseFriction, piecewise_friction
from railgrip.brake.rigging import Rigging, clamp_force, hysteresis
from railgrip.brake.track_brake import TrackBrake, track_brake_force
from railgrip.compiler import inlined
from railgrip.core.formulas.piecewise_linear import hinges_from_points
from railgrip.core.formulas.two_node_heat import DiscHeat, two_node_heat_rates

FLAT = hinges_from_points([(25e3, 1.0)])
FADE = hinges_from_points([(150.0, 1.0), (350.0, 0.8)])
SPEED = hinges_from_points([(0.0, 1.08), (10.0, 1.0), (15.0, 1.0), (55.0, 0.88)])
DISC = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
CASES: list[tuple[Callable[..., Any], Any, tuple[float, ...]]] = [
    (constant_friction, ConstantFriction(0.35), (6e4, 60.0, 500.0)),
    (karwatzki_1950, KarwatzkiParameters(), (6e4, 60.0, 500.0)),
    (piecewise_friction, PiecewiseFriction(0.37, FADE, SPEED, FLAT), (6e4, 60.0, 500.0)),
    (clamp_force, Rigging(346e-4, 0.95, -300.0, 5.0, 0.95, -500.0, 1.0), (4e5,)),
    (dynamic_brake_limit, DynamicBrake(30e3, 500e3, 2.8, 1.4), (60.0,)),
    (track_brake_force, TrackBrake(80e3, release_speed=5.0), (60.0,)),
    (distributor_rate, Distributor(0.2, 3.0, 0.38e5, 0.1), (4e5, 4e5)),
    (two_node_heat_rates, DISC, (500.0, 300.0, 3e5, 90.0)),
    (orifice_flow, None, (7e5, 7e5)),
    (hysteresis, None, (6e4, 6e4, 0.1)),
]


@pytest.mark.parametrize(
    ("law", "params", "highs"), [pytest.param(*case, id=case[0].__name__) for case in CASES]
)
def test_plain_and_compiled_agree(
    law: Callable[..., Any], params: Any, highs: tuple[float, ...]
) -> None:
    compiled = inlined(law)
    fixed = () if params is None else (params,)
    driver = numba.njit(error_model="numpy")(lambda *inputs: compiled(*inputs))
    generator = np.random.default_rng(1950)
    points = generator.uniform(0.0, highs, (500, len(highs))).tolist()
    points += [[0.0] * len(highs), list(highs)]
    found = [driver(*fixed, *point) for point in points]
    assert np.array(found).tobytes() == np.array([law(*fixed, *p) for p in points]).tobytes()
