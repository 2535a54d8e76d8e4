"""One self-contained page about a journey: figures and tables, nothing from outside."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.coasting import coasting_curve
from railgrip.report.plots.journey import draw_speeds, draw_trade_off
from railgrip.report.static_page import heading, picture, static_page, table
from railgrip.report.supervised_journey import draw_supervised, log_rows, supervision_tables
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]


WORDS = {
    "traction": "traction at the wheel", "motor_brake": "braked by the motors",
    "friction": "braked by friction", "resistance": "running resistance", "grade": "gradient",
    "auxiliaries": "auxiliaries", "dc_link": "net at the DC link",
    "pantograph": "net at the pantograph",
}  # fmt: skip


def energy_rows(found: Any) -> list[list[str]]:
    """Return what each way of driving takes, kWh: one row a kind of energy."""
    return [
        [word, *(f"{way.energy[key] / 3.6e6:.2f}" if key in way.energy else "–"
                 for way in found.ways)]
        for key, word in WORDS.items()
    ]  # fmt: skip


def leg_rows(journey: Journey, times: Mapping[str, Array]) -> list[list[str]]:
    """Return one row a leg: from, to, and the running time of each way of driving."""
    stops = journey.stops()
    return [
        [f"{_name(here)} – {_name(there)}", *(f"{column[k]:.1f}" for column in times.values())]
        for k, (here, there) in enumerate(pairwise(stops))
    ]


def page(found: Any) -> str:
    """Return the page about what `railgrip.campaign.driving.driven` gave."""
    journey, ways = found.journey, found.ways
    head, *rows = found.summary()
    runs = {way.name: (way.position, way.speed) for way in ways}
    times = {way.name: way.running_times for way in ways}
    sources = f"Line: {journey.line.source}. Train: {journey.train.source}."
    notice = "A simulation without slip, not an approval."
    curves = coasting_curve(journey) if journey.coasting is not None else None
    return static_page(
        found.title,
        [
            heading(found.title, notice, sources),
            table(head, rows),
            *(f"<p>{remark}</p>" for remark in found.remarks()),
            "<h2>Speed over distance</h2>",
            _figure((10, 4.5), "speed", lambda axes: draw_speeds(axes, journey, runs, curves)),
            "<h2>Energy over time</h2>",
            _figure((7, 4.2), "energy over time", lambda axes: draw_trade_off(axes, found.curves)),
            "<h2>Running times</h2>",
            table(["from – to, s", *times], leg_rows(journey, times)),
            "<h2>Energy, kWh</h2>",
            table(["", *times], energy_rows(found)),
            f"<h2>Wear of pads, at {journey.train.pad_wear * 1e12:g} cm³/MJ</h2>",
            table(["", *times], [["cm³", *(f"{found.pad_wear(way) * 1e6:.1f}" for way in ways)]]),
            *_supervised(found),
            *_tuned(found),
            *(_log(way) for way in ways if way.log),
        ],
    )


def _supervised(found: Any) -> list[str]:
    tables = supervision_tables(found)
    if not tables:
        return []
    mode = found.journey.supervision.mode
    told = {"report": "It watches and does not act.",
            "drive": "All but the optimum are driven below the permitted speed.",
            "intervene": "It brakes all but the optimum."}[mode]  # fmt: skip
    body = ["<h2>Supervision (ETCS)</h2>", f"<p>{told} Distances are the least way left to a limit "
            "before each target; negative: beyond it.</p>"]  # fmt: skip
    for title, (head, *rows) in tables:
        body += [f"<h3>{title}</h3>", table(head, rows)]
    for way in (way for way in found.ways if way.watched is not None):
        body += [f"<h3>Limits and run, {way.name}</h3>", _two(way)]
        head, *rows = log_rows(way.watched)
        body += [f"<details><summary>Log, {way.name}: {len(rows)} changes</summary>",
                 table(head, rows), "</details>"]  # fmt: skip
    return body


def _two(way: Any) -> str:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10, 7.5), layout="constrained")
    FigureCanvasAgg(figure)
    draw_supervised(tuple(figure.subplots(2, 1)), way)
    return picture(figure, f"limits of the supervision and the run over distance, {way.name}")


def _tuned(found: Any) -> list[str]:
    if found.tuned is None:
        return []
    return ["<h2>Coasting, tuned</h2>", table(["parameter (SI)", ""], found.tuned_rows())]


def _log(way: Any) -> str:
    heads = ["position, km", "time, s", "speed, km/h", "ready", "acting"]
    rows = [
        [f"{one.position / 1e3:.3f}", f"{one.time:.1f}", f"{one.speed * 3.6:.1f}",
         "yes" if one.is_ready else "no", "yes" if one.is_acting else "no"]
        for one in way.log
    ]  # fmt: skip
    return f"<h2>Indicators, {way.name}</h2>" + table(heads, rows)


def _name(stop: Any) -> str:
    return stop.name or f"{stop.at / 1e3:.3f} km"


def _figure(size: tuple[float, float], words: str, draw: Any) -> str:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure.subplots())
    return picture(figure, words)
