"""A leg of a journey on a grid, in units in which everything is of the order of one."""

from __future__ import annotations

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.core.constants import GRAVITY
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.journey.effort import brake_pieces, pieces_of
from railgrip.engine.journey.forces import UNLIMITED
from railgrip.engine.journey.profile import Sections, limits
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]

LENGTH, SPEED, TIME = 100.0, 10.0, 10.0
"""Units of the grid: m, m/s, s. Acceleration is in m/s², forces are per dynamic mass."""
FINEST, COARSEST, NODES = 2.0, 10.0, 5000
"""Distance of nodes, m: that of so many nodes a leg, but within these bounds."""
NEAR = 0.25
"""An additional node is left out where another is nearer, m."""
SLIVER = 0.02
"""The least share of an interval that a node in it cuts off."""
SHARP = 0.02
"""A change of acceleration that counts as a turn, m/s²."""
AT_ONCE = 0.2
"""A motors' brake that fades all at once does so over so much speed, m/s."""


class Grid(NamedTuple):
    """A leg, scaled."""

    width: Array
    """Of each interval."""
    slope: Array
    """Specific gradient force in each interval."""
    drag: Array
    """Coefficient of the square of the speed in each interval."""
    limit: Array
    """Square of the permitted speed at each node."""
    gain: Array
    """The greatest acceleration in each interval: what is preset, or what a steep fall gives."""
    loss: Array
    """The greatest deceleration: what is preset, or what a steep climb takes."""
    effort: Array
    """Pieces of the effort (speed, c0, c1, c2), without the constant limit of the force."""
    brake: Array
    """The same of the motors' brake."""
    bounds: Array
    """constant, linear, effort, brake, friction, drive, return."""
    given: NDArray[np.bool_]
    """Which of the ten conditions of an interval there are."""


def nodes(journey: Journey, begin: float, end: float, step: float | None = None) -> Array:
    """Return the positions of the nodes of a leg, m.

    Every change of a limit, a gradient or a tunnel is a node; towards the stops they lie closer.
    """
    if step is None:
        step = min(max((end - begin) / NODES, FINEST), COARSEST)
    marks = {at for at, _ in limits(journey)} | set(Sections(journey).position.tolist())
    edges = [begin, *sorted(mark for mark in marks if begin < mark < end), end]
    parts = [
        np.linspace(a, b, max(1, int(np.ceil((b - a) / step))) + 1)[:-1] for a, b in pairwise(edges)
    ]
    base = np.concatenate([*parts, [end]])
    near = [0.5]
    while near[-1] < 8.0 * step:
        near.append(near[-1] + max(0.5, 0.12 * near[-1]))
    extra = np.concatenate([begin + np.array(near), end - np.array(near)])
    extra = extra[(extra > begin) & (extra < end)]
    right = np.clip(np.searchsorted(base, extra), 1, base.size - 1)
    gap = np.minimum(np.abs(base[right] - extra), np.abs(base[right - 1] - extra))
    return np.unique(np.concatenate([base, extra[gap > NEAR]]))


def with_turns(places: Array, square: Array) -> Array:
    """Return the nodes and one more wherever the run turns from pulling to holding or braking.

    There the square of speed has a peak or a corner. Between nodes it would be cut off, and the
    fastest run would be short of its energy by a share of the distance of the nodes.
    """
    width = np.diff(places)
    steep = np.diff(square) / width
    before, after = steep[:-2], steep[2:]
    bend = before - after
    with np.errstate(divide="ignore", invalid="ignore"):
        # where the lines of the two neighbouring intervals meet
        along = (square[2:-1] - square[1:-2] - after * width[1:-1]) / bend
    inside = (along > SLIVER * width[1:-1]) & (along < (1.0 - SLIVER) * width[1:-1])
    sharp = bend > SHARP * (2.0 / SPEED**2)
    return np.unique(np.concatenate([places, (places[1:-2] + along)[inside & sharp]]))


