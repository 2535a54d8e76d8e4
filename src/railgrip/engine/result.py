"""What a simulation remembers: one xarray dataset with units and meanings."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from railgrip.core.signals import SIGNALS, attributes
from railgrip.core.status import RunStatus, sentence
from railgrip.engine import layout as at
from railgrip.engine.adhesion import available_adhesion
from railgrip.engine.plan import FloatArray, Memory, Outcome, Plan
from railgrip.engine.records import AXLE_OUTCOMES, AXLE_TRACES, TRAIN_OUTCOMES, TRAIN_TRACES
from railgrip.scenario.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr

FLAT_WEAR = 1.0e-13
"""Volume that a locked wheel loses per friction work, m³/J (illustrative, of the order of mild
to severe wear of wheel steel)."""
TREAD_WIDTH = 0.02
"""Width of the patch that a locked wheel grinds, m (illustrative)."""


OF_DRIVING = {
    "drive_demand", "energy_traction", "covered_distance", "final_speed", "axle_greatest_spin",
    "axle_spin_time",
}  # fmt: skip
"""What only a run that drives, or goes on for a given time, has to tell."""

OF_BRAKE_CONTROL = {
    "correction_effort", "axle_mean_adhesion", "brake_correction", "estimated_friction",
}  # fmt: skip
"""What only a train with brake control has to tell."""


OF_UNITS = {"unit_reference_speed", "unit_state"}
"""What only a train with several computers of the protection has to tell."""
OF_DRIVELINE = {"motor_speed", "driveline_torque", "energy_driveline"}
"""What only a train whose motors turn their wheels through a shaft has to tell."""


def drives(scenario: Scenario) -> bool:
    """Return whether a run is more than a stop: it drives, or goes on for a given time."""
    return bool(scenario.run.drive) or scenario.run.duration is not None


@dataclass(frozen=True)
class Result:
    """What happened in one run or in many.

    Attributes
    ----------
    scenario : Scenario
        What was run.
    data : xarray.Dataset
        Dims ``run``, ``axle``, ``vehicle``, ``time``, ``cell``; every variable with ``units``,
        ``long_name`` and ``symbol`` (the glossary lists them all).
    """

    scenario: Scenario
    data: xr.Dataset

    @property
    def status(self) -> RunStatus:
        """How the (first) run ended."""
        return RunStatus(int(self.data["status"].values[0]))

    @property
    def sentence(self) -> str:
        """How the (first) run ended, in words."""
        raised = self.status == RunStatus.CONTROLLER_FAILED and self.data.attrs.get("failure")
        return str(raised) if raised else sentence(self.status)

    def __getitem__(self, name: str) -> Any:
        return self.data[name]

    def __str__(self) -> str:
        n_runs = self.data.sizes["run"]
        stopped = int((self.data["status"] == RunStatus.STOPPED).sum())
        distance = self.data["stopping_distance"].values
        head = f"{self.scenario.title or 'untitled scenario'}: "
        if n_runs == 1 and "covered_distance" in self.data:
            covered = float(self.data["covered_distance"].values[0])
            return f"{head}{self.sentence} {covered:.1f} m covered."
        if n_runs == 1:
            return f"{head}{self.sentence} {distance[0]:.1f} m after the brake command."
        median = float(np.nanmedian(distance)) if stopped else float("nan")
        return f"{head}{stopped} of {n_runs} runs stopped, median {median:.1f} m."

    @classmethod
    def from_arrays(
        cls,
        scenario: Scenario,
        plan: Plan,
        out: Outcome,
        rail: Memory | None,
        wsp_parameters: dict[str, float],
        failures: dict[int, str] | None = None,
    ) -> Result:
        """Name the kernel's columns; ``failures`` says what controllers raised, by run."""
        import xarray as xr

        import railgrip

        variables: dict[str, tuple[tuple[str, ...], FloatArray]] = {}
        variables |= _outcomes(scenario, out)
        coords: dict[str, Any] = {
            "axle": ("axle", [place.label for place in scenario.train.axles()]),
            "vehicle": ("vehicle", [f"C1-V{i + 1}" for i in range(len(scenario.train.vehicle))]),
        }
        if out.trace_train.shape[0]:
            traces, time = _traces(scenario, plan, out)
            variables |= traces
            coords["time"] = ("time", time, {"units": "s", "long_name": "Time since the start."})
        if rail is not None:
            cells, position = _rail(plan, rail, float(out.train[0, -2]))
            variables |= cells
            coords["cell"] = (
                "cell", position, {"units": "m", "long_name": "Position on the line."},
            )  # fmt: skip
        if not drives(scenario):
            variables = {name: v for name, v in variables.items() if name not in OF_DRIVING}
        if not scenario.wsp.unit:
            variables = {name: v for name, v in variables.items() if name not in OF_UNITS}
        traction = scenario.train.traction
        if traction is None or traction.driveline is None:
            variables = {n: v for n, v in variables.items() if n not in OF_DRIVELINE}
        if scenario.brake_control is None:
            variables = {n: v for n, v in variables.items() if n not in OF_BRAKE_CONTROL}
        data = xr.Dataset(
            {name: (dims, values, attributes(name)) for name, (dims, values) in variables.items()},
            coords=coords,
            attrs={
                "title": scenario.title,
                "scenario_json": scenario.model_dump_json(by_alias=True),
                "railgrip_version": railgrip.__version__,
                "seed": scenario.run.seed,
                "creep_law": scenario.run.creep_law,
                "creep_law_error": plan.creep_tables.error,
                "controller": str(scenario.wsp),
                "failure": next(iter((failures or {}).values()), ""),
                "faults": "\n".join(map(str, scenario.fault)),
                "wsp_parameters": json.dumps(wsp_parameters),
            },
        )
        return cls(scenario, data)


