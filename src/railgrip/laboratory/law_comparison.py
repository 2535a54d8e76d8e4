"""Several laws of rolling contact, and the exact theory, on the same points."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, RollingContact
from railgrip.core import registry
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    flash_conductance,
    flash_temperature,
)
from railgrip.laboratory.exact import solve_exact
from railgrip.laboratory.inputs import FloatArray, checked_points
from railgrip.laboratory.laws_over_arrays import CreepForces, creep_forces, rescaled
from railgrip.laboratory.sliding_contact import SlidingContact

EXACT = "exact"
"""Name under which the exact theory stands among the laws."""


@dataclass(frozen=True, eq=False)
class LawComparison:
    """Forces by several laws, point by point; every array has one value a point.

    Parameters
    ----------
    contact : RollingContact
        The contact under the load of reference.
    rail : RailFriction
        State of the rail.
    speed, load : ndarray
        Speed of the train [m/s], normal force [N].
    longitudinal, lateral, spin : ndarray
        Creepages [-], spin [1/m].
    forces : dict of str to CreepForces
        By law, in the order asked for.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.scenario.contact_pair import contact_of_pair
    >>> found = compare_laws(
    ...     ["polach_2005"], contact_of_pair("cone_on_head", 100e3), DRY_POLACH_2005, 20.0, 0.01
    ... )
    >>> found.adhesion("polach_2005").round(4).item()
    0.3594
    """

    contact: RollingContact
    rail: RailFriction
    speed: FloatArray
    load: FloatArray
    longitudinal: FloatArray
    lateral: FloatArray
    spin: FloatArray
    forces: dict[str, CreepForces]

    @property
    def laws(self) -> list[str]:
        """Names of the laws, the first asked for first."""
        return list(self.forces)

    @property
    def friction_limit(self) -> FloatArray:
        """Static friction times load, μ0 Q [N]: what differences are measured by."""
        return self.rail.static_friction * self.load

    @property
    def slip_speed(self) -> FloatArray:
        """Slip speed at the centre of the patch, v √(s_x² + s_y²) [m/s]."""
        return self.speed * np.hypot(self.longitudinal, self.lateral)

    def adhesion(self, law: str) -> FloatArray:
        """Adhesion used by a law: resultant force over load [-]."""
        found = self.forces[law]
        return np.hypot(found.longitudinal, found.lateral) / self.load

    def difference(self, law: str, reference: str) -> FloatArray:
        """Length of the difference of both laws' forces over μ0 Q [-]; NaN without friction."""
        ours, its = self.forces[law], self.forces[reference]
        apart = np.hypot(ours.longitudinal - its.longitudinal, ours.lateral - its.lateral)
        with np.errstate(invalid="ignore"):
            return np.asarray(apart / self.friction_limit)

    def friction_power(self, law: str) -> FloatArray:
        """Power that the contact turns into heat, v (F_x s_x + F_y s_y + M φ) [W].

        A law that gives no moment leaves out what spin adds.
        """
        x, y, moment, _ = self.forces[law]
        return self.speed * (x * self.longitudinal + y * self.lateral + moment * self.spin)

    def flash_rise(self, law: str) -> FloatArray:
        """Greatest flash temperature of steel surfaces over that at which they enter [K].

        The heat is spread like Hertz's pressure, as when the whole patch slides. Where part of it
        sticks, the same power heats less of it and the true rise is greater: on the base case by a
        half at 0.2 %, an eighth at 0.5 %, a fourteenth at 1 %; `patch_rises` gives it. A law
        without a moment may take power from a large spin; that counts as no heat.
        """
        power = np.maximum(self.friction_power(law), 0.0).tolist()
        return np.array(
            [
                flash_temperature(
                    flash_conductance(STEEL_ERTZ_2002, a, b, wheel),
                    flash_conductance(STEEL_ERTZ_2002, a, b, train),
                    heat,
                ).rise
                for heat, (_, a, b, wheel, train) in zip(power, self._surfaces(), strict=True)
            ]
        )

    def surface_temperature(
        self, law: str, wheel_temperature: float = 20.0, rail_temperature: float = 20.0
    ) -> FloatArray:
        """Greatest temperature in the patch: where the bodies meet, and the flash on top [°C].

        The arguments are the temperatures with which wheel and rail enter [°C].
        """
        touch = [
            SlidingContact(
                load, a, b, 0.0, wheel, train, wheel_temperature, rail_temperature
            ).touch_temperature()
            for load, a, b, wheel, train in self._surfaces()
        ]
        return np.array(touch) + self.flash_rise(law)

    def _surfaces(self) -> list[tuple[float, ...]]:
        """Load, semi-axes, speeds of wheel and rail surface at each point."""
        growth = np.cbrt(self.load / self.contact.load)
        wheel_speed = np.abs(self.speed * (1.0 + self.longitudinal))
        columns = (
            self.load, growth * self.contact.a, growth * self.contact.b, wheel_speed, self.speed,
        )  # fmt: skip
        return list(zip(*(column.tolist() for column in columns), strict=True))


