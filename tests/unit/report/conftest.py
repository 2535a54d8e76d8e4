"""Datasets to report on: a stop of a train that slides, integrated here in a few lines.

The engine's train is far better; this one needs nothing but numpy, so that a wrong picture or a
wrong table is the report's own fault.
"""

from __future__ import annotations

import json
from collections.abc import Callable

import numpy as np
import pytest
import xarray as xr

from railgrip.core.signals import SIGNALS, attributes

STEP, EVERY = 0.01, 2  # s; every second step is kept
GRID = np.geomspace(1e-4, 1.0, 60)  # creepages among which the greatest adhesion is sought
AXLE_OUTCOMES = (
    "slid_energy", "locked_time", "longest_lock", "slid_distance", "slide_time", "greatest_slip",
    "valve_cycles",
)  # fmt: skip


def adhesion(friction, creepage, speed):
    """Adhesion rises with creepage, then the friction falls with the speed of sliding."""
    falling = friction * (0.4 * np.exp(-0.15 * creepage * speed) + 0.6)
    x = 1.2 * creepage / friction * 8.0
    return falling * 2 / np.pi * (x / (1 + x * x) + np.arctan(x))


def build(variables, coords, **attrs):
    """A dataset with the names, dims and attributes that the engine gives."""
    named = {}
    for name, values in variables.items():
        values = np.asarray(values)[None]
        named[name] = (("run", *SIGNALS[name].dims), values, attributes(name))
    coords = {**coords, "time": ("time", coords["time"], {"units": "s"})}
    if "cell" in coords:
        coords["cell"] = ("cell", coords["cell"], {"units": "m"})
    return xr.Dataset(named, coords={"run": [0], **coords}, attrs=attrs)


