"""What slows the train, over speed and position: brake, gradient, reduced adhesion."""

from __future__ import annotations

from typing import NamedTuple

from railgrip.control.etcs.gradient_acceleration import gradient_acceleration
from railgrip.control.etcs.steps import Steps, breaks, constant

NO_CORRECTION = constant(0.0)
NO_CAP = constant(float("inf"))


class DecelerationField(NamedTuple):
    """Deceleration over speed and position of the front, constant between its breaks.

    Parameters
    ----------
    brake : Steps
        Of the brake alone over the speed, [m/s²] over [m/s].
    gradient : Steps
        Least gradient under the train over the position of the front, [1] over [m].
    rotating_mass : float, optional
        Share of the mass, [1].
    cap : Steps
        What the brake may count for at most over the position, [m/s²] (reduced adhesion).
    uphill, downhill : Steps
        Kn+ and Kn− of the normal service brake over the speed, [m/s²].

    Notes
    -----
    ``A(V, d) = min(A_brake(V), cap(d)) + A_gradient(d) − Kn±(V)·grad(d)``

    References
    ----------
    .. [1] SUBSET-026-3 v3.4.0, 3.13.6.2.1.3, 3.13.6.3.1.3, 3.13.6.4.3.

    Examples
    --------
    >>> level = DecelerationField(constant(1.0), constant(0.0))
    >>> level.at(30.0, 500.0)
    1.0
    """

    brake: Steps
    gradient: Steps
    rotating_mass: float | None = None
    cap: Steps = NO_CAP
    uphill: Steps = NO_CORRECTION
    downhill: Steps = NO_CORRECTION

    def at(self, speed: float, position: float) -> float:
        """Return the deceleration at one speed and position, [m/s²]."""
        gradient = self.gradient.at(position)
        correction = (self.uphill if gradient > 0.0 else self.downhill).at(speed) * gradient
        brake = min(self.brake.at(speed), self.cap.at(position))
        return brake + gradient_acceleration(gradient, self.rotating_mass) - correction

    def speed_breaks(self) -> list[float]:
        """Return the speeds at which it steps, [m/s]."""
        return breaks([self.brake, self.uphill, self.downhill])

    def position_breaks(self) -> list[float]:
        """Return the positions at which it steps, [m]."""
        return breaks([self.gradient, self.cap])
