"""Curves and limits of the supervision as CSV: one row a speed."""

from __future__ import annotations

import csv
import math
import os
from pathlib import Path

from railgrip.control.etcs.supervision import CURVES, SupervisionLimits
from railgrip.core.atomic import write_aside


def write_supervision(limits: SupervisionLimits, path: str | os.PathLike[str]) -> Path:
    """Write the table, distances in metres before the target, empty where there is none.

    Parameters
    ----------
    limits : SupervisionLimits
        Over speeds.
    path : path
        The CSV file.

    Returns
    -------
    Path
        The file written.
    """
    with write_aside(path) as aside, aside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["speed_kmh", *(f"{name}_m" for name in CURVES)])
        for row in zip(*limits, strict=True):
            distances = ["" if math.isnan(x) else f"{x:.3f}" for x in row[1:]]
            writer.writerow([f"{3.6 * row[0]:.6g}", *distances])
    return Path(path)
