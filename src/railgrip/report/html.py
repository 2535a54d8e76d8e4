"""One self-contained page about a run: opens offline, loads nothing, runs only its own scripts."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

import numpy as np

from railgrip.core.status import ENDED_WELL
from railgrip.report import tables
from railgrip.report.energy import energy_table
from railgrip.report.limits import check_limits
from railgrip.report.metrics import axle_table, metrics, status_sentence
from railgrip.report.payload import payload
from railgrip.report.static_page import policy, template
from railgrip.report.view import View, dataset_of

ONLY_COMPARED = ("found", "force")
"""Charts that a page about one run has no room for."""
SCRIPTS = ("data.js", "look.js", "charts.js", "page.js")

CHARTS = {
    "speed": ("Speeds of train and wheels, km/h", "wheel_speed"),
    "slip": ("Slip, (reference − wheel)/reference speed, %", "wheel_speed"),
    "pressure": ("Brake cylinder pressure, bar", "brake_cylinder_pressure"),
    "valve": ("Dump valves", "dump_valve"),
    "adhesion": ("Adhesion used and available, force over wheel load", "adhesion_used"),
    "found": ("Rail friction that each axle found under its wheels", "rail_friction"),
    "force": ("Force between wheel and rail, braking positive, kN", "contact_force"),
    "deceleration": ("Deceleration of the train, m/s²", "acceleration"),
    "motor": ("Motor force at the tread, dynamic brake positive, kN", "dynamic_force"),
    "flash": ("Flash temperature: rise in the contact, K", "flash_temperature"),
    "temperature": ("Brake disc (or tread) temperature, °C", "disc_temperature"),
    "reservoir": ("Reservoir pressure, bar", "reservoir_pressure"),
    "rail": ("Rail friction along the line, before and after the train", "rail_friction_after"),
    "energy": ("Friction energy that the rail received, kJ/m", "rail_energy"),
    "sand": ("Sand laid on the rail, g/m", "rail_sand"),
}


def write_report(
    result: Any,
    path: str | Path,
    *,
    ghost: Mapping[str, Any] | None = None,
    measured: Any | None = None,
    limits: Mapping[str, float] | None = None,
    run: int = 0,
) -> Path:
    """Write the page about a run.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave, with traces.
    path : str or Path
        The HTML file to write.
    ghost : mapping, optional
        Name → other result; drawn as pale curves and compared in a table.
    measured : MeasuredComparison, optional
        What `railgrip.io.measured.compare_measured` gave; drawn dashed, its table shown.
    limits : mapping, optional
        Limits in SI; those of the scenario in the dataset if not given.
    run : int
        Which run of the batch.

    Returns
    -------
    Path
        The file written.
    """
    from railgrip.core.atomic import write_aside

    target = Path(path)
    page = report_html(result, ghost=ghost, measured=measured, limits=limits, run=run)
    with write_aside(target) as aside:
        Path(aside).write_text(page, encoding="utf-8")
    return target


def report_html(
    result: Any,
    *,
    ghost: Mapping[str, Any] | None = None,
    measured: Any | None = None,
    limits: Mapping[str, float] | None = None,
    run: int = 0,
) -> str:
    """Return the page about a run as text; see `write_report`."""
    view = View(dataset_of(result), run)
    ghosts = {name: View(dataset_of(other)) for name, other in (ghost or {}).items()}
    figures = metrics(view.dataset, run)
    drawn = [name for name in CHARTS if name not in ONLY_COMPARED and _drawn(view, name)]
    return filled(
        "page.html",
        payload(view, ghosts, measured),
        title=escape(view.title),
        cards=tables.cards(figures),
        limits=tables.limit_list(check_limits(view.dataset, _limits(view, limits), run)),
        comparison=_comparison(view, ghosts, measured),
        stage=stage([view], drawn),
        metrics=tables.metric_table(figures),
        energy=tables.energy_rows(energy_table(view.dataset, run)),
        axles=_axles(view),
        scenario=scenario_part(view),
        **_heading(view),
    )


def filled(page: str, data: Mapping[str, Any], **parts: str) -> str:
    """Return a page of the templates in its frame: scripts, style, data, and its parts.

    ``title`` and ``version`` are among the parts: the frame names them too.
    """
    script = '"use strict";\n(() => {\n' + "".join(template(name) for name in SCRIPTS) + "})();\n"
    uplot = _vendored("uPlot.iife.min.js")
    style = _vendored("uPlot.min.css") + template("page.css")
    return Template(template("frame.html")).substitute(
        inside=Template(template(page)).substitute(parts),
        title=parts["title"],
        version=parts["version"],
        policy=policy([uplot, script], style),
        licence=_vendored("LICENSE").strip().replace("--", "- -"),
        style=style,
        uplot=uplot,
        script=script,
        data=_harmless(json.dumps(data, separators=(",", ":"))),
    )


def stage(views: Sequence[View], drawn: Sequence[str], looked: str = "") -> str:
    """Return the part of a page that holds the charts and what is chosen for them.

    Parameters
    ----------
    views : sequence of View
        The runs; the first gives the words for those who do not see the charts.
    drawn : sequence of str
        Of `CHARTS`.
    looked : str
        The choice of the run that is looked at, for a page of several.
    """
    charts = "\n".join(_figure(views[0], name) for name in drawn)
    return Template(template("charts.html")).substitute(
        charts=charts or "<p>This run was made without traces.</p>",
        looked=looked,
        kind=" compared" if looked else "",
        behind="Behind it" if looked else "Laid over",
    )


def compared_charts(views: Sequence[View]) -> list[str]:
    """Return the charts that at least one of the runs can fill."""
    return [name for name in CHARTS if any(_drawn(view, name) for view in views)]


def _heading(view: View) -> dict[str, str]:
    ended = view.number("status")
    well = ended in ENDED_WELL
    start = view.start if view.has("train_position") else 0.0
    return {
        "status": escape(status_sentence(view.dataset, view.run)),
        "state": "good" if well else "bad",
        "version": escape(str(view.dataset.attrs.get("railgrip_version", "?"))),
        "seed": escape(str(view.dataset.attrs.get("seed", "–"))),
        "where": "".join(f" · {escape(part)}" for part in circumstances(view, start)),
    }


def circumstances(view: View, start: float) -> list[str]:
    """Return what a run was made with, in a few words each."""
    attrs = view.dataset.attrs
    parts = [f"controller {attrs['controller']}"] if "controller" in attrs else []
    parts += [f"creep law {attrs['creep_law']}"] if "creep_law" in attrs else []
    return parts + ([f"starts at km {start / 1e3:.3f} of the line"] if start else [])


def _limits(view: View, given: Mapping[str, float] | None) -> Mapping[str, float]:
    if given is not None:
        return given
    stated = view.scenario.get("limits")
    if not isinstance(stated, Mapping):
        return {}
    return {name: value for name, value in stated.items() if isinstance(value, int | float)}


def _drawn(view: View, name: str) -> bool:
    signal = CHARTS[name][1]
    if name in ("sand", "motor"):
        return view.has(signal) and bool(np.any(view.get(signal)))
    return view.has("train_speed") and view.has(signal)


def _figure(view: View, name: str) -> str:
    words = CHARTS[name][0]
    told = f"Chart: {words}; {view.title}. The figures are in the tables of this page."
    return (
        f'<figure><figcaption>{escape(words)}</figcaption><div class="key" id="key-{name}"></div>'
        f'<div class="chart" id="chart-{name}" role="img" tabindex="0" '
        f'aria-label="{escape(told)}"></div></figure>'
    )


def _comparison(view: View, ghosts: Mapping[str, View], measured: Any | None) -> str:
    parts = []
    if ghosts:
        runs = {view.title: metrics(view.dataset, view.run)}
        for name, other in ghosts.items():
            runs[name if name not in runs else f"{name} (other)"] = metrics(other.dataset)
        parts.append(f'<div class="scroll">{tables.comparison_table(runs)}</div>')
    if measured is not None:
        parts.append(f'<div class="scroll">{tables.difference_table(measured.rows)}</div>')
    if not parts:
        return ""
    head = '<section aria-labelledby="h-compared">\n<h2 id="h-compared">Compared</h2>\n'
    return head + "\n".join(parts) + "\n</section>"


def _axles(view: View) -> str:
    table = axle_table(view.dataset, view.run)
    if not table.heads:
        return ""
    worst = view.axles[view.worst_axle] if view.has("axle_slid_energy") else ""
    return (
        '<section aria-labelledby="h-axles">\n<h2 id="h-axles">Axle by axle</h2>\n'
        f'<div class="scroll">{tables.axle_rows(table, worst)}</div>\n</section>'
    )


def scenario_part(view: View) -> str:
    """Return the part of a page that holds the scenario, folded."""
    text = str(view.dataset.attrs.get("scenario_text", ""))
    if not text and view.scenario:
        text = json.dumps(view.scenario, indent=2, ensure_ascii=False)
    if not text:
        return ""
    return (
        '<section aria-labelledby="h-scenario">\n<h2 id="h-scenario">Scenario</h2>\n'
        f"<details><summary>What was run</summary><pre>{escape(text)}</pre></details>\n</section>"
    )


def _harmless(text: str) -> str:
    """Return JSON that cannot end the script element it stands in."""
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _vendored(name: str) -> str:
    return (files("railgrip.report") / "vendor" / "uplot" / name).read_text(encoding="utf-8")
