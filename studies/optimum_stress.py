"""Does the optimum hold on any line, with any train, at any time?

Random journeys (steep, with many limits and tunnels, with and without regeneration, long trains,
weak trains that climb by their run-up) and every shipped line with every train, each at 15 times
from the least possible to twice that. Looked for in each: a time that is not met; energy that
rises with time; a saving by a second that grows with time; a limit that is passed; an energy that
an integration of its own over the same speeds does not give; a rule that needs less.

    python studies/optimum_stress.py [--journeys 300] [--out studies/results]

Journey k of a kind is drawn with seed k. A row a journey goes to `optimum_stress.csv`.
"""

from __future__ import annotations

import argparse
import csv
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from railgrip import __version__, data
from railgrip.campaign.optimum.leg import LegProblem
from railgrip.core.errors import RailgripError
from railgrip.engine.journey.coasting import coasting_of
from railgrip.engine.journey.drive import drive
from railgrip.scenario.journey import Journey

SHARES = (0.0, 1e-4, 1e-3, 5e-3, 0.01, 0.02, 0.03, 0.05, 0.08, 0.1, 0.15, 0.2, 0.35, 0.5, 1.0)
FIELDS = ("journey", "nodes", "least_time", "time_off", "rise", "price_rise", "overspeed",
          "overpull", "integral_off", "rule_below")  # fmt: skip
KINDS = {"strong": ((0.25, 1.3), (4.0, 22.0)), "weak": ((0.08, 0.4), (1.5, 8.0))}
"""Greatest force and power over the mass, m/s² and W/kg."""
UNLIMITED = ("curves", "downhill_10", "downhill_20", "level", "uphill_10", "uphill_20")
"""Shipped lines without speed limits: for brakes, not for journeys."""
RULES = ({"coasting_deceleration": 0.05}, {"coasting_deceleration": 0.15},
         {"coasting_deceleration": 0.1, "action": "reduced"})  # fmt: skip


def random_journey(kind: str, seed: int) -> dict[str, Any]:
    """Draw the description of a journey of one leg."""
    draw = np.random.default_rng((seed, list(KINDS).index(kind)))
    length = float(draw.uniform(1.5e3, 40e3))

    def marks(mean: float) -> list[float]:
        places = draw.uniform(50.0, length - 50.0, draw.poisson(length / mean))
        return [0.0, *np.unique(np.round(places, 1)).tolist()]

    limits, slopes = marks(draw.choice([300, 1500, 5000])), marks(draw.choice([200, 800, 3000]))
    fast, steep = draw.choice([25.0, 45.0, 60.0]), draw.choice([5e-3, 15e-3, 30e-3])
    tunnels: list[dict[str, float]] = []
    at = 0.0
    while draw.random() < 0.6:
        begin = at + draw.uniform(100.0, 4000.0)
        at = begin + draw.uniform(100.0, 5000.0)
        if at < length:
            area = float(draw.uniform(25.0, 80.0))
            tunnels.append({"from": float(begin), "to": float(at), "cross_section": area})
    return {
        "train": random_train(draw, *KINDS[kind]),
        "gradient_under": str(draw.choice(["front", "train"])),
        "line": {
            "length": length,
            "speed_limit": [{"at": x, "value": float(draw.uniform(8.0, fast))} for x in limits],
            "gradient": [
                {"at": x, "value": float(np.clip(draw.normal(0.0, steep), -0.045, 0.045))}
                for x in slopes
            ],
            "tunnel": tunnels,
        },
    }


