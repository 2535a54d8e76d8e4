"""Creep curves of several laws side by side: solid where a law is valid, dashed beyond."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from railgrip.laboratory.law_comparison import EXACT, LawComparison
from railgrip.report.contact_axes import component, force_label, place, shown_force
from railgrip.report.plots.style import PALETTE, beside, styled
from railgrip.report.view import Array

_COLOURS = (*PALETTE, "#8C510A", "#7F7F7F", "#B2182B", "#4D4D9A")
_EXACT_COLOUR = "#000000"
_DASHES = (0, (4, 3))
_LEAST_DIFFERENCE = 0.1  # per cent of μ0 Q: below it the panel would show rounding


class _Panel(NamedTuple):
    """One set of axes: the label of its y axis and a curve a law."""

    label: str
    curves: dict[str, Array]
    least: float = 0.0


def curves_figure(
    found: LawComparison,
    swept: str,
    *,
    title: str = "",
    over: str = "creepage",
    show: str = "adhesion",
    reference: str = "",
) -> Figure:
    """Draw the curves of a sweep; with several laws their differences too, with spin the moment.

    Parameters
    ----------
    found : LawComparison
        Two points or more.
    swept : str
        ``longitudinal``, ``lateral``, ``spin``, ``speed`` or ``load``.
    title : str
        Second line of the heading.
    over : {"creepage", "slip-speed"}
        What creepage is drawn as, in longitudinal and lateral sweeps.
    show : {"adhesion", "force"}
        What forces are drawn as.
    reference : str
        Law from which differences are taken; the first if not given.

    Returns
    -------
    matplotlib.figure.Figure
        One to three panels.
    """
    x, axis = place(found, swept, over)
    panels = _panels(found, swept, show, reference or found.laws[0])
    colours = _colours(found.laws)
    with styled():
        made = Figure(figsize=(3.0 + 3.6 * len(panels), 4.6))
        made.suptitle(f"{_heading(swept)}\n", x=0.01, ha="left", weight="bold")
        made.text(0.01, 1 - 0.27 / 4.6, title, ha="left", va="top", fontsize=8.5, color="#555555")
        for axes, panel in zip(np.ravel(made.subplots(1, len(panels))), panels, strict=True):
            for k, (law, values) in enumerate(panel.curves.items()):
                # the earlier ones are drawn wider, so that curves that coincide are all seen
                width = 1.2 + 0.15 * (len(panel.curves) - 1 - k)
                _draw(axes, x, values, found.forces[law].is_valid, colours[law], width)
            axes.set(xlabel=axis.label, ylabel=panel.label)
            axes.set_ylim(*_limits(panel, found))
        beside(made.axes[-1], handles=_legend(found, colours))
    return made


def _panels(found: LawComparison, swept: str, show: str, reference: str) -> list[_Panel]:
    curves = {law: shown_force(found, law, swept, show) for law in found.laws}
    panels = [_Panel(force_label(swept, show), curves)]
    others = [law for law in found.laws if law != reference]
    if others:
        panels.append(_differences(found, swept, reference, others))
    if swept == "spin" or np.any(found.spin):
        moments = {law: found.forces[law].spin_moment for law in found.laws}
        panels.append(_Panel("Spin moment, N m", moments))
    return panels


def _differences(found: LawComparison, swept: str, reference: str, others: Sequence[str]) -> _Panel:
    its = component(found, reference, swept)
    limit = np.where(found.friction_limit > 0.0, found.friction_limit, np.nan)
    curves = {law: 100 * (component(found, law, swept) - its) / limit for law in others}
    return _Panel(f"Force less that of {reference}, % of μ₀Q", curves, _LEAST_DIFFERENCE)


def _draw(
    axes: Axes, x: Array, values: Array, is_valid: NDArray[np.bool_], colour: str, width: float
) -> None:
    """Solid where valid; the dashed line begins at the last valid point, so nothing gapes."""
    axes.plot(x, np.where(is_valid, values, np.nan), color=colour, lw=width)
    beyond = ~is_valid
    beyond[:-1] |= ~is_valid[1:]
    beyond[1:] |= ~is_valid[:-1]
    axes.plot(x, np.where(beyond, values, np.nan), color=colour, lw=0.9, ls=_DASHES)


def _limits(panel: _Panel, found: LawComparison) -> tuple[float, float]:
    """Range of the valid points: a law that knows no limit must not flatten the others."""
    valid = [values[found.forces[law].is_valid] for law, values in panel.curves.items()]
    shown = np.concatenate([values[np.isfinite(values)] for values in valid])
    low, high = (shown.min(), shown.max()) if shown.size else (0.0, 1.0)
    low, high = min(float(low), -panel.least, 0.0), max(float(high), panel.least, 0.0)
    room = 0.06 * (high - low) or 1.0
    return (low - room if low < 0.0 else 0.0), (high + room if high > 0.0 else 0.0)


def _colours(laws: Sequence[str]) -> dict[str, str]:
    fast = [law for law in laws if law != EXACT]
    colours = {law: _COLOURS[k % len(_COLOURS)] for k, law in enumerate(fast)}
    return {**colours, EXACT: _EXACT_COLOUR}


def _legend(found: LawComparison, colours: dict[str, str]) -> list[Line2D]:
    handles = [Line2D([], [], color=colours[law], lw=1.4, label=law) for law in found.laws]
    if not all(forces.is_valid.all() for forces in found.forces.values()):
        beyond = "beyond the law's validity"
        handles.append(Line2D([], [], color="#555555", lw=0.9, ls=_DASHES, label=beyond))
    return handles


def _heading(swept: str) -> str:
    words = {"speed": "the speed of the train", "load": "the wheel load", "spin": "spin"}
    return f"Creep forces over {words.get(swept, f'{swept} creepage')}"
