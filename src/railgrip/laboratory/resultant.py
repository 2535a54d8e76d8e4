"""A law for creepage along the track, used for combined creepage along the resultant."""

from __future__ import annotations

import math
import types
from functools import cache

from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, CreepForce, RollingContact, RollingLaw
from railgrip.laboratory.curve_of_law import PlantLaw

_LEAST = 1e-30
_law: PlantLaw = polach_2005


def _resultant(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    """Polach's law along the resultant: the pattern that `along_the_resultant` fills anew."""
    area = contact.a * contact.b
    arm = math.sqrt(area)
    along = contact.shear_modulus * area
    turning = along * arm * contact.c23
    x = along * contact.c11 * creepage.longitudinal
    y = along * contact.c22 * creepage.lateral + turning * creepage.spin
    moment = along * area * contact.c33 * creepage.spin - turning * creepage.lateral
    s = max(math.sqrt(creepage.longitudinal**2 + creepage.lateral**2), _LEAST)
    linear = max(math.sqrt(x * x + y * y), _LEAST)
    share = _law(rail, contact.load, linear / s, s * speed, s) / linear
    return CreepForce(share * x, share * y, share * moment)


@cache
def along_the_resultant(law: PlantLaw) -> RollingLaw:
    """Law of rolling contact with combined creepage, made from a law of the plant.

    Choose it to put an angle of attack on any law of the plant. With small spin it is the method
    of Shen, Hedrick and Elkins for their law, and nearly Polach's for his; laws of rolling contact
    of their own, where there are, are better.

    Parameters
    ----------
    law : function
        ``law(rail, load, slope, slip_speed, creepage)``, a plain function.

    Returns
    -------
    function
        ``law(contact, rail, speed, creepage)``, which can be compiled as it stands.

    Notes
    -----
    F_lin and M_lin are the forces and the moment of Kalker's linear theory. The plant's law gives
    the magnitude F for the slope |F_lin|/s, the resultant creepage s = √(s_x² + s_y²) and the slip
    speed s v; the three components of the linear theory are scaled by F/|F_lin|. So the initial
    slopes are Kalker's times the law's own share, and the contact takes power at any creepage.
    Known wrong when the spin is large: a saturated patch turns on, and the moment falls otherwise.

    References
    ----------
    .. [1] Z. Y. Shen, J. K. Hedrick, J. A. Elkins, Vehicle System Dynamics 12 (1983) 79–83,
       doi:10.1080/00423118308968725.

    Checked by tests/laws/test_deformed_curves.py.

    Examples
    --------
    >>> from railgrip.contact.rail_friction import DRY_POLACH_2005
    >>> from railgrip.contact.rolling_contact import rolling_contact
    >>> base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    >>> force = along_the_resultant(polach_2005)(
    ...     base, DRY_POLACH_2005, 20.0, Creepage(0.01, 0.0, 0.0)
    ... )
    >>> round(force.longitudinal, 2)
    35940.38
    """
    scope = {**globals(), "_law": law}
    name = f"{law.__name__}_along_the_resultant"
    made = types.FunctionType(_resultant.__code__, scope, name)
    made.__module__, made.__qualname__, made.__doc__ = __name__, name, _resultant.__doc__
    return made
