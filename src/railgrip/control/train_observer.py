"""What all axles together tell about the train: fastest wheel, brake effort, who adheres."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.contract import (
    BRAKED,
    CYLINDER_PRESSURE,
    DYNAMIC_FORCE,
    MOTORED,
    FloatArray,
)
from railgrip.control.conventional_parameters import (
    DYNAMIC_LEAST_FORCE,
    EMPTY_PRESSURE,
    PRESSURE_PER_FORCE,
)
from railgrip.control.conventional_state import (
    ACCELERATION,
    IS_FAULTY,
    REFERENCE,
    SETTLED_CLOCK,
    SLIDES,
    SPEED,
    VOTE_CLOCK,
    WITNESS_CLOCK,
    axle_base,
)
from railgrip.control.deceleration_estimate import estimate_deceleration, learn_pressure_gain
from railgrip.control.free_axle import free_an_axle
from railgrip.control.lone_leader import VOTES_AFTER, count_for_vote, outvote_leader
from railgrip.control.reference_speed import advance_reference
from railgrip.control.wheel_speed import read_wheel

LOCKED_SHARE: Final = 0.05  # of the reference speed: the brake of a locked wheel measures nothing
GAINING_ACCELERATION: Final = 0.2  # m/s²: an unbraked wheel that gains no more turns with the train
SETTLED_AFTER: Final = 0.25  # s: an unbraked wheel that has gained nothing so long shows the train
FREE_SHARE: Final = 0.9  # of the fastest wheel: a free wheel is never much slower, a locked one is
WITNESS_SLIP: Final = 0.01  # a wheel so close to the reference speed, or this close in m/s,
WITNESS_FLOOR: Final = 0.15
WITNESS_AFTER: Final = 1.0  # s: and for so long, is a witness of the train speed
ENOUGH_WITNESSES: Final = 2  # one alone is always at its own speed


class Wheels(NamedTuple):
    """What a look at all wheels shows.

    Parameters
    ----------
    fastest, seen : float
        Greatest believable speed; speed of a wheel that runs free, -1 where there is none, [m/s].
    candidate : int
        The fastest axle that can be released; -1 for none.
    effort : float
        Mean braking pressure, [Pa].
    acceleration : float
        Mean over the wheels, [m/s²].
    is_witnessed, is_adhering : bool
        Whether enough wheels turn at the reference speed; whether none slides besides.
    """

    fastest: float
    seen: float
    candidate: int
    effort: float
    acceleration: float
    is_witnessed: bool
    is_adhering: bool


def observe_train(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    slip_lower: float,
    dt: float,
) -> None:
    """Update wheel speeds, reference speed and the freed axle in the state.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract.
    slip_lower : float
        Slip at the lower threshold of the narrowest band in use: how exactly the train speed must
        be known.
    dt : float
        Period, [s].
    """
    wheels = look_at_wheels(parameters, axle_setup, state, measured, slip_lower, dt)
    estimate_deceleration(parameters, state, wheels.effort, wheels.acceleration)
    free_an_axle(parameters, state, wheels.candidate, wheels.is_witnessed, slip_lower, dt)
    advance_reference(parameters, state, wheels.fastest, wheels.seen, dt)
    learn_pressure_gain(parameters, state, wheels.effort, wheels.fastest, wheels.is_adhering, dt)


def look_at_wheels(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    slip_lower: float,
    dt: float,
) -> Wheels:
    """Update the wheels in the state and return what they show; arguments as above."""
    n_axles = measured.shape[0]
    near = state[REFERENCE] * min(slip_lower, WITNESS_SLIP)
    near = max(WITNESS_FLOOR, near)
    fastest = 0.0
    candidate = -1
    seen = -1.0
    effort = 0.0
    acceleration = 0.0
    n_valid = 0
    n_witnesses = 0
    n_sliding = 0
    n_voters = 0
    leader = -1
    for axle in range(n_axles):
        base = axle_base(axle)
        read_wheel(parameters, state, base, measured, axle, dt)
        if state[base + IS_FAULTY] > 0.0:
            continue
        n_valid += 1
        speed = state[base + SPEED]
        acceleration += state[base + ACCELERATION]
        if speed >= LOCKED_SHARE * state[REFERENCE]:
            effort += braking_pressure(parameters, measured, axle)
        if settle(parameters, state, base, measured, axle, dt):
            seen = max(seen, speed)
        if state[base + VOTE_CLOCK] > VOTES_AFTER:
            n_voters += 1
        if state[base + SLIDES] > 0.0:
            n_sliding += 1
        if is_near(state, base, near, dt):
            n_witnesses += 1
        if speed > fastest:
            fastest = speed
            leader = axle
            if axle_setup[axle, BRAKED] > 0.0 or axle_setup[axle, MOTORED] > 0.0:
                candidate = axle
    if seen < max(FREE_SHARE * fastest, LOCKED_SHARE * state[REFERENCE]):
        seen = -1.0
    if n_voters >= ENOUGH_WITNESSES and leader >= 0:
        voted = outvote_leader(state, measured, leader, dt)
        seen = voted if voted >= 0.0 else seen
    if n_valid > 0:
        effort /= n_valid
        acceleration /= n_valid
    is_witnessed = n_witnesses >= min(ENOUGH_WITNESSES, n_axles)
    is_adhering = n_sliding == 0 and is_witnessed
    return Wheels(fastest, seen, candidate, effort, acceleration, is_witnessed, is_adhering)


def braking_pressure(parameters: FloatArray, measured: FloatArray, axle: int) -> float:
    """Return the cylinder pressure that would brake as much as all brakes of the axle, [Pa]."""
    pressure = (
        measured[axle, CYLINDER_PRESSURE]
        + parameters[PRESSURE_PER_FORCE] * measured[axle, DYNAMIC_FORCE]
    )
    return pressure if 0.0 < pressure < 1.0e7 else 0.0


def is_near(state: FloatArray, base: int, near: float, dt: float) -> bool:
    """Return whether a wheel has turned at the reference speed for a while."""
    slip_speed = state[REFERENCE] - state[base + SPEED]
    clock: float = state[base + WITNESS_CLOCK] + dt if slip_speed < near else 0.0
    state[base + WITNESS_CLOCK] = clock
    return clock > WITNESS_AFTER


def settle(
    parameters: FloatArray, state: FloatArray, base: int, measured: FloatArray, axle: int, dt: float
) -> bool:
    """Return whether an unbraked wheel has stopped turning faster: it then shows the train."""
    is_unbraked = (
        measured[axle, CYLINDER_PRESSURE] < parameters[EMPTY_PRESSURE]
        and measured[axle, DYNAMIC_FORCE] < parameters[DYNAMIC_LEAST_FORCE]
    )
    settles = is_unbraked and state[base + ACCELERATION] < GAINING_ACCELERATION
    count_for_vote(state, base, is_unbraked, settles, dt)
    clock: float = state[base + SETTLED_CLOCK] + dt if settles else 0.0
    state[base + SETTLED_CLOCK] = clock
    return clock > SETTLED_AFTER
