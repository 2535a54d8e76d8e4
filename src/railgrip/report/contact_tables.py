"""The figures of a contact as rows of text: what it is, its slopes, and what each law says."""

from __future__ import annotations

import math

import numpy as np

from railgrip.contact.rail_friction import RailFriction
from railgrip.laboratory.contact_case import ContactCase
from railgrip.laboratory.law_comparison import LawComparison
from railgrip.laboratory.temperature_limits import passed_limits
from railgrip.report.contact_axes import axis_of, force_label, place, shown_force

Rows = list[list[str]]

_FORMULAS = {
    "cap_2000": "Čáp (2.12a), cone on a round head",
    "cap_2000_simple": "Čáp (2.12b)",
    "carter_1926": "Carter (2.13), cylinders",
    "kalker_1967": "Kalker (2.14a)",
    "kalker_1967_simple": "Kalker (2.14b)",
    "surface_stiffness": "surface stiffness 20·10¹² N/m³",
    "kalker_1990": "Kalker's table, as the laws have it",
}
_MOST_ROWS = 21
BEYOND = "*"
"""Stands behind a figure where a law is beyond its validity."""


def contact_rows(case: ContactCase, rail: RailFriction) -> Rows:
    """Return what the contact is: patch, pressure, coefficients, friction."""
    contact, patch = case.contact, case.patch
    falls = rail.friction_ratio < 1.0 and rail.friction_decay > 0.0
    least = rail.friction_ratio * rail.static_friction
    return [
        ["Wheel load", f"{1e-3 * contact.load:.6g} kN"],
        ["Wheel radius", f"{case.geometry.wheel_radius:.4g} m"],
        ["Transverse radius of the tread", _radius(case.geometry.wheel_transverse_radius)],
        ["Transverse radius of the rail", _radius(case.geometry.rail_transverse_radius)],
        ["Semi-axis along the track, a", f"{1e3 * patch.a:.4f} mm"],
        ["Semi-axis across the track, b", f"{1e3 * patch.b:.4f} mm"],
        ["Greatest pressure", f"{1e-6 * patch.greatest_pressure:.1f} MPa"],
        ["Approach of the bodies", f"{1e6 * patch.approach:.1f} µm"],
        ["Kalker's C11, C22", f"{contact.c11:.4f}, {contact.c22:.4f}"],
        ["Kalker's C23, C33", f"{contact.c23:.4f}, {contact.c33:.4f}"],
        [
            "Friction coefficient",
            f"{rail.static_friction:.3g}, falling to {least:.3g}"
            if falls
            else f"{rail.static_friction:.3g}",
        ],
    ]


def slope_rows(case: ContactCase) -> Rows:
    """Return the initial slope dT/ds by each formula [kN], and over that of Kalker's table."""
    true = case.slopes.kalker_1990
    rows = []
    for name, slope in case.slopes._asdict().items():
        text = "–" if math.isnan(slope) else f"{1e-3 * slope:.1f}"
        is_other = name != "kalker_1990" and not math.isnan(slope)
        share = f"{100 * (slope / true - 1.0):+.1f} %" if is_other else "–"
        rows.append([_FORMULAS[name], text, share])
    return rows


def law_rows(
    found: LawComparison,
    reference: str,
    wheel_temperature: float = 20.0,
    rail_temperature: float = 20.0,
) -> tuple[list[str], Rows]:
    """Return heads and rows of what each law says at the first point."""
    temperatures = (wheel_temperature, rail_temperature)
    heads = ["law", "along, kN", "across, kN", "moment, N m", "adhesion", "flash, K", "surface, °C"]
    rows = [
        [
            law + ("" if forces.is_valid[0] else BEYOND),
            _number(1e-3 * forces.longitudinal[0], 3),
            _number(1e-3 * forces.lateral[0], 3),
            _number(forces.spin_moment[0], 2),
            _number(found.adhesion(law)[0], 4),
            _number(found.flash_rise(law)[0], 1),
            _number(found.surface_temperature(law, *temperatures)[0], 1),
        ]
        for law, forces in found.forces.items()
    ]
    return _with_distance(heads, rows, found, reference, [[0]] * len(rows))


def sweep_rows(
    found: LawComparison, swept: str, over: str = "creepage", show: str = "adhesion"
) -> tuple[list[str], Rows]:
    """Return heads and rows of a sweep, one column a law; of many points only some."""
    x, axis = place(found, swept, over)
    some = np.unique(np.linspace(0, x.size - 1, min(x.size, _MOST_ROWS)).round().astype(int))
    curves = {law: shown_force(found, law, swept, show) for law in found.laws}
    digits = 4 if show == "adhesion" else 3
    rows = [
        [
            f"{x[k]:.5g}",
            *(
                _number(curve[k], digits) + ("" if found.forces[law].is_valid[k] else BEYOND)
                for law, curve in curves.items()
            ),
        ]
        for k in some
    ]
    return [axis.label, *found.laws], rows


def sweep_title(swept: str, over: str = "creepage", show: str = "adhesion") -> str:
    """Return what the figures of `sweep_rows` are."""
    return f"{force_label(swept, show)}, over {axis_of(swept, over).words.lower()}"


def summary_rows(
    found: LawComparison,
    swept: str,
    reference: str,
    over: str = "creepage",
    show: str = "adhesion",
) -> tuple[list[str], Rows]:
    """Return heads and rows: of each law the greatest force within its validity, and the rest."""
    x, axis = place(found, swept, over)
    rows, valid = [], []
    for law in found.laws:
        curve = shown_force(found, law, swept, show)
        is_valid = found.forces[law].is_valid
        valid.append(np.flatnonzero(is_valid).tolist())
        greatest, where = "–", "–"
        if is_valid.any():
            k = int(np.argmax(np.where(is_valid, np.abs(curve), -1.0)))
            greatest = _number(curve[k], 4 if show == "adhesion" else 3)
            where = f"{x[k]:.4g} {axis.unit}"
        rows.append([law, greatest, where, f"{is_valid.sum()} of {x.size}"])
    heads = ["law", "greatest", "at", "valid points"]
    return _with_distance(heads, rows, found, reference, valid)


def warnings(
    found: LawComparison, wheel_temperature: float = 20.0, rail_temperature: float = 20.0
) -> list[str]:
    """Return which temperature limits of steel a law's surfaces pass, the highest of each law."""
    told = []
    for law in found.laws:
        hottest = float(found.surface_temperature(law, wheel_temperature, rail_temperature).max())
        passed = passed_limits(hottest) if math.isfinite(hottest) else []
        if passed:
            told.append(f"{law}: {passed[-1]}")
    return told


def _with_distance(
    heads: list[str], rows: Rows, found: LawComparison, reference: str, points: list[list[int]]
) -> tuple[list[str], Rows]:
    """Add how far each law is from the reference at some points, where there are several laws."""
    if len(found.laws) == 1:
        return heads, rows
    for row, law, some in zip(rows, found.laws, points, strict=True):
        far = 100 * found.difference(law, reference)[some]
        row.append("" if law == reference or not far.size else _number(far.max(), 2))
    return [*heads, f"from {reference}, % of μ₀Q"], rows


def _radius(radius: float) -> str:
    if math.isinf(radius):
        return "straight"
    return f"{radius:.4g} m" if radius > 0.0 else f"{radius:.4g} m (hollow)"


def _number(value: float, digits: int) -> str:
    if not math.isfinite(value):
        return "–"
    text = f"{value:.{digits}f}"
    return text if float(text) else text.lstrip("-")
