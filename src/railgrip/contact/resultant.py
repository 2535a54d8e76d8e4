"""What laws with combined creepages share: resultants, the speed of slip, forces scaled down."""

import math

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact

LEAST_FORCE = 1e-6
"""Forces are scaled by the share of two forces; below this, in N, the share no longer changes."""


def resultant(x: float, y: float) -> float:
    """Length of a vector with two components.

    Examples
    --------
    >>> resultant(3.0, -4.0)
    5.0
    """
    return math.sqrt(x * x + y * y)


def slip_speed_of(speed: float, creepage: Creepage) -> float:
    """Speed at which the centre of the patch would slide as a rigid body [m/s]; spin adds none.

    Examples
    --------
    >>> slip_speed_of(20.0, Creepage(0.03, -0.04, 0.5))
    1.0
    """
    return speed * resultant(creepage.longitudinal, creepage.lateral)


def friction_force(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> float:
    """Greatest force that friction allows, μQ with μ at the slip speed of the centre [N].

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> round(friction_force(wheel, DRY_POLACH_2005, 20.0, Creepage(0.01, 0.0, 0.0)), 1)
    51268.4
    """
    return contact.load * falling_friction(rail, slip_speed_of(speed, creepage))


def size_of(force: CreepForce) -> float:
    """Resultant of longitudinal and lateral force, at least `LEAST_FORCE` [N].

    Examples
    --------
    >>> size_of(CreepForce(3e3, 4e3, 10.0))
    5000.0
    """
    return max(resultant(force.longitudinal, force.lateral), LEAST_FORCE)


def scaled(force: CreepForce, share: float) -> CreepForce:
    """Return both forces and the spin moment times a share.

    Examples
    --------
    >>> scaled(CreepForce(3e3, 4e3, 10.0), 0.5)
    CreepForce(longitudinal=1500.0, lateral=2000.0, spin_moment=5.0)
    """
    return CreepForce(share * force.longitudinal, share * force.lateral, share * force.spin_moment)