def grid_of(journey: Journey, places: Array) -> Grid:
    """Return the grid of a leg on nodes."""
    train, sections = journey.train, Sections(journey)
    if train.efficiency.map is not None:
        raise RailgripError(
            Problem(
                "train.efficiency.map",
                "is not known to the optimum, which counts with constant efficiency",
                cure="leave the map out; efficiency.traction and .regeneration then count",
            )
        )
    mass = train.dynamic_mass
    middle = 0.5 * (places[1:] + places[:-1])
    steps = limits(journey)
    at = np.array([a for a, _ in steps])
    squares = np.array([v * v for _, v in steps]) / SPEED**2
    here = squares[np.searchsorted(at, middle, "right") - 1]
    limit = np.minimum(np.append(here, here[-1]), np.append(here[0], here))
    deceleration = journey.deceleration()
    motor, friction = train.regeneration, train.friction_brake
    effort, most = _open(pieces_of(train.effort), mass)
    brake, most_brake = _open(brake_pieces(motor), mass)
    has_motor, has_friction = most_brake > 0.0, friction != 0.0
    chain = train.efficiency
    bounds = np.array([
        train.resistance.constant / mass,
        train.resistance.linear * SPEED / mass,
        most,
        most_brake,
        UNLIMITED if friction is None else friction / mass,
        1.0 / (chain.traction * chain.converter),
        chain.regeneration * chain.converter * motor.receptivity,
    ])  # fmt: skip
    given = np.array([
        True, True, True, has_motor, has_motor, has_motor,
        has_friction, has_friction and friction is not None,
        train.max_acceleration is not None, deceleration is not None,
    ])  # fmt: skip
    slope = train.mass * GRAVITY / mass * sections.mean_slope(places)
    drag = (train.resistance.quadratic + sections.drag_at(middle)) * SPEED**2 / mass
    resists = slope + bounds[0] + bounds[1] * np.sqrt(here) + drag * here
    return Grid(
        np.diff(places) / LENGTH, slope, drag, limit,
        np.maximum(train.max_acceleration or UNLIMITED, -slope - bounds[0]),
        np.maximum(deceleration or UNLIMITED, resists),
        effort, brake, bounds, given,
    )  # fmt: skip


def _open(pieces: Array, mass: float) -> tuple[Array, float]:
    """Scale pieces and take the constant limit of the force out of them.

    A hyperbola goes on to standstill, where the constant limit holds: each alone is smooth, the
    lesser of both has a bend.
    """
    pieces = pieces.copy()
    most = float(np.max(np.maximum(pieces[:, 1] + pieces[:, 2] * pieces[:, 0], 0.0)))
    if not np.any(pieces[:, 3]) and np.all(pieces[:, 2] == 0.0) and len(pieces) > 1:
        pieces = _lines(pieces)
    elif np.any(pieces[:, 3]):
        pieces = _hyperbola(pieces, most)
    pieces[:, 0] /= SPEED
    pieces[:, 1] /= mass
    pieces[:, 2] *= SPEED / mass
    pieces[:, 3] /= SPEED * mass
    return pieces, most / mass


def _lines(pieces: Array) -> Array:
    """Return held entries as lines through the middles of their steps: the effort in the mean."""
    steps, force = pieces[:, 0], pieces[:, 1]
    middle = 0.5 * (steps[1:] + steps[:-1])
    speed = np.concatenate([[0.0], middle, [2.0 * steps[-1] - middle[-1]]])
    force = np.concatenate([force[:1], force])
    slope = np.append(np.diff(force) / np.diff(speed), 0.0)
    return np.column_stack([speed, force - slope * speed, slope, np.zeros(speed.size)])


def _hyperbola(pieces: Array, most: float) -> Array:
    """Return a hyperbola alone, below it the line of a fade up to where both meet.

    A limit must not jump: Newton's method would go to and fro over the step.
    """
    power = pieces[-1, 3]
    line = pieces[pieces[:, 2] > 0.0]
    if len(pieces) > 1 and (line.size or pieces[0, 1] == 0.0):
        if line.size:
            c0, c1 = line[0, 1], line[0, 2]
        else:  # faded at once
            c1 = pieces[1, 1] / AT_ONCE
            c0 = -c1 * pieces[1, 0]
        meet = 0.5 * (np.sqrt(c0 * c0 + 4.0 * c1 * power) - c0) / c1
    else:  # a tangent, far above the constant limit, so that nothing grows beyond bounds
        meet = 0.5 * power / most
        c0, c1 = 2.0 * power / meet, -power / meet**2
    return np.array([[0.0, c0, c1, 0.0], [meet, 0.0, 0.0, power]])
