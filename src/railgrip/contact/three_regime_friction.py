"""Static friction, falling kinetic friction, and its renewed rise (figure 1.1 of Čáp 2000)."""

from typing import NamedTuple

from railgrip.core.formulas.elementary import exp_decay

_LEAST_SPEED = 1e-12
_MOST_SPEEDS = 1e6


class ThreeRegimeFriction(NamedTuple):
    """Friction in three regimes of slip speed.

    Parameters
    ----------
    static_friction : float
        Friction coefficient as the slip speed goes to zero, φ_s, ≥ 0 [-].
    kinetic_friction : float
        What it falls to, φ_k, 0 … φ_s [-].
    falling_speed : float
        Slip speed at which 1/e of the fall is left, w_f, ≥ 0 [m/s]; 0 for the idealised step.
    vibration_rise : float
        What asperity vibration adds at a very high slip speed, ≥ 0 [-].
    vibration_speed : float
        Slip speed at which half of that is added, w_v, ≥ 0 [m/s]; `inf` for no rise.
    """

    static_friction: float
    kinetic_friction: float
    falling_speed: float
    vibration_rise: float
    vibration_speed: float


def three_regime_friction(
    parameters: ThreeRegimeFriction, slip_speed: float, temperature: float
) -> float:
    """Friction coefficient with a static, a falling and a rising regime over the slip speed.

    Choose it to study what a renewed rise at high slip speed would do to a slide. The source draws
    the rise without numbers, so size and place of it are the user's.

    Parameters
    ----------
    parameters : ThreeRegimeFriction
        Coefficients and speeds of the three regimes.
    slip_speed : float
        Magnitude of the slip speed, ≥ 0 [m/s].
    temperature : float
        Temperature of the contact, not used [°C].

    Returns
    -------
    float
        Friction coefficient, between φ_k and φ_s + rise [-].

    Notes
    -----
    φ = φ_k + (φ_s − φ_k) e^(−w/w_f) + Δφ z/(1 + z), z = (w/w_v)⁴.
    The fourth power keeps the regimes apart: at a third of w_v the rise is 1 % of Δφ. The source
    gives the shape as a sketch only; this formula for it is ours. Without the rise it is
    `exponential_friction` with A = φ_k/φ_s and B = 1/w_f.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       figure 1.1 and the text below it.

    Checked by tests/laws/test_friction_laws.py.

    Examples
    --------
    >>> round(three_regime_friction(ILLUSTRATIVE_THREE_REGIMES, 20.0, 20.0), 6)
    0.245
    """
    fallen = slip_speed / max(parameters.falling_speed, _LEAST_SPEED)
    above = parameters.static_friction - parameters.kinetic_friction
    z = min(_MOST_SPEEDS, slip_speed / max(parameters.vibration_speed, _LEAST_SPEED))
    z = z * z
    z = z * z
    rise = parameters.vibration_rise * (z / (1.0 + z))
    return parameters.kinetic_friction + above * exp_decay(fallen) + rise


ILLUSTRATIVE_THREE_REGIMES = ThreeRegimeFriction(0.40, 0.22, 1.5, 0.05, 20.0)
"""Illustrative: chosen to show the three regimes of the sketch, from no measurement."""
