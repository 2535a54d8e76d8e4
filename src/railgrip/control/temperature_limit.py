"""How hot wheel and rail may get at present: constant, a course in time, or by kind of braking."""

from __future__ import annotations

from railgrip.control.contract import FloatArray
from railgrip.control.temperature_parameters import COURSE, COURSE_RAMPS, EMERGENCY_FACTOR

N_POINTS = 3


def limit_factor(parameters: FloatArray, time: float, emergency: float) -> float:
    """Return the factor on both admissible rises.

    Parameters
    ----------
    parameters : ndarray
        As in the controller contract.
    time : float
        Since the controller began, [s].
    emergency : float
        1 in an emergency brake application.

    Examples
    --------
    A limit that is halved after 5 s, by hand or by plan:

    >>> from railgrip.control.temperature_parameters import TemperatureParameters
    >>> halved = TemperatureParameters(course_1=5.0, factor_1=0.5)
    >>> limit_factor(halved, 4.0, 0.0), limit_factor(halved, 6.0, 0.0)
    (1.0, 0.5)
    """
    factor = 1.0
    before = 0.0
    found = 1.0
    for i in range(N_POINTS):
        at = parameters[COURSE + 2 * i]
        value = parameters[COURSE + 2 * i + 1]
        if time >= at:
            factor = value
        elif time >= before and parameters[COURSE_RAMPS] > 0.0 and at < 1.0e8:
            factor = found + (value - found) * (time - before) / max(at - before, 1.0e-9)
        before = at
        found = value
    if emergency > 0.0:
        factor *= parameters[EMERGENCY_FACTOR]
    return factor
