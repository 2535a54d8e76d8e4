"""The report of a safety case: one HTML page that an assessor can follow from top to bottom."""

from __future__ import annotations

import math
from html import escape
from pathlib import Path

import numpy as np

import railgrip
from railgrip.campaign.rare.convergence import convergence
from railgrip.campaign.rare.levels import EBCL, SHORTFALLS
from railgrip.campaign.safety.factors import SafetyFactors, Step
from railgrip.campaign.safety.page_case import ASSUMPTIONS, failures, variables
from railgrip.campaign.safety.safe_braking import safe_deceleration, safe_distance, warnings
from railgrip.report.safety_chart import convergence_chart, exceedance_chart
from railgrip.report.static_page import static_page, table

STYLE = """
svg { width: 100%; max-width: 720px; height: auto; font: 12px system-ui, sans-serif; }
svg text { fill: var(--ink); } svg .end { text-anchor: end; } svg .mid { text-anchor: middle; }
svg .mark { text-anchor: end; font-weight: 600; } svg tspan { font-size: 9px; }
svg .grid { stroke: var(--grid); }
svg .curve { stroke: var(--accent); fill: none; stroke-width: 2; }
svg .band { fill: var(--accent); opacity: .3; } svg .dot { fill: var(--ink); }
"""


def page(found: SafetyFactors) -> str:
    """Return the page as text: self-contained, without scripts, light and dark."""
    case = found.case
    title = case.title or case.train.title or "Safety case"
    body = [
        f"<h1>K_dry_rst and K_wet_rst: {escape(title)}</h1>",
        '<p class="notice"><strong>Simulation, not an approval.</strong> Every figure follows from '
        "the assumptions and distributions below; where a source says illustrative, so is the "
        "result.</p>",
        f'<p class="small">railgrip {escape(railgrip.__version__)} · method {case.method} · seed '
        f"{case.seed} · {case.runs} runs for each speed step, pilots on top</p>",
        *_warnings(found),
        "<h2>K_dry_rst</h2>",
        *(_dry_table(step) for step in found.steps),
        "<h2>K_wet_rst</h2>",
        _wet_table(found),
        "<h2>Safe deceleration and stopping distance</h2>",
        _safe_table(found),
        *_worth(found),
        "<h2>What was assumed</h2>",
        "<ol>" + "".join(f"<li>{escape(one)}</li>" for one in ASSUMPTIONS) + "</ol>",
        variables(found),
        failures(found),
        "<h2>The sample</h2>",
        *(_sample(step) for step in found.steps),
        "<h2>Which failed units make which level</h2>",
        *(_shares(found, step) for step in found.steps),
        '<footer><p class="small">Simulation, not an approval: no figure here replaces a test '
        "or an assessment.</p></footer>",
    ]
    return static_page(title, body, STYLE)


def write_page(found: SafetyFactors, path: Path) -> Path:
    """Write the page; nothing half-written is left behind."""
    from railgrip.core.atomic import write_aside

    with write_aside(path) as aside:
        Path(aside).write_text(page(found), encoding="utf-8")
    return path


def _kmh(speed: float) -> str:
    return f"{speed * 3.6:.4g} km/h"


def _between(low: float, high: float) -> str:
    if not (math.isfinite(low) and math.isfinite(high)):
        return "not resolved"
    return f"{low:.4f} … {high:.4f}"


def _dry_table(step: Step) -> str:
    rows = []
    for level, p, k in zip(EBCL, SHORTFALLS, step.dry.quantile, strict=True):
        confidence = f"{100 * (1 - p):.9f}".rstrip("0").rstrip(".") + " %"
        rows.append([f"EBCL {level}", confidence, f"{k.value:.4f}", _between(k.low, k.high),
                     _between(k.low_all, k.high_all), f"{k.effective:.0f}"])  # fmt: skip
    heads = ["", "confidence", "K_dry_rst", "95 %", "95 %, all ten at once", "effective runs"]
    return table(heads, rows, f"From {_kmh(step.speed)}")


def _wet_table(found: SafetyFactors) -> str:
    rows = [
        [_kmh(step.speed), f"{step.wet.value:.4f}", _between(step.wet.low, step.wet.high),
         f"{step.wet.least:.4f}", str(step.wet.runs)]
        for step in found.steps if step.wet is not None
    ]  # fmt: skip
    if not rows or found.case.wet is None:
        return "<p>Not asked; taken as 1.</p>"
    wet = found.case.wet
    caption = f"Rail condition {wet.condition}, controller {wet.controller}, stepped in time"
    return table(["from", "K_wet_rst", "95 %", "least of all stops", "stops"], rows, caption)


