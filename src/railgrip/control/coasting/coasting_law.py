"""Coasting-initiation law: when traction ends, is reduced, or a weak brake is applied."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

from railgrip.control.coasting.coasting_curves import braking_speed, raised_speed, straight_speed
from railgrip.control.coasting.coasting_parameters import CoastingParameters, check_coasting

NO_LIMIT: Final = 1.0e3
"""Speed of a curve where no target is announced, m/s."""
AT_THE_CURVE: Final = 1.0e-7
"""So near a curve, m/s, a speed that an event has located counts as having crossed it."""
AT_THE_TARGET: Final = 1.0e-6
"""So near, m, a target has been reached."""


class AnnouncedTarget(NamedTuple):
    """A target that the train control has announced.

    Parameters
    ----------
    position : float
        [m].
    speed : float
        v_z, ≥ 0, [m/s].
    is_station : bool
        Whether the train stops there for passengers: near it the law is off.
    """

    position: float
    speed: float = 0.0
    is_station: bool = False


class CoastingState(NamedTuple):
    """What the law remembers.

    Parameters
    ----------
    is_acting : bool
        The relay R: the speed has crossed the coasting-initiation curve.
    is_slow : bool
        The speed fell below v_min and has not yet reached v_min + Δ.
    """

    is_acting: bool = False
    is_slow: bool = False


class CoastingCommand(NamedTuple):
    """What the train does.

    Parameters
    ----------
    traction : float
        Greatest share of the effort at that speed, 0 to 1.
    brake : float
        Deceleration of the light brake on top of the running resistance, ≥ 0, [m/s²].
    holds_speed : bool
        Whether the speed is held, traction as needed.
    must_brake : bool
        Whether the braking curve is reached; it has priority.
    is_ready, is_acting : bool
        The two indicators: the law is switched on; it has taken traction away.
    """

    traction: float = 1.0
    brake: float = 0.0
    holds_speed: bool = False
    must_brake: bool = False
    is_ready: bool = False
    is_acting: bool = False


class CoastingLaw:
    """The law with its state, as a train control calls it.

    Parameters
    ----------
    parameters : CoastingParameters
        Checked when the law is made.
    brake_on_steepest_fall : float, optional
        What the brake gives on the steepest fall of the line, [m/s²].

    Raises
    ------
    RailgripError
        What `check_coasting` finds.

    Notes
    -----
    v_B and v_ALK are the least over all announced targets ahead. The action begins when the speed
    is above v_ALK and lasts until it is below v_ALK − Δ or the braking curve is met. The methods
    `above_coasting`, `above_release`, `above_braking` and so on are signed: their zeros are where
    something changes, so that a run can locate them as events.

    Known wrong when: b varies along the track; the curves take no gradient.

    References
    ----------
    .. [1] H. Übel, ES 100 730 (priority DE 26 31 540.2, 1976).

    Checked by tests/reference/coasting_figures.

    Examples
    --------
    >>> law = CoastingLaw(CoastingParameters(0.8, coasting_deceleration=0.2))
    >>> stop = [AnnouncedTarget(2000.0)]
    >>> law.coasting_speed(1000.0, stop), law.braking_speed(1000.0, stop)
    (20.0, 40.0)
    >>> law.step(1000.0, 25.0, stop).is_acting, law.step(1100.0, 17.9, stop).is_acting
    (True, False)
    """

    def __init__(
        self, parameters: CoastingParameters, brake_on_steepest_fall: float | None = None
    ) -> None:
        check_coasting(parameters, brake_on_steepest_fall)
        self.parameters = parameters
        self.state = CoastingState()

    def reset(self) -> None:
        """Forget everything."""
        self.state = CoastingState()

    def step(
        self,
        position: float,
        speed: float,
        targets: Sequence[AnnouncedTarget],
        *,
        by_hand: bool = True,
        by_control: bool = True,
    ) -> CoastingCommand:
        """Return what the train does, and remember what must be.

        Parameters
        ----------
        position, speed : float
            Of the front, [m]; ≥ 0, [m/s].
        targets : sequence of AnnouncedTarget
            Those behind the train are ignored.
        by_hand, by_control : bool
            The driver's and the train control's switch.
        """
        p = self.parameters
        ahead = targets_ahead(position, targets)
        must_brake = self.above_braking(position, speed, ahead) >= -AT_THE_CURVE
        is_slow = self._is_slow(speed)
        near_station = self.past_station_limit(position, ahead) >= -AT_THE_TARGET
        switched = {"hand": by_hand, "control": by_control, "both": by_hand and by_control}
        is_on = switched[p.switch] and not is_slow and not near_station
        is_acting = is_on and not must_brake and self._acts(position, speed, ahead)
        self.state = CoastingState(is_acting, is_slow)
        holds = near_station and switched[p.switch] and p.at_station == "hold"
        command = CoastingCommand(
            holds_speed=holds, must_brake=must_brake, is_ready=is_on, is_acting=is_acting
        )
        if not is_acting:
            return command
        share = p.reduced_share if p.action == "reduced" else 0.0
        brake = p.light_deceleration if p.action == "light braking" else 0.0
        return command._replace(traction=share, brake=brake)

    def braking_speed(self, position: float, targets: Sequence[AnnouncedTarget]) -> float:
        """Return v_B, the least over the targets, [m/s]."""
        b = self.parameters.braking
        speeds = [braking_speed(t.position - position, t.speed, b) for t in targets]
        return min(speeds, default=NO_LIMIT)

    def coasting_speed(self, position: float, targets: Sequence[AnnouncedTarget]) -> float:
        """Return v_ALK, the least over the targets and never above v_B, [m/s]."""
        speeds = [self._coasting_speed(t.position - position, t.speed) for t in targets]
        return min(speeds, default=NO_LIMIT)

    def above_coasting(
        self, position: float, speed: float, targets: Sequence[AnnouncedTarget]
    ) -> float:
        """Return the speed above the coasting-initiation curve; the action begins at 0."""
        return speed - self.coasting_speed(position, targets)

    def above_release(
        self, position: float, speed: float, targets: Sequence[AnnouncedTarget]
    ) -> float:
        """Return the speed above the curve less Δ; the action ends at 0."""
        return self.above_coasting(position, speed, targets) + self.parameters.hysteresis

    def above_braking(
        self, position: float, speed: float, targets: Sequence[AnnouncedTarget]
    ) -> float:
        """Return the speed above the braking curve; braking begins at 0."""
        return speed - self.braking_speed(position, targets)

    def above_least_speed(self, speed: float) -> float:
        """Return the speed above the one at which the law is switched off, or on again."""
        rise = self.parameters.hysteresis if self.state.is_slow else 0.0
        return speed - self.parameters.least_speed - rise

    def past_station_limit(self, position: float, targets: Sequence[AnnouncedTarget]) -> float:
        """Return how far the train is within z_st of a station ahead; at 0 the law goes off."""
        distances = [t.position - position for t in targets if t.is_station]
        return self.parameters.station_distance - min(distances, default=NO_LIMIT * NO_LIMIT)

    def _coasting_speed(self, distance: float, target_speed: float) -> float:
        p = self.parameters
        limit = braking_speed(distance, target_speed, p.braking)
        if p.shape == "straight":
            speed = straight_speed(distance, target_speed, p.distance_gain, p.speed_gain)
        else:
            speed = braking_speed(distance, target_speed, p.coasting_deceleration)
        if p.braking < p.flat_braking:
            speed = raised_speed(speed, p.knee_speed, p.lift)
        return min(speed, limit)

    def _acts(self, position: float, speed: float, ahead: Sequence[AnnouncedTarget]) -> bool:
        if self.state.is_acting:
            return self.above_release(position, speed, ahead) > AT_THE_CURVE
        return self.above_coasting(position, speed, ahead) >= -AT_THE_CURVE

    def _is_slow(self, speed: float) -> bool:
        if self.parameters.least_speed <= 0.0:
            return False
        above = self.above_least_speed(speed)
        return above < -AT_THE_CURVE if self.state.is_slow else above < AT_THE_CURVE


def targets_ahead(position: float, targets: Sequence[AnnouncedTarget]) -> list[AnnouncedTarget]:
    """Return the targets that the train has not reached.

    Examples
    --------
    >>> len(targets_ahead(500.0, [AnnouncedTarget(500.0, 10.0), AnnouncedTarget(900.0)]))
    1
    """
    return [target for target in targets if target.position - position > AT_THE_TARGET]