def random_train(draw: Any, pull: tuple[float, ...], pace: tuple[float, ...]) -> dict[str, Any]:
    """Draw a train; ``pull`` and ``pace`` bound force and power over the mass."""
    mass = float(draw.choice([60e3, 150e3, 400e3, 1200e3]))
    force, power = mass * float(draw.uniform(*pull)), mass * float(draw.uniform(*pace))
    train = {
        "mass": mass,
        "rotating": float(draw.uniform(0.0, 0.12)),
        "length": float(draw.choice([0.0, 100.0, 400.0, 700.0])),
        "rear_clears": bool(draw.random() < 0.7),
        "max_speed": float(draw.uniform(20.0, 70.0)),
        "resistance": {
            "constant": mass * float(draw.uniform(0.005, 0.03)),
            "linear": mass * float(draw.uniform(0.0, 4e-4)),
            "quadratic": mass * float(draw.uniform(1e-5, 6e-5)),
        },
        "tunnel_resistance": [
            {"cross_section": 30.0, "quadratic": mass * 4e-5},
            {"cross_section": 70.0, "quadratic": mass * 1e-5},
        ],
        "effort": {"force": force, "power": power},
        "max_deceleration": float(draw.uniform(0.3, 1.0)),
        "efficiency": {
            "traction": float(draw.uniform(0.7, 1.0)),
            "regeneration": float(draw.uniform(0.5, 1.0)),
        },
    }
    if draw.random() < 0.6:
        brake = {"force": force * float(draw.uniform(0.3, 1.2)),
                 "power": power * float(draw.uniform(0.3, 1.5))}  # fmt: skip
        train["regeneration"] = brake
        if draw.random() < 0.5:
            train["regeneration"] = {**brake, "fade_start": 3.0, "fade_end": 1.0}
    if draw.random() < 0.5:
        train["friction_brake"] = mass * float(draw.uniform(1.0, 1.5))
    if draw.random() < 0.4:
        train["max_acceleration"] = float(draw.uniform(0.2, 1.0))
    if draw.random() < 0.2:
        speeds = np.linspace(0.0, train["max_speed"] + 1.0, 12)
        rows = [{"speed": v, "force": min(force, power / max(v, 0.1))} for v in speeds.tolist()]
        between = str(draw.choice(["linear", "held"]))
        train["effort"] = {"table": rows, "between": between}
    return train


def integrated(journey: Journey, leg: LegProblem, square: Any, parts: int = 8) -> float:
    """Integrate the energy over the speeds of a run anew, straight from the description, J."""
    train, line, x = journey.train, journey.line, leg.position
    share = (np.arange(parts) + 0.5) / parts
    place = (x[:-1, None] + np.diff(x)[:, None] * share).ravel()
    v2 = 100.0 * (square[:-1, None] + np.diff(square)[:, None] * share).ravel()
    rate = np.repeat(50.0 * np.diff(square) / np.diff(x), parts)
    height_at = np.array([0.0, *(p.at for p in line.gradient), line.length])
    grade = np.array([0.0, *(p.value for p in line.gradient)])
    height = np.concatenate([[0.0], np.cumsum(grade * np.diff(height_at))])
    back = train.length if journey.gradient_under == "train" else 0.0

    def altitude(at: Any) -> Any:
        # before the line its first gradient goes on
        first = line.gradient[0].value if line.gradient and line.gradient[0].at == 0.0 else 0.0
        return np.where(at < 0.0, first * at, np.interp(at, height_at, height))

    reach = max(back, 1e-3)
    slope = (altitude(place + reach - back) - altitude(place - back)) / reach
    drag = np.full(place.size, train.resistance.quadratic)
    for tube in line.tunnel:
        inside = (tube.begin <= place) & (place < tube.end)
        drag[inside] += train.tunnel_quadratic(tube.cross_section)
    force = train.dynamic_mass * rate + train.mass * 9.81 * slope
    force += train.resistance.constant + train.resistance.linear * np.sqrt(v2) + drag * v2
    # a coasting train is not driven and braked by turns within an interval: its mean force counts
    force = force.reshape(-1, parts).mean(axis=1)
    motor = np.minimum(
        np.maximum(-force, 0.0), leg_motor(train, v2.reshape(-1, parts).mean(axis=1))
    )
    drawn = np.maximum(force, 0.0) / train.efficiency.traction
    back_to_net = motor * train.efficiency.regeneration * train.regeneration.receptivity
    return float(np.sum((drawn - back_to_net) * np.diff(x)))


def leg_motor(train: Any, v2: Any) -> Any:
    """Return the most that the motors brake with, N."""
    brake, v = train.regeneration, np.sqrt(v2)
    if brake.force == 0.0 or brake.power == 0.0:
        return np.zeros(v.size)
    force = np.minimum(brake.force, brake.power / v)
    if brake.fade_start > 0.0:
        faded = (v - brake.fade_end) / (brake.fade_start - brake.fade_end)
        force = np.minimum(force, brake.force * np.clip(faded, 0.0, 1.0))
    return force


