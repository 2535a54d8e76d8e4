"""Any law of rolling contact over NumPy arrays of creepages, spin, speed and load."""

from __future__ import annotations

import math
from functools import cache
from types import FunctionType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.compiler import entry, numba, with_compiled_callees
from railgrip.contact.kalker_linear import kalker_linear
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact, RollingLaw
from railgrip.contact.validity import is_within, validity_of
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.fastsim_strips import ABREAST, work_space
from railgrip.laboratory.inputs import FloatArray, as_floats, checked_points, refuse


class CreepForces(NamedTuple):
    """What a law says, point by point; all arrays have one shape.

    Parameters
    ----------
    longitudinal, lateral : ndarray
        Forces with the sign of the creepages [N].
    spin_moment : ndarray
        Moment about the normal [N m]; zero where the law gives none.
    is_valid : ndarray of bool
        False where the creepages are beyond what the law declares itself good for.
    """

    longitudinal: FloatArray
    lateral: FloatArray
    spin_moment: FloatArray
    is_valid: NDArray[np.bool_]


def creep_forces(
    law: str | RollingLaw,
    contact: RollingContact,
    rail: RailFriction,
    speed: ArrayLike,
    longitudinal: ArrayLike,
    lateral: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    *,
    load: ArrayLike | None = None,
) -> CreepForces:
    """Creep forces by a law for arrays of creepages, compiled; one core, no interpreter lock.

    Parameters
    ----------
    law : str or function
        Name of a registered law of rolling contact, or a function with the same contract.
    contact : RollingContact
        The contact; its load is the load of reference.
    rail : RailFriction
        State of the rail.
    speed : array_like
        Speed of the train, > 0 [m/s].
    longitudinal, lateral : array_like
        Creepages, finite [-].
    spin : array_like
        Spin, finite [1/m].
    load : array_like, optional
        Normal force, > 0 [N]; the patch grows with load^(1/3) and keeps its shape.

    Returns
    -------
    CreepForces
        Arrays of the shape that the arguments broadcast to. Each value has the same bits as the
        law called from Python.

    Raises
    ------
    RailgripError
        ``law of rolling contact 'polach' unknown; known: …; did you mean 'polach_2005'?``;
        ``the load must be positive and finite; got -5.0 N``; the same for speed, creepages, spin;
        and where the shapes do not broadcast.

    Notes
    -----
    A law declares its range with `railgrip.contact.validity.valid_within`.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> forces = creep_forces("polach_2005", base, DRY_POLACH_2005, 20.0, [0.0, 0.01, -0.01])
    >>> forces.longitudinal.round(2).tolist(), forces.is_valid.tolist()
    ([0.0, 35940.38, -35940.38], [True, True, True])
    """
    function = registry.resolve("railgrip.rolling_laws", law) if isinstance(law, str) else law
    loads = contact.load if load is None else load
    columns = checked_points(speed, loads, longitudinal, lateral, spin)
    shape = columns[0].shape
    growth = _growth(as_floats("load", loads) / contact.load)  # before there are a million of them
    flat = [*(column.ravel() for column in columns), np.broadcast_to(growth, shape).ravel()]
    force_x, force_y, moment = np.empty((3, flat[0].size))
    forces = CreepForces(force_x, force_y, moment, np.empty(flat[0].size, dtype=np.bool_))
    _kernel(function)(contact, rail, validity_of(function), *flat, *forces, work_space())
    return CreepForces(
        forces.longitudinal.reshape(shape),
        forces.lateral.reshape(shape),
        forces.spin_moment.reshape(shape),
        forces.is_valid.reshape(shape),
    )


def rescaled(contact: RollingContact, load: float) -> RollingContact:
    """Return the contact under another load: its patch grows with load^(1/3), its shape stays.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 8e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> round(rescaled(wheel, 12.5e3).a, 9)
    0.004
    """
    if not 0.0 < load < math.inf:
        refuse("load", load, "N", positive=True)
    growth = math.cbrt(load / contact.load)
    return contact._replace(load=load, a=growth * contact.a, b=growth * contact.b)


_law: RollingLaw = kalker_linear
"""Law of the call below; `_kernel` makes a copy of the call for each law."""


def _alone(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage, work: Any
) -> CreepForce:
    """Call a law that needs no work space."""
    return _law(contact, rail, speed, creepage)


_law_with_work = _alone
"""Law of the loop below; `_kernel` makes a copy of the loop for each law."""


def _over_points(
    contact: Any, rail: Any, validity: Any, speed: Any, load: Any,
    longitudinal: Any, lateral: Any, spin: Any, growth: Any,
    force_x: Any, force_y: Any, moment: Any, is_valid: Any, work: Any,
) -> None:  # fmt: skip
    for i in range(speed.size):
        here = RollingContact(
            load[i], growth[i] * contact.a, growth[i] * contact.b,
            contact.shear_modulus, contact.poisson,
            contact.c11, contact.c22, contact.c23, contact.c33,
        )  # fmt: skip
        creepage = Creepage(longitudinal[i], lateral[i], spin[i])
        force = _law_with_work(here, rail, speed[i], creepage, work)
        force_x[i], force_y[i], moment[i] = (
            force.longitudinal, force.lateral, force.spin_moment,
        )  # fmt: skip
        is_valid[i] = is_within(validity, here, rail, speed[i], creepage)


@cache
def _kernel(law: RollingLaw) -> Any:
    """Compile the loop around one law; kept on disk where law and loop are both our own."""
    if not isinstance(law, FunctionType):
        raise RailgripError(
            Problem(
                "",
                "a law must be a plain Python function",
                got=type(law).__name__,
                cure="give its name, or a function of contact, rail, speed and creepage",
            )
        )
    name = f"{law.__module__}_{law.__name__}".replace(".", "_")
    with_work = ABREAST.get(law) or _rebound(_alone, f"call_{name}", _law=law)
    kernel = _rebound(_over_points, f"over_points_of_{name}", _law_with_work=with_work)
    if law.__module__.startswith("railgrip."):
        return entry(kernel)
    return numba.njit(with_compiled_callees(kernel), error_model="numpy", nogil=True)


def _rebound(template: Any, name: str, **names: Any) -> FunctionType:
    """Return the template under another name, with some of its global names standing for others."""
    bound = FunctionType(template.__code__, {**globals(), **names}, name)
    bound.__module__, bound.__qualname__ = __name__, name
    return bound


def _growth(ratio: FloatArray) -> FloatArray:
    """Cube root of each ratio by `math.cbrt`, whose bits NumPy's own does not promise."""
    loads, places = np.unique(ratio, return_inverse=True)
    roots = np.array([math.cbrt(each) for each in loads.tolist()])
    return roots[places].reshape(ratio.shape)
