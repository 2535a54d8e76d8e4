"""What a campaign found, as rows of text and as a page."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np

from railgrip.campaign.batch import Batches
from railgrip.campaign.designs import Compared
from railgrip.campaign.manifest import MANIFEST
from railgrip.campaign.sensitivity import tornado
from railgrip.campaign.statistics import Estimate, exceedance, mean, quantile
from railgrip.campaign.store import Store
from railgrip.core.atomic import write_aside
from railgrip.core.errors import RailgripError
from railgrip.core.status import ENDED_WELL, RunStatus
from railgrip.report.metrics import SOURCES
from railgrip.report.units import Shown, shown

QUANTILES = (0.5, 0.9, 0.99, 0.999)
COLUMNS = ("figure", "mean", *(f"{100 * level:g} %" for level in QUANTILES), "greatest")


def how_shown(figure: str) -> tuple[str, Shown]:
    """Return name and unit of a figure; an own one stands as it is."""
    source = SOURCES.get(figure)
    if source is None:
        return figure, Shown("", 1.0, 4)
    return source.label, shown(source.variable)


def said(estimate: Estimate, how: Shown) -> str:
    """Return an estimate with its interval, in the unit of the figure.

    Examples
    --------
    >>> said(Estimate(480.2, 479.1, 481.3), Shown("m", 1.0, 1))
    '480.2 [479.1, 481.3] m'
    """
    value, low, high = (f"{number * how.factor:.{max(how.decimals, 0)}f}" for number in estimate)
    return f"{value} [{low}, {high}] {how.unit}".rstrip()


def states(status: Any) -> str:
    """Return how the runs ended, in one line."""
    kinds, counts = np.unique(status, return_counts=True)
    return ", ".join(
        f"{count} {RunStatus(int(kind)).name}" for kind, count in zip(kinds, counts, strict=True)
    )


def _is_drawn(store: Store, column: str) -> bool:
    """Whether a column holds draws: a variable's label, with the vehicle, bogie or axle."""
    return any(
        re.fullmatch(rf"{re.escape(variable.label)}(_V\d+(_B\d+(_A\d+)?)?)?", column)
        for variable in store.campaign.variable
    )


def summary(store: Store) -> tuple[str, list[list[str]]]:
    """Return how the runs ended, and a row of statistics for each kept figure.

    Runs that did not end well are counted, and left out of the statistics.
    """
    table = store.read()
    well = np.isin(table["status"], ENDED_WELL)
    rows = []
    for figure, values in table.items():
        if figure in ("run", "status") or _is_drawn(store, figure):
            continue
        finite = np.asarray(values, dtype=float)[well]
        finite = finite[np.isfinite(finite)]
        if not len(finite):
            continue
        label, how = how_shown(figure)
        cells = [said(mean(finite), how)] + [said(quantile(finite, q), how) for q in QUANTILES]
        greatest = f"{finite.max() * how.factor:.{max(how.decimals, 0)}f} {how.unit}".rstrip()
        rows.append([label, *cells, greatest])
    return states(table["status"]), rows


def write_page(store: Store, figure: str, with_tornado: bool = True) -> Path:
    """Write the page of a campaign into its folder."""
    from railgrip.report.campaign_page import Section, campaign_html
    from railgrip.report.plots import campaign as plots

    ended, rows = summary(store)
    table = store.read(["run", "status", figure])
    values = np.asarray(table[figure], dtype=float)
    finite = values[np.isfinite(values)]
    label, how = how_shown(figure)
    axis = f"{label}, {how.unit}" if how.unit else label
    sections = [
        Section("How the runs ended", f"{len(values)} runs: {ended}."),
        Section("Figures", "Mean and quantiles with 95 % confidence intervals.", COLUMNS, rows),
    ]
    if len(finite):
        thresholds = np.linspace(finite.min(), finite.max(), 200)
        band = exceedance(finite, thresholds)
        picture = plots.exceedance(finite, band, thresholds * how.factor, axis)
        sections += [
            Section(f"{label}: exceedance", figure=picture),
            Section(f"{label}: distribution", figure=plots.histogram(finite * how.factor, axis)),
        ]
    else:
        sections.append(Section(label, "No run has this figure."))
    if with_tornado and store.campaign.variable and len(finite):
        try:
            middle, swings = tornado(Batches(store.campaign), figure)
            picture = plots.tornado(middle, swings, how, axis)
            text = (
                "One variable at a time, in all its places together, all others at their medians, "
                "on one and the same rail."
            )
            sections.append(Section("What matters most", text, figure=picture))
        except (RailgripError, TypeError) as error:
            sections.append(Section("What matters most", f"No tornado: {error}"))
    manifest = (store.folder / MANIFEST).read_text(encoding="utf-8")
    note = json.loads(manifest)
    sections.append(Section("What was asked", preformatted=manifest))
    lead = (
        f"{len(values)} runs, {store.campaign.sampling.method} sampling, seed {note['seed']}, "
        f"railgrip {note['railgrip_version']}."
    )
    page = campaign_html(store.campaign.title or store.folder.name, lead, sections)
    with write_aside(store.folder / "report.html") as aside:
        aside.write_text(page, encoding="utf-8")
    return store.folder / "report.html"


def compared_rows(rows: list[Compared], figure: str) -> list[list[str]]:
    """Return a study's table as text."""
    _, how = how_shown(figure)
    return [
        [
            f"{row.condition}, {row.design}",
            f"{row.runs}",
            said(row.mean, how),
            said(row.high, how),
            *(
                "" if one is None else said(one, how)
                for one in (row.over_first, row.high_over_first)
            ),
        ]
        for row in rows
    ]


def write_comparison(rows: list[Compared], figure: str, title: str, folder: Path) -> Path:
    """Write the comparison page of a study."""
    from railgrip.report.campaign_page import Section, campaign_html

    label, _ = how_shown(figure)
    text = (
        "All designs are drawn alike. Over the first design: the mean difference run by run, "
        "and the difference of the 99 % quantiles (paired bootstrap)."
    )
    table = Section(label, text, STUDY_COLUMNS, compared_rows(rows, figure))
    with write_aside(folder / "comparison.html") as aside:
        page = campaign_html(title or folder.name, f"{len(rows)} campaigns.", [table])
        aside.write_text(page, encoding="utf-8")
    return folder / "comparison.html"


STUDY_COLUMNS = (
    "condition, design",
    "runs",
    "mean",
    "99 %",
    "mean over the first",
    "99 % over the first",
)
