"""Small charts as SVG inside a page: no script, colours of the page, light or dark."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

WIDTH, HEIGHT = 460.0, 270.0
LEFT, RIGHT, TOP, BOTTOM = 56.0, 12.0, 10.0, 44.0

STYLE = """
svg.plot { width: 100%; max-width: 34rem; height: auto; display: block; font-size: 12px; }
svg.plot text { fill: var(--soft); }
svg.plot .grid { stroke: var(--grid); stroke-width: 1; }
svg.plot .line { fill: none; stroke: var(--accent); stroke-width: 2.2; }
svg.plot .band { fill: var(--accent); fill-opacity: .18; }
svg.plot .dot { fill: var(--soft); fill-opacity: .55; }
svg.plot .knot { fill: var(--paper); stroke: var(--accent); stroke-width: 2; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 22rem), 1fr)); gap: 1rem; }
"""  # noqa: E501


class Chart(NamedTuple):
    """One chart; every part may be empty.

    Attributes
    ----------
    words, x_label, y_label : str
        What it shows; labels with units.
    dots, line, knots : (x, y)
        Small grey points; a line; open circles.
    band : (x, low, high)
        Between two curves.
    """

    words: str
    x_label: str
    y_label: str
    dots: tuple[ArrayLike, ArrayLike] = ((), ())
    line: tuple[ArrayLike, ArrayLike] = ((), ())
    knots: tuple[ArrayLike, ArrayLike] = ((), ())
    band: tuple[ArrayLike, ArrayLike, ArrayLike] = ((), (), ())


def chart_svg(chart: Chart) -> str:
    """Return the chart as an SVG element.

    Examples
    --------
    >>> text = chart_svg(Chart("a line", "x", "y", line=([0, 1], [2, 3])))
    >>> text.count("polyline"), text.startswith("<svg")
    (1, True)
    """
    xs = _joined(chart.dots[0], chart.line[0], chart.knots[0], chart.band[0])
    ys = _joined(chart.dots[1], chart.line[1], chart.knots[1], chart.band[1], chart.band[2])
    (x0, x1), (y0, y1) = _range(xs), _range(ys)

    def place(x: ArrayLike, y: ArrayLike) -> list[tuple[float, float]]:
        px = LEFT + (np.asarray(x, float) - x0) / (x1 - x0) * (WIDTH - LEFT - RIGHT)
        py = HEIGHT - BOTTOM - (np.asarray(y, float) - y0) / (y1 - y0) * (HEIGHT - TOP - BOTTOM)
        return list(zip(px.tolist(), py.tolist(), strict=True))

    parts = [_axes(chart, (x0, x1), (y0, y1), place)]
    bx, low, high = (np.asarray(one, float) for one in chart.band)
    if len(bx):
        outline = place(np.append(bx, bx[::-1]), np.append(low, high[::-1]))
        parts.append(f'<polygon class="band" points="{_points(outline)}"/>')
    parts += [f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="2.6"/>'
              for x, y in place(*chart.dots)]  # fmt: skip
    if len(np.asarray(chart.line[0])):
        parts.append(f'<polyline class="line" points="{_points(place(*chart.line))}"/>')
    parts += [f'<circle class="knot" cx="{x:.1f}" cy="{y:.1f}" r="4"/>'
              for x, y in place(*chart.knots)]  # fmt: skip
    return (
        f'<svg class="plot" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" role="img" '
        f'aria-label="{escape(chart.words)}">{"".join(parts)}</svg>'
    )


def _joined(*parts: ArrayLike) -> np.ndarray:
    found = np.concatenate([np.asarray(one, dtype=float).ravel() for one in parts])
    return np.asarray(found[np.isfinite(found)])


def _range(values: np.ndarray) -> tuple[float, float]:
    if not len(values):
        return 0.0, 1.0
    low, high = float(values.min()), float(values.max())
    room = 0.05 * (high - low) or max(0.05 * abs(high), 0.05)
    return low - room, high + room


def _ticks(low: float, high: float) -> list[float]:
    rough = (high - low) / 5.0
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(m * power for m in (1.0, 2.0, 5.0, 10.0) if m * power >= rough)
    return [float(k * step) for k in range(int(np.ceil(low / step)), int(high // step) + 1)]


def _axes(chart: Chart, x: tuple[float, float], y: tuple[float, float], place: object) -> str:
    assert callable(place)
    parts = []
    for value in _ticks(*x):
        ((px, _),) = place([value], [y[0]])
        parts.append(f'<line class="grid" x1="{px:.1f}" x2="{px:.1f}" y1="{TOP}" '
                     f'y2="{HEIGHT - BOTTOM}"/><text x="{px:.1f}" y="{HEIGHT - BOTTOM + 15}" '
                     f'text-anchor="middle">{value:g}</text>')  # fmt: skip
    for value in _ticks(*y):
        ((_, py),) = place([x[0]], [value])
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{py:.1f}" '
                     f'y2="{py:.1f}"/><text x="{LEFT - 6}" y="{py + 4:.1f}" '
                     f'text-anchor="end">{value:.4g}</text>')  # fmt: skip
    middle = (TOP + HEIGHT - BOTTOM) / 2
    parts.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">'
                 f'{escape(chart.x_label)}</text><text x="14" y="{middle}" text-anchor="middle" '
                 f'transform="rotate(-90 14 {middle})">{escape(chart.y_label)}</text>')  # fmt: skip
    return "".join(parts)


def _points(places: Sequence[tuple[float, float]]) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
