"""Does the plant's K_dry at EBCL 0 to 4 agree with a million plain stops of the same trains?

Every stop of the eight-axle unit of EN 14531-1 is stepped in time by the engine; units fail and
quantities scatter as in the shipped safety case. The stops are kept chunk by chunk, so that a run
that was broken off goes on where it was. Beside it stands the estimate by importance sampling from
a few thousand stops of the same plant, and what a million stops cost.

    python studies/plant_brute_force.py [--runs N] [--folder FOLDER] [--threads N] [--out FOLDER]
"""

from __future__ import annotations

import argparse
import json
import platform
import resource
import time
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.safety.case import find_case, read_safety_case
from railgrip.campaign.safety.factors import dry_factor
from railgrip.campaign.safety.plant import Plant
from railgrip.campaign.safety.train_layout import Layout, layout_of
from railgrip.core.atomic import write_aside

ROOT = Path(__file__).resolve().parents[1]
SPEED = 100 / 3.6
CHUNK, SEED = 5_000, 1
RARE_RUNS = 9_000
LEVELS = (0, 1, 2, 3, 4)


def plant_model(threads: int) -> tuple[Any, Layout]:
    """Return the factor of each train on the plant, and how trains are drawn."""
    case = read_safety_case(find_case("emu_en14531"))
    layout = layout_of(case)
    stop = Plant(case, layout, SPEED, threads=threads)
    distance, response = stop.nominal()
    return dry_factor(stop, layout, distance - SPEED * response, response), layout


def chunk(model: Any, layout: Layout, number: int, stops: int = CHUNK) -> np.ndarray:
    """Return the factors of one chunk of plain stops, or of its first; the number says which."""
    generator = np.random.Generator(np.random.Philox([SEED, number]))
    chances = layout.states.weight / layout.states.weight.sum()
    state = generator.choice(len(chances), CHUNK, p=chances)
    normals = generator.standard_normal((CHUNK, layout.n_variables))
    factors: np.ndarray = model(normals[:stops], layout.states.failed[state[:stops]])
    return factors


def count(runs: int, folder: Path, threads: int) -> tuple[np.ndarray, float, float]:
    """Return factors of that many stops, and wall and CPU seconds they took; resumes."""
    folder.mkdir(parents=True, exist_ok=True)
    model, layout = plant_model(threads)
    chunk_count = -(-runs // CHUNK)
    for number in range(chunk_count):
        part = folder / f"{number:06d}.npz"
        if part.exists():
            continue
        wall, cpu = time.perf_counter(), time.process_time()
        factors = chunk(model, layout, number)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        with write_aside(part) as aside, Path(aside).open("wb") as file:
            np.savez(file, factors=factors, seconds=np.array([wall, cpu]))
        print(f"\r{(number + 1) * CHUNK} of {runs} stops", end="", flush=True)
    print()
    parts = [np.load(folder / f"{number:06d}.npz") for number in range(chunk_count)]
    seconds = np.sum([part["seconds"] for part in parts], axis=0)
    return np.concatenate([part["factors"] for part in parts])[:runs], *map(float, seconds)


def compare(factors: np.ndarray, threads: int) -> list[dict[str, float]]:
    """Return for each level the estimate, and how many plain stops lie below it and its ends."""
    model, layout = plant_model(threads)
    found = rare_quantiles(
        model, layout.n_variables, layout.states, owner=layout.owner, runs=RARE_RUNS
    )
    rows = []
    for level in LEVELS:
        one, p = found.quantile[level], float(found.probability[level])
        below = [int(np.count_nonzero(factors <= k)) for k in (one.low, one.value, one.high)]
        rows.append(
            {"level": level, "probability": p, "k_dry": one.value, "low": one.low,
             "high": one.high, "below_low": below[0], "below": below[1], "below_high": below[2],
             "k_dry_counted": float(np.quantile(factors, p, method="inverted_cdf"))}
        )  # fmt: skip
    return rows


def main() -> None:
    """Count, compare, print, and keep the result."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n\n")[0])
    parser.add_argument("--runs", type=int, default=1_000_000, help="plain stops")
    parser.add_argument("--folder", type=Path, default=Path("out/plant_brute_force"))
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--out", type=Path, default=ROOT / "studies/results")
    chosen = parser.parse_args()
    factors, wall, cpu = count(chosen.runs, chosen.folder, chosen.threads)
    rows = compare(factors, chosen.threads)
    for row in rows:
        n = row["below"]
        print(f"EBCL {row['level']}: K_dry {row['k_dry']:.4f} ({row['low']:.4f} … "
              f"{row['high']:.4f}), counted {row['k_dry_counted']:.4f}; {row['probability']:g} "
              f"asked, {n / chosen.runs:.3g} ± {n**0.5 / chosen.runs:.1g} counted")  # fmt: skip
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{chosen.runs} stops: {wall:.0f} s on {chosen.threads} threads, "
          f"{chosen.runs / cpu:.0f} a second and core, {peak:.0f} MiB")  # fmt: skip
    content = {
        "command": f"python studies/plant_brute_force.py --runs {chosen.runs}",
        "version": railgrip.__version__, "seed": SEED, "runs": chosen.runs,
        "estimated_from": RARE_RUNS, "machine": platform.machine(), "threads": chosen.threads,
        "wall": wall, "cpu": cpu, "memory_mib": peak, "levels": rows,
    }  # fmt: skip
    chosen.out.mkdir(parents=True, exist_ok=True)
    text = json.dumps(content, indent=1)
    (chosen.out / "plant_brute_force.json").write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
