"""When an axle asks for sand."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.conventional_state import SAND_CLOCK, SLIDES
from railgrip.core.formulas.choosing import choose


def request_sand(
    parameters: ConventionalParameters, state: FloatArray, base: int, reference: float, dt: float
) -> float:
    """Return 1 while the axle wants sand, else 0.

    Parameters
    ----------
    parameters : ConventionalParameters
        By name.
    state : ndarray
        As in the controller contract. The clock in it counts down from zero while the axle
        slides without sand, and down from `sand_time` while sand is asked for.
    base : int
        Where the axle's values begin.
    reference : float
        Reference speed, [m/s].
    dt : float
        Period, [s].
    """
    clock = state[base + SAND_CLOCK]
    is_due = (clock > 0.0) | (clock <= -parameters.sand_after)
    sliding = choose(is_due, parameters.sand_time, clock - dt)
    slides = (state[base + SLIDES] > 0.0) & (reference > parameters.sand_above)
    clock = choose(slides, sliding, max(0.0, clock - dt))
    state[base + SAND_CLOCK] = clock
    return wants_sand(state, base)


def wants_sand(state: FloatArray, base: int) -> float:
    """Return 1 while the axle wants sand, else 0."""
    return choose(state[base + SAND_CLOCK] > 0.0, 1.0, 0.0)
