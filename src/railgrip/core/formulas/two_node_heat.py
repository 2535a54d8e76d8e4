"""Two-node heat balance of a brake disc: friction ring and hub."""

from typing import NamedTuple

from railgrip.core.constants import STEFAN_BOLTZMANN, ZERO_CELSIUS
from railgrip.core.formulas.elementary import power_0_8

_HEAT_CAPACITY_AT_20 = 460.0
_HEAT_CAPACITY_SLOPE = 0.35


class DiscHeat(NamedTuple):
    """What decides how hot a brake disc becomes.

    Parameters
    ----------
    ring_mass, hub_mass : float
        Mass of the friction ring and of the hub, > 0 [kg].
    conductance : float
        Heat flow between ring and hub per kelvin [W/K].
    surface : float
        Surface of the ring that cools [m²].
    heat_share : float
        Share of the friction power that goes into the disc, 0 … 1 [-].
    film_still, film_wind : float
        Film coefficient at standstill [W/(m²K)] and its growth with speed^0.8 [W/(m²K)/(m/s)^0.8].
    emissivity : float
        For radiation, 0 … 1 [-].
    ambient : float
        Temperature of the air [°C].
    """

    ring_mass: float
    hub_mass: float
    conductance: float
    surface: float
    heat_share: float
    film_still: float
    film_wind: float
    emissivity: float
    ambient: float


def film_coefficient(still: float, wind: float, speed: float) -> float:
    """Heat carried off by air per area and kelvin, at a train speed.

    Parameters
    ----------
    still : float
        At standstill [W/(m²K)].
    wind : float
        Growth with speed^0.8 [W/(m²K)/(m/s)^0.8].
    speed : float
        Train speed, 0 … 125 [m/s].

    Returns
    -------
    float
        still + wind · speed^0.8 [W/(m²K)].

    Examples
    --------
    >>> round(film_coefficient(9.0, 3.0, 32.0), 3)
    57.0
    """
    return still + wind * power_0_8(speed)


def heat_capacity(temperature: float) -> float:
    """Specific heat of grey iron and steel, c_p = 460 + 0.35 (T − 20).

    Parameters
    ----------
    temperature : float
        Temperature, −40 … 700 [°C].

    Returns
    -------
    float
        Specific heat [J/(kg K)].

    Examples
    --------
    >>> heat_capacity(120.0)
    495.0
    """
    return _HEAT_CAPACITY_AT_20 + _HEAT_CAPACITY_SLOPE * (temperature - 20.0)


def two_node_heat_rates(
    disc: DiscHeat,
    ring_temperature: float,
    hub_temperature: float,
    friction_power: float,
    film: float,
) -> tuple[float, float]:
    """Rates of change of the temperatures of ring and hub.

    Choose it for one stop or a drag brake; it knows no gradient through the ring's thickness, so
    that the rubbing surface (flash and hot spots) is hotter than it says.

    Parameters
    ----------
    disc : DiscHeat
        The disc.
    ring_temperature, hub_temperature : float
        Temperatures [°C].
    friction_power : float
        Power of pad on disc, ≥ 0 [W].
    film : float
        Film coefficient from `film_coefficient` [W/(m²K)].

    Returns
    -------
    ring_rate, hub_rate : float
        Rates of temperature [K/s].

    Notes
    -----
    m_r c(T_r) dT_r/dt = share · P − h A (T_r − T_a) − ε σ A (T_r⁴ − T_a⁴) − G (T_r − T_h);
    m_h c(T_h) dT_h/dt = G (T_r − T_h), with c from `heat_capacity` and kelvin in the fourth power.
    Known wrong when the hub cools by itself (wheel-mounted discs): only the ring meets the air.

    Checked by tests/reference/disc_200_kmh: 10.8 MJ into 125 kg, 156 K, 1 %.

    Examples
    --------
    >>> disc = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
    >>> round(two_node_heat_rates(disc, 20.0, 20.0, 300e3, 30.0)[0], 4)
    9.0301
    """
    ring = ring_temperature + ZERO_CELSIUS
    air = disc.ambient + ZERO_CELSIUS
    ring2 = ring * ring
    air2 = air * air
    radiation = disc.emissivity * STEFAN_BOLTZMANN * (ring2 * ring2 - air2 * air2)
    cooling = disc.surface * (film * (ring_temperature - disc.ambient) + radiation)
    conduction = disc.conductance * (ring_temperature - hub_temperature)
    ring_heat = disc.heat_share * friction_power - cooling - conduction
    ring_rate = ring_heat / (disc.ring_mass * heat_capacity(ring_temperature))
    hub_rate = conduction / (disc.hub_mass * heat_capacity(hub_temperature))
    return ring_rate, hub_rate
