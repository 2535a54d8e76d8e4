"""The scenario: a train, its load, a line, a rail, a run, a protection, limits."""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

from pydantic import Field, GetJsonSchemaHandler, ValidationError, model_validator
from pydantic.functional_validators import ModelWrapValidatorHandler
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario import library
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.brake_control import BrakeControlLayer
from railgrip.scenario.describe import describe
from railgrip.scenario.explain import problems_of
from railgrip.scenario.fault import Fault
from railgrip.scenario.limits import Limits
from railgrip.scenario.line import Route
from railgrip.scenario.merge import with_path
from railgrip.scenario.rail import Rail
from railgrip.scenario.reference import Reference
from railgrip.scenario.run import Run
from railgrip.scenario.train import Train
from railgrip.scenario.trip import Trip
from railgrip.scenario.units import Dimensionless
from railgrip.scenario.wsp import Wsp

LoadState = Literal["normal", "empty", "laden"]


class Load(Model):
    """How the train is loaded."""

    state: LoadState = Field(
        default="normal", description="normal: each vehicle's payload; laden: its payload_max."
    )
    share: Dimensionless | None = Field(
        default=None, ge=0, le=1, description="Share of every payload_max, instead of a state."
    )

    @model_validator(mode="before")
    @classmethod
    def _short(cls, value: Any) -> Any:
        return {"state": value} if isinstance(value, str) else value

    @classmethod
    def __get_pydantic_json_schema__(
        cls, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> JsonSchemaValue:
        """Editors offer the short form too."""
        return {"anyOf": [{"enum": list(get_args(LoadState))}, handler(schema)]}

    @model_validator(mode="after")
    def _one_way(self) -> Load:
        if self.share is not None and self.state != "normal":
            refuse(
                [
                    Problem(
                        "share",
                        "contradicts the state",
                        got=f"state '{self.state}'",
                        cure="give one of them",
                    )
                ]
            )
        return self


class Scenario(Model):
    """One braking run, complete: it needs no other file.

    Every problem is reported at once, each with its key path; entries of lists are counted
    from 0, as they stand in the file.

    Raises
    ------
    RailgripError
        One line a problem, e.g. ``run.speed: must not be more than 600 km/h; got 700 km/h``.

    Examples
    --------
    >>> Scenario(train={}, run={"speed": "160 km/h"})
    Traceback (most recent call last):
    railgrip.core.errors.RailgripError: train.vehicle: is missing
    """

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    train: Annotated[Train, Reference("train")] = Field(
        description="A shipped name, a file or a table."
    )
    load: Load = Field(default=Load(), description="normal, empty, laden, or a share.")
    line: Route = Field(default=Route(), description="The line and where the train begins.")
    rail: Rail = Field(default=Rail(), description="The rail's condition.")
    run: Run = Field(default=Run(), description="Speed, demand, step.")
    wsp: Wsp = Field(default=Wsp(), description="Wheel-slide protection.")
    brake_control: BrakeControlLayer | None = Field(
        default=None,
        description="Friction estimate and deceleration control above it; absent: none.",
    )
    trip: Trip | None = Field(
        default=None, description="From stop to stop, for `railgrip drive`; absent: one stop."
    )
    fault: Annotated[tuple[Fault, ...], Field(max_length=1000)] = Field(
        default=(), description="What breaks during the run."
    )
    limits: Limits = Field(default=Limits(), description="What the run must keep.")

    @model_validator(mode="wrap")
    @classmethod
    def _kind_reply(cls, value: Any, handler: ModelWrapValidatorHandler[Scenario]) -> Scenario:
        try:
            if isinstance(value, dict):
                value = library.inherited("scenario", value)
            scenario = handler(value)
        except ValidationError as error:
            raise RailgripError(problems_of(error, cls)) from None
        problems = [
            *scenario._patches_on_line(),
            *scenario._limits_fit_speed(),
            *scenario._can_drive(),
            *scenario._faults_have_axles(),
            *scenario.wsp.problems(scenario.train),
        ]
        if problems:
            raise RailgripError(problems)
        return scenario

    def _patches_on_line(self) -> list[Problem]:
        length = self.line.use.length
        return [
            Problem(
                f"rail.patch[{i}].from",
                "lies beyond the end of the line",
                got=f"{patch.begin:g} m",
                allowed=f"0 to less than {length:g} m",
            )
            for i, patch in enumerate(self.rail.patch)
            if patch.begin >= length
        ]

    def _limits_fit_speed(self) -> list[Problem]:
        distance, most = self.limits.stopping_distance, self.limits.mean_deceleration_greatest
        if distance is None or most is None or self.run.speed**2 <= 2 * most * distance:
            return []
        return [
            Problem(
                "limits.stopping_distance",
                "contradicts mean_deceleration_greatest at this speed",
                got=f"{distance:g} m and {most:g} m/s² from {self.run.speed * 3.6:.4g} km/h",
                allowed=f"at least {self.run.speed**2 / (2 * most):.4g} m",
            )
        ]

    def _can_drive(self) -> list[Problem]:
        if self.train.traction is not None or not any(p.level > 0 for p in self.run.drive):
            return []
        what = "asks for tractive effort, and the train has none"
        return [Problem("run.drive", what, cure="a train with [traction], e.g. 'emu_four_car'")]

    def _faults_have_axles(self) -> list[Problem]:
        axles = {place.label: place.axle for place in self.train.axles()}
        problems = []
        for i, fault in enumerate(self.fault):
            where = f"fault[{i}]"
            if fault.axle != "all" and fault.axle not in axles:
                problems.append(unknown_name(f"{where}.axle", "axle", fault.axle, [*axles, "all"]))
            elif fault.kind.startswith("valve") and self.train.dump_valve is None:
                problems.append(Problem(f"{where}.kind", "the train has no dump valves"))
        return problems

    def __str__(self) -> str:
        return describe(self)

    def payloads(self) -> tuple[float, ...]:
        """Payload of each vehicle under this load, kg."""
        share = {"normal": None, "empty": 0.0, "laden": 1.0}[self.load.state]
        if self.load.share is not None:
            share = self.load.share
        return tuple(
            vehicle.payload if share is None else share * vehicle.payload_max
            for vehicle in self.train.vehicle
        )

    @property
    def mass(self) -> float:
        """Mass of the loaded train without rotating parts, kg."""
        return self.train.tare + sum(self.payloads())

    def with_(self, changes: dict[str, Any] | None = None, /, **more: Any) -> Scenario:
        """Return this scenario with something changed, checked anew.

        Parameters
        ----------
        changes : dict
            Values by key or dotted key: ``{"run.speed": "120 km/h"}``.
        **more : table or value
            Laid over what is there: ``run={"speed": "120 km/h"}``, ``load="laden"``. Lists
            replace; a new ``law`` or ``controller`` replaces the table it stands in.

        Examples
        --------
        >>> scenario = Scenario(train="emu_four_car")
        >>> scenario.with_({"run.speed": "36 km/h"}, rail={"condition": "wet"}).run.speed
        10.0
        """
        table = self.model_dump(exclude_unset=True)
        for path, value in {**(changes or {}), **more}.items():
            table = with_path(table, path, value)
        return Scenario.model_validate(table)
