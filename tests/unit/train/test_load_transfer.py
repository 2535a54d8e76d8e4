"""Load transfer: moments about the rail, nothing gained or lost, whatever the vehicle."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from railgrip.train.load_transfer import load_transfer

HEIGHT = st.floats(0.3, 2.5)
MASS = st.floats(1e3, 60e3)


def two_bogies(
    body: float, height: float, bogie: float, bogie_height: float, traction: float,
    pivots: float, base: float,
) -> list[list[float]]:  # fmt: skip
    axles = (base / 2, -base / 2)
    return load_transfer(
        (5.0, 5.0 + pivots), (bogie, bogie), (bogie_height, bogie_height), body, height,
        (traction, traction), (axles, axles),
    )  # fmt: skip


@given(
    body=MASS, height=HEIGHT, bogie=MASS, bogie_height=HEIGHT, traction=HEIGHT,
    pivots=st.floats(5.0, 25.0), base=st.floats(1.5, 4.0),
)  # fmt: skip
def test_sums_to_nothing_and_tips_forward(
    body: float, height: float, bogie: float, bogie_height: float, traction: float,
    pivots: float, base: float,
) -> None:  # fmt: skip
    gains = two_bogies(body, height, bogie, bogie_height, traction, pivots, base)
    scale = sum(abs(gain) for axles in gains for gain in axles)
    assert sum(map(sum, gains)) == pytest.approx(0.0, abs=1e-9 * scale)
    assert gains[0][0] > gains[0][1]
    assert gains[1][0] > gains[1][1]
    if height > traction:
        assert sum(gains[0]) > 0.0 > sum(gains[1])


@given(
    body=MASS, height=HEIGHT, bogie=MASS, bogie_height=HEIGHT, traction=HEIGHT,
    pivots=st.floats(5.0, 25.0), base=st.floats(1.5, 4.0),
)  # fmt: skip
def test_the_moment_about_the_rail_is_all_inertia(
    body: float, height: float, bogie: float, bogie_height: float, traction: float,
    pivots: float, base: float,
) -> None:  # fmt: skip
    """Σ gain × place ahead of the middle = Σ mass × height, per unit of deceleration."""
    gains = two_bogies(body, height, bogie, bogie_height, traction, pivots, base)
    places = ((pivots / 2 + base / 2, pivots / 2 - base / 2),
              (-pivots / 2 + base / 2, -pivots / 2 - base / 2))  # fmt: skip
    moment = sum(
        gain * place for axles, spots in zip(gains, places, strict=True)
        for gain, place in zip(axles, spots, strict=True)
    )  # fmt: skip
    assert moment == pytest.approx(body * height + 2 * bogie * bogie_height, rel=1e-9)


def test_a_single_axle_takes_no_moment() -> None:
    """Two-axle wagon: all of it between the two axles, none within a 'bogie' of one."""
    gains = load_transfer(
        (2.0, 8.0), (1e3, 1e3), (0.5, 0.5), 18e3, 1.5, (0.5, 0.5), ((0.0,), (0.0,))
    )
    assert gains[0][0] == pytest.approx(18e3 * 1.0 / 6.0)
    assert gains[1][0] == pytest.approx(-gains[0][0])


def test_one_bogie_alone_does_not_divide_by_zero() -> None:
    gains = load_transfer((5.0,), (6e3,), (0.6,), 20e3, 1.5, (0.8,), ((1.25, -1.25),))
    assert gains[0][0] == -gains[0][1] > 0.0
