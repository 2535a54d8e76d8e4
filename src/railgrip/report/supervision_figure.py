"""The curves of the supervision in one figure: speed over the distance before the target."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from railgrip.control.etcs.supervision import SupervisionLimits
from railgrip.report.plots.style import beside, styled

LOOKS = {
    "ebd": ("#8B0000", "-", "EBD, emergency brake deceleration"),
    "sbd": ("#E69F00", "-", "SBD, service brake deceleration"),
    "gui": ("#009E73", "-", "GUI, guidance"),
    "ebi": ("#B2182B", "--", "EBI, emergency brake intervenes"),
    "sbi2": ("#D55E00", "--", "SBI2, service brake before EBI"),
    "sbi1": ("#E69F00", "--", "SBI1, service brake before SBD"),
    "warning": ("#CC79A7", "-", "Warning"),
    "permitted": ("#0072B2", "-", "Permitted speed"),
    "indication": ("#56B4E9", "-", "Indication"),
}
"""Colour, line and words of each curve, from the target outwards."""


def supervision_figure(limits: SupervisionLimits, title: str = "") -> Figure:
    """Draw all curves and limits of one target.

    Parameters
    ----------
    limits : SupervisionLimits
        Over two speeds or more.
    title : str
        Second line of the heading.

    Returns
    -------
    matplotlib.figure.Figure
        The target stands at the right; curves that are not there are left out.
    """
    with styled():
        made = Figure(figsize=(9.5, 4.6))
        made.suptitle("ETCS supervision: speed before the target\n", x=0.01, ha="left",
                      weight="bold")  # fmt: skip
        made.text(0.01, 1 - 0.27 / 4.6, title, ha="left", va="top", fontsize=8.5, color="#555555")
        axes = made.subplots()
        for order, (name, (colour, line, words)) in enumerate(LOOKS.items()):
            distance = getattr(limits, name)
            # curves that coincide are all seen: the earlier ones are drawn wider
            if np.isfinite(distance).any():
                axes.plot(-distance, 3.6 * limits.speed, color=colour, ls=line, label=words,
                          lw=2.6 - 0.18 * order)  # fmt: skip
        axes.set(xlabel="Distance to the target, m (negative: before it)", ylabel="Speed, km/h")
        axes.set_ylim(bottom=0.0)
        beside(axes)
    return made