Variables = dict[str, tuple[tuple[str, ...], FloatArray]]


def _outcomes(scenario: Scenario, out: Outcome) -> Variables:
    table = dict(zip(TRAIN_OUTCOMES, out.train.T, strict=True))
    found: Variables = {name: (("run",), table[name]) for name in TRAIN_OUTCOMES if name in SIGNALS}
    found["status"] = (("run",), table["status"].astype(np.int8))
    speed = table["initial_speed"]
    distance = table["stopping_distance"] - speed * table["build_up_time"]
    found["deceleration_distance"] = (("run",), distance)
    with np.errstate(divide="ignore", invalid="ignore"):
        found["mean_deceleration"] = (("run",), speed**2 / (2 * distance))
    taken = sum(table[f"energy_{name}"] for name in (
        "contact", "brake", "dynamic", "track_brake", "resistance", "gradient", "driveline",
    ))  # fmt: skip
    given = table["energy_kinetic_initial"] + table["energy_traction"]
    residual = given - table["energy_kinetic_final"] - taken
    found["energy_balance"] = (("run",), residual / np.maximum(given, 1.0))
    axle = dict(zip(AXLE_OUTCOMES, np.moveaxis(out.axle, 2, 0), strict=True))
    found |= {name: (("run", "axle"), axle[name]) for name in AXLE_OUTCOMES if name in SIGNALS}
    radius = np.array([place.axle.wheel_radius for place in scenario.train.axles()])
    found["axle_flat_length"] = (
        ("run", "axle"), flat_length(axle["axle_locked_slide"], radius),
    )  # fmt: skip
    return found


def figures_of(scenario: Scenario, out: Outcome) -> dict[str, FloatArray]:
    """Return what a batch amounts to: one value for each run, or for each run and axle."""
    return {name: values for name, (_, values) in _outcomes(scenario, out).items()}


def flat_length(locked_work: FloatArray, wheel_radius: FloatArray) -> FloatArray:
    """Return the length of the flat that locked sliding grinds into each wheel.

    Parameters
    ----------
    locked_work : float array
        Friction work of an axle (two wheels) while it was locked [J].
    wheel_radius : float array
        [m].

    Notes
    -----
    A chord of length l cuts the volume B l³/(12 r) off a wheel; the volume is the friction work of
    one wheel times `FLAT_WEAR`. The wear rate is illustrative: use it to compare.

    Examples
    --------
    >>> round(float(flat_length(np.array([2e6]), np.array([0.46]))[0]) * 1e3, 1)
    30.2
    """
    volume = FLAT_WEAR * np.maximum(locked_work, 0.0) / 2
    length: FloatArray = np.cbrt(12 * wheel_radius * volume / TREAD_WIDTH)
    return length


