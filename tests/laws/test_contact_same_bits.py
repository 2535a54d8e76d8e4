"""One law, plain or compiled for many lanes: the same bits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba
import numpy as np
import pytest

from railgrip.compiler import inlined
from railgrip.contact.carter_1926 import carter_1926
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.core.formulas.elementary import arctangent, exp_decay, power_0_8

COUNT = 4096


@pytest.mark.parametrize("function", [arctangent, exp_decay, power_0_8])
def test_elementary_functions(function: Callable[[float], float]) -> None:
    compiled = inlined(function)

    @numba.njit(error_model="numpy")
    def over_lanes(x: Any, out: Any) -> None:
        for k in range(x.size):
            out[k] = compiled(x[k])

    generator = np.random.default_rng(2005)
    x = generator.uniform(0.0, 1.0, COUNT) ** 4 * 120.0
    out = np.empty(COUNT)
    over_lanes(x, out)
    assert out.tobytes() == np.array([function(each) for each in x.tolist()]).tobytes()


@pytest.mark.parametrize(
    "law", [polach_2005, freibauer_1983, shen_hedrick_elkins_1983, carter_1926]
)
def test_creep_laws(law: Callable[..., float]) -> None:
    compiled = inlined(law)

    @numba.njit(error_model="numpy")
    def over_lanes(rail: Any, load: Any, slope: Any, slip: Any, creepage: Any, out: Any) -> None:
        for k in range(load.size):
            state = RailFriction(rail[k, 0], rail[k, 1], rail[k, 2], rail[k, 3], rail[k, 4])
            out[k] = compiled(state, load[k], slope[k], slip[k], creepage[k])

    generator = np.random.default_rng(2005)
    rail = generator.uniform(0.0, 1.0, (COUNT, 5))
    rail[::64, 0] = 0.0
    columns = [generator.uniform(0.0, high, COUNT) for high in (1e5, 3e7, 30.0, 0.1)]
    columns[0][::50] = 0.0
    out = np.empty(COUNT)
    over_lanes(rail, *columns, out)
    plain = [
        law(RailFriction(*state), *point)
        for state, point in zip(rail.tolist(), np.column_stack(columns).tolist(), strict=True)
    ]
    assert out.tobytes() == np.array(plain).tobytes()
