"""A case for the ETCS supervision: train, track, target, national values."""

from __future__ import annotations

from itertools import pairwise
from typing import Annotated, Literal

from pydantic import Field, model_validator

from railgrip.control.etcs import train_data
from railgrip.control.etcs.braked_weight import (
    build_up_times,
    deceleration_of,
    service_deceleration_of,
)
from railgrip.control.etcs.deceleration_field import NO_CAP
from railgrip.control.etcs.steps import Steps, combined, constant
from railgrip.core.errors import Problem
from railgrip.scenario.base import Model, Text, refuse
from railgrip.scenario.supervised_train import SupervisedTrain
from railgrip.scenario.supervision_values import FAST, Area, GradientFrom, NationalValues, steps_of
from railgrip.scenario.units import Length, Speed


class SupervisedTarget(Model):
    """Where which speed must be reached."""

    at: Length = Field(ge=0, le=1e6, description="Position of target or end of authority.")
    speed: Speed = Field(default=0.0, ge=0, le=FAST, description="Speed there.")
    kind: Literal["end of authority", "speed limit"] = Field(
        default="end of authority", description="An end of authority has speed 0."
    )
    supervised_location: Length | None = Field(
        default=None, ge=0, le=1e6, description="Of an end of authority; itself if not given."
    )
    release_speed: Speed = Field(default=0.0, ge=0, le=FAST, description="Of an end of authority.")

    @model_validator(mode="after")
    def _fits(self) -> SupervisedTarget:
        problems = []
        if self.kind == "end of authority" and self.speed > 0.0:
            problems.append(Problem("speed", "an end of authority has speed 0",
                                    got=f"{3.6 * self.speed:g} km/h",
                                    cure='kind = "speed limit"'))  # fmt: skip
        if self.supervised_location is not None and self.supervised_location < self.at:
            problems.append(Problem("supervised_location", "must not lie before the target",
                                    got=f"{self.supervised_location:g} m"))  # fmt: skip
        refuse(problems)
        return self


