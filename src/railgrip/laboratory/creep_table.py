"""A creep law as a table: what it holds, and its force."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.input_checks import refuse_not_positive
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import resultant
from railgrip.contact.rolling_contact import RollingContact
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.creep_grid import GridAxis, chord_by_grid
from railgrip.laboratory.creep_spline import chord_by_table
from railgrip.laboratory.inputs import FloatArray, refuse


class CreepTable(NamedTuple):
    """Longitudinal creep force of one law on one shape of contact; made by `tabulate`.

    Parameters
    ----------
    law : str
        Name of the law.
    contact : RollingContact
        The contact at the load of reference.
    rail : RailFriction
        State of reference. Where the law reads k_A and k_S, they hold for the whole table, and
        where `axis.by_fall` is 1, so does A; all else may be another when the table is read.
    lateral : float
        Lateral creepage [-].
    spin : float
        Spin [1/m].
    axis : GridAxis
        Where the curves stand; all zero where there is but one.
    curves : ndarray (curve, cells + 2)
        Coefficients.
    reads_reduction : bool
        Whether the law depends on k_A and k_S.
    error : float
        Greatest difference to the law, in shares of μQ, at points between the nodes and at other
        loads, speeds and states of the rail.
    """

    law: str
    contact: RollingContact
    rail: RailFriction
    lateral: float
    spin: float
    axis: GridAxis
    curves: FloatArray
    reads_reduction: bool
    error: float

    @property
    def is_one_curve(self) -> bool:
        """Whether creepage, load, speed and friction come together in one argument."""
        return bool(self.curves.shape[0] == 1)

    def slope(self, load: float) -> float:
        """Initial slope of linear theory, G a b C11 at a load [N per unit creepage].

        The patch grows with load^(1/3) and keeps its shape.
        """
        own = self.contact
        return own.shear_modulus * own.a * own.b * own.c11 * math.cbrt(load / own.load) ** 2

    def force(self, load: float, rail: RailFriction, speed: float, creepage: float) -> float:
        """Longitudinal creep force, by the look-up that the engine compiles.

        Parameters
        ----------
        load : float
            Normal force Q, > 0 [N].
        rail : RailFriction
            State of the rail; see `rail` above for what of it must be the table's.
        speed : float
            Speed of the train, > 0 [m/s].
        creepage : float
            Longitudinal creepage, finite [-].

        Returns
        -------
        float
            Force [N], with the sign of the creepage.

        Raises
        ------
        RailgripError
            "the load must be positive and finite; got 0 N", likewise the speed; "the longitudinal
            creepage must be finite"; "the table holds for another state of the rail".

        Examples
        --------
        >>> from railgrip.contact.rolling_contact import rolling_contact
        >>> from railgrip.laboratory.tabulate import tabulate
        >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
        >>> rail = RailFriction(0.3, 0.4, 0.2, 1.0, 1.0)
        >>> table = tabulate("fastsim_1982", base, rail)
        >>> round(table.force(80e3, rail, 20.0, -0.001), 1)
        -10391.9
        """
        refuse_not_positive((("load", load, "N"), ("speed", speed, "m/s")))
        if not math.isfinite(creepage):
            refuse("longitudinal creepage", creepage, "", positive=False)
        self._refuse_another(rail)
        size, slope = abs(creepage), self.slope(load)
        if self.is_one_curve:
            limit = load * falling_friction(rail, speed * size)
            chord = chord_by_table(self.curves[0], limit, slope, size)
        else:
            numbers = np.array(self.axis)
            chord = chord_by_grid(self.curves, numbers, rail, load, slope, speed, size)
        return float(chord) * creepage

    def share(self, load: float, rail: RailFriction, speed: float, creepage: float) -> float:
        """Return `force` over the friction force at the slip speed of the centre [-]."""
        slip_speed = speed * resultant(creepage, self.lateral)
        return self.force(load, rail, speed, creepage) / (load * falling_friction(rail, slip_speed))

    def _refuse_another(self, rail: RailFriction) -> None:
        own = self.rail
        fixed = ["adhesion_reduction", "slip_reduction"] if self.reads_reduction else []
        if self.axis.by_fall:
            fixed.append("friction_ratio")
        for name in fixed:
            if getattr(rail, name) != getattr(own, name):
                raise RailgripError(
                    Problem(
                        "",
                        f"the table holds for another state of the rail: {name}",
                        got=f"{getattr(rail, name):g}",
                        allowed=f"{getattr(own, name):g}",
                        cure="tabulate the law for this rail",
                    )
                )
