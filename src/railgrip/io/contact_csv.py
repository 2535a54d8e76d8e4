"""A contact as CSV files: what laws say, in all four forms, and the fields of the patch."""

from __future__ import annotations

import csv
import os
from pathlib import Path

import numpy as np

from railgrip.core.atomic import write_aside
from railgrip.laboratory.inputs import FloatArray
from railgrip.laboratory.law_comparison import LawComparison
from railgrip.laboratory.patch_map import PatchMap

COLUMNS = (
    "law", "speed_m_s", "load_N", "longitudinal_creepage", "lateral_creepage", "spin_1_m",
    "slip_speed_m_s", "longitudinal_force_N", "lateral_force_N", "spin_moment_N_m",
    "longitudinal_adhesion", "lateral_adhesion", "friction_power_W", "flash_rise_K",
    "difference_of_friction_limit", "is_valid",
)  # fmt: skip
"""Heads of the columns; units stand behind the names."""


def write_comparison(
    found: LawComparison, path: str | os.PathLike[str], reference: str = ""
) -> Path:
    """Write a comparison of laws.

    Parameters
    ----------
    found : LawComparison
        One point or more.
    path : str or path
        The file; it appears whole or not at all.
    reference : str
        Law from which differences are taken; the first if not given.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RailgripError
        ``out/curves.csv: cannot be written; got Permission denied``

    Notes
    -----
    Force and adhesion, creepage and slip speed stand side by side: any of the forms T(w), T(s),
    μ(w) and μ(s) is two of the columns.
    """
    reference = reference or found.laws[0]
    with write_aside(path) as aside, aside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for law, forces in found.forces.items():
            columns = (
                found.speed, found.load, found.longitudinal, found.lateral, found.spin,
                found.slip_speed, forces.longitudinal, forces.lateral, forces.spin_moment,
                forces.longitudinal / found.load, forces.lateral / found.load,
                found.friction_power(law), found.flash_rise(law), found.difference(law, reference),
            )  # fmt: skip
            for values, is_valid in zip(
                zip(*columns, strict=True), forces.is_valid.tolist(), strict=True
            ):
                writer.writerow([law, *(f"{value:.9g}" for value in values), int(is_valid)])
    return Path(path)


MAP_COLUMNS = (
    "x_m", "y_m", "pressure_Pa", "traction_x_Pa", "traction_y_Pa", "slip_x", "slip_y",
    "heat_flux_W_m2", "wheel_rise_K", "is_slipping",
)  # fmt: skip
"""Heads of the columns of a map; slip is over the speed of the train."""


def write_map(
    found: PatchMap, path: str | os.PathLike[str], rises: FloatArray | None = None
) -> Path:
    """Write the fields of a patch, one row a cell in contact.

    Parameters
    ----------
    found : PatchMap
        From `railgrip.laboratory.patch_map`.
    path : str or path
        The file; it appears whole or not at all.
    rises : ndarray, optional
        Flash rise of the wheel's surface from `patch_rises`; NaN in the file if not given [K].

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RailgripError
        ``out/map.csv: cannot be written; got Permission denied``
    """
    inside = found.is_inside
    warmth = np.full(found.x.shape, np.nan) if rises is None else rises
    columns = [
        field[inside].tolist()
        for field in (
            found.x, found.y, found.pressure, found.traction_x, found.traction_y,
            found.slip_x, found.slip_y, found.heat_flux, warmth,
        )
    ]  # fmt: skip
    with write_aside(path) as aside, aside.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(MAP_COLUMNS)
        for *values, slips in zip(*columns, found.is_slipping[inside].tolist(), strict=True):
            writer.writerow([*(f"{value:.9g}" for value in values), int(slips)])
    return Path(path)