def _traces(scenario: Scenario, plan: Plan, out: Outcome) -> tuple[Variables, FloatArray]:
    timing = plan.timing
    rows = np.ceil(np.round(out.train[:, -1] / timing.tick + 1) / timing.trace_every).astype(int)
    n_rows = min(int(rows.max()), out.trace_train.shape[1])
    time = timing.tick * timing.trace_every * np.arange(n_rows)
    after = np.arange(n_rows)[None, :] >= rows[:, None]
    train = np.where(after[:, :, None], np.nan, out.trace_train[:, :n_rows])
    axle = np.where(after[:, :, None, None], np.nan, out.trace_axle[:, :n_rows])
    vehicle = np.where(after[:, :, None], np.nan, out.trace_vehicle[:, :n_rows])
    of_train = {name: train[:, :, i] for i, name in enumerate(TRAIN_TRACES)}
    of_axle = {name: np.moveaxis(axle[:, :, :, i], 2, 1) for i, name in enumerate(AXLE_TRACES)}
    found: Variables = {
        name: (("run", "time"), values)
        for name, values in of_train.items()
        if name != "track_brake_force"
    }
    speed = of_train["train_speed"][:, None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        of_axle["creepage"] = np.where(
            speed > 0.01, (of_axle["wheel_speed"] - speed) / speed, np.nan
        )
    # before the first tick no pad has rubbed yet
    if n_rows > 1:
        of_axle["pad_friction"][:, :, 0] = of_axle["pad_friction"][:, :, 1]
    believed = of_train["reference_speed"][:, None, :]
    believed = of_axle["unit_reference_speed"] if scenario.wsp.unit else believed
    of_axle["slip_speed"] = believed - of_axle["measured_speed"]
    with np.errstate(invalid="ignore", divide="ignore"):
        of_axle["adhesion_used"] = np.abs(of_axle["contact_force"]) / of_axle["wheel_load"]
    of_axle["adhesion_available"] = available_adhesion(scenario, plan, of_axle, speed)
    of_axle["adhesion_asked"] = _asked(plan, of_axle)
    found |= {
        name: (("run", "axle", "time"), values)
        for name, values in of_axle.items()
        if name in SIGNALS
    }
    air = np.moveaxis(vehicle, 2, 1)
    found["reservoir_pressure"] = (
        ("run", "vehicle", "time"), air if scenario.train.reservoir else np.full_like(air, np.nan),
    )  # fmt: skip
    found["track_brake_force"] = (
        ("run", "vehicle", "time"), _magnets(scenario, of_train["track_brake_force"]),
    )  # fmt: skip
    found["adhesion_utilisation"] = (("run",), _utilisation(of_train, of_axle))
    return found, time


def _magnets(scenario: Scenario, force: FloatArray) -> FloatArray:
    of_vehicle = np.array([v.track_brake.force if v.track_brake else 0.0
                           for v in scenario.train.vehicle])  # fmt: skip
    share = of_vehicle / max(float(of_vehicle.sum()), 1.0)
    spread: FloatArray = force[:, None, :] * share[None, :, None]
    return spread


def _asked(plan: Plan, of_axle: dict[str, FloatArray]) -> FloatArray:
    """Return what friction brake and motor would bring to the tread were the valve open."""

    def of(offset: int) -> FloatArray:
        column: FloatArray = plan.parameters[1:, offset - at.FIRST_PARAMETER]
        return column[None, :, None]

    clamp = of(at.CLAMP_PER_PRESSURE) * of_axle["supply_pressure"] + of(at.CLAMP_OFFSET)
    force = np.maximum(clamp, 0.0) * of_axle["pad_friction"] * of(at.TREAD_PER_CLAMP)
    with np.errstate(invalid="ignore", divide="ignore"):
        asked: FloatArray = (force + np.abs(of_axle["dynamic_force"])) / of_axle["wheel_load"]
    return asked


def _utilisation(of_train: dict[str, FloatArray], of_axle: dict[str, FloatArray]) -> FloatArray:
    """Return force used over force available, summed over the distance of sliding axles."""
    way = of_train["train_speed"][:, None, :] * of_axle["wheel_load"]
    sliding = np.abs(of_axle["creepage"]) > 0.01
    weight = np.where(sliding, way, 0.0)
    used = np.nansum(weight * of_axle["adhesion_used"], axis=(1, 2))
    available = np.nansum(weight * of_axle["adhesion_available"], axis=(1, 2))
    with np.errstate(divide="ignore", invalid="ignore"):
        share: FloatArray = np.where(available > 0, used / available, np.nan)
    return share


def _rail(plan: Plan, rail: Memory, front: float) -> tuple[Variables, FloatArray]:
    way = plan.way
    front = front if np.isfinite(front) else way.origin
    n_cells = int((front - way.origin) / way.cell_length) + 2
    n_cells = min(max(n_cells, 0), len(rail.ring_energy), len(way.condition_of_cell))
    cells = np.arange(n_cells)
    position = np.array(way.origin + (cells + 0.5) * way.cell_length, dtype=np.float64)
    rows = way.conditions[0, way.condition_of_cell[:n_cells]]
    before = rows[:, 0] * rail.ring_factor[:n_cells]
    clean = np.maximum(rows[:, 5], before)
    energy, sand = rail.ring_energy[:n_cells], rail.ring_sand[:n_cells]
    after = clean + np.exp(-rows[:, 10] * energy) * (before - clean)
    effect = 1 - np.exp(-sand / way.effective_sand)
    after = after + effect * np.maximum(way.sand_friction - after, 0.0)
    found: Variables = {
        "rail_energy": (("run", "cell"), energy[None]),
        "rail_friction_before": (("run", "cell"), before[None]),
        "rail_friction_after": (("run", "cell"), after[None]),
        "rail_sand": (("run", "cell"), sand[None]),
    }
    return found, position
