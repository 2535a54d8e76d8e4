"""One run of a campaign again, with its whole way."""

from __future__ import annotations

from typing import Any

import numpy as np

from railgrip.campaign.batch import Batches
from railgrip.campaign.store import Store
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import RunStatus
from railgrip.engine.result import Result
from railgrip.engine.simulate import run_prepared


def replay(store: Store, run: int) -> tuple[Result, dict[str, Any]]:
    """Return a run with its traces, and what was drawn for it.

    Parameters
    ----------
    store : Store
        The campaign.
    run : int
        Number of the run; it need not have been made yet.

    Returns
    -------
    result : Result
        The same bits as in the campaign.
    draws : dict
        Column → what was drawn.

    Raises
    ------
    RailgripError
        ``run 123456: The run was not made: a number that was drawn lies outside …``
    """
    if not 0 <= run < store.campaign.runs:
        allowed = f"0 to {store.campaign.runs - 1}"
        raise RailgripError(Problem("", "there is no such run", f"{run}", allowed))
    batches = Batches(store.campaign)
    draws = batches.drawing.draw(run, run + 1)
    if batches.figures(draws, np.array([run]))["status"][0] == RunStatus.IMPOSSIBLE:
        raise RailgripError(Problem(f"run {run}", "was not made", cure="a truncated distribution"))
    prepared, plan, changes = batches.laid_out(draws, np.array([run]))
    parameters = plan.parameters.copy().ravel()
    parameters[changes.target] = changes.value[0]
    plan = plan._replace(parameters=parameters.reshape(plan.parameters.shape))
    title = f"{prepared.scenario.title or 'campaign'}, run {run}"
    scenario = prepared.scenario.model_copy(update={"title": title})
    result = run_prepared(prepared._replace(plan=plan, scenario=scenario), changes, traced=True)
    return result, {name: values[0].item() if hasattr(values[0], "item") else values[0]
                    for name, values in draws.items()}  # fmt: skip
