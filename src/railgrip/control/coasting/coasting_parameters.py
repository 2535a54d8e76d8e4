"""Parameters of the coasting-initiation law, and what is wrong with a set of them."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.core.errors import Problem, RailgripError, unknown_name

SHAPES: Final = ("parabolic", "straight")
ACTIONS: Final = ("cut", "reduced", "light braking")
SWITCHES: Final = ("hand", "control", "both")
AT_STATIONS: Final = ("accelerate", "hold")


class CoastingParameters(NamedTuple):
    """What a coasting-initiation law is set to.

    Parameters
    ----------
    braking : float
        b of the braking curve, > 0, [m/s²].
    shape : {"parabolic", "straight"}
        Of the coasting-initiation curve.
    coasting_deceleration : float
        b_ALK of the parabolic one, 0 < b_ALK < b, [m/s²].
    distance_gain, speed_gain : float
        k1 > 0 [1/s] and k2 ≥ 1 of the straight one.
    hysteresis : float
        Δ > 0, [m/s].
    action : {"cut", "reduced", "light braking"}
        What happens above the curve.
    reduced_share : float
        Share of the effort at that speed, 0 to 1.
    light_deceleration : float
        Of light braking, on top of the running resistance, > 0, [m/s²].
    least_speed : float
        v_min: below it the law is off until v_min + Δ, ≥ 0, [m/s].
    station_distance : float
        z_st: so near a stop the law is off, ≥ 0, [m].
    at_station : {"accelerate", "hold"}
        What the train may do there.
    switch : {"hand", "control", "both"}
        Who switches the law on; "both": only together.
    flat_braking : float
        b_flat: braking curves with b below it are flat, ≥ 0, [m/s²].
    knee_speed, lift : float
        v_knee [m/s] and k_h ≥ 0 of the raised curve.
    """

    braking: float
    shape: str = "parabolic"
    coasting_deceleration: float = 0.1
    distance_gain: float = 0.01
    speed_gain: float = 1.0
    hysteresis: float = 1.0
    action: str = "cut"
    reduced_share: float = 0.3
    light_deceleration: float = 0.1
    least_speed: float = 0.0
    station_distance: float = 0.0
    at_station: str = "accelerate"
    switch: str = "control"
    flat_braking: float = 0.0
    knee_speed: float = 0.0
    lift: float = 0.0


def check_coasting(
    parameters: CoastingParameters, brake_on_steepest_fall: float | None = None
) -> None:
    """Refuse parameters with which the law has no meaning.

    Parameters
    ----------
    parameters : CoastingParameters
        To be checked.
    brake_on_steepest_fall : float, optional
        What the brake gives on the steepest fall of the line, [m/s²].

    Raises
    ------
    RailgripError
        All problems at once: ``coasting_deceleration: must be above 0 and below braking; got …``

    Examples
    --------
    >>> check_coasting(CoastingParameters(0.7))
    >>> check_coasting(CoastingParameters(0.7, shape="strait"))
    Traceback (most recent call last):
    railgrip.core.errors.RailgripError: shape: curve 'strait' unknown; known: parabolic, straight; \
did you mean 'straight'?
    """
    p = parameters
    words = (
        ("shape", "curve", p.shape, SHAPES),
        ("action", "action", p.action, ACTIONS),
        ("switch", "switch", p.switch, SWITCHES),
        ("at_station", "behaviour", p.at_station, AT_STATIONS),
    )
    problems = [unknown_name(*row) for row in words if row[2] not in row[3]]
    numbers = (
        ("braking", p.braking > 0.0, "must be above 0", p.braking, "m/s²"),
        ("coasting_deceleration", 0.0 < p.coasting_deceleration < p.braking
         or p.shape == "straight", "must be above 0 and below braking",
         p.coasting_deceleration, "m/s²"),
        ("distance_gain", p.distance_gain > 0.0, "must be above 0", p.distance_gain, "1/s"),
        ("speed_gain", p.speed_gain >= 1.0, "must be at least 1", p.speed_gain, ""),
        ("hysteresis", p.hysteresis > 0.0, "must be above 0", p.hysteresis, "m/s"),
        ("reduced_share", 0.0 <= p.reduced_share <= 1.0, "must be 0 to 1", p.reduced_share, ""),
        ("light_deceleration", p.light_deceleration > 0.0, "must be above 0",
         p.light_deceleration, "m/s²"),
        ("least_speed", p.least_speed >= 0.0, "must not be negative", p.least_speed, "m/s"),
        ("station_distance", p.station_distance >= 0.0, "must not be negative",
         p.station_distance, "m"),
        ("lift", p.lift >= 0.0, "must not be negative", p.lift, ""),
    )  # fmt: skip
    problems += [
        Problem(name, what, got=f"{value:g} {unit}".rstrip())
        for name, is_good, what, value, unit in numbers if not is_good
    ]  # fmt: skip
    if brake_on_steepest_fall is not None and p.braking > brake_on_steepest_fall:
        what = "the brake does not give it on the steepest fall of the line"
        allowed = f"up to {brake_on_steepest_fall:.3g} m/s²"
        problems.append(Problem("braking", what, f"{p.braking:g} m/s²", allowed))
    if problems:
        raise RailgripError(problems)
