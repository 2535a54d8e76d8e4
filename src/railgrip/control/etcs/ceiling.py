"""Margins above a ceiling speed (SUBSET-026, 3.13.9.2) and inaccuracy of the speed measured."""

from __future__ import annotations

from typing import Final

_KMH: Final = 1.0 / 3.6
EMERGENCY: Final = (7.5 * _KMH, 15.0 * _KMH, 110.0 * _KMH, 210.0 * _KMH)
SERVICE: Final = (5.5 * _KMH, 10.0 * _KMH, 110.0 * _KMH, 210.0 * _KMH)
WARNING: Final = (4.0 * _KMH, 5.0 * _KMH, 110.0 * _KMH, 140.0 * _KMH)


def ceiling_margin(speed: float, margins: tuple[float, float, float, float] = EMERGENCY) -> float:
    """Return how far above a ceiling speed a limit lies.

    Parameters
    ----------
    speed : float
        Ceiling, ≥ 0, [m/s].
    margins : (float, float, float, float)
        `EMERGENCY`, `SERVICE` or `WARNING`: least and greatest margin, and the speeds between
        which it grows, [m/s].

    Returns
    -------
    float
        dV_ebi, dV_sbi or dV_warning, [m/s].

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.9.2.3 and A.3.1.

    Examples
    --------
    >>> round(3.6 * ceiling_margin(160 / 3.6), 2), round(3.6 * ceiling_margin(0.0, SERVICE), 2)
    (11.25, 5.5)
    """
    least, greatest, begin, end = margins
    share = min(max((speed - begin) / (end - begin), 0.0), 1.0)
    return least + share * (greatest - least)


def speed_inaccuracy(speed: float) -> float:
    """Return how much the measured speed may be below the true one at worst.

    Parameters
    ----------
    speed : float
        Measured, ≥ 0, [m/s].

    Returns
    -------
    float
        [m/s].

    References
    ----------
    .. [1] SUBSET-041, 5.3.1.2: 2 km/h up to 30 km/h, then linear to 12 km/h at 500 km/h.

    Examples
    --------
    >>> round(3.6 * speed_inaccuracy(265 / 3.6), 6)
    7.0
    """
    kmh = 3.6 * speed
    return (2.0 + 10.0 * max(kmh - 30.0, 0.0) / 470.0) / 3.6
