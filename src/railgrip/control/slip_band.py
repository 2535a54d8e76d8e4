"""The slip band: from slip speed and wheel acceleration to the wish of one axle."""

from __future__ import annotations

from typing import Final

from railgrip.control.contract import FILL, HOLD, VENT, FloatArray
from railgrip.control.conventional_state import ADHERED_CLOCK, SLIDES
from railgrip.core.formulas.choosing import choose

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
    lead_time: float,
    slip_speed: float,
    relative_acceleration: float,
    lower: float,
    upper: float,
) -> float:
    """Return FILL, HOLD or VENT, as the slip speed foreseen lies in the band.

    Parameters
    ----------
    lead_time : float
        How far ahead the slip speed is foreseen, [s].
    slip_speed : float
        Reference speed less wheel speed, [m/s].
    relative_acceleration : float
        Of the wheel against the train, negative while the slide deepens, [m/s²].
    lower, upper : float
        Slip speeds at the thresholds, [m/s].

    Examples
    --------
    >>> wish(0.2, 2.0, -5.0, 1.6, 3.2)
    1.0
    """
    foreseen = slip_speed - lead_time * relative_acceleration
    wished = choose(foreseen < lower, FILL, HOLD)
    return choose(foreseen > upper, VENT, wished)


def note_slide(
    state: FloatArray, base: int, wished: float, slip_speed: float, lower: float, dt: float
) -> None:
    """Update in the state whether the axle slides, and since when it adheres."""
    adheres = (wished == FILL) & (slip_speed < lower)
    clock = choose(adheres, state[base + ADHERED_CLOCK] + dt, 0.0)
    slides = choose(clock > ADHERES_AFTER, 0.0, state[base + SLIDES])
    state[base + ADHERED_CLOCK] = clock
    state[base + SLIDES] = choose(wished == VENT, 1.0, slides)
