"""Friction of a brake block that falls with force and speed (Karwatzki)."""

from typing import NamedTuple


class KarwatzkiParameters(NamedTuple):
    """Constants of Karwatzki's formula for one block material.

    The default is the composition block of the 90 t wagon in the EN 14531 literature, written in
    SI: 0.055 (F + 200)/(F + 50) · (v + 150)/(v + 75) with F in kN and v in km/h.

    Parameters
    ----------
    base : float
        Friction at great force and speed [-].
    force_high, force_low : float
        Force added above and below the line of the fraction, > 0 [N].
    speed_high, speed_low : float
        Speed added above and below it, > 0 [m/s].
    """

    base: float = 0.055
    force_high: float = 200e3
    force_low: float = 50e3
    speed_high: float = 150.0 / 3.6
    speed_low: float = 75.0 / 3.6


def karwatzki_1950(
    params: KarwatzkiParameters, clamp_force: float, rubbing_speed: float, disc_temperature: float
) -> float:
    """Friction of one brake block on the wheel tread (Karwatzki 1950).

    Choose it for tread brakes: it gives the friction that rises towards the end of a stop.

    Parameters
    ----------
    params : KarwatzkiParameters
        Constants of the block.
    clamp_force : float
        Force of one block, ≥ 0 [N].
    rubbing_speed : float
        Speed of the tread under the block, ≥ 0 [m/s].
    disc_temperature : float
        Not used; it is there because every law of pad friction has it.

    Returns
    -------
    float
        Friction coefficient, > 0 [-].

    Notes
    -----
    μ = base (F + F_high)/(F + F_low) · (v + v_high)/(v + v_low).
    Known wrong when the block is wet or hot.

    References
    ----------
    .. [1] Karwatzki 1950, the form as textbooks of running dynamics give it; original not seen.

    Checked by tests/reference/karwatzki_block, 1e-12.

    Examples
    --------
    >>> round(karwatzki_1950(KarwatzkiParameters(), 20e3, 100 / 3.6, 20.0), 6)
    0.246939
    """
    above = (clamp_force + params.force_high) * (rubbing_speed + params.speed_high)
    below = (clamp_force + params.force_low) * (rubbing_speed + params.speed_low)
    return params.base * above / below
