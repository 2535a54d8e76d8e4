"""What happens within the patch, cell by cell, by FASTSIM or by the exact theory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from railgrip.contact.modified_fastsim_2013 import EUROSPRINTER_2013, SlopeReduction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.laboratory.exact import solve_exact
from railgrip.laboratory.fastsim_map import fastsim_map
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.law_comparison import EXACT

_FASTSIM: dict[str, tuple[str, SlopeReduction | None]] = {
    "fastsim_1982": ("parabolic", None),
    "fastsim_elliptic_1982": ("elliptic", None),
    "modified_fastsim_2013": ("parabolic", EUROSPRINTER_2013),
}
MAPPED_LAWS = (*_FASTSIM, EXACT)
"""Laws that know what happens within the patch."""

_CELLS = 48


@dataclass(frozen=True, eq=False)
class PatchMap:
    """Fields over the patch; all arrays have one two-dimensional shape.

    Parameters
    ----------
    x, y : ndarray
        Centres of the cells: x in the direction of rolling, y to its left [m].
    pressure : ndarray
        Hertz's pressure [Pa].
    traction_x, traction_y : ndarray
        Traction of the rail on the wheel, with the sign of the forces [Pa].
    slip_x, slip_y : ndarray
        Slip of wheel on rail over the speed of the train, with the sign of the creepages [-].
    is_inside, is_slipping : ndarray of bool
        Cells in contact; those of them where friction does not hold.
    heat_flux : ndarray
        Friction power per area, traction times slip speed, ≥ 0 [W/m²].
    forces : CreepForce
        Sum over the patch.
    """

    x: FloatArray
    y: FloatArray
    pressure: FloatArray
    traction_x: FloatArray
    traction_y: FloatArray
    slip_x: FloatArray
    slip_y: FloatArray
    is_inside: NDArray[np.bool_]
    is_slipping: NDArray[np.bool_]
    heat_flux: FloatArray
    forces: CreepForce


def patch_map(
    law: str,
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    *,
    cells: int = _CELLS,
) -> PatchMap:
    """Pressure, traction, slip and friction heat within the patch.

    Choose ``exact`` for what is true, ``fastsim_elliptic_1982`` for a quick picture; the parabolic
    bound of ``fastsim_1982`` gives better forces and tractions a third too large at the centre.

    Parameters
    ----------
    law : str
        One of `MAPPED_LAWS`.
    contact, rail, speed, creepage
        As in `fastsim_map` and `solve_exact`.
    cells : int
        Cells along and across.

    Returns
    -------
    PatchMap
        By rows and columns of the law's own grid.

    Raises
    ------
    RailgripError
        ``law: law with a map 'polach_2005' unknown; known: exact, fastsim_1982, …``; "the exact
        solver did not converge"; and from `fastsim_map` and `solve_exact`.

    Notes
    -----
    FASTSIM's rows go from the leading to the trailing edge, and its columns are strips of unlike
    length; the exact grid is a rectangle around the ellipse. The pressure is Hertz's in both, the
    heat is traction · slip · speed.

    Checked by tests/unit/laboratory/test_patch_map.py: the heat adds up to the power of the forces.

    Examples
    --------
    >>> from railgrip.scenario.contact_pair import contact_of_pair
    >>> base, coulomb = contact_of_pair("cone_on_head", 100e3), RailFriction(0.3, 1.0, 0, 1.0, 1.0)
    >>> found = patch_map("exact", base, coulomb, 20.0, Creepage(0.002, 0.0, 0.0))
    >>> round(float(found.is_slipping.sum() / found.is_inside.sum()), 2)
    0.48
    """
    if law not in MAPPED_LAWS:
        raise RailgripError(unknown_name("law", "law with a map", law, MAPPED_LAWS))
    if law == EXACT:
        return _exact(contact, rail, speed, creepage, cells)
    bound, reduction = _FASTSIM[law]
    found = fastsim_map(
        contact, rail, speed, creepage, cells=cells, bound=bound, reduction=reduction
    )
    inside = 1.0 - (found.x / contact.a) ** 2 - (found.y / contact.b) ** 2
    greatest = 1.5 * contact.load / (np.pi * contact.a * contact.b)
    return PatchMap(
        found.x,
        found.y,
        greatest * np.sqrt(np.maximum(inside, 0.0)),
        found.traction_x,
        found.traction_y,
        found.slip_x,
        found.slip_y,
        np.ones(found.x.shape, dtype=np.bool_),
        found.is_slipping,
        speed * (found.traction_x * found.slip_x + found.traction_y * found.slip_y),
        found.forces,
    )


def _exact(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage, cells: int
) -> PatchMap:
    found = solve_exact(contact, rail, speed, creepage, grid=(cells, cells))
    if not found.is_converged:
        raise RailgripError(
            Problem(
                "creepage",
                "the exact solver did not converge",
                got=f"residual {found.residual:.1e}",
                cure="another number of cells, or fastsim_1982",
            )
        )
    x, y = np.meshgrid(found.x, found.y)
    heat = speed * (found.traction_x * found.slip_x + found.traction_y * found.slip_y)
    return PatchMap(
        x,
        y,
        found.pressure,
        found.traction_x,
        found.traction_y,
        found.slip_x,
        found.slip_y,
        found.is_inside,
        found.is_slipping,
        np.where(found.is_slipping, heat, 0.0),
        found.force,
    )
