"""What to run: frozen models, complete and checked, with key paths in every message."""

from railgrip.scenario.bogie import Axle, Bogie
from railgrip.scenario.brakes import BrakeControl, Disc, DumpValve, FrictionBrake, Reservoir
from railgrip.scenario.contact_pair import ContactPair
from railgrip.scenario.equipment import (
    DynamicBrake,
    Resistance,
    Sander,
    Sensor,
    TrackBrake,
    Traction,
)
from railgrip.scenario.friction import ConstantPad, KarwatzkiPad, Pad, PiecewisePad
from railgrip.scenario.limits import Limits
from railgrip.scenario.line import Curve, GradientPoint, Line, Route, SpeedLimit
from railgrip.scenario.rail import FrictionState, Rail, RailCondition, RailPatch, RandomField
from railgrip.scenario.run import DemandPoint, Run
from railgrip.scenario.scenario import Load, Scenario
from railgrip.scenario.train import AxlePlace, BogiePlace, Train
from railgrip.scenario.vehicle import Vehicle
from railgrip.scenario.wsp import Wsp, WspUnit

__all__ = [
    "Axle",
    "AxlePlace",
    "Bogie",
    "BogiePlace",
    "BrakeControl",
    "ConstantPad",
    "ContactPair",
    "Curve",
    "DemandPoint",
    "Disc",
    "DumpValve",
    "DynamicBrake",
    "FrictionBrake",
    "FrictionState",
    "GradientPoint",
    "KarwatzkiPad",
    "Limits",
    "Line",
    "Load",
    "Pad",
    "PiecewisePad",
    "Rail",
    "RailCondition",
    "RailPatch",
    "RandomField",
    "Reservoir",
    "Resistance",
    "Route",
    "Run",
    "Sander",
    "Scenario",
    "Sensor",
    "SpeedLimit",
    "TrackBrake",
    "Traction",
    "Train",
    "Vehicle",
    "Wsp",
    "WspUnit",
]
