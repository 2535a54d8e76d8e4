"""The creep force over a cycle of a swinging wheel load, until it repeats itself."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.compiler import compiled, inlined
from railgrip.contact.dynamic_load import contact_under_load, first_phase, load_share
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.relaxation import relaxation_length, relaxation_step
from railgrip.contact.rolling_contact import Creepage, RollingContact

FloatArray = NDArray[np.float64]

_GAUSS = 0.5 / math.sqrt(3.0)
_MOST_CYCLES = 4000
_UNCHANGED = 1e-12
_TINY = 1e-6
_LEAST = 1e-12


class LoadCycle(NamedTuple):
    """One cycle of the wheel load, cut into steps in which the patch is on the rail.

    Parameters
    ----------
    share : ndarray (node)
        Load over its mean; node 0 and the last are the same moment, or both without contact.
    rolled : ndarray (step)
        Distance rolled in a step over the relaxation length.
    step : float
        Part of the cycle that a step takes.
    """

    share: FloatArray
    rolled: FloatArray
    step: float


def load_cycle(
    contact: RollingContact, speed: float, amplitude: float, frequency: float, steps: int
) -> LoadCycle:
    """Cut a cycle of the load into steps.

    Parameters
    ----------
    contact : RollingContact
        The contact under the mean load.
    speed, amplitude, frequency : float
        As in `railgrip.laboratory.deformed_curve.deformed_curve`.
    steps : int
        Steps, ≥ 1.

    Returns
    -------
    LoadCycle
        Beginning with the least load, or with the touch-down where the wheel lifts off.

    Notes
    -----
    The relaxation length goes with the load^(1/3); what is rolled of it in a step is integrated
    with Gauss's two points, which never meet the moment without load.
    """
    start = first_phase(amplitude)
    width = (math.pi - 2.0 * start) / steps
    rolled = np.zeros(steps)
    for point in (0.5 - _GAUSS, 0.5 + _GAUSS):
        shares = [load_share(amplitude, start + (k + point) * width) for k in range(steps)]
        rolled += 0.5 * width / np.cbrt(shares)
    turn = 2.0 * math.pi * frequency * relaxation_length(contact.a)
    rolled *= speed / turn if turn > 0.0 else math.inf
    share = [load_share(amplitude, start + k * width) for k in range(steps + 1)]
    return LoadCycle(np.array(share), rolled, width / (2.0 * math.pi))


@inlined
def _steady_forces(
    law: Any, contact: Any, rail: Any, speed: Any, creepage: Any, shrinks: Any, share: Any,
    steady: Any,
) -> None:  # fmt: skip
    """Fill the steady force at each node, and what sliding leaves of the relaxation length.

    That is the chord of the law over its initial slope in the direction of this creepage.
    """
    tiny = Creepage(_TINY * creepage.longitudinal, _TINY * creepage.lateral, _TINY * creepage.spin)
    for k in range(share.shape[0]):
        steady[k, 0] = steady[k, 1] = 0.0
        steady[k, 2] = 0.0 if shrinks else 1.0
        if share[k] > _LEAST:
            here = contact_under_load(contact, share[k])
            force = law(here, rail, speed, creepage)
            steady[k, 0], steady[k, 1] = force.longitudinal, force.lateral
            if shrinks:
                start = law(here, rail, speed, tiny)
                chord = _TINY * math.sqrt(force.longitudinal**2 + force.lateral**2)
                slope = math.sqrt(start.longitudinal**2 + start.lateral**2)
                steady[k, 2] = chord / slope if slope > 0.0 else 1.0


@inlined
def _weigh(cycle: Any, steady: Any, memory: Any) -> Any:
    """Fill the weights of each step; return what a cycle forgets of the force at its start."""
    rolled = 0.0
    for k in range(cycle.rolled.shape[0]):
        length = max(0.5 * (steady[k, 2] + steady[k + 1, 2]), _LEAST)
        step = relaxation_step(cycle.rolled[k] / length)
        memory[k, 0], memory[k, 1], memory[k, 2] = step.kept, step.before, step.after
        rolled += cycle.rolled[k] / length
    return -math.expm1(-rolled)


@inlined
def _follow(memory: Any, steady: Any, k: Any, x: Any, y: Any) -> Any:
    kept, before, after = memory[k, 0], memory[k, 1], memory[k, 2]
    return (
        kept * x + before * steady[k, 0] + after * steady[k + 1, 0],
        kept * y + before * steady[k, 1] + after * steady[k + 1, 1],
    )


@inlined
def _within(x: Any, y: Any, limit: Any) -> Any:
    """Bring a force back to the circle of friction."""
    size = math.sqrt(x * x + y * y)
    if size <= limit:
        return x, y
    return x * (limit / size), y * (limit / size)


@inlined
def _mean_force(cycle: Any, memory: Any, forgotten: Any, steady: Any, limit: Any) -> Any:
    """Mean over a cycle that repeats itself, |F| ≤ limit · share at every node.

    Without the limit a cycle maps its first force to (1 − forgotten) times it plus what a start at
    zero ends with, so the force that repeats itself is known at once. From there all cycles lie
    above the one sought; where the limit is touched, what came before is forgotten. So with one
    direction two cycles are exact; a direction that turns is forgotten as the relaxation goes.
    """
    x = y = 0.0
    for k in range(cycle.rolled.shape[0]):
        x, y = _follow(memory, steady, k, x, y)
    x, y = _within(x / forgotten, y / forgotten, limit * cycle.share[0])
    sum_x = sum_y = 0.0
    for _ in range(_MOST_CYCLES):
        first_x, first_y = x, y
        sum_x = sum_y = 0.0
        for k in range(cycle.rolled.shape[0]):
            x, y = _follow(memory, steady, k, x, y)
            x, y = _within(x, y, limit * cycle.share[k + 1])
            sum_x += x
            sum_y += y
        if abs(x - first_x) + abs(y - first_y) <= _UNCHANGED * limit:
            break
    return sum_x * cycle.step, sum_y * cycle.step


@compiled
def mean_forces(
    law: Any, contact: Any, rail: Any, speed: Any, creepages: Any, cycle: Any, shrinks: Any,
    steady: Any, memory: Any, mean: Any,
) -> None:  # fmt: skip
    """Fill the mean forces along and across the track for each row of creepages.

    Parameters
    ----------
    law : compiled function
        Law of rolling contact.
    contact, rail, speed
        As the law reads them; the contact is that of the mean load.
    creepages : ndarray (point, 3)
        Longitudinal and lateral creepage [-], spin [1/m].
    cycle : LoadCycle
        From `load_cycle`.
    shrinks : bool
        Whether sliding shortens the relaxation length.
    steady, memory : ndarray (node, 3), (step, 3)
        Work space.
    mean : ndarray (point, 2)
        Result [N].

    Notes
    -----
    The friction limit is that of the rail at the slip speed v √(s_x² + s_y²), times the load of the
    moment.
    """
    for i in range(creepages.shape[0]):
        sx, sy, spin = creepages[i, 0], creepages[i, 1], creepages[i, 2]
        creepage = Creepage(sx, sy, spin)
        _steady_forces(law, contact, rail, speed, creepage, shrinks, cycle.share, steady)
        forgotten = _weigh(cycle, steady, memory)
        limit = contact.load * falling_friction(rail, speed * math.sqrt(sx * sx + sy * sy))
        mean[i, 0], mean[i, 1] = _mean_force(cycle, memory, forgotten, steady, limit)
