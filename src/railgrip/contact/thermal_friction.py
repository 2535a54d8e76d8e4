"""Friction that changes linearly with the temperature of the contact."""

from typing import NamedTuple

_LEAST_SPAN = 1e-12


class ThermalFriction(NamedTuple):
    """A straight change of the friction over a span of temperature.

    Parameters
    ----------
    reference_friction : float
        Friction coefficient up to the reference temperature, μ_ref, ≥ 0 [-].
    friction_change : float
        What is added to it at the end of the span, Δμ, ≥ −μ_ref, usually negative [-].
    reference_temperature : float
        Where the change begins, T_ref [°C].
    temperature_span : float
        Over how many kelvin it takes place, ΔT, ≥ 0 [K].
    """

    reference_friction: float
    friction_change: float
    reference_temperature: float
    temperature_span: float


def thermal_friction(parameters: ThermalFriction, slip_speed: float, temperature: float) -> float:
    """Friction coefficient that changes linearly with the temperature of the contact.

    Choose it for high creepage, where the flash temperature reaches hundreds of degrees: then the
    falling branch follows from the heat and needs no fall with the slip speed.

    Parameters
    ----------
    parameters : ThermalFriction
        The two ends of the change.
    slip_speed : float
        Magnitude of the slip speed, not used [m/s].
    temperature : float
        Temperature of the contact, flash temperature included [°C].

    Returns
    -------
    float
        Friction coefficient, between μ_ref and μ_ref + Δμ [-].

    Notes
    -----
    μ = μ_ref + Δμ min(1, max(0, (T − T_ref)/ΔT)).
    Known wrong when the third body is water or leaves, which have other reasons to change with
    temperature.

    References
    ----------
    .. [1] E. A. H. Vollebregt, User guide for CONTACT, its temperature-dependent friction.
    .. [2] M. Ertz, K. Knothe, A comparison of analytical and numerical methods for the calculation
       of temperatures in wheel/rail contact, Wear 253 (2002) 498–508.

    Checked by tests/laws/test_friction_laws.py.

    Examples
    --------
    >>> round(thermal_friction(CONTACT_EXAMPLE_OVER_1200, 0.0, 600.0), 12)
    0.235
    """
    heated = temperature - parameters.reference_temperature
    share = min(1.0, max(0.0, heated / max(parameters.temperature_span, _LEAST_SPAN)))
    return parameters.reference_friction + parameters.friction_change * share


CONTACT_EXAMPLE_OVER_1200 = ThermalFriction(0.33, -0.19, 0.0, 1200.0)
"""An example, not a measured rail: 0.33 → 0.14 over 0–1200 °C, from cases shipped with CONTACT."""

CONTACT_EXAMPLE_OVER_400 = ThermalFriction(0.33, -0.19, 0.0, 400.0)
"""An example, not a measured rail: 0.33 → 0.14 over 0–400 °C, from cases shipped with CONTACT."""

CONTACT_EXAMPLE_LOWER = ThermalFriction(0.30, -0.18, 0.0, 400.0)
"""An example, not a measured rail: 0.30 → 0.12 over 0–400 °C, from cases shipped with CONTACT."""