class Slide:
    """A stop of four-axle vehicles over 500 m of leaves, stepped by Euler, wheels implicitly."""

    def __init__(self, vehicles: int, speed: float, protected: bool) -> None:
        n = 4 * vehicles
        self.vehicle, self.start = np.repeat(np.arange(vehicles), 4), speed
        self.protected = protected
        self.behind = self.vehicle * 20.0 + np.tile([3.0, 5.5, 14.0, 16.5], vehicles)
        self.load = 13e3 * 9.81 * np.tile([1.04, 0.99, 1.01, 0.96], vehicles)
        self.mass, self.rotating, self.asked = self.load.sum() / 9.81, 900.0, np.full(n, 14.95e3)
        self.cell = np.arange(-20.0 * vehicles, 2200.0, 2.0)
        leaves = (self.cell > 150) & (self.cell < 650)
        self.dirty, self.clean = np.where(leaves, 0.055, 0.16), np.where(leaves, 0.11, 0.2)
        self.received = np.zeros_like(self.cell)
        self.time, self.train, self.position, self.wheels = 0.0, speed, 0.0, np.full(n, speed)
        self.reference = speed if protected else np.nan
        self.motored = (self.vehicle == 0).astype(float)
        self.pressure, self.valve, self.dynamic = (np.zeros(n) for _ in range(3))
        self.ring, self.hub = np.full(n, 20.0), np.full(n, 20.0)
        self.reservoir, self.air = np.full(vehicles, 7e5), 0.0
        self.work = dict.fromkeys(["contact", "brake", "resistance", "dynamic"], 0.0)
        self.axle = {name: np.zeros(n) for name in AXLE_OUTCOMES}
        self.lock, self.used, self.available, self.active = np.zeros(n), 0.0, 1.0, []
        self.rows: dict[str, list] = {}

    def rail(self):
        return self.clean - (self.clean - self.dirty) * np.exp(-4e-5 * self.received)

    def step(self, keep: bool) -> None:
        train, wheels, load = self.train, self.wheels, self.load
        place = ((self.position - self.behind - self.cell[0]) / 2.0).astype(int)
        here = np.clip(place, 0, len(self.cell) - 1)
        friction = self.rail()[here]
        creepage = (train - wheels) / max(train, 0.3)
        tau = adhesion(friction, np.abs(creepage), train) * np.sign(creepage)
        more = adhesion(friction, np.abs(creepage) + 1e-4, train)
        slope = np.maximum(more - np.abs(tau), 0) / 1e-4
        force, dynamic = tau * load, self.motored * self.dynamic
        brake = np.maximum(self.pressure / 3e5 * self.asked - dynamic, 0)
        brake = np.where(wheels > 0.02, brake, np.minimum(brake, force))
        stiff = self.rotating + STEP * slope * load / max(train, 0.3)
        new = np.maximum(wheels + STEP * (force - brake - dynamic) / stiff, 0.0)
        force = self.rotating * (new - wheels) / STEP + brake + dynamic
        drag = 3000 + 110 * train + 7 * train**2
        acceleration = -(force.sum() + drag) / self.mass
        middle, centre = (wheels + new) / 2, train + acceleration * STEP / 2
        self._account(here, force, brake, dynamic, drag, middle, centre)
        peak = adhesion(friction[:, None], GRID, train).max(axis=1)
        self._watch(creepage, tau, peak)
        if keep:
            self._keep(acceleration, creepage, force, peak, tau, brake, dynamic, friction)
        gain = (new - wheels) / STEP
        self.wheels, self.position = new, self.position + centre * STEP
        self.train, self.time = train + acceleration * STEP, self.time + STEP
        if self.protected:
            self._protect(gain)
        self._fill()
        self._heat(0.9 * brake * middle)

    def _account(self, here, force, brake, dynamic, drag, middle, centre) -> None:
        friction_work = np.abs(force) * np.abs(centre - middle) * STEP
        np.add.at(self.received, here, friction_work / 2.0)
        self.axle["slid_energy"] += friction_work
        self.work["contact"] += friction_work.sum()
        self.work["brake"] += (brake * middle).sum() * STEP
        self.work["dynamic"] += (dynamic * middle).sum() * STEP
        self.work["resistance"] += drag * centre * STEP

    def _watch(self, creepage, tau, peak) -> None:
        is_locked = (self.wheels < 0.05 * self.train) & (self.train > 1)
        self.lock = np.where(is_locked, self.lock + STEP, 0.0)
        axle, sliding = self.axle, creepage > 0.05
        axle["locked_time"] += is_locked * STEP
        axle["longest_lock"] = np.maximum(axle["longest_lock"], self.lock)
        axle["slid_distance"] += np.where(sliding, self.train - self.wheels, 0) * STEP
        axle["slide_time"] += sliding * STEP
        if self.train > 3:
            axle["greatest_slip"] = np.maximum(axle["greatest_slip"], creepage)
        weight = self.load * self.train * sliding
        self.used, self.available = self.used + tau @ weight, self.available + peak @ weight
        self.active.append((creepage > 0.1).mean())

    def _keep(self, acceleration, creepage, force, peak, tau, brake, dynamic, friction) -> None:
        demand = float(self.time > 1.0)
        values = {
            "train_speed": self.train, "train_position": self.position,
            "acceleration": acceleration, "reference_speed": self.reference,
            "brake_demand": demand, "wheel_speed": self.wheels,
            "measured_speed": np.round(self.wheels / 0.02) * 0.02, "creepage": -creepage,
            "slip_speed": self.reference - self.wheels, "wheel_load": self.load,
            "contact_force": -force, "adhesion_available": peak, "adhesion_used": tau,
            "adhesion_asked": self.asked / self.load * demand,
            "brake_cylinder_pressure": self.pressure, "dump_valve": self.valve,
            "brake_force": brake, "dynamic_force": dynamic, "disc_temperature": self.ring,
            "hub_temperature": self.hub, "rail_friction": friction,
            "reservoir_pressure": self.reservoir,
        }  # fmt: skip
        for name, value in values.items():
            self.rows.setdefault(name, []).append(np.copy(value))

    def _protect(self, gain) -> None:
        self.reference = max(self.wheels.max(), self.reference - 1.2 * STEP)
        slip = (self.reference - self.wheels) / max(self.reference, 0.5)
        careful = np.arange(len(slip)) % 4 == 3  # lets one axle of a vehicle run with little slip
        vent = (slip > 0.22) | ((gain < -3.5) & (slip > 0.03)) | (careful & (slip > 0.06))
        hold = (slip > 0.10) | ((gain < 0.5) & (slip > 0.03)) | (careful & (slip > 0.03))
        wanted = np.where(vent, 2, np.where(hold, 1, 0)) * (self.reference > 1.4)
        self.axle["valve_cycles"] += (wanted == 2) & (self.valve != 2)
        self.valve = wanted
        share = 0.3 if slip[self.vehicle == 0].max() > 0.1 else 1
        self.dynamic = 5e3 * share * (self.time > 1.0) * (self.train > 3)

    def _fill(self) -> None:
        target = 3e5 * (self.time > 1.3) * np.minimum(1, self.reservoir[self.vehicle] / 4e5)
        flow = np.where(self.valve == 0, np.clip((target - self.pressure) * 2.2, -3e5, 1e5), 0)
        flow = np.where(self.valve == 2, -3.5 * self.pressure, flow)
        self.pressure = np.maximum(self.pressure + STEP * flow, 0)
        taken = np.bincount(self.vehicle, 0.012 * np.maximum(flow, 0) * STEP)
        self.reservoir, self.air = self.reservoir - taken / 0.15, self.air + taken.sum() / 1e5

    def _heat(self, heat) -> None:
        between = 450.0 * (self.ring - self.hub)
        wind = (20 + 2 * self.train) * (self.ring - 20)
        self.ring = self.ring + STEP * (heat - between - wind) / (62 * 480)
        self.hub = self.hub + STEP * (between - 8 * (self.hub - 20)) / (55 * 480)

    def outcomes(self):
        rotating = 0.5 * self.rotating
        initial = 0.5 * self.mass * self.start**2 + rotating * len(self.wheels) * self.start**2
        final = 0.5 * self.mass * self.train**2 + rotating * (self.wheels**2).sum()
        distance = self.position - self.start  # the brake command comes after one second
        braked = distance - 1.1 * self.start
        self.axle["flat_length"] = 0.02 * np.sqrt(self.axle["locked_time"])
        self.axle["greatest_disc_temperature"] = np.max(self.rows["disc_temperature"], axis=0)
        return {
            "rail_energy": self.received, "rail_friction_before": self.dirty,
            "rail_friction_after": self.rail(), "rail_sand": np.zeros_like(self.cell),
            "status": 1, "initial_speed": self.start, "stopping_distance": distance,
            "stopping_time": self.time - 1.0, "build_up_time": 1.1,
            "deceleration_distance": braked, "mean_deceleration": self.start**2 / 2 / braked,
            "adhesion_utilisation": self.used / self.available,
            "slide_activity": np.mean(self.active), "air_used": self.air,
            "energy_kinetic_initial": initial, "energy_kinetic_final": final,
            "energy_track_brake": 0.0, "energy_gradient": 0.0,
            "energy_rail": self.work["contact"],
            "energy_balance": abs(initial - final - sum(self.work.values())) / initial,
            **{f"energy_{name}": value for name, value in self.work.items()},
            **{f"axle_{name}": value for name, value in self.axle.items()},
        }  # fmt: skip


