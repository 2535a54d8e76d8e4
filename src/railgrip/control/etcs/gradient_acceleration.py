"""Acceleration by the gradient under a train (SUBSET-026, 3.13.4)."""

from __future__ import annotations

from typing import Final

from railgrip.control.etcs.steps import Steps

GRAVITY: Final = 9.81
"""As SUBSET-026 has it, m/s²."""
MOST_ROTATING: Final = 0.15
"""Rotating mass taken uphill where the nominal one is not known."""
LEAST_ROTATING: Final = 0.02
"""Rotating mass taken downhill where the nominal one is not known."""


def gradient_under_train(gradient: Steps, length: float) -> Steps:
    """Return the least gradient under the train over the position of its front.

    Parameters
    ----------
    gradient : Steps
        Over the position, uphill positive, [1]; the first and the last go on for ever.
    length : float
        Of the train, ≥ 0, [m].

    Returns
    -------
    Steps
        Over the position of the front, [1].

    Notes
    -----
    A gradient is under the train from where it begins until a train's length behind its end, so
    the result breaks where gradients begin and a length later.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.4.2.

    Checked by tests/reference/etcs_era_tool.

    Examples
    --------
    >>> gradient_under_train(Steps((0.0, 1000.0), (-0.01, 0.005)), 400.0)
    Steps(begins=(0.0, 1000.0, 1400.0), values=(-0.01, -0.01, 0.005))
    """
    begins = sorted({*gradient.begins, *(begin + length for begin in gradient.begins[1:])})
    values = []
    for front in begins:
        # A gradient that ends just at the rear is no longer under the train.
        inside = [gradient.at(front - length), gradient.at(front)]
        inside += [
            value
            for begin, value in zip(gradient.begins, gradient.values, strict=True)
            if front - length < begin <= front
        ]
        values.append(min(inside))
    return Steps(tuple(begins), tuple(values))


def gradient_acceleration(gradient: float, rotating_mass: float | None = None) -> float:
    """Return the deceleration that a gradient adds to the brake's.

    Parameters
    ----------
    gradient : float
        Uphill positive, [1].
    rotating_mass : float, optional
        Share of the mass, ≥ 0, [1]; without it the unfavourable fixed value is taken.

    Returns
    -------
    float
        A_gradient, negative downhill, [m/s²].

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.4.3 and A.3.1.

    Examples
    --------
    >>> round(gradient_acceleration(-0.009), 4), round(gradient_acceleration(0.007), 5)
    (-0.0866, 0.05971)
    """
    if rotating_mass is None:
        rotating_mass = MOST_ROTATING if gradient > 0.0 else LEAST_ROTATING
    return GRAVITY * gradient / (1.0 + rotating_mass)
