"""One axle under one vehicle: the model of figure 4 of the source, with a controller in its loop.

What the full train is compared with: one wheel, one mass, one force with a first-order lag, and
nothing else. It shares the creep law and the controller with the engine, and no line of the
integration.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.control.contract import AxleData, Measured, Setup
from railgrip.core.constants import GRAVITY
from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]
FrictionForce = Callable[[float, float], float]
"""Force of the rail on the axle, driving positive [N], at a wheel speed and a train speed [m/s]."""

STANDING = 0.05
"""Below this speed the stop is over, m/s."""
PARTS = 20
"""Steps of the integration in a period of the controller."""
FULL_PRESSURE = 3.0e5
"""Pressure in whose terms the clamp force is told, Pa."""


class SingleAxle(NamedTuple):
    """The vehicle.

    Parameters
    ----------
    mass : float
        What the axle carries and moves, > 0 [kg].
    rotating_mass : float
        Reduced to the tread, > 0 [kg].
    full_force : float
        Of brake, or motor when driving, at full demand, > 0 [N].
    lag : float
        Time constant of that force, > 0 [s].
    """

    mass: float
    rotating_mass: float
    full_force: float
    lag: float


class Course(NamedTuple):
    """What happened, one value a period of the controller.

    Parameters
    ----------
    time : ndarray
        [s].
    wheel_speed, train_speed : ndarray
        [m/s].
    position : ndarray
        [m].
    force, friction : ndarray
        Applied at the tread, and of the rail on the axle, driving positive [N].
    """

    time: FloatArray
    wheel_speed: FloatArray
    train_speed: FloatArray
    position: FloatArray
    force: FloatArray
    friction: FloatArray


def polach_force(rail: RailFriction, load: float, slope: float) -> FrictionForce:
    """Return Polach's law as a force over wheel and train speed.

    Parameters
    ----------
    rail : RailFriction
        State of the rail.
    load : float
        Of the axle, > 0 [N].
    slope : float
        Kalker's initial slope of the axle's two contacts, > 0 [N].

    Examples
    --------
    >>> low = RailFriction(0.06, 1.0, 0.0, 1.0, 0.4)
    >>> round(polach_force(low, 127.5e3, 14e6)(18.0, 20.0))
    -7599
    """

    def force(wheel: float, train: float) -> float:
        slip = wheel - train
        creepage = abs(slip) / max(abs(wheel), abs(train), 1e-3)
        return math.copysign(polach_2005(rail, load, slope, abs(slip), creepage), slip)

    return force


def single_axle(
    controller: Any,
    vehicle: SingleAxle,
    friction: FrictionForce,
    *,
    speed: float,
    demand: float = 1.0,
    drive: float = 0.0,
    duration: float = 300.0,
) -> Course:
    """Brake or drive one axle until it stands, or for so long.

    Parameters
    ----------
    controller : controller
        In its plain form. It sees the axle and, as a second one, a wheel without brake or motor
        that shows the true speed.
    vehicle : SingleAxle
        The vehicle.
    friction : callable
        Force of the rail, see `polach_force`.
    speed : float
        At the start, ≥ 0 [m/s].
    demand, drive : float
        What the driver asks of the brake and of the motor, 0 … 1 [-].
    duration : float
        When to end at the latest, > 0 [s].

    Returns
    -------
    Course
        The way of speeds and forces.

    Raises
    ------
    RailgripError
        "the mass (rotating mass, full force, lag) must be positive", "the speed must not be
        negative".

    Notes
    -----
    a_wheel = (F − F_friction)/m_r, a_vehicle = F_friction/M; F follows its permitted value with a
    first-order lag, exactly. Both speeds by Runge-Kutta of fourth order in steps of a twentieth of
    the controller's period; a wheel that a brake stops stands still.
    Known wrong when adhesion carries the wheel in steps longer than 1/(slope/(m_r v)): below
    0.2 m/s.

    References
    ----------
    .. [1] T. Rasel, EP 2 231 448 B1, figure 4.

    Checked by tests/agreement/test_single_axle.py: the full plant, 0.5 %.

    Examples
    --------
    >>> from railgrip.control.no_protection import NoProtection
    >>> axle = SingleAxle(13e3, 1000.0, 5e3, 0.06)
    >>> grip = polach_force(RailFriction(0.3, 1.0, 0.0, 1.0, 0.4), 127.5e3, 14e6)
    >>> course = single_axle(NoProtection(), axle, grip, speed=10.0)
    >>> round(float(course.position[-1]))  # v²/2a with a = 5 kN/14 t, and 60 ms
    141
    """
    _check(vehicle, speed)
    period = float(controller.period)
    state = controller.reset(_setup(vehicle, period, is_driven=drive > 0.0))
    wheel = train = speed
    position = force = 0.0
    rows: list[tuple[float, ...]] = []
    for tick in range(round(duration / period)):
        rows.append((tick * period, wheel, train, position, force, friction(wheel, train)))
        if drive == 0.0 and train < STANDING:
            break
        seen = Measured(
            wheel_speed=np.array([wheel, train]),
            brake_cylinder_pressure=np.array([max(-force, 0.0), 0.0])
            * (FULL_PRESSURE / vehicle.full_force),
            dynamic_force=np.array([-max(force, 0.0), 0.0]),
            brake_demand=demand if drive == 0.0 else 0.0,
            emergency=0.0,
            drive_demand=drive,
        )
        command = controller.step(state, seen, period)
        permitted = 1.0 if command.friction_share is None else float(command.friction_share[0])
        wanted = -demand * permitted * vehicle.full_force
        if drive > 0.0:
            wanted = drive * float(command.dynamic_share[0]) * vehicle.full_force
        step = period / PARTS
        for _ in range(PARTS):
            after = wanted + (force - wanted) * math.exp(-step / vehicle.lag)
            wheel, train, way = _move(vehicle, friction, wheel, train, 0.5 * (force + after), step)
            position += way
            force = after
    return Course(*np.array(rows).T)


def _move(
    vehicle: SingleAxle, friction: FrictionForce, wheel: float, train: float, force: float, h: float
) -> tuple[float, float, float]:
    """Return both speeds and the way after a step, by Runge-Kutta."""

    def rates(w: float, v: float) -> tuple[float, float]:
        rail = friction(w, v)
        turning = (force - rail) / vehicle.rotating_mass
        return turning if w > 0.0 or turning > 0.0 else 0.0, rail / vehicle.mass

    a = rates(wheel, train)
    b = rates(wheel + 0.5 * h * a[0], train + 0.5 * h * a[1])
    c = rates(wheel + 0.5 * h * b[0], train + 0.5 * h * b[1])
    d = rates(wheel + h * c[0], train + h * c[1])
    turned = wheel + h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0])
    after = train + h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1])
    return max(turned, 0.0), after, 0.5 * h * (train + after)


def _setup(vehicle: SingleAxle, period: float, is_driven: bool) -> Setup:
    first = np.array([1.0, 0.0])
    brake, motor = (0.0, 1.0) if is_driven else (1.0, 0.0)
    return Setup(
        n_axles=2,
        period=period,
        wheel_radius=np.full(2, 0.425),
        motored=first * motor > 0,
        braked=first * brake > 0,
        axle_load=np.full(2, vehicle.mass * GRAVITY),
        axles=AxleData(
            rotating_mass=np.full(2, vehicle.rotating_mass),
            full_force=first * brake * vehicle.full_force,
            full_pressure=first * brake * FULL_PRESSURE,
            first_pressure=np.zeros(2),
            continuous=first * brake > 0,
            braking_effort=np.zeros(2),
            braking_power=np.zeros(2),
            tractive_effort=first * motor * vehicle.full_force,
            tractive_power=first * motor * 1e9,
        ),
    )


def _check(vehicle: SingleAxle, speed: float) -> None:
    wrong = [
        Problem("", f"the {name.replace('_', ' ')} must be positive", got=f"{value:g}")
        for name, value in vehicle._asdict().items()
        if not 0.0 < value < math.inf
    ]
    if not 0.0 <= speed < math.inf:
        wrong.append(Problem("", "the speed must not be negative", got=f"{speed:g} m/s"))
    if wrong:
        raise RailgripError(wrong)
