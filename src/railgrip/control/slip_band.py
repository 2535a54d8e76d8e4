"""The slip band: from slip speed and wheel acceleration to the wish of one axle."""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FILL, HOLD, VENT, FloatArray
from railgrip.control.conventional_parameters import LEAD_TIME
from railgrip.control.conventional_state import ADHERED_CLOCK, SLIDES

ADHERES_AFTER: Final = 0.3
"""A slide has ended when slip stayed under the lower threshold so long, s."""


def threshold(share: float, floor: float, reference: float) -> float:
    """Return the slip speed at a threshold: a share of the reference speed, with a floor, [m/s].

    Examples
    --------
    >>> threshold(0.16, 0.25, 40.0), threshold(0.16, 0.25, 1.0)
    (6.4, 0.25)
    """
    return max(floor, share * reference)


def wish(
    parameters: FloatArray,
    slip_speed: float,
    relative_acceleration: float,
    lower: float,
    upper: float,
) -> float:
    """Return FILL, HOLD or VENT, as the slip speed foreseen lies in the band.

    Parameters
    ----------
    parameters : ndarray
        As in the controller contract.
    slip_speed : float
        Reference speed less wheel speed, [m/s].
    relative_acceleration : float
        Of the wheel against the train, negative while the slide deepens, [m/s²].
    lower, upper : float
        Slip speeds at the thresholds, [m/s].

    Examples
    --------
    >>> from railgrip.control.conventional_parameters import ConventionalParameters
    >>> wish(ConventionalParameters(), 2.0, -5.0, 1.6, 3.2)
    1.0
    """
    foreseen = slip_speed - parameters[LEAD_TIME] * relative_acceleration
    if foreseen > upper:
        return VENT
    if foreseen < lower:
        return FILL
    return HOLD


def note_slide(
    state: FloatArray, base: int, wished: float, slip_speed: float, lower: float, dt: float
) -> None:
    """Update in the state whether the axle slides, and since when it adheres."""
    if wished == FILL and slip_speed < lower:
        state[base + ADHERED_CLOCK] += dt
        if state[base + ADHERED_CLOCK] > ADHERES_AFTER:
            state[base + SLIDES] = 0.0
    else:
        state[base + ADHERED_CLOCK] = 0.0
        if wished == VENT:
            state[base + SLIDES] = 1.0