def _safe_table(found: SafetyFactors) -> str:
    heads = ["", *(f"{_kmh(step.speed)}: m/s²" for step in found.steps),
             *(f"stop from {_kmh(step.speed)}: m" for step in found.steps)]  # fmt: skip
    nominal = ["nominal", *(f"{step.emergency_deceleration:.3f}" for step in found.steps),
               *(f"{step.distance:.1f}" for step in found.steps)]  # fmt: skip
    rows = [nominal]
    for level in EBCL:
        rows.append([f"EBCL {level}", *(f"{a:.3f}" for a in safe_deceleration(found, level)),
                     *(f"{s:.1f}" for s in safe_distance(found, level))])  # fmt: skip
    caption = (
        "A_brake_safe up to each speed, and the stopping distance with the nominal build-up time; "
        f"M_NVAVADH {found.case.available_adhesion_weight:g}"
    )
    return table(heads, rows, caption)


def _worth(found: SafetyFactors) -> list[str]:
    """Return what the brake control is worth, level by level."""
    without = found.without
    if without is None:
        return []
    parts = [
        "<h2>What brake control is worth</h2>",
        "<p>The same train, scatter and failed brakes, without its friction estimate and "
        "deceleration controller. Each K refers to its own nominal stop, so compare decelerations "
        "and distances.</p>",
    ]
    heads = ["", "K_dry_rst with", "without", "A_brake_safe with, m/s²", "without",
             "safe stop with, m", "without", "shorter by"]  # fmt: skip
    for number, (own, bare) in enumerate(zip(found.steps, without.steps, strict=True)):
        rows = []
        for level in EBCL:
            pair = [(safe_deceleration(one, level)[number], safe_distance(one, level)[number])
                    for one in (found, without)]  # fmt: skip
            rows.append([
                f"EBCL {level}", f"{own.dry.quantile[level].value:.4f}",
                f"{bare.dry.quantile[level].value:.4f}", f"{pair[0][0]:.3f}", f"{pair[1][0]:.3f}",
                f"{pair[0][1]:.0f}", f"{pair[1][1]:.0f}",
                f"{100 * (1 - pair[0][1] / pair[1][1]):.1f} %",
            ])  # fmt: skip
        parts.append(table(heads, rows, f"From {_kmh(own.speed)}"))
    parts += [_curve(step, f"{_kmh(step.speed)} without brake control") for step in without.steps]
    return parts


def _curve(step: Step, name: str) -> str:
    dry = step.dry
    marks = [
        (level, k.value, p) for level, p, k in zip(EBCL, SHORTFALLS, dry.quantile, strict=True)
    ]
    return (
        f"<figure><figcaption>From {name}: how probable it is to brake worse (EBCL marked), with "
        "its 95 % band</figcaption>"
        + exceedance_chart(dry.curve.bound, dry.curve.probability, dry.curve.error, marks)
        + "</figure>"
    )


def _sample(step: Step) -> str:
    dry = step.dry
    stages = convergence(dry, len(EBCL) - 1)
    columns = np.array([[s.quantile.value, s.quantile.low, s.quantile.high] for s in stages])
    name = _kmh(step.speed)
    return (
        _curve(step, name)
        + f"<figure><figcaption>From {name}: K_dry_rst at EBCL 9 as the sample grows "
        f"({dry.pilots} pilots besides)</figcaption>"
        + convergence_chart([s.runs for s in stages], columns[:, 0], columns[:, 1],
                            columns[:, 2], "K_dry_rst, EBCL 9")
        + "</figure>"
    )  # fmt: skip


def _shares(found: SafetyFactors, step: Step) -> str:
    rows = [[f"EBCL {level}", *(f"{100 * share:.1f} %" for share in row)]
            for level, row in zip(EBCL, step.dry.share, strict=True)]  # fmt: skip
    control, states = found.layout.control, found.layout.states
    heads = [""]
    for group in range(step.dry.share.shape[1]):
        failed = states.failed[states.n_failed == group][:1]
        count = int(failed.sum())
        if control >= 0 and failed[:, control].any():
            heads.append("control" if count == 1 else f"control and {count - 1}")
        else:
            heads.append(f"{count} failed")
    told = f"From {_kmh(step.speed)}: of the runs that undercut the level"
    return table(heads, rows, told)


def _warnings(found: SafetyFactors) -> list[str]:
    return [f'<p class="notice">{escape(one)}</p>' for one in warnings(found)]
