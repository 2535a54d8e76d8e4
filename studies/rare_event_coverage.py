"""Do the intervals of rare quantiles hold as often as they say? Thirty seeds, exact cases.

For each case and seed all ten levels are estimated from one sample and compared with the closed
quantile. Counted are 95 % intervals that hold, pooled over seeds and levels, and seeds in which all
ten simultaneous ones do. Beside it: brute force on the EN 14531 formula.

    python studies/rare_event_coverage.py [--quick] [--brute RUNS] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import importlib.util
import json
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.rare.cross_checks import BATCH
from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.rare.failures import failure_states
from railgrip.campaign.safety.case import find_case, read_safety_case
from railgrip.campaign.safety.factors import dry_factor
from railgrip.campaign.safety.formula import Formula
from railgrip.campaign.safety.train_layout import layout_of

ROOT = Path(__file__).resolve().parents[1]
SEEDS, QUICK_SEEDS, RUNS = 30, 5, 9000
CASES = {
    "16 units, q 1e-3, c 5 %": ([1 / 16] * 16, [1e-3] * 16, 0.05),
    "16 units, q 1e-3, c 3 %": ([1 / 16] * 16, [1e-3] * 16, 0.03),
    "8 units, q 1e-2, c 8 %": ([1 / 8] * 8, [1e-2] * 8, 0.08),
    "12 units, q 1.1e-3, c 3 %": ([1 / 12] * 12, [1.1e-3] * 12, 0.03),
    "4 units, q 1e-4, c 10 %": ([1 / 4] * 4, [1e-4] * 4, 0.1),
    "16 units, q 0.2, c 5 %": ([1 / 16] * 16, [0.2] * 16, 0.05),
    "8 units, forces 1:3, q 1e-4 … 1e-2": (
        list(np.linspace(0.5, 1.5, 8) / 8), list(np.geomspace(1e-4, 1e-2, 8)), 0.05),
    "16 units, EBCL 4 in the gap, c 0.5 %": ([1 / 16] * 16, [9.1917e-4] * 16, 0.005),
}  # fmt: skip


def exact_module() -> Any:
    """Return the closed forms of the reference tests."""
    place = ROOT / "tests/reference/rare_events/exact.py"
    spec = importlib.util.spec_from_file_location("exact", place)
    module = importlib.util.module_from_spec(spec)  # type: ignore[arg-type]
    spec.loader.exec_module(module)  # type: ignore[union-attr]
    return module


def several() -> dict[str, tuple[Any, int, int, Any]]:
    """Return cases that fall in several directions: result, normal numbers, units, exact form.

    The share of failed units, each failed with 10⁻³, comes off every result.
    """
    form = exact_module()
    mean, spread = np.array([1.0, 1.02, 1.1]), np.array([0.03, 0.04, 0.06])
    share = 8**-0.5
    return {
        "least of three, spreads 3, 4, 6 %": (
            lambda u: np.min(mean + spread * u, axis=1), 3, 8, form.least_of(mean, spread)),
        "least of three bogies of eight, 24 variables": (
            lambda u: np.min(1.0 + 0.1 * u.reshape(len(u), 3, 8).mean(axis=2), axis=1), 24, 8,
            form.least_of([1.0] * 3, [0.1 * share] * 3)),
        "least of five, 5 %": (
            lambda u: np.min(1.0 + 0.05 * u, axis=1), 5, 8, form.least_of([1.0] * 5, [0.05] * 5)),
        "too much or too little, 8 variables": (
            lambda u: 1.0 - 0.1 * np.abs(u.mean(axis=1)), 8, 4, form.two_sided(0.1 * share)),
        "distance from the centre, 3 variables": (
            lambda u: 1.0 - 0.01 * (u**2).sum(axis=1), 3, 4, form.distance_of(3, 0.01)),
        "distance from the centre, 10 variables": (
            lambda u: 1.0 - 0.01 * (u**2).sum(axis=1), 10, 4, form.distance_of(10, 0.01)),
    }  # fmt: skip


def study(seeds: int, cases: dict[str, Any] = CASES) -> dict[str, Any]:
    """Return coverage and widths of each case of unequal or equal units."""
    rows = {}
    for name, (forces, chances, spread) in cases.items():
        share = np.asarray(forces)
        exact = exact_module().quantiles(share, chances, spread)
        alike = len(set(forces)) == len(set(chances)) == 1
        states = failure_states(chances, ["unit"] * len(share) if alike else None)

        def model(normals: Any, failed: Any, share: Any = share, spread: float = spread) -> Any:
            return (share * (1.0 + spread * normals) * ~failed).sum(axis=1)

        rows[name] = counted(model, len(share), states, exact, seeds, range(len(share)))
    return rows


def study_several(seeds: int, names: Any = None) -> dict[str, Any]:
    """Return coverage and widths of each case that falls in several directions."""
    rows, cases = {}, several()
    for name in names or cases:
        result, variables, units, form = cases[name]
        states = failure_states([1e-3] * units, ["unit"] * units)
        exact = exact_module().of_units(units, 1e-3, form)

        def model(normals: Any, failed: Any, result: Any = result) -> Any:
            return result(normals) - failed.mean(axis=1)

        rows[name] = counted(model, variables, states, exact, seeds, None)
    return rows


def counted(
    model: Any, variables: int, states: Any, exact: list[float], seeds: int, owner: Any
) -> dict[str, Any]:
    """Return how often intervals hold; those that stay open hold everything and count apart."""
    each, every, widths, refused, runs = [], [], [], [], 0
    for seed in range(1, seeds + 1):
        found = rare_quantiles(model, variables, states, runs=RUNS, seed=seed, owner=owner)
        pairs = list(zip(found.quantile, exact, strict=True))
        each.append([q.low <= k <= q.high for q, k in pairs])
        every.append(all(q.low_all <= k <= q.high_all for q, k in pairs))
        refused.append([not np.isfinite(q.high - q.low) for q in found.quantile])
        widths.append([0.5 * (q.high - q.low) for q in found.quantile])
        runs = found.runs
    is_open = np.array(refused)
    closed = np.ma.masked_array(widths, is_open)  # type: ignore[no-untyped-call]
    return {
        "exact": exact,
        "coverage": float(np.mean(each)),
        "coverage_by_level": np.mean(each, axis=0).tolist(),
        "simultaneous": int(sum(every)),
        "not_resolved": is_open.mean(axis=0).tolist(),
        "half_width": closed.mean(axis=0).tolist(),
        "runs": runs,
    }


def brute(runs: int) -> list[dict[str, float]]:
    """Count plain runs of the EN 14531 formula below the quantiles of EBCL 3 … 6."""
    case = read_safety_case(find_case("emu_en14531"))
    layout = layout_of(case)
    stop = Formula(case, layout, 100 / 3.6)
    distance, response = stop.nominal()
    model = dry_factor(stop, layout, distance - stop.speed * response, response)
    found = rare_quantiles(
        model, layout.n_variables, layout.states, owner=layout.owner, runs=100_000
    )
    bounds = [found.quantile[level].value for level in (3, 4, 5, 6)]
    generator = np.random.Generator(np.random.SFC64(7))
    chances = layout.states.weight / layout.states.weight.sum()
    hits = np.zeros(4)
    for first in range(0, runs, BATCH):
        size = min(BATCH, runs - first)
        row = generator.choice(len(chances), size, p=chances)
        normals = generator.standard_normal((size, layout.n_variables))
        results = model(normals, layout.states.failed[row])
        hits += [np.count_nonzero(results <= bound) for bound in bounds]
    return [
        {"level": level, "bound": bound, "probability": 10.0**-level, "runs": runs,
         "brute": float(n / runs), "error": float(np.sqrt(n) / runs)}
        for level, bound, n in zip((3, 4, 5, 6), bounds, hits, strict=True)
    ]  # fmt: skip


def main() -> None:
    """Study, print, and keep the results."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="a few seeds")
    parser.add_argument("--brute", type=int, default=20_000_000, help="plain runs of the formula")
    parser.add_argument("--out", type=Path, default=ROOT / "studies/results")
    chosen = parser.parse_args()
    seeds = QUICK_SEEDS if chosen.quick else SEEDS
    rows, split = study(seeds), study_several(seeds)
    for name, row in (rows | split).items():
        print(f"{name}: {row['coverage']:.3f}, simultaneous {row['simultaneous']} of {seeds}, "
              f"EBCL 4 ± {row['half_width'][4]}, EBCL 9 ± {row['half_width'][9]}, "
              f"not resolved {100 * np.mean(row['not_resolved']):.0f} %")  # fmt: skip
    plain = brute(100_000 if chosen.quick else chosen.brute)
    for one in plain:
        print(f"EBCL {one['level']}: {one['probability']:g}, brute force {one['brute']:.3g} "
              f"± {one['error']:.1g}")  # fmt: skip
    content = {
        "command": "python studies/rare_event_coverage.py", "version": railgrip.__version__,
        "seeds": seeds, "runs": RUNS, "cases": rows, "several_directions": split,
        "brute_force": plain,
    }  # fmt: skip
    if not chosen.quick:
        chosen.out.mkdir(parents=True, exist_ok=True)
        text = json.dumps(content, indent=1)
        (chosen.out / "rare_event_coverage.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
