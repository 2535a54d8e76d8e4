"""Magnetic track brake: a force on the train that needs no adhesion of the wheels."""

from typing import NamedTuple


class TrackBrake(NamedTuple):
    """The magnetic track brake of one vehicle.

    Parameters
    ----------
    force : float
        Attraction of all magnets of the vehicle to the rail, ≥ 0 [N].
    friction : float
        Friction of the pole shoes at walking pace, ≥ 0 [-]; the default is illustrative.
    friction_fall : float
        How quickly it falls with the speed, ≥ 0 [s/m]; the default is illustrative.
    release_speed : float
        The magnets are off at this speed and below, ≥ 0 [m/s].
    """

    force: float
    friction: float = 0.2
    friction_fall: float = 0.02
    release_speed: float = 0.0


def track_brake_force(brake: TrackBrake, train_speed: float) -> float:
    """Retarding force of the magnetic track brake of one vehicle, fully energised.

    Choose it for the steady force; the time to lower and energise the magnets is the caller's.

    Parameters
    ----------
    brake : TrackBrake
        The brake.
    train_speed : float
        Speed, ≥ 0 [m/s].

    Returns
    -------
    float
        Magnitude of the force, ≥ 0 [N].

    Notes
    -----
    F = N μ/(1 + b v) above the release speed, else 0.
    Known wrong when the magnets clean the rail for the wheels behind them, or the rail is icy.

    Examples
    --------
    >>> round(track_brake_force(TrackBrake(80e3), 50.0))
    8000
    """
    switched = 1.0 if train_speed > brake.release_speed else 0.0
    return switched * brake.force * brake.friction / (1.0 + brake.friction_fall * train_speed)
