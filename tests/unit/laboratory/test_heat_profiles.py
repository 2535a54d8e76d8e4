"""The profile of any distribution, against closed forms; and what does not fit."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.laboratory.heat_profiles import (
    parabolic_profile,
    semi_elliptic_profile,
    strip_profile,
    uniform_profile,
)


@pytest.mark.parametrize(
    ("closed", "flux", "tolerance"),
    [
        (uniform_profile, lambda x: np.ones_like(x), 1e-12),
        (parabolic_profile, lambda x: 1.0 - x * x, 1e-6),
        (semi_elliptic_profile, lambda x: np.sqrt(1.0 - x * x), 2e-3),
    ],
)
def test_any_distribution_is_integrated(
    closed: Callable[[np.ndarray], np.ndarray],
    flux: Callable[[np.ndarray], np.ndarray],
    tolerance: float,
) -> None:
    x = np.linspace(-1.0, 1.0, 2001)
    assert strip_profile(x, flux(x)) == pytest.approx(closed(x), abs=tolerance)


def test_behind_the_patch_the_flux_is_zero_and_the_heat_fades() -> None:
    x = np.concatenate([np.linspace(-1.0, 1.0, 801), np.linspace(1.0 + 1e-9, 5.0, 400)])
    flux = np.where(x <= 1.0, 1.0 - x * x, 0.0)
    assert strip_profile(x, flux)[-1] == pytest.approx(float(parabolic_profile(5.0)), rel=1e-5)


def test_several_strips_at_once() -> None:
    x = np.linspace(-1.0, 1.0, 11)
    rows = np.vstack([np.ones(11), 2.0 * np.ones(11)])
    found = strip_profile(x, rows)
    assert found.shape == (2, 11)
    assert found[1] == pytest.approx(2.0 * found[0])


@pytest.mark.parametrize(
    ("places", "flux", "says"),
    [
        ([0.0, 0.0], [1.0, 1.0], "the places must rise"),
        ([0.0, 1.0], [1.0], "one heat flux for each place"),
        ([0.0, 1.0], [1.0, np.nan], "one heat flux for each place"),
    ],
)
def test_what_does_not_fit_is_refused(places: list[float], flux: list[float], says: str) -> None:
    with pytest.raises(RailgripError, match=says):
        strip_profile(places, flux)
