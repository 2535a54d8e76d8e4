"""What differs between two runs, in words: who stops shorter, slides less, stays cooler."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from railgrip.report.metrics import SOURCES, Metric
from railgrip.report.units import shown


class Wording(NamedTuple):
    """How a difference is told: ``{}`` stands for its size with unit."""

    more: str
    less: str
    equal: str = ""


WORDS: dict[str, Wording] = {
    "stopping_distance": Wording("stops {} longer", "stops {} shorter", "stops as short"),
    "covered_distance": Wording("covers {} more", "covers {} less"),
    "slid_energy": Wording(
        "has {} more slid energy on its worst axle",
        "has {} less slid energy on its worst axle",
    ),
    "flash_temperature": Wording(
        "its hottest contact rises {} further", "its hottest contact rises {} less"
    ),
    "locked_time": Wording("its longest lock lasts {} longer", "its longest lock is {} shorter"),
    "air_used": Wording("takes {} more air", "takes {} less air"),
}
"""Figures worth a sentence, in its order."""


def difference(
    name: str, own: Sequence[Metric], other: Sequence[Metric], other_name: str = ""
) -> str:
    """Return how a run differs from another, as one sentence.

    Parameters
    ----------
    name : str
        Of the run.
    own, other : sequence of Metric
        Figures of the run, and of the one it is compared with.
    other_name : str
        Of the run it is compared with.

    Examples
    --------
    >>> short = [Metric("stopping_distance", "", 400.0, "m", "")]
    >>> long = [Metric("stopping_distance", "", 500.0, "m", "")]
    >>> difference("careful", long, short, "bold")
    'careful stops 100.0 m (25.0 %) longer than bold.'
    """
    known = {metric.name: metric.value for metric in other}
    mine = {metric.name: metric.value for metric in own}
    than = f" than {other_name}" if other_name else ""
    stops, stopped = mine.get("stopping_distance"), known.get("stopping_distance")
    parts = []
    if stops is not None and stopped is not None and (stops != stops) != (stopped != stopped):
        parts.append("does not come to a stand" if stops != stops else "comes to a stand")
    parts += [
        told
        for figure in WORDS
        if figure in mine and figure in known
        and (told := _told(figure, mine[figure], known[figure]))
    ]  # fmt: skip
    if not parts:
        return f"{name} does the same as {other_name}."
    words = f"{parts[0]}{than}" if "{}" not in parts[0] else parts[0]
    return f"{name} {'; '.join([words, *parts[1:]])}."


def _told(figure: str, mine: float, known: float) -> str:
    """Return the words for one figure, nothing where it says nothing."""
    if mine != mine or known != known:
        return ""
    how = shown(SOURCES[figure].variable)
    change = round(mine - known, max(how.decimals, 0))
    if change == 0.0:
        return ""
    size = f"{abs(change):.{max(how.decimals, 0)}f} {how.unit}"
    share = abs(change / known) if known else 0.0
    size += f" ({share:.1%})".replace("%", " %") if 0.0005 <= share <= 2.0 else ""
    words = WORDS[figure].more if change > 0.0 else WORDS[figure].less
    return words.format(size)


def differences(runs: Mapping[str, Sequence[Metric]], reference: str) -> list[str]:
    """Return a sentence for each run but the reference, which it is compared with.

    Examples
    --------
    >>> runs = {"a": [Metric("air_used", "", 300.0, "Nl", "")],
    ...         "b": [Metric("air_used", "", 240.0, "Nl", "")]}
    >>> differences(runs, "b")
    ['a takes 60 Nl (25.0 %) more air than b.']
    """
    base = runs[reference]
    return [
        difference(name, figures, base, reference)
        for name, figures in runs.items()
        if name != reference
    ]