def law_names() -> list[str]:
    """Return what `compare_laws` knows: the registered laws of rolling contact, and ``exact``.

    Examples
    --------
    >>> {"polach_2005", "exact"} <= set(law_names())
    True
    """
    return sorted({*registry.names("railgrip.rolling_laws"), EXACT})


def compare_laws(
    laws: Sequence[str],
    contact: RollingContact,
    rail: RailFriction,
    speed: ArrayLike,
    longitudinal: ArrayLike = 0.0,
    lateral: ArrayLike = 0.0,
    spin: ArrayLike = 0.0,
    *,
    load: ArrayLike | None = None,
) -> LawComparison:
    """Forces by several laws on the same points.

    Choose it to see by how much laws part; for one law over many points `creep_forces` is enough.

    Parameters
    ----------
    laws : sequence of str
        Names of registered laws, or ``exact``; each once, at least one.
    contact, rail, speed, longitudinal, lateral, spin, load
        As in `creep_forces`; one row of points.

    Returns
    -------
    LawComparison
        One value a point and law.

    Raises
    ------
    RailgripError
        ``law of rolling contact 'polach' unknown; known: …; did you mean 'polach_2005'?``; "no law
        is given"; "the points must lie in one row"; and from `creep_forces`.

    Notes
    -----
    ``exact`` is `solve_exact` on 48 × 48 cells, some 20 ms a point, 100 ms where friction falls
    steeply; a point at which it does not converge is flagged as not valid.

    Checked by tests/unit/laboratory/test_law_comparison.py.

    Examples
    --------
    >>> from railgrip.scenario.contact_pair import contact_of_pair
    >>> base, coulomb = contact_of_pair("cone_on_head", 100e3), RailFriction(0.3, 1.0, 0, 1.0, 1.0)
    >>> found = compare_laws(["exact", "fastsim_1982"], base, coulomb, 20.0, [0.001, 0.003])
    >>> found.difference("fastsim_1982", "exact").round(3).tolist()
    [0.014, 0.039]
    """
    if not laws:
        raise RailgripError(Problem("laws", "no law is given", cure=", ".join(law_names())))
    for law in laws:
        if law not in law_names():
            raise RailgripError(unknown_name("laws", "law of rolling contact", law, law_names()))
    points = checked_points(
        speed, contact.load if load is None else load, longitudinal, lateral, spin
    )
    if points[0].ndim > 1:
        raise RailgripError(Problem("", "the points must lie in one row", got=f"{points[0].shape}"))
    points = tuple(np.atleast_1d(column) for column in points)
    forces = {law: _forces(law, contact, rail, *points) for law in dict.fromkeys(laws)}
    speeds, loads, along, across, spins = points
    return LawComparison(contact, rail, speeds, loads, along, across, spins, forces)


def _forces(
    law: str,
    contact: RollingContact,
    rail: RailFriction,
    speed: FloatArray,
    load: FloatArray,
    longitudinal: FloatArray,
    lateral: FloatArray,
    spin: FloatArray,
) -> CreepForces:
    if law != EXACT:
        return creep_forces(law, contact, rail, speed, longitudinal, lateral, spin, load=load)
    solutions = [
        solve_exact(rescaled(contact, q), rail, v, Creepage(s_x, s_y, turn))
        for v, q, s_x, s_y, turn in zip(
            *(column.tolist() for column in (speed, load, longitudinal, lateral, spin)), strict=True
        )
    ]
    components: NDArray[np.float64] = np.array([solution.force for solution in solutions]).T
    is_valid = np.array([solution.is_converged for solution in solutions])
    return CreepForces(components[0], components[1], components[2], is_valid)
