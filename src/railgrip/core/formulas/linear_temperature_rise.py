"""The linear temperature rise of the temperature-controlled slide protection (EP 2 231 448)."""

import math


def linear_rise(factor: float, power: float, area: float, contact_time: float) -> float:
    """Rise of a surface point at the end of its contact, dT = k_T · P · t/A.

    Choose it to follow the source to the letter; `railgrip.core.formulas.flash_temperature` has the
    physical rise.

    Parameters
    ----------
    factor : float
        Factor of proportionality k_T [K m²/J].
    power : float
        Friction power of the contact, ≥ 0 [W].
    area : float
        Length times width of the patch, > 0 [m²].
    contact_time : float
        Length over the speed of the surface: of the tread for the wheel, of the train for the
        rail [s].

    Returns
    -------
    float
        Rise [K].

    Notes
    -----
    One place of the source prints P/(A · t); its formulas f1 and f2 follow from the product.
    Known wrong when the speed is not the one for which k_T was chosen: the true rise grows with
    √t, so that a constant k_T overstates it at lower speeds and understates it at higher ones.

    References
    ----------
    .. [1] T. Rasel, Knorr-Bremse, EP 2 231 448 (ES 2 487 512 T3), equations 1, f1, f2.

    Checked by tests/unit/core/test_linear_temperature_rise.py.

    Examples
    --------
    >>> factor = linear_factor(0.5, 13290.0, 3.92e-4)
    >>> round(linear_rise(factor, 30e3, 11.76e-3 * 21.08e-3, 3.92e-4), 2)
    101.72
    """
    return factor * power * contact_time / area


def linear_factor(share: float, surface_effusivity: float, contact_time: float) -> float:
    """Return the k_T that gives the physical rise for one contact time.

    Parameters
    ----------
    share : float
        Share of the heat that enters this body, 0 … 1 [-].
    surface_effusivity : float
        β = √(λρc), > 0 [W√s/(m²K)].
    contact_time : float
        > 0 [s].

    Returns
    -------
    float
        k_T = 2 share/(β √(π t)) [K m²/J].

    Notes
    -----
    A half-space under the constant heat flux q rises by 2 q √(t/π)/β; with q = share · P/A that is
    k_T P t/A. k_T falls with 1/√t, so the power that a permitted rise allows grows with √v and not
    with v as f1 and f2 say.

    Checked by tests/unit/core/test_linear_temperature_rise.py.

    Examples
    --------
    >>> round(linear_factor(0.5, 13290.0, 3.92e-4) * 1e3, 5)
    2.14416
    """
    return 2.0 * share / (surface_effusivity * math.sqrt(math.pi * contact_time))
