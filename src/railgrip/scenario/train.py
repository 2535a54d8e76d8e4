"""A train: its vehicles in order, its named brakes, what all of them share."""

from __future__ import annotations

from typing import Annotated, NamedTuple

from pydantic import Field, model_validator

from railgrip.core.errors import Problem, unknown_name
from railgrip.scenario.base import Model, Name, Repeated, Text, places, refuse
from railgrip.scenario.bogie import Axle, Bogie
from railgrip.scenario.brakes import BrakeControl, DumpValve, FrictionBrake, Reservoir
from railgrip.scenario.equipment import DynamicBrake, Resistance, Sander, Sensor, Traction
from railgrip.scenario.units import Mass, Speed
from railgrip.scenario.vehicle import Vehicle

MOST_AXLES = 2000


class AxlePlace(NamedTuple):
    """Where an axle sits in the train (all numbers from 0, distances in m)."""

    label: str
    vehicle: int
    bogie: int
    number: int
    behind_front: float
    axle: Axle


class BogiePlace(NamedTuple):
    """Where a bogie sits in the train (all numbers from 0, distances in m)."""

    vehicle: int
    number: int
    behind_front: float
    bogie: Bogie


class Train(Model):
    """A train as it is; how it is loaded and driven stands in the scenario."""

    title: Text = Field(default="", description="Name for people.")
    source: Text = Field(default="", description="Where the numbers come from.")
    brake_control: BrakeControl = Field(
        default=BrakeControl(), description="From driver to vehicles."
    )
    resistance: Resistance = Field(default=Resistance(), description="Of the whole train.")
    brakes: dict[Name, FrictionBrake] = Field(
        default={}, max_length=MOST_AXLES, description="Friction brakes by name, each for one axle."
    )
    dump_valve: DumpValve | None = Field(
        default=None, description="Valves of the slide protection; absent: it has none."
    )
    reservoir: Reservoir | None = Field(
        default=None, description="Air of each vehicle; absent: never exhausted."
    )
    dynamic_brake: DynamicBrake | None = Field(default=None, description="Braking by the motors.")
    traction: Traction | None = Field(default=None, description="Tractive effort.")
    sander: Sander | None = Field(default=None, description="Of every axle with sander = true.")
    sensor: Sensor = Field(default=Sensor(), description="Speed sensor of every axle.")
    max_speed: Speed | None = Field(default=None, gt=0, le=600 / 3.6, description="Permitted.")
    braked_weight: Mass | None = Field(
        default=None, gt=0, le=1e8, description="From the data sheet, to check against."
    )
    vehicle: Annotated[tuple[Vehicle, ...], Repeated] = Field(
        min_length=1, max_length=1000, description="From the front."
    )

    @model_validator(mode="after")
    def _fits_together(self) -> Train:
        refuse([*self._size(), *self._names(), *self._owners()])
        return self

    def _size(self) -> list[Problem]:
        per_vehicle = {id(v): sum(len(bogie.axle) for bogie in v.bogie) for v in self.vehicle}
        axles = sum(per_vehicle[id(v)] for v in self.vehicle)
        if axles <= MOST_AXLES:
            return []
        return [Problem("vehicle", "too many axles", got=f"{axles}", allowed=f"1 to {MOST_AXLES}")]

    def _names(self) -> list[Problem]:
        return [
            unknown_name(
                f"vehicle[{i}].bogie[{j}].axle[{k}].brake", "brake", axle.brake, self.brakes
            )
            for i, vehicle in places(self.vehicle)
            for j, bogie in places(vehicle.bogie)
            for k, axle in places(bogie.axle)
            if axle.brake is not None and axle.brake not in self.brakes
        ]

    def _owners(self) -> list[Problem]:
        # Each kind of equipment is described once for the train and worn by some of its axles.
        axles = [axle for _, v in places(self.vehicle) for b in v.bogie for axle in b.axle]
        problems = []
        if self.dynamic_brake is not None and not any(axle.motor for axle in axles):
            problems.append(Problem("dynamic_brake", "needs an axle with motor = true"))
        if self.traction is not None and not any(axle.motor for axle in axles):
            problems.append(Problem("traction", "needs an axle with motor = true"))
        if self.sander is not None and not any(axle.sander for axle in axles):
            problems.append(Problem("sander", "needs an axle with sander = true"))
        if self.sander is None and any(axle.sander for axle in axles):
            problems.append(Problem("sander", "is missing, while an axle has sander = true"))
        return problems

    @property
    def tare(self) -> float:
        """Mass without payload, kg."""
        return sum(vehicle.tare for vehicle in self.vehicle)

    @property
    def length(self) -> float:
        """Length over couplers, m."""
        return sum(vehicle.length for vehicle in self.vehicle)

    @property
    def n_axles(self) -> int:
        """Number of axles."""
        return sum(len(bogie.axle) for vehicle in self.vehicle for bogie in vehicle.bogie)

    def vehicle_fronts(self) -> tuple[float, ...]:
        """Distance of each vehicle's front behind the train's, m."""
        fronts, front = [], 0.0
        for vehicle in self.vehicle:
            fronts.append(front)
            front += vehicle.length
        return tuple(fronts)

    def bogies(self) -> tuple[BogiePlace, ...]:
        """Every bogie from the front, with its place."""
        return tuple(
            BogiePlace(i, j, front + pivot, bogie)
            for i, (front, vehicle) in enumerate(
                zip(self.vehicle_fronts(), self.vehicle, strict=True)
            )
            for j, (pivot, bogie) in enumerate(
                zip(vehicle.pivot_offsets(), vehicle.bogie, strict=True)
            )
        )

    def axles(self) -> tuple[AxlePlace, ...]:
        """Every axle from the front, with its place and its label (C1-V2-B1-A2)."""
        found = []
        for i, (front, vehicle) in enumerate(zip(self.vehicle_fronts(), self.vehicle, strict=True)):
            offsets = iter(vehicle.axle_offsets())
            for j, bogie in enumerate(vehicle.bogie):
                for k, axle in enumerate(bogie.axle):
                    label = f"C1-V{i + 1}-B{j + 1}-A{k + 1}"
                    found.append(AxlePlace(label, i, j, k, front + next(offsets), axle))
        return tuple(found)