def slide(vehicles=4, speed=160 / 3.6, protected=True, title="Four-car train on leaves"):
    """Stop a train and name everything as the engine does."""
    run, k = Slide(vehicles, speed, protected), 0
    while run.train > 0.05 and k < 30000:
        run.step(keep=k % EVERY == 0)
        k += 1
    variables = {name: np.asarray(values).T for name, values in run.rows.items()}
    places = [f"V{v + 1}-B{b}-A{a}" for v in range(vehicles) for b in (1, 2) for a in (1, 2)]
    coords = {
        "axle": [f"C1-{place}" for place in places],
        "vehicle": [f"C1-V{v + 1}" for v in range(vehicles)],
        "time": np.arange(len(run.rows["train_speed"])) * STEP * EVERY, "cell": run.cell,
    }  # fmt: skip
    scenario = {"title": title, "wsp": {"controller": "conventional", "parameters": {}}}
    return build(
        variables | run.outcomes(), coords, title=title, railgrip_version="0.1.0", seed=1,
        scenario_json=json.dumps(scenario),
    )  # fmt: skip


def by_hand():
    """Two axles, 20 m/s, 1 m/s² from the first moment on: every figure can be worked out."""
    time = np.arange(0.0, 20.01, 0.5)
    speed = 20.0 - time
    axles = np.vstack([speed, 0.9 * speed])  # the second axle slips by a tenth all the way
    variables = {
        "train_speed": speed,
        "train_position": 1000.0 + 20 * time - time**2 / 2,
        "acceleration": np.full_like(time, -1.0),
        "reference_speed": speed,
        "brake_demand": np.ones_like(time),
        "wheel_speed": axles,
        "measured_speed": axles,
        "brake_cylinder_pressure": np.full_like(axles, 3e5),
        "dump_valve": np.zeros(axles.shape, np.int8),
        "adhesion_available": np.full_like(axles, 0.15),
        "adhesion_used": np.full_like(axles, 0.10),
        "reservoir_pressure": np.full((1, 41), 7e5),
        "disc_temperature": np.vstack([20 + 5 * time, 20 + 4 * time]),
        "status": 1,
        "initial_speed": 20.0,
        "stopping_distance": 200.0,
        "stopping_time": 20.0,
        "build_up_time": 0.0,
        "deceleration_distance": 200.0,
        "mean_deceleration": 1.0,
        "adhesion_utilisation": 2 / 3,
        "slide_activity": 0.25,
        "air_used": 0.048,
        "energy_kinetic_initial": 10e6,
        "energy_kinetic_final": 0.0,
        "energy_contact": 0.5e6,
        "energy_brake": 8e6,
        "energy_dynamic": 1e6,
        "energy_track_brake": 0.0,
        "energy_resistance": 0.3e6,
        "energy_gradient": 0.2e6,
        "energy_rail": 0.5e6,
        "energy_balance": 1e-9,
        "axle_slid_distance": [0.0, 20.0],
        "axle_slid_energy": [0.1e6, 0.4e6],
        "axle_locked_time": [0.0, 1.5],
        "axle_longest_lock": [0.0, 0.7],
        "axle_greatest_slip": [0.01, 0.1],
        "axle_slide_time": [0.0, 20.0],
        "axle_greatest_disc_temperature": [120.0, 100.0],
        "axle_flat_length": [0.0, 0.012],
        "axle_valve_cycles": [0, 7],
    }
    coords = {"axle": ["C1-V1-B1-A1", "C1-V1-B1-A2"], "vehicle": ["C1-V1"], "time": time}
    return build(
        variables, coords, title="By hand", railgrip_version="0.1.0", seed=1, scenario_json="{}"
    )


@pytest.fixture(scope="session")
def stop() -> xr.Dataset:
    """A sixteen-axle stop with slides under control."""
    return slide()


@pytest.fixture(scope="session")
def unprotected() -> xr.Dataset:
    """The same stop with locked wheels."""
    return slide(protected=False, title="Without protection")


@pytest.fixture(scope="session")
def long_train() -> xr.Dataset:
    """Eighty-four axles."""
    return slide(vehicles=21, speed=100 / 3.6, title="Freight train")


@pytest.fixture
def hand() -> xr.Dataset:
    return by_hand()


@pytest.fixture(scope="session")
def make() -> Callable[..., xr.Dataset]:
    return build
