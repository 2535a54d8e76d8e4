"""Initial slope of the creep curve by Carter's formula for railway wheels (2.13)."""

import math

from railgrip.contact.input_checks import refuse_not_positive


def carter_1926_slope(load: float, wheel_radius: float) -> float:
    """Slope dT/ds at zero creepage of a wheel on a flat rail (Carter 1926, as Čáp quotes it).

    Choose it to compare with old work: it takes wheel and rail for cylinders with a fixed width of
    contact and lies a third below the others.

    Parameters
    ----------
    load : float
        Vertical wheel load Q, > 0 [N].
    wheel_radius : float
        Rolling radius r1x, > 0 [m].

    Returns
    -------
    float
        Slope [N per unit creepage].

    Raises
    ------
    RailgripError
        "the load must be positive and finite" and likewise for the radius.

    Notes
    -----
    c = 1460 √(r1x Q) with kN and m, so 1460·√1000 √(r1x Q) with N and m. The 2 Q r1x/a of
    `carter_1926` on the rectangle of (1.13) grows likewise with √(r1x Q), but is 1.84 times as much
    on a usual width of 20 mm; it would be this on 5.9 mm.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.13.
    .. [2] F. W. Carter, On the action of a locomotive driving wheel, Proc. R. Soc. A 112 (1926)
       151–157, doi:10.1098/rspa.1926.0100.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(carter_1926_slope(100e3, 0.5) / 1e3, 2)
    10323.76
    """
    refuse_not_positive((("load", load, "N"), ("wheel radius", wheel_radius, "m")))
    return 1460.0 * math.sqrt(1000.0 * wheel_radius * load)
