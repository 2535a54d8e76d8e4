"""Exponential, arctangent and x^0.8 as polynomials: branch-free, and the same bits everywhere.

`math.exp`, `math.atan` and `**` are calls into the C library. A call stops the compiler from
working on several lanes at once, and two C libraries may differ in the last bit. The functions here
use only +, −, ×, ÷, square root, minimum and selection, which IEEE 754 fixes to the last bit.

The coefficients are minimax fits (Remez exchange, 50 digits) over the intervals named beside them.
"""

import math

_HALF_PI = 1.5707963267948966
_QUARTER_PI = 0.7853981633974483
_TAN_EIGHTH_PI = 0.41421356237309503
_TAN_THREE_EIGHTHS_PI = 2.414213562373095


def exp_decay(x: float) -> float:
    """e^(−x) for a decay that starts at x = 0.

    Choose it inside laws that the engine compiles; elsewhere `math.exp` is as good.

    Parameters
    ----------
    x : float
        Exponent, ≥ 0 [-]. Beyond 64 it counts as 64, where e^(−x) is 1.6e-28.

    Returns
    -------
    float
        e^(−x), exactly 1 at x = 0, relative error below 1e-13.

    Notes
    -----
    e^(−x) = (e^(−x/256))^256: a polynomial on [−1/4, 0] (error 8e-17), squared eight times; the
    squarings multiply the rounding error by 256.
    Known wrong when x < 0: the polynomial leaves its interval below about −2.

    Checked by tests/unit/core/test_elementary.py, 1e-13 against `math.exp`.

    Examples
    --------
    >>> round(exp_decay(1.0), 12)
    0.367879441171
    """
    y = min(x, 64.0) * -0.00390625
    q = 2.1918834190857208e-05
    q = q * y + 0.00019710417464367344
    q = q * y + 0.0013885660607764621
    q = q * y + 0.008333286934098849
    q = q * y + 0.04166666277240314
    q = q * y + 0.16666666648564565
    q = q * y + 0.4999999999959281
    q = q * y + 0.9999999999999687
    power = q * y + 1.0
    power = power * power
    power = power * power
    power = power * power
    power = power * power
    power = power * power
    power = power * power
    power = power * power
    return power * power


def arctangent(x: float) -> float:
    """Angle whose tangent is x.

    Choose it inside laws that the engine compiles; elsewhere `math.atan` is as good.

    Parameters
    ----------
    x : float
        Tangent, any sign and size [-].

    Returns
    -------
    float
        Angle between −π/2 and π/2 [rad], absolute error below 5e-16, odd in x to the last bit.

    Notes
    -----
    For t = |x|: arctan t = π/4 + arctan((t − 1)/(t + 1)) = π/2 + arctan(−1/t). The first is used
    from tan(π/8), the second from tan(3π/8) on, so that one division brings every argument into
    ±tan(π/8), where an odd polynomial of degree 21 is exact to 8e-18.

    Checked by tests/unit/core/test_elementary.py, 5e-16 against `math.atan`.

    Examples
    --------
    >>> round(4.0 * arctangent(1.0), 12)
    3.14159265359
    """
    t = abs(x)
    is_large = t > _TAN_THREE_EIGHTHS_PI
    is_small = t <= _TAN_EIGHTH_PI
    numerator = -1.0 if is_large else (t if is_small else t - 1.0)
    denominator = t if is_large else (1.0 if is_small else t + 1.0)
    offset = _HALF_PI if is_large else (0.0 if is_small else _QUARTER_PI)
    r = numerator / denominator
    z = r * r
    q = 0.020738198689577974
    q = q * z - 0.04313091002047069
    q = q * z + 0.056752306282322834
    q = q * z - 0.0663749940172233
    q = q * z + 0.07689607784292114
    q = q * z - 0.09090745930960509
    q = q * z + 0.11111104880739259
    q = q * z - 0.14285714145413328
    q = q * z + 0.1999999999837736
    q = q * z - 0.33333333333326437
    angle = offset + (r + r * z * q)
    return -angle if x < 0.0 else angle


def power_0_8(x: float) -> float:
    """x^0.8, the exponent of turbulent heat transfer.

    Parameters
    ----------
    x : float
        Speed, 0 … 125 [m/s].

    Returns
    -------
    float
        x^0.8, zero at zero and below; relative error under 5e-7 from 1e-4 m/s to 125 m/s.

    Notes
    -----
    With s = x^(1/16) by four square roots, x^0.8 = s¹² · s^0.8, and s^0.8 is smooth enough for a
    polynomial of degree 6 on [0.56, 1.36].
    Known wrong when x > 125: the error is 1e-5 at 250.

    Checked by tests/unit/core/test_elementary.py, 5e-7 against `**`.

    Examples
    --------
    >>> round(power_0_8(32.0), 4)
    16.0
    """
    s = math.sqrt(math.sqrt(math.sqrt(math.sqrt(max(x, 0.0)))))
    q = -0.01325518903169277
    q = q * s + 0.09205578953613527
    q = q * s - 0.27816664948104153
    q = q * s + 0.4891411728043455
    q = q * s - 0.6001933897821234
    q = q * s + 1.264883000529269
    q = q * s + 0.04553553358472543
    s4 = (s * s) * (s * s)
    return s4 * s4 * s4 * q


def power_2_3(x: float) -> float:
    """x^(2/3): how the size of a contact patch grows with the load.

    Parameters
    ----------
    x : float
        Load over the load of reference, 0 … 4 [-].

    Returns
    -------
    float
        x^(2/3), zero at zero and below; relative error under 2e-6 from 1/16 to 4. Below 1/16 it
        tends to zero too slowly: 3e-4 too large at 1/100.

    Notes
    -----
    With s = x^(1/4) by two square roots, x^(2/3) = s² · s^(2/3), and a polynomial of degree 6 for
    s^(2/3) on [0.5, 1.42].

    Checked by tests/unit/core/test_elementary.py, 2e-6 against `**`.

    Examples
    --------
    >>> round(power_2_3(1.331), 5)
    1.21
    """
    root = math.sqrt(max(x, 0.0))
    s = math.sqrt(root)
    q = -0.026345146098826083
    q = q * s + 0.1807028709328891
    q = q * s - 0.5343896273942325
    q = q * s + 0.906529200067061
    q = q * s - 1.036379783430089
    q = q * s + 1.4119593668546369
    q = q * s + 0.09792465378859443
    return root * q
