"""From a model to its rare quantiles: pilots, one sample, intervals."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.levels import SHORTFALLS
from railgrip.campaign.rare.pilots import Counted, Model, pilot
from railgrip.campaign.rare.proposal import Sample, components, draw
from railgrip.campaign.rare.quantiles import RESOLVED, Curve, Interval, curve, intervals
from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]
PILOT_SHARE = 0.1
EXPLAINED = 0.97
"""Several directions that explain less of what pilots gave leave rare levels unresolved."""
RARE = 0.05
"""More probable levels rest on the runs drawn as they come, whatever the directions."""
"""Runs of one pilot round, as a share of the whole sample."""


class RareResult(NamedTuple):
    """What `rare_quantiles` found.

    Attributes
    ----------
    probability : (levels,)
        The probabilities asked.
    quantile : list of Interval
        Result that is undercut with each probability, and its intervals.
    curve : Curve
        Distribution over all results.
    share : (levels, counts)
        How the runs that undercut a level divide by the number of failed units.
    sample, result : Sample, (runs,)
        The runs behind it.
    states : FailureStates
        What may have failed.
    pilots : int
        Runs that only showed the way.
    warnings : list of str
        What the reader must know; empty if nothing.
    """

    probability: FloatArray
    quantile: list[Interval]
    curve: Curve
    share: FloatArray
    sample: Sample
    result: FloatArray
    states: FailureStates
    pilots: int
    warnings: list[str]

    @property
    def runs(self) -> int:
        """All runs, pilots included."""
        return self.pilots + len(self.result)


def rare_quantiles(
    model: Model,
    n_variables: int,
    states: FailureStates,
    *,
    probabilities: Sequence[float] = SHORTFALLS,
    runs: int = 10_000,
    seed: int = 1,
    owner: Sequence[int] | None = None,
) -> RareResult:
    """Return quantiles of a result, common and rare ones, from one sample.

    Choose it where failed units make several modes and probabilities go down to 1e-9. For
    probabilities that a plain sample reaches, or a result that no direction orders, sample plainly.

    Parameters
    ----------
    model : callable
        Takes ``normals (runs, variables)``, independent standard normal numbers, and ``failed
        (runs, units)``, true where a unit has failed; returns the result of each run, finite,
        larger is better. It is called several times with many runs.
    n_variables : int
        How many normal numbers a run needs, ≥ 1.
    states : FailureStates
        From `failure_states`.
    probabilities : sequence of float
        Which quantiles, each between 0 and 1; those of EBCL 0 … 9 if not given.
    runs : int
        Runs of the final sample, ≥ 500; pilots come on top.
    seed : int
        The same seed gives the same result.
    owner : sequence of int, optional
        For each variable the unit without which it has no effect, or −1. It spares pilots.

    Returns
    -------
    found : RareResult

    Raises
    ------
    RailgripError
        ``runs: must be at least 500; got 10``; ``the model gave a result that is not finite``

    Notes
    -----
    Failed units are enumerated with exact weights. Pilots find, for each number of failed units,
    the directions in which the result falls (at most six); final samples are drawn beyond where
    each level begins, along each direction, and weighted by the balance heuristic over all of
    them. Where variables are few, a shell around the centre joins in. Pilots are not counted.
    Where several directions explain too little of what the pilots gave (a distance from the
    centre, which has no end of them), or a level rests on too few effective runs, it gets an open
    interval and a warning. Known wrong when thousands of pilots miss a direction altogether. Check
    a new model with `railgrip.campaign.rare.cross_checks`.

    References
    ----------
    .. [1] E. Veach, L. Guibas, Optimally combining sampling techniques for Monte Carlo rendering,
       SIGGRAPH 1995, §3 (balance heuristic).
    .. [2] A. Owen, Y. Zhou, Safe and effective importance sampling, J. Am. Stat. Assoc. 95 (2000)
       135-143 (deterministic mixture, control variates).

    Checked by tests/reference/rare_events.

    Examples
    --------
    Sixteen equal brakes, each failed with 10⁻³, each force with a spread of 5 %:

    >>> from railgrip.campaign.rare.failures import failure_states
    >>> def force(normals, failed):
    ...     return ((1.0 + 0.05 * normals) * ~failed).mean(axis=1)
    >>> states = failure_states([1e-3] * 16, ["brake"] * 16)
    >>> found = rare_quantiles(force, 16, states, owner=range(16))
    >>> round(found.quantile[9].value, 2)
    0.75
    """
    chances = np.asarray(probabilities, dtype=float)
    _check(n_variables, chances, runs, states, owner)
    generator = np.random.Generator(np.random.Philox(seed))
    asked = Counted(model)
    owners = np.full(n_variables, -1) if owner is None else np.asarray(owner, dtype=np.intp)
    ladder = _ladder(chances)
    faces, explained = pilot(
        asked, states, owners, ladder, max(200, int(PILOT_SHARE * runs)), generator
    )
    pilots = asked.runs
    sample = draw(components(faces, states, ladder, runs), faces, states, generator)
    result = asked(sample.normals, states.failed[sample.state])
    found = curve(result, sample, states)
    rows = intervals(found, chances, states.left_out)
    shares = _shares(rows, sample, result, states)
    rows, unseen = _refused(chances, rows, shares, explained)
    return RareResult(
        chances, rows, found, shares, sample, result, states, pilots,
        [*_warnings(chances, rows, states), *unseen],
    )  # fmt: skip


def _check(
    n_variables: int, chances: FloatArray, runs: int, states: FailureStates, owner: object
) -> None:
    problems = []
    if n_variables < 1:
        problems.append(Problem("n_variables", "must be at least 1", got=str(n_variables)))
    if runs < 500:
        problems.append(Problem("runs", "must be at least 500", got=str(runs)))
    if not len(chances) or not np.all((chances > 0.0) & (chances < 1.0)):
        what = "must lie between 0 and 1, both excluded"
        problems.append(Problem("probabilities", what, got=str(chances.tolist())))
    elif states.left_out > 0.1 * chances.min():
        problems.append(
            Problem("states", "leave out too much for the rarest level",
                    got=f"{states.left_out:.1e} for {chances.min():.1e}",
                    cure="a smaller 'negligible' of failure_states")
        )  # fmt: skip
    if owner is not None and len(list(owner)) != n_variables:  # type: ignore[call-overload]
        problems.append(Problem("owner", "needs one unit for each variable"))
    if problems:
        raise RailgripError(problems)


def _ladder(chances: FloatArray) -> FloatArray:
    """Return the levels that samples are drawn for: the asked ones, steps between, one beyond."""
    lowest = math.log10(chances.min()) - 0.5
    steps = 10.0 ** np.arange(-0.5, lowest - 1e-9, -0.5)
    return np.unique(np.concatenate([chances, steps, [10.0**lowest]]))[::-1]


def _shares(
    rows: list[Interval], sample: Sample, result: FloatArray, states: FailureStates
) -> FloatArray:
    counts = states.n_failed[sample.state]
    share = np.zeros((len(rows), int(states.n_failed.max()) + 1))
    for i, row in enumerate(rows):
        below = result <= row.value
        np.add.at(share[i], counts[below], sample.weight[below])
    whole: FloatArray = share.sum(axis=1, keepdims=True)
    divided: FloatArray = share / np.maximum(whole, 1e-300)
    return divided


def _refused(
    chances: FloatArray, rows: list[Interval], shares: FloatArray, explained: dict[int, float]
) -> tuple[list[Interval], list[str]]:
    """Open the intervals of rare levels whose directions are not well enough known."""
    known = np.array([explained.get(count, 1.0) for count in range(shares.shape[1])])
    kept, told = [], []
    for p, row, seen in zip(chances, rows, shares @ known, strict=True):
        if p < RARE and row.effective >= RESOLVED and seen < EXPLAINED:
            told.append(
                f"the level of {p:.3g} is not resolved: the results fall in so many directions "
                f"that those found explain {100 * seen:.0f} % of them"
            )
            row = row._replace(low=-np.inf, high=np.inf, low_all=-np.inf, high_all=np.inf)
        kept.append(row)
    return kept, told


def _warnings(chances: FloatArray, rows: list[Interval], states: FailureStates) -> list[str]:
    found = []
    for p, row in zip(chances, rows, strict=True):
        if row.effective < RESOLVED:
            found.append(
                f"the level of {p:.3g} is not resolved: it rests on {row.effective:.0f} effective "
                "runs, because the results fall in several directions or the runs are too few"
            )
        elif math.isfinite(row.low_all) != math.isfinite(row.high_all):
            found.append(f"the interval of level {p:.3g} is open: take more runs")
    if states.left_out > 1e-3 * chances.min():
        found.append(f"failure states of {states.left_out:.1e} are left out; intervals hold them")
    return found
