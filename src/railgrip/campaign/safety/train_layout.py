"""Which normal number makes which quantity of which axle, and what failed units take with them."""

from __future__ import annotations

from collections.abc import Hashable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.failures import FailureStates, failure_states
from railgrip.campaign.safety.case import SafetyCase
from railgrip.campaign.safety.variable import OF_TRAIN, Variable
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine import layout as at
from railgrip.engine.lower_train import lower_train, nominal_friction

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


class Brakes(NamedTuple):
    """The braked axles as they are when nothing scatters, (axles,) each, SI.

    Attributes
    ----------
    axle : axle number in the train; name : name of its brake
    pressure : full cylinder pressure; slope, spring, offset : clamp force = slope p + spring +
        offset, the first two through the rigging
    friction, radius, lever : pad friction, wheel radius, mean radius of rubbing
    fill, dead : fill time and dead time
    temperature : of the discs when the brake is applied, °C
    """

    axle: NDArray[np.intp]
    name: tuple[str, ...]
    pressure: FloatArray
    slope: FloatArray
    spring: FloatArray
    offset: FloatArray
    efficiency: FloatArray
    friction: FloatArray
    radius: FloatArray
    lever: FloatArray
    fill: FloatArray
    dead: FloatArray
    temperature: FloatArray


class Layout(NamedTuple):
    """Which normal number makes which quantity of which axle.

    Attributes
    ----------
    brakes : Brakes
        The train as it is.
    variables : list of (Variable, columns)
        For each variable the column of each braked axle, −1 where it has none; one column for a
        quantity of the train.
    n_variables : int
        How many normal numbers.
    fails : (units, braked axles) bool
        Which brakes a unit takes with it.
    together : list of (columns, factor)
        Normal numbers that are correlated, (places, variables), and Cholesky's factor.
    control : int
        The unit that is the brake control, or −1.
    states : FailureStates
        The states of the units.
    owner : list of int
        For each normal number the unit without which it has no effect, or −1.
    """

    brakes: Brakes
    variables: list[tuple[Variable, NDArray[np.intp]]]
    n_variables: int
    fails: BoolArray
    states: FailureStates
    owner: list[int]
    control: int
    together: list[tuple[NDArray[np.intp], FloatArray]]


def layout_of(case: SafetyCase) -> Layout:
    """Return how a case is laid out in normal numbers and units."""
    brakes = _brakes(case)
    places = [case.train.axles()[i] for i in brakes.axle]
    keys = {
        "train": [0 for _ in places],
        "vehicle": [place.vehicle for place in places],
        "bogie": [(place.vehicle, place.bogie) for place in places],
        "axle": [int(i) for i in brakes.axle],
        "control": [0 for _ in places],
    }
    variables, n = [], 0
    for variable in case.variables:
        numbers: dict[Hashable, int] = {}
        column = np.full(len(places), -1, dtype=np.intp)
        for i, key in enumerate(keys[variable.per]):
            if not variable.brakes or brakes.name[i] in variable.brakes:
                column[i] = n + numbers.setdefault(key, len(numbers))
        n += len(numbers)
        variables.append((variable, column))
    fails, chances, kinds = _units(case, brakes, keys)
    states = failure_states(chances, kinds)
    takes = fails.any(axis=1)
    control = -1 if takes.all() else int(np.flatnonzero(~takes)[0])
    if control >= 0:
        states = _apart(states, control)
    together = _together(case, variables)
    owner = _owners(variables, n, fails)
    for columns, _ in together:
        for place in columns:
            # a number of one of them acts through the others too
            if len({owner[column] for column in place}) > 1:
                for column in place:
                    owner[column] = -1
    return Layout(brakes, variables, n, fails, states, owner, control, together)


def _together(
    case: SafetyCase, variables: list[tuple[Variable, NDArray[np.intp]]]
) -> list[tuple[NDArray[np.intp], FloatArray]]:
    own = {variable.label: np.unique(column[column >= 0]) for variable, column in variables}
    return [
        (
            np.column_stack([own[name] for name in one.variables]),
            np.linalg.cholesky(np.array(one.matrix)),
        )
        for one in case.correlation
    ]


