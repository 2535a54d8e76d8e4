"""Two charts of a safety case as inline SVG: no script, colours of the page's own look."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
WIDTH, HEIGHT = 720, 380
LEFT, RIGHT, TOP, BOTTOM = 76, 16, 12, 46
INNER_WIDTH, INNER_HEIGHT = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM


def exceedance_chart(
    bound: FloatArray, probability: FloatArray, error: FloatArray,
    levels: Sequence[tuple[int, float, float]],
) -> str:  # fmt: skip
    """Return the probability of braking worse than K over K, with its 95 % band and the levels.

    Parameters
    ----------
    bound, probability, error : (points,)
        The curve; probabilities from 1 down to 1e-9 are drawn.
    levels : sequence of (level, quantile, probability)
        Marked points.
    """
    seen = (probability > 3e-10) & (probability < 0.9999)
    every = max(1, int(np.count_nonzero(seen) / 800))
    k, p, e = bound[seen][::every], probability[seen][::every], error[seen][::every]
    if len(k) < 2:
        return "<p>Too few runs for a curve.</p>"
    low, high = _round_range(float(k[0]), float(k[-1]), 0.05)
    across = _scale(low, high)

    def down(value: FloatArray) -> FloatArray:
        return TOP - np.log10(np.clip(value, 1e-10, 1.0)) / 10.0 * INNER_HEIGHT

    upper = _points(across(k), down(p + 1.96 * e))
    lower = _points(across(k)[::-1], down(np.maximum(p - 1.96 * e, 1e-12))[::-1])
    parts = [f'<polygon class="band" points="{upper} {lower}"/>']
    parts.append(f'<polyline class="curve" points="{_points(across(k), down(p))}"/>')
    for level, value, at in levels:
        x, y = float(across(np.array([value]))[0]), float(down(np.array([at]))[0])
        parts.append(f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>')
        parts.append(f'<text class="mark" x="{x - 7:.1f}" y="{y - 5:.1f}">{level}</text>')
    rows = [(down(np.array([10.0**-n]))[0], f"10<tspan dy='-5'>−{n}</tspan>" if n else "1")
            for n in range(0, 11)]  # fmt: skip
    frame = _frame(low, high, rows, "K, nominal over real deceleration distance",
                   "probability of braking worse")  # fmt: skip
    told = f"Probability of braking worse than K, from {low:g} to {high:g}, with its 95 % band"
    return _svg([frame, *parts], told)


def convergence_chart(runs: Sequence[int], middle: FloatArray, low: FloatArray, high: FloatArray,
                      name: str) -> str:  # fmt: skip
    """Return a quantile with its 95 % interval over the number of runs."""
    finite = np.concatenate([values[np.isfinite(values)] for values in (middle, low, high)])
    span = max(float(np.ptp(finite)), 1e-6)
    bottom, top = float(finite.min()) - 0.1 * span, float(finite.max()) + 0.1 * span
    across = _scale(0.0, runs[-1] * 1.08)

    def down(value: float) -> float:
        if not math.isfinite(value):
            return TOP if value > 0 else TOP + INNER_HEIGHT
        return TOP + (top - value) / (top - bottom) * INNER_HEIGHT

    parts = []
    for n, value, a, b in zip(runs, middle, low, high, strict=True):
        x = float(across(np.array([float(n)]))[0])
        parts.append(f'<line class="curve" x1="{x:.1f}" y1="{down(a):.1f}" x2="{x:.1f}" '
                     f'y2="{down(b):.1f}"/>')  # fmt: skip
        parts.append(f'<circle class="dot" cx="{x:.1f}" cy="{down(value):.1f}" r="4"/>')
        parts.append(f'<text class="mark" x="{x - 8:.1f}" y="{down(value) + 4:.1f}">{n}</text>')
    ticks = [(down(v), f"{v:.4f}") for v in np.linspace(bottom, top, 6)]
    frame = _frame(0.0, runs[-1] * 1.08, ticks, "runs of the final sample", name)
    return _svg([frame, *parts], f"{name} over the number of runs, with its 95 % interval")


def _svg(parts: list[str], told: str) -> str:
    inside = "\n".join(parts)
    return (
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(told)}">'
        f"<title>{escape(told)}</title>\n{inside}\n</svg>"
    )


def _scale(low: float, high: float) -> Callable[[Any], Any]:
    return lambda values: LEFT + (values - low) / (high - low) * INNER_WIDTH


def _points(x: FloatArray, y: FloatArray) -> str:
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))


def _round_range(low: float, high: float, step: float) -> tuple[float, float]:
    return math.floor(low / step) * step, math.ceil(high / step) * step


def _frame(
    low: float, high: float, rows: list[tuple[float, str]], x_name: str, y_name: str
) -> str:  # fmt: skip
    across = _scale(low, high)
    parts = []
    for y, text in rows:
        parts.append(f'<line class="grid" x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{y:.1f}" '
                     f'y2="{y:.1f}"/>')  # fmt: skip
        parts.append(f'<text class="end" x="{LEFT - 6}" y="{y + 4:.1f}">{text}</text>')
    for value in _ticks(low, high):
        x = across(value)
        parts.append(f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" '
                     f'y2="{HEIGHT - BOTTOM}"/>')  # fmt: skip
        parts.append(f'<text class="mid" x="{x:.1f}" y="{HEIGHT - BOTTOM + 16}">{value:g}</text>')
    parts.append(f'<text class="mid" x="{LEFT + INNER_WIDTH / 2}" y="{HEIGHT - 8}">'
                 f"{escape(x_name)}</text>")  # fmt: skip
    middle = TOP + INNER_HEIGHT / 2
    parts.append(f'<text class="mid" transform="translate(16 {middle}) rotate(-90)">'
                 f"{escape(y_name)}</text>")  # fmt: skip
    return "\n".join(parts)


def _ticks(low: float, high: float) -> list[float]:
    step = 10.0 ** math.floor(math.log10((high - low) / 3.0))
    step *= next(m for m in (1.0, 2.0, 5.0, 10.0) if (high - low) / (m * step) <= 8.0)
    first = math.ceil(low / step - 1e-9)
    return [round(n * step, 10) for n in range(first, math.floor(high / step + 1e-9) + 1)]
