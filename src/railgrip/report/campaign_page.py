"""One self-contained page about a campaign: figures as pictures, tables as text, no script."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import Any, NamedTuple

from railgrip.report.static_page import heading, picture, static_page, table


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
    parts = [heading(title, lead=lead), *(_section(one) for one in sections)]
    return static_page(title, parts)


def _section(one: Section) -> str:
    parts = [f"<h2>{escape(one.title)}</h2>"]
    if one.text:
        parts.append(f"<p>{escape(one.text)}</p>")
    if one.rows:
        parts.append(table(one.columns, one.rows))
    if one.figure is not None:
        parts.append(picture(one.figure, one.title))
    if one.preformatted:
        parts.append(
            f"<details><summary>show</summary><pre>{escape(one.preformatted)}</pre></details>"
        )
    return "".join(parts)
