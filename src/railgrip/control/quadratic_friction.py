"""Two quadratic friction laws that the source of the estimator cites as baselines."""

from __future__ import annotations

from typing import NamedTuple


class QuadraticFriction(NamedTuple):
    """Coefficients of a friction that is a sum of parabolas.

    Parameters
    ----------
    constant : float
        a0 [-].
    speed, speed_squared : float
        a1 [s/m], a2 [s²/m²].
    temperature, temperature_squared : float
        b1 [1/K], b2 [1/K²].
    force, force_squared : float
        c1 [1/N], c2 [1/N²].
    """

    constant: float
    speed: float = 0.0
    speed_squared: float = 0.0
    temperature: float = 0.0
    temperature_squared: float = 0.0
    force: float = 0.0
    force_squared: float = 0.0


def quadratic_friction(
    params: QuadraticFriction, disc_temperature: float, rubbing_speed: float, clamp_force: float
) -> float:
    """Return pad friction as a sum of parabolas.

    Choose it as a baseline only: seven coefficients, and no bound outside the measured range.

    Parameters
    ----------
    params : QuadraticFriction
        Coefficients.
    disc_temperature : float
        [°C].
    rubbing_speed : float
        [m/s].
    clamp_force : float
        [N].

    Returns
    -------
    float
        μ = a0 + a1 v + a2 v² + b1 T + b2 T² + c1 F + c2 F² [-].

    Notes
    -----
    Known wrong beyond the measurements it was fitted to: a parabola turns round.

    Examples
    --------
    >>> round(quadratic_friction(QuadraticFriction(0.40, speed=-1e-3), 100.0, 30.0, 25e3), 6)
    0.37
    """
    v, temperature, force = rubbing_speed, disc_temperature, clamp_force
    return (
        params.constant
        + (params.speed + params.speed_squared * v) * v
        + (params.temperature + params.temperature_squared * temperature) * temperature
        + (params.force + params.force_squared * force) * force
    )


class LastInputs(NamedTuple):
    """What the second law remembers: temperature [°C], speed [m/s], force [N] of the step before.

    Parameters
    ----------
    disc_temperature, rubbing_speed, clamp_force : float
        As they were one step ago.
    """

    disc_temperature: float
    rubbing_speed: float
    clamp_force: float


def lagged_quadratic_friction(params: QuadraticFriction, before: LastInputs) -> float:
    """Return the same sum of parabolas from the values of the step before.

    Choose it where the friction has to be known before this step's values are measured.

    Parameters
    ----------
    params : QuadraticFriction
        Coefficients.
    before : LastInputs
        Values of step i − 1.

    Returns
    -------
    float
        μ_i = a0 + a1 v_(i−1) + … + c2 F²_(i−1) [-].

    Examples
    --------
    >>> pad = QuadraticFriction(0.40, speed=-1e-3)
    >>> round(lagged_quadratic_friction(pad, LastInputs(100.0, 30.0, 25e3)), 6)
    0.37
    """
    return quadratic_friction(
        params, before.disc_temperature, before.rubbing_speed, before.clamp_force
    )
