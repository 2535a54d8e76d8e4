"""How well identification gets back pads that are known, and fits laws that are published.

    python studies/identification.py            200 trials; writes results/identification.json, .md
    python studies/identification.py --quick    a few trials, nothing written

Each trial is a programme of synthetic stops (railgrip.laboratory.pad_fit.synthetic): noise that is
correlated within a stop, an offset of 3 % per stop, a temperature sensor with a lag that is fitted,
outliers. Counted is how often each 95 % interval holds the truth.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950
from railgrip.laboratory.pad_fit import INFLUENCES, Plan, Shape, compare_laws, identify_pad
from railgrip.laboratory.pad_fit.laws import Lags
from railgrip.laboratory.pad_fit.parameters import REFERENCE
from railgrip.laboratory.pad_fit.synthetic import (
    ORGANIC_POINTS,
    PadLaw,
    Programme,
    organic,
    product_law,
    synthetic_stops,
)

RESULTS = Path(__file__).parent / "results"
SEED = 20_000
TRIALS, QUICK_TRIALS = 200, 4
MODEL_TRIALS, QUICK_MODEL_TRIALS = 12, 1
LEAST_COVERAGE, LEAST_MEAN = 0.90, 0.93

LEVEL = {name: [(REFERENCE[name], 1.0)] for name in INFLUENCES}


def truth() -> dict[str, float]:
    """The parameters of the pad that made the stops."""
    found = {"reference_friction": 0.37, "temperature_lag": Programme().lag}
    for name, points in ORGANIC_POINTS.items():
        at_reference = float(np.interp(REFERENCE[name], *zip(*points, strict=True)))
        found["reference_friction"] *= at_reference
        factors = [y / at_reference for _, y in points]
        for k, (x, _) in enumerate(points):
            found[f"{name}_point_{k + 1}"] = x
            found[f"{name}_factor_{k + 1}"] = factors[k]
        found[f"{name}_slope_1"] = (factors[1] - factors[0]) / (points[1][0] - points[0][0])
    return found


def trial(seed: int) -> dict[str, tuple[bool, bool, float]]:
    """For each parameter: whether the interval, and the naive one, hold the truth; the error."""
    known = truth()
    found = identify_pad(synthetic_stops(organic, Programme(), seed=seed))
    return {
        one.name: (
            bool(one.low <= known[one.name] <= one.high),
            bool(naive.low <= known[one.name] <= naive.high),
            one.value - known[one.name],
        )
        for one, naive in zip(found.parameters, found.naive, strict=True)
        if not one.is_fixed and one.name in known
    }


def coverage(trials: int, tell: Callable[[str], None]) -> dict[str, dict[str, float]]:
    """Share of trials in which each interval holds the truth."""
    rows: dict[str, list[tuple[bool, bool, float]]] = {}
    for number in range(trials):
        for name, row in trial(SEED + number).items():
            rows.setdefault(name, []).append(row)
        tell(f"trial {number + 1} of {trials}")
    return {
        name: {
            "clustered": float(np.mean([one[0] for one in found])),
            "naive": float(np.mean([one[1] for one in found])),
            "mean_error": float(np.mean([one[2] for one in found])),
            "spread": float(np.std([one[2] for one in found])),
            "trials": len(found),
        }
        for name, found in rows.items()
    }


def additive(t: np.ndarray, v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """The quadratic law that the source cites; coefficients illustrative."""
    warm, fast, force = t / 100.0, v / 10.0, f / 10e3
    return np.asarray(
        0.44 - 0.020 * fast + 0.0012 * fast**2 - 0.010 * warm - 0.0015 * warm**2
        - 0.020 * force + 0.0015 * force**2
    )  # fmt: skip


def crossed(t: np.ndarray, v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """A pad that fades with temperature the more, the faster it rubs; illustrative."""
    fade = np.interp(t, [150.0, 350.0], [0.0, 0.25]) * (0.4 + 0.6 * v / 25.0)
    return np.asarray(organic(np.full_like(t, 100.0), v, f) * (1.0 - fade))


def karwatzki(t: np.ndarray, v: np.ndarray, f: np.ndarray) -> np.ndarray:
    """Karwatzki's composite block."""
    law = np.vectorize(lambda a, b: karwatzki_1950(KarwatzkiParameters(), a, b, 20.0))
    return np.asarray(law(f, v))


MAKERS: dict[str, PadLaw] = {
    "constant": product_law(0.37, **LEVEL),
    "I": product_law(0.37, **{**LEVEL, "speed": ORGANIC_POINTS["speed"]}),
    "II": product_law(0.37, **{**ORGANIC_POINTS, "clamp_force": LEVEL["clamp_force"]}),
    "III": organic,
    "quadratic": additive,
}


