"""Measured stops → pad file, report and residuals."""

from __future__ import annotations

import csv
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from railgrip.core.atomic import write_aside
from railgrip.core.errors import Problem
from railgrip.io.measured.pad_channels import PadChannelMap, read_pad_channels
from railgrip.io.measured.pad_reading import PadMeasurement, read_pad_stops
from railgrip.laboratory.pad_fit import INFLUENCES, Identified, Score, compare_laws, identify_pad
from railgrip.laboratory.pad_fit.parameters import LEAST_STOPS

PAD, REPORT, RESIDUALS = "pad.toml", "report.html", "residuals.csv"
_UNITS = {"temperature": "degC", "speed": "m/s", "clamp_force": "N"}


class Identification(NamedTuple):
    """What a measurement says of a pad.

    Attributes
    ----------
    channels : PadChannelMap
        How it was read.
    measured : PadMeasurement
        What was read.
    found : Identified
        The pad.
    scores : list of Score
        Comparison of laws; empty with too few stops.
    """

    channels: PadChannelMap
    measured: PadMeasurement
    found: Identified
    scores: list[Score]

    @property
    def problems(self) -> list[Problem]:
        """What could not be used or found."""
        return [*self.measured.problems, *self.found.problems]


def identify(
    path: str | os.PathLike[str],
    channels: PadChannelMap | str | os.PathLike[str],
    progress: Callable[[str], None] | None = None,
) -> Identification:
    """Read a measurement, fit the pad, compare the laws.

    Parameters
    ----------
    path : path
        CSV, Parquet, MDF4 or TDMS.
    channels : PadChannelMap or path
        Which channel is what, and what shall be found.
    progress : callable, optional
        Told what goes on.

    Returns
    -------
    Identification
        With all that could be found; `problems` says what could not, and why.
    """
    tell = progress or (lambda words: None)
    wanted = channels if isinstance(channels, PadChannelMap) else read_pad_channels(channels)
    measured = read_pad_stops(path, wanted, lambda rows: tell(f"read {rows} rows"))
    tell(f"fitting {len(measured.labels)} stops")
    found = identify_pad(measured.stops, wanted.plan())
    scores = []
    if len(measured.labels) >= LEAST_STOPS:
        tell("comparing laws")
        scores = compare_laws(found)
    return Identification(wanted, measured, found, scores)


def write_identification(result: Identification, folder: Path) -> list[Path]:
    """Write pad file, report and residuals, each whole or not at all.

    Returns
    -------
    list of Path
        ``pad.toml``, ``report.html``, ``residuals.csv``.
    """
    from railgrip.report.identification import identification_html

    with write_aside(folder / PAD) as aside:
        aside.write_text(pad_toml(result), encoding="utf-8")
    with write_aside(folder / REPORT) as aside:
        page = identification_html(
            result.channels.title, result.channels.source, result.found, result.scores,
            result.measured.labels, result.problems,
        )  # fmt: skip
        aside.write_text(page, encoding="utf-8")
    with write_aside(folder / RESIDUALS) as aside:
        _write_residuals(result, aside)
    return [folder / name for name in (PAD, REPORT, RESIDUALS)]


def pad_toml(result: Identification) -> str:
    """Return the pad as TOML that a scenario uses directly, its intervals as comments."""
    import tomli_w

    found = result.found
    stops = len(result.measured.labels)
    table: dict[str, Any] = {
        "title": result.channels.title,
        "source": result.channels.source or f"identified by railgrip from {stops} stops",
    }
    pad = found.pad()
    for name in INFLUENCES:
        if name in pad:
            pad[name] = [[f"{x:.6g} {_UNITS[name]}", round(y, 6)] for x, y in pad[name]]
    pad["reference_friction"] = round(pad["reference_friction"], 6)
    lines = ["# Identified by railgrip; 95 % intervals, clustered by stop:"]
    lines += [f"#   {one.name} = {one.value:.6g}{_interval(one)} {one.unit}".rstrip()
              for one in found.parameters]  # fmt: skip
    lines += [f"# {' '.join(str(problem).split())}" for problem in result.problems]
    return "\n".join(lines) + "\n" + tomli_w.dumps({**table, **pad})


def _interval(one: Any) -> str:
    if one.is_fixed or not np.isfinite(one.low):
        return ""
    return f" ({one.low:.6g} to {one.high:.6g})"


def _write_residuals(result: Identification, path: Path) -> None:
    found, blocks = result.found, result.found.blocks
    law = found.fit.law
    fitted, _ = law.log_friction(found.fit.theta, blocks)
    heads = ["stop", "time_s", "disc_temperature_degC", "rubbing_speed_m_s", "clamp_force_N",
             "pad_friction", "fitted_friction", "residual", "weight"]  # fmt: skip
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(heads)
        for k, label in enumerate(result.measured.labels):
            for j in np.flatnonzero(blocks.is_there[k]):
                log_friction, log_fitted = blocks.log_friction[k, j], fitted[k, j]
                weight = found.fit.weights.block[k, j] * found.fit.weights.stop[k]
                row = [blocks.time[k, j], *blocks.values[:, k, j], np.exp(log_friction),
                       np.exp(log_fitted), log_friction - log_fitted, weight]  # fmt: skip
                writer.writerow([label, *(f"{x:.7g}" if np.isfinite(x) else "" for x in row)])
