"""Friction that falls exponentially, told by the slip speed at which half of the fall is done."""

import math
from typing import NamedTuple

from railgrip.contact.rail_friction import RailFriction
from railgrip.core.formulas.elementary import exp_decay

_LN_2 = 0.6931471805599453
_LEAST_SPEED = 1e-12


class HalfValueFriction(NamedTuple):
    """Parameters of the exponential fall as the program CONTACT writes them.

    Parameters
    ----------
    kinetic_friction : float
        Friction coefficient at a very high slip speed μ_kin, ≥ 0 [-].
    excess_friction : float
        What the friction has above it as the slip speed goes to zero, μ_1, ≥ 0 [-].
    half_speed : float
        Slip speed at which half of the excess is gone, s_h, ≥ 0, `inf` for no fall [m/s].
    """

    kinetic_friction: float
    excess_friction: float
    half_speed: float


def half_value_friction(
    parameters: HalfValueFriction, slip_speed: float, temperature: float
) -> float:
    """Friction coefficient that falls exponentially with the slip speed, by its half-value speed.

    Choose it where the parameters come from CONTACT; `exponential_friction` is the same curve.

    Parameters
    ----------
    parameters : HalfValueFriction
        The coefficients and the half-value speed.
    slip_speed : float
        Magnitude of the slip speed, ≥ 0 [m/s].
    temperature : float
        Temperature of the contact, not used [°C].

    Returns
    -------
    float
        Friction coefficient, falling from μ_kin + μ_1 to μ_kin [-].

    Notes
    -----
    μ = μ_kin + μ_1 2^(−w/s_h). CONTACT applies it in each point of the patch to the slip there;
    here one slip speed serves the whole patch.

    References
    ----------
    .. [1] E. A. H. Vollebregt, User guide for CONTACT, its exponential falling friction.

    Checked by tests/laws/test_friction_laws.py: the conversions, 1e-12.

    Examples
    --------
    >>> round(half_value_friction(HalfValueFriction(0.2, 0.1, 0.5), 0.5, 20.0), 12)
    0.25
    """
    halves = slip_speed / max(parameters.half_speed, _LEAST_SPEED)
    fall = exp_decay(_LN_2 * halves)
    return parameters.kinetic_friction + parameters.excess_friction * fall


def half_value_from_polach(rail: RailFriction) -> HalfValueFriction:
    """Return Polach's friction in CONTACT's form: μ_kin = A μ0, μ_1 = (1 − A) μ0, s_h = ln 2/B.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> [round(value, 4) for value in half_value_from_polach(DRY_POLACH_2005)]
    [0.22, 0.33, 1.1552]
    """
    kinetic = rail.friction_ratio * rail.static_friction
    half_speed = _LN_2 / rail.friction_decay if rail.friction_decay > 0.0 else math.inf
    return HalfValueFriction(
        kinetic, (1.0 - rail.friction_ratio) * rail.static_friction, half_speed
    )


def polach_from_half_value(
    parameters: HalfValueFriction, adhesion_reduction: float, slip_reduction: float
) -> RailFriction:
    """Return CONTACT's friction in Polach's form; k_A and k_S, which CONTACT lacks, are added.

    Examples
    --------
    >>> rail = polach_from_half_value(HalfValueFriction(0.22, 0.33, 1.1552), 1.0, 0.4)
    >>> [round(value, 4) for value in rail]
    [0.55, 0.4, 0.6, 1.0, 0.4]
    """
    static = parameters.kinetic_friction + parameters.excess_friction
    ratio = parameters.kinetic_friction / static if static > 0.0 else 1.0
    decay = _LN_2 / max(parameters.half_speed, _LEAST_SPEED)
    return RailFriction(static, ratio, decay, adhesion_reduction, slip_reduction)
