"""Whether the measurements can tell a function at all; if not, why."""

from __future__ import annotations

import numpy as np

from railgrip.core.errors import Problem
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.pad_fit.additive import range_of
from railgrip.laboratory.pad_fit.data import INFLUENCES, UNITS, Blocks
from railgrip.laboratory.pad_fit.shape import MOST_POINTS, hats

LEAST_VARIATION = {"temperature": 30.0, "speed": 5.0}
LEAST_FORCE_VARIATION = 0.15
"""Of the clamp force, in shares of its median."""
LEAST_OWN_SHARE = 0.02
"""Share of an influence's variance that the others must leave unexplained."""
DROPPED_FIRST = ("clamp_force", "temperature", "speed")
"""Of influences that move together, the one dropped: the source's (III) before (II) before (I)."""


def identifiable(asked: list[str], blocks: Blocks) -> tuple[list[str], list[Problem]]:
    """Return the influences that a function can be found for, and why not for the others.

    Parameters
    ----------
    asked : list of str
        Influences that shall have a function.
    blocks : Blocks
        The measurements.

    Returns
    -------
    tuple
        Names in the order of `INFLUENCES`; one sentence for each other.
    """
    problems: list[Problem] = []
    left = []
    for name in INFLUENCES:
        if name in asked:
            problem = _varies_too_little(name, blocks)
            problems += [problem] if problem else []
            left += [] if problem else [name]
    for name in DROPPED_FIRST:
        if name in left and len(left) > 1:
            problem = _moves_with_others(name, left, blocks)
            if problem:
                problems.append(problem)
                left.remove(name)
    return left, problems


def _varies_too_little(name: str, blocks: Blocks) -> Problem | None:
    if np.isnan(blocks.values[INFLUENCES.index(name)][blocks.is_there]).any():
        what = "its function cannot be found: it was not measured"
        return Problem(name, what, cure=f'[[channel]] column = "…", signal = "{_signal(name)}"')
    low, high = range_of(name, blocks)
    least = LEAST_VARIATION.get(name, LEAST_FORCE_VARIATION * 0.5 * (low + high))
    if high - low >= least:
        return None
    unit = UNITS[name]
    got = f"{low:.4g} to {high:.4g} {unit}"
    what = "its function cannot be found: it varies too little"
    cure = "add stops from other speeds, temperatures or pressures"
    return Problem(
        name, what, got, f"a range of {least:.3g} {unit.replace('°C', 'K')} or more", cure
    )


def _signal(name: str) -> str:
    return {"temperature": "disc_temperature", "speed": "rubbing_speed"}.get(name, name)


def _moves_with_others(name: str, among: list[str], blocks: Blocks) -> Problem | None:
    there = blocks.is_there
    target = blocks.values[INFLUENCES.index(name)][there]
    others = [other for other in among if other != name]
    share = _own_share(target, [blocks.values[INFLUENCES.index(o)][there] for o in others])
    if share >= LEAST_OWN_SHARE:
        return None
    words = " and ".join(other.replace("_", " ") for other in others)
    what = f"its function cannot be told from that of the {words}: they move together"
    got = f"{share:.1%} of its variation is its own"
    cure = "add stops in which it takes other values at the same " + words
    return Problem(name, what, got, f"{LEAST_OWN_SHARE:.0%} or more", cure)


def _own_share(target: FloatArray, others: list[FloatArray]) -> float:
    columns = [np.ones((len(target), 1))]
    for values in others:
        low, high = np.quantile(values, [0.002, 0.998])
        knots = np.linspace(float(low), float(high), 12)
        columns.append(hats(knots, values)[:, 1:])
    design = np.concatenate(columns, axis=1)
    fitted = design @ np.linalg.lstsq(design, target, rcond=None)[0]
    return float(np.var(target - fitted) / np.var(target))


def levels_of(name: str, blocks: Blocks) -> tuple[float, ...]:
    """Return the few values that an influence takes, or nothing where it moves freely.

    Two to four values, each far narrower than the steps between them, cannot show where a function
    bends between them; but they are good points for it.
    """
    values = np.sort(blocks.values[INFLUENCES.index(name)][blocks.is_there])
    span = values[-1] - values[0]
    cuts = np.flatnonzero(np.diff(values) > 0.1 * span) + 1
    groups = np.split(values, cuts)
    narrow = all(group[-1] - group[0] < 0.06 * span for group in groups)
    if not 2 <= len(groups) <= MOST_POINTS or not narrow:
        return ()
    return tuple(float(group.mean()) for group in groups)
