"""The greatest adhesion that a contact could transmit, at whatever slip: the creep curve's peak."""

from __future__ import annotations

from typing import Any

import numba
import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.core import registry
from railgrip.core.formulas.elementary import power_2_3
from railgrip.engine import layout as at
from railgrip.engine.compiler import inlined
from railgrip.engine.plan import FloatArray, Plan
from railgrip.scenario.scenario import Scenario

CREEPAGES = np.concatenate([np.geomspace(1e-4, 1.0, 60)])
"""Creepages at which the curve is sampled: within 0.3 % of the peak of Polach's curves."""

_power_2_3 = inlined(power_2_3)


@numba.njit(error_model="numpy")
def _peaks(
    law: Any, rail: Any, load: Any, static_load: Any, slope: Any, speed: Any, creepages: Any
) -> Any:
    found = np.empty(load.shape[0])
    for i in range(load.shape[0]):
        state = RailFriction(rail[i, 0], rail[i, 1], rail[i, 2], rail[i, 3], rail[i, 4])
        steep = slope[i] * _power_2_3(load[i] / static_load[i])
        best = 0.0
        for creepage in creepages:
            best = max(best, law(state, load[i], steep, creepage * speed[i], creepage))
        found[i] = best / load[i]
    return found


def available_adhesion(
    scenario: Scenario, plan: Plan, of_axle: dict[str, FloatArray], speed: FloatArray
) -> FloatArray:
    """Return the peak of the creep curve at every point of the traces (run, axle, time).

    Own cleaning in the contact is left out: it is what the rail offers as it lies there.
    """
    law = inlined(registry.resolve("railgrip.laws", scenario.run.creep_law))
    shape = of_axle["wheel_load"].shape

    def per_axle(offset: int) -> FloatArray:
        column = plan.parameters[1:, offset - at.FIRST_PARAMETER]
        spread: FloatArray = np.ascontiguousarray(np.broadcast_to(column[None, :, None], shape))
        return spread.ravel()

    names = (
        "rail_friction", "friction_ratio", "friction_decay", "adhesion_reduction", "slip_reduction",
    )  # fmt: skip
    rail = np.stack([of_axle[name].ravel() for name in names], axis=1)
    peaks: FloatArray = _peaks(
        law, rail, of_axle["wheel_load"].ravel(), per_axle(at.STATIC_LOAD),
        per_axle(at.KALKER_SLOPE), np.broadcast_to(speed, shape).ravel(), CREEPAGES,
    )  # fmt: skip
    return peaks.reshape(shape)
