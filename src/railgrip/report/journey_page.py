"""One self-contained page about a journey: figures and tables, nothing from outside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.drive import JourneyRun
from railgrip.report.plots.journey import draw_speeds, draw_trade_off
from railgrip.report.static_page import heading, picture, static_page, table
from railgrip.scenario.journey import Journey

Array = NDArray[np.float64]


def energy_rows(run: JourneyRun) -> list[tuple[str, str]]:
    """Return (what, kWh) of a fast journey."""
    words = {
        "traction": "traction at the wheel", "motor_brake": "braked by the motors",
        "friction": "braked by friction", "resistance": "running resistance", "grade": "gradient",
        "auxiliaries": "auxiliaries", "dc_link": "net at the DC link",
        "pantograph": "net at the pantograph",
    }  # fmt: skip
    return [(words[key], f"{value / 3.6e6:.2f}") for key, value in run.energy.items()]


def leg_rows(journey: Journey, times: Mapping[str, Array]) -> list[list[str]]:
    """Return one row a leg: from, to, and the running time of each way of driving."""
    stops = journey.stops()
    return [
        [f"{_name(here)} – {_name(there)}", *(f"{column[k]:.1f}" for column in times.values())]
        for k, (here, there) in enumerate(pairwise(stops))
    ]


def page(
    run: JourneyRun,
    runs: Mapping[str, tuple[Array, Array]],
    summary: Sequence[Sequence[str]],
    times: Mapping[str, Array],
    curves: Mapping[str, tuple[Array, Array]],
) -> str:
    """Return the page.

    Parameters
    ----------
    run : JourneyRun
        The fast journey.
    runs : mapping
        Name → positions and speeds to draw.
    summary : rows of text
        The first one is the head.
    times : mapping
        Name → running time of each leg, s.
    curves : mapping
        Name → times and energies of the trade-off.
    """
    journey = run.journey
    title = journey.title or f"{journey.train.title} on {journey.line.title}"
    legs = leg_rows(journey, times)
    sources = f"Line: {journey.line.source}. Train: {journey.train.source}."
    notice = "A simulation without slip, not an approval."
    return static_page(
        title,
        [
            heading(title, notice, sources),
            table(summary[0], summary[1:]),
            "<h2>Speed over distance</h2>",
            _figure((10, 4.5), "speed", lambda axes: draw_speeds(axes, journey, runs)),
            "<h2>Running times</h2>",
            table(["from – to, s", *times], legs),
            "<h2>Energy</h2>",
            table(["flat out", "kWh"], energy_rows(run)),
            "<h2>Energy over time</h2>",
            _figure((7, 4.2), "energy over time", lambda axes: draw_trade_off(axes, curves)),
        ],
    )


def _name(stop: Any) -> str:
    return stop.name or f"{stop.at / 1e3:.3f} km"


def _figure(size: tuple[float, float], words: str, draw: Any) -> str:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure.subplots())
    return picture(figure, words)
