"""The states of the adaptive supervisor, drawn from the table that the code itself has."""

from __future__ import annotations

import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from railgrip.control.adaptive_states import STATES, TRANSITIONS

if TYPE_CHECKING:
    from sphinx.application import Sphinx

# Two columns, as in the source's figure 2: the system in macro-slip, the system in micro-slip.
GAP = 2.3
PLACES = {
    **{301.0 + row: (0.0, -float(row)) for row in range(6)},
    **{307.0 + row: (GAP, -float(row)) for row in range(8)},
}
HALF = 0.37  # width of a box
BOW = {  # ways past other states of their column: how far beside it
    (305.0, 304.0): 0.5, (306.0, 301.0): -0.75, (306.0, 302.0): -0.55, (308.0, 312.0): -0.75,
    (310.0, 312.0): -0.5, (314.0, 307.0): 0.75, (314.0, 308.0): 0.5,
}  # fmt: skip
LABEL = {(306.0, 307.0): 0.1, (309.0, 301.0): 0.3, (314.0, 301.0): 0.1}  # share of the way across


def setup(app: Sphinx) -> dict[str, Any]:
    """Let the diagram be drawn before Sphinx looks for pictures."""
    app.connect("config-inited", lambda app, _config: draw(Path(app.confdir) / "_generated"))
    return {"parallel_read_safe": True}


def draw(folder: Path) -> Path:
    """Draw the diagram into a folder and return its file."""
    import matplotlib as mpl
    from matplotlib.figure import Figure

    folder.mkdir(parents=True, exist_ok=True)
    figure = Figure(figsize=(11, 9))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(-1.05, GAP + 1.15), ylim=(-7.5, 0.75))
    axes.axis("off")
    axes.text(0, 0.55, "system in macro-slip", ha="center", weight="bold")
    axes.text(GAP, 0.55, "system in micro-slip", ha="center", weight="bold")
    for number, (x, y) in PLACES.items():
        _box(axes, x, y, number)
    for way in TRANSITIONS:
        _arrow(axes, (way.before, way.after), way.when)
    path = folder / "adaptive_states.svg"
    with mpl.rc_context({"svg.hashsalt": "railgrip"}):
        figure.savefig(path, metadata={"Date": None})
    return path


def _box(axes: Any, x: float, y: float, number: float) -> None:
    asks = STATES[number].endswith("?")
    text = "\n".join(textwrap.wrap(STATES[number], 26))
    style = {"boxstyle": "round,pad=0.35", "facecolor": "#fff4d6" if asks else "#e3eef9"}
    axes.text(
        x, y, f"{number:.0f}  {text}", ha="center", va="center", fontsize=8.5,
        bbox={**style, "edgecolor": "#456"},
    )  # fmt: skip


def _arrow(axes: Any, pair: tuple[float, float], when: str) -> None:
    (x1, y1), (x2, y2) = PLACES[pair[0]], PLACES[pair[1]]
    style: dict[str, Any] = {"arrowstyle": "-|>", "color": "#456", "lw": 1.1}
    if x1 != x2:
        across = HALF if x2 > x1 else -HALF
        start, end = x1 + across, x2 - across
        axes.annotate("", (end, y2), (start, y1), arrowprops=style)
        share = LABEL[pair]
        _label(axes, start + share * (end - start), y1 + share * (y2 - y1), when, "center")
    elif pair in BOW:
        side = HALF if BOW[pair] > 0 else -HALF
        far = x1 + BOW[pair]
        axes.plot([x1 + side, far, far], [y1 - 0.07, y1 - 0.07, y2 + 0.07], color="#456", lw=1.1)
        axes.annotate("", (x2 + side, y2 + 0.07), (far, y2 + 0.07), arrowprops=style)
        where = (y1 + y2) / 2 if pair != (308.0, 312.0) else -4.6
        _label(axes, far, where, "\n".join(textwrap.wrap(when, 11)), "center")
    else:
        axes.annotate("", (x2, y2 + 0.24), (x1, y1 - 0.24), arrowprops=style)
        _label(axes, x1 + 0.03, (y1 + y2) / 2, when, "left")


def _label(axes: Any, x: float, y: float, text: str, align: str) -> None:
    axes.text(
        x, y, text, fontsize=8, style="italic", ha=align, va="center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
    )  # fmt: skip
