"""Equivalent conicity of a wheelset: profiles of wheel and rail together, by amplitude."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from railgrip.contact.s1002 import s1002
from railgrip.core.errors import Problem, RailgripError
from railgrip.laboratory.rail_head import head_60e1

Array = NDArray[np.float64]
Profile = Callable[[Array], Array]

HALF_DISTANCE = 0.750
"""Half the distance of the running circles, for a distance of 1.36 m between the flange backs."""

_REACH, _CELL = (-0.029, 0.035), 1e-5
_ROLL_PASSES = 12
_MOST_AMPLITUDE = 0.010
_PHASES = 24


def s1002_heights(position: Array) -> Array:
    """Height z of the profile S1002 at places y.

    Parameters
    ----------
    position : ndarray
        y from the running circle, positive towards the field side [m].

    Returns
    -------
    ndarray
        z, positive away from the axle [m].

    Raises
    ------
    RailgripError
        "the position is off the profile S1002".

    Examples
    --------
    >>> np.round(1e3 * s1002_heights(np.array([-0.008, 0.008])), 3).tolist()
    [0.384, -0.183]
    """
    return np.array([s1002(float(place)).height for place in position])


def rolling_radius_difference(
    shifts: Array,
    wheel: Profile = s1002_heights,
    rail: Profile = head_60e1,
    half_distance: float = HALF_DISTANCE,
) -> Array:
    """How much the right wheel rolls on a larger radius than the left, by the wheelset's shift.

    Choose it to see where the contact jumps; the conicity is an average over it.

    Parameters
    ----------
    shifts : ndarray (shift)
        Shift of the wheelset to the right, |shift| ≤ 10 mm [m].
    wheel : callable
        Height z of both wheels' profile by place y, as `s1002_heights`.
    rail : callable
        Depth of both rails by the distance from the middle of the track, as `head_60e1`.
    half_distance : float
        From the middle of the wheelset to the running circle [m].

    Returns
    -------
    ndarray (shift)
        Δr, odd in the shift [m].

    Raises
    ------
    RailgripError
        "the shift of the wheelset is out of range".

    Notes
    -----
    Rigid profiles, no yaw: each wheel touches where its gap over the rail is least; the wheelset
    rolls until both gaps are closed. Wheel places −29 … 35 mm are searched, without the flange.
    Known wrong where the flange touches.

    Checked by tests/unit/laboratory/test_equivalent_conicity.py: cones, and arcs on arcs.

    Examples
    --------
    >>> float(np.round(1e3 * rolling_radius_difference(np.array([0.003])), 2)[0])
    0.93
    """
    if not (np.abs(shifts) <= _MOST_AMPLITUDE).all():
        raise RailgripError(
            Problem(
                "",
                "the shift of the wheelset is out of range",
                got=f"{1e3 * float(np.max(np.abs(shifts))):g} mm",
                allowed=f"up to {1e3 * _MOST_AMPLITUDE:g} mm",
            )
        )
    places = np.arange(_REACH[0], _REACH[1], _CELL)
    heights = wheel(places)

    def touch(shift: float, roll: float) -> tuple[float, float]:
        """Least gap of the right wheel, and its height there."""
        across = places + half_distance + shift
        gap = rail(across) - heights - roll * across
        at = int(np.nanargmin(gap))
        return float(gap[at]), float(heights[at])

    found = []
    for shift in shifts:
        roll = 0.0
        for _ in range(_ROLL_PASSES):
            (right, outer), (left, inner) = touch(shift, roll), touch(-shift, -roll)
            roll += 0.5 * (right - left) / half_distance
        found.append(outer - inner)
    return np.array(found)


def equivalent_conicity(
    amplitude: float,
    wheel: Profile = s1002_heights,
    rail: Profile = head_60e1,
    half_distance: float = HALF_DISTANCE,
) -> float:
    """Conicity of the cone on which a wheelset would swing as long as on its profiles.

    Choose it for running dynamics; the spin of a contact needs the local slope of `s1002` instead.
    Without further words: new S1002 on new 60E1 rails at 1:40, gauge 1435 mm.

    Parameters
    ----------
    amplitude : float
        Amplitude of the lateral swing, 0 … 10 mm; 3 mm is usual [m].
    wheel, rail, half_distance
        As in `rolling_radius_difference`.

    Returns
    -------
    float
        Equivalent conicity tan γ_e [-].

    Raises
    ------
    RailgripError
        "the amplitude must be positive"; "the shift of the wheelset is out of range".

    Notes
    -----
    Harmonic linearisation: λ = 1/(2π ŷ) ∫ Δr(ŷ sin φ) sin φ dφ over one swing; a cone gives
    Δr = 2λy. Integrating the equation of the swing instead gives the same for small amplitudes and
    differs where Δr is far from straight.

    References
    ----------
    .. [1] EN 15302 names the quantity and allows several methods; this is one of them, not checked
       against its tables.

    Checked by tests/unit/laboratory/test_equivalent_conicity.py: cones, and arcs on arcs.

    Examples
    --------
    >>> round(equivalent_conicity(0.003), 2)
    0.17
    """
    if not amplitude > 0.0:
        got = f"{1e3 * amplitude:g} mm"
        raise RailgripError(Problem("", "the amplitude must be positive", got=got))
    sine = np.sin((np.arange(_PHASES) + 0.5) * 0.5 * math.pi / _PHASES)
    difference = rolling_radius_difference(amplitude * sine, wheel, rail, half_distance)
    return float(np.mean(difference * sine) / amplitude)
