"""What the exact solver refuses, in words."""

from __future__ import annotations

import math

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, RollingContact
from railgrip.core.errors import Problem, RailgripError

LEAST_CELLS, MOST_CELLS = 8, 512


def refuse_bad_input(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    grid: tuple[int, int],
) -> None:
    """Raise one RailgripError with a line for everything that has no solution.

    Raises
    ------
    RailgripError
        Each line names the quantity, its value and its range.
    """
    wrong = [
        *(
            Problem(f"contact.{name}", "must be positive and finite", got=f"{value} {unit}")
            for name, value, unit in (
                ("load", contact.load, "N"),
                ("a", contact.a, "m"),
                ("b", contact.b, "m"),
                ("shear_modulus", contact.shear_modulus, "Pa"),
            )
            if not 0.0 < value < math.inf
        ),
        *(
            Problem(f"creepage.{name}", "must be a finite number", got=f"{value}")
            for name, value in creepage._asdict().items()
            if not math.isfinite(value)
        ),
        *_bad_range("contact.poisson", contact.poisson, 0.0, 0.5),
        *_bad_range("rail.static_friction", rail.static_friction, 0.0, 10.0),
        *_bad_range("rail.friction_ratio", rail.friction_ratio, 0.0, 1.0),
        *_bad_range("rail.friction_decay", rail.friction_decay, 0.0, math.inf),
        *_bad_grid(grid),
    ]
    if falls(rail) and not 0.0 < speed < math.inf:
        wrong.append(
            Problem(
                "speed",
                "must be positive and finite where friction falls with the slip speed",
                got=f"{speed} m/s",
                cure="the speed of the train, or a rail with friction_ratio = 1",
            )
        )
    if wrong:
        raise RailgripError(wrong)


def falls(rail: RailFriction) -> bool:
    """Return whether the friction depends on the slip speed."""
    return rail.friction_ratio != 1.0 and rail.friction_decay != 0.0


def _bad_range(name: str, value: float, low: float, high: float) -> list[Problem]:
    if low <= value <= high and math.isfinite(value):
        return []
    return [Problem(name, "out of range", got=f"{value}", allowed=f"{low:g} … {high:g}")]


def _bad_grid(grid: tuple[int, int]) -> list[Problem]:
    counts = tuple(grid) if isinstance(grid, (tuple, list)) else ()
    whole = len(counts) == 2 and all(isinstance(each, int) for each in counts)
    if whole and all(LEAST_CELLS <= each <= MOST_CELLS for each in counts):
        return []
    allowed = f"two whole numbers (along, across), {LEAST_CELLS} … {MOST_CELLS}"
    return [Problem("grid", "no such grid", got=f"{grid}", allowed=allowed, cure="grid=(48, 48)")]
