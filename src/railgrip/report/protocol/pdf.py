"""The protocol as a PDF, set by Typst (extra ``pdf``)."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from railgrip.core.errors import Problem, RailgripError
from railgrip.report.protocol import cells
from railgrip.report.protocol.charts import COLOURS, run_charts, svg
from railgrip.report.protocol.words import ASSUMPTIONS, words

_HEAD = """#set document(title: {title}, date: none)
#set page(paper: "a4", margin: (x: 1.8cm, y: 2cm), numbering: "1 / 1",
  header: text(8pt, fill: gray)[{simulation}])
#set text(font: ("Libertinus Serif", "New Computer Modern"), size: 9pt, lang: "{language}")
#set table(stroke: (x, y) => if y == 0 {{ (bottom: 0.6pt) }} else {{ (bottom: 0.2pt + gray) }},
  inset: 3pt, align: left)
#show heading.where(level: 1): set text(15pt)
#show heading.where(level: 2): set text(11pt)
#let good(it) = text(fill: rgb("#00674a"), it)
#let bad(it) = text(fill: rgb("#a3161f"), weight: "bold", it)
"""


_VERDICT = ("figure", "limit", "measured", "margin", "verdict", "sure", "provenance")


def protocol_pdf(table: dict[str, Any], language: str = "en") -> bytes:
    """Return the PDF: verdicts, each test with its figures, and one page a run.

    Parameters
    ----------
    table : dict
        What `railgrip.campaign.programme.protocol.protocol` gave.
    language : str
        ``en`` or ``de``.
    """
    typst = typesetter()
    with tempfile.TemporaryDirectory(prefix="railgrip-protocol-") as folder:
        source = Path(folder) / "protocol.typ"
        source.write_text(_source(table, language, Path(folder)), encoding="utf-8")
        made = typst.compile(str(source), root=folder, ignore_system_fonts=True, timestamp=0)
    content: bytes = made
    return content


def typesetter() -> Any:
    """Return Typst.

    Raises
    ------
    RailgripError
        ``typst is not installed; try: pip install 'railgrip[pdf]'``
    """
    try:
        import typst
    except ImportError:
        cure = "pip install 'railgrip[pdf]'"
        raise RailgripError(Problem("", "typst is not installed", cure=cure)) from None
    return typst


def _source(table: dict[str, Any], language: str, folder: Path) -> str:
    said = words(language)
    found = table["identification"]
    title = f"{said['title']}: {found['controller']}, {table['train']['title']}"
    well, outcome = cells.outcome(table, said)
    parts = [
        _HEAD.format(title=_text(title), simulation=_shown(said["simulation"]), language=language),
        f"= {_shown(title)}",
        f"#{'good' if well else 'bad'}[{_shown(' '.join(outcome))}]",
        f"== {_shown(said['identification'])}",
        _grid([said["item"], said["value"]], cells.identification_rows(table, said), "auto, 1fr"),
    ]
    for test in table["tests"]:
        parts.append(
            f"== {_shown(test['name'])}: {_shown(cells.title(test, language))}"
        )  # fmt: skip
        parts.append(_shown(f"{said['rail']}: {test['rail']}. {test['problem']}"))
        if test["limits"]:
            heads = [said[name] for name in _VERDICT]
            rows = cells.verdict_rows(test, said, language)
            parts.append(_grid(heads, rows, "1.4fr, 1.2fr, 1fr, 0.8fr, 0.9fr, 1.2fr, 1.6fr"))
        if test["runs"]:
            heads = [said[n] for n in ("figure", "mean_of", "interval", "least", "greatest")]
            rows = cells.figure_rows(test, said, language)
            parts.append(_grid(heads, rows, "2fr, 1fr, 1.4fr, 1fr, 1fr"))
    parts.append(f"== {_shown(said['deviations'])}")
    parts += [_shown(sentence) + "\n" for sentence in ASSUMPTIONS[language]]
    parts.append(f"#v(3cm)#line(length: 7cm, stroke: 0.5pt)\n{_shown(said['signature'])}")
    for test in table["tests"]:
        parts += [_run(table, test, run, said, folder) for run in test["runs"]]
    return "\n\n".join(parts)


def _run(
    table: dict[str, Any], test: dict[str, Any], run: dict[str, Any], said: dict[str, str],
    folder: Path,
) -> str:  # fmt: skip
    limits = cells.thresholds(table)
    name = f"{test['name']}.{run['number']}"
    pictures = []
    drawn = run_charts(run["curves"], said, limits)
    for number, (told, lines, _) in enumerate(drawn):
        over = run["curves"]["distance" if told == said["over_distance"] else "time"]
        bounds = limits if told == said["slip"] else ()
        file = f"{name}-{number}.svg"
        (folder / file).write_text(svg(over, lines, bounds, told, standalone=True), "utf-8")
        key = " ".join(
            f'#text(fill: rgb("{COLOURS[line.kind]}"))[{_shown(line.label)}]'
            for line in lines
            if line.label
        )
        picture = f'#image("{file}", width: 100%)'
        pictures.append(f"[#text(8pt)[{_shown(told)}\\ {key}]\\ {picture}]")
    state = f"{said['invalid']}: {run['invalid']}" if run["invalid"] else run["status"]
    figures = ", ".join(
        f"{cells.label(one, 'en' if said['test'] == 'Test' else 'de')} "
        f"{cells.figure(run['figures'][one['metric']], one['unit'], said)}"
        for one in test["figures"]
    )
    return (
        f"#pagebreak()\n== {_shown(name)}\n{_shown(state)} "
        f"{_shown(said['seed'])} {run['seed']}/{run['index']}. {_shown(figures)}\n\n"
        f"#grid(columns: 2, gutter: 8pt, {', '.join(pictures)})"
    )


def _grid(heads: Sequence[str], rows: Sequence[Sequence[str]], widths: str) -> str:
    top = ", ".join(f"[*{_shown(head)}*]" for head in heads)
    body = ",\n".join(", ".join(f"[{_shown(str(cell))}]" for cell in row) for row in rows)
    return f"#text(7.5pt)[#table(columns: ({widths}), table.header({top}),\n{body})]"


def _shown(text: str) -> str:
    """Return plain text as Typst's content: through a string, so that nothing in it is markup."""
    return f"#({_text(text)})"


def _text(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ")
    return f'"{escaped}"'
