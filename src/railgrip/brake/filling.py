"""How the pressure in a brake cylinder follows the demand: linear ramps, or a distributor."""

import math
from typing import NamedTuple

from railgrip.brake.orifice import (
    orifice_flow,
    orifice_time,
    rate_constant_fill,
    rate_constant_vent,
)
from railgrip.core.errors import Problem, RailgripError

_FILLED = 0.95
_RELEASED = 0.4e5
_INSHOT_FADE = 0.2


class LinearFilling(NamedTuple):
    """Straight ramps, as EN 14531 draws them.

    Parameters
    ----------
    fill_rate, release_rate : float
        Greatest rise and fall of the pressure, > 0 [Pa/s].
    """

    fill_rate: float
    release_rate: float


def linear_fill_rate(
    filling: LinearFilling, brake_cylinder_pressure: float, target: float, dt: float
) -> float:
    """Rate of the cylinder pressure on straight ramps, which ends exactly on the target.

    Choose it for electro-pneumatic brakes and for calculations after EN 14531.

    Parameters
    ----------
    filling : LinearFilling
        The ramps.
    brake_cylinder_pressure, target : float
        Pressure now and pressure asked for, gauge [Pa].
    dt : float
        Time for which the rate will hold, > 0 [s].

    Returns
    -------
    float
        Rate of the pressure [Pa/s].

    Examples
    --------
    >>> linear_fill_rate(LinearFilling(1.5e5, 1.0e5), 0.0, 3.0e5, 0.01)
    150000.0
    """
    rate = (target - brake_cylinder_pressure) / dt
    return max(-filling.release_rate, min(filling.fill_rate, rate))


class Distributor(NamedTuple):
    """A distributor that fills through orifices; made by `distributor`.

    Parameters
    ----------
    fill_rate : float
        Rate constant of filling after the inshot [1/s].
    inshot_rate : float
        Rate constant of filling during the inshot [1/s].
    inshot_pressure : float
        Pressure at which the inshot has ended, gauge, ≥ 0 [Pa].
    release_rate : float
        Rate constant of release [1/s].
    """

    fill_rate: float
    inshot_rate: float
    inshot_pressure: float
    release_rate: float


def distributor(
    pressure: float,
    fill_time: float,
    release_time: float,
    *,
    inshot: float = 0.0,
    inshot_time: float = 0.5,
) -> Distributor:
    """Distributor with given filling and release times.

    Parameters
    ----------
    pressure : float
        Cylinder pressure in full braking, gauge, > 0.4 bar [Pa].
    fill_time : float
        From 0 to 95 % of it, without dead time [s].
    release_time : float
        From full pressure to 0.4 bar [s].
    inshot : float
        Share of the pressure that comes first and quickly, 0 … 0.5 [-]; position G has 0.1.
    inshot_time : float
        Time of the inshot, < fill_time; not used without inshot [s]. The default is illustrative.

    Returns
    -------
    Distributor
        Rate constants.

    Raises
    ------
    RailgripError
        "the full pressure must be above 0.4 bar", "the inshot is out of range",
        "the inshot takes longer than the filling", "the time must be positive".

    Examples
    --------
    >>> round(distributor(3.8e5, 4.0, 15.0).fill_rate, 4)
    0.2197
    """
    if not _RELEASED < pressure < math.inf:
        raise RailgripError(
            Problem("", "the full pressure must be above 0.4 bar", got=f"{pressure} Pa")
        )
    release_rate = rate_constant_vent(pressure, _RELEASED, release_time)
    if inshot == 0.0:
        fill_rate = rate_constant_fill(0.0, _FILLED * pressure, pressure, fill_time)
        return Distributor(fill_rate, fill_rate, 0.0, release_rate)
    if not 0.0 < inshot <= 0.5:
        raise RailgripError(
            Problem("", "the inshot is out of range", got=f"{inshot}", allowed="0 … 0.5")
        )
    if not 0.0 < inshot_time < fill_time:
        raise RailgripError(
            Problem(
                "",
                "the inshot takes longer than the filling",
                got=f"{inshot_time} s of {fill_time} s",
                cure="a shorter inshot_time",
            )
        )
    first = inshot * pressure
    fill_rate = rate_constant_fill(first, _FILLED * pressure, pressure, fill_time - inshot_time)
    inshot_rate = _inshot_rate(fill_rate, first, pressure, inshot_time)
    return Distributor(fill_rate, inshot_rate, first, release_rate)


def distributor_rate(
    distributor: Distributor, brake_cylinder_pressure: float, target: float
) -> float:
    """Rate of the cylinder pressure behind a distributor.

    Choose it for pneumatic brakes, where the filling slows down towards the end.

    Parameters
    ----------
    distributor : Distributor
        Rate constants.
    brake_cylinder_pressure, target : float
        Pressure now and pressure asked for, gauge, ≥ 0 [Pa].

    Returns
    -------
    float
        Rate of the pressure [Pa/s]; 0 when the pressure is the target.

    Notes
    -----
    Filling and release are orifice flows between the cylinder and the target pressure. Towards the
    end of the inshot (its last fifth) the rate constant passes linearly into that of filling.
    Known wrong when the reservoir is nearly exhausted; limit the target to its pressure.

    Examples
    --------
    >>> distributor_rate(Distributor(0.5, 0.5, 0.0, 0.2), 0.0, 3.8e5)
    240000.0
    """
    flow = orifice_flow(target, brake_cylinder_pressure)
    fade = max(_INSHOT_FADE * distributor.inshot_pressure, 1.0)
    share = max(0.0, min(1.0, (distributor.inshot_pressure - brake_cylinder_pressure) / fade))
    rate = distributor.fill_rate + share * (distributor.inshot_rate - distributor.fill_rate)
    return rate * max(0.0, flow) + distributor.release_rate * min(0.0, flow)


def _inshot_rate(fill_rate: float, first: float, supply: float, time: float) -> float:
    """Rate constant with which the inshot, its fading end included, takes its time."""
    slices = 50
    faded = (1.0 - _INSHOT_FADE) * first
    step = (first - faded) / slices
    quick = orifice_time(0.0, faded, supply, 1.0)
    last = [
        orifice_time(faded + k * step, faded + (k + 1) * step, supply, 1.0) for k in range(slices)
    ]

    def time_at(rate: float) -> float:
        share = [(slices - k - 0.5) / slices for k in range(slices)]
        rates = [fill_rate + part * (rate - fill_rate) for part in share]
        return quick / rate + sum(part / each for part, each in zip(last, rates, strict=True))

    low, high = 1e-9, 1e9
    while high - low > 1e-12 * high:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if time_at(middle) > time else (low, middle)
    return high
