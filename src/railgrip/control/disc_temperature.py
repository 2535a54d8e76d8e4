"""Disc temperature for the friction estimate: from a sensor that lags, or from a heat model."""

from __future__ import annotations

from railgrip.core.formulas.elementary import exp_decay
from railgrip.core.formulas.two_node_heat import DiscHeat, film_coefficient, two_node_heat_rates


def lagging_sensor(reading: float, temperature: float, lag: float, dt: float) -> float:
    """Return the next reading of a temperature sensor with a first-order lag.

    Parameters
    ----------
    reading : float
        Last reading [°C].
    temperature : float
        Of the disc since then [°C].
    lag : float
        Time constant, > 0 [s].
    dt : float
        Time since the last reading, ≥ 0 [s].

    Returns
    -------
    float
        [°C]; exact for a temperature that is constant over dt.

    Examples
    --------
    >>> round(lagging_sensor(20.0, 120.0, 5.0, 5.0), 2)
    83.21
    """
    return temperature + (reading - temperature) * exp_decay(dt / lag)


def advance_disc(
    disc: DiscHeat, ring: float, hub: float, friction_power: float, train_speed: float, dt: float
) -> tuple[float, float]:
    """Advance the controller's own model of a disc by one period (midpoint rule).

    Parameters
    ----------
    disc : DiscHeat
        The disc as the controller knows it.
    ring, hub : float
        Temperatures [°C].
    friction_power : float
        Estimated brake force at the tread times wheel speed, ≥ 0 [W].
    train_speed : float
        [m/s].
    dt : float
        Period [s].

    Returns
    -------
    ring, hub : float
        Temperatures at the end of the period [°C].

    Notes
    -----
    Second order in dt. Checked by tests/laws/test_disc_temperature.py: heat stored and lost equals
    heat put in.

    Examples
    --------
    >>> disc = DiscHeat(65.0, 55.0, 450.0, 2.0, 0.9, 9.0, 3.0, 0.7, 20.0)
    >>> round(advance_disc(disc, 20.0, 20.0, 300e3, 40.0, 0.1)[0], 3)
    20.902
    """
    film = film_coefficient(disc.film_still, disc.film_wind, train_speed)
    ring_rate, hub_rate = two_node_heat_rates(disc, ring, hub, friction_power, film)
    middle_ring = ring + 0.5 * dt * ring_rate
    middle_hub = hub + 0.5 * dt * hub_rate
    ring_rate, hub_rate = two_node_heat_rates(disc, middle_ring, middle_hub, friction_power, film)
    return ring + dt * ring_rate, hub + dt * hub_rate
