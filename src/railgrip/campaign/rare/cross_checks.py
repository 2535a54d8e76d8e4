"""Other ways to the same probability: brute force, and two methods of OpenTURNS.

They give the probability of a result below a bound, not quantiles, and one bound at a time. The two
of OpenTURNS run within each failure state and are put together with its exact weight.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.rare.failures import FailureStates
from railgrip.campaign.rare.pilots import Model
from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]
BATCH = 100_000
IMPOSSIBLE = 1e-14
"""A state in which the event is rarer counts as safe: it cannot matter at 1e-9."""


class Checked(NamedTuple):
    """Probability of a result at most the bound, its standard error as stated, and the runs."""

    probability: float
    error: float
    runs: int


def brute_force(
    model: Model, n_variables: int, states: FailureStates, bound: float, *, runs: int, seed: int = 1
) -> Checked:
    """Return the probability by counting plain runs, units failing at random.

    Parameters
    ----------
    model, n_variables, states
        As for `railgrip.campaign.rare.estimate.rare_quantiles`.
    bound : float
        Which result is bad enough.
    runs : int
        How many; a probability p takes about 400/p for 5 %.
    seed : int
        Of the random numbers.

    Examples
    --------
    >>> from railgrip.campaign.rare.failures import failure_states
    >>> states = failure_states([0.1])
    >>> found = brute_force(lambda u, failed: 1.0 - failed[:, 0], 1, states, 0.5, runs=1000)
    >>> abs(found.probability - 0.1) < 0.05
    True
    """
    generator = np.random.Generator(np.random.SFC64(seed))
    chances = states.weight / states.weight.sum()
    hits = done = 0
    while done < runs:
        size = min(BATCH, runs - done)
        row = generator.choice(len(chances), size, p=chances)
        normals = generator.standard_normal((size, n_variables))
        hits += int(np.count_nonzero(model(normals, states.failed[row]) <= bound))
        done += size
    p = hits / runs
    return Checked(p, math.sqrt(p * (1.0 - p) / runs), runs)


def cross_entropy(
    model: Model, n_variables: int, states: FailureStates, bound: float, *, seed: int = 1,
    runs: int = 2000,
) -> Checked:  # fmt: skip
    """Return the probability by cross-entropy importance sampling in the normal space.

    Parameters
    ----------
    runs : int
        Runs of one iteration.

    References
    ----------
    .. [1] OpenTURNS, StandardSpaceCrossEntropyImportanceSampling.
    .. [2] R. Rubinstein, D. Kroese, The Cross-Entropy Method, 2004.
    """

    def of_state(ot: Any, event: Any) -> Any:
        method = ot.StandardSpaceCrossEntropyImportanceSampling(event, 0.2)
        method.setMaximumOuterSampling(runs // 100)
        method.setBlockSize(100)
        return method

    return _state_by_state(model, n_variables, states, bound, seed, of_state)


def subset_simulation(
    model: Model, n_variables: int, states: FailureStates, bound: float, *, seed: int = 1,
    runs: int = 2000,
) -> Checked:  # fmt: skip
    """Return the probability by subset simulation.

    Parameters
    ----------
    runs : int
        Runs of one level. The stated error is too small: it counts chains as independent.

    References
    ----------
    .. [1] OpenTURNS, SubsetSampling.
    .. [2] S.-K. Au, J. Beck, Estimation of small failure probabilities in high dimensions by
       subset simulation, Prob. Eng. Mech. 16 (2001) 263-277.
    """

    def of_state(ot: Any, event: Any) -> Any:
        method = ot.SubsetSampling(event)
        method.setConditionalProbability(0.1)
        method.setMinimumProbability(IMPOSSIBLE)
        # blocks longer than p0 N would share their seeds and not come to an end
        method.setBlockSize(100)
        method.setMaximumOuterSampling(runs // 100)
        return method

    return _state_by_state(model, n_variables, states, bound, seed, of_state)


def _state_by_state(
    model: Model, n_variables: int, states: FailureStates, bound: float, seed: int, of_state: Any
) -> Checked:
    ot = _openturns()
    ot.RandomGenerator.SetSeed(seed)  # it has one generator for everything
    total = variance = 0.0
    count = 0
    for failed, weight in zip(states.failed, states.weight, strict=True):
        calls = _Calls(model, failed)
        function = ot.PythonFunction(n_variables, 1, func_sample=calls)
        vector = ot.RandomVector(ot.Normal(n_variables))
        event = ot.ThresholdEvent(
            ot.CompositeRandomVector(function, vector), ot.LessOrEqual(), bound
        )
        plain = calls.share_below(bound, n_variables, seed)
        if plain > 0.2:
            # common enough within this state: count
            p, own = plain, plain * (1.0 - plain) / calls.PLAIN
        else:
            method = of_state(ot, event)
            p, own = _estimate(method)
        total += weight * p
        variance += weight**2 * own
        count += calls.runs
    return Checked(total, math.sqrt(variance), count)


def _estimate(method: Any) -> tuple[float, float]:
    try:
        method.run()
    except RuntimeError as error:
        if "too small" not in str(error):
            raise
        return 0.0, 0.0
    result = method.getResult()
    return result.getProbabilityEstimate(), result.getVarianceEstimate()


class _Calls:
    """The model in one failure state, as OpenTURNS calls it."""

    PLAIN = 2000

    def __init__(self, model: Model, failed: NDArray[np.bool_]) -> None:
        self.model, self.failed, self.runs = model, failed, 0

    def __call__(self, sample: Any) -> FloatArray:
        normals = np.asarray(sample)
        self.runs += len(normals)
        failed = np.broadcast_to(self.failed, (len(normals), len(self.failed)))
        return np.asarray(self.model(normals, failed), dtype=float)[:, None]

    def share_below(self, bound: float, n_variables: int, seed: int) -> float:
        generator = np.random.Generator(np.random.SFC64(seed))
        normals = generator.standard_normal((self.PLAIN, n_variables))
        return float(np.mean(self(normals)[:, 0] <= bound))


def _openturns() -> Any:
    try:
        import openturns
    except ImportError:
        cure = "pip install 'railgrip[rare]'"
        raise RailgripError(Problem("", "openturns is not installed", cure=cure)) from None
    openturns.Log.Show(openturns.Log.NONE)
    return openturns
