"""The laws that are fitted to pad friction: products of functions, and quadratic ones."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.data import INFLUENCES, Blocks
from railgrip.laboratory.pad_fit.shape import Placed, log_curve

LONGEST_LAG = 30.0
LEAST_FRICTION = 1e-3


class Law(Protocol):
    """What the fit needs of a law."""

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each parameter."""

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest of each parameter."""

    def log_friction(self, theta: FloatArray, blocks: Blocks) -> tuple[FloatArray, FloatArray]:
        """Logarithm of the friction (stop, block), and its derivative to each parameter."""


class Lags(NamedTuple):
    """First-order lags of the sensors.

    Parameters
    ----------
    given : tuple of float
        Of temperature, speed and clamp force [s]; where fitted, the start.
    fitted : tuple of str
        Influences whose lag is to be found.
    friction : float
        Of the friction, that is of the torque [s].

    Notes
    -----
    x = x_m + τ dx_m/dt is what the sensor saw. A friction that comes late by τ_μ belongs to
    influences of τ_μ ago, to first order; only the difference of the lags counts.
    """

    given: tuple[float, float, float] = (0.0, 0.0, 0.0)
    fitted: tuple[str, ...] = ()
    friction: float = 0.0


class Product(NamedTuple):
    """f0 · f1(T) · f2(v) · f3(F) with any subset of the functions.

    Parameters
    ----------
    functions : dict
        Influence → its shape over the data.
    lags : Lags
        Of the sensors.
    """

    functions: dict[str, Placed]
    lags: Lags = Lags()

    @property
    def fitted_lags(self) -> tuple[str, ...]:
        """Lags that count: of influences that have a function."""
        return tuple(name for name in self.lags.fitted if name in self.functions)

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each parameter, those of the functions counted."""
        inner = [f"{f}_{k}" for f, p in self.functions.items() for k in range(p.shape.parameters)]
        return ("level", *inner, *(f"{name}_lag" for name in self.fitted_lags))

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest of each parameter."""
        inner = [placed.bounds() for placed in self.functions.values()]
        n = len(self.fitted_lags)
        low = [np.array([-7.0]), *(one[0] for one in inner), np.full(n, -1.0)]
        high = [np.array([2.0]), *(one[1] for one in inner), np.full(n, LONGEST_LAG)]
        return np.concatenate(low), np.concatenate(high)

    def parts(self, theta: FloatArray) -> tuple[dict[str, FloatArray], FloatArray]:
        """Return the parameters of each function, and the lag of each influence."""
        begin, found = 1, {}
        for name, placed in self.functions.items():
            found[name] = theta[begin : begin + placed.shape.parameters]
            begin += placed.shape.parameters
        lags = np.array(self.lags.given)
        for name, lag in zip(self.fitted_lags, theta[begin:], strict=True):
            lags[INFLUENCES.index(name)] = lag
        return found, lags

    def log_friction(self, theta: FloatArray, blocks: Blocks) -> tuple[FloatArray, FloatArray]:
        """Logarithm of the friction (stop, block), and its derivative to each parameter."""
        numbers, lags = self.parts(theta)
        total = np.full(blocks.time.shape, theta[0])
        columns = [np.ones((*blocks.time.shape, 1))]
        late = {}
        for name, placed in self.functions.items():
            k = INFLUENCES.index(name)
            slopes = blocks.slopes[k]
            x = blocks.values[k] + (lags[k] - self.lags.friction) * slopes
            log_h, by_numbers, by_x = log_curve(placed, numbers[name], x)
            total = total + log_h
            columns.append(by_numbers)
            late[name] = (by_x * slopes)[..., None]
        columns += [late[name] for name in self.fitted_lags]
        return total, np.concatenate(columns, axis=-1)


class Quadratic(NamedTuple):
    """μ = a0 + a1 v + a2 v² + b1 T + b2 T² + c1 F + c2 F², a law that the source cites.

    Parameters
    ----------
    scales : tuple of float
        Of temperature, speed, clamp force; 0 where an influence has no part.
    lags : Lags
        Of the sensors.
    steps_back : float
        The influences are those of so many samples before: 0, or 1 for the law with (i − 1).
    """

    scales: tuple[float, float, float]
    lags: Lags = Lags()
    steps_back: float = 0.0

    @property
    def names(self) -> tuple[str, ...]:
        """Name of each parameter."""
        signs = dict(zip(INFLUENCES, "bac", strict=True))
        used = [name for name, scale in zip(INFLUENCES, self.scales, strict=True) if scale]
        return ("a0", *(f"{signs[name]}{k}" for name in used for k in (1, 2)))

    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest of each parameter."""
        n = len(self.names)
        return np.full(n, -np.inf), np.full(n, np.inf)

    def columns(self, blocks: Blocks) -> FloatArray:
        """Return what each coefficient is multiplied with, (stop, block, parameter), scaled."""
        found = [np.ones(blocks.time.shape)]
        for k, scale in enumerate(self.scales):
            if scale:
                shift = self.lags.given[k] - self.lags.friction - self.steps_back * blocks.spacing
                x = (blocks.values[k] + shift * blocks.slopes[k]) / scale
                found += [x, x * x]
        return np.stack(found, axis=-1)

    def log_friction(self, theta: FloatArray, blocks: Blocks) -> tuple[FloatArray, FloatArray]:
        """Logarithm of the friction (stop, block), and its derivative to each parameter."""
        columns = self.columns(blocks)
        friction = np.maximum(columns @ theta, LEAST_FRICTION)
        return np.log(friction), columns / friction[..., None]

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """Return the coefficients in SI, in the order of `names`."""
        units = [1.0]
        for scale in self.scales:
            if scale:
                units += [scale, scale**2]
        return np.asarray(theta / np.array(units))
