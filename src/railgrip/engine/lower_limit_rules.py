"""Rules of brake control from a scenario's table to the rows that the kernel reads."""

from __future__ import annotations

import math
from collections.abc import Sequence

from railgrip.control.friction_estimate import (
    ON_DEVIATION,
    ON_FUNCTIONS,
    ON_RESULT,
    Influence,
    LimitSet,
)
from railgrip.control.limit_rules import (
    ANY,
    EMERGENCY_BRAKE,
    NEW,
    SERVICE,
    WORN,
    Conditions,
    LimitRule,
)
from railgrip.core.formulas.piecewise_linear import hinges_from_points
from railgrip.scenario import limit_rules as described

_FORMS = {"functions": ON_FUNCTIONS, "result": ON_RESULT, "deviation": ON_DEVIATION}
_BRAKES = {"any": ANY, "service": SERVICE, "emergency": EMERGENCY_BRAKE}
_PADS = {"any": ANY, "new": NEW, "worn": WORN}


def lower_rule(rule: described.Rule) -> LimitRule:
    """Return a rule in numbers; an open end of a range is infinite."""
    ranges: list[float] = []
    for name in ("train_speed", "time", "disc_temperature", "rubbing_speed", "clamp_force"):
        low, high = getattr(rule, name)
        ranges += [-math.inf if low is None else low, math.inf if high is None else high]
    when = Conditions(_BRAKES[rule.brake], _PADS[rule.pads], *ranges)
    return LimitRule(when, _limits(rule.model), _limits(rule.control))


def _limits(limits: described.LimitSet) -> LimitSet:
    form = limits.form if isinstance(limits, described.ControlLimitSet) else "functions"
    return LimitSet(
        _influence(limits.temperature, limits.temperature.weight),
        _influence(limits.speed, limits.speed.weight),
        _influence(limits.clamp_force, limits.clamp_force.weight),
        _FORMS[form],
        limits.weight,
    )


def _influence(bounds: described.Bounds, weight: Sequence[tuple[float, float]]) -> Influence:
    return Influence(
        -math.inf if bounds.least is None else bounds.least,
        math.inf if bounds.greatest is None else bounds.greatest,
        hinges_from_points(weight),
    )
