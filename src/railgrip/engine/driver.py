"""The automatic driver of a trip: pulls, holds the speed, coasts, brakes on the curve, stops.

It knows the line and the train as its papers say, and where and how fast it is. What it wants is
an acceleration: that of the permitted speed, and a correction for the deviation from it, looked at
here and a moment ahead, since brakes take time to fill.
"""

from __future__ import annotations

import math
from typing import Any, Final

from railgrip.compiler import compiled
from railgrip.engine import layout as at
from railgrip.engine.journey.coasting import coasting_demand
from railgrip.engine.journey.forces import HOLD

(
    DYNAMIC_MASS, FULL_BRAKE, EFFORT, POWER, GAIN, FORESIGHT, GREATEST_ACCELERATION,
) = range(7)  # fmt: skip
"""Places in `DriverPlan.numbers`."""
ACTS, IS_SLOW, WANTED = range(3)
"""Places in the driver's state: two of the coasting law, and the acceleration wanted last."""
DEMAND: Final = 3
"""From here on, what the coasting law demands."""
DRIVER_STATES: Final = DEMAND + 4
LEAST_BRAKE: Final = 0.01
"""A brake demand below it is none: the train coasts instead."""
AT_THE_STOP: Final = 3.0
"""So near before its stop a slow train does not pull again, m."""
SLOW: Final = 0.4
"""Below it the brake is left as it is for the last bit, m/s."""
HOLDING: Final = 0.3
"""Brake demand that holds a train at its stop, and one that starts uphill."""
START: Final = 1.5
"""For so long a train that starts uphill holds its brake while its motors build up, s."""

_law = compiled(coasting_demand)


@compiled
def _ceiling(own: Any, place: float) -> tuple[float, float]:
    """Return permitted speed and its slope times itself (an acceleration) at a place."""
    j, last = 0, own.squares.shape[0] - 1
    # halving: lines have hundreds of pieces
    low, high = 0, last
    while low < high:
        j = (low + high + 1) // 2
        if own.bounds[j] <= place:
            low = j
        else:
            high = j - 1
    square = own.squares[low] + own.falls[low] * (place - own.bounds[low])
    return math.sqrt(max(square, 0.0)), 0.5 * own.falls[low]


@compiled
def _wanted(own: Any, place: float, speed: float, before: float) -> float:
    """Return the acceleration that the permitted speed asks for, m/s².

    What is wanted now acts a moment later, so it is that of the permitted speed there; but the
    speed permitted here is not passed for a higher one ahead.
    """
    gain, ahead = own.numbers[GAIN], own.numbers[FORESIGHT]
    here, along = _ceiling(own, place)
    soon, falls = _ceiling(own, place + ahead * speed)
    later = falls + gain * (soon - (speed + ahead * before))
    wanted = min(later, max(along, falls) + gain * (here - speed))
    return float(min(wanted, own.numbers[GREATEST_ACCELERATION]))


@compiled
def _decide(L: int, S: Any, own: Any, state: Any, k: int) -> None:
    place, speed = S[at.POSITION * L + k], S[at.TRAIN_SPEED * L + k]
    numbers, end = own.numbers, own.bounds[own.bounds.shape[0] - 1]
    if speed < SLOW and place > end - AT_THE_STOP:
        S[at.DRIVE_DEMAND * L + k] = 0.0
        S[at.DRIVER_DEMAND * L + k] = max(S[at.DRIVER_DEMAND * L + k], HOLDING)
        return
    wanted = _wanted(own, place, speed, state[WANTED])
    demand = state[DEMAND:]
    _law(place, speed, own.law, state, demand)
    share, retard = demand[0], demand[1]
    state[ACTS], state[IS_SLOW] = demand[2], demand[3]
    if share == HOLD:
        wanted, share = min(wanted, 0.0), 1.0
    resists = S[at.RESISTANCE_CONSTANT * L + k] + speed * (
        S[at.RESISTANCE_LINEAR * L + k] + speed * S[at.RESISTANCE_QUADRATIC * L + k]
    )
    resists += S[at.GRADIENT_FORCE * L + k] + S[at.CURVE_FORCE * L + k]
    force = numbers[DYNAMIC_MASS] * wanted + resists
    effort = min(numbers[EFFORT], numbers[POWER] / max(speed, 1e-3))
    pull = min(max(force / effort, 0.0), share)
    brake = max(-force, numbers[DYNAMIC_MASS] * retard) / numbers[FULL_BRAKE]
    brake = min(brake, 1.0) if brake > LEAST_BRAKE else 0.0
    is_starting = S[at.TICK * L + k] <= own.every and S[at.GRADIENT_FORCE * L + k] > 0.0
    S[at.DRIVE_DEMAND * L + k] = pull
    S[at.DRIVER_DEMAND * L + k] = HOLDING if is_starting else brake
    reached = max(wanted, -numbers[FULL_BRAKE] / numbers[DYNAMIC_MASS])
    free = (effort * share - resists) / numbers[DYNAMIC_MASS]
    state[WANTED] = min(reached, max(free, -1.0)) if wanted > 0.0 else reached


@compiled
def act_as_driver(L: int, S: Any, memory: Any, own: Any, n_axles: int, tick: float, k: int) -> None:
    """Decide if it is time to, and let the brake demand reach the axles after their delays."""
    now = int(S[at.TICK * L + k])
    is_held = now * tick < START and S[at.DRIVER_DEMAND * L + k] > 0.0 and now > 0
    if now % own.every == 0 and not is_held:
        _decide(L, S, own, memory.driver_state[k], k)
    history = memory.demand_history[k]
    size = history.shape[0]
    history[now % size] = S[at.DRIVER_DEMAND * L + k]
    for axle in range(n_axles):
        then = max(now - own.late[axle], 0)
        S[((1 + axle) * at.N_VARS + at.DEMAND) * L + k] = history[then % size]
