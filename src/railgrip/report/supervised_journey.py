"""What the supervision says of journeys: tables, and its limits over the line with the run."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from railgrip.control.etcs.limit_table import EBI, LIMITS
from railgrip.report.supervision_figure import LOOKS

Array = NDArray[np.float64]

CLOSE = 1.6
"""The close-up begins at so many indication distances before the target."""
LINES = {name: LOOKS["sbi1" if name == "sbi" else name] for name in LIMITS}
WORDS = {"indication": "indication", "permitted": "permitted", "warning": "warning",
         "sbi": "service brake (SBI)", "ebi": "emergency brake (EBI)"}  # fmt: skip


def supervision_tables(found: Any) -> list[tuple[str, list[list[str]]]]:
    """Return (title, rows with their head) for each way of driving that was supervised.

    Parameters
    ----------
    found : Driven
        From `railgrip.campaign.driving.driven`.
    """
    tables = []
    for way in found.ways:
        if way.watched is None:
            continue
        tables.append((f"Supervision, {way.name}: metres left", _approach_rows(way.watched)))
        if way.interventions:
            tables.append((f"Braked by the supervision, {way.name}", _braked_rows(way)))
    return tables


def log_rows(watched: Any) -> list[list[str]]:
    """Return the log of the status, head first."""
    head = ["position, km", "time, s", "speed, km/h", "status", "because of"]
    return [head] + [
        [f"{one.position / 1e3:.3f}", f"{one.time:.1f}", f"{3.6 * one.speed:.1f}", one.status,
         "" if np.isnan(one.target) else f"target at {one.target / 1e3:.3f} km"]
        for one in watched.log
    ]  # fmt: skip


def draw_supervised(axes: tuple[Any, Any], way: Any) -> None:
    """Draw the limits and the run: over the whole way, and where it came nearest to a brake."""
    for one in axes:
        top = 1.02 * float(np.nanmax(way.watched.limits[EBI]))
        for name, limit in zip(LIMITS, way.watched.limits, strict=True):
            colour, style, _ = LINES[name]
            row = np.where(limit < top, limit, np.nan)
            one.plot(way.watched.position / 1e3, 3.6 * row, color=colour, ls=style, lw=1.1,
                     label=WORDS[name])  # fmt: skip
        one.plot(way.position / 1e3, 3.6 * way.speed, color="k", lw=1.6, label=way.name)
        for k, braked in enumerate(way.interventions):
            inside = (way.position >= braked.begin[1]) & (way.position <= braked.end[1])
            one.plot(way.position[inside] / 1e3, 3.6 * way.speed[inside], color="#B2182B", lw=3.5,
                     alpha=0.55, label=None if k else "braked by the supervision")  # fmt: skip
        one.set(xlabel="Position, km", ylabel="Speed, km/h")
        one.set_ylim(bottom=0.0)
    begin, end = float(way.position[0]), float(way.position[-1])
    axes[0].set_xlim(begin / 1e3, end / 1e3)
    axes[0].legend(loc="lower center", ncols=4, frameon=False, bbox_to_anchor=(0.5, 1.0))
    nearest = min(way.watched.approaches, key=lambda one: float(one.margin[EBI]), default=None)
    if nearest is None:
        axes[1].set_visible(False)
        return
    far = CLOSE * float(np.nan_to_num(nearest.passed[0], nan=1000.0))
    axes[1].set_xlim((nearest.target - far) / 1e3, (nearest.target + 0.12 * far) / 1e3)
    axes[1].axvline(nearest.target / 1e3, color="0.5", lw=0.8)
    near = (way.watched.position > nearest.target - far) & (
        way.watched.position < nearest.target + 0.12 * far
    )
    axes[1].set_ylim(
        0.6 * 3.6 * nearest.target_speed,
        1.05 * 3.6 * float(np.nanmax(way.watched.limits[EBI, near])),
    )
    words = "end of authority" if nearest.target_speed == 0.0 else "lower limit"
    axes[1].set_title(f"Nearest to the emergency brake: {words} at {nearest.target / 1e3:.3f} km",
                      fontsize="medium")  # fmt: skip


def _approach_rows(watched: Any) -> list[list[str]]:
    head = ["target", "to, km/h", "indicated, m",
            "to permitted", "to warning", "to SBI", "to EBI"]  # fmt: skip
    rows = []
    for one in watched.approaches:
        margins = [f"{x:+.1f}" for x in one.margin[1:]]
        place = "train ahead" if one.kind == "train ahead" else _km(one.target)
        rows.append([place, f"{3.6 * one.target_speed:.0f}", f"{one.passed[0]:.0f}", *margins])
    return [head, *rows]


def _braked_rows(way: Any) -> list[list[str]]:
    head = ["brake", "from, km", "at, km/h", "until, km", "at, km/h", "because of"]
    return [head] + [
        [one.brake, f"{one.begin[1] / 1e3:.3f}", f"{3.6 * one.begin[2]:.1f}",
         f"{one.end[1] / 1e3:.3f}", f"{3.6 * one.end[2]:.1f}",
         "speed limit" if np.isnan(one.target) else f"target at {one.target / 1e3:.3f} km"]
        for one in way.interventions
    ]  # fmt: skip


def _km(position: float) -> str:
    return f"{position / 1e3:.3f}\N{NO-BREAK SPACE}km"
