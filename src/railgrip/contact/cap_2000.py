"""Initial slope of the creep curve by Čáp's formulas (2.12a) and (2.12b)."""

from railgrip.contact.input_checks import refuse_not_positive


def cap_2000_slope(load: float, wheel_radius: float, rail_transverse_radius: float) -> float:
    """Slope dT/ds at zero creepage for a cone on a round rail head (Čáp 2000, 2.12a).

    Choose it for a quick estimate with the stiffness K = 20·10¹² N/m³ built in; it stands for
    `stiffness_slope` of Hertz's ellipse of steel.

    Parameters
    ----------
    load : float
        Vertical wheel load Q, > 0 [N].
    wheel_radius : float
        Rolling radius r1x, > 0 [m].
    rail_transverse_radius : float
        Radius of the rail head r2y, > 0 [m].

    Returns
    -------
    float
        Slope [N per unit creepage].

    Raises
    ------
    RailgripError
        "the load must be positive and finite" and likewise for the radii.

    Notes
    -----
    c = 738 r1x Q (0.3 q + 0.7)/(q + 1), q = r1x/r2y (the unit of force drops out).
    The paper prints q = r1x/r1y, which is zero for a cone and gives 25 830 kN for 100 kN, 0.5 m
    and 0.3 m; and its table prints 17 500 kN for that case where the right q gives 16 605 kN. It
    lies above the (8/3) a²bK that it stands for (E = 210 GPa, ν = 0.3): by 5.5 % there, 6.4 % at
    q = 1 and 17 % at q = 6. Known wrong for S1002, whose transverse radius it does not know.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.12a.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(cap_2000_slope(100e3, 0.5, 0.3) / 1e3, 1)
    16605.0
    """
    refuse_not_positive(
        (
            ("load", load, "N"),
            ("wheel radius", wheel_radius, "m"),
            ("radius of the rail head", rail_transverse_radius, "m"),
        )
    )
    ratio = wheel_radius / rail_transverse_radius
    return 738.0 * wheel_radius * load * (0.3 * ratio + 0.7) / (ratio + 1.0)


def cap_2000_simple_slope(load: float, wheel_radius: float) -> float:
    """Slope dT/ds at zero creepage, in round numbers (Čáp 2000, 2.12b).

    Choose it for wheels of about 0.5 m on rail heads of about 0.3 m, which are built in.

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
    c = 333 r1x Q. For 100 kN and 0.5 m: 16 650 kN (the paper prints 16 600).

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       eq. 2.12b.

    Checked by tests/reference/five_slopes, 1e-4.

    Examples
    --------
    >>> round(cap_2000_simple_slope(100e3, 0.5) / 1e3, 1)
    16650.0
    """
    refuse_not_positive((("load", load, "N"), ("wheel radius", wheel_radius, "m")))
    return 333.0 * wheel_radius * load
