"""One self-contained page about a trip on the plant: legs, speeds, slip, what it took."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.legs import Leg, legs
from railgrip.engine.journey.watching import watched
from railgrip.engine.trip import TripRun
from railgrip.report.plots.journey import draw_speeds
from railgrip.report.static_page import heading, picture, static_page, table
from railgrip.report.supervised_journey import draw_supervised, log_rows, supervision_tables

Array = NDArray[np.float64]


def figures(run: TripRun) -> list[tuple[str, float, str, str]]:
    """Return (name, value in SI, words, text) of a trip as a whole.

    Parameters
    ----------
    run : TripRun
        From `railgrip.engine.trip.drive_trip`.
    """
    worst = max(float(leg.run.data["axle_longest_fast_lock"].values.max()) for leg in run.legs)
    past = max((leg.past_stop for leg in run.legs), key=abs)
    values = [
        ("running_time", run.running_time, "running time", f"{run.running_time:.1f} s"),
        ("dry_time", run.fast.running_time, "without slip", f"{run.fast.running_time:.1f} s"),
        ("delay", run.delay, "behind the timetable at the end", f"{run.delay:.1f} s"),
        ("past_stop", past, "farthest past (short of) a stop", f"{past:+.1f} m"),
    ]
    for name, words in (
        ("energy_traction", "traction at the wheel"), ("energy_dynamic", "braked by the motors"),
        ("energy_brake", "braked by friction"), ("energy_contact", "lost in the contacts"),
    ):  # fmt: skip
        joules = run.total(name)
        values.append((name, joules, words, f"{joules / 3.6e6:.2f} kWh"))
    air, sand = run.total("air_used"), sum(leg.sand for leg in run.legs)
    values += [
        ("sand", sand, "sand laid", f"{sand:.1f} kg"),
        ("air_used", air, "air used", f"{air * 1e3:.0f} Nl"),
        ("longest_lock", worst, "longest lock above 30 km/h", f"{worst:.2f} s"),
    ]
    return values


def leg_table(run: TripRun) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows: one row a leg."""
    heads = ["from, km", "to, km", "time, s", "without slip, s", "timetable, s", "past the stop, m",
             "greatest slip", "ended"]  # fmt: skip
    rows = []
    for leg, dry in zip(run.legs, run.fast.running_times, strict=True):
        slip = float(leg.run.data["axle_greatest_slip"].values.max())
        time = f"{leg.time:.1f}" if np.isfinite(leg.time) else "–"
        rows.append([f"{leg.begin / 1e3:.3f}", f"{leg.stop / 1e3:.3f}", time, f"{dry:.1f}",
                     f"{leg.planned:.1f}", f"{leg.past_stop:+.1f}", f"{slip:.0%}",
                     leg.run.status.name])  # fmt: skip
    return heads, rows


def trip_html(run: TripRun) -> str:
    """Return the page about a trip."""
    title = run.scenario.title or "Trip"
    heads, rows = leg_table(run)
    protection = f"Slide protection: {run.scenario.wsp.controller}."
    return static_page(
        title,
        [
            heading(title, lead=protection),
            table(heads, rows),
            "<h2>Speed over distance</h2>",
            picture(_speeds(run), "speed over distance"),
            *supervised(run),
            "<h2>Slip</h2>",
            picture(_slips(run), "speed of the slowest and the fastest wheel over the train's"),
            "<h2>Altogether</h2>",
            table(["", ""], [[words, text] for _, _, words, text in figures(run)]),
        ],
    )


def supervised(run: TripRun) -> list[str]:
    """Return what the supervision says of a trip: table, limits with the run, log."""
    if run.journey.supervision is None:
        return []
    way = supervised_way(run)
    found = SimpleNamespace(ways=[way])
    body = ["<h2>Supervision (ETCS)</h2>"]
    for title, (head, *rows) in supervision_tables(found):
        body += [f"<h3>{title}</h3>", table(head, rows)]
    head, *rows = log_rows(way.watched)
    figure = _figure(7.5)
    draw_supervised(tuple(figure.subplots(2, 1)), way)
    return [*body, picture(figure, "limits of the supervision and the run over distance"),
            f"<details><summary>Log: {len(rows)} changes</summary>", table(head, rows),
            "</details>"]  # fmt: skip


def supervised_way(run: TripRun) -> SimpleNamespace:
    """Return the trip as a way of driving that the supervision has watched."""
    time, position, speed = list[Array](), list[Array](), list[Array]()
    told, clock = list[tuple[int, Leg]](), 0.0
    for leg, known in zip(run.legs, legs(run.journey), strict=True):
        data = leg.run.data
        told.append((sum(part.size for part in time), known))
        time.append(clock + data["time"].values)
        position.append(data["train_position"].values[0])
        speed.append(data["train_speed"].values[0])
        clock = float(time[-1][-1])
    whole = [np.concatenate(parts) for parts in (time, position, speed)]
    said = watched(run.journey, whole[0], whole[1], whole[2], told)
    return SimpleNamespace(name="on the plant", position=whole[1], speed=whole[2], watched=said,
                           interventions=())  # fmt: skip


def ways(run: TripRun) -> dict[str, tuple[Array, Array]]:
    """Return name → (positions, speeds): on the plant, and without slip."""
    # a gap after each leg: a train past its stop begins the next one at the stop
    gap = np.array([np.nan])
    position, speed = (
        np.concatenate([part for leg in run.legs for part in (leg.run.data[name].values[0], gap)])
        for name in ("train_position", "train_speed")
    )
    fast = run.fast.trace
    return {"without slip": (fast["position"], fast["speed"]), "on the plant": (position, speed)}


def slip_speeds(data: Any) -> tuple[Array, Array, Array]:
    """Return positions, and there how much slower and faster than the train wheels turn, m/s."""
    speed = data["train_speed"].values[0]
    over = data["wheel_speed"].values[0] - speed
    return data["train_position"].values[0], over.min(axis=0), over.max(axis=0)


def _figure(height: float) -> Any:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def _speeds(run: TripRun) -> Any:
    figure = _figure(4.5)
    draw_speeds(figure.subplots(), run.journey, ways(run))
    return figure


def _slips(run: TripRun) -> Any:
    figure = _figure(3.0)
    axes = figure.subplots()
    for leg in run.legs:
        place, least, greatest = slip_speeds(leg.run.data)
        axes.fill_between(place / 1e3, 3.6 * least, 3.6 * greatest, color="tab:blue", lw=0)
    axes.axhline(0.0, color="k", lw=0.6)
    stops = run.journey.stops()
    axes.set(xlabel="Position, km", ylabel="Wheels faster than the train, km/h",
             xlim=(stops[0].at / 1e3, stops[-1].at / 1e3))  # fmt: skip
    return figure
