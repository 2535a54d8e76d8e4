"""A contact that slides, as the temperatures of its surfaces need it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas import rail_chill
from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    FlashTemperature,
    ThermalMaterial,
    flash_conductance,
    flash_temperature,
    friction_power,
)


@dataclass(frozen=True)
class SlidingContact:
    """A Hertzian contact that slides: what its surfaces' temperatures depend on.

    Parameters
    ----------
    load : float
        Wheel load Q, > 0 [N].
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    friction : float
        Friction coefficient, ≥ 0; the whole patch is taken to slide [-].
    wheel_speed, train_speed : float
        Speed at the tread, 0 for a locked wheel, and of the train, both ≥ 0 [m/s].
    wheel_temperature, rail_temperature : float
        With which the surfaces enter [°C].
    wheel, rail : ThermalMaterial
        The materials.

    Raises
    ------
    RailgripError
        "must be positive and finite", "must be zero or more, and finite" or "must be a finite
        number", with the name in front.

    Examples
    --------
    >>> ertz = SlidingContact(100e3, 5.88e-3, 10.54e-3, 0.3, 29.5, 30.5)
    >>> round(ertz.flash().rise, 2), ertz.power
    (150.29, 30000.0)
    """

    load: float
    a: float
    b: float
    friction: float
    wheel_speed: float
    train_speed: float
    wheel_temperature: float = 20.0
    rail_temperature: float = 20.0
    wheel: ThermalMaterial = STEEL_ERTZ_2002
    rail: ThermalMaterial = STEEL_ERTZ_2002

    def __post_init__(self) -> None:
        for name, unit in (("load", "N"), ("a", "m"), ("b", "m")):
            if not 0.0 < getattr(self, name) < math.inf:
                raise _refusal(name, "must be positive and finite", getattr(self, name), unit)
        for name, unit in (("friction", ""), ("wheel_speed", "m/s"), ("train_speed", "m/s")):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise _refusal(name, "must be zero or more, and finite", getattr(self, name), unit)
        for name in ("wheel_temperature", "rail_temperature"):
            if not math.isfinite(getattr(self, name)):
                raise _refusal(name, "must be a finite number", getattr(self, name), "°C")

    @property
    def power(self) -> float:
        """Friction power μ Q |slip speed| [W]."""
        return friction_power(self.wheel_speed, self.train_speed, self.friction * self.load)

    @property
    def heat_flux(self) -> float:
        """Friction power per area at the centre of the patch, μ p0 |slip speed| [W/m²]."""
        return 1.5 * self.power / (math.pi * self.a * self.b)

    def flash(self) -> FlashTemperature:
        """Greatest rise and the wheel's share, from the formula that plant and controllers use."""
        wheel = flash_conductance(self.wheel, self.a, self.b, self.wheel_speed)
        rail = flash_conductance(self.rail, self.a, self.b, self.train_speed)
        return flash_temperature(wheel, rail, self.power)

    def touch_temperature(self) -> float:
        """Temperature in the patch without friction, between those of the two bodies [°C]."""
        wheel = rail_chill.touch_conductance(self.wheel, self.a, self.b, self.wheel_speed)
        rail = rail_chill.touch_conductance(self.rail, self.a, self.b, self.train_speed)
        return rail_chill.contact_temperature(
            wheel, rail, self.wheel_temperature, self.rail_temperature
        )


def _refusal(name: str, what: str, value: float, unit: str) -> RailgripError:
    return RailgripError(Problem(name, what, got=f"{value} {unit}".strip()))
