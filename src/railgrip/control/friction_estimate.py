"""Estimate of pad friction for brake control, out of straight-line functions.

The estimate is the reference friction times one function each of disc temperature, rubbing speed
and clamp force. Two sets of bounds and weights are laid over it: one for how far the model of the
pad is believed, one for how far the control may follow it.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from railgrip.core.formulas.piecewise_linear import Hinges, piecewise_linear

ON_FUNCTIONS: Final = 0.0
ON_RESULT: Final = 1.0
ON_DEVIATION: Final = 2.0
"""What the weights of the control set act on."""

ALWAYS_ONE: Final = Hinges(1.0)
"""A function that is not used, or a weight of 100 % everywhere."""


class FrictionModel(NamedTuple):
    """What is known of a pad: friction at the reference point and functions that are 1 there.

    Parameters
    ----------
    reference_friction : float
        f0, met at low temperature and moderate speed, > 0 [-].
    temperature, speed, clamp_force : Hinges
        f1 of the disc temperature [°C], f2 of the rubbing speed [m/s], f3 of the clamp force [N];
        `ALWAYS_ONE` for a function that is left out.
    """

    reference_friction: float
    temperature: Hinges = ALWAYS_ONE
    speed: Hinges = ALWAYS_ONE
    clamp_force: Hinges = ALWAYS_ONE


class Influence(NamedTuple):
    """How far one function is followed.

    Parameters
    ----------
    least, greatest : float
        Bounds of the function, least ≤ greatest [-].
    weight : Hinges
        Weight against the function's own argument, 0 … 1 [-].
    """

    least: float = -math.inf
    greatest: float = math.inf
    weight: Hinges = ALWAYS_ONE


class LimitSet(NamedTuple):
    """One set of bounds and weights: of the model (C_M, g_M) or of the control (C_S, g_S).

    Parameters
    ----------
    temperature, speed, clamp_force : Influence
        For each function.
    form : float
        What the weights act on: `ON_FUNCTIONS`, `ON_RESULT` or `ON_DEVIATION`.
    weight : float
        Common weight, multiplied by the three of the functions, ≥ 0 [-].
    """

    temperature: Influence = Influence()
    speed: Influence = Influence()
    clamp_force: Influence = Influence()
    form: float = ON_FUNCTIONS
    weight: float = 1.0


def weighted_function(influence: Influence, function: float, weight: float, common: float) -> float:
    """Return one function inside its bounds, drawn towards 1 by its weight.

    Parameters
    ----------
    influence : Influence
        Bounds.
    function : float
        Value f of the function [-].
    weight, common : float
        Weight of the function here, weight of the set [-].

    Returns
    -------
    float
        1 + g (C(f) − 1); exactly 1 for g = 0.

    Examples
    --------
    >>> weighted_function(Influence(least=0.9), 0.8, 0.5, 1.0)
    0.95
    """
    bounded = max(influence.least, min(influence.greatest, function))
    return 1.0 + weight * common * (bounded - 1.0)


def estimate_friction(
    model: FrictionModel,
    model_set: LimitSet,
    control_set: LimitSet,
    disc_temperature: float,
    rubbing_speed: float,
    clamp_force: float,
) -> float:
    """Estimate the friction that brake control reckons with.

    Choose it to feed clamp forces forward; any subset of the three functions may be used.

    Parameters
    ----------
    model : FrictionModel
        The pad.
    model_set, control_set : LimitSet
        How far the model is believed; how far the control may follow it. The form of the model's
        set is not read: its weights always act on the functions.
    disc_temperature : float
        Of the friction ring [°C].
    rubbing_speed : float
        Of the disc under the pad, ≥ 0 [m/s].
    clamp_force : float
        Of one pad pair, ≥ 0 [N].

    Returns
    -------
    float
        μ_S [-]; exactly f0 where the weights are 0.

    Notes
    -----
    μ_M = f0 Π m_i with m_i = 1 + g_M,i (C_M,i(f_i) − 1). Then, with c_i = C_S,i(m_i), one of

    - on functions: μ_S = f0 Π (1 + g_S,i (c_i − 1));
    - on the result: μ_S = g_SM f0 Π c_i with g_SM = g Π g_S,i;
    - on the deviation: μ_S = f0 + g_ref f0 (Π c_i − 1) with g_ref = g Π g_S,i.

    The source prints the first form as a product of g_i f_i, which would make 0 % a friction of
    nothing; it is read so that 0 % is no compensation. On the result, 100 % is the estimate, and a
    weight may not be 0. Known wrong when the influences depend on each other.

    References
    ----------
    .. [1] Knorr-Bremse, patent application on brake control with an estimated friction coefficient,
       2021, published 2023, claims 1 to 11 and equations (I) to (III).

    Checked by tests/laws/test_friction_estimate.py.

    Examples
    --------
    >>> from railgrip.core.formulas.piecewise_linear import hinges_from_points
    >>> pad = FrictionModel(0.37, hinges_from_points([(150.0, 1.0), (350.0, 0.8)]))
    >>> round(estimate_friction(pad, LimitSet(), LimitSet(), 250.0, 15.0, 25e3), 6)
    0.333
    """
    warm = piecewise_linear(model.temperature, disc_temperature)
    fast = piecewise_linear(model.speed, rubbing_speed)
    clamped = piecewise_linear(model.clamp_force, clamp_force)
    own = model_set.temperature
    warm = weighted_function(
        own, warm, piecewise_linear(own.weight, disc_temperature), model_set.weight
    )
    own = model_set.speed
    fast = weighted_function(
        own, fast, piecewise_linear(own.weight, rubbing_speed), model_set.weight
    )
    own = model_set.clamp_force
    clamped = weighted_function(
        own, clamped, piecewise_linear(own.weight, clamp_force), model_set.weight
    )
    by_temperature = piecewise_linear(control_set.temperature.weight, disc_temperature)
    by_speed = piecewise_linear(control_set.speed.weight, rubbing_speed)
    by_force = piecewise_linear(control_set.clamp_force.weight, clamp_force)
    is_on_functions = control_set.form == ON_FUNCTIONS
    common = control_set.weight
    warm = weighted_function(
        control_set.temperature, warm, by_temperature if is_on_functions else 1.0,
        common if is_on_functions else 1.0,
    )  # fmt: skip
    fast = weighted_function(
        control_set.speed, fast, by_speed if is_on_functions else 1.0,
        common if is_on_functions else 1.0,
    )  # fmt: skip
    clamped = weighted_function(
        control_set.clamp_force, clamped, by_force if is_on_functions else 1.0,
        common if is_on_functions else 1.0,
    )  # fmt: skip
    product = warm * fast * clamped
    together = common * by_temperature * by_speed * by_force
    if control_set.form == ON_RESULT:
        product = together * product
    elif control_set.form == ON_DEVIATION:
        product = 1.0 + together * (product - 1.0)
    return model.reference_friction * product
