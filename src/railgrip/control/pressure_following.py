"""A dump valve that lets the cylinder follow a wanted pressure, in pulses."""

from __future__ import annotations

from railgrip.control.contract import FILL, HOLD, VENT, FloatArray
from railgrip.control.temperature_parameters import (
    FILL_TIME,
    PRESSURE_BAND,
    VALVE_DELAY,
    VENT_TIME,
)
from railgrip.control.temperature_state import FLIGHT


def follow_pressure(
    parameters: FloatArray,
    state: FloatArray,
    own: int,
    pressure: float,
    wanted: float,
    supply: float,
    dt: float,
) -> float:
    """Return FILL, HOLD or VENT so that the cylinder comes to a pressure.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    own : int
        Where the axle's own block begins.
    pressure, wanted, supply : float
        In the cylinder now, wanted, and before the valve, [Pa].
    dt : float
        Period, [s].

    Notes
    -----
    A valve acts late, so what has been commanded and not yet felt is remembered and counted in:
    without that every pulse would be given several times over.
    """
    filling = max(supply - pressure, 0.0) / parameters[FILL_TIME] * dt
    venting = pressure / parameters[VENT_TIME] * dt
    flight = state[own + FLIGHT] * (1.0 - min(1.0, dt / parameters[VALVE_DELAY]))
    missing = wanted - pressure - flight
    valve = HOLD
    if missing > parameters[PRESSURE_BAND]:
        valve = FILL
        flight += filling
    elif missing < -parameters[PRESSURE_BAND]:
        valve = VENT
        flight -= venting
    state[own + FLIGHT] = flight
    return valve
