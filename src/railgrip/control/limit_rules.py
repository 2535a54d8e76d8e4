"""Which sets of bounds and weights hold now: rules with conditions, the last that holds decides.

A rule is one row of numbers, so that the engine's kernel can read it: first its conditions, then
the model's set and the control's set of `friction_estimate`.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from railgrip.control.contract import FloatArray
from railgrip.control.friction_estimate import Influence, LimitSet
from railgrip.core.formulas.piecewise_linear import Hinges

ANY: Final = 0.0
SERVICE: Final = 1.0
EMERGENCY_BRAKE: Final = 2.0
NEW: Final = 1.0
WORN: Final = 2.0


class Conditions(NamedTuple):
    """When a rule holds: all of it at once.

    Parameters
    ----------
    brake : float
        `ANY`, `SERVICE` or `EMERGENCY_BRAKE`.
    pads : float
        `ANY`, `NEW` or `WORN`.
    least_speed, greatest_speed : float
        Range of the train speed [m/s].
    least_time, greatest_time : float
        Range of the time since the brake command [s].
    least_temperature, greatest_temperature : float
        Range of the disc temperature [°C].
    least_rubbing_speed, greatest_rubbing_speed : float
        Range of the rubbing speed [m/s].
    least_clamp_force, greatest_clamp_force : float
        Range of the clamp force [N].
    """

    brake: float = ANY
    pads: float = ANY
    least_speed: float = -math.inf
    greatest_speed: float = math.inf
    least_time: float = -math.inf
    greatest_time: float = math.inf
    least_temperature: float = -math.inf
    greatest_temperature: float = math.inf
    least_rubbing_speed: float = -math.inf
    greatest_rubbing_speed: float = math.inf
    least_clamp_force: float = -math.inf
    greatest_clamp_force: float = math.inf


class LimitRule(NamedTuple):
    """Two sets and when they hold.

    Parameters
    ----------
    when : Conditions
        Always, if nothing is given.
    model, control : LimitSet
        The two sets.
    """

    when: Conditions = Conditions()
    model: LimitSet = LimitSet()
    control: LimitSet = LimitSet()


N_CONDITIONS: Final = len(Conditions._fields)
N_INFLUENCE: Final = 2 + len(Hinges._fields)
N_SET: Final = 3 * N_INFLUENCE + 2
N_RULE: Final = N_CONDITIONS + 2 * N_SET


def rule_numbers(rule: LimitRule) -> list[float]:
    """Return a rule as one row of `N_RULE` numbers.

    Examples
    --------
    >>> len(rule_numbers(LimitRule())) == N_RULE
    True
    """
    numbers = list(rule.when)
    for limits in (rule.model, rule.control):
        for influence in (limits.temperature, limits.speed, limits.clamp_force):
            numbers += [influence.least, influence.greatest, *influence.weight]
        numbers += [limits.form, limits.weight]
    return numbers


def _influence(rules: FloatArray, i: int, at: int) -> Influence:
    weight = Hinges(
        rules[i, at + 2], rules[i, at + 3], rules[i, at + 4], rules[i, at + 5], rules[i, at + 6],
        rules[i, at + 7], rules[i, at + 8], rules[i, at + 9], rules[i, at + 10],
    )  # fmt: skip
    return Influence(rules[i, at], rules[i, at + 1], weight)


def limit_set(rules: FloatArray, i: int, at: int) -> LimitSet:
    """Return the set that begins at a column of row i.

    Parameters
    ----------
    rules : ndarray (rule, `N_RULE`)
        Rows of `rule_numbers`.
    i, at : int
        Row; column: `N_CONDITIONS` for the model's set, `N_SET` further for the control's.

    Examples
    --------
    >>> import numpy as np
    >>> rules = np.array([rule_numbers(LimitRule(control=LimitSet(weight=0.5)))])
    >>> float(limit_set(rules, 0, N_CONDITIONS + N_SET).weight)
    0.5
    """
    return LimitSet(
        _influence(rules, i, at),
        _influence(rules, i, at + N_INFLUENCE),
        _influence(rules, i, at + 2 * N_INFLUENCE),
        rules[i, at + 3 * N_INFLUENCE],
        rules[i, at + 3 * N_INFLUENCE + 1],
    )


def rule_in_force(
    rules: FloatArray,
    brake: float,
    pads: float,
    train_speed: float,
    time: float,
    disc_temperature: float,
    rubbing_speed: float,
    clamp_force: float,
) -> int:
    """Return the row of the last rule that holds.

    Parameters
    ----------
    rules : ndarray (rule, `N_RULE`)
        Rows of `rule_numbers`.
    brake, pads : float
        Codes of brake and pads, as in `Conditions`.
    train_speed, time : float
        [m/s]; since the brake command [s].
    disc_temperature, rubbing_speed, clamp_force : float
        [°C], [m/s], [N].

    Returns
    -------
    int
        −1 where none holds: then nothing is compensated.

    Examples
    --------
    >>> import numpy as np
    >>> hard = LimitRule(Conditions(brake=EMERGENCY_BRAKE))
    >>> rules = np.array([rule_numbers(LimitRule()), rule_numbers(hard)])
    >>> rule_in_force(rules, SERVICE, NEW, 30.0, 5.0, 100.0, 15.0, 25e3)
    0
    """
    found = -1
    for i in range(rules.shape[0]):
        is_kind = rules[i, 0] == 0.0 or rules[i, 0] == brake
        is_state = rules[i, 1] == 0.0 or rules[i, 1] == pads
        holds = (
            is_kind
            and is_state
            and rules[i, 2] <= train_speed <= rules[i, 3]
            and rules[i, 4] <= time <= rules[i, 5]
            and rules[i, 6] <= disc_temperature <= rules[i, 7]
            and rules[i, 8] <= rubbing_speed <= rules[i, 9]
            and rules[i, 10] <= clamp_force <= rules[i, 11]
        )
        found = i if holds else found
    return found
