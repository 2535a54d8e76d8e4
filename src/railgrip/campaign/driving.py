"""A journey driven in every way that is asked for, side by side."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from railgrip.campaign.coasting_tuning import (
    TunedCoasting,
    coasting_trade_off,
    share_of_saving,
    tune_coasting,
)
from railgrip.campaign.optimum.timetable import OptimalRun, optimum
from railgrip.campaign.optimum.trade_off import capped_curve, optimal_curve
from railgrip.control.etcs.limit_table import LIMITS
from railgrip.engine.journey.coasting import Indicated, coasting_of, indicators
from railgrip.engine.journey.drive import Intervention, JourneyRun
from railgrip.engine.journey.following import driven_run
from railgrip.engine.journey.legs import legs
from railgrip.engine.journey.watching import Watched, watched
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]
KWH = 3.6e6


class Way(NamedTuple):
    """One way of driving a journey, SI; ``energy`` has the keys of `JourneyRun.energy`.

    ``share`` is how much of the saving possible in its time it makes; nan for the fastest run.
    """

    name: str
    position: Array
    speed: Array
    running_times: Array
    energy: dict[str, float]
    switchings: int
    share: float
    log: list[Indicated]
    watched: Watched | None = None
    interventions: tuple[Intervention, ...] = ()

    @property
    def running_time(self) -> float:
        """Without dwells, s."""
        return float(self.running_times.sum())


class Driven(NamedTuple):
    """All ways of driving a journey, the fastest first, and energy over time of each rule.

    ``early``, s, and ``is_optimal`` are those of the optimum.
    """

    journey: Journey
    ways: list[Way]
    least_time: float
    tuned: TunedCoasting | None
    curves: dict[str, tuple[Array, Array]]
    early: float
    is_optimal: bool

    def remarks(self) -> list[str]:
        """Return what must be said of the optimum, a sentence each."""
        found = []
        if self.early > 0.0:
            found.append(f"The optimum arrives {self.early:.1f} s early: no slower run was found.")
        if self.journey.train.efficiency.map is not None:
            found.append("The optimum is that of the mean efficiencies; its energy counts the map.")
        elif self.early == 0.0 and not self.is_optimal:
            found.append("No optimum was found for this time: a run between its neighbours stands.")
        return found

    @property
    def title(self) -> str:
        """Name for people."""
        journey = self.journey
        return journey.title or f"{journey.train.title} on {journey.line.title}"

    def summary(self) -> list[list[str]]:
        """Return the rows of the table, the head first."""
        head = ["", "time, s", "energy, kWh", "of flat out", "motor brake, kWh",
                "friction brake, kWh", "switchings", "of possible saving"]  # fmt: skip
        whole = self.ways[0].energy["pantograph"]
        rows = [
            [way.name, f"{way.running_time:.1f}", f"{way.energy['pantograph'] / KWH:.2f}",
             f"{way.energy['pantograph'] / whole:.1%}", f"{way.energy['motor_brake'] / KWH:.2f}",
             f"{way.energy['friction'] / KWH:.2f}", str(way.switchings),
             "–" if np.isnan(way.share) else f"{way.share:.0%}"]
            for way in self.ways
        ]  # fmt: skip
        return [head, *rows]

    def pad_wear(self, way: Way) -> float:
        """Return the volume that pads and blocks of the train lose on the way, [m³]."""
        return float(self.journey.train.pad_wear * way.energy["friction"])

    def tuned_rows(self) -> list[list[str]]:
        """Return (parameter, value) of the tuned coasting."""
        assert self.tuned is not None
        assert self.tuned.journey.coasting is not None
        own = self.tuned.journey.coasting.model_dump()
        return [[name, f"{v:.4g}" if isinstance(v, float) else str(v)] for name, v in own.items()]

    def as_table(self) -> dict[str, Any]:
        """Return all figures in SI, by the names of the ways."""
        found: dict[str, Any] = {
            way.name.replace(" ", "_").replace(",", ""): {
                "running_time": way.running_time,
                "energy": way.energy["pantograph"] if way.name == "optimum" else way.energy,
                "pad_wear": self.pad_wear(way),
                "switchings": way.switchings,
                "share_of_saving": None if np.isnan(way.share) else way.share,
                "log": [one._asdict() for one in way.log],
                **_supervised_table(way),
            }
            for way in self.ways
        }
        found["optimum"]["least_time"] = self.least_time
        found["optimum"]["early"], found["optimum"]["is_optimal"] = self.early, self.is_optimal
        if self.tuned is not None and self.tuned.journey.coasting is not None:
            found["coasting_tuned"]["parameters"] = self.tuned.journey.coasting.model_dump()
        return found


def driven(journey: Journey, *, tune: bool = False, seed: int = 1) -> Driven:
    """Drive a journey flat out, with its coasting, with tuned coasting if asked, and at best.

    Behind a ``leader`` all but the optimum follow it, and under a ``supervision`` all but the
    optimum obey it; the optimum has the line for itself, so it is a bound for them too.

    Parameters
    ----------
    journey : Journey
        Train, line, stops, maybe ``coasting``, and the time asked for.
    tune : bool
        Whether coasting parameters are searched for the time asked for.
    seed : int
        Of the search.

    Examples
    --------
    >>> found = driven(Journey(train="local", line="const", supplement=0.1, coasting={}))
    >>> [way.name for way in found.ways]
    ['flat out', 'coasting', 'optimum']
    """
    flat_out = driven_run(journey)
    best = optimum(journey)
    ways = [_way("flat out", flat_out, np.nan)]
    curve = optimal_curve(journey)
    curves = {
        "optimum": curve,
        "full power to a lower top speed": capped_curve(journey, float(curve[0].max())),
    }
    tuned = None
    if journey.coasting is not None:
        run = driven_run(journey, coasting_of(journey))
        in_time = optimum(journey, max(run.running_time, flat_out.running_time))
        share = share_of_saving(run, flat_out, in_time)
        ways.append(_way("coasting", run, share, indicators(run)))
        if journey.leader is None:
            curves["coasting, flatter and flatter"] = coasting_trade_off(journey)
    if tune:
        tuned = tune_coasting(journey, max(best.running_time, flat_out.running_time), seed=seed)
        ways.append(_way("coasting, tuned", tuned.run, tuned.share, indicators(tuned.run)))
    ways.append(_best(journey, best))
    least = float(best.least_times.sum())
    return Driven(journey, ways, least, tuned, curves, best.early, best.is_optimal)


def _supervised_table(way: Way) -> dict[str, Any]:
    """Return what the supervision says of a way of driving, nan as None."""
    if way.watched is None:
        return {}

    def known(value: float) -> float | None:
        return None if np.isnan(value) else float(value)

    approaches = [
        {"target": one.target, "target_speed": one.target_speed, "kind": one.kind,
         "passed": {n: known(x) for n, x in zip(LIMITS, one.passed, strict=True)},
         "margin": {n: known(x) for n, x in zip(LIMITS, one.margin, strict=True)}}
        for one in way.watched.approaches
    ]  # fmt: skip
    log = [{**one._asdict(), "target": known(one.target)} for one in way.watched.log]
    braked = [{**one._asdict(), "target": known(one.target)} for one in way.interventions]
    return {"supervision": {"log": log, "approaches": approaches, "interventions": braked}}


def _way(name: str, run: JourneyRun, share: float, log: list[Indicated] | None = None) -> Way:
    trace = run.trace
    said = None
    if run.journey.supervision is not None:
        said = watched(run.journey, trace["time"], trace["position"], trace["speed"], run.told)
    return Way(name, trace["position"], trace["speed"], run.running_times, run.energy,
               run.switchings, share, log or [], said, tuple(run.interventions))  # fmt: skip


def _best(journey: Journey, best: OptimalRun) -> Way:
    steps = np.diff(best.position)
    pulls = np.concatenate([[False], best.traction > 1.0, [False]])
    train = journey.train
    energy = {
        "traction": float(best.traction @ steps),
        "motor_brake": float(best.motor_brake @ steps),
        "friction": float(best.friction @ steps),
        "auxiliaries": train.auxiliaries * float(best.time[-1]),
        "pantograph": best.energy,
    }
    said = None
    if journey.supervision is not None:
        told = [(int(np.searchsorted(best.position, leg.begin)), leg) for leg in legs(journey)]
        said = watched(journey, best.time, best.position, best.speed, told)
    return Way("optimum", best.position, best.speed, best.running_times, energy,
               int(np.count_nonzero(np.diff(pulls))), 1.0, [], said)  # fmt: skip
