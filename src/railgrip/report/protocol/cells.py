"""What stands in the tables of a protocol, the same for page and PDF."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

Table = Mapping[str, Any]
Words = Mapping[str, str]


def label(entry: Table, language: str) -> str:
    """Return an entry's words in the language."""
    return str(entry["label_de" if language == "de" else "label"])


def title(test: Table, language: str) -> str:
    """Return a test's title in the language."""
    return str(test["title_de" if language == "de" else "title"])


def figure(value: Any, unit: str, words: Words) -> str:
    """Return a figure with its unit; a dash where there is none.

    Examples
    --------
    >>> figure(0.4, "s", {}), figure(None, "s", {})
    ('0.4 s', '–')
    """
    if value is None:
        return "–"
    if value == "infinite":
        return words["infinite"]
    return f"{value:.4g} {unit}".rstrip()


def bound(limit: Table, words: Words) -> str:
    """Return a limit in words."""
    sides = [
        f"{words[side]} {figure(limit[name], limit['unit'], words)}"
        for side, name in (("at_least", "least"), ("at_most", "greatest"))
        if limit[name] is not None
    ]
    return f"{', '.join(sides)} ({words[limit['judged']]})"


def margin(limit: Table) -> str:
    """Return how far the limit is kept, or missed, over the limit."""
    value = limit["margin"]
    if value is None or isinstance(value, str):
        return "–"
    zero = limit["greatest"] == 0 or limit["least"] == 0
    return f"{value:+.3g} {limit['unit']}".rstrip() if zero else f"{value:+.1%}"


def sure(limit: Table, words: Words) -> str:
    """Return how sure the verdict is."""
    share = limit["sure"]
    if share is None or limit["verdict"] == "not applicable":
        return "–"
    return words[f"sure_{limit['judged']}"].format(share=share)


def verdict_rows(test: Table, words: Words, language: str) -> list[list[str]]:
    """Return the rows: limit, bound, measured, margin, verdict, confidence, provenance."""
    return [
        [label(limit, language), bound(limit, words), figure(limit["value"], limit["unit"], words),
         margin(limit), words[limit["verdict"]], sure(limit, words), limit["source"]]
        for limit in test["limits"]
    ]  # fmt: skip


def figure_rows(test: Table, words: Words, language: str) -> list[list[str]]:
    """Return the rows: figure, mean, its interval, least, greatest."""
    rows = []
    for one in test["figures"]:
        unit = one["unit"]
        interval = "–"
        if one["mean_low"] is not None and not isinstance(one["mean_low"], str):
            interval = f"{one['mean_low']:.4g} … {one['mean_high']:.4g} {unit}".rstrip()
        rows.append(
            [label(one, language), figure(one["mean"], unit, words), interval,
             figure(one["least"], unit, words), figure(one["greatest"], unit, words)]
        )  # fmt: skip
    return rows


def run_rows(test: Table, words: Words) -> tuple[list[str], list[list[str]]]:
    """Return heads and rows: run, seed, end, valid, margin and every figure shown."""
    shown = test["figures"]
    heads = [words["run"], words["seed"], words["status"], words["valid"], words["margin"]]
    heads += [f"{one['metric']}{', ' + one['unit'] if one['unit'] else ''}" for one in shown]
    rows = []
    for run in test["runs"]:
        kept = run["margin"]
        rows.append(
            [f"{test['name']}.{run['number']}", f"{run['seed']}/{run['index']}", run["status"],
             f"{words['invalid']}: {run['invalid']}" if run["invalid"] else words["valid"],
             f"{kept:+.1%}" if isinstance(kept, float | int) else "–",
             *(figure(run["figures"][one["metric"]], "", words) for one in shown)]
        )  # fmt: skip
    return heads, rows


def identification_rows(table: Table, words: Words) -> list[list[str]]:
    """Return what was tested, by what, with which versions."""
    found, train = table["identification"], table["train"]
    parameters = ", ".join(f"{name} {value:.6g}" for name, value in found["parameters"].items())
    delays = train["valve_delays_ms"]
    return [
        [words["version"], found["railgrip"]],
        [words["controller"], found["controller"]],
        [words["controller_hash"], found["controller_hash"]],
        [words["parameters"], parameters or "–"],
        [words["profile"], f"{found['profile']}: {found['profile_title']}"],
        [words["profile_source"], found["profile_source"] or "–"],
        [words["profile_hash"], found["profile_hash"]],
        [words["seed"], str(found["seed"])],
        [words["vehicle"], f"{train['name']}: {train['title']} ({train['source']})"],
        [words["axles"], str(train["axles"])],
        [words["mass"], f"{train['mass_t']:g}"],
        [words["length"], f"{train['length_m']:g}"],
        [words["v_max"], f"{train['v_max_kmh']:g}" if train["v_max_kmh"] else "–"],
        [words["teeth"], str(train["sensor_teeth"])],
        [words["valve_delays"], f"{delays[0]}, {delays[1]}" if delays else "–"],
    ]


def outcome(table: Table, words: Words) -> tuple[bool, list[str]]:
    """Return whether all is well, and the sentences that say so."""
    summary = table["summary"]
    judged = summary["kept"] + summary["missed"]
    well = summary["missed"] == 0 and summary["incomplete"] == 0
    said = [words["all_kept"] if summary["missed"] == 0
            else words["some_missed"].format(missed=summary["missed"], all=judged)]  # fmt: skip
    if summary["incomplete"]:
        said.append(words["incomplete"].format(count=summary["incomplete"]))
    said.append(words["summary"].format(**summary))
    return well, said


def thresholds(table: Table) -> list[float]:
    """Return the slip thresholds of the controller, where it names them, [%]."""
    parameters = table["identification"]["parameters"]
    return [100.0 * parameters[name] for name in ("slip_lower", "slip_upper") if name in parameters]
