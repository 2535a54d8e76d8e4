"""Creep forces by the simplified theory: FASTSIM (Kalker 1982)."""

from railgrip.contact.fastsim_grid import CELLS, fastsim_on_grid, flexibilities
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import friction_force
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact


def fastsim_1982(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces by FASTSIM with its parabolic traction bound (Kalker 1982).

    Choose it where creepages and spin act together, and where stick and slip within the patch
    matter (`railgrip.laboratory.fastsim_map`). It is a thousand cheap steps; for longitudinal
    creepage alone `shen_hedrick_elkins_1983` says nearly the same at once.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail; k_A and k_S are not used.
    speed : float
        Speed of the train, > 0 [m/s].
    creepage : Creepage
        Longitudinal and lateral creepage and spin.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages, spin moment [N m].

    Notes
    -----
    See `railgrip.contact.fastsim_grid.fastsim_on_grid`; 50 strips of 50 cells are within 1e-4 of
    μQ of an infinite number, at a spin of 10/m within 6e-4.
    One friction coefficient holds in the whole patch, that of the slip speed of its centre. A
    friction that falls with the slip of each point has several solutions there, between which
    only the history decides; without a memory of it, it is left out.
    The forces have Kalker's slopes. The moment has not: on the base case its slope by lateral
    creepage is 25 %, that by spin 17 % below C23 and C33.
    Known wrong when friction differs within the patch, and in the moment.

    References
    ----------
    .. [1] J. J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle
       System Dynamics 11 (1982) 1–13, doi:10.1080/00423118208968684.

    Checked by tests/reference/fastsim_base_case, 5e-4 of μQ.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> round(fastsim_1982(base, rail, 20.0, Creepage(0.001, 0.0, 0.0)).longitudinal / 30e3, 4)
    0.4077
    """
    limit = friction_force(contact, rail, speed, creepage)
    return fastsim_on_grid(contact, limit, flexibilities(contact), creepage, CELLS, False)


def fastsim_elliptic_1982(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces by FASTSIM with Hertz's own pressure as traction bound.

    Choose it for tractions within the patch, which the paraboloid overdraws by a third at the
    centre; for forces `fastsim_1982` is nearer to the exact theory. With longitudinal creepage
    alone its limit for many cells is Freibauer's formula.

    Parameters
    ----------
    contact, rail, speed, creepage
        As in `fastsim_1982`.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages, spin moment [N m].

    References
    ----------
    .. [1] J. J. Kalker, A fast algorithm for the simplified theory of rolling contact, Vehicle
       System Dynamics 11 (1982) 1–13, doi:10.1080/00423118208968684.

    Checked by tests/reference/fastsim_base_case, 5e-4 of μQ.

    Examples
    --------
    >>> import math
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> force = fastsim_elliptic_1982(base, rail, 20.0, Creepage(0.001, 0.0, 0.0))
    >>> round(force.longitudinal / 30e3, 4)
    0.4428
    """
    limit = friction_force(contact, rail, speed, creepage)
    return fastsim_on_grid(contact, limit, flexibilities(contact), creepage, CELLS, True)
