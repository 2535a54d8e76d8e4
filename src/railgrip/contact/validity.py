"""How far a law of rolling contact may be trusted: declared by the law, flagged in results."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.resultant import LEAST_FORCE, friction_force, resultant
from railgrip.contact.rolling_contact import Creepage, RollingContact

Law = TypeVar("Law", bound=Callable[..., Any])
_DECLARED = "valid_within"


class Validity(NamedTuple):
    """Greatest inputs for which a law means something; beyond, results are flagged, not refused.

    Three of the four limits are forces that Kalker's linear theory would give, over the friction
    force μQ: that measure is the same for a small and a large wheel, dry and wet.

    Parameters
    ----------
    total_share : float
        By all creepages together [-].
    lateral_share : float
        By lateral creepage alone, G a b C22 |s_y|/(μQ) [-].
    spin_share : float
        By spin alone, G (ab)^(3/2) C23 |φ|/(μQ) [-].
    creepage : float
        Greatest resultant of longitudinal and lateral creepage [-]; a wheel locked is at 1.

    Examples
    --------
    >>> Validity(total_share=0.3).creepage
    1.0
    """

    total_share: float = math.inf
    lateral_share: float = math.inf
    spin_share: float = math.inf
    creepage: float = 1.0


def valid_within(
    total_share: float = math.inf,
    lateral_share: float = math.inf,
    spin_share: float = math.inf,
    creepage: float = 1.0,
) -> Callable[[Law], Law]:
    """Declare a law's validity, as a decorator; the law itself stays the plain function it is.

    Examples
    --------
    >>> @valid_within(spin_share=0.0)
    ... def my_law(contact, rail, speed, creepage):
    ...     return contact.load
    >>> validity_of(my_law).spin_share
    0.0
    """

    def declare(law: Law) -> Law:
        setattr(law, _DECLARED, Validity(total_share, lateral_share, spin_share, creepage))
        return law

    return declare


def validity_of(law: Callable[..., Any]) -> Validity:
    """Return what a law declares; one that declares nothing is trusted up to a locked wheel.

    Examples
    --------
    >>> validity_of(max)
    Validity(total_share=inf, lateral_share=inf, spin_share=inf, creepage=1.0)
    """
    declared: Validity = getattr(law, _DECLARED, Validity())
    return declared


def is_within(
    validity: Validity,
    contact: RollingContact,
    rail: RailFriction,
    speed: float,
    creepage: Creepage,
) -> bool:
    """Whether creepages are within what a law declares.

    Examples
    --------
    >>> wheel = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.8, 1.0)
    >>> rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
    >>> [is_within(Validity(0.3), wheel, rail, 20.0, Creepage(s, 0.0, 0.0)) for s in (5e-4, 1e-3)]
    [True, False]
    """
    limit = max(friction_force(contact, rail, speed, creepage), LEAST_FORCE)
    area = contact.a * contact.b
    stiffness = contact.shear_modulus * area / limit
    along = stiffness * contact.c11 * creepage.longitudinal
    across = stiffness * contact.c22 * creepage.lateral
    by_spin = stiffness * math.sqrt(area) * contact.c23 * creepage.spin
    return (
        resultant(creepage.longitudinal, creepage.lateral) <= validity.creepage
        and resultant(along, across + by_spin) <= validity.total_share
        and abs(across) <= validity.lateral_share
        and abs(by_spin) <= validity.spin_share
    )
