"""The turned ellipse against the eigenvectors of the summed curvature tensor."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from railgrip.contact.hertz_factors import hertz_factors
from railgrip.contact.yawed_patch import printed_turn, yawed_patch
from railgrip.core.errors import RailgripError
from railgrip.core.formulas.patch import hertz_1882

RADII = st.floats(0.05, 5.0)


@given(RADII, st.floats(0.3, 20.0), RADII, st.floats(-1.5, 1.5))
def test_the_axes_are_the_eigenvectors_of_the_summed_curvatures(
    wheel: float, across: float, rail: float, yaw: float
) -> None:
    turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
    tensor = turn @ np.diag([1.0 / wheel, 1.0 / across]) @ turn.T + np.diag([0.0, 1.0 / rail])
    values, vectors = np.linalg.eigh(tensor)
    assume(values[1] - values[0] > 1e-3 * values[1])
    patch = yawed_patch(100e3, wheel, across, rail, 210e9, 0.28, yaw)
    axis = np.array([math.cos(patch.turn_from_rail), math.sin(patch.turn_from_rail)])
    of_a = int(abs(vectors[:, 1] @ axis) > abs(vectors[:, 0] @ axis))
    assert abs(vectors[:, of_a] @ axis) == pytest.approx(1.0, abs=1e-6)
    straight = hertz_1882(100e3, 1.0 / values[of_a], 1.0 / values[1 - of_a], math.inf, 210e9, 0.28)
    assert (patch.a, patch.b) == pytest.approx((straight.a, straight.b), rel=1e-6)
    assert patch.turn_from_wheel == patch.turn_from_rail - yaw


def test_without_yaw_it_is_the_plain_ellipse() -> None:
    plain = hertz_1882(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    found = yawed_patch(100e3, 0.46, math.inf, 0.3, 210e9, 0.28, 0.0)
    assert (found.a, found.b, found.turn_from_rail) == pytest.approx((plain.a, plain.b, 0.0))
    assert found.greatest_pressure == pytest.approx(plain.greatest_pressure)


def test_a_quarter_turn_of_the_wheel_swaps_its_radii() -> None:
    found = yawed_patch(100e3, 0.46, 0.5, 0.3, 210e9, 0.28, 0.5 * math.pi)
    swapped = hertz_1882(100e3, 0.5, 0.46, 0.3, 210e9, 0.28)
    assert sorted((found.a, found.b)) == pytest.approx(sorted((swapped.a, swapped.b)))


@given(st.floats(-1e-3, 1e-3).filter(lambda yaw: abs(yaw) > 1e-6))
def test_the_usual_radii_turn_by_1_5_and_2_5_of_the_yaw(yaw: float) -> None:
    found = yawed_patch(100e3, 0.5, math.inf, 0.3, 210e9, 0.3, yaw)
    assert found.turn_from_rail / yaw == pytest.approx(-1.5, rel=1e-4)
    assert found.turn_from_wheel / yaw == pytest.approx(-2.5, rel=1e-4)


@given(RADII, RADII, st.floats(1e-6, 1e-3))
def test_the_printed_turn_lacks_the_cosine_of_the_angle(
    wheel: float, rail: float, yaw: float
) -> None:
    cosine = math.cos(hertz_factors(1.0 / wheel, 1.0 / rail).angle)
    assume(cosine > 0.05)
    true = yawed_patch(100e3, wheel, math.inf, rail, 210e9, 0.28, yaw).turn_from_rail
    printed = printed_turn(wheel, math.inf, rail, yaw)
    assert abs(true) == pytest.approx(printed / cosine, rel=1e-2)


@given(RADII, st.floats(0.3, 20.0), RADII, st.floats(0.0, 1.5))
def test_yaw_to_the_left_mirrors_yaw_to_the_right(
    wheel: float, across: float, rail: float, yaw: float
) -> None:
    left = yawed_patch(100e3, wheel, across, rail, 210e9, 0.28, yaw)
    right = yawed_patch(100e3, wheel, across, rail, 210e9, 0.28, -yaw)
    assert (left.a, left.b) == (right.a, right.b)
    assert abs(left.turn_from_rail) == abs(right.turn_from_rail)


@pytest.mark.parametrize(
    ("wheel", "across", "rail", "yaw", "sentence"),
    [
        (0.46, -0.2, 0.3, 1e-3, "Hertz has no solution; got yaw 0.001 rad, wheel -0.2 m"),
        (0.46, math.inf, math.inf, 0.0, "Hertz has no solution"),
        (0.0, math.inf, 0.3, 0.0, "wheel radius must be positive"),
        (0.46, 0.0, 0.3, 0.0, "transverse radius of the wheel must not be zero"),
        (0.46, math.inf, 0.3, 2.0, "the yaw is out of range; got 2 rad"),
        (0.46, math.inf, 0.3, math.nan, "the yaw is out of range"),
    ],
)
def test_impossible_yaws_get_a_sentence(
    wheel: float, across: float, rail: float, yaw: float, sentence: str
) -> None:
    with pytest.raises(RailgripError, match=sentence):
        yawed_patch(100e3, wheel, across, rail, 210e9, 0.28, yaw)


def test_the_printed_formula_has_limits_of_its_own() -> None:
    with pytest.raises(RailgripError, match=r"\(1\.15\) has no angle"):
        printed_turn(0.46, -0.1, 0.12, 0.7)
