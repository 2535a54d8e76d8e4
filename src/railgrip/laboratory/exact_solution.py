"""What the exact solver returns, and the way there and back from the patch's normal size."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.laboratory.exact_checks import falls
from railgrip.laboratory.exact_friction import FrictionMemory
from railgrip.laboratory.exact_newton import TangentialAnswer
from railgrip.laboratory.exact_step import FrictionCase
from railgrip.laboratory.half_space_patch import HalfSpacePatch

SPIN_SHIFT = 1.0 / 6.0
"""How many cells ahead of its centre the spin of a cell is taken; as CONTACT does."""


@dataclass(frozen=True, eq=False)
class ExactSolution:
    """Forces, and what happens in each cell of the patch.

    Parameters
    ----------
    force : CreepForce
        What the rail does to the wheel [N, N, N m].
    is_converged : bool
        Whether the equations hold to the tolerance; if not, nothing here may be relied on.
    residual : float
        What is left of them, over the size of the traction [-].
    newton_steps, friction_rounds : int
        Newton steps in all, and how often a falling friction was renewed.
    x, y : ndarray (along), (across)
        Centres of the cells, rolling towards +x [m].
    cell_area : float
        Area of a cell [m²].
    is_inside, is_slipping : ndarray (across, along)
        Cells in contact; those of them that slip.
    pressure : ndarray (across, along)
        Normal pressure [Pa].
    traction_x, traction_y : ndarray (across, along)
        Tangential stress on the wheel, with the sign of `force` [Pa].
    slip_x, slip_y : ndarray (across, along)
        Slip of the wheel's surface on the rail over the speed, with the sign of the creepage [-].
    friction : ndarray (across, along)
        Friction coefficient [-].
    """

    force: CreepForce
    is_converged: bool
    residual: float
    newton_steps: int
    friction_rounds: int
    x: Any
    y: Any
    cell_area: float
    is_inside: Any
    is_slipping: Any
    pressure: Any
    traction_x: Any
    traction_y: Any
    slip_x: Any
    slip_y: Any
    friction: Any

    @property
    def is_sticking(self) -> Any:
        """Cells in contact that do not slip."""
        return self.is_inside & ~self.is_slipping


def free_slip(patch: HalfSpacePatch, contact: RollingContact, creepage: Creepage) -> Any:
    """Slip of rigid bodies in each cell over one step [a], (2, across, along)."""
    spin = creepage.spin * contact.a
    ahead = patch.x + SPIN_SHIFT * patch.dx
    slip = np.empty((2, patch.y.size, patch.x.size))
    slip[0] = creepage.longitudinal - spin * patch.y[:, None]
    slip[1] = creepage.lateral + spin * ahead[None, :]
    return slip * patch.dx * patch.is_inside


def friction_case(
    patch: HalfSpacePatch,
    contact: RollingContact,
    rail: RailFriction,
    memory: FrictionMemory,
    speed: float,
    before: Any,
) -> FrictionCase:
    """Friction of this contact in the patch's normal size."""
    dt = patch.dx * contact.a / speed if falls(rail) else 0.0
    to_speed = speed / patch.dx if falls(rail) else 0.0
    pressure = patch.pressure * (contact.load / (math.pi * contact.shear_modulus * contact.a**2))
    return FrictionCase(rail, memory, pressure, to_speed, dt, before)


def solution_of(
    patch: HalfSpacePatch,
    contact: RollingContact,
    answer: TangentialAnswer,
    friction: Any,
    rounds: int,
) -> ExactSolution:
    """Put the answer into SI units and add it up."""
    a, area = contact.a, patch.dx * patch.dy * contact.a**2
    x, y = a * patch.x, a * patch.y
    along, across = answer.traction * (math.pi * contact.shear_modulus)
    slip = answer.slip / patch.dx
    moment = float((across @ x).sum() - (y @ along).sum())
    return ExactSolution(
        force=CreepForce(float(along.sum()) * area, float(across.sum()) * area, moment * area),
        is_converged=answer.is_converged,
        residual=answer.residual,
        newton_steps=answer.steps,
        friction_rounds=rounds,
        x=x,
        y=y,
        cell_area=area,
        is_inside=patch.is_inside,
        is_slipping=answer.is_slipping,
        pressure=patch.pressure * (contact.load / a**2),
        traction_x=along,
        traction_y=across,
        slip_x=slip[0],
        slip_y=slip[1],
        friction=friction,
    )
