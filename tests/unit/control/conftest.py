"""A small train to close the loop around a controller in unit tests; no part of the product.

Sixteen or fewer equal axles, creep after Polach's form, friction blended by the energy that each
metre of rail has received, cylinders with dead times, toothed wheels with a timer. It is written
apart from the engine on purpose: a controller that only works with one plant is not trusted.
"""

from __future__ import annotations

import math
import types
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest

from railgrip.control import contract

GRAVITY = 9.81
STEP = 1e-3
TICK = 10
PERIOD = TICK * STEP
KALKER_SLOPE = 2 * 10.5e6  # N, both wheels of an axle of 12.5 t
FULL_PRESSURE = 3.0e5
CELL = 1.0


class Rail(NamedTuple):
    """Friction (contaminated, clean), its fall with slip speed, creep reductions, patches."""

    friction: float = 0.05
    ratio: float = 0.4
    decay: float = 0.2
    adhesion_reduction: float = 1.0
    slip_reduction: float = 0.4
    clean: float = 0.28
    cleaning: float = 0.0
    patch_length: float = 0.0
    patch_friction: float = 0.3


LEAVES = Rail()
DETERGENT = Rail(friction=0.06, cleaning=1.9e-4)
DRY = Rail(friction=0.3)


class Train(NamedTuple):
    """The train; masses in kg, forces in N, times in s."""

    n_axles: int = 16
    mass_per_axle: float = 12.5e3
    rotating_share: float = 0.07
    full_deceleration: float = 1.2
    dead_time: float = 0.4
    build_up: float = 1.5
    dynamic_force: float = 0.0  # on axles 0, 1, 4, 5, …
    dynamic_fade: float = 2.0
    wheel_error: float = 0.0  # first axle turns faster by this share
    lost_axle: float = -1.0  # axle whose sensor reads `lost_reading` after two seconds
    lost_reading: float = 0.0
    resistance: float = 3.0e3
    quadratic: float = 7.0
    gradient: float = 0.0


class Stop(NamedTuple):
    """What came of it; traces [tick] or [tick, axle]."""

    distance: float
    time: float
    longest_lock: float
    deep_slide: float
    vent_cycles: float
    speed: np.ndarray
    reference: np.ndarray
    wheel_speed: np.ndarray
    pressure: np.ndarray
    valve: np.ndarray
    dynamic: np.ndarray
    sanding: np.ndarray
    alarm: np.ndarray


def compiled(function: Any) -> Any:
    """Return a plain function compiled with the plain functions that it calls."""
    scope = dict(function.__globals__)
    for name in function.__code__.co_names:
        callee = scope.get(name)
        if isinstance(callee, types.FunctionType) and callee is not function:
            scope[name] = compiled(callee)
    bound = types.FunctionType(
        function.__code__, scope, function.__name__, None, function.__closure__
    )
    return numba.njit(bound, error_model="numpy")


@numba.njit
def polach(friction, ratio, decay, k_a, k_s, load, speed, slip_speed):
    available = friction * load * ((1 - ratio) * math.exp(-decay * abs(slip_speed)) + ratio)
    creepage = slip_speed / max(speed, 0.5)
    gradient = 0.25 * math.pi * KALKER_SLOPE * creepage / available
    ka = k_a * gradient
    return 2 * available / math.pi * (ka / (1 + ka * ka) + math.atan(k_s * gradient))


