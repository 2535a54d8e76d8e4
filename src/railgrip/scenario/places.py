"""Key paths with wildcards: every place of a scenario that `train.vehicle[*].tare` means."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.scenario.base import Model
from railgrip.scenario.scenario import Scenario

Steps = tuple[str | int, ...]
OF = ".of."
"""Between the name of a brake and the axle that wears it."""
SCOPES = ("train", "vehicle", "bogie", "axle")

_PART = re.compile(r"([^.\[\]]+)((?:\[(?:\d{1,6}|\*)\])*)")


class Place(NamedTuple):
    """One place in a scenario whose train is spread out.

    Attributes
    ----------
    steps : tuple
        Field names, keys and indices from the scenario down.
    value : object
        What the scenario holds there.
    position : tuple of int
        Vehicle, bogie and axle it belongs to, as far as it belongs to one; all from 0.
    """

    steps: Steps
    value: Any
    position: tuple[int, ...]


def spread_out(scenario: Scenario) -> Scenario:
    """Return the scenario with a brake of its own for every axle, so that each can be changed."""
    train = scenario.train
    brakes, vehicles = {}, []
    for i, vehicle in enumerate(train.vehicle):
        bogies = []
        for j, bogie in enumerate(vehicle.bogie):
            axles = []
            for k, axle in enumerate(bogie.axle):
                own = None if axle.brake is None else f"{axle.brake}{OF}{i}.{j}.{k}"
                if own is not None and axle.brake is not None:
                    brakes[own] = train.brakes[axle.brake]
                axles.append(axle.model_copy(update={"brake": own}))
            bogies.append(bogie.model_copy(update={"axle": tuple(axles)}))
        vehicles.append(vehicle.model_copy(update={"bogie": tuple(bogies)}))
    spread = train.model_copy(update={"brakes": brakes, "vehicle": tuple(vehicles)})
    return scenario.model_copy(update={"train": spread})


def find_places(scenario: Scenario, path: str, where: str = "") -> list[Place]:
    """Return the places that a key path means.

    Parameters
    ----------
    scenario : Scenario
        As `spread_out` returns it.
    path : str
        Dotted; ``[*]`` stands for every entry, ``train.brakes.disc`` for that brake of every axle
        that wears it, ``train.brakes.*`` for every brake.
    where : str
        Key path of the path itself, for the message.

    Raises
    ------
    RailgripError
        ``variable[0].quantity: train.vehicle[*].tara: key 'tara' unknown; known: …``

    Examples
    --------
    >>> scenario = spread_out(Scenario(train="emu_four_car"))
    >>> len(find_places(scenario, "train.vehicle[*].bogie[*].axle[*].wheel_radius"))
    16
    """
    steps: list[str] = []
    for part in path.split("."):
        match = _PART.fullmatch(part)
        if match is None:
            what = f"'{path[:80]}' is no key path"
            raise RailgripError(Problem(where, what, allowed="e.g. train.vehicle[*].tare"))
        steps += [match[1], *re.findall(r"\[(?:\d+|\*)\]", match[2])]
    found = [Place((), scenario, ())]
    for step in steps:
        found = [below for place in found for below in _below(place, step, path, where)]
    if not found:
        raise RailgripError(Problem(where, f"'{path}' means nothing in this scenario"))
    return found


def _below(place: Place, step: str, path: str, where: str) -> list[Place]:
    value, steps, position = place.value, place.steps, place.position
    if step.startswith("["):
        return _entries(place, step, path, where)
    if isinstance(value, dict):
        is_brakes = steps == ("train", "brakes")
        keys = [k for k in value if step in ("*", str(k).partition(OF)[0] if is_brakes else k)]
        if not keys:
            known = sorted({str(k).partition(OF)[0] for k in value})
            raise RailgripError(unknown_name(where, "name", step, known))
        return [
            Place((*steps, key), value[key], _axle_of(key) if is_brakes else position)
            for key in keys
        ]
    if not isinstance(value, Model):
        what = f"'{path}' leads below a value"
        if value is None:
            what = f"'{path}' leads below something that this scenario does not have"
        raise RailgripError(Problem(where, what))
    names = {field.alias or name: name for name, field in type(value).model_fields.items()}
    if step not in names:
        raise RailgripError(unknown_name(where, "key", step, names))
    return [Place((*steps, names[step]), getattr(value, names[step]), position)]


def _entries(place: Place, step: str, path: str, where: str) -> list[Place]:
    value, steps = place.value, place.steps
    if not isinstance(value, (list, tuple)):
        raise RailgripError(Problem(where, f"'{path}': '{steps[-1]}' is no list"))
    if step != "[*]" and int(step[1:-1]) >= len(value):
        what = f"'{path}': there is no entry {step}"
        raise RailgripError(Problem(where, what, allowed=f"0 to {len(value) - 1}"))
    wanted = range(len(value)) if step == "[*]" else [int(step[1:-1])]
    in_train = bool(steps) and steps[-1] in SCOPES and steps[0] == "train"
    return [
        Place((*steps, i), value[i], (*place.position, i) if in_train else place.position)
        for i in wanted
    ]


def _axle_of(key: str) -> tuple[int, ...]:
    return tuple(int(number) for number in key.partition(OF)[2].split("."))


def replaced(model: Any, steps: Steps, value: Any) -> Any:
    """Return a model with something else at a place, unchecked.

    It may be an array over runs: lowering then gives arrays.
    """
    if not steps:
        return value
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        items = list(model)
        items[step] = replaced(items[step], rest, value)
        return tuple(items)
    if isinstance(model, dict):
        return {**model, step: replaced(model[step], rest, value)}
    return model.model_copy(update={step: replaced(getattr(model, step), rest, value)})
