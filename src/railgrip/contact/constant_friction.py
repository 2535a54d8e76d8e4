"""Friction that depends on nothing (Coulomb)."""

from typing import NamedTuple


class ConstantFriction(NamedTuple):
    """Friction with one coefficient.

    Parameters
    ----------
    coefficient : float
        Friction coefficient φ, ≥ 0 [-].
    """

    coefficient: float


def constant_friction(parameters: ConstantFriction, slip_speed: float, temperature: float) -> float:
    """Friction coefficient, the same at every slip speed and temperature.

    Choose it to compare laws of rolling contact with theories, which know no other friction. A rail
    that brakes a train has a falling branch: take `exponential_friction`.

    Parameters
    ----------
    parameters : ConstantFriction
        The coefficient.
    slip_speed : float
        Magnitude of the slip speed, not used [m/s].
    temperature : float
        Temperature of the contact, not used [°C].

    Returns
    -------
    float
        Friction coefficient, ≥ 0 [-].

    Notes
    -----
    The idealised line of figure 1.1 in [1], past the static value.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 1.2.

    Checked by tests/laws/test_friction_laws.py.

    Examples
    --------
    >>> constant_friction(ConstantFriction(0.3), 2.0, 20.0)
    0.3
    """
    return parameters.coefficient
