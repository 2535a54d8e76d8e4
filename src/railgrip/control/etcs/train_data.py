"""What the supervision knows of train, target and track (SUBSET-026, 3.13.2)."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.etcs.deceleration_field import NO_CAP, NO_CORRECTION
from railgrip.control.etcs.steps import Steps, combined

REDUCED_ADHESION: Final = {"passenger P with magnets": 1.0, "passenger P": 0.7, "freight": 0.7}
"""Default national values A_NVMAXREDADH1 to 3, m/s²."""


class Brakes(NamedTuple):
    """Brake model of a train for one target.

    Parameters
    ----------
    safe : Steps
        A_brake_safe over the speed, correction factors included, [m/s²].
    service : Steps
        A_brake_service over the speed, [m/s²].
    emergency_time, service_time : float
        T_be with Kt, T_bs, ≥ 0, [s].
    normal_service : Steps, optional
        A_brake_normal_service over the speed; without it there is no guidance curve, [m/s²].
    uphill, downhill : Steps
        Kn+ and Kn− over the speed, [m/s²].
    """

    safe: Steps
    service: Steps
    emergency_time: float
    service_time: float
    normal_service: Steps | None = None
    uphill: Steps = NO_CORRECTION
    downhill: Steps = NO_CORRECTION


class SupervisedTrain(NamedTuple):
    """A train as the supervision sees it.

    Parameters
    ----------
    length : float
        [m].
    brakes : Brakes
        For the target at hand.
    rotating_mass : float, optional
        Nominal share of the mass, [1].
    commands_service_brake : bool
        Whether there is an interface to the service brake.
    cuts_traction : bool
        Whether there is an interface that cuts traction off at the warning.
    traction_cut_off_time : float
        ≥ 0, [s].
    acceleration : float
        Estimated, signed, [m/s²].
    compensates_speed : bool
        Whether the inaccuracy of the speed measured is added (not inhibited by national value).
    """

    length: float
    brakes: Brakes
    rotating_mass: float | None = None
    commands_service_brake: bool = False
    cuts_traction: bool = False
    traction_cut_off_time: float = 0.0
    acceleration: float = 0.0
    compensates_speed: bool = False


class Target(NamedTuple):
    """Where which speed must be reached.

    Parameters
    ----------
    position : float
        End of authority, or begin of the lower speed, [m].
    speed : float
        ≥ 0, [m/s].
    is_end_of_authority : bool
        Whether it is an end of authority with a supervised location; if not, a speed limit or a
        limit of authority, which may have speed 0 too.
    supervised_location : float, optional
        Of an end of authority; its own position if not given, [m].
    """

    position: float
    speed: float = 0.0
    is_end_of_authority: bool = True
    supervised_location: float | None = None


class Track(NamedTuple):
    """Gradient and reduced adhesion along the track.

    Parameters
    ----------
    gradient : Steps
        Uphill positive, [1] over [m].
    cap : Steps
        A_MAXREDADH over the position of the front, infinite where adhesion is normal, [m/s²].
    """

    gradient: Steps
    cap: Steps = NO_CAP


def safe_deceleration(
    emergency: Steps, dry: Steps, wet: Steps, available_adhesion: float = 0.0
) -> Steps:
    """Return the emergency deceleration that a train surely reaches.

    Parameters
    ----------
    emergency : Steps
        A_brake_emergency over the speed, [m/s²].
    dry : Steps
        Kdry_rst for the confidence asked, 0 to 1.
    wet : Steps
        Kwet_rst, 0 to 1.
    available_adhesion : float
        M_NVAVADH, 0 (wet) to 1 (dry).

    Returns
    -------
    Steps
        [m/s²].

    Notes
    -----
    ``A = Kdry [Kwet + M_NVAVADH (1 − Kwet)] A_brake_emergency``

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.6.2.1.4.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> safe = safe_deceleration(constant(1.2), constant(0.9), constant(0.8), 0.5)
    >>> round(safe.at(30.0), 4)
    0.972
    """
    return combined(
        lambda a, k_dry, k_wet: k_dry * (k_wet + available_adhesion * (1.0 - k_wet)) * a,
        emergency, dry, wet,
    )  # fmt: skip


def passenger_factor(
    below: Steps, above: Steps, greatest: float, pivots: tuple[float, float]
) -> Steps:
    """Return Kv_int of a passenger train, between its two tables.

    Parameters
    ----------
    below, above : Steps
        Kv_int_a and Kv_int_b over the speed.
    greatest : float
        Greatest A_brake_emergency up to the train's maximum speed, [m/s²].
    pivots : (float, float)
        A_NVP12 < A_NVP23, [m/s²].

    Returns
    -------
    Steps
        Kv_int over the speed.

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.6.2.1.8.1.

    Examples
    --------
    >>> from railgrip.control.etcs.steps import constant
    >>> round(passenger_factor(constant(0.6), constant(0.8), 1.1, (1.0, 1.2)).at(0.0), 6)
    0.7
    """
    share = min(max((greatest - pivots[0]) / (pivots[1] - pivots[0]), 0.0), 1.0)
    return combined(lambda a, b: a + share * (b - a), below, above)


def reduced_adhesion(areas: tuple[tuple[float, float], ...], length: float, cap: float) -> Steps:
    """Return A_MAXREDADH over the position of the front.

    Parameters
    ----------
    areas : tuple of (float, float)
        Begin and end of each area, in any order, [m].
    length : float
        Of the train: an area counts until the rear has left it, [m].
    cap : float
        National value for the kind of train, > 0, [m/s²].

    Returns
    -------
    Steps
        Infinite outside the areas, [m/s²].

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.5.3.

    Examples
    --------
    >>> reduced_adhesion(((1000.0, 1500.0),), 200.0, 0.7).at(1600.0)
    0.7
    """
    begins = sorted({float("-inf"), *(x for a, b in areas for x in (a, b + length))})
    inside = [any(a <= begin < b + length for a, b in areas) for begin in begins]
    return Steps(tuple(begins), tuple(cap if within else float("inf") for within in inside))
