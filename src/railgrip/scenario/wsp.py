"""Who protects the wheels: one controller for the train, or units with a controller each."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import Field, model_validator

from railgrip.core.errors import Problem, unknown_name
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.reference import Plugin
from railgrip.scenario.run import Parameter

if TYPE_CHECKING:
    from railgrip.scenario.train import Train

ControllerName = Annotated[Text, Plugin("railgrip.controllers", "controller", "none")]
_WORDS = "A registered controller, 'none', or a Python file that holds one."


class WspUnit(Model):
    """One computer of the protection: it sees and commands its own axles only."""

    controller: ControllerName = Field(default="conventional", min_length=1, description=_WORDS)
    parameters: dict[Text, Parameter] = Field(
        default={}, max_length=1000, description="Of the controller, SI or with units."
    )
    vehicles: tuple[int, ...] = Field(
        default=(), max_length=1000, description="Vehicles it serves, counted from 1 at the front."
    )
    axles: tuple[Text, ...] = Field(
        default=(), max_length=1000, description="Labels of further axles, e.g. C1-V1-B1-A1."
    )

    @model_validator(mode="after")
    def _serves_somebody(self) -> WspUnit:
        if not self.vehicles and not self.axles:
            what, cure = "serves no axle", "vehicles = [1] or axles = ['C1-V1-B1-A1']"
            refuse([Problem("", what, cure=cure)])
        return self

    def places(self, train: Train) -> tuple[int, ...]:
        """Return the unit's axles as numbers from the front of the train, from 0."""
        return tuple(
            i
            for i, place in enumerate(train.axles())
            if place.vehicle + 1 in self.vehicles or place.label in self.axles
        )

    def __str__(self) -> str:
        where = [f"V{number}" for number in self.vehicles] + list(self.axles)
        return f"{Path(self.controller).stem} on {', '.join(where)}"


class Wsp(Model):
    """The wheel-slide protection."""

    controller: ControllerName = Field(default="conventional", min_length=1, description=_WORDS)
    parameters: dict[Text, Parameter] = Field(
        default={}, max_length=1000, description="Of the controller, SI or with units."
    )
    unit: tuple[WspUnit, ...] = Field(
        default=(),
        max_length=250,
        description="Instead of one controller: a computer each for some vehicles or axles.",
    )

    @model_validator(mode="after")
    def _one_way(self) -> Wsp:
        also = {"controller", "parameters"} & self.model_fields_set if self.unit else set()
        # a dumped model states its defaults; they contradict nobody
        also = {name for name in also if getattr(self, name) not in ("conventional", {})}
        what = "stands beside [[wsp.unit]], which says who protects which axle"
        refuse([Problem(name, what, cure="put it into the units") for name in sorted(also)])
        return self

    def problems(self, train: Train) -> list[Problem]:
        """Return what is wrong unless every axle of the train belongs to exactly one unit."""
        if not self.unit:
            return []
        labels = [place.label for place in train.axles()]
        found = [
            *self._unknown_vehicles(len(train.vehicle)),
            *(
                unknown_name(f"wsp.unit[{i}].axles", "axle", label, labels)
                for i, unit in enumerate(self.unit)
                for label in unit.axles
                if label not in labels
            ),
        ]
        served = Counter(axle for unit in self.unit for axle in unit.places(train))
        twice = [label for i, label in enumerate(labels) if served[i] > 1]
        never = [label for i, label in enumerate(labels) if served[i] == 0]
        if twice:
            found.append(Problem("wsp.unit", "an axle belongs to two units", got=_few(twice)))
        if never and not found:
            cure = "a unit for them; controller = 'none' leaves them unprotected"
            found.append(Problem("wsp.unit", "axles without a unit", got=_few(never), cure=cure))
        return found

    def _unknown_vehicles(self, count: int) -> list[Problem]:
        return [
            Problem(
                f"wsp.unit[{i}].vehicles",
                "there is no such vehicle",
                got=f"{number}",
                allowed=f"1 to {count}",
            )
            for i, unit in enumerate(self.unit)
            for number in unit.vehicles
            if not 1 <= number <= count
        ]

    def __str__(self) -> str:
        """Return who protects, in words.

        Examples
        --------
        >>> two = ({"controller": "none", "vehicles": [1]}, {"vehicles": [2, 3]})
        >>> print(Wsp(unit=two))
        none on V1; conventional on V2, V3
        """
        return "; ".join(map(str, self.unit)) if self.unit else self.controller


def _few(labels: list[str]) -> str:
    return ", ".join(labels[:4]) + (f" and {len(labels) - 4} more" if len(labels) > 4 else "")
