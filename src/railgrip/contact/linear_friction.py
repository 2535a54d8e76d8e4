"""Friction that falls linearly with the slip speed, down to a floor."""

from typing import NamedTuple

_LEAST_SPEED = 1e-12


class LinearFriction(NamedTuple):
    """A straight fall of the friction between two slip speeds.

    Parameters
    ----------
    static_friction : float
        Friction coefficient as the slip speed goes to zero, μ0, ≥ 0 [-].
    kinetic_friction : float
        Friction coefficient from the floor speed on, μ_k, ≥ 0 [-].
    floor_speed : float
        Slip speed where the floor is reached, w_k, ≥ 0 [m/s].
    """

    static_friction: float
    kinetic_friction: float
    floor_speed: float


def linear_friction(parameters: LinearFriction, slip_speed: float, temperature: float) -> float:
    """Friction coefficient that falls linearly with the slip speed, down to a floor.

    Choose it where two measured points are all that is known. Its kink at the floor shows in the
    creep curve; `exponential_friction` has none.

    Parameters
    ----------
    parameters : LinearFriction
        The two coefficients and the floor speed.
    slip_speed : float
        Magnitude of the slip speed, ≥ 0 [m/s].
    temperature : float
        Temperature of the contact, not used [°C].

    Returns
    -------
    float
        Friction coefficient, from μ0 to μ_k [-].

    Notes
    -----
    μ = μ_k + (μ0 − μ_k) max(0, 1 − w/w_k).
    With w_k = 1/B it has the initial tangent of `exponential_friction` and lies below it.

    References
    ----------
    .. [1] E. A. H. Vollebregt, User guide for CONTACT, which has a linear fall among its friction
       laws; the parameters here are the two ends of the line.

    Checked by tests/laws/test_friction_laws.py.

    Examples
    --------
    >>> round(linear_friction(LinearFriction(0.3, 0.1, 2.0), 0.5, 20.0), 12)
    0.25
    """
    fallen = slip_speed / max(parameters.floor_speed, _LEAST_SPEED)
    above = parameters.static_friction - parameters.kinetic_friction
    return parameters.kinetic_friction + above * max(0.0, 1.0 - fallen)
