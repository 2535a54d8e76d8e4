"""Flash temperature of both surfaces over a patch of which only a part slides."""

from __future__ import annotations

import numpy as np

from railgrip.contact.rolling_contact import Creepage, RollingContact
from railgrip.laboratory.contact_temperature import flux_rises
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.patch_map import PatchMap
from railgrip.laboratory.sliding_contact import SlidingContact


def patch_rises(
    found: PatchMap, contact: RollingContact, speed: float, creepage: Creepage
) -> tuple[FloatArray, FloatArray]:
    """Rises of wheel and rail surface over the temperatures with which they enter.

    Choose it where part of the patch sticks, so that the heat comes late; where all of it slides,
    `surface_temperatures` knows the answer in closed form, slow and locked wheels too.

    Parameters
    ----------
    found : PatchMap
        Fields of the patch, with the friction heat.
    contact, speed, creepage
        With which they were computed.

    Returns
    -------
    wheel, rail : ndarray
        Rises, of the shape of the map [K].

    Raises
    ------
    RailgripError
        From `flux_rises`: "the surface of the wheel is too slow to be taken strip by strip", as
        when it is locked.

    Notes
    -----
    Each strip along the track is heated by traction · slip · speed of its own cells. Steel after
    Ertz and Knothe.

    Checked by tests/unit/laboratory/test_patch_temperature.py: against the closed formula where all
    of the patch slides.

    Examples
    --------
    >>> from railgrip.laboratory.patch_map import patch_map
    >>> from railgrip.contact.rail_friction import RailFriction
    >>> from railgrip.scenario.contact_pair import contact_of_pair
    >>> base, coulomb = contact_of_pair("cone_on_head", 100e3), RailFriction(0.3, 1.0, 0, 1.0, 1.0)
    >>> half = Creepage(0.003, 0.0, 0.0)
    >>> wheel, rail = patch_rises(patch_map("exact", base, coulomb, 20.0, half), base, 20.0, half)
    >>> round(float(wheel.max()), 1)
    22.7
    """
    surfaces = SlidingContact(
        contact.load, contact.a, contact.b, 0.0, abs(speed * (1.0 + creepage.longitudinal)), speed
    )
    wheel, rail = np.zeros((2, *found.x.shape))
    along_rows = found.x.shape[1] > 1 and np.ptp(found.y[0]) == 0.0
    if along_rows:
        # surfaces run against the direction of rolling
        wheel[:, ::-1], rail[:, ::-1] = flux_rises(
            surfaces, -found.x[0, ::-1], found.heat_flux[:, ::-1]
        )
        return wheel, rail
    for strip in range(found.x.shape[1]):
        wheel[:, strip], rail[:, strip] = flux_rises(
            surfaces, -found.x[:, strip], found.heat_flux[:, strip]
        )
    return wheel, rail
