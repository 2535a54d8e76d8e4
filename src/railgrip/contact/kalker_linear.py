"""Creep forces of Kalker's linear theory, without any bound (Kalker 1967)."""

import math

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact
from railgrip.contact.validity import valid_within


@valid_within(total_share=0.3)
def kalker_linear(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Forces and spin moment proportional to the creepages (Kalker's linear theory).

    Choose it for stability analysis and as the tangent of every other law. The whole patch sticks,
    so no friction bounds the force: at 0.3 μQ it is about a tenth too large, and from there on
    results are flagged.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        Not used: nothing slides.
    speed : float
        Not used.
    creepage : Creepage
        Longitudinal and lateral creepage and spin.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages, spin moment [N m].

    Notes
    -----
    F_x = G ab C11 s_x, F_y = G ab C22 s_y + G (ab)^(3/2) C23 φ,
    M = −G (ab)^(3/2) C23 s_y + G (ab)² C33 φ.
    The power F_x s_x + F_y s_y + M φ is never negative: the coupling by C23 cancels in it.
    Known wrong when slip spreads from the trailing edge, with any force comparable to μQ.

    References
    ----------
    .. [1] J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer 1990,
       table E.3, doi:10.1007/978-94-015-7889-9.

    Checked by tests/laws/test_rolling_laws.py, and by tests/reference/kalker_base_case (1e-6).

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> force = kalker_linear(base, DRY_POLACH_2005, 20.0, Creepage(1e-4, 0.0, 0.1))
    >>> round(force.longitudinal, 2), round(force.lateral, 2), round(force.spin_moment, 3)
    (1452.37, 3720.89, 12.34)
    """
    area = contact.a * contact.b
    root = math.sqrt(area)
    stiffness = contact.shear_modulus * area
    coupling = stiffness * root * contact.c23
    return CreepForce(
        stiffness * contact.c11 * creepage.longitudinal,
        stiffness * contact.c22 * creepage.lateral + coupling * creepage.spin,
        stiffness * area * contact.c33 * creepage.spin - coupling * creepage.lateral,
    )
