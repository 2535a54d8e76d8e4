"""What breaks during a run: a speed sensor, a dump valve, an axle that seizes."""

from __future__ import annotations

import math
from typing import Literal, get_args

from pydantic import Field, model_validator

from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.units import Dimensionless, Speed, Time

FaultKind = Literal[
    "sensor_lost", "sensor_dead", "sensor_frozen", "sensor_noisy", "sensor_scaled",
    "valve_fills", "valve_holds", "valve_vents", "valve_delayed", "axle_locked",
]  # fmt: skip
FAULT_KINDS: tuple[str, ...] = get_args(FaultKind)

_NEEDS = {"sensor_noisy": "noise", "sensor_scaled": "factor", "valve_delayed": "delay"}
_WORDS = {
    "sensor_lost": "speed sensor lost",
    "sensor_dead": "speed sensor reads nothing",
    "sensor_frozen": "speed sensor frozen",
    "sensor_noisy": "speed sensor noisy",
    "sensor_scaled": "speed sensor reads too much or too little",
    "valve_fills": "dump valve stuck open to the supply",
    "valve_holds": "dump valve stuck shut",
    "valve_vents": "dump valve stuck venting",
    "valve_delayed": "dump valve delayed",
    "axle_locked": "axle locked",
}


class Fault(Model):
    """One fault of one axle, from a time on.

    sensor_lost: the controller is told that there is no speed; sensor_dead: it reads zero.
    """

    axle: Text = Field(description="Label of the axle, e.g. C1-V1-B1-A1, or 'all'.")
    kind: FaultKind = Field(description="What is wrong.")
    begin: Time = Field(default=0.0, alias="from", ge=0, le=7200, description="Since the start.")
    happens: bool = Field(
        default=True, strict=True, description="False: it is only prepared, for a campaign."
    )
    end: Time = Field(
        default=math.inf, alias="to", ge=0, description="When it heals; absent: never."
    )
    noise: Speed | None = Field(
        default=None, gt=0, le=50, description="Standard deviation; sensor_noisy only."
    )
    factor: Dimensionless | None = Field(
        default=None, gt=0, le=10, description="Speed read over true speed; sensor_scaled only."
    )
    delay: Time | None = Field(
        default=None, gt=0, le=0.5, description="Added to the valve's own; valve_delayed only."
    )

    @model_validator(mode="after")
    def _fits_its_kind(self) -> Fault:
        wanted = _NEEDS.get(self.kind)
        problems = []
        for name in _NEEDS.values():
            given = getattr(self, name) is not None
            if name == wanted and not given:
                problems.append(Problem(name, f"is needed for kind '{self.kind}'"))
            if name != wanted and given:
                problems.append(Problem(name, f"does not belong to kind '{self.kind}'"))
        if self.end <= self.begin:
            problems.append(
                Problem("to", "must be later than from", got=f"{self.end:g} s, {self.begin:g} s")
            )
        refuse(problems)
        return self

    @property
    def value(self) -> float:
        """Noise, factor or delay; 0 where the kind has none."""
        return float(getattr(self, _NEEDS[self.kind])) if self.kind in _NEEDS else 0.0

    def __str__(self) -> str:
        until = "" if math.isinf(self.end) else f" to {self.end:g} s"
        return f"{self.axle}: {_WORDS[self.kind]}, from {self.begin:g} s{until}"