def _brakes(case: SafetyCase) -> Brakes:
    table, _ = lower_train(case.scenario(case.speed_steps[-1]))
    rows = []
    for i, place in enumerate(case.train.axles()):
        if place.axle.brake is None:
            continue
        brake, row = case.train.brakes[place.axle.brake], table[1 + i]
        through = brake.rigging_ratio * brake.rigging_efficiency * brake.units
        clamp = row[at.CLAMP_PER_PRESSURE - at.FIRST_PARAMETER]
        pressure = row[at.FULL_PRESSURE - at.FIRST_PARAMETER]
        offset = brake.rigging_spring * brake.units
        spring = brake.cylinder_spring * through
        per_block = row[at.CLAMP_PER_BLOCK - at.FIRST_PARAMETER]
        friction = nominal_friction(brake.pad, (clamp * pressure + spring + offset) * per_block)
        radius = place.axle.wheel_radius
        lever = brake.friction_radius if brake.friction_radius is not None else radius
        fill = 3.0 * brake.lag if brake.fill == "lag" else brake.fill_time
        dead = row[at.DEMAND_DELAY - at.FIRST_PARAMETER]
        hot = row[at.START_TEMPERATURE - at.FIRST_PARAMETER]
        rows.append((i, place.axle.brake, pressure, clamp, spring, offset, brake.rigging_efficiency,
                     friction, radius, lever, fill, dead, hot))  # fmt: skip
    if not rows:
        raise RailgripError(Problem("train", "has no friction brake", cure="give axles a brake"))
    columns = list(zip(*rows, strict=True))
    numbers = [np.array(column, dtype=float) for column in columns[2:]]
    return Brakes(np.array(columns[0], dtype=np.intp), tuple(columns[1]), *numbers)


def _units(
    case: SafetyCase, brakes: Brakes, keys: dict[str, list[Hashable]]
) -> tuple[BoolArray, list[float], list[Hashable] | None]:
    rows: list[BoolArray] = []
    chances: list[float] = []
    kinds: list[Hashable] = []
    for kind, failure in enumerate(case.failures):
        chosen = [not failure.brakes or name in failure.brakes for name in brakes.name]
        members: dict[Hashable, list[int]] = {}
        for i, key in enumerate(keys[failure.per]):
            if chosen[i]:
                members.setdefault(key, []).append(i)
        for axles in members.values():
            row = np.zeros(len(brakes.axle), dtype=bool)
            row[axles] = failure.per != "control"
            rows.append(row)
            chances.append(failure.probability)
            kinds.append((kind, *sorted(brakes.name[i] for i in axles)))
    fails = np.array(rows, dtype=bool).reshape(len(rows), len(brakes.axle))
    # where one unit lies within another, which of them fail does matter; and so it does where a
    # variable of a bogie or a vehicle ties axles together
    overlap = bool((fails.sum(axis=0) > 1).any())
    tied = any(v.per in ("vehicle", "bogie") for v in case.variables)
    return fails, chances, None if overlap or tied else kinds


def _apart(states: FailureStates, control: int) -> FailureStates:
    """Return the states with those of a failed control counted beyond the others.

    Without its control the train brakes so differently that runs must be sought elsewhere.
    """
    fails = states.failed[:, control]
    beyond = int(states.n_failed[~fails].max())
    return states._replace(n_failed=np.where(fails, beyond + states.n_failed, states.n_failed))


def _owners(
    variables: list[tuple[Variable, NDArray[np.intp]]], n: int, fails: BoolArray
) -> list[int]:
    owner = [-1] * n
    for variable, column in variables:
        if variable.quantity in (*OF_TRAIN, "wheel_radius"):
            continue
        for number in np.unique(column[column >= 0]):
            acts = column == number
            units = [u for u in range(len(fails)) if bool(fails[u][acts].all())]
            owner[int(number)] = units[0] if len(units) == 1 else -1
    return owner
