"""One page about several runs: each can be looked at, with the others as ghosts behind it."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import Any

from railgrip.core.errors import Problem, RailgripError
from railgrip.core.status import ENDED_WELL
from railgrip.report import tables
from railgrip.report.differences import differences
from railgrip.report.html import circumstances, compared_charts, filled, scenario_part, stage
from railgrip.report.metrics import Metric, metrics, status_sentence
from railgrip.report.payload import compared_runs
from railgrip.report.view import View, dataset_of

MOST = 12
"""Runs on one page: more could not be told apart."""
COLOURS = 8


def comparison_html(runs: Mapping[str, Any]) -> str:
    """Return the page about several runs as text.

    Parameters
    ----------
    runs : mapping
        Name → Result or dataset, with traces; 2 to 12 of them.

    Raises
    ------
    RailgripError
        "compare: a page holds 2 to 12 runs; got 1".
    """
    if not 2 <= len(runs) <= MOST:
        what = f"a page holds 2 to {MOST} runs"
        raise RailgripError(Problem("compare", what, got=f"{len(runs)}"))
    views = {name: View(dataset_of(result)) for name, result in runs.items()}
    first = next(iter(views.values()))
    figures = {name: metrics(view.dataset) for name, view in views.items()}
    titles = list(dict.fromkeys(view.title for view in views.values()))
    start = first.start if first.has("train_position") else 0.0
    where = circumstances(first, start)
    if len({view.dataset.attrs.get("controller") for view in views.values()}) > 1:
        where = [part for part in where if not part.startswith("controller")]
    return filled(
        "compare.html",
        compared_runs(views),
        title=escape(titles[0] if len(titles) == 1 else f"{len(views)} runs compared"),
        version=escape(str(first.dataset.attrs.get("railgrip_version", "?"))),
        seed=escape(", ".join(dict.fromkeys(
            str(view.dataset.attrs.get("seed", "–")) for view in views.values()
        ))),
        where="".join(f" · {escape(part)}" for part in where),
        runs="\n".join(_run(i, name, views[name], figures[name]) for i, name in enumerate(views)),
        compared="\n".join(_against(i, name, figures) for i, name in enumerate(figures)),
        stage=stage(list(views.values()), compared_charts(list(views.values())), _choice(views)),
        scenario=scenario_part(first),
    )  # fmt: skip


def breakable(name: str) -> str:
    """Return a name, escaped, that may break after its underscores.

    Examples
    --------
    >>> breakable("peak_seeking")
    'peak_<wbr>seeking'
    """
    return escape(name).replace("_", "_<wbr>")


def _run(number: int, name: str, view: View, figures: list[Metric]) -> str:
    """Return how one run ended, beside its colour."""
    state = "good" if view.number("status") in ENDED_WELL else "bad"
    known = {figure.name: figure.text for figure in figures}
    distance = known.get("stopping_distance") or known.get("covered_distance") or ""
    told = status_sentence(view.dataset)
    ended = f"{told} {distance}." if state == "good" and distance else told
    if state == "bad" and len(view.time):
        ended += f" Shown up to {view.time[-1]:.2f} s."
    return (
        f'<li><i class="swatch s{number % COLOURS}"></i> <strong>{breakable(name)}</strong> '
        f'<span class="{state}">{escape(ended)}</span></li>'
    )


def _against(number: int, name: str, figures: Mapping[str, list[Metric]]) -> str:
    """Return differences and table against one run; the page shows those of the run looked at."""
    told = "\n".join(f"<li>{escape(one)}</li>" for one in differences(figures, name))
    ordered = {name: figures[name]} | dict(figures)
    hidden = " hidden" if number else ""
    return (
        f'<div data-against="{number}"{hidden}>\n<ul class="differences">\n{told}\n</ul>\n'
        f'<div class="scroll">{tables.comparison_table(ordered)}</div>\n</div>'
    )


def _choice(views: Mapping[str, View]) -> str:
    """Return the buttons that choose the run looked at."""
    buttons = "\n".join(
        f'<label><input type="radio" name="looked" value="{i}"{" checked" if i == 0 else ""}> '
        f'<i class="swatch s{i % COLOURS}"></i> {breakable(name)}</label>'
        for i, name in enumerate(views)
    )
    return f'<fieldset class="looked"><legend>Looked at</legend>\n{buttons}\n</fieldset>\n'


def comparison_csv(runs: Mapping[str, Any]) -> str:
    """Return the figures of several runs as CSV: one row a figure, one column a run.

    Examples
    --------
    >>> import xarray as xr
    >>> run = xr.Dataset({"status": ("run", [1]), "air_used": ("run", [0.25])})
    >>> print(comparison_csv({"a": run, "b": run}).splitlines()[1])
    air_used,Nl,250.0,250.0
    """
    figures = [{m.name: m for m in metrics(result)} for result in runs.values()]
    every = {name: metric for of_run in reversed(figures) for name, metric in of_run.items()}
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["figure", "unit", *runs])
    for name, metric in every.items():
        values = [of_run[name].value if name in of_run else float("nan") for of_run in figures]
        writer.writerow([name, metric.unit, *("" if v != v else repr(float(v)) for v in values)])
    return text.getvalue()


def write_comparison(runs: Mapping[str, Any], path: str | Path) -> Path:
    """Write the page about several runs; return its path.

    Examples
    --------
    >>> write_comparison({}, "nowhere.html")
    Traceback (most recent call last):
    railgrip.core.errors.RailgripError: compare: a page holds 2 to 12 runs; got 0
    """
    from railgrip.core.atomic import write_aside

    page = comparison_html(runs)
    with write_aside(Path(path)) as aside:
        Path(aside).write_text(page, encoding="utf-8")
    return Path(path)
