"""Pad friction that is always the same."""

from typing import NamedTuple


class ConstantFriction(NamedTuple):
    """A pad or block whose mean friction is all that is known.

    Parameters
    ----------
    friction : float
        Friction coefficient, ≥ 0 [-].
    """

    friction: float


def constant_friction(
    params: ConstantFriction, clamp_force: float, rubbing_speed: float, disc_temperature: float
) -> float:
    """Friction of a pad or block: a constant.

    Choose it for calculations after EN 14531, which use one mean friction for the whole stop.

    Parameters
    ----------
    params : ConstantFriction
        The friction.
    clamp_force, rubbing_speed, disc_temperature : float
        Not used; they are there because every law of pad friction has them.

    Returns
    -------
    float
        Friction coefficient [-].

    Examples
    --------
    >>> constant_friction(ConstantFriction(0.35), 25e3, 15.0, 100.0)
    0.35
    """
    return params.friction
