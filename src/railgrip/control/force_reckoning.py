"""Reference speed out of the forces that the rails are observed to give, while all wheels slide.

The ordinary protection reckons with cylinder pressures and a gain that it learns. Where the force
of each axle is observed (`adhesion_window`), their sum over the mass is the train's deceleration.
"""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.conventional_parameters import DECELERATION_PER_PRESSURE
from railgrip.control.conventional_state import DECELERATION, OFFSET, PRESSURE_GAIN
from railgrip.control.deceleration_estimate import (
    GREATEST_DECELERATION,
    GREATEST_OFFSET,
    learn_pressure_gain,
)
from railgrip.control.free_axle import free_an_axle
from railgrip.control.reference_speed import advance_reference
from railgrip.control.side_by_side import total
from railgrip.control.state_layout import group_base, groups
from railgrip.control.temperature_state import COUNTED_FRICTION, COUNTED_LOAD
from railgrip.control.train_observer import Wheels
from railgrip.core.constants import GRAVITY


def reckon_with_forces(
    parameters: FloatArray,
    state: FloatArray,
    wheels: Wheels,
    n_axles: int,
    slip_lower: float,
    dt: float,
) -> None:
    """Update deceleration, freed axle and reference speed in the state.

    Parameters
    ----------
    parameters, state : ndarray
        As in the controller contract.
    wheels : Wheels
        What a look at the wheels has shown.
    n_axles : int
        Number of axles.
    slip_lower : float
        How exactly the train speed must be known, as a slip.
    dt : float
        Period, [s].

    Notes
    -----
    D = κ ΣF/ΣM + offset over the axles whose sensor is believed. κ, 1 at the start, is learned
    while the wheels adhere, as the ordinary protection learns its gain: it holds the error of pads
    and masses; the offset, learned on free wheels, holds resistance and gradient.
    """
    force = 0.0
    load = 0.0
    for group in range(groups(n_axles)):
        force -= total(state, group_base(group) + COUNTED_FRICTION)
        load += total(state, group_base(group) + COUNTED_LOAD)
    by_forces = force * GRAVITY / load if load > 0.0 else 0.0
    # in the terms of the ordinary gain, so that it learns and bounds as it does there
    effort = by_forces * (1.0 / parameters[DECELERATION_PER_PRESSURE])
    deceleration = state[PRESSURE_GAIN] * effort + state[OFFSET]
    state[DECELERATION] = max(-GREATEST_OFFSET, min(GREATEST_DECELERATION, deceleration))
    free_an_axle(parameters, state, n_axles, wheels.is_witnessed, slip_lower, dt)
    advance_reference(parameters, state, wheels.fastest, wheels.seen, dt)
    learn_pressure_gain(parameters, state, effort, wheels.fastest, wheels.is_adhering, dt)
