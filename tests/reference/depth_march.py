"""Heat marched into a half-space by finite volumes: depth in layers, time in implicit steps."""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_banded

from railgrip.core.formulas.flash_temperature import ThermalMaterial


def march(steel: ThermalMaterial, time: np.ndarray, flux: np.ndarray) -> np.ndarray:
    """Rise of the surface at each time, under the mean flux of each step (one fewer than times).

    The layers grow with the depth, from a fiftieth of how deep heat goes in a step to eight
    times that of the whole course.
    """
    conductivity = steel.conductivity
    capacity = steel.density * steel.specific_heat
    steps = np.diff(time)
    thin = 0.02 * np.sqrt(conductivity / capacity * steps.min())
    deep = 8.0 * np.sqrt(conductivity / capacity * (time[-1] - time[0]))
    edges = np.concatenate([[0.0], np.geomspace(thin, deep, 400)])
    size, centre = np.diff(edges), 0.5 * (edges[1:] + edges[:-1])
    between = conductivity / np.diff(centre)
    rise, surface = np.zeros(size.size), [0.0]
    for step, entering in zip(steps, flux, strict=True):
        bands = np.zeros((3, size.size))
        bands[1] = capacity * size / step
        bands[1, :-1] += between
        bands[1, 1:] += between
        bands[0, 1:] = bands[2, :-1] = -between
        right = capacity * size / step * rise
        right[0] += entering
        rise = solve_banded((1, 1), bands, right)
        surface.append(float(rise[0] + entering * 0.5 * size[0] / conductivity))
    return np.array(surface)
