"""Heat balance of a wheel: a rim that is heated and chilled at the tread, and a web behind it."""

from typing import NamedTuple


class WheelHeat(NamedTuple):
    """What decides how warm a wheel becomes.

    Parameters
    ----------
    rim_mass, web_mass : float
        Mass of the rim and of web and hub, > 0 [kg].
    specific_heat : float
        c of the steel, > 0 [J/(kg K)].
    conductance : float
        Heat flow between rim and web per kelvin, ≥ 0 [W/K].
    rim_surface, web_surface : float
        Surfaces that cool in the air, ≥ 0 [m²].
    ambient : float
        Temperature of the air [°C].
    """

    rim_mass: float
    web_mass: float
    specific_heat: float
    conductance: float
    rim_surface: float
    web_surface: float
    ambient: float


ILLUSTRATIVE_WHEEL = WheelHeat(190.0, 150.0, 450.0, 90.0, 0.9, 0.9, 20.0)
"""A wheel of 0.92 m and 340 kg; masses, surfaces and conductance are illustrative."""


class WheelHeatFlows(NamedTuple):
    """Heat flows of a wheel [W], positive in the direction of their name.

    Parameters
    ----------
    from_contact : float
        Friction heat out of the contact.
    from_tread_brake : float
        Friction heat of brake blocks; zero for disc brakes.
    to_rail : float
        Chilling by the rail.
    to_air : float
        Convection from rim and web.
    to_web : float
        Conduction from the rim.
    """

    from_contact: float
    from_tread_brake: float
    to_rail: float
    to_air: float
    to_web: float


def wheel_heat_flows(
    wheel: WheelHeat,
    rim_temperature: float,
    web_temperature: float,
    contact_heat: float,
    tread_brake_heat: float,
    chill: float,
    rail_temperature: float,
    film: float,
) -> WheelHeatFlows:
    """Heat that flows into and out of a wheel.

    Choose it for one stop or for drag braking with blocks; for what one contact adds on top, and
    for the first seconds in which only the tread is warm, see
    `railgrip.laboratory.temperature_cycle`.

    Parameters
    ----------
    wheel : WheelHeat
        The wheel.
    rim_temperature, web_temperature : float
        Temperatures [°C].
    contact_heat : float
        Wheel's share of the contact's friction power, ≥ 0 [W].
    tread_brake_heat : float
        Wheel's share of the power of the blocks, ≥ 0 [W].
    chill : float
        `railgrip.core.formulas.rail_chill.chill_conductance`, ≥ 0 [W/K].
    rail_temperature : float
        Of the rail before the wheel comes [°C].
    film : float
        `railgrip.core.formulas.two_node_heat.film_coefficient` [W/(m²K)].

    Returns
    -------
    WheelHeatFlows
        The flows.

    Notes
    -----
    to_rail = chill (T_rim − T_rail); to_air = h [A_rim (T_rim − T_a) + A_web (T_web − T_a)];
    to_web = G (T_rim − T_web). Radiation is left out: up to 400 °C it is 4 … 21 W/(m²K), which
    may be added to the film.
    Known wrong where the heat has had no time to spread through the rim (60 mm need about
    (60 mm)²/κ, four minutes): the tread is hotter then than the rim as a whole.

    Examples
    --------
    >>> flows = wheel_heat_flows(ILLUSTRATIVE_WHEEL, 120.0, 20.0, 8e3, 0.0, 82.0, 20.0, 30.0)
    >>> [round(flow, 6) for flow in flows]
    [8000.0, 0.0, 8200.0, 2700.0, 9000.0]
    """
    rim_air = wheel.rim_surface * (rim_temperature - wheel.ambient)
    web_air = wheel.web_surface * (web_temperature - wheel.ambient)
    return WheelHeatFlows(
        contact_heat,
        tread_brake_heat,
        chill * (rim_temperature - rail_temperature),
        film * (rim_air + web_air),
        wheel.conductance * (rim_temperature - web_temperature),
    )


def wheel_heat_rates(
    wheel: WheelHeat, web_temperature: float, film: float, flows: WheelHeatFlows
) -> tuple[float, float]:
    """Rates of change of the temperatures of rim and web.

    Parameters
    ----------
    wheel : WheelHeat
        The wheel.
    web_temperature : float
        Temperature of the web [°C].
    film : float
        Film coefficient, as given to `wheel_heat_flows` [W/(m²K)].
    flows : WheelHeatFlows
        From `wheel_heat_flows`.

    Returns
    -------
    rim_rate, web_rate : float
        Rates of temperature [K/s].

    Notes
    -----
    m_rim c dT_rim/dt + m_web c dT_web/dt = from_contact + from_tread_brake − to_rail − to_air.

    Checked by tests/unit/laboratory/test_wheel_bulk.py (energy, and the closed form of one node).

    Examples
    --------
    >>> flows = WheelHeatFlows(8e3, 0.0, 8.2e3, 2.7e3, 9e3)
    >>> rates = wheel_heat_rates(ILLUSTRATIVE_WHEEL, 20.0, 30.0, flows)
    >>> [round(rate, 5) for rate in rates]
    [-0.13918, 0.13333]
    """
    web_air = film * wheel.web_surface * (web_temperature - wheel.ambient)
    rim_heat = (
        flows.from_contact
        + flows.from_tread_brake
        - flows.to_rail
        - (flows.to_air - web_air)
        - flows.to_web
    )
    web_heat = flows.to_web - web_air
    return (
        rim_heat / (wheel.rim_mass * wheel.specific_heat),
        web_heat / (wheel.web_mass * wheel.specific_heat),
    )
