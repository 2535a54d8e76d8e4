"""What a dynamic brake can do at a speed: force, power, and its end at low speed."""

from typing import NamedTuple


class DynamicBrake(NamedTuple):
    """The dynamic brake of one motored axle.

    Parameters
    ----------
    force : float
        Greatest force at the tread, ≥ 0 [N].
    power : float
        Greatest power at the tread, ≥ 0 [W].
    fade_start, fade_end : float
        Wheel speeds between which the force falls to zero, start ≥ end ≥ 0 [m/s].
    """

    force: float
    power: float
    fade_start: float
    fade_end: float


def dynamic_brake_limit(brake: DynamicBrake, wheel_speed: float) -> float:
    """Greatest force of the dynamic brake of one axle.

    Parameters
    ----------
    brake : DynamicBrake
        The brake.
    wheel_speed : float
        Speed at the tread [m/s]; a wheel that stands or turns backwards gets no force.

    Returns
    -------
    float
        Greatest force at the tread, ≥ 0 [N].

    Notes
    -----
    min(force, power/v), times a straight line from 0 at `fade_end` to 1 at `fade_start`.

    Examples
    --------
    >>> dynamic_brake_limit(DynamicBrake(30e3, 500e3, 2.8, 1.4), 25.0)
    20000.0
    """
    by_power = brake.power / max(wheel_speed, 1e-3)
    width = max(brake.fade_start - brake.fade_end, 1e-6)
    fade = max(0.0, min(1.0, (wheel_speed - brake.fade_end) / width))
    return min(brake.force, by_power) * fade
