"""Parameters of traction anti-slip, and where each stands in the array that its kernel reads.

All of them were chosen here, on the shipped multiple unit and locomotive, and are illustrative.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from railgrip.control.adaptive_parameters import FORCES, Supervision
from railgrip.control.contract import MACRO
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.parameter_sets import joined
from railgrip.control.slip_ranges import N_RANGED


class Driving(NamedTuple):
    """What the traction controllers need to know of wheels and train while driving, SI.

    Parameters
    ----------
    speed_noise : float
        Error of the measured wheel speed, [m/s].
    force_drift : float
        How fast the force of the rail changes, [N/s], at the observer.
    doubt_rate : float
        How fast the reference speed is doubted while all wheels spin, [m/s²]; less the more often
        the train's speed was seen.
    doubt_longest : float
        Doubt at which an axle is let run free to show the train's speed, [m/s].
    look_longest : float
        Longest time that takes, [s].
    """

    speed_noise: float = 0.02
    force_drift: float = 60.0e3
    doubt_rate: float = 0.1
    doubt_longest: float = 0.15
    look_longest: float = 1.0


class Easing(NamedTuple):
    """What the conventional control adds, SI.

    Parameters
    ----------
    spin_lower, spin_upper : float
        Slip below which torque comes back and above which it is cut, share of the reference speed.
    spin_lower_floor, spin_upper_floor : float
        Least slip speeds of the two thresholds, [m/s].
    spin_acceleration : float
        Of a wheel over the train's, beyond which torque is cut whatever the slip, [m/s²].
    cut_time : float
        Full torque to nothing, [s].
    step_to : float
        Share of the torque at breakaway that comes back in one step.
    ramp_time : float
        Nothing to full torque on the ramp behind the step, [s].
    """

    spin_lower: float = 0.02
    spin_upper: float = 0.05
    spin_lower_floor: float = 0.15
    spin_upper_floor: float = 0.4
    spin_acceleration: float = 2.5
    cut_time: float = 0.3
    step_to: float = 0.8
    ramp_time: float = 20.0


class PeakSearch(NamedTuple):
    """What the peak seeker adds, SI.

    Parameters
    ----------
    target_start : float
        Slip speed aimed at first, [m/s].
    target_least, target_least_share : float
        Its lower bound, [m/s] and as share of the reference speed; the larger counts.
    target_greatest, target_greatest_share : float
        Its upper bound, the sum of both.
    slip_gain : float
        Wheel acceleration asked for each m/s of slip speed off the target, [1/s].
    dither, dither_time : float
        How far the target is moved to and fro, as share of it, and the period, [s].
    search_mean_time : float
        Time constant of the means of slip and force, [s].
    observer_lag : float
        Lag of the observed force, which the slip is made to have too, [s].
    force_error : float
        Standard deviation of the observed force around the curve, share of its mean.
    slope_drift : float
        How fast the slope changes, [1/√s].
    search_rate : float
        Greatest change of the target as share of it, [1/s].
    search_slope : float
        Slope at which that is reached.
    search_margin : float
        Slope aimed at: above 0 the target stays a little before the peak.
    speed_forward : float
        How far the target moves with the train's speed: 1, a peak at a creepage; 0, a peak at a
        slip speed.

    Examples
    --------
    >>> PeakSearch().dither
    0.3
    """

    target_start: float = 0.6
    target_least: float = 0.15
    target_least_share: float = 0.015
    target_greatest: float = 1.0
    target_greatest_share: float = 0.2
    slip_gain: float = 4.0
    dither: float = 0.3
    dither_time: float = 1.6
    search_mean_time: float = 1.5
    observer_lag: float = 0.06
    force_error: float = 0.04
    slope_drift: float = 0.1
    search_rate: float = 1.0
    search_slope: float = 0.1
    search_margin: float = 0.02
    speed_forward: float = 0.0


class DeepSlip(NamedTuple):
    """Slip that axles in macro-slip are led to, SI; those in micro-slip seek the peak.

    Parameters
    ----------
    macro_slip, macro_slip_floor : float
        Slip speed as share of the reference speed, and its least value, [m/s].
    """

    macro_slip: float = 0.2
    macro_slip_floor: float = 2.0


ConventionalTractionParameters: Any = joined(
    "ConventionalTractionParameters", ConventionalParameters, Driving, Easing
)
"""The ordinary protection's parameters come first: it brakes, and reads them unchanged."""

PeakSeekingParameters: Any = joined(
    "PeakSeekingParameters", ConventionalParameters, Driving, PeakSearch
)

AdaptiveTractionParameters: Any = joined(
    "AdaptiveTractionParameters", ConventionalParameters, Driving, PeakSearch, DeepSlip,
    Supervision,
    rule=FORCES, start=MACRO, lead_axles=0.0, k_system=0.95, k_axle=1.0, mean_time=0.8,
    restart_after=1.0, decide_distance=4.0, test_distance=2.0, test_pause=8.0, least_axles=2.0,
)  # fmt: skip
"""Those of the peak seeker come first, the supervisor's last."""

_easing = ConventionalTractionParameters._fields.index
_search = PeakSeekingParameters._fields.index
_deep = AdaptiveTractionParameters._fields.index

SPEED_NOISE: Final = _easing("speed_noise")
FORCE_DRIFT: Final = _easing("force_drift")
DOUBT_RATE: Final = _easing("doubt_rate")
DOUBT_LONGEST: Final = _easing("doubt_longest")
LOOK_LONGEST: Final = _easing("look_longest")

SPIN_LOWER: Final = _easing("spin_lower")
SPIN_UPPER: Final = _easing("spin_upper")
SPIN_LOWER_FLOOR: Final = _easing("spin_lower_floor")
SPIN_UPPER_FLOOR: Final = _easing("spin_upper_floor")
SPIN_ACCELERATION: Final = _easing("spin_acceleration")
CUT_TIME: Final = _easing("cut_time")
STEP_TO: Final = _easing("step_to")
RAMP_TIME: Final = _easing("ramp_time")

TARGET_START: Final = _search("target_start")
TARGET_LEAST: Final = _search("target_least")
TARGET_LEAST_SHARE: Final = _search("target_least_share")
TARGET_GREATEST: Final = _search("target_greatest")
TARGET_GREATEST_SHARE: Final = _search("target_greatest_share")
SLIP_GAIN: Final = _search("slip_gain")
DITHER: Final = _search("dither")
DITHER_TIME: Final = _search("dither_time")
SEARCH_MEAN_TIME: Final = _search("search_mean_time")
OBSERVER_LAG: Final = _search("observer_lag")
FORCE_ERROR: Final = _search("force_error")
SLOPE_DRIFT: Final = _search("slope_drift")
SEARCH_RATE: Final = _search("search_rate")
SEARCH_SLOPE: Final = _search("search_slope")
SEARCH_MARGIN: Final = _search("search_margin")
SPEED_FORWARD: Final = _search("speed_forward")

MACRO_SLIP: Final = _deep("macro_slip")
MACRO_SLIP_FLOOR: Final = _deep("macro_slip_floor")
SUPERVISION: Final = _deep("supervise_every") - N_RANGED
"""Seen from here on, the parameters of `Supervision` stand where `adaptive_parameters` has them."""
