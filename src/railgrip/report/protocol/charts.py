"""The charts of one run as plain SVG: no script, so they print, and open anywhere."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, NamedTuple

WIDTH, HEIGHT = 420, 170
LEFT, RIGHT, TOP, BOTTOM = 40, 6, 8, 22


class Line(NamedTuple):
    """One curve: its class (which the page colours), its words, its values."""

    kind: str
    label: str
    values: Sequence[float]


COLOURS = {"c0": "#000000", "c1": "#D55E00", "c2": "#0072B2", "c3": "#009E73"}
"""Colour of each kind of line on paper (Okabe and Ito)."""
STANDALONE = (
    "<style>text{font:9px sans-serif;fill:#333}.grid{stroke:#ddd}.line{fill:none;stroke-width:1.2}"
    ".limit{stroke:#a3161f;stroke-dasharray:4 3}"
    + "".join(f".{kind}{{stroke:{colour}}}" for kind, colour in COLOURS.items())
    + "</style>"
)
"""Colours for charts outside a page."""


def run_charts(
    curves: Mapping[str, Any], words: Mapping[str, str], thresholds: Sequence[float] = ()
) -> list[tuple[str, list[Line], str]]:
    """Return every chart of a run: words, lines, SVG.

    Parameters
    ----------
    curves : mapping
        `railgrip.report.protocol.curves.Curves` as a mapping.
    words : mapping
        Of the language.
    thresholds : sequence of float
        Slip thresholds, [%].
    """
    time, distance = curves["time"], curves["distance"]
    speeds = [
        Line("c0", words["train"], curves["train"]),
        Line("c1", words["reference"], curves["reference"]),
        Line("c2", words["wheels"], curves["slowest"]),
        Line("c2", "", curves["fastest"]),
    ]
    pressures = [
        Line("c0", words["pressure_mean"], curves["pressure"]),
        Line("c2", words["pressure_least"], curves["least_pressure"]),
        Line("c1", words["venting"], [value / 10.0 for value in curves["venting"]]),
    ]
    adhesions = [
        Line("c0", words["used"], curves["used"]),
        Line("c3", words["available"], curves["available"]),
    ]
    charts = [
        ("over_time", speeds, time, ()),
        ("over_distance", speeds, distance, ()),
        ("slip", [Line("c2", "", curves["slip"])], time, thresholds),
        ("pressure", pressures, time, ()),
        ("adhesion", adhesions, time, ()),
    ]
    if curves["reservoir"]:
        charts.append(
            ("air", [Line("c0", words["reservoir"], curves["reservoir"])], time, ())
        )  # fmt: skip
    return [
        (words[name], lines, svg(x, lines, at, words[name])) for name, lines, x, at in charts
    ]  # fmt: skip


def svg(
    x: Sequence[float], lines: Sequence[Line], limits: Sequence[float] = (), told: str = "",
    *, standalone: bool = False,
) -> str:  # fmt: skip
    """Return a chart with axes.

    Parameters
    ----------
    x : sequence of float
        Ascending.
    lines : sequence of Line
        Drawn over it.
    limits : sequence of float
        Horizontal lines.
    told : str
        What a screen reader says.
    standalone : bool
        Whether it stands in a file of its own, with its own colours.

    Examples
    --------
    >>> svg([0.0, 1.0], [Line("c0", "speed", [10.0, 0.0])]).count("<polyline")
    1
    """
    finite = [v for line in lines for v in line.values if math.isfinite(v)]
    top, step = _nice(max([*finite, *limits], default=1.0))
    bottom = min([0.0, *finite])
    bottom = -step * math.ceil(-bottom / step) if bottom < 0.0 else 0.0
    first, last = (x[0], x[-1]) if x else (0.0, 1.0)
    across = (WIDTH - LEFT - RIGHT) / max(last - first, 1e-9)
    up = (HEIGHT - TOP - BOTTOM) / max(top - bottom, 1e-9)
    floor = HEIGHT - BOTTOM

    def place(value: float) -> float:
        return round(floor - (value - bottom) * up, 1)

    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
        f'aria-label="{escape(told)}">'
    ]
    if standalone:
        parts.append(STANDALONE)
    for k in range(round((top - bottom) / step) + 1):
        value = bottom + k * step
        y = place(value)
        parts.append(
            f'<path class="grid" d="M{LEFT} {y}H{WIDTH - RIGHT}"/>'
            f'<text x="{LEFT - 4}" y="{y + 3}" text-anchor="end">{value:g}</text>'
        )
    far, stride = _nice(last - first)
    for k in range(int(far / stride) + 1):
        at = LEFT + k * stride * across
        if at <= WIDTH - RIGHT + 0.5:
            value = first + k * stride
            parts.append(
                f'<text x="{at:.0f}" y="{HEIGHT - 6}" text-anchor="middle">{value:g}</text>'
            )
    for limit in limits:
        parts.append(f'<path class="limit" d="M{LEFT} {place(limit)}H{WIDTH - RIGHT}"/>')
    for line in lines:
        points = " ".join(
            f"{LEFT + (a - first) * across:.0f},{place(v):.0f}"
            for a, v in zip(x, line.values, strict=True)
            if math.isfinite(v)
        )
        parts.append(f'<polyline class="line {line.kind}" points="{points}"/>')
    return "".join(parts) + "</svg>"


def _nice(span: float) -> tuple[float, float]:
    """Return a round number that is not less, and the step of four or five ticks up to it."""
    if not span > 0.0:
        return 1.0, 0.25
    size = 10.0 ** math.floor(math.log10(span))
    for factor in (1.0, 2.0, 4.0, 5.0, 8.0, 10.0):
        if span <= factor * size * 1.0000001:
            return factor * size, factor * size / (5.0 if factor in (1.0, 5.0, 10.0) else 4.0)
    return 10.0 * size, 2.0 * size
