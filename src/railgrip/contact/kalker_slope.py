"""Initial slope of the creep curve by the fits of Kalker's theory that Čáp quotes (2.14)."""

import math

from railgrip.contact.input_checks import refuse_not_positive


def kalker_1967_slope(a: float, b: float, young: float) -> float:
    """Slope dT/ds at zero creepage by the semi-axes of the ellipse (Čáp 2000, 2.14a).

    Choose it to compare; the full theory is `railgrip.contact.kalker_1990.kalker_slope`.

    Parameters
    ----------
    a, b : float
        Semi-axes along and across the track, > 0 [m].
    young : float
        Young's modulus E, > 0 [Pa].

    Returns
    -------
    float
        Slope [N per unit creepage].

    Raises
    ------
    RailgripError
        "the semi-axis a must be positive and finite" and likewise for b and E.

    Notes
    -----
    c = E a b (1.25 + 0.4 a/b). For 100 kN on a cone of 0.5 m, a head of 0.3 m, E = 210 GPa and
    ν = 0.3 it gives 15 062.8 kN; the paper prints 15 500. At a/b = 0.5 … 2 and ν = 0.25 … 0.3 it
    is within 1.2 % of G a b C11 of Kalker's table.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.14a, after
    .. [2] J. J. Kalker, On the rolling contact of two elastic bodies in the presence of dry
       friction, thesis, Delft 1967.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(kalker_1967_slope(7.3e-3, 5.2e-3, 210e9) / 1e3, 1)
    14440.9
    """
    refuse_not_positive(
        (("semi-axis a", a, "m"), ("semi-axis b", b, "m"), ("Young's modulus", young, "Pa"))
    )
    return young * a * b * (1.25 + 0.4 * a / b)


def kalker_1967_simple_slope(load: float) -> float:
    """Slope dT/ds at zero creepage by the load alone (Čáp 2000, 2.14b).

    Choose it for a wheel of about 0.5 m, of which it knows nothing else.

    Parameters
    ----------
    load : float
        Vertical wheel load Q, > 0 [N].

    Returns
    -------
    float
        Slope [N per unit creepage].

    Raises
    ------
    RailgripError
        "the load must be positive and finite".

    Notes
    -----
    c = 754 Q^(2/3) with kN, so 7540 Q^(2/3) with N. For 100 kN: 16 244.4 kN (the paper prints
    16 400).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.14b.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(kalker_1967_simple_slope(100e3) / 1e3, 2)
    16244.44
    """
    refuse_not_positive((("load", load, "N"),))
    return 7540.0 * math.cbrt(load * load)
