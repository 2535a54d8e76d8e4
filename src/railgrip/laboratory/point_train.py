"""A train as a point: what drives it and what slows it, for exact runs under a driving law."""

from __future__ import annotations

from typing import NamedTuple

from railgrip.core.constants import GRAVITY


class PointTrain(NamedTuple):
    """A train without length whose wheels do not slip.

    Parameters
    ----------
    mass : float
        > 0, [kg].
    rotating_mass : float
        Share of the mass, ≥ 0, [1].
    effort : float
        Greatest tractive effort, > 0, [N].
    power : float
        Greatest power at the wheel, > 0, [W].
    resistance : (float, float, float)
        Of running: a [N], b [N s/m], c [N s²/m²].
    acceleration : float
        Preset: the train takes no more effort than this needs, > 0, [m/s²].

    Examples
    --------
    >>> train = PointTrain(200e3, 0.06, 200e3, 2e6, (2e3, 30.0, 5.0), 0.8)
    >>> train.greatest_effort(20.0), train.running_resistance(20.0, 0.0)
    (100000.0, 4600.0)
    """

    mass: float
    rotating_mass: float
    effort: float
    power: float
    resistance: tuple[float, float, float]
    acceleration: float

    @property
    def inertia(self) -> float:
        """Mass with the rotating share, [kg]."""
        return self.mass * (1.0 + self.rotating_mass)

    def greatest_effort(self, speed: float) -> float:
        """Return the effort available, [N]."""
        return min(self.effort, self.power / max(speed, 1e-3))

    def running_resistance(self, speed: float, gradient: float) -> float:
        """Return what slows the train without brakes, downhill it may be negative, [N]."""
        a, b, c = self.resistance
        return a + speed * (b + c * speed) + self.mass * GRAVITY * gradient

    def free_acceleration(
        self, speed: float, gradient: float, share: float = 1.0, brake: float = 0.0
    ) -> float:
        """Return the acceleration under a share of the effort and a light brake, [m/s²]."""
        resistance = self.running_resistance(speed, gradient)
        preset = max(self.inertia * self.acceleration + resistance, 0.0)
        effort = min(share * self.greatest_effort(speed), preset)
        return (effort - resistance) / self.inertia - brake
