"""A dump valve that lets the cylinder follow a wanted pressure, in pulses."""

from __future__ import annotations

from railgrip.control.contract import FILL, HOLD, VENT, FloatArray
from railgrip.control.temperature_parameters import TemperatureOnly
from railgrip.control.temperature_state import FLIGHT
from railgrip.core.formulas.choosing import choose


def follow_pressure(
    parameters: TemperatureOnly,
    state: FloatArray,
    base: int,
    is_limited: bool,
    pressure: float,
    wanted: float,
    supply: float,
    dt: float,
) -> float:
    """Return FILL, HOLD or VENT so that the cylinder comes to a pressure.

    Parameters
    ----------
    parameters : TemperatureOnly
        By name.
    state : ndarray
        As in the controller contract.
    base : int
        Where the axle's values begin.
    is_limited : bool
        Whether a pressure is wanted at all: else the valve fills, and nothing is noted.
    pressure, wanted, supply : float
        In the cylinder now, wanted, and before the valve, [Pa].
    dt : float
        Period, [s].

    Notes
    -----
    A valve acts late, so what has been commanded and not yet felt is remembered and counted in:
    without that every pulse would be given several times over.
    """
    filling = max(supply - pressure, 0.0) * (dt / parameters.fill_time)
    venting = pressure * (dt / parameters.vent_time)
    felt = state[base + FLIGHT] * (1.0 - min(1.0, dt / parameters.valve_delay))
    missing = wanted - pressure - felt
    fills = missing > parameters.pressure_band
    vents = missing < -parameters.pressure_band
    flight = choose(fills, felt + filling, felt)
    flight = choose(vents, felt - venting, flight)
    state[base + FLIGHT] = choose(is_limited, flight, state[base + FLIGHT])
    valve = choose(fills | (not is_limited), FILL, HOLD)
    return choose(vents & is_limited, VENT, valve)
