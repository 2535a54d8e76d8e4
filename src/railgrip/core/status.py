"""How a run ended, and what to do when it did not end well."""

from __future__ import annotations

from enum import IntEnum


class RunStatus(IntEnum):
    """Outcome of one run."""

    RUNNING = 0
    STOPPED = 1
    ARRIVED = 2
    STALLED = 3
    END_OF_TRACK = 4
    TIME_LIMIT = 5
    DIVERGED = 6
    CONTROLLER_FAILED = 7
    COMPLETED = 8
    IMPOSSIBLE = 9


_SENTENCES = {
    RunStatus.RUNNING: "The run has not ended.",
    RunStatus.STOPPED: "The train came to a stand.",
    RunStatus.ARRIVED: "The train arrived at its destination.",
    RunStatus.STALLED: (
        "The train rolled back although it was driven; try more tractive effort, a lighter train, "
        "or to hold it by the brake until the effort has built up."
    ),
    RunStatus.END_OF_TRACK: (
        "The line ended before the train stood; "
        "try a longer line, an earlier start or a lower speed."
    ),
    RunStatus.TIME_LIMIT: (
        "The time limit passed before the train stood; try a larger run.time_limit, "
        "or ask whether the brake can hold this gradient at all."
    ),
    RunStatus.DIVERGED: (
        "A number of the run became infinite or undefined; try a smaller run.step "
        "and look for extreme parameters."
    ),
    RunStatus.CONTROLLER_FAILED: (
        "The controller returned something that is no command; run 'railgrip check' on it."
    ),
    RunStatus.COMPLETED: "The time that was asked for has passed.",
    RunStatus.IMPOSSIBLE: (
        "The run was not made: a number that was drawn lies outside what the scenario allows; "
        "try a truncated distribution."
    ),
}


ENDED_WELL = (RunStatus.STOPPED, RunStatus.ARRIVED, RunStatus.COMPLETED)
"""Outcomes that are what was asked for."""


def sentence(status: int) -> str:
    """Return what the status means, with a cure where there is one.

    Examples
    --------
    >>> sentence(RunStatus.STOPPED)
    'The train came to a stand.'
    """
    return _SENTENCES[RunStatus(int(status))]
