"""Ten million stops of a shunting train: twenty normal numbers each, stepped in time in lanes.

Choose it for the plain question how far a rake of block-braked wagons runs from walking pace: no
sliding, no heat, no slide protection. Everything else is for the engine.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.compiler import entry, inlined
from railgrip.core.errors import Problem, RailgripError
from railgrip.track.random_field import standard_normal

FloatArray = NDArray[np.float64]

LANES = 16
"""Runs side by side."""
WAGONS = 6
STREAM = 7
"""Random stream of this program, so that it shares no number with the rail."""
CHUNK = 8192

N_NORMALS = 3 * WAGONS + 2
"""Of a run: pressure, rigging and friction of each wagon, fill time, mass."""


class ShuntingTrain(NamedTuple):
    """A locomotive that does not brake, with six wagons of one block brake each, SI.

    The wagon is the shipped `wagon_block` (published example with Karwatzki's friction). Spreads
    are those of published Monte Carlo practice; locomotive and resistance are illustrative.
    """

    speed: float = 25.0 / 3.6
    locomotive_mass: float = 80e3
    wagon_mass: float = 90e3
    rotating_mass: float = 3.6e3
    wagon_length: float = 14.04
    wave_speed: float = 250.0
    dead_time: float = 0.2
    pressure: float = 3.8e5
    cylinder_area: float = 0.12946
    cylinder_spring: float = -1500.0
    rigging_ratio: float = 5.65
    rigging_efficiency: float = 0.83
    rigging_spring: float = -2000.0
    blocks: float = 16.0
    friction: float = 0.055
    resistance: float = 1236.0
    fill_time: float = 4.0
    pressure_spread: float = 0.05e5
    efficiency_spread: float = 0.02
    friction_spread: float = 0.025
    fill_time_spread: float = 0.33
    mass_spread: float = 0.02


# places in a lane's memory: per wagon the full force of a block and its friction, then the run's
_CLAMP, _FRICTION = 0, WAGONS
_PER_FILL, _PER_MASS, _SPEED, _PLACE, _DECELERATION, _FORCE = range(2 * WAGONS, 2 * WAGONS + 6)
N_VARS = 2 * WAGONS + 6


@inlined
def _begin(S: Any, k: int, train: Any, run: int, seed: int) -> None:
    """Draw the numbers of one run into a lane."""
    for w in range(WAGONS):
        pressure = train.pressure + train.pressure_spread * standard_normal(
            3 * w, run, STREAM, seed
        )
        efficiency = train.rigging_efficiency + train.efficiency_spread * standard_normal(
            3 * w + 1, run, STREAM, seed
        )
        piston = pressure * train.cylinder_area + train.cylinder_spring
        clamp = piston * train.rigging_ratio * efficiency + train.rigging_spring
        factor = 1.0 + train.friction_spread * standard_normal(3 * w + 2, run, STREAM, seed)
        S[(_CLAMP + w) * LANES + k] = max(clamp, 0.0) / train.blocks * 1e-3
        S[(_FRICTION + w) * LANES + k] = train.friction * factor * train.blocks * 1e3
    fill = train.fill_time + train.fill_time_spread * standard_normal(3 * WAGONS, run, STREAM, seed)
    mass = 1.0 + train.mass_spread * standard_normal(3 * WAGONS + 1, run, STREAM, seed)
    still = (train.locomotive_mass + WAGONS * train.wagon_mass) * mass
    S[_PER_FILL * LANES + k] = 1.0 / max(fill, 0.1)
    S[_PER_MASS * LANES + k] = 1.0 / (still + WAGONS * train.rotating_mass)
    S[_SPEED * LANES + k] = train.speed
    S[_PLACE * LANES + k] = 0.0
    S[_DECELERATION * LANES + k] = 0.0


@inlined
def _wagon_pass(S: Any, w: int, filling: float) -> None:
    """Add the force of one wagon to all lanes, without the factor of speed."""
    for k in range(LANES):
        share = min(max(filling * S[_PER_FILL * LANES + k], 0.0), 1.0)
        clamp = share * S[(_CLAMP + w) * LANES + k]
        grip = clamp * (clamp + 200.0) / (clamp + 50.0)
        S[_FORCE * LANES + k] += S[(_FRICTION + w) * LANES + k] * grip


@inlined
def _move_pass(S: Any, step: float, resistance: float) -> float:
    """Move all lanes on by a step; return the sum of speeds, 0 when all stand."""
    moving = 0.0
    for k in range(LANES):
        speed = S[_SPEED * LANES + k]
        # friction at the speed of the middle of the step, by the deceleration so far
        middle = max(speed - 0.5 * step * S[_DECELERATION * LANES + k], 0.0) * 3.6
        force = S[_FORCE * LANES + k] * (middle + 150.0) / (middle + 75.0) + resistance
        deceleration = force * S[_PER_MASS * LANES + k]
        after = speed - deceleration * step
        rolled = 0.5 * (speed + after) * step
        stops = after <= 0.0
        last = 0.5 * speed * speed / deceleration
        S[_PLACE * LANES + k] += last if stops else rolled
        S[_SPEED * LANES + k] = 0.0 if stops else after
        S[_DECELERATION * LANES + k] = deceleration
        S[_FORCE * LANES + k] = 0.0
        moving += max(after, 0.0)
    return moving


def _stops(S: Any, train: Any, out: Any, first: int, last: int, seed: int, step: float) -> None:
    resistance = WAGONS * train.resistance
    for group in range(first, last, LANES):
        for k in range(LANES):
            _begin(S, k, train, group + k, seed)
            S[_FORCE * LANES + k] = 0.0
        time, moving = 0.5 * step, 1.0
        while moving > 0.0 and time < 600.0:
            for w in range(WAGONS):
                arrives = train.dead_time + (w + 1.5) * train.wagon_length / train.wave_speed
                _wagon_pass(S, w, time - arrives)
            moving = _move_pass(S, step, resistance)
            time += step
        for k in range(min(LANES, last - group)):
            out[group - first + k] = S[_PLACE * LANES + k]


_kernel = entry(_stops)


def shunting_stops(
    runs: int,
    *,
    train: ShuntingTrain = ShuntingTrain(),  # noqa: B008  a tuple
    seed: int = 1,
    first: int = 0,
    step: float = 0.1,
    threads: int = 1,
) -> FloatArray:
    """Return the stopping distance of so many runs, each with twenty normal numbers of its own.

    Parameters
    ----------
    runs : int
        How many, ≥ 1.
    train : ShuntingTrain
        The train and its spreads.
    seed : int
        Key of the random numbers, ≥ 0.
    first : int
        Number of the first run; the same run has the same distance in any batch.
    step : float
        Of the integration, s, 0.001 … 1. The error of the distance at 0.1 s is below 1e-5.
    threads : int
        Threads that share the runs; the bits do not depend on it.

    Returns
    -------
    distance : (runs,)
        Metres from the brake command.

    Raises
    ------
    RailgripError
        ``runs: must be at least 1; got 0``

    Notes
    -----
    Pressure rises linearly in each wagon once the wave in the brake pipe has reached it; block
    friction by Karwatzki, 0.055 (F + 200)/(F + 50) (v + 150)/(v + 75), F in kN a block, v in km/h.
    Midpoint rule, the last step to the very standstill.

    Examples
    --------
    >>> float(shunting_stops(1)[0].round())
    48.0
    """
    for name, value, least in (("runs", runs, 1), ("threads", threads, 1), ("seed", seed, 0),
                               ("first", first, 0)):  # fmt: skip
        if value < least:
            raise RailgripError(Problem(name, f"must be at least {least}", got=str(value)))
    if not 0.001 <= step <= 1.0:
        raise RailgripError(Problem("step", "must lie between 0.001 and 1 s", got=f"{step:g}"))
    distance = np.empty(runs)

    def work(start: int) -> None:
        end = min(start + CHUNK, runs)
        memory = np.zeros(N_VARS * LANES)
        _kernel(memory, train, distance[start:end], first + start, first + end, seed, step)

    if threads == 1:
        for start in range(0, runs, CHUNK):
            work(start)
    else:
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(work, range(0, runs, CHUNK)))
    return distance
