"""Friction that falls with the local slip speed and remembers what it was (friction memory)."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.core.errors import Problem, RailgripError


class FrictionMemory(NamedTuple):
    """How far a particle must slip until its friction has followed the slip speed.

    Parameters
    ----------
    distance : float
        Characteristic slip distance d_c, ≥ 0; 0 for friction without memory [m].
    least_slip_speed : float
        Slip speed s_0 with which friction recovers where the surfaces stick, ≥ 0 [m/s].

    Notes
    -----
    The defaults, 1 µm and 10 mm/s, are CONTACT's. They are of the order of the roughness and are
    not measured for any rail: illustrative.
    """

    distance: float = 1e-6
    least_slip_speed: float = 1e-2


def steady_friction(rail: RailFriction, slip_speed: Any) -> Any:
    """Friction coefficient after a long slip at this speed; `falling_friction` over an array."""
    fall = np.exp(-rail.friction_decay * slip_speed)
    return rail.static_friction * ((1.0 - rail.friction_ratio) * fall + rail.friction_ratio)


def remembered_friction(
    rail: RailFriction, memory: FrictionMemory, slip_speed: Any, dt: float, before: Any = None
) -> Any:
    """Friction coefficient of the particle in each cell.

    Parameters
    ----------
    rail : RailFriction
        State of the rail.
    memory : FrictionMemory
        How fast friction follows.
    slip_speed : ndarray (across, along)
        Slip speed, ≥ 0 [m/s].
    dt : float
        Time in which the patch rolls one cell, > 0 [s].
    before : ndarray (across, along), optional
        Friction in the cells one step ago; without it rolling is steady.

    Returns
    -------
    ndarray (across, along)
        Friction coefficient [-].

    Notes
    -----
    dμ/dt = −max(s, s_0)/d_c · (μ − μ_s(s)) for a particle, from μ_s(0) where it enters, by an
    implicit step a cell: μ_i = θ μ_(i+1) + (1 − θ) μ_s(s_i), θ = d_c/(d_c + dt max(s_i, s_0)).
    Without memory the friction would jump where slip begins, and a transient can then have several
    solutions that grow into spikes of traction.

    References
    ----------
    .. [1] E. A. H. Vollebregt, H. M. Schuttelaars, Quasi-static analysis of two-dimensional rolling
       contact with slip-velocity dependent friction, J. Sound Vib. 331 (2012) 2141–2155.
    """
    wanted = steady_friction(rail, slip_speed)
    pace = dt * np.maximum(slip_speed, memory.least_slip_speed)
    kept = memory.distance / np.maximum(memory.distance + pace, 1e-300)
    friction = np.empty_like(wanted)
    entering = np.full(wanted.shape[0], rail.static_friction)
    for column in range(wanted.shape[1] - 1, -1, -1):
        friction[:, column] = (
            kept[:, column] * entering + (1.0 - kept[:, column]) * wanted[:, column]
        )
        entering = friction[:, column] if before is None else before[:, column]
    return friction


def refuse_bad_memory(memory: FrictionMemory) -> None:
    """Raise a RailgripError where a length or speed is negative or no number."""
    wrong = [
        Problem(f"memory.{name}", "must be finite and not negative", got=f"{value}")
        for name, value in memory._asdict().items()
        if not 0.0 <= value < np.inf
    ]
    if wrong:
        raise RailgripError(wrong)
