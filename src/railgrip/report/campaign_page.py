"""One self-contained page about a campaign: figures as pictures, tables as text, no script."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from html import escape
from typing import Any, NamedTuple

STYLE = """
:root{color-scheme:light dark;--ink:#1c1f24;--paper:#fff;--card:#f3f5f7;--line:#d5d9df}
@media screen and (prefers-color-scheme:dark){
:root{--ink:#e6eaed;--paper:#14191d;--card:#1e252b;--line:#35404a}}
body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;
padding:0 1rem;color:var(--ink);background:var(--paper);overflow-wrap:break-word}
table{border-collapse:collapse;margin:1rem 0;display:block;overflow-x:auto}
th,td{padding:.25rem .8rem;text-align:right;border-bottom:1px solid var(--line)}
th:first-child,td:first-child{text-align:left}
.picture{overflow-x:auto}.picture img{max-width:100%;height:auto;background:#fff;border-radius:4px}
pre{overflow:auto;background:var(--card);padding:1rem}
.note{border-left:4px solid #0b5fa5;padding:.3rem 1rem;background:var(--card)}
@media (max-width:600px){h1{font-size:1.5rem}th,td{padding:.2rem .45rem;white-space:nowrap}
td:first-child{white-space:normal}.picture img{max-width:none;width:36rem}}
"""
"""Of a page without scripts: light or dark as its reader likes; on a phone tables scroll."""


class Section(NamedTuple):
    """A heading with sentences, a table and a picture, each of which may be empty."""

    title: str
    text: str = ""
    columns: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    figure: Any = None
    preformatted: str = ""


def campaign_html(title: str, lead: str, sections: Sequence[Section]) -> str:
    """Return the page; it loads nothing and runs nothing.

    Examples
    --------
    >>> "<script" in campaign_html("Stops", "1000 runs.", [Section("Runs", "All stopped.")])
    False
    """
    body = "".join(_section(one) for one in sections)
    policy = "default-src 'none'; style-src 'unsafe-inline'; img-src data:"
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{escape(title)}</title><style>{STYLE}</style></head><body>"
        f'<h1>{escape(title)}</h1><p class="note">Simulation, not an approval.</p>'
        f"<p>{escape(lead)}</p>{body}</body></html>\n"
    )


def _section(one: Section) -> str:
    parts = [f"<h2>{escape(one.title)}</h2>"]
    if one.text:
        parts.append(f"<p>{escape(one.text)}</p>")
    if one.rows:
        head = "".join(f"<th>{escape(name)}</th>" for name in one.columns)
        lines = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in one.rows)
        rows = "".join(f"<tr>{line}</tr>" for line in lines)
        parts.append(f"<table><tr>{head}</tr>{rows}</table>")
    if one.figure is not None:
        parts.append(picture(one.figure, one.title))
    if one.preformatted:
        parts.append(
            f"<details><summary>show</summary><pre>{escape(one.preformatted)}</pre></details>"
        )
    return "".join(parts)


def picture(figure: Any, meaning: str) -> str:
    """Return a figure of Matplotlib as the element that shows it; ``meaning`` is read out."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=110)
    source = "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")
    return f'<div class="picture"><img alt="{escape(meaning)}" src="{source}"></div>'
