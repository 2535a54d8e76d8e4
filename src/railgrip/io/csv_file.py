"""Results as CSV: traces as one wide table, outcomes as one row a run."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem, RailgripError, unknown_name
from railgrip.core.signals import SIGNALS

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


def write_csv(
    result: Any,
    path: str | os.PathLike[str],
    *,
    run: int = 0,
    signals: Iterable[str] | None = None,
) -> Path:
    """Write the traces of a run, one row for each moment until its end.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave, with traces.
    path : path
        The CSV file.
    run : int
        Which run of the batch.
    signals : iterable of str, optional
        Names of the signal catalogue; every trace if not given.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    RailgripError
        ``signals: signal 'train_sped' unknown; known: …; did you mean 'train_speed'?``

    Notes
    -----
    Columns: ``time_s``, then ``train_speed_m_s``, ``wheel_speed_m_s:C1-V1-B1-A1``, … SI with
    the unit in the name (``m_s2`` is m/s²; ratios have none), nine digits, empty where undefined.
    """
    data = _dataset(result)
    if not 0 <= run < data.sizes.get("run", 1):
        allowed = f"0 to {data.sizes['run'] - 1}"
        raise RailgripError(Problem("run", f"there is no run {run}", allowed=allowed))
    one = data.isel(run=run) if "run" in data.dims else data
    names = _traces(one, signals)
    columns = [("time_s", np.asarray(one["time"].values, dtype=float))]
    for name in names:
        columns += _columns(one, name)
    end = _steps(one)
    table = np.column_stack([values[:end] for _, values in columns])
    return _write(Path(path), [name for name, _ in columns], table)


def write_outcomes_csv(result: Any, path: str | os.PathLike[str]) -> Path:
    """Write the outcomes, one row for each run.

    Parameters
    ----------
    result : Result or xarray.Dataset
        What the engine gave; a batch is as good as one run.
    path : path
        The CSV file.

    Returns
    -------
    Path
        The file written: ``run``, ``stopping_distance_m``, …, ``axle_slid_energy_J:C1-V1-B1-A1``.
    """
    data = _dataset(result)
    runs = np.arange(data.sizes["run"]) if "run" not in data.coords else data["run"].values
    columns = [("run", np.asarray(runs, dtype=float))]
    for name in map(str, data.data_vars):
        if data[name].dims == ("run",):
            columns.append((_head(name), np.asarray(data[name].values, dtype=float)))
        elif set(data[name].dims) == {"run", "axle"}:
            rows = np.asarray(data[name].transpose("axle", "run").values, dtype=float)
            labels = data["axle"].values
            columns += [(f"{_head(name)}:{a}", row) for a, row in zip(labels, rows, strict=True)]
    table = np.column_stack([values for _, values in columns])
    return _write(Path(path), [name for name, _ in columns], table)


def _dataset(result: Any) -> xr.Dataset:
    data: xr.Dataset = result if hasattr(result, "data_vars") else result.data
    return data


def _traces(one: xr.Dataset, signals: Iterable[str] | None) -> list[str]:
    present = [str(name) for name in one.data_vars if "time" in one[name].dims]
    order = {name: k for k, name in enumerate(SIGNALS)}
    present.sort(key=lambda name: (one[name].ndim, order.get(name, len(order))))
    if signals is None:
        return present
    wanted = list(signals)
    wrong = [name for name in wanted if name not in present]
    if wrong:
        raise RailgripError([unknown_name("signals", "signal", name, present) for name in wrong])
    return wanted


def _columns(one: xr.Dataset, name: str) -> Iterator[tuple[str, Array]]:
    values = np.asarray(one[name].transpose(..., "time").values, dtype=float)
    if values.ndim == 1:
        yield _head(name), values
        return
    other = str(next(dim for dim in one[name].dims if dim != "time"))
    labels = one[other].values if other in one.coords else range(len(values))
    for label, row in zip(labels, values, strict=True):
        yield f"{_head(name)}:{label}", row


def _head(name: str) -> str:
    unit = SIGNALS[name].unit if name in SIGNALS else "1"
    return name if unit == "1" else f"{name}_{unit.replace('/', '_').replace('^', '')}"


def _steps(one: xr.Dataset) -> int:
    if "train_speed" not in one:
        return one.sizes["time"]
    known = np.flatnonzero(np.isfinite(np.asarray(one["train_speed"].values, dtype=float)))
    return int(known[-1]) + 1 if len(known) else 0


def _write(target: Path, names: list[str], table: Array) -> Path:
    line = ",".join(["%.9g"] * len(names))
    with write_aside(target) as aside, Path(aside).open("w", encoding="utf-8", newline="") as file:
        file.write(",".join(_quoted(name) for name in names) + "\n")
        for row in table.tolist():
            file.write((line % tuple(row)).replace("nan", "") + "\n")
    return target


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"' if any(sign in name for sign in ',"\n') else name
