"""The page about an identified pad: functions, residuals, laws; opens offline, loads nothing."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

import numpy as np

import railgrip
from railgrip.core.errors import Problem
from railgrip.laboratory.pad_fit import INFLUENCES, Identified, Score
from railgrip.laboratory.pad_fit.laws import Product
from railgrip.laboratory.pad_fit.shape import log_curve
from railgrip.report.static_page import static_page, table
from railgrip.report.svg import STYLE, Chart, chart_svg

AXES = {
    "temperature": ("Disc temperature, °C", 1.0),
    "speed": ("Rubbing speed, m/s", 1.0),
    "clamp_force": ("Clamp force, kN", 1e-3),
}
BINS = 60


def identification_html(
    title: str,
    source: str,
    found: Identified,
    scores: Sequence[Score],
    labels: Sequence[str],
    problems: Sequence[Problem],
) -> str:
    """Return the page about an identified pad.

    Parameters
    ----------
    title, source : str
        Name of the pad; where the measurement comes from.
    found : Identified
        The pad.
    scores : sequence of Score
        Comparison of laws, may be empty.
    labels : sequence of str
        Names of the stops.
    problems : sequence of Problem
        What was left out or could not be found.

    Returns
    -------
    str
        HTML with everything in it.
    """
    plots = "".join(
        f"<figure><figcaption>{escape(one.words)}</figcaption>{chart_svg(one)}</figure>"
        for one in charts(found)
    )
    told = "".join(f"<li>{escape(' '.join(str(one).split()))}</li>" for one in problems)
    left = f"<h2>What could not be used or found</h2><ul>{told}</ul>" if told else ""
    body = [
        f"<h1>{escape(title)}</h1>",
        f'<p class="status good">f0 = {found.reference_friction:.4f} from {len(labels)} stops</p>',
        f'<p class="small">{escape(source)} · railgrip {railgrip.__version__}</p>',
        left,
        "<h2>Functions and residuals</h2>",
        '<p class="small">Dots: means of what was measured, the other functions and the offset of '
        "each stop taken out. Line and band: the function and its 95 % interval, clustered by "
        "stop; circles: its points.</p>",
        f'<div class="plots">{plots}</div>',
        "<h2>Numbers</h2>",
        _numbers(found),
        _laws(scores),
        '<footer><p class="small">The intervals hold for this pad, this programme and these '
        "sensors.</p></footer>",
    ]
    return static_page(title, body, STYLE)


def charts(found: Identified) -> list[Chart]:
    """Return a chart for each function, one of the stops' offsets, one of the residuals."""
    blocks, fit = found.blocks, found.fit
    there = blocks.is_there
    offsets = np.where(there, fit.residuals, 0.0).sum(axis=1) / there.sum(axis=1)
    inner = (fit.residuals - offsets[:, None])[there]
    made = [_function(name, found, inner) for name in INFLUENCES if name in found.points]
    number = np.arange(1, len(offsets) + 1)
    made.append(Chart("Offset of each stop", "Stop", "Measured over fitted − 1, %",
                      dots=(number, 100 * np.expm1(offsets))))  # fmt: skip
    ordered = np.sort(inner)
    share = (np.arange(len(ordered)) + 0.5) / len(ordered)
    some = np.linspace(0, len(ordered) - 1, 200).astype(int)
    made.append(Chart("Residuals within the stops", "Measured over fitted − 1, %",
                      "Share of blocks below",
                      line=(100 * np.expm1(ordered[some]), share[some])))  # fmt: skip
    return made


def _function(name: str, found: Identified, inner: np.ndarray) -> Chart:
    law = found.fit.law
    assert isinstance(law, Product)
    numbers, lags = law.parts(found.fit.theta)
    k = INFLUENCES.index(name)
    blocks, placed = found.blocks, law.functions[name]
    x = (blocks.values[k] + (lags[k] - law.lags.friction) * blocks.slopes[k])[blocks.is_there]
    at = np.linspace(placed.low, placed.high, 200)
    log_h, by, _ = log_curve(placed, numbers[name], at)
    reference = found.plan.reference[name]
    log_ref, by_ref, _ = log_curve(placed, numbers[name], np.array([reference]))
    begin = 1
    for other, one in law.functions.items():
        if other == name:
            break
        begin += one.shape.parameters
    part = slice(begin, begin + placed.shape.parameters)
    spread = by - by_ref
    variance = np.einsum("ip,pq,iq->i", spread, found.fit.covariance[part, part], spread)
    half = 1.96 * np.sqrt(np.maximum(variance, 0.0))
    curve = np.exp(log_h - log_ref)
    edges = np.linspace(placed.low, placed.high, BINS + 1)
    bin_of = np.clip(np.searchsorted(edges, x) - 1, 0, BINS - 1)
    counts = np.bincount(bin_of, minlength=BINS)
    full = counts > 0
    values = np.exp(log_curve(placed, numbers[name], x)[0] - log_ref + inner)
    means = np.bincount(bin_of, values, BINS)[full] / counts[full]
    centres = np.bincount(bin_of, x, BINS)[full] / counts[full]
    label, scale = AXES[name]
    points = np.array(found.points[name])
    shown = (points[:, 0] >= placed.low) & (points[:, 0] <= placed.high)
    return Chart(
        f"Factor by {name.replace('_', ' ')}, 1 at {reference * scale:g} {label.split()[-1]}",
        label, "Factor", dots=(centres * scale, means), line=(at * scale, curve),
        knots=(points[shown, 0] * scale, points[shown, 1]),
        band=(at * scale, curve * np.exp(-half), curve * np.exp(half)),
    )  # fmt: skip


def _numbers(found: Identified) -> str:
    rows = [
        [
            one.name,
            f"{one.value:.5g}",
            "fixed" if one.is_fixed else f"{one.low:.5g} to {one.high:.5g}",
            one.unit,
        ]
        for one in found.parameters
    ]
    noise = found.fit.noise
    rest = (
        f'<p class="small">Offset from stop to stop {noise.offset:.1%}; noise within a stop '
        f"{np.hypot(noise.slow, noise.fast):.1%} per block, correlated over {noise.memory:.2g} s."
        "</p>"
    )
    return table(["Number", "Value", "95 % interval", "Unit"], rows) + rest


def _laws(scores: Sequence[Score]) -> str:
    if not scores:
        return ""
    heads = ["Law", "Numbers", "Error", "Within a stop", "Log-likelihood behind, per stop"]
    rows = [
        [
            one.name + (" (chosen)" if one.is_chosen else ""),
            str(one.parameters),
            f"{one.error:.2%}",
            f"{one.error_within:.2%}",
            f"{one.behind:.2f} ± {one.behind_error:.2f}",
        ]
        for one in scores
    ]
    return "<h2>Laws on stops that were left out</h2>" + table(heads, rows)
