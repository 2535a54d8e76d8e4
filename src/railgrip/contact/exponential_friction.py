"""Friction that falls exponentially with the slip speed, in the contract of the friction laws."""

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction


def exponential_friction(parameters: RailFriction, slip_speed: float, temperature: float) -> float:
    """Friction coefficient that falls exponentially with the slip speed (Polach 2005).

    Choose it for braking and traction at the adhesion limit; it is the friction of the plant, bit
    for bit. `half_value_friction` is the same curve with other parameters.

    Parameters
    ----------
    parameters : RailFriction
        State of the rail; k_A and k_S belong to the creep law and are not used.
    slip_speed : float
        Magnitude of the slip speed, ≥ 0 [m/s].
    temperature : float
        Temperature of the contact, not used [°C].

    Returns
    -------
    float
        Friction coefficient, falling from μ0 to A μ0 [-].

    Notes
    -----
    μ = μ0 [(1 − A) e^(−B w) + A], from `falling_friction`.

    References
    ----------
    .. [1] O. Polach, Wear 258 (2005) 992–1000, doi:10.1016/j.wear.2004.03.046.

    Checked by tests/laws/test_friction_laws.py.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> round(exponential_friction(DRY_POLACH_2005, 0.2, 20.0), 6)
    0.512684
    """
    return falling_friction(parameters, slip_speed)
