"""FASTSIM with flexibility that grows with slip (Spiryagin, Polach and Cole 2013)."""

import math
from typing import NamedTuple

from railgrip.contact.fastsim_grid import CELLS, Flexibilities, fastsim_on_grid, flexibilities
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import LEAST_FORCE, friction_force, resultant
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact


class SlopeReduction(NamedTuple):
    """How an interfacial layer softens the contact: k falls from k0 to k0 α∞ as slip spreads.

    Parameters
    ----------
    initial : float
        Initial slope over Kalker's, k0, 0 < k0 ≤ 1 [-].
    final_share : float
        Share of it that is left at very great slip, α∞, 0 … 1 [-].
    decay : float
        How quickly it falls with the gradient of the traction, β, ≥ 0 [-].
    """

    initial: float
    final_share: float
    decay: float


EUROSPRINTER_2013 = SlopeReduction(0.54, 0.02, 0.64)
"""Siemens locomotive Eurosprinter 127 001, from Spiryagin, Polach and Cole 2013 as CONTACT's user
guide quotes it; the guide's own example file has β = 0.62."""

EUROSPRINTER_RAIL_2013 = RailFriction(0.36, 0.38, 0.70, 1.0, 1.0)
"""Friction of the same measurements, same source; k_A and k_S are not used by FASTSIM."""


def softening(
    contact: RollingContact, limit: float, creepage: Creepage, reduction: SlopeReduction
) -> float:
    """Factor k that divides the flexibilities [-].

    Notes
    -----
    k = k0 (α∞ + (1 − α∞)/(1 + β ε)), ε = k0 G π ab C11 s/(4 μQ), s = √(s_x² + s_yC²), where s_yC
    is s_y + φ a or s_y, whichever is greater in size.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> softening(wheel, 30e3, Creepage(0.0, 0.0, 0.0), EUROSPRINTER_2013)
    0.54
    >>> round(softening(wheel, 30e3, Creepage(0.01, 0.0, 0.0), EUROSPRINTER_2013), 4)
    0.2548
    """
    with_spin = creepage.lateral + creepage.spin * contact.a
    across = max(abs(creepage.lateral), abs(with_spin))
    total = resultant(creepage.longitudinal, across)
    slope = contact.shear_modulus * contact.a * contact.b * contact.c11
    gradient = 0.25 * math.pi * reduction.initial * slope * total / max(limit, LEAST_FORCE)
    falling = (1.0 - reduction.final_share) / (1.0 + reduction.decay * gradient)
    return reduction.initial * (reduction.final_share + falling)


def softened(
    contact: RollingContact, limit: float, creepage: Creepage, reduction: SlopeReduction
) -> Flexibilities:
    """Kalker's flexibilities, each divided by `softening`.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> still = softened(wheel, 30e3, Creepage(0.0, 0.0, 0.0), EUROSPRINTER_2013)
    >>> round(flexibilities(wheel).spin / still.spin, 6)
    0.54
    """
    softer = 1.0 / softening(contact, limit, creepage, reduction)
    stiff = flexibilities(contact)
    return Flexibilities(softer * stiff.longitudinal, softer * stiff.lateral, softer * stiff.spin)


def modified_fastsim(
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
    reduction: SlopeReduction,
) -> CreepForce:
    """Creep forces by modified FASTSIM with a slope reduction of one's own.

    Parameters
    ----------
    contact, rail, speed, creepage
        As in `modified_fastsim_2013`.
    reduction : SlopeReduction
        k0, α∞ and β.

    Returns
    -------
    CreepForce
        Forces [N] with the sign of the creepages, spin moment [N m].

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> small, none = Creepage(1e-6, 0.0, 0.0), SlopeReduction(1.0, 1.0, 0.0)
    >>> force = modified_fastsim(base, EUROSPRINTER_RAIL_2013, 10.0, small, none)
    >>> round(force.longitudinal, 2)
    14.52
    """
    limit = friction_force(contact, rail, speed, creepage)
    flexible = softened(contact, limit, creepage, reduction)
    return fastsim_on_grid(contact, limit, flexible, creepage, CELLS, False)


def modified_fastsim_2013(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Creep forces of a locomotive on wet rail, by modified FASTSIM (Spiryagin et al. 2013).

    Choose it for traction and braking at the adhesion limit with spin: it has the flatter slope of
    a contaminated rail, the late maximum and, with a falling friction, the branch behind it. It is
    tuned to one locomotive; for other parameters see `modified_fastsim`.

    Parameters
    ----------
    contact : RollingContact
        The contact.
    rail : RailFriction
        State of the rail, e.g. `EUROSPRINTER_RAIL_2013`; k_A and k_S are not used.
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
    FASTSIM with a parabolic bound and flexibilities L/k, k from `softening` with
    `EUROSPRINTER_2013`; the friction is that of the slip speed of the centre, without spin. The
    initial slope is k0 of Kalker's.
    Known wrong when the locomotive, the rail or its layer is another; k was fitted.

    References
    ----------
    .. [1] M. Spiryagin, O. Polach, C. Cole, Creep force modelling for rail traction vehicles based
       on the Fastsim algorithm, Vehicle System Dynamics 51 (2013) 1765–1783,
       doi:10.1080/00423114.2013.826370; read in CONTACT's user guide and program, not at hand.

    Checked by tests/reference/fastsim_base_case and tests/laws/test_rolling_laws.py.

    Examples
    --------
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> force = modified_fastsim_2013(base, EUROSPRINTER_RAIL_2013, 10.0, Creepage(0.05, 0.0, 0.0))
    >>> round(force.longitudinal / 100e3, 3)
    0.279
    """
    return modified_fastsim(contact, rail, speed, creepage, EUROSPRINTER_2013)
