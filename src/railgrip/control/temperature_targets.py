"""From admissible rises to a slip and a force: the relations f1 to f7 and f9 of the source.

Signs: forces, slip and accelerations are driving positive, speeds and powers magnitudes.
"""

from __future__ import annotations

import math

from railgrip.control.temperature_parameters import LINEAR, TemperatureOnly
from railgrip.core.formulas.choosing import choose

ABSENT = 1.0e6
"""A rise that no contact reaches, K: a limit that is absent."""


def admissible_power(
    parameters: TemperatureOnly,
    still: float,
    moving: float,
    wheel: float,
    train: float,
    factor: float,
) -> float:
    """Return the friction power of an axle that heats its contacts as far as is aimed at, [W].

    Parameters
    ----------
    parameters : TemperatureOnly
        By name.
    still, moving : float
        Squares of one body's heat conductance at rest [W²/K²] and for each m/s, as in
        `railgrip.core.formulas.flash_temperature.flash_conductance`.
    wheel, train : float
        Speed at the tread and of the train, ≥ 0 [m/s]; floored.
    factor : float
        On both admissible rises.

    Notes
    -----
    Linear law of the source, f1 to f3: P = ΔT · v · (A/l)/k_T for each body with its own speed, the
    smaller counts. Physical law: both surfaces of a contact become equally hot,
    P = ΔT (G_wheel + G_rail), and the smaller rise counts. Two contacts share the axle's power.

    Examples
    --------
    >>> from railgrip.control.temperature_parameters import TemperatureOnly
    >>> one = TemperatureOnly(rise_wheel=200.0, rise_rail=0.0, set_point=1.0)
    >>> round(admissible_power(one, 0.503, 67.46, 20.0, 20.0, 1.0))
    29391
    """
    aim = parameters.set_point * factor
    rise_wheel = aim * (parameters.rise_wheel if parameters.rise_wheel > 0.0 else ABSENT)
    rise_rail = aim * (parameters.rise_rail if parameters.rise_rail > 0.0 else ABSENT)
    wheel = max(wheel, parameters.least_speed)
    train = max(train, parameters.least_speed)
    per_speed = 2.0 * parameters.semi_axis_across / parameters.linear_factor
    linear = 2.0 * per_speed * min(rise_wheel * wheel, rise_rail * train)
    conductance = math.sqrt(still + moving * wheel) + math.sqrt(still + moving * train)
    physical = 2.0 * min(rise_wheel, rise_rail) * conductance
    return choose(parameters.heat_law == LINEAR, linear, physical)


def per_fastest(parameters: TemperatureOnly, fastest: float) -> float:
    """Return one over the larger of wheel and train speed, which is floored, [s/m].

    Examples
    --------
    >>> from railgrip.control.temperature_parameters import TemperatureOnly
    >>> per_fastest(TemperatureOnly(), 20.0)
    0.05
    """
    return 1.0 / max(fastest, parameters.least_speed)


def signed_slip(wheel: float, train: float, per_fastest: float) -> float:
    """Return s* = (wheel − train)/max(wheel, train), f4.

    Examples
    --------
    >>> signed_slip(18.0, 20.0, 1.0 / 20.0)
    -0.1
    """
    return (wheel - train) * per_fastest


def friction_speed(
    parameters: TemperatureOnly, power: float, friction: float, load: float
) -> float:
    """Return the slip speed at which the rail turns this power into heat, [m/s].

    Examples
    --------
    >>> from railgrip.control.temperature_parameters import TemperatureOnly
    >>> friction_speed(TemperatureOnly(), 30e3, -6e3, 130e3)
    5.0
    """
    speed: float = power / max(abs(friction), parameters.least_adhesion * load)
    return speed


def slip_target(speed: float, per_fastest: float, greatest: float, sign: float) -> float:
    """Return s_soll out of the friction speed (f5), with the sign of the demand.

    It is never beyond ``greatest``.

    Examples
    --------
    >>> slip_target(2.0, 1.0 / 20.0, 0.25, -1.0)
    -0.1
    """
    return sign * min(speed * per_fastest, greatest)


def force_target(
    parameters: TemperatureOnly,
    slip: float,
    wanted: float,
    friction: float,
    train_acceleration: float,
    mass: float,
    whole_force: float,
    excess_gain: float,
    demand: float,
    fastest: float,
) -> float:
    """Return F*: the force that leads the slip to its target, never beyond the demand (f7, f9).

    Parameters
    ----------
    parameters : TemperatureOnly
        By name.
    slip, wanted : float
        s* and s_soll.
    friction : float
        Force of the rail as observed, [N].
    train_acceleration : float
        Signed, [m/s²].
    mass : float
        Rotating mass at the tread, [kg].
    whole_force : float
        Magnitude that a slip error of s_max asks for, [N].
    excess_gain : float
        Factor on a slip error beyond the target.
    demand : float
        The driver's, signed, [N].
    fastest : float
        The larger of wheel and train speed, [m/s].

    Notes
    -----
    a = K (s_soll − s*) + (1 − |s*|) a_train with K = F_max/(m_r s_max). The second term keeps a
    steady slip while the train changes its speed; without it an error remains.

    Examples
    --------
    >>> from railgrip.control.temperature_parameters import TemperatureOnly
    >>> settled = TemperatureOnly(gain_speed=1.0)
    >>> round(force_target(settled, -0.1, -0.1, -6e3, -0.5, 1000.0, 15e3, 1.0, -15e3, 20.0))
    -6450
    """
    pace = max(fastest, parameters.least_speed) * (1.0 / parameters.gain_speed)
    gain = whole_force * (1.0 / parameters.slip_scale) * min(pace, 1.0)
    error = wanted - slip
    gain = choose(abs(slip) > abs(wanted), gain * excess_gain, gain)
    force: float = gain * error + mass * (1.0 - min(abs(slip), 1.0)) * train_acceleration + friction
    braking = max(demand, min(force, 0.0))
    driving = min(demand, max(force, 0.0))
    return choose(demand < 0.0, braking, driving)
