"""Pieces of the page's HTML. Everything that a user or a file named goes through `escape`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from html import escape
from typing import Any

from railgrip.report.energy import EnergyRow
from railgrip.report.limits import Verdict
from railgrip.report.metrics import SOURCES, AxleTable, Metric
from railgrip.report.units import shown

CARDS = (
    "covered_distance",
    "final_speed",
    "stopping_distance",
    "deceleration_distance",
    "stopping_time",
    "mean_deceleration",
    "adhesion_utilisation",
    "greatest_slip",
    "greatest_spin",
    "locked_time",
    "flat_length",
    "flash_temperature",
    "disc_temperature",
    "air_used",
)
DECIMALS = {"km/h": 2, "m": 1, "s": 2, "m/s²": 3, "bar": 2, "kN": 2, "°C": 1}


def cards(figures: Sequence[Metric]) -> str:
    """Return the key figures as list items."""
    by_name = {figure.name: figure for figure in figures}
    items = []
    for name in CARDS:
        if name not in by_name:
            continue
        figure = by_name[name]
        number, _, axle = figure.text.partition(" (")
        note = f'<span class="note">{escape(axle.rstrip(")"))}</span>' if axle else ""
        items.append(
            f'<li><span class="label">{escape(figure.label)}</span>'
            f'<span class="value">{escape(number)}</span>{note}</li>'
        )
    return "\n".join(items)


def limit_list(verdicts: Sequence[Verdict]) -> str:
    """Return the limits with their verdicts as a list."""
    if not verdicts:
        return ""
    items = [
        f'<li class="{"good" if verdict.passed else "bad"}">{escape(verdict.text)}</li>'
        for verdict in verdicts
    ]
    missed = sum(not verdict.passed for verdict in verdicts)
    heading = f"Limits: {missed} of {len(verdicts)} missed" if missed else "Limits: all passed"
    return f'<h3>{heading}</h3>\n<ul class="limits">\n' + "\n".join(items) + "\n</ul>"


def metric_table(figures: Iterable[Metric]) -> str:
    """Return every figure with its value."""
    rows = [(figure.label, [figure.text]) for figure in figures]
    return table("Figures of the run", ["Figure", "Value"], rows)


def energy_rows(rows: Sequence[EnergyRow]) -> str:
    """Return the energy balance with a bar for each term."""
    if not rows:
        return ""
    body = "\n".join(
        f'<tr><th scope="row">{escape(row.label)}</th><td>{row.energy / 1e3:.1f}</td>'
        f"<td>{row.share * 100:.4g}</td><td>{_bar(row.share)}</td></tr>"
        for row in rows
    )
    return (
        "<table><caption>Where the initial kinetic energy went</caption><thead><tr>"
        '<th scope="col">Term</th><th scope="col">kJ</th><th scope="col">%</th>'
        f'<th scope="col"><span aria-hidden="true"></span></th></tr></thead><tbody>\n{body}\n'
        "</tbody></table>"
    )


def _bar(share: float) -> str:
    width = min(100.0, abs(share) * 100)
    return (
        '<svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">'
        f'<rect width="{width:.2f}" height="10"/></svg>'
    )


def axle_rows(axles: AxleTable, worst: str) -> str:
    """Return the outcomes of each axle, the worst one in bold."""
    heads = ["Axle"] + [
        f"{head}, {unit}" if unit else head
        for head, unit in zip(axles.heads, axles.units, strict=True)
    ]
    rows = [(label, texts) for (label, _), texts in zip(axles.rows, axles.texts, strict=True)]
    return table("Outcomes of each axle", heads, rows, strong=worst)


def comparison_table(runs: Mapping[str, Sequence[Metric]]) -> str:
    """Return the figures of several runs side by side, each with its difference to the first."""
    (_, first), *others = runs.items()
    tables = [{figure.name: figure for figure in figures} for _, figures in others]
    rows = []
    for figure in first:
        cells = [figure.text]
        for other in tables:
            if figure.name not in other:
                cells.append("–")
                continue
            change = other[figure.name].value - figure.value
            how = shown(SOURCES[figure.name].variable)
            form = f"+.{how.decimals}f" if how.decimals >= 0 else "+.1e"
            less = f" ({change:{form}})" if change == change and change else ""
            cells.append(other[figure.name].text.partition(" (")[0] + less)
        rows.append((figure.label, cells))
    caption = f"Runs compared (in brackets: less {next(iter(runs))})"
    return table(caption, ["Figure", *runs], rows)


def difference_table(rows: Iterable[Any]) -> str:
    """Return a table simulated − measured from rows with label, simulated, measured, unit."""
    body = []
    for row in rows:
        form = f"{{:.{DECIMALS[row.unit]}f}}" if row.unit in DECIMALS else "{:.4g}"
        numbers = (row.simulated, row.measured, row.difference)
        cells = ["–" if number != number else form.format(number) for number in numbers]
        if row.measured == row.measured and row.measured:
            cells[2] += f" ({100 * row.difference / row.measured:+.1f} %)"
        body.append((row.label, [*cells, row.unit]))
    heads = ["Figure", "Simulated", "Measured", "Simulated − measured", "Unit"]
    return table("Simulated and measured", heads, body)


def table(
    caption: str,
    heads: Sequence[str],
    rows: Iterable[tuple[str, Sequence[str]]],
    strong: str = "",
) -> str:
    """Return a table whose first column names the row."""
    heads = [escape(head).replace("_", "_<wbr>") for head in heads]
    top = "".join(f'<th scope="col">{head}</th>' for head in heads)
    body = []
    for label, cells in rows:
        mark = ' class="worst"' if strong and label == strong else ""
        filled = "".join(f"<td>{escape(cell)}</td>" for cell in cells)
        body.append(f'<tr{mark}><th scope="row">{escape(label)}</th>{filled}</tr>')
    return (
        f"<table><caption>{escape(caption)}</caption><thead><tr>{top}</tr></thead>"
        "<tbody>\n" + "\n".join(body) + "\n</tbody></table>"
    )