def make_plant(kernel: Any, initial: Any) -> Any:
    """Return the plant compiled around one controller."""

    @numba.njit
    def run(rail, train, parameters, setup, state, speed, is_held, demand, wheels, pressures,
            valves, trace, shares, sands, alarms, rail_energy):  # fmt: skip
        (friction0, ratio, decay, k_a0, k_s0, clean, cleaning, patch, patch_friction) = rail
        (_, mass, rotating, full, dead, build_up, dynamic, fade, wheel_error, lost, lost_reading,
         resistance, quadratic, gradient) = train  # fmt: skip
        n = setup.shape[0]
        m_rot = rotating * mass
        force_full = full * (mass + m_rot)
        position = 400.0
        begin = position
        wheel = np.full(n, speed)
        rolled = np.zeros(n)
        edges = np.zeros(n)
        edge_time = np.zeros(n)
        reading = np.full(n, speed)
        pressure = np.zeros(n)
        dyn = np.zeros(n)
        measured = np.zeros((n, contract.N_MEASURED))
        command = np.zeros((n, contract.N_COMMAND))
        command[:, contract.DYNAMIC_SHARE] = 1.0
        vent_since = np.zeros(n)
        fill_since = np.zeros(n)
        lock_now = np.zeros(n)
        entry_energy = np.zeros(n)
        cell_now = np.full(n, -1)
        longest_lock = 0.0
        deep = 0.0
        cycles = 0.0
        pitch = 2 * math.pi * 0.46 / 100
        tick = 0
        deceleration = 0.0
        n_ticks = trace.shape[0]
        while tick < n_ticks and speed > 0.02:
            now = tick * PERIOD
            for i in range(n):
                measured[i, contract.WHEEL_SPEED] = reading[i]  # one period old: the delay
                if i == lost and now > 2.0:
                    measured[i, contract.WHEEL_SPEED] = lost_reading
                measured[i, contract.CYLINDER_PRESSURE] = pressure[i]
                measured[i, contract.DYNAMIC_FORCE] = dyn[i]
                measured[i, contract.BRAKE_DEMAND] = demand
                measured[i, contract.EMERGENCY] = 1.0
                count = math.floor(rolled[i] / pitch)
                if count > edges[i]:
                    edge = now - (rolled[i] - count * pitch) / max(wheel[i], 1e-3)
                    edge = math.floor(edge * 1e5) * 1e-5
                    if edge > edge_time[i]:
                        reading[i] = (count - edges[i]) * pitch / (edge - edge_time[i])
                    edges[i] = count
                    edge_time[i] = edge
                elif now - edge_time[i] > pitch / max(reading[i], 1e-3):
                    reading[i] = pitch / (now - edge_time[i])
            if tick == 0:
                initial(parameters, setup, state, measured)
            kernel(parameters, setup, state, measured, command, PERIOD)
            trace[tick, 0] = speed
            trace[tick, 1] = command[0, contract.REFERENCE_SPEED]
            for i in range(n):
                valve = command[i, contract.DUMP_VALVE]
                if valve == contract.VENT:
                    if vent_since[i] == 0.0:
                        cycles += 1
                    vent_since[i] += PERIOD
                else:
                    vent_since[i] = 0.0
                fill_since[i] = fill_since[i] + PERIOD if valve == contract.FILL else 0.0
                wheels[tick, i] = wheel[i]
                pressures[tick, i] = pressure[i]
                valves[tick, i] = valve
                shares[tick, i] = command[i, contract.DYNAMIC_SHARE]
                sands[tick, i] = command[i, contract.SANDING]
                alarms[tick, i] = command[i, contract.ALARM]
                is_locked = wheel[i] < 0.05 * speed
                lock_now[i] = lock_now[i] + PERIOD if is_locked else 0.0
                if speed > 30 / 3.6:
                    longest_lock = max(longest_lock, lock_now[i])
                    if wheel[i] < 0.5 * speed:
                        deep += PERIOD / n
            for sub in range(TICK):
                supply = demand * min(1.0, max(0.0, (now + sub * STEP - dead) / build_up))
                total = 0.0
                for i in range(n):
                    wants = supply * FULL_PRESSURE
                    wanted_dynamic = 0.0
                    if dynamic > 0.0 and setup[i, contract.MOTORED] > 0.0:
                        ramp = min(1.0, max(0.0, (speed - 1.0) / fade))
                        wanted_dynamic = (
                            dynamic * supply * ramp * command[i, contract.DYNAMIC_SHARE]
                        )
                        wants = max(0.0, wants - dyn[i] / force_full * FULL_PRESSURE)
                    dyn[i] += STEP / 0.1 * (wanted_dynamic - dyn[i])
                    if vent_since[i] > 0.05:
                        pressure[i] -= STEP / 0.31 * pressure[i]
                    elif fill_since[i] > 0.06 and pressure[i] < wants:
                        pressure[i] += STEP / 0.35 * (wants - pressure[i])
                    elif pressure[i] > wants:
                        pressure[i] -= STEP / 0.5 * (pressure[i] - wants)
                    place = i % 4
                    shift = (0.03 if place % 2 == 0 else -0.03) + (0.02 if place < 2 else -0.02)
                    load = mass * GRAVITY * (1 + shift * deceleration / 1.2)
                    here = position - 9.0 * i
                    cell = int(here / CELL) % rail_energy.shape[0]
                    if cell != cell_now[i]:
                        cell_now[i] = cell
                        entry_energy[i] = rail_energy[cell]
                    blend = 1 - math.exp(-cleaning * entry_energy[i])
                    friction = friction0 + (clean - friction0) * blend
                    k_a = k_a0 + (0.3 - k_a0) * blend
                    k_s = k_s0 + (0.1 - k_s0) * blend
                    if patch > 0.0 and int(here / patch) % 2 == 1:
                        friction = patch_friction
                    slip = speed - wheel[i]
                    contact = polach(friction, ratio, decay, k_a, k_s, load, speed, slip)
                    above = polach(friction, ratio, decay, k_a, k_s, load, speed, slip + 1e-4)
                    stiffness = max(0.0, (above - contact) / 1e-4)
                    brake = pressure[i] / FULL_PRESSURE * force_full + dyn[i]
                    change = STEP * (contact - brake) / (m_rot + STEP * stiffness)
                    new = wheel[i] + change
                    if new < 0.0:  # the brake holds a wheel that stands
                        new = 0.0
                    contact -= stiffness * (new - wheel[i])
                    wheel[i] = new
                    rolled[i] += STEP * new * (1 + (wheel_error if i == 0 else 0.0))
                    rail_energy[cell] += abs(contact * (speed - new)) * STEP / CELL
                    total += contact
                drag = resistance + quadratic * speed * speed
                deceleration = (total + drag) / (n * mass) + gradient * GRAVITY
                if is_held == 0.0:  # else the brake drags on a gradient that holds the speed
                    speed -= STEP * deceleration
                position += STEP * speed
                if speed <= 0.0:
                    break
            tick += 1
        return position - begin, tick, longest_lock, deep, cycles

    return run


