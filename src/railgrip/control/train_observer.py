"""What all axles together tell about the train: fastest wheel, brake effort, who adheres."""

from __future__ import annotations

from typing import Final, NamedTuple

from railgrip.control.axle_signals import take_measured
from railgrip.control.contract import BRAKE_DEMAND, FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters, conventional_of
from railgrip.control.conventional_state import (
    ACCELERATION,
    COUNTED_ACCELERATION,
    COUNTED_SPEED,
    DYNAMIC,
    EFFORT,
    HAS_LED,
    IS_FAULTY,
    PRESSURE,
    REFERENCE,
    SETTLED_CLOCK,
    SHOWN_SPEED,
    SLIDES,
    SPEED,
    VOTE_CLOCK,
    WITNESS_CLOCK,
)
from railgrip.control.deceleration_estimate import estimate_deceleration, learn_pressure_gain
from railgrip.control.free_axle import free_an_axle
from railgrip.control.lone_leader import VOTES_AFTER, VOTES_AT_MOST, keep_dropped, outvote_leader
from railgrip.control.reference_speed import advance_reference
from railgrip.control.side_by_side import count_above, count_equal, greatest, total
from railgrip.control.state_layout import GROUP, axle_base, group_base, groups
from railgrip.control.wheel_speed import read_wheel
from railgrip.core.formulas.choosing import choose

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
    effort : float
        Mean braking pressure, [Pa].
    acceleration : float
        Mean over the wheels, [m/s²].
    is_witnessed, is_adhering : bool
        Whether enough wheels turn at the reference speed; whether none slides besides.
    """

    fastest: float
    seen: float
    effort: float
    acceleration: float
    is_witnessed: bool
    is_adhering: bool


def observe_train(
    parameters: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    slip_lower: float,
    dt: float,
) -> None:
    """Update wheel speeds, reference speed and the freed axle in the state.

    Parameters
    ----------
    parameters, state, measured : ndarray
        As in the controller contract.
    slip_lower : float
        Slip at the lower threshold of the narrowest band in use: how exactly the train speed must
        be known.
    dt : float
        Period, [s].
    """
    wheels = look_at_wheels(parameters, state, measured, slip_lower, dt)
    estimate_deceleration(parameters, state, wheels.effort, wheels.acceleration)
    free_an_axle(parameters, state, measured.shape[0], wheels.is_witnessed, slip_lower, dt)
    advance_reference(parameters, state, wheels.fastest, wheels.seen, dt)
    learn_pressure_gain(parameters, state, wheels.effort, wheels.fastest, wheels.is_adhering, dt)


def look_at_wheels(
    parameters: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    slip_lower: float,
    dt: float,
) -> Wheels:
    """Update the wheels in the state and return what they show; arguments as above."""
    n_axles = measured.shape[0]
    take_measured(state, measured)
    if state[HAS_LED] > 0.0:
        keep_dropped(parameters, state, n_axles, measured[0, BRAKE_DEMAND] > 0.0, dt)
    _read_wheels(parameters, state, n_axles, slip_lower, dt)
    counts = _count_wheels(state, n_axles)
    sums = _sum_up(state, n_axles, counts.valid)
    seen = sums.seen
    if counts.voters >= ENOUGH_WITNESSES and sums.fastest > 0.0:
        voted = outvote_leader(state, measured, _leader(state, n_axles, sums.fastest), dt)
        seen = voted if voted >= 0.0 else seen
    is_witnessed = counts.witnesses >= min(ENOUGH_WITNESSES, n_axles)
    is_adhering = counts.sliding == 0 and is_witnessed
    return Wheels(
        sums.fastest, seen, sums.effort, sums.acceleration, is_witnessed, is_adhering,
    )  # fmt: skip


class Counts(NamedTuple):
    """How many wheels are believed, at the reference speed, sliding, and fit to vote."""

    valid: int
    witnesses: int
    sliding: int
    voters: int


def _read_wheels(
    parameters: FloatArray,
    state: FloatArray,
    n_axles: int,
    slip_lower: float,
    dt: float,
) -> None:
    """Update every wheel in the state, several at a time."""
    own = conventional_of(parameters)
    reference = state[REFERENCE]
    near = max(WITNESS_FLOOR, reference * min(slip_lower, WITNESS_SLIP))
    is_fast = reference > own.dead_reference
    for group in range(groups(n_axles)):
        for i in range(GROUP):
            base = group_base(group) + i
            read_wheel(own, state, base, is_fast, dt)
            _weigh_effort(own, state, base, reference)
            _settle(own, state, base, dt)
            _stay_near(state, base, reference, near, dt)
            _count_in(state, base, state[base + IS_FAULTY] == 0.0)


def _count_wheels(state: FloatArray, n_axles: int) -> Counts:
    """Count the wheels when all have been read."""
    n_valid = 0
    n_witnesses = 0
    n_sliding = 0
    n_voters = 0
    for group in range(groups(n_axles)):
        first = group_base(group)
        is_faulty = first + IS_FAULTY
        n_valid += count_equal(state, is_faulty, 0.0)
        n_witnesses += count_above(state, first + WITNESS_CLOCK, WITNESS_AFTER, is_faulty)
        n_sliding += count_above(state, first + SLIDES, 0.0, is_faulty)
        n_voters += count_above(state, first + VOTE_CLOCK, VOTES_AFTER, is_faulty)
    return Counts(n_valid, n_witnesses, n_sliding, n_voters)


class Sums(NamedTuple):
    """As in `Wheels`, before the vote."""

    fastest: float
    seen: float
    effort: float
    acceleration: float


def _sum_up(state: FloatArray, n_axles: int, n_valid: int) -> Sums:
    """Find the greatest speeds, and sum up in the order of the axles."""
    fastest = 0.0
    seen = -1.0
    effort = 0.0
    acceleration = 0.0
    for group in range(groups(n_axles)):
        fastest = max(fastest, greatest(state, group_base(group) + COUNTED_SPEED))
        seen = max(seen, greatest(state, group_base(group) + SHOWN_SPEED))
        effort += total(state, group_base(group) + EFFORT)
        acceleration += total(state, group_base(group) + COUNTED_ACCELERATION)
    if seen < max(FREE_SHARE * fastest, LOCKED_SHARE * state[REFERENCE]):
        seen = -1.0
    if n_valid > 0:
        effort /= n_valid
        acceleration /= n_valid
    return Sums(fastest, seen, effort, acceleration)


def _leader(state: FloatArray, n_axles: int, fastest: float) -> int:
    """Return the first axle that is as fast as the fastest."""
    for axle in range(n_axles):
        if state[axle_base(axle) + COUNTED_SPEED] == fastest:
            return axle
    return -1


def braking_pressure(parameters: ConventionalParameters, state: FloatArray, base: int) -> float:
    """Return the cylinder pressure that would brake as much as all brakes of the axle, [Pa]."""
    pressure = state[base + PRESSURE] + parameters.pressure_per_force * state[base + DYNAMIC]
    return choose((pressure > 0.0) & (pressure < 1.0e7), pressure, 0.0)


def _count_in(state: FloatArray, base: int, is_valid: bool) -> None:
    """Put into the sums to come what a believed sensor says, and nothing for another."""
    state[base + COUNTED_SPEED] = choose(is_valid, state[base + SPEED], 0.0)
    state[base + COUNTED_ACCELERATION] = choose(is_valid, state[base + ACCELERATION], 0.0)
    state[base + EFFORT] = choose(is_valid, state[base + EFFORT], 0.0)
    state[base + SHOWN_SPEED] = choose(is_valid, state[base + SHOWN_SPEED], -1.0)


def _weigh_effort(
    parameters: ConventionalParameters, state: FloatArray, base: int, reference: float
) -> None:
    """Note how hard the axle brakes; the brake of a locked wheel tells nothing."""
    tells = state[base + SPEED] >= LOCKED_SHARE * reference
    state[base + EFFORT] = choose(tells, braking_pressure(parameters, state, base), 0.0)


def _stay_near(state: FloatArray, base: int, reference: float, near: float, dt: float) -> None:
    """Count how long a believed wheel has turned at the reference speed."""
    is_near = reference - state[base + SPEED] < near
    clock = choose(is_near, state[base + WITNESS_CLOCK] + dt, 0.0)
    is_valid = state[base + IS_FAULTY] == 0.0
    state[base + WITNESS_CLOCK] = choose(is_valid, clock, state[base + WITNESS_CLOCK])


def _settle(parameters: ConventionalParameters, state: FloatArray, base: int, dt: float) -> None:
    """Note the speed of an unbraked wheel that has stopped turning faster: it shows the train.

    For the vote its clock runs forth while it gains no speed, and back while it does. Between two
    teeth the acceleration of a pole wheel trembles by more than half a metre per second squared, so
    it is the majority of the readings that counts.
    """
    is_valid = state[base + IS_FAULTY] == 0.0
    is_empty = state[base + PRESSURE] < parameters.empty_pressure
    is_idle = state[base + DYNAMIC] < parameters.dynamic_least_force
    gains = state[base + ACCELERATION] >= GAINING_ACCELERATION
    is_unbraked = is_empty & is_idle
    settles = is_unbraked & (not gains)
    votes = state[base + VOTE_CLOCK] + choose(settles, dt, -dt)
    votes = choose(is_unbraked, min(max(votes, 0.0), VOTES_AT_MOST), 0.0)
    clock = choose(settles, state[base + SETTLED_CLOCK] + dt, 0.0)
    state[base + VOTE_CLOCK] = choose(is_valid, votes, state[base + VOTE_CLOCK])
    state[base + SETTLED_CLOCK] = choose(is_valid, clock, state[base + SETTLED_CLOCK])
    state[base + SHOWN_SPEED] = choose(clock > SETTLED_AFTER, state[base + SPEED], -1.0)
