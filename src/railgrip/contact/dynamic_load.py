"""A wheel load that swings, and the contact under it."""

import math

from railgrip.contact.rolling_contact import RollingContact

_TWO_PI = 6.283185307179586
_HALF_PI = 1.5707963267948966


def first_phase(amplitude: float) -> float:
    """Phase at which the wheel touches the rail first; it leaves it at π minus this [rad].

    Parameters
    ----------
    amplitude : float
        Amplitude A of the wheel load over its mean, ≥ 0 [-].

    Returns
    -------
    float
        −arcsin(1/A) where the wheel lifts off (A > 1); else −π/2, where the load is least.
    """
    return -math.asin(1.0 / amplitude) if amplitude > 1.0 else -_HALF_PI


def load_share(amplitude: float, phase: float) -> float:
    """Wheel load over its mean, at a moment of its swing.

    Choose it for a load that swings about what the wheel carries: track irregularities, an
    out-of-round wheel, corrugation. Beyond A = 1 the wheel lifts off.

    Parameters
    ----------
    amplitude : float
        Amplitude A, ≥ 0 [-].
    phase : float
        ωt [rad].

    Returns
    -------
    float
        Q/Q0, ≥ 0, one in the mean over a cycle [-].

    Notes
    -----
    Q/Q0 = max(0, 1 + A sin ωt)/m. For A ≤ 1, m = 1. Beyond, the wheel is off the rail for a part of
    the cycle, and the mean of the numerator over the cycle is
    m = [(π + 2β) + 2A cos β]/(2π), β = arcsin(1/A). Dividing by it keeps the mean: a wheel carries
    its share of the vehicle, however it bounces. A → ∞ is a half-wave of height π.

    References
    ----------
    .. [1] J. Čáp, Teoretický rozbor tečných a interaktivních sil ve styku kolo kolejnice (2000),
       conclusion; it names dynamic changes of the load without a formula.

    Checked by tests/laws/test_deformed_curves.py.

    Examples
    --------
    >>> load_share(0.5, math.pi / 2), round(load_share(2.0, math.pi / 2), 6)
    (1.5, 2.463063)
    """
    mean = 1.0
    if amplitude > 1.0:
        edge = math.asin(1.0 / amplitude)
        mean = (0.5 * _TWO_PI + 2.0 * edge + 2.0 * amplitude * math.cos(edge)) / _TWO_PI
    return max(0.0, 1.0 + amplitude * math.sin(phase)) / mean


def contact_under_load(contact: RollingContact, share: float) -> RollingContact:
    """Return the contact under another load: a, b grow with its cube root, their ratio stays.

    Parameters
    ----------
    contact : RollingContact
        The contact under the mean load.
    share : float
        Load over that load, > 0 [-].

    Returns
    -------
    RollingContact
        Kalker's coefficients depend on a/b only and so stay; the slope grows as share^(2/3).

    Examples
    --------
    >>> base = RollingContact(100e3, 7e-3, 5e-3, 82e9, 0.28, 4.5, 4.1, 1.9, 1.0)
    >>> contact_under_load(base, 8.0)[:3]
    (800000.0, 0.014, 0.01)
    """
    growth = share ** (1.0 / 3.0)
    return RollingContact(
        share * contact.load, growth * contact.a, growth * contact.b,
        contact.shear_modulus, contact.poisson,
        contact.c11, contact.c22, contact.c23, contact.c33,
    )  # fmt: skip
