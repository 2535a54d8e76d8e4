"""Pad friction as a product of three straight-line factors: temperature, speed, force."""

from typing import NamedTuple

from railgrip.core.formulas.piecewise_linear import Hinges, piecewise_linear


class PiecewiseFriction(NamedTuple):
    """A pad by its friction at a reference point and three factors that are 1 there.

    Parameters
    ----------
    reference_friction : float
        Friction at the reference point (100 °C, 15 m/s, 25 kN), ≥ 0 [-].
    temperature : Hinges
        Factor against the disc temperature [°C], > 0.
    speed : Hinges
        Factor against the rubbing speed [m/s], > 0.
    clamp_force : Hinges
        Factor against the clamp force [N], > 0.
    """

    reference_friction: float
    temperature: Hinges
    speed: Hinges
    clamp_force: Hinges


def piecewise_friction(
    params: PiecewiseFriction, clamp_force: float, rubbing_speed: float, disc_temperature: float
) -> float:
    """Friction of a disc brake pad as f0 · f1(T) · f2(v) · f3(F).

    Choose it for discs with measured fading: dynamometer curves go in as they are, up to four
    points each.

    Parameters
    ----------
    params : PiecewiseFriction
        The pad.
    clamp_force : float
        Clamp force [N].
    rubbing_speed : float
        Speed of the disc under the pad [m/s].
    disc_temperature : float
        Temperature of the friction ring [°C].

    Returns
    -------
    float
        Friction coefficient [-].

    Notes
    -----
    Known wrong when the factors do not separate (glazing, a wet first stop).

    Examples
    --------
    >>> from railgrip.core.formulas.piecewise_linear import hinges_from_points
    >>> pad = PiecewiseFriction(
    ...     0.37,
    ...     hinges_from_points([(150.0, 1.0), (350.0, 0.8)]),
    ...     hinges_from_points([(0.0, 1.08), (10.0, 1.0), (15.0, 1.0), (55.0, 0.88)]),
    ...     hinges_from_points([(25e3, 1.0)]),
    ... )
    >>> round(piecewise_friction(pad, 25e3, 35.0, 250.0), 6)
    0.31302
    """
    warmth = piecewise_linear(params.temperature, disc_temperature)
    speed = piecewise_linear(params.speed, rubbing_speed)
    force = piecewise_linear(params.clamp_force, clamp_force)
    return params.reference_friction * warmth * speed * force
