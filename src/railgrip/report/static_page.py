"""The frame of pages without scripts: head, style, tables, pictures; light, dark, phone, paper."""

from __future__ import annotations

import base64
import hashlib
import io
from collections.abc import Iterable, Sequence
from html import escape
from importlib.resources import files
from typing import Any

STYLE = """
body { max-width: 62rem; }
p { max-width: 48rem; }
.scroll { margin: .3rem 0 1rem; }
.notice { border-left: 4px solid var(--bad); padding: .3rem .8rem; background: var(--card); }
.scroll > img { height: auto; max-width: max(100%, 34rem); display: block; }
@media screen and (prefers-color-scheme: dark) {
  .scroll > img { filter: invert(.91) hue-rotate(180deg); }
}
@media (max-width: 600px) { td { white-space: nowrap; } }
td.text, th.text { text-align: left; white-space: normal; }
"""
"""Pictures scroll rather than shrink below what the eye can read; in the dark they are inverted."""


def template(name: str) -> str:
    """Return a file of the report's templates as text."""
    return (files("railgrip.report") / "template" / name).read_text(encoding="utf-8")


def static_page(title: str, body: Iterable[str], style: str = "") -> str:
    """Return a page that loads nothing and runs nothing.

    Parameters
    ----------
    title : str
        Of the browser's window; the body has its own heading.
    body : iterable of str
        HTML.
    style : str
        CSS beyond that of all reports.

    Examples
    --------
    >>> page = static_page("Stops", [heading("Stops"), table(["", "m"], [["dry", "480"]])])
    >>> "<script" in page, page.count("<h1>")
    (False, 1)
    """
    sheet = template("page.css") + STYLE + style
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy([], sheet)}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta name="color-scheme" content="light dark">\n<link rel="icon" href="data:,">\n'
        f"<title>{escape(title)}</title>\n<style>{sheet}</style>\n</head>\n<body>\n"
        + "\n".join(body)
        + "\n</body>\n</html>\n"
    )


def heading(title: str, notice: str = "Simulation, not an approval.", lead: str = "") -> str:
    """Return the head of a page: title, what must not be overlooked, a sentence."""
    said = f'\n<p class="small">{escape(lead)}</p>' if lead else ""
    return f'<h1>{escape(title)}</h1>\n<p class="notice">{escape(notice)}</p>{said}'


def table(
    heads: Sequence[str], rows: Iterable[Iterable[str]], caption: str = "", kind: str = ""
) -> str:
    """Return a table that scrolls by itself; the first cell of each row is its head.

    Examples
    --------
    >>> table(["", "m"], [["dry", "480"]]).count("<td>")
    1
    """
    of = f' class="{kind}"' if kind else ""
    told = f"<caption>{escape(caption)}</caption>" if caption else ""
    top = "".join(f'<th scope="col"{of}>{escape(head)}</th>' for head in heads)
    lines = []
    for first, *rest in rows:
        cells = "".join(f"<td{of}>{escape(str(cell))}</td>" for cell in rest)
        lines.append(f'<tr><th scope="row">{escape(str(first))}</th>{cells}</tr>')
    return (
        f'<div class="scroll"><table>{told}<thead><tr>{top}</tr></thead>'
        f"<tbody>{''.join(lines)}</tbody></table></div>"
    )


def picture(figure: Any, words: str) -> str:
    """Return a figure of Matplotlib within the page; ``words`` say what it shows."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=144)
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    width = round(96 * figure.get_figwidth())
    source = f"data:image/png;base64,{data}"
    return f'<div class="scroll"><img alt="{escape(words)}" width="{width}" src="{source}"></div>'


def policy(scripts: Iterable[str], style: str) -> str:
    """Return a policy that lets exactly these scripts and this style run, and loads nothing."""
    hashes = " ".join(f"'sha256-{_sha256(script)}'" for script in scripts) or "'none'"
    return (
        f"default-src 'none'; script-src {hashes}; style-src 'sha256-{_sha256(style)}'; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )


def _sha256(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
