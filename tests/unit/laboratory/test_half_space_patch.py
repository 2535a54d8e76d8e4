"""The divided patch: its pressure is Hertz's, its convolution the plain sum."""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.contact.half_space import rectangle_influence
from railgrip.laboratory.half_space_grid import convolve
from railgrip.laboratory.half_space_patch import half_space_patch


@pytest.mark.parametrize("b", [0.1, 0.7, 1.0, 10.0])
@pytest.mark.parametrize("grid", [(8, 8), (33, 24), (64, 64)])
def test_the_pressure_carries_the_load_on_hertz_ellipse(b: float, grid: tuple[int, int]) -> None:
    patch = half_space_patch(1.0, b, 0.28, *grid)
    assert float(patch.pressure.sum()) * patch.dx * patch.dy == pytest.approx(1.0, rel=1e-9)
    assert float(patch.pressure.min()) == 0.0
    area = float(patch.is_inside.sum()) * patch.dx * patch.dy
    assert area == pytest.approx(np.pi * b, rel=1.5 * patch.dx)


def test_the_pressure_is_hertz_ellipsoid() -> None:
    patch = half_space_patch(1.0, 0.7, 0.28, 84, 84)
    depth = 1.0 - patch.x[None, :] ** 2 - (patch.y[:, None] / 0.7) ** 2
    hertz = 1.5 / (np.pi * 0.7) * np.sqrt(np.maximum(depth, 0.0))
    assert np.abs(patch.pressure - hertz)[depth > 0.2].max() < 2e-3 * hertz.max()
    assert np.abs(patch.pressure - hertz).max() < 0.1 * hertz.max()


def test_the_pressure_does_not_depend_on_poisson_nor_size() -> None:
    one = half_space_patch(1.0, 0.7, 0.0, 24, 24)
    other = half_space_patch(3e-3, 2.1e-3, 0.5, 24, 24)
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=1e-7, atol=1e-9)


def test_the_same_shape_is_kept() -> None:
    assert half_space_patch(1.0, 0.7, 0.3, 20, 16) is half_space_patch(5e-3, 3.5e-3, 0.3, 20, 16)


def test_the_convolution_is_the_plain_sum() -> None:
    patch = half_space_patch(1.0, 0.7, 0.3, 11, 9)
    load = np.random.default_rng(1).normal(size=(2, 9, 11))
    now, before, steady = (
        convolve(kernel, load) for kernel in (patch.now, patch.before, patch.steady)
    )

    def plain(row: int, column: int) -> np.ndarray:
        moved = np.zeros(2)
        for i in range(9):
            for j in range(11):
                push = rectangle_influence(
                    (column - j) * patch.dx, (row - i) * patch.dy, patch.dx, patch.dy, 0.3
                )
                moved += np.array([[push.xx, push.xy], [push.xy, push.yy]]) @ load[:, i, j]
        return moved

    for row, column in ((0, 0), (4, 5), (8, 9)):
        np.testing.assert_allclose(now[:, row, column], plain(row, column), rtol=1e-10)
        np.testing.assert_allclose(before[:, row, column], plain(row, column + 1), rtol=1e-10)
    np.testing.assert_allclose(steady, now - before, atol=1e-12)