def looked_at(name: str, journey: Journey, begin: float, end: float, rules: bool) -> list[Any]:
    """Return the row of a journey: the worst of all its times."""
    leg = LegProblem(journey, begin, end, 0.0, 0.0)
    least, shares = leg.least_time, np.array(SHARES)
    runs = [leg.for_time(least * (1.0 + share)) for share in SHARES]
    energy = np.array([leg.energy_of(run) for run in runs])
    times = np.array([leg.time_of(run.square) for run in runs])
    whole = max(float(np.abs(energy).max()), 1.0)
    saving = -np.diff(energy) / np.diff(shares) / whole
    slack = 2e-5 / np.diff(shares)[1:]  # what the optimum's own tolerance is worth
    rises, dearer = np.diff(energy) / whole, np.diff(saving) - 1e-3 * np.abs(saving[:-1]) - slack
    fast = max(np.max(run.square / leg.grid.limit) for run in runs)
    pull = max(np.max(leg.traction_of(run) / effort_on(leg, run.square)) for run in runs)
    again = np.array([integrated(journey, leg, run.square) for run in runs])
    found = (
        np.max(np.abs(times / least - 1.0 - shares)), max(np.max(rises), 0.0),
        max(np.max(dearer), 0.0), max(fast - 1.0, 0.0), max(pull - 1.0, 0.0),
        np.max(np.abs(again - energy)) / whole, rule_below(journey, leg) if rules else 0.0,
    )  # fmt: skip
    return [name, leg.position.size, f"{least:.3f}", *(f"{value:.1e}" for value in found)]


def effort_on(leg: LegProblem, square: Any) -> Any:
    """Return the effort in the intervals of a grid, as its description says."""
    pieces, v = leg.grid.effort, np.sqrt(0.5 * (square[1:] + square[:-1]))
    i = np.clip(np.searchsorted(pieces[:, 0], v, "right") - 1, 0, None)
    open_here = pieces[i, 1] + pieces[i, 2] * v + pieces[i, 3] / v
    return np.maximum(np.minimum(open_here, leg.grid.bounds[2]), 1e-3)


def rule_below(journey: Journey, leg: LegProblem) -> float:
    """Return by how much of its energy the best rule lies below the optimum of its time."""
    worst = 0.0
    for rule in RULES:
        own = Journey.model_validate({**journey.model_dump(by_alias=True), "coasting": rule})
        try:
            run = drive(own, coasting_of(own))
        except RailgripError:
            continue  # brakes too weak for the braking curve, or left standing
        best = leg.energy_of(leg.for_time(max(run.running_time, leg.least_time)))
        needed = run.energy["pantograph"] - run.energy["auxiliaries"]
        worst = max(worst, (best - needed) / max(abs(needed), 3.6e6))
    return worst


def shipped() -> list[tuple[str, Journey, float, float, bool]]:
    """Return the first legs of every shipped line with every shipped train."""
    found = []
    for train in data.names("point_trains"):
        for line in data.names("lines"):
            if line in UNLIMITED:
                continue
            journey = Journey(train=train, line=line)
            stops = [stop.at for stop in journey.stops()]
            for begin, end in [*pairwise(stops)][:2]:
                whole = len(stops) == 2
                found.append((f"{train} {line} {begin:.0f}", journey, begin, end, whole))
    return found


def main() -> None:
    """Look at all and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--journeys", type=int, default=300, help="random ones of each kind")
    parser.add_argument("--out", type=Path, default=Path("studies/results"), help="folder")
    given = parser.parse_args()
    tasks = shipped()
    for kind in KINDS:
        for seed in range(given.journeys):
            journey = Journey(**random_journey(kind, seed))
            tasks.append((f"{kind} {seed}", journey, 0.0, journey.line.length, True))
    rows, refused = [], 0
    for task in tasks:
        try:
            rows.append(looked_at(*task))
        except RailgripError as error:
            refused += 1
            print(task[0], error)
    with (given.out / "optimum_stress.csv").open("w", encoding="utf-8", newline="") as file:
        file.write(f"# railgrip {__version__}, python studies/optimum_stress.py --journeys "
                   f"{given.journeys}; {refused} cannot climb or stop\n")  # fmt: skip
        table = csv.writer(file)
        table.writerow(FIELDS)
        table.writerows(rows)
    for k, name in enumerate(FIELDS[3:], 3):
        row = max(rows, key=lambda row, k=k: float(row[k]))
        print(f"{name}: at most {row[k]} ({row[0]}) of {len(rows)}")


if __name__ == "__main__":
    main()
