"""The protocol as one page that opens offline, in light and dark, on paper and on a phone."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from string import Template
from typing import Any

from railgrip.report.protocol import cells
from railgrip.report.protocol.charts import Line, run_charts
from railgrip.report.protocol.words import ASSUMPTIONS
from railgrip.report.protocol.words import words as words_of

_PLACES = ("railgrip.report", "template")


def protocol_html(table: dict[str, Any], language: str = "en", compared: Sequence[Any] = ()) -> str:
    """Return the page.

    Parameters
    ----------
    table : dict
        What `railgrip.campaign.programme.protocol.protocol` gave.
    language : str
        ``en`` or ``de``.
    compared : sequence of Difference
        Shown as a comparison with another protocol.

    Raises
    ------
    RailgripError
        ``--language: language 'fr' unknown; …``
    """
    words = words_of(language)
    well, said = cells.outcome(table, words)
    found = table["identification"]
    style = _read("page.css") + _read("protocol.css")
    nearest = table["nearest"]
    example = f"{nearest[0]['test']}.{nearest[0]['number']}" if nearest else "W3.1"
    return Template(_read("protocol.html")).substitute(
        language=language,
        style=style,
        title=escape(f"{words['title']}: {found['controller']}, {table['train']['title']}"),
        version=escape(found["railgrip"]),
        seed=found["seed"],
        simulation=escape(words["simulation"]),
        state="good" if well else "bad",
        result_head=escape(words["result"]),
        result="".join(f"<p>{escape(one)}</p>" for one in said),
        comparison=_comparison(compared, words, language),
        tests_head=escape(words["tests"]),
        tests=_verdicts(table, words, language),
        nearest_head=escape(words["nearest"]),
        nearest_note=escape(words["nearest_note"].format(example=example)),
        nearest=_nearest(nearest, words),
        details="\n".join(_test(table, test, words, language) for test in table["tests"]),
        identification_head=escape(words["identification"]),
        identification=_grid([words["item"], words["value"]],
                             cells.identification_rows(table, words), "words"),
        deviations_head=escape(words["deviations"]),
        deviations="".join(f"<p>{escape(one)}</p>" for one in ASSUMPTIONS[language]),
        signature=escape(words["signature"]),
    )  # fmt: skip


def _read(name: str) -> str:
    return (files(_PLACES[0]) / _PLACES[1] / name).read_text(encoding="utf-8")


def _grid(heads: Sequence[str], rows: Sequence[Sequence[str]], kind: str = "") -> str:
    top = "".join(f'<th scope="col">{escape(head)}</th>' for head in heads)
    body = "\n".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(str(cell))}</td>" for cell in row[1:])
        + "</tr>"
        for row in rows
    )
    return (
        f'<div class="scroll"><table class="{kind}"><thead><tr>{top}</tr></thead>'
        f"<tbody>\n{body}\n</tbody></table></div>"
    )


def _verdict_heads(words: dict[str, str]) -> list[str]:
    return [words[name] for name in
            ("figure", "limit", "measured", "margin", "verdict", "sure", "provenance")]  # fmt: skip


def _verdicts(table: dict[str, Any], words: dict[str, str], language: str) -> str:
    heads = [words[name] for name in ("test", "figure", "limit", "measured", "margin", "verdict")]
    top = "".join(f'<th scope="col">{escape(head)}</th>' for head in heads)
    body = []
    for test in table["tests"]:
        anchor = f'<a href="#t-{escape(test["name"])}">{escape(test["name"])}</a>'
        name = f"{anchor} {escape(cells.title(test, language))}"
        if test["problem"]:
            body.append(
                f'<tr><th scope="row">{name}</th><td colspan="5" class="note">'
                f"{escape(test['problem'])}</td></tr>"
            )
        for limit in test["limits"]:
            mark = {"kept": "good", "missed": "bad"}.get(limit["verdict"], "")
            cell = (
                cells.label(limit, language),
                cells.bound(limit, words),
                cells.figure(limit["value"], limit["unit"], words),
                cells.margin(limit),
            )
            body.append(
                f'<tr><th scope="row">{name}</th>'
                + "".join(f"<td>{escape(one)}</td>" for one in cell)
                + f'<td class="{mark}">{escape(words[limit["verdict"]])}</td></tr>'
            )
            name = ""
    return (
        f'<div class="scroll"><table class="words"><thead><tr>{top}</tr></thead><tbody>\n'
        + "\n".join(body)
        + "\n</tbody></table></div>"
    )


def _nearest(runs: Sequence[dict[str, Any]], words: dict[str, str]) -> str:
    rows = [
        [f"{run['test']}.{run['number']}", f"{run['seed']}/{run['index']}",
         f"{run['margin']:+.2%}" if isinstance(run["margin"], float | int) else "–"]
        for run in runs
    ]  # fmt: skip
    return _grid([words["run"], words["seed"], words["margin"]], rows)


def _comparison(compared: Sequence[Any], words: dict[str, str], language: str) -> str:
    if not compared:
        return ""
    rows = []
    for one in compared:
        changed = ""
        if one.is_newly_missed:
            changed = words["newly_missed"]
        elif one.verdict_before == "missed" and one.verdict_after == "kept":
            changed = words["now_kept"]
        rows.append(
            [one.test, one.label_de if language == "de" else one.label,
             cells.figure(one.before, one.unit, words), words[one.verdict_before],
             cells.figure(one.after, one.unit, words), words[one.verdict_after], changed]
        )  # fmt: skip
    heads = [words["test"], words["limit"], words["before"], words["verdict"], words["after"],
             words["verdict"], ""]  # fmt: skip
    grid = _grid(heads, rows, "words")
    return f"<section><h2>{escape(words['compared'])}</h2>{grid}</section>"


def _test(table: dict[str, Any], test: dict[str, Any], words: dict[str, str], language: str) -> str:
    facts = [
        f"{words['speed']}: {test['speed_kmh']:g} km/h" if test["speed_kmh"] is not None else "",
        f"{words['rail']}: {test['rail']}" if test["rail"] else "",
        f"{words['faults']}: {'; '.join(test['faults'])}" if test["faults"] else "",
        *(
            f"{words['valid_when']}: {cells.label(one, language)} {_window(one, words)} "
            f"({one['source']})"
            for one in test["validity"]
        ),
        words["valid_runs"].format(
            valid=test["valid_runs"], wanted=test["wanted"], tried=test["tried"]
        ),
        test["problem"],
    ]
    parts = [
        f'<section class="test"><h2 id="t-{escape(test["name"])}">{escape(test["name"])}: '
        f"{escape(cells.title(test, language))}</h2>",
        *(f'<p class="small">{escape(fact)}</p>' for fact in facts if fact),
    ]
    if test["limits"]:
        rows = cells.verdict_rows(test, words, language)
        parts.append(_grid(_verdict_heads(words), rows, "words"))
    if test["runs"]:
        heads = [words[n] for n in ("figure", "mean_of", "interval", "least", "greatest")]
        parts.append(f"<h3>{escape(words['figures'])}</h3>")
        parts.append(_grid(heads, cells.figure_rows(test, words, language)))
        run_heads, rows = cells.run_rows(test, words)
        parts.append(f"<details><summary>{escape(words['runs'])}</summary>{_grid(run_heads, rows)}")
        parts += [_run(table, test, run, words) for run in test["runs"]]
        parts.append("</details>")
    return "\n".join(parts) + "</section>"


def _window(window: dict[str, Any], words: dict[str, str]) -> str:
    sides = (("at_least", window["least"]), ("at_most", window["greatest"]))
    return ", ".join(f"{words[side]} {value}" for side, value in sides if value is not None)


def _run(
    table: dict[str, Any], test: dict[str, Any], run: dict[str, Any], words: dict[str, str]
) -> str:
    drawn = run_charts(run["curves"], words, cells.thresholds(table))
    charts = "".join(
        f"<figure><figcaption>{escape(told)}</figcaption>{_key(lines)}{picture}</figure>"
        for told, lines, picture in drawn
    )
    state = f"{words['invalid']}: {run['invalid']}" if run["invalid"] else run["status"]
    return (
        f'<div class="run"><h3>{escape(test["name"])}.{run["number"]} · {escape(state)}</h3>'
        f'<div class="charts">{charts}</div></div>'
    )


def _key(lines: Sequence[Line]) -> str:
    named = "".join(
        f'<span class="{line.kind}">{escape(line.label)}</span>' for line in lines if line.label
    )
    return f'<div class="names">{named}</div>'
