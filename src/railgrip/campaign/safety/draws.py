"""From standard normal numbers and failed units to the brakes of a train, run by run."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.campaign.safety.marginals import of_sample, value
from railgrip.campaign.safety.train_layout import BoolArray, FloatArray, Layout
from railgrip.campaign.safety.variable import OF_TRAIN


class Trains(NamedTuple):
    """Numbers that differ from run to run: (runs, braked axles), of the train (runs,)."""

    pressure: FloatArray
    efficiency: FloatArray
    friction: FloatArray
    radius: FloatArray
    fill: FloatArray
    dead: FloatArray
    mass: FloatArray
    resistance: FloatArray
    works: BoolArray
    disc_temperature: FloatArray
    temperature_error: FloatArray
    deceleration_scale: FloatArray
    deceleration_offset: FloatArray
    is_controlled: BoolArray

    def chosen(self, runs: BoolArray) -> Trains:
        """Return only some of the trains."""
        return Trains(*(numbers[runs] for numbers in self))  # type: ignore[arg-type]


def trains(layout: Layout, normals: FloatArray, failed: BoolArray) -> Trains:
    """Return the trains that normal numbers and failed units make.

    Parameters
    ----------
    layout : Layout
        From `layout_of`.
    normals : (runs, variables)
        Standard normal numbers.
    failed : (runs, units) bool
        Which units have failed.
    """
    brakes, runs = layout.brakes, len(normals)
    shape = (runs, len(brakes.axle))
    found = {
        "cylinder_pressure": np.broadcast_to(brakes.pressure, shape).copy(),
        "rigging_efficiency": np.broadcast_to(brakes.efficiency, shape).copy(),
        "pad_friction": np.ones(shape),
        "fill_time": np.broadcast_to(brakes.fill, shape).copy(),
        "dead_time": np.broadcast_to(brakes.dead, shape).copy(),
        "wheel_radius": np.broadcast_to(brakes.radius, shape).copy(),
        "disc_temperature": np.broadcast_to(brakes.temperature, shape).copy(),
        "temperature_error": np.zeros(shape),
        "mass": np.ones((runs, 1)),
        "resistance": np.ones((runs, 1)),
        "deceleration_scale": np.ones((runs, 1)),
        "deceleration_offset": np.zeros((runs, 1)),
    }
    if layout.together:
        normals = normals.copy()
        for columns, factor in layout.together:
            normals[:, columns] = normals[:, columns] @ factor.T
    for variable, column in layout.variables:
        target = found[variable.quantity]
        acts = np.flatnonzero(column >= 0)[: 1 if variable.quantity in OF_TRAIN else None]
        scores = normals[:, column[acts]]
        if variable.distribution == "empirical":
            drawn = of_sample(variable.sample, scores)
        else:
            drawn = value(variable.distribution, variable.numbers, scores)
        here = np.arange(target.shape[1]) if variable.quantity in OF_TRAIN else acts
        if variable.means == "value":
            target[:, here] = drawn
        elif variable.means == "difference":
            target[:, here] += drawn
        else:
            target[:, here] *= drawn
    works = ~(failed @ layout.fails) if len(layout.fails) else np.ones(shape, dtype=bool)
    has_control = layout.control >= 0
    is_controlled = ~failed[:, layout.control] if has_control else np.ones(runs, dtype=bool)
    return Trains(
        found["cylinder_pressure"], found["rigging_efficiency"] / brakes.efficiency,
        found["pad_friction"], found["wheel_radius"], np.maximum(found["fill_time"], 0.02),
        np.maximum(found["dead_time"], 0.0), found["mass"][:, 0], found["resistance"][:, 0],
        works, found["disc_temperature"], found["temperature_error"],
        found["deceleration_scale"][:, 0], found["deceleration_offset"][:, 0], is_controlled,
    )  # fmt: skip
