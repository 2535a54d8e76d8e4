"""One self-contained page about a journey: figures and tables, nothing from outside."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.engine.journey.drive import JourneyRun
from railgrip.report.campaign_page import STYLE, picture
from railgrip.report.plots.journey import draw_speeds, draw_trade_off
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
    speeds = _figure(
        "Speed over distance", (10, 4.5), lambda axes: draw_speeds(axes, journey, runs)
    )
    trade = _figure("Energy over time", (7, 4.2), lambda axes: draw_trade_off(axes, curves))
    legs = [["from – to, s", *times], *leg_rows(journey, times)]
    energy = [["flat out", "kWh"], *map(list, energy_rows(run))]
    return (
        f"<!doctype html><html lang='en'><meta charset='utf-8'><title>{escape(title)}</title>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'>"
        f"<style>{STYLE}</style><h1>{escape(title)}</h1>{_table(summary)}"
        f"<h2>Speed over distance</h2>{speeds}<h2>Running times</h2>{_table(legs)}"
        f"<h2>Energy</h2>{_table(energy)}<h2>Energy over time</h2>{trade}"
        f"<p>Line: {escape(journey.line.source)}. Train: {escape(journey.train.source)}. "
        "A simulation without slip, no approval.</p></html>\n"
    )


def _name(stop: Any) -> str:
    return stop.name or f"{stop.at / 1e3:.3f} km"


def _table(rows: Sequence[Sequence[str]]) -> str:
    def line(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    return f"<table>{line(rows[0], 'th')}{''.join(line(row, 'td') for row in rows[1:])}</table>"


def _figure(meaning: str, size: tuple[float, float], draw: Any) -> str:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    draw(figure.subplots())
    return picture(figure, meaning)
