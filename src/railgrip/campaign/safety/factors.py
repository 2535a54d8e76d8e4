"""The correction factors of a case, and the deceleration and distance that follow from them.

K_dry_rst(V, EBCL) is the quotient of two deceleration distances from V, nominal over real, that a
stop stays above with the confidence of the level. K_wet_rst(V) is the quotient dry over wet.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.stats import t as student

from railgrip.campaign.rare.estimate import RareResult, rare_quantiles
from railgrip.campaign.safety.case import SafetyCase
from railgrip.campaign.safety.draws import trains
from railgrip.campaign.safety.formula import Formula
from railgrip.campaign.safety.plant import Plant
from railgrip.campaign.safety.train_layout import Layout, layout_of
from railgrip.core.errors import Problem, RailgripError

FloatArray = NDArray[np.float64]


class WetFactor(NamedTuple):
    """K_wet_rst from so many stops: estimate, 95 % interval, least of all stops."""

    value: float
    low: float
    high: float
    least: float
    runs: int


class Step(NamedTuple):
    """What was found for one speed step.

    Attributes
    ----------
    speed : upper speed of the step, m/s
    distance, build_up_time : nominal stop from it, m and s
    emergency_deceleration : A_brake_emergency within the step, m/s²
    dry : K_dry_rst of all levels, with its sample
    wet : K_wet_rst, or None
    """

    speed: float
    distance: float
    build_up_time: float
    emergency_deceleration: float
    dry: RareResult
    wet: WetFactor | None


class SafetyFactors(NamedTuple):
    """The whole answer to a case; ``without`` is the one without its brake control."""

    case: SafetyCase
    layout: Layout
    steps: list[Step]
    without: SafetyFactors | None = None


def safety_factors(
    case: SafetyCase,
    *,
    threads: int = 1,
    progress: Callable[[str], None] | None = None,
    without: bool = True,
) -> SafetyFactors:
    """Return K_dry_rst, K_wet_rst and nominal decelerations of a case.

    Parameters
    ----------
    case : SafetyCase
        From `read_safety_case`.
    threads : int
        Threads for runs of the plant.
    progress : callable, optional
        Called with a sentence before each part.
    without : bool
        Whether a case with brake control is also answered without it.

    Notes
    -----
    Deceleration distance: from the brake command, less the distance run until the end of the
    *nominal* equivalent build-up time, D = s − V t_e. A slower filling thus counts in K.

    A_brake_emergency of a step is (V_i² − V_{i−1}²)/(2 (D_i − D_{i−1})), so that the decelerations
    of the steps give the nominal stop from each step's speed exactly.

    References
    ----------
    .. [1] UNISIG SUBSET-026 §3.13 (K_dry_rst, K_wet_rst, A_brake_safe).
    .. [2] UNISIG SUBSET-040 §4.4.1.5 (deceleration distance).
    """
    bare = None
    if without and case.brake_control is not None:
        told = None if progress is None else (lambda part: progress(f"{part}, without control"))
        bare = safety_factors(case.without_control(), threads=threads, progress=told)
    layout = layout_of(case)
    steps: list[Step] = []
    before = (0.0, 0.0)
    for number, speed in enumerate(case.speed_steps):
        if progress is not None:
            progress(f"K_dry from {speed * 3.6:.0f} km/h")
        stop = (
            Formula(case, layout, speed)
            if case.method == "formula"
            else Plant(case, layout, speed, threads=threads)
        )
        distance, response = stop.nominal()
        if not np.isfinite(distance) or distance <= speed * response:
            raise RailgripError(Problem("train", "does not stop with all brakes working"))
        braking = distance - speed * response
        dry = rare_quantiles(
            dry_factor(stop, layout, braking, response), layout.n_variables, layout.states,
            runs=case.runs, seed=case.seed + number, owner=layout.owner,
        )  # fmt: skip
        wet = None
        if case.wet is not None:
            if progress is not None:
                progress(f"K_wet from {speed * 3.6:.0f} km/h")
            wet = _wet(case, layout, speed, threads, case.seed + number)
        mean = (speed**2 - before[0] ** 2) / (2.0 * (braking - before[1]))
        steps.append(Step(speed, distance, response, mean, dry, wet))
        before = (speed, braking)
    return SafetyFactors(case, layout, steps, bare)


def dry_factor(
    stop: Any, layout: Layout, braking: float, response: float
) -> Callable[[FloatArray, NDArray[np.bool_]], FloatArray]:
    """Return the model that `rare_quantiles` asks: nominal over real deceleration distance.

    Parameters
    ----------
    stop : Formula or Plant
        Anything whose ``distance(trains)`` gives stopping distances.
    layout : Layout
        Of the case.
    braking, response : float
        Nominal deceleration distance m and equivalent build-up time s.
    """

    def model(normals: FloatArray, failed: NDArray[np.bool_]) -> FloatArray:
        distances, _ = stop.distance(trains(layout, normals, failed))
        real = np.maximum(distances - stop.speed * response, 1e-3)
        factor: FloatArray = braking / real
        return factor

    return model


def _wet(case: SafetyCase, layout: Layout, speed: float, threads: int, seed: int) -> WetFactor:
    """Return K_wet from the same trains on dry and on wet rail."""
    assert case.wet is not None
    generator = np.random.Generator(np.random.Philox([seed, 1]))
    normals = generator.standard_normal((case.wet.runs, layout.n_variables))
    made = trains(layout, normals, np.zeros((len(normals), len(layout.fails)), dtype=bool))
    dry = Plant(case, layout, speed, threads=threads)
    wet = Plant(case, layout, speed, wet=True, threads=threads)
    _, response = dry.nominal()
    short = dry.distance(made)[0] - speed * response
    long = wet.distance(made)[0] - speed * response
    if not np.isfinite(long).all():
        return WetFactor(0.0, 0.0, 0.0, 0.0, len(long))
    value = float(short.mean() / long.mean())
    error = float(np.std(short - value * long, ddof=1) / np.sqrt(len(long)) / long.mean())
    reach = float(student.ppf(0.975, len(long) - 1)) * error
    return WetFactor(value, value - reach, value + reach, float((short / long).min()), len(long))
