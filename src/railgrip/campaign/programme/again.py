"""One repetition of a programme again, bit for bit, with full curves."""

from __future__ import annotations

from railgrip.campaign.programme import situation
from railgrip.campaign.programme.perform import Programme
from railgrip.core.errors import Problem, RailgripError
from railgrip.engine.result import Result
from railgrip.engine.simulate import simulate


def run_again(programme: Programme, name: str, number: int) -> Result:
    """Run one repetition again with full curves, bit for bit as in the programme.

    Parameters
    ----------
    programme : Programme
        As it ran.
    name : str
        Of the test.
    number : int
        Of the run, as the protocol counts it.

    Raises
    ------
    RailgripError
        ``W3.40: there was no such run; …``
    """
    record = next(one for one in programme.perform((name,)) if one.name == name)
    if not 1 <= number <= len(record.runs):
        raise RailgripError(
            Problem(f"{name}.{number}", "there was no such run", allowed=f"1 to {len(record.runs)}")
        )
    run = record.runs[number - 1]
    scenario = situation.scenario_of(programme.profile, name, programme.base, run.seed)
    varied = situation.variations(
        scenario, programme.profile.tolerance, record.test, run.index + 1, programme.controller
    )
    fine = scenario.with_({"run.trace": max(0.02, scenario.run.step)})
    result = simulate(
        fine, runs=run.index + 1, variations=varied, traces=True, controller=programme.controller
    )
    chosen = result.data.isel(run=[run.index])
    return Result(fine, chosen)
