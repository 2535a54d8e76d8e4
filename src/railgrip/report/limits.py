"""The limits of a scenario, held against what the run gave."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from railgrip.core.errors import RailgripError, unknown_name
from railgrip.report.metrics import SOURCES, si_value
from railgrip.report.units import shown, written
from railgrip.report.view import View, dataset_of

AT_LEAST = frozenset({"mean_deceleration", "adhesion_utilisation"})
"""Metrics of which more is better; every other limit is an upper one.

A limit that ends in ``_least`` or ``_greatest`` says so itself.
"""


class Verdict(NamedTuple):
    """One limit and how the run stood against it.

    Attributes
    ----------
    name, label : str
        Metric; in words.
    value, limit : float
        In `unit`.
    unit : str
        The engineer's unit.
    passed : bool
        A value that the run does not have never passes.
    text : str
        One line: label, value, limit, passed or missed.
    """

    name: str
    label: str
    value: float
    limit: float
    unit: str
    passed: bool
    text: str


def check_limits(result: Any, limits: Mapping[str, float], run: int = 0) -> list[Verdict]:
    """Return the verdict on each limit.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave.
    limits : mapping
        Metric → limit, SI; None counts as no limit. ``mean_deceleration`` and
        ``adhesion_utilisation`` are lower limits, all others upper ones, unless the name ends in
        ``_least`` or ``_greatest``.
    run : int
        Which run of the batch.

    Returns
    -------
    list of Verdict
        In the order of `limits`.

    Raises
    ------
    RailgripError
        ``limits: metric 'stoping_distance' unknown; known: …; did you mean 'stopping_distance'?``

    Examples
    --------
    >>> import xarray as xr
    >>> data = xr.Dataset({"stopping_distance": ("run", [1007.04])})
    >>> check_limits(data, {"stopping_distance": 1000.0})[0].text
    'Stopping distance: 1007.0 m, limit at most 1000.0 m, missed'
    """
    view = View(dataset_of(result), run)
    given = {name: float(limit) for name, limit in limits.items() if limit is not None}
    wrong = [name for name in given if _metric(name)[0] not in SOURCES]
    if wrong:
        raise RailgripError([unknown_name("limits", "metric", name, SOURCES) for name in wrong])
    return [_verdict(view, *_metric(name), limit) for name, limit in given.items()]


def _metric(name: str) -> tuple[str, bool]:
    """Return the metric that a limit is for and whether it is a lower limit."""
    for ending, lower in (("_least", True), ("_greatest", False)):
        if name.endswith(ending):
            return name.removesuffix(ending), lower
    return name, name in AT_LEAST


def _verdict(view: View, name: str, lower: bool, limit: float) -> Verdict:
    value, _ = si_value(view, name)
    passed = value >= limit if lower else value <= limit
    source = SOURCES[name]
    how = shown(source.variable)
    side = "at least" if lower else "at most"
    value, limit = value * how.factor, limit * how.factor
    text = (
        f"{source.label}: {written(value, how)}, limit {side} {written(limit, how)}, "
        f"{'passed' if passed else 'missed'}"
    )
    return Verdict(name, source.label, value, limit, how.unit, passed, text)
