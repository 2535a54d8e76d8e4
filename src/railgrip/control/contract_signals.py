"""Signals to put before a controller, and a bench that steps it through them.

The bench knows no train: wheel speeds are given, only the brake cylinders answer to the valves.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

import numpy as np

from railgrip.control.contract import (
    FILL,
    HOLD,
    VENT,
    Command,
    Controller,
    FloatArray,
    Measured,
    Setup,
)

FULL_PRESSURE: Final = 3.0e5  # Pa
FILLING_TIME: Final = 0.35  # s, time constants of an ordinary cylinder
VENTING_TIME: Final = 0.30  # s
DYNAMIC_FORCE: Final = 8.0e3  # N on a motored axle


class ContractError(Exception):
    """A controller does not keep the contract; the text says how."""


class Driven(NamedTuple):
    """What a controller commanded on the bench: [tick, axle], reference speed [tick]."""

    dump_valve: FloatArray
    dynamic_share: FloatArray
    sanding: FloatArray
    reference_speed: FloatArray


def bench_setup(n_axles: int, period: float) -> Setup:
    """Return a train of equal axles, every fourth one motored.

    Examples
    --------
    >>> bench_setup(4, 0.01).motored.tolist()
    [True, False, False, False]
    """
    return Setup(
        n_axles=n_axles,
        period=period,
        wheel_radius=np.full(n_axles, 0.46),
        motored=np.arange(n_axles) % 4 == 0,
        braked=np.ones(n_axles, dtype=bool),
    )


def dry_stop(n_axles: int, period: float, speed: float = 30.0) -> FloatArray:
    """Return the wheel speeds of a stop without any slide, [tick, axle], with a second of stand.

    The brake comes at once, with the filling time of the bench's cylinders.

    Examples
    --------
    >>> float(dry_stop(4, 0.01)[-1, 0])
    0.0
    """
    time = np.arange(0.0, speed / 1.2 + FILLING_TIME + 1.0, period)
    lost_time = FILLING_TIME * (1.0 - np.exp(-time / FILLING_TIME))
    one = np.clip(speed - 1.2 * (time - lost_time), 0.0, None)
    return np.repeat(one[:, None], n_axles, axis=1)


def locking(n_axles: int, period: float, duration: float, axle: int = 1) -> FloatArray:
    """Return wheel speeds under a drag brake, one of whose axles locks at 2 s.

    Examples
    --------
    >>> float(locking(4, 0.01, 5.0)[-1, 1])
    0.0
    """
    time = np.arange(0.0, duration, period)
    speeds = np.repeat((30.0 - 0.05 * time)[:, None], n_axles, axis=1)
    speeds[:, axle] = np.clip(speeds[:, axle] - 20.0 * np.maximum(0.0, time - 2.0), 0.0, None)
    return speeds


def faults(n_axles: int, period: float) -> FloatArray:
    """Return wheel speeds with what sensors do when they fail: NaN, 0, negative, far too fast."""
    speeds = np.repeat(dry_stop(n_axles, period)[:, :1], n_axles, axis=1)
    third = len(speeds) // 3
    speeds[third : 2 * third, 0] = np.nan
    speeds[third:, -1] = 0.0
    speeds[:third, n_axles // 2] *= -1.0
    speeds[2 * third : 2 * third + 3, 0] = 1.0e6
    speeds[2 * third + 50 : 2 * third + 60, :] = np.nan
    return speeds


def drive(
    controller: Controller,
    speeds: FloatArray,
    *,
    demand: float = 1.0,
    state: Any = None,
) -> Driven:
    """Step a controller through given wheel speeds and return what it commanded.

    Parameters
    ----------
    controller : Controller
        In its plain form.
    speeds : ndarray (tick, axle)
        Wheel speeds as measured, [m/s].
    demand : float
        Brake demand, 0..1.
    state : object, optional
        A state of the controller to go on with; a new one by default.

    Raises
    ------
    ContractError
        The command has a wrong shape, a value that is no number, or a code that is none.
    """
    n_ticks, n_axles = speeds.shape
    period = controller.period
    setup = bench_setup(n_axles, period)
    if state is None:
        state = controller.reset(setup)
    pressure = np.zeros(n_axles)
    dynamic = np.where(setup.motored, demand * DYNAMIC_FORCE, 0.0)
    valves, shares, sands = (np.empty((n_ticks, n_axles)) for _ in range(3))
    driven = Driven(valves, shares, sands, np.empty(n_ticks))
    emergency = 1.0 if demand >= 1.0 else 0.0
    for tick in range(n_ticks):
        emergency = 1.0 if demand >= 1.0 else 0.0
        given = (speeds[tick].copy(), pressure.copy(), dynamic.copy())
        command = controller.step(state, Measured(*given, demand, emergency), period)
        _refuse_written(given, (speeds[tick], pressure, dynamic))
        valve, share, sanding = refuse_wrong(command, n_axles)
        driven.dump_valve[tick] = valve
        driven.dynamic_share[tick] = share
        driven.sanding[tick] = sanding
        driven.reference_speed[tick] = command.reference_speed
        filled = pressure + period / FILLING_TIME * (demand * FULL_PRESSURE - pressure)
        vented = pressure - period / VENTING_TIME * pressure
        pressure = np.where(valve == FILL, filled, np.where(valve == VENT, vented, pressure))
        dynamic = np.where(setup.motored, demand * DYNAMIC_FORCE * share, 0.0)
    return driven


def _refuse_written(given: tuple[FloatArray, ...], kept: tuple[FloatArray, ...]) -> None:
    for name, now, before in zip(Measured._fields, given, kept, strict=False):
        if not np.array_equal(now, before, equal_nan=True):
            raise ContractError(f"step wrote into measured.{name}; copy it before changing it")


def refuse_wrong(command: Command, n_axles: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return valve, share and sanding of a command as arrays, or refuse it.

    Raises
    ------
    ContractError
        "dump_valve: got 3, allowed FILL (0), HOLD (1), VENT (2)", and the like.

    Examples
    --------
    >>> one = np.ones(2)
    >>> refuse_wrong(Command(one, one, one, 20.0), 2)[0].tolist()
    [1.0, 1.0]
    """
    if not isinstance(command, Command):
        raise ContractError(f"step returned {type(command).__name__}, allowed: a Command")
    valve = _row("dump_valve", command.dump_valve, n_axles)
    share = _row("dynamic_share", command.dynamic_share, n_axles)
    sanding = _row("sanding", command.sanding, n_axles)
    if not np.isin(valve, (FILL, HOLD, VENT)).all():
        wrong = valve[~np.isin(valve, (FILL, HOLD, VENT))][0]
        raise ContractError(f"dump_valve: got {wrong:g}, allowed FILL (0), HOLD (1), VENT (2)")
    if not ((share >= 0.0) & (share <= 1.0)).all():
        raise ContractError(f"dynamic_share: got {share.min():g}..{share.max():g}, allowed 0..1")
    if command.friction_share is not None:
        friction = _row("friction_share", command.friction_share, n_axles)
        if not ((friction >= 0.0) & (friction <= 1.0)).all():
            raise ContractError(
                f"friction_share: got {friction.min():g}..{friction.max():g}, allowed 0..1"
            )
    if not np.isin(sanding, (0.0, 1.0)).all():
        raise ContractError("sanding: allowed 0 and 1")
    reference = np.asarray(command.reference_speed, dtype=float)
    if reference.shape != () or not 0.0 <= float(reference) < np.inf:
        raise ContractError(f"reference_speed: got {command.reference_speed!r}, allowed: ≥ 0 m/s")
    return valve, share, sanding


def _row(name: str, values: Any, n_axles: int) -> FloatArray:
    try:
        row = np.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise ContractError(f"{name}: is not an array of numbers") from None
    if row.shape != (n_axles,):
        shape = "×".join(map(str, row.shape)) or "one number"
        raise ContractError(f"{name}: got shape {shape}, allowed one value for each axle")
    if not np.isfinite(row).all():
        raise ContractError(f"{name}: got {row[~np.isfinite(row)][0]}, which is no finite number")
    return row
