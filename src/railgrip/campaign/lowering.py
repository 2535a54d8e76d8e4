"""Whether runs can share a batch: lowering an array must give what lowering its values gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from railgrip.campaign.drawing import Column
from railgrip.core.errors import RailgripError
from railgrip.engine.many import vary
from railgrip.engine.plan import Overrides, Plan
from railgrip.engine.simulate import Prepared, prepare
from railgrip.scenario import Scenario
from railgrip.scenario.places import replaced

SAME = 2e-5
"""How far lowering by arrays may be from lowering one by one, relative: knots of Kalker's table."""


def goes_together(
    scenario: Scenario,
    column: Column,
    tried: Any,
    prepared: Prepared,
    checked: Callable[[Scenario], Scenario],
) -> bool:
    """Whether a column can go into the batch as an array, tried with some of its draws.

    Parameters
    ----------
    scenario : Scenario
        As spread out.
    column : Column
        What is drawn.
    tried : array
        Two draws that the scenario allows; of names any number, each of which is checked.
    prepared : Prepared
        The scenario, lowered.
    checked : callable
        Refuses a scenario that cannot be.
    """
    if tried.dtype.kind not in "fib":
        for value in set(tried.tolist()):
            checked(replaced(scenario, column.places[0].steps, value))
        return False
    many, singles = scenario, [scenario, scenario]
    for place in column.places:
        value = column.value(place, tried)
        many = replaced(many, place.steps, value)
        singles = [
            replaced(single, place.steps, one.item())
            for single, one in zip(singles, value, strict=True)
        ]
    try:
        plan, changes = vary(prepared.plan, scenario, many, np.arange(2))
    except (TypeError, ValueError, AttributeError, RailgripError):
        return False
    wanted = [prepare(single).plan for single in singles]
    return all(_same(plan, changes, run, one) for run, one in enumerate(wanted))


def _same(plan: Plan, changes: Overrides, run: int, wanted: Plan) -> bool:
    """Whether a run of a batch has the plan that it would have alone.

    What controllers are told of the train is left out: they know it as it should be.
    """
    numbers = plan.parameters.copy().ravel()
    numbers[changes.target] = changes.value[run]
    pairs = [
        (numbers.reshape(plan.parameters.shape), wanted.parameters),
        *zip(_own(plan.way._asdict(), run), _own(wanted.way._asdict(), 0), strict=True),
        *zip(_own(plan.faults._asdict(), run), _own(wanted.faults._asdict(), 0), strict=True),
        *zip(_own(plan.formation._asdict(), run), _own(wanted.formation._asdict(), 0),
             strict=True),
        *zip(plan.timing, wanted.timing, strict=True),
        *zip(plan.creep_tables, wanted.creep_tables, strict=True),
        (plan.controller_parameters, wanted.controller_parameters),
    ]  # fmt: skip
    return all(
        np.shape(a) == np.shape(b) and np.allclose(a, b, rtol=SAME, atol=1e-12) for a, b in pairs
    )


def _own(parts: dict[str, Any], run: int) -> list[Any]:
    per_run = ("conditions", "relative_spread", "vehicle_share", "happens")
    return [
        part[run if len(part) > 1 else 0] if name in per_run else part
        for name, part in parts.items()
        if name != "axle_setup"
    ]