class SupervisionCase(Model):
    """A question to the supervision, as its file asks it."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    train: SupervisedTrain = Field(description="Its brake and interfaces.")
    target: SupervisedTarget = Field(description="Where which speed must be reached.")
    gradient: Annotated[tuple[GradientFrom, ...], Field(max_length=20_000)] = Field(
        default=(), description="Ascending by position; level if not given."
    )
    reduced_adhesion: Annotated[tuple[Area, ...], Field(max_length=1000)] = Field(
        default=(), description="Stretches with reduced adhesion."
    )
    national: NationalValues = Field(default=NationalValues(), description="National values.")
    ceiling: Speed | None = Field(default=None, gt=0, le=FAST, description="Limit before it.")
    speed_step: Speed = Field(default=5 / 3.6, ge=0.1 / 3.6, le=FAST, description="Of the table.")
    driver_reacts: bool = Field(
        default=False, strict=True, description="T_indication with T_driver, SUBSET-026 v4."
    )
    as_era_tool: bool = Field(
        default=False, strict=True, description="Service brake above 180 km/h as ERA's tool v3.0."
    )

    @model_validator(mode="after")
    def _in_order(self) -> SupervisionCase:
        places = [point.at for point in self.gradient]
        problems = [
            Problem(f"gradient[{i + 1}].at", "must lie beyond the entry before it",
                    got=f"{b:g} m after {a:g} m")
            for i, (a, b) in enumerate(pairwise(places)) if b <= a
        ] + [
            Problem(f"reduced_adhesion[{i}].to", "must lie beyond 'from'",
                    got=f"from {area.begin:g} m to {area.end:g} m")
            for i, area in enumerate(self.reduced_adhesion) if area.end <= area.begin
        ]  # fmt: skip
        levels = [row.confidence_level for row in self.train.kdry]
        if levels and self.national.confidence_level not in levels:
            problems.append(Problem("train.kdry", "has no steps for national.confidence_level",
                                    got=", ".join(map(str, levels)),
                                    allowed=str(self.national.confidence_level)))  # fmt: skip
        if self.target.speed >= (self.ceiling or self.train.top_speed):
            problems.append(Problem("target.speed", "must be below the ceiling speed",
                                    got=f"{3.6 * self.target.speed:g} km/h"))  # fmt: skip
        refuse(problems)
        return self

    def supervised_train(self) -> train_data.SupervisedTrain:
        """Return the train as the supervision sees it, national values included."""
        one = self.train
        return train_data.SupervisedTrain(
            length=one.length, brakes=self._brakes(), rotating_mass=one.rotating_mass,
            commands_service_brake=one.service_brake_interface and self.national.service_brake,
            cuts_traction=one.traction_cut_off_interface,
            traction_cut_off_time=one.traction_cut_off_time, acceleration=one.acceleration,
            compensates_speed=self.national.compensate_speed,
        )  # fmt: skip

    def supervised_track(self) -> train_data.Track:
        """Return gradient and reduced adhesion."""
        points = self.gradient or (GradientFrom(at=0.0, value=0.0),)
        gradient = Steps(tuple(p.at for p in points), tuple(p.value for p in points))
        if not self.reduced_adhesion:
            return train_data.Track(gradient, NO_CAP)
        with_magnets, passenger, freight = self.national.reduced_adhesion
        cap = freight
        if self.train.position == "passenger P":
            cap = with_magnets if self.train.adhesion_independent_brake else passenger
        areas = tuple((area.begin, area.end) for area in self.reduced_adhesion)
        length = self.train.length
        return train_data.Track(gradient, train_data.reduced_adhesion(areas, length, cap))

    def supervised_target(self) -> train_data.Target:
        """Return the target."""
        is_end = self.target.kind == "end of authority"
        place = self.target.supervised_location
        return train_data.Target(self.target.at, self.target.speed, is_end, place)

    def _brakes(self) -> train_data.Brakes:
        one, national = self.train, self.national
        normal = steps_of(one.normal_service) if one.normal_service and national.guidance else None
        kn = [steps_of(steps) if steps else constant(0.0)
              for steps in (one.kn_uphill, one.kn_downhill)]  # fmt: skip
        if one.braked_weight is None:
            level = national.confidence_level
            dry = [steps_of(row.steps) for row in one.kdry if row.confidence_level == level]
            safe = train_data.safe_deceleration(
                steps_of(one.emergency), dry[0] if dry else constant(1.0),
                steps_of(one.kwet) if one.kwet else constant(1.0), national.available_adhesion,
            )  # fmt: skip
            times = (one.emergency_time or 0.0, one.service_time or 0.0)
            return train_data.Brakes(safe, steps_of(one.service), *times, normal, *kn)
        emergency = deceleration_of(one.braked_weight)
        service = service_deceleration_of(one.braked_weight, self.as_era_tool)
        safe = combined(lambda a, k: a * k, emergency, self._kv(emergency))
        longer = [step.value for step in national.kr if one.length > step.begin]
        safe = safe.scaled(longer[-1] if longer else national.kr[0].value)
        times = build_up_times(one.position, one.length, self.target.speed)
        return train_data.Brakes(safe, service, national.kt * times[0], times[1], normal, *kn)

    def _kv(self, emergency: Steps) -> Steps:
        national = self.national
        if self.train.position != "passenger P":
            return steps_of(national.kv_freight)
        begins = tuple(step.begin for step in national.kv_passenger)
        weak = Steps(begins, tuple(step.weak for step in national.kv_passenger))
        strong = Steps(begins, tuple(step.strong for step in national.kv_passenger))
        reached = [value for begin, value in zip(*emergency, strict=True)
                   if begin <= self.train.top_speed]  # fmt: skip
        pivots = (national.a_nvp12, national.a_nvp23)
        return train_data.passenger_factor(weak, strong, max(reached), pivots)
