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


def slide(vehicles=4, speed=160 / 3.6, protected=True, title="Four-car train on leaves"):
    """Stop a train of `vehicles` four-axle vehicles over 500 m of leaves."""
    n = 4 * vehicles
    vehicle = np.repeat(np.arange(vehicles), 4)
    behind = vehicle * 20.0 + np.tile([3.0, 5.5, 14.0, 16.5], vehicles)
    load = 13e3 * 9.81 * np.tile([1.04, 0.99, 1.01, 0.96], vehicles)
    rotating, asked = 900.0, 13e3 * np.full(n, 1.15)
    mass = load.sum() / 9.81
    cell = np.arange(-20.0 * vehicles, 2200.0, 2.0)
    dirty = np.where((cell > 150) & (cell < 650), 0.055, 0.16)
    clean = np.where((cell > 150) & (cell < 650), 0.11, 0.2)
    received = np.zeros_like(cell)

    def friction_at(energy):
        return clean - (clean - dirty) * np.exp(-4e-5 * energy)

    train, wheels, position, pressure = speed, np.full(n, speed), 0.0, np.zeros(n)
    reference = speed if protected else np.nan
    before, valve = wheels.copy(), np.zeros(n)
    ring, hub, reservoir, air = np.full(n, 20.0), np.full(n, 20.0), np.full(vehicles, 7e5), 0.0
    work = dict.fromkeys(["contact", "brake", "resistance", "dynamic"], 0.0)
    slid_energy, slid, locked, lock, longest = (np.zeros(n) for _ in range(5))
    time_sliding, worst, cycles, active, observed = (np.zeros(n) for _ in range(5))
    used_sum = available_sum = 0.0
    rows: dict[str, list] = {}
    motored = (vehicle == 0).astype(float)
    dynamic, t, k = np.zeros(n), 0.0, 0
    while train > 0.05 and k < 30000:
        here = np.clip(((position - behind - cell[0]) / 2.0).astype(int), 0, len(cell) - 1)
        friction = friction_at(received)[here]
        creepage = (train - wheels) / max(train, 0.3)
        tau = adhesion(friction, np.abs(creepage), train) * np.sign(creepage)
        slope = (
            adhesion(friction, np.abs(creepage) + 1e-4, train)
            - adhesion(friction, np.abs(creepage), train)
        ) / 1e-4
        force = tau * load  # of the rail, turning the wheel onwards
        brake = pressure / 3e5 * asked - motored * dynamic
        brake = np.where(wheels > 0.02, np.maximum(brake, 0), np.minimum(brake, force))
        stiff = rotating + STEP * np.maximum(slope, 0) * load / max(train, 0.3)
        new = np.maximum(wheels + STEP * (force - brake - motored * dynamic) / stiff, 0.0)
        force = rotating * (new - wheels) / STEP + brake + motored * dynamic
        drag = 3000 + 110 * train + 7 * train**2
        acceleration = -(force.sum() + drag) / mass
        mean_wheel, mean_train = (wheels + new) / 2, train + acceleration * STEP / 2
        friction_work = np.abs(force) * np.abs(mean_train - mean_wheel) * STEP
        np.add.at(received, here, friction_work / 2.0)
        slid_energy += friction_work
        work["contact"] += friction_work.sum()
        work["brake"] += (brake * mean_wheel).sum() * STEP
        work["dynamic"] += (motored * dynamic * mean_wheel).sum() * STEP
        work["resistance"] += drag * mean_train * STEP
        is_locked = (wheels < 0.05 * train) & (train > 1)
        locked += is_locked * STEP
        lock = np.where(is_locked, lock + STEP, 0.0)
        longest = np.maximum(longest, lock)
        slid += np.where(creepage > 0.05, train - wheels, 0) * STEP
        time_sliding += (creepage > 0.05) * STEP
        worst = np.maximum(worst, creepage if train > 3 else 0)
        active += creepage > 0.1
        observed += 1
        peak = adhesion(friction[:, None], GRID, train).max(axis=1)
        sliding = creepage > 0.02
        used_sum += (tau * load * train)[sliding].sum()
        available_sum += (peak * load * train)[sliding].sum()
        if k % EVERY == 0:
            values = {
                "train_speed": train, "train_position": position, "acceleration": acceleration,
                "reference_speed": reference, "brake_demand": float(t > 1.0),
                "wheel_speed": wheels, "measured_speed": np.round(wheels / 0.02) * 0.02,
                "creepage": -creepage, "slip_speed": reference - wheels, "wheel_load": load,
                "contact_force": -force, "adhesion_available": peak, "adhesion_used": tau,
                "adhesion_asked": (asked / load) * float(t > 1.0),
                "brake_cylinder_pressure": pressure, "dump_valve": valve.astype(np.int8),
                "brake_force": brake, "dynamic_force": motored * dynamic,
                "disc_temperature": ring, "hub_temperature": hub, "rail_friction": friction,
                "reservoir_pressure": reservoir,
            }
            for name, value in values.items():
                rows.setdefault(name, []).append(np.copy(value))
        gain = (new - before) / STEP
        before = new.copy()
        if protected:
            reference = max(new.max(), reference - 1.2 * STEP)
            slip = (reference - new) / max(reference, 0.5)
            vent = (slip > 0.22) | ((gain < -3.5) & (slip > 0.03))
            hold = (slip > 0.10) | ((slip > 0.03) & (gain < 0.5))
            sensed = np.arange(n) % 4 == 3  # lets one axle of a vehicle run with little slip
            hold |= sensed & (slip > 0.03)
            vent |= sensed & (slip > 0.06)
            wanted = np.where(reference < 1.4, 0, np.where(vent, 2, np.where(hold, 1, 0)))
            cycles += (wanted == 2) & (valve != 2)
            valve = wanted
            dynamic = 5e3 * (t > 1.0) * (train > 3) * (0.3 if slip[vehicle == 0].max() > 0.1 else 1)
        target = 3e5 * (t > 1.3) * np.minimum(1, reservoir[vehicle] / 4e5)
        filled = np.where(valve == 0, np.clip((target - pressure) * 2.2, -3e5, 1e5), 0)
        pressure = np.maximum(pressure + STEP * np.where(valve == 2, -3.5 * pressure, filled), 0)
        taken = np.bincount(vehicle, 0.012 * np.maximum(filled, 0) * STEP)
        reservoir = reservoir - taken / 0.15
        air += taken.sum() / 1e5
        heat = 0.9 * brake * mean_wheel
        between = 450.0 * (ring - hub)
        ring = ring + STEP * (heat - between - (20 + 2 * train) * (ring - 20)) / (62 * 480)
        hub = hub + STEP * (between - 8 * (hub - 20)) / (55 * 480)
        wheels, position = new, position + mean_train * STEP
        train += acceleration * STEP
        t, k = t + STEP, k + 1
    initial = 0.5 * (mass + n * rotating) * speed**2
    final = 0.5 * mass * train**2 + 0.5 * rotating * (wheels**2).sum()
    distance = position - speed * 1.0
    variables = {name: np.asarray(values).T for name, values in rows.items()}
    variables |= {
        "rail_energy": received, "rail_friction_before": dirty,
        "rail_friction_after": friction_at(received), "rail_sand": np.zeros_like(cell),
        "status": 1, "initial_speed": speed, "stopping_distance": distance,
        "stopping_time": t - 1.0, "build_up_time": 1.1,
        "deceleration_distance": distance - 1.1 * speed,
        "mean_deceleration": speed**2 / 2 / (distance - 1.1 * speed),
        "adhesion_utilisation": used_sum / max(available_sum, 1.0),
        "slide_activity": (active / observed).mean(), "air_used": air,
        "energy_kinetic_initial": initial, "energy_kinetic_final": final,
        "energy_track_brake": 0.0, "energy_gradient": 0.0, "energy_rail": work["contact"],
        "energy_balance": abs(initial - final - sum(work.values())) / initial,
        **{f"energy_{name}": value for name, value in work.items()},
        "axle_slid_distance": slid, "axle_slid_energy": slid_energy, "axle_locked_time": locked,
        "axle_longest_lock": longest, "axle_greatest_slip": worst,
        "axle_slide_time": time_sliding, "axle_flat_length": 0.02 * np.sqrt(locked),
        "axle_greatest_disc_temperature": variables["disc_temperature"].max(axis=1),
        "axle_valve_cycles": cycles,
    }
    labels = [f"C{a + 1}-V{a // 4 + 1}-B{a % 4 // 2 + 1}-A{a % 2 + 1}" for a in range(n)]
    coords = {
        "axle": labels, "vehicle": [f"V{v + 1}" for v in range(vehicles)],
        "time": np.arange(len(rows["train_speed"])) * STEP * EVERY, "cell": cell,
    }
    scenario = {"title": title, "wsp": {"controller": "conventional", "parameters": {}}}
    return build(
        variables, coords, title=title, version="0.1.0", seed=1,
        scenario_json=json.dumps(scenario),
    )


