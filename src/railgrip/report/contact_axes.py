"""What the quantities of a contact are called and shown in, on axes and in tables."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from railgrip.laboratory.law_comparison import LawComparison
from railgrip.report.view import Array


class Axis(NamedTuple):
    """One quantity: shown value = `factor` times the SI value.

    Parameters
    ----------
    name : str
        Attribute of `LawComparison`.
    words, unit : str
        For people.
    factor : float
        Shown unit per SI unit.
    """

    name: str
    words: str
    unit: str
    factor: float

    @property
    def label(self) -> str:
        """Words with the unit behind a comma."""
        return f"{self.words}, {self.unit}"


SLIP_SPEED = Axis("slip_speed", "Slip speed", "m/s", 1.0)
SWEPT = {
    "longitudinal": Axis("longitudinal", "Longitudinal creepage", "%", 100.0),
    "lateral": Axis("lateral", "Lateral creepage", "%", 100.0),
    "spin": Axis("spin", "Spin", "1/m", 1.0),
    "speed": Axis("speed", "Speed of the train", "km/h", 3.6),
    "load": Axis("load", "Wheel load", "kN", 1e-3),
}
"""What a contact can be swept over."""

_COMPONENT = {"longitudinal": "Longitudinal", "lateral": "Lateral", "spin": "Lateral"}


def axis_of(swept: str, over: str = "creepage") -> Axis:
    """Return what a sweep is shown over."""
    return SLIP_SPEED if over == "slip-speed" else SWEPT[swept]


def place(found: LawComparison, swept: str, over: str = "creepage") -> tuple[Array, Axis]:
    """Return where the points of a sweep are shown, in shown units, and their axis."""
    axis = axis_of(swept, over)
    values: Array = axis.factor * getattr(found, axis.name)
    # drawn over slip speed, braking stays to the left
    return (np.copysign(values, getattr(found, swept)) if axis is SLIP_SPEED else values), axis


def component(found: LawComparison, law: str, swept: str) -> Array:
    """Return the force that belongs to what is swept: along, across, or the resultant [N]."""
    forces = found.forces[law]
    if swept in ("lateral", "spin"):
        return forces.lateral
    if swept == "longitudinal":
        return forces.longitudinal
    return np.hypot(forces.longitudinal, forces.lateral)


def shown_force(found: LawComparison, law: str, swept: str, show: str = "adhesion") -> Array:
    """Return the curve of a law in shown units."""
    force = component(found, law, swept)
    return 1e-3 * force if show == "force" else force / found.load


def force_label(swept: str, show: str = "adhesion") -> str:
    """Return what `shown_force` gives, with its unit."""
    which = _COMPONENT.get(swept, "Resultant")
    return f"{which} force T, kN" if show == "force" else f"{which} force over load, adhesion μ"
