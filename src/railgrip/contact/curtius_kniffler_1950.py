"""Adhesion that traction can count on, over the speed of the train (Curtius and Kniffler 1950)."""

import math

from railgrip.core.formulas.elementary import exp_decay

_SQRT_3 = 1.7320508075688772
_TAIL = 0.4
_EDGE = 0.5 * _SQRT_3 - _TAIL


def curtius_kniffler_1950(speed: float, floor: float = 0.161) -> float:
    """Greatest adhesion of driven wheels on dry rail at a speed of the train.

    Choose it to size traction and to compare with tables: a mean of measurements, not a law of
    contact. It knows neither creepage nor load.

    Parameters
    ----------
    speed : float
        Speed of the train, ≥ 0 [m/s].
    floor : float
        Adhesion that is left at very high speed [-]: 0.161 on dry rail. A variant with 0.130 for
        wet rail (`WET_FLOOR`) is known from a secondary source only.

    Returns
    -------
    float
        Adhesion [-].

    Notes
    -----
    μ = 7.5/(V + 44) + 0.161, V in km/h.
    Known wrong when the rail is contaminated, and for brakes: on leaves it is too high by far.

    References
    ----------
    .. [1] E. W. Curtius, A. Kniffler, Neue Erkenntnisse über die Haftung zwischen Treibrad und
       Schiene, Elektrische Bahnen 21 (1950), as quoted by the manual of Open Rails.

    Checked by tests/unit/contact/test_curtius_kniffler_1950.py, 5e-5 (the digits of the table).

    Examples
    --------
    >>> [round(curtius_kniffler_1950(v / 3.6), 4) for v in (0, 50, 100, 200)]
    [0.3315, 0.2408, 0.2131, 0.1917]
    """
    return 7.5 / (3.6 * speed + 44.0) + floor


WET_FLOOR = 0.130
"""Floor for wet rail; a note in a public project, unverified."""


def pacha(x: float) -> float:
    """Traction used over the greatest possible, as a function of relative slip.

    Choose it with `curtius_kniffler_1950` for a quick traction curve when nothing of the contact
    is known; its peak is where the user puts it.

    Parameters
    ----------
    x : float
        Slip speed over the slip speed of the peak, any sign [-].

    Returns
    -------
    float
        u/u_m, −1 … 1 [-]: 1 at x = 1, tending to 0.4 beyond.

    Notes
    -----
    u/u_m = 2x/(1 + x²) up to |x| = √3; beyond, 0.4 + (√3/2 − 0.4) e^(−(|x| − √3)/(4 (√3/2 − 0.4))),
    whose decay makes the slope continuous, −1/4 at the joint.

    References
    ----------
    .. [1] The form named after Pacha, with an exponential tail to 0.4, as in Open Rails' manual;
       the original was not at hand.

    Checked by tests/unit/contact/test_curtius_kniffler_1950.py.

    Examples
    --------
    >>> pacha(1.0), round(pacha(-3.0), 4)
    (1.0, -0.6361)
    """
    t = abs(x)
    if t <= _SQRT_3:
        return 2.0 * x / (1.0 + x * x)
    return math.copysign(_TAIL + _EDGE * exp_decay((t - _SQRT_3) / (4.0 * _EDGE)), x)