_plants: dict[Any, Any] = {}


def stop(
    controller: Any,
    rail: Rail,
    train: Train | None = None,
    *,
    speed: float = 160 / 3.6,
    demand: float = 1.0,
    time_limit: float = 150.0,
    hold_speed: bool = False,
) -> Stop:
    """Brake the train to a stand under a controller and return what happened."""
    train = Train() if train is None else train
    pair = (controller.kernel, controller.initial)
    if pair not in _plants:
        _plants[pair] = make_plant(compiled(pair[0]), compiled(pair[1]))
    n = train.n_axles
    ticks = round(time_limit / PERIOD)
    axles = np.arange(n)
    motored = (axles % 4 < 2) & (train.dynamic_force > 0)
    setup = contract.Setup(n, PERIOD, np.full(n, 0.46), motored, np.ones(n, dtype=bool))
    traces = [np.zeros((ticks, n)) for _ in range(6)]
    wheels, pressures, valves, shares, sands, alarms = traces
    trace = np.zeros((ticks, 2))
    distance, used, lock, deep, cycles = _plants[pair](
        tuple(rail), tuple(float(x) for x in train), np.array(controller.parameters, dtype=float),
        contract.setup_array(setup), np.zeros(controller.state_size(n)), speed,
        1.0 if hold_speed else 0.0, demand, wheels, pressures, valves, trace, shares, sands,
        alarms, np.zeros(8000),
    )  # fmt: skip
    trace = trace[:used]
    return Stop(
        distance, used * PERIOD, lock, deep, cycles, trace[:, 0], trace[:, 1],
        wheels[:used], pressures[:used], valves[:used], shares[:used], sands[:used], alarms[:used],
    )  # fmt: skip


@pytest.fixture(scope="session")
def plant() -> Any:
    """The test train: plant.stop(controller, plant.LEAVES) and its words."""
    return types.SimpleNamespace(
        stop=stop, compiled=compiled, Train=Train, LEAVES=LEAVES, DETERGENT=DETERGENT, DRY=DRY
    )
