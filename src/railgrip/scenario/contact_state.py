"""What a wheel does on the rail at one moment, with units in words: load, speed, creepages."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import Field, ValidationError

from railgrip.contact.rail_friction import RailFriction
from railgrip.core.errors import RailgripError
from railgrip.scenario import library
from railgrip.scenario.base import Model
from railgrip.scenario.explain import problems_of
from railgrip.scenario.rail import FrictionState, RailCondition
from railgrip.scenario.units import Dimensionless, Force, Speed, Spin, Temperature


class ContactState(Model):
    """Load, speed, creepages and temperatures of one wheel; creepage is positive when driving."""

    load: Force = Field(default=100e3, gt=0, le=1e6, description="Normal force.")
    speed: Speed = Field(default=20.0, gt=0, le=200, description="Of the train.")
    longitudinal: Dimensionless = Field(
        default=0.0, ge=-100, le=100, description="(wheel speed − train speed)/train speed."
    )
    lateral: Dimensionless = Field(default=0.0, ge=-100, le=100, description="Across the track.")
    spin: Spin = Field(default=0.0, ge=-1000, le=1000, description="Rotation over train speed.")
    wheel_temperature: Temperature = Field(
        default=20.0, ge=-60, le=1500, description="With which the tread enters the patch."
    )
    rail_temperature: Temperature = Field(
        default=20.0, ge=-60, le=1500, description="With which the rail enters the patch."
    )


def contact_state(words: Mapping[str, Any]) -> ContactState:
    """Return a state from texts with units or numbers in SI.

    Raises
    ------
    RailgripError
        ``load: must be above 0 N; got 0 N``, and likewise for all that is wrong.

    Examples
    --------
    >>> contact_state({"load": "100 kN", "speed": "72 km/h", "longitudinal": "0.2 %"}).speed
    20.0
    """
    try:
        return ContactState.model_validate(dict(words))
    except ValidationError as error:
        raise RailgripError(problems_of(error, ContactState)) from None


def rail_friction(condition: str) -> RailFriction:
    """Return the friction of a shipped rail condition or a file, as the first wheel finds it.

    Raises
    ------
    RailgripError
        ``rail condition 'dri' unknown; known: …; did you mean 'dry'?``; what is wrong in a file.

    Examples
    --------
    >>> rail_friction("wet").static_friction
    0.3
    """
    try:
        found = RailCondition.model_validate(library.fetch("rail_condition", condition))
    except ValidationError as error:
        raise RailgripError(problems_of(error, RailCondition)) from None
    return RailFriction(**found.contaminated.model_dump())


def constant_friction_rail(friction: Any) -> RailFriction:
    """Return a rail with one friction coefficient at any slip speed, and Kalker's initial slope.

    Raises
    ------
    RailgripError
        ``static_friction: must be at least 0; got -0.1``

    Examples
    --------
    >>> constant_friction_rail(0.3)
    RailFriction(static_friction=0.3, friction_ratio=1.0, friction_decay=0.0, \
adhesion_reduction=1.0, slip_reduction=1.0)
    """
    words = {
        "static_friction": friction, "friction_ratio": 1.0, "friction_decay": 0.0,
        "adhesion_reduction": 1.0, "slip_reduction": 1.0,
    }  # fmt: skip
    try:
        return RailFriction(**FrictionState.model_validate(words).model_dump())
    except ValidationError as error:
        raise RailgripError(problems_of(error, FrictionState)) from None
