"""Temperature of a whole wheel over a stop: heat from the contact, chilling by rail and air."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.wheel_heat import (
    WheelHeat,
    WheelHeatFlows,
    wheel_heat_flows,
    wheel_heat_rates,
)

Array = NDArray[np.float64]


@dataclass(frozen=True)
class WheelBulk:
    """Course of a wheel's temperature, and where the heat went.

    Parameters
    ----------
    time : ndarray
        [s].
    rim, web : ndarray
        Temperatures [°C].
    from_contact, from_tread_brake, to_rail, to_air, stored : float
        Energies over the whole course [J].
    """

    time: Array
    rim: Array
    web: Array
    from_contact: float
    from_tread_brake: float
    to_rail: float
    to_air: float
    stored: float

    @property
    def imbalance(self) -> float:
        """Energy that came in and is neither stored nor gone; rounding only [J]."""
        out = self.to_rail + self.to_air + self.stored
        return self.from_contact + self.from_tread_brake - out


def wheel_bulk(
    wheel: WheelHeat,
    time: ArrayLike,
    *,
    contact_heat: ArrayLike = 0.0,
    tread_brake_heat: ArrayLike = 0.0,
    chill: ArrayLike = 0.0,
    film: ArrayLike = 0.0,
    rail_temperature: float = 20.0,
    start: float | tuple[float, float] = 20.0,
) -> WheelBulk:
    """Temperatures of rim and web over a stop.

    Parameters
    ----------
    wheel : WheelHeat
        The wheel.
    time : array_like, shape (n,)
        Rising, the results stand at these times [s].
    contact_heat, tread_brake_heat : array_like, shape (n,) or scalar
        Wheel's share of the friction power in the contact and of the brake blocks, ≥ 0 [W].
    chill : array_like
        `railgrip.core.formulas.rail_chill.chill_conductance`, ≥ 0; about 80 for a rolling loaded
        wheel, 0 leaves the rail out [W/K].
    film : array_like
        `railgrip.core.formulas.two_node_heat.film_coefficient`, ≥ 0 [W/(m²K)].
    rail_temperature : float
        Of the rail before the wheel [°C].
    start : float or (float, float)
        Of the wheel, or of rim and web, at the first time [°C].

    Returns
    -------
    WheelBulk
        Temperatures and energies.

    Raises
    ------
    RailgripError
        "the time must rise", "must be zero or more, and finite" or "must be positive".

    Notes
    -----
    The balance of `wheel_heat_rates`, linear in the temperatures, is stepped with the midpoint
    rule, implicit and of second order: it does not oscillate at steps of seconds and keeps the
    energy to rounding at any step.
    Known wrong in the first half minute for the tread itself, see `wheel_heat_flows`.

    References
    ----------
    .. [1] M. Ertz, K. Knothe, Wear 253 (2002) 498–508: convection and the rail's chilling both
       count for the wheel's bulk temperature.

    Checked by tests/unit/laboratory/test_wheel_bulk.py.

    Examples
    --------
    >>> from railgrip.core.formulas.wheel_heat import ILLUSTRATIVE_WHEEL
    >>> course = wheel_bulk(ILLUSTRATIVE_WHEEL, [0.0, 30.0, 60.0], contact_heat=15e3, chill=82.0)
    >>> course.rim.round(2).tolist()
    [20.0, 25.11, 29.93]
    """
    t = np.asarray(time, float)
    if t.ndim != 1 or t.size < 2 or not np.all(np.diff(t) > 0.0):
        raise RailgripError(Problem("time", "the time must rise", cure="two or more times"))
    _refuse_bad_wheel(wheel)
    inputs = {
        "contact_heat": contact_heat,
        "tread_brake_heat": tread_brake_heat,
        "chill": chill,
        "film": film,
    }
    middles = [_middles(name, values, t.size) for name, values in inputs.items()]
    temperatures = np.empty((t.size, 2))
    temperatures[0] = start
    energies = np.zeros(4)
    for k, step in enumerate(np.diff(t)):
        now = tuple(float(values[k]) for values in middles)
        middle = _implicit_half_step(wheel, temperatures[k], now, rail_temperature, float(step))
        temperatures[k + 1] = 2.0 * middle - temperatures[k]
        flows = _flows(wheel, float(middle[0]), float(middle[1]), now, rail_temperature)
        energies += step * np.array(flows[:4])
    masses = np.array([wheel.rim_mass, wheel.web_mass]) * wheel.specific_heat
    stored = float(masses @ (temperatures[-1] - temperatures[0]))
    rim, web = temperatures.T
    contact, blocks, to_rail, to_air = energies.tolist()
    return WheelBulk(t, rim, web, contact, blocks, to_rail, to_air, stored)


def _flows(
    wheel: WheelHeat, rim: float, web: float, now: tuple[float, ...], rail_temperature: float
) -> WheelHeatFlows:
    contact_heat, tread_brake_heat, chill, film = now
    return wheel_heat_flows(
        wheel, rim, web, contact_heat, tread_brake_heat, chill, rail_temperature, film
    )


def _implicit_half_step(
    wheel: WheelHeat,
    begin: Array,
    now: tuple[float, ...],
    rail_temperature: float,
    step: float,
) -> Array:
    """Temperatures T in the middle of a step, T = begin + step/2 · rates(T)."""

    def rates(rim: float, web: float) -> Array:
        flows = _flows(wheel, rim, web, now, rail_temperature)
        return np.array(wheel_heat_rates(wheel, web, now[3], flows))

    # the rates are linear in the two temperatures: three values are all there is to know
    rim, web = begin.tolist()
    here = rates(rim, web)
    slopes = np.column_stack([rates(rim + 1.0, web) - here, rates(rim, web + 1.0) - here])
    half = 0.5 * step
    return np.asarray(begin + np.linalg.solve(np.eye(2) - half * slopes, half * here))


def _middles(name: str, values: ArrayLike, count: int) -> Array:
    given = np.asarray(values, float)
    if given.shape not in ((), (count,)):
        raise RailgripError(
            Problem(name, "one value for each time, or one for all", got=f"shape {given.shape}")
        )
    if not (np.all(given >= 0.0) and np.all(np.isfinite(given))):
        raise RailgripError(Problem(name, "must be zero or more, and finite"))
    course = np.broadcast_to(given, (count,))
    return np.asarray(0.5 * (course[1:] + course[:-1]))


def _refuse_bad_wheel(wheel: WheelHeat) -> None:
    for name in ("rim_mass", "web_mass", "specific_heat"):
        value = getattr(wheel, name)
        if not 0.0 < value < math.inf:
            raise RailgripError(Problem(f"wheel.{name}", "must be positive", got=f"{value}"))