def told_apart(trials: int, tell: Callable[[str], None]) -> dict[str, dict[str, int]]:
    """How often each law was chosen, by the law that made the stops."""
    counts: dict[str, dict[str, int]] = {}
    for maker, law in MAKERS.items():
        counts[maker] = {}
        for number in range(trials):
            found = identify_pad(synthetic_stops(law, Programme(), seed=SEED + number))
            chosen = next(one.name for one in compare_laws(found) if one.is_chosen)
            counts[maker][chosen] = counts[maker].get(chosen, 0) + 1
        tell(f"stops of {maker}: {counts[maker]}")
    return counts


def published() -> dict[str, dict[str, float]]:
    """Errors of (III) fitted to other laws, without any noise: how far the form itself carries."""
    clean = Programme(stops=150, samples=160, offset=1e-5, noise=1e-5, lag=1e-9, outliers=0.0)
    block = clean._replace(clamp_force=(5e3, 60e3), train_force=9e3)
    cases = {
        "karwatzki, 2 points": (karwatzki, block, Shape(2, "open")),
        "karwatzki, 4 points": (karwatzki, block, Shape(4, "open")),
        "additive quadratic, 2 points": (additive, clean, Shape(2)),
        "additive quadratic, 4 points": (additive, clean, Shape(4, "open")),
        "temperature effect by speed, 2 points": (crossed, clean, Shape(2)),
        "temperature effect by speed, 4 points": (crossed, clean, Shape(4, "open")),
    }
    found = {}
    for name, (law, programme, shape) in cases.items():
        plan = Plan(dict.fromkeys(INFLUENCES, shape), lags=Lags())
        fit = identify_pad(synthetic_stops(law, programme, seed=SEED), plan)
        missed = np.expm1(-fit.fit.residuals[fit.blocks.is_there])
        found[name] = {
            "rms": float(np.sqrt(np.mean(missed**2))),
            "largest": float(np.abs(missed).max()),
            "functions": len(fit.points),
        }
    return found


def judged(found: dict[str, dict[str, float]]) -> dict[str, Any]:
    """What was asked of the intervals, and what is missed."""
    shares = {name: one["clustered"] for name, one in found.items()}
    return {
        "least": min(shares.values()),
        "mean": float(np.mean(list(shares.values()))),
        "naive_mean": float(np.mean([one["naive"] for one in found.values()])),
        "naive_least": min(one["naive"] for one in found.values()),
        "below": sorted(name for name, share in shares.items() if share < LEAST_COVERAGE),
    }


def markdown(stored: dict[str, Any]) -> str:
    """The tables of the documentation."""
    lines = ["| parameter | 95 % interval holds | naive one holds | mean error | spread |",
             "|---|---|---|---|---|"]  # fmt: skip
    for name, one in stored["coverage"].items():
        lines.append(f"| {name} | {one['clustered']:.3f} | {one['naive']:.3f} "
                     f"| {one['mean_error']:.3g} | {one['spread']:.3g} |")  # fmt: skip
    lines += ["", "| stops made by | chosen, of " + str(stored["model_trials"]) + " |", "|---|---|"]
    for maker, counts in stored["told_apart"].items():
        lines.append(f"| {maker} | {', '.join(f'{k} {n}' for k, n in counts.items())} |")
    lines += ["", "| law fitted by (III) | rms error | largest |", "|---|---|---|"]
    for name, one in stored["published"].items():
        lines.append(f"| {name} | {one['rms']:.2%} | {one['largest']:.2%} |")
    return "\n".join(lines) + "\n"


def main() -> int:
    """Run the study and write or print its result."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--trials", type=int, default=TRIALS)
    options = parser.parse_args()
    trials = QUICK_TRIALS if options.quick else options.trials
    model_trials = QUICK_MODEL_TRIALS if options.quick else MODEL_TRIALS

    def tell(words: str) -> None:
        print(words, file=sys.stderr, flush=True)

    found = coverage(trials, tell)
    stored = {
        "command": "python studies/identification.py", "version": railgrip.__version__,
        "seed": SEED, "trials": trials, "model_trials": model_trials,
        "coverage": found, "judged": judged(found),
        "published": published(), "told_apart": told_apart(model_trials, tell),
    }  # fmt: skip
    print(markdown(stored))
    print(stored["judged"])
    if not options.quick:
        text = json.dumps(stored, indent=2) + "\n"
        (RESULTS / "identification.json").write_text(text, encoding="utf-8")
        (RESULTS / "identification.md").write_text(markdown(stored), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