def by_hand():
    """Two axles, 20 m/s, 1 m/s² from the first moment on: every figure can be worked out."""
    time = np.arange(0.0, 20.01, 0.5)
    speed = 20.0 - time
    axles = np.vstack([speed, 0.9 * speed])  # the second axle slips by a tenth all the way
    variables = {
        "train_speed": speed, "train_position": 1000.0 + 20 * time - time**2 / 2,
        "acceleration": np.full_like(time, -1.0), "reference_speed": speed,
        "brake_demand": np.ones_like(time), "wheel_speed": axles, "measured_speed": axles,
        "brake_cylinder_pressure": np.full_like(axles, 3e5),
        "dump_valve": np.zeros(axles.shape, np.int8),
        "adhesion_available": np.full_like(axles, 0.15),
        "adhesion_used": np.full_like(axles, 0.10), "reservoir_pressure": np.full((1, 41), 7e5),
        "disc_temperature": np.vstack([20 + 5 * time, 20 + 4 * time]),
        "status": 1, "initial_speed": 20.0, "stopping_distance": 200.0, "stopping_time": 20.0,
        "build_up_time": 0.0, "deceleration_distance": 200.0, "mean_deceleration": 1.0,
        "adhesion_utilisation": 2 / 3, "slide_activity": 0.25, "air_used": 0.048,
        "energy_kinetic_initial": 10e6, "energy_kinetic_final": 0.0, "energy_contact": 0.5e6,
        "energy_brake": 8e6, "energy_dynamic": 1e6, "energy_track_brake": 0.0,
        "energy_resistance": 0.3e6, "energy_gradient": 0.2e6, "energy_rail": 0.5e6,
        "energy_balance": 1e-9,
        "axle_slid_distance": [0.0, 20.0], "axle_slid_energy": [0.1e6, 0.4e6],
        "axle_locked_time": [0.0, 1.5], "axle_longest_lock": [0.0, 0.7],
        "axle_greatest_slip": [0.01, 0.1], "axle_slide_time": [0.0, 20.0],
        "axle_greatest_disc_temperature": [120.0, 100.0], "axle_flat_length": [0.0, 0.012],
        "axle_valve_cycles": [0, 7],
    }
    coords = {"axle": ["C1-V1-B1-A1", "C2-V1-B1-A2"], "vehicle": ["V1"], "time": time}
    return build(
        variables, coords, title="By hand", version="0.1.0", seed=1, scenario_json="{}"
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
