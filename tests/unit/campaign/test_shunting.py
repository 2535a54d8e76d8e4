from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from railgrip.campaign.shunting import WAGONS, ShuntingTrain, shunting_stops
from railgrip.core.errors import RailgripError

STEADY = ShuntingTrain(pressure_spread=0, efficiency_spread=0, friction_spread=0,
                       fill_time_spread=0, mass_spread=0)  # fmt: skip


def test_one_stop_is_that_of_an_adaptive_integrator() -> None:
    """Against scipy's DOP853 at 1e-10, written from the formulas: 1e-5 at the default step."""
    t = STEADY
    clamp = (t.pressure * t.cylinder_area + t.cylinder_spring) * t.rigging_ratio
    clamp = (clamp * t.rigging_efficiency + t.rigging_spring) / t.blocks / 1e3
    mass = t.locomotive_mass + WAGONS * (t.wagon_mass + t.rotating_mass)

    def rates(time: float, state: list[float]) -> list[float]:
        kmh, force = max(state[1], 0.0) * 3.6, WAGONS * t.resistance
        for w in range(WAGONS):
            arrives = t.dead_time + (w + 1.5) * t.wagon_length / t.wave_speed
            f = clamp * min(max((time - arrives) / t.fill_time, 0.0), 1.0)
            friction = t.friction * (f + 200) / (f + 50) * (kmh + 150) / (kmh + 75)
            force += friction * f * 1e3 * t.blocks
        return [state[1], -force / mass]

    def stands(_time: float, state: list[float]) -> float:
        return state[1]

    stands.terminal = True  # type: ignore[attr-defined]
    exact = solve_ivp(rates, (0, 60), [0.0, t.speed], method="DOP853", events=stands,
                      rtol=1e-10, atol=1e-10, max_step=0.05)  # fmt: skip
    assert shunting_stops(1, train=t)[0] == pytest.approx(exact.y[0, -1], rel=1e-5)


def test_a_run_is_the_same_in_any_batch_and_on_any_threads() -> None:
    all_of_them = shunting_stops(20_000, threads=2)
    assert np.array_equal(all_of_them, shunting_stops(20_000))
    assert np.array_equal(all_of_them[12_345:12_377], shunting_stops(32, first=12_345))


def test_spreads_show() -> None:
    distance = shunting_stops(4_000)
    assert distance.mean() == pytest.approx(shunting_stops(1, train=STEADY)[0], rel=2e-3)
    assert 0.01 < distance.std() / distance.mean() < 0.06


@pytest.mark.parametrize("wrong", [{"runs": 0}, {"runs": 1, "threads": 0}, {"runs": 1, "step": 5}])
def test_bad_input(wrong: dict[str, int]) -> None:
    with pytest.raises(RailgripError, match="must"):
        shunting_stops(**wrong)  # type: ignore[arg-type]
