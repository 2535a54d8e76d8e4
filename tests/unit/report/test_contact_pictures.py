"""Figures and tables of a contact: the right curves, labels with units, validity drawn."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage
from railgrip.io.contact_csv import COLUMNS, MAP_COLUMNS, write_comparison, write_map
from railgrip.laboratory.contact_case import contact_case
from railgrip.laboratory.law_comparison import LawComparison, compare_laws
from railgrip.laboratory.patch_map import patch_map
from railgrip.report import contact_tables as tables
from railgrip.report.contact_figures import curves_figure
from railgrip.report.contact_maps import map_figure

CASE = contact_case("cone_on_head", 100e3)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
LAWS = ["polach_2005", "kalker_linear"]


@pytest.fixture(scope="module")
def swept() -> LawComparison:
    return compare_laws(LAWS, CASE.contact, COULOMB, 20.0, np.linspace(-0.01, 0.01, 41))


@pytest.mark.parametrize(
    ("over", "show", "x_label", "y_label", "x", "y"),
    [
        ("creepage", "adhesion", "Longitudinal creepage, %", "adhesion μ", 1.0, 0.298),
        ("creepage", "force", "Longitudinal creepage, %", "force T, kN", 1.0, 29.8),
        ("slip-speed", "adhesion", "Slip speed, m/s", "adhesion μ", 0.2, 0.298),
        ("slip-speed", "force", "Slip speed, m/s", "force T, kN", 0.2, 29.8),
    ],
)
def test_the_four_forms(
    swept: LawComparison, over: str, show: str, x_label: str, y_label: str, x: float, y: float
) -> None:
    curves, differences = curves_figure(swept, "longitudinal", over=over, show=show).axes
    assert curves.get_xlabel() == x_label
    assert y_label in curves.get_ylabel()
    assert "% of μ₀Q" in differences.get_ylabel()
    solid = curves.lines[0]
    assert float(np.asarray(solid.get_xdata())[-1]) == pytest.approx(x)
    assert float(np.asarray(solid.get_ydata())[-1]) == pytest.approx(y, rel=2e-3)
    assert float(np.asarray(solid.get_xdata())[0]) == pytest.approx(-x)


def test_beyond_its_validity_a_law_is_dashed_and_does_not_set_the_scale(
    swept: LawComparison,
) -> None:
    curves = curves_figure(swept, "longitudinal").axes[0]
    solid, dashed = curves.lines[2:4]
    assert np.isnan(np.asarray(solid.get_ydata())[-1])
    assert float(np.asarray(dashed.get_ydata())[-1]) == pytest.approx(1.45, rel=2e-2)
    assert solid.get_color() == dashed.get_color()
    assert curves.get_ylim()[1] < 0.4


def test_spin_has_a_panel_for_the_moment() -> None:
    found = compare_laws(["fastsim_1982"], CASE.contact, COULOMB, 20.0, 0, 0, [0.0, 1.0])
    labels = [axes.get_ylabel() for axes in curves_figure(found, "spin").axes]
    assert labels == ["Lateral force over load, adhesion μ", "Spin moment, N m"]


def test_the_map_names_its_fields_and_their_units() -> None:
    patch = patch_map("exact", CASE.contact, COULOMB, 20.0, Creepage(0.002, 0.0, 0.3), cells=24)
    titles = {axes.get_title(loc="left") for axes in map_figure(patch, 20.0).axes}
    assert {"Pressure, MPa", "Slip speed, m/s", "Friction heat, MW/m²"} <= titles


def test_tables_mark_what_is_beyond_validity(swept: LawComparison) -> None:
    heads, rows = tables.sweep_rows(swept, "longitudinal")
    assert heads == ["Longitudinal creepage, %", *LAWS]
    assert len(rows) == 21
    assert rows[-1][2].endswith(tables.BEYOND)
    assert not rows[-1][1].endswith(tables.BEYOND)
    heads, rows = tables.summary_rows(swept, "longitudinal", "polach_2005")
    assert heads[-1] == "from polach_2005, % of μ₀Q"
    assert rows[1][3].endswith("of 41")


def test_tables_of_a_case() -> None:
    rows = dict(tables.contact_rows(CASE, COULOMB))
    assert rows["Semi-axis along the track, a"] == "7.1920 mm"
    assert rows["Transverse radius of the tread"] == "straight"
    assert rows["Friction coefficient"] == "0.3"
    assert tables.slope_rows(CASE)[-1][1:] == ["14523.7", "–"]
    hollow = tables.contact_rows(contact_case("worn_on_worn", 100e3), COULOMB)
    assert dict(hollow)["Transverse radius of the tread"] == "-0.8 m (hollow)"


def test_csv_has_all_forms(swept: LawComparison, tmp_path: Path) -> None:
    path = write_comparison(swept, tmp_path / "forces.csv")
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == COLUMNS
    assert len(rows) == 82
    last = rows[-1]
    assert (last["law"], last["is_valid"]) == ("kalker_linear", "0")
    assert float(last["slip_speed_m_s"]) == pytest.approx(0.2)
    assert float(last["longitudinal_adhesion"]) == pytest.approx(1.4523733, rel=1e-6)


def test_csv_of_a_map_has_one_row_a_cell(tmp_path: Path) -> None:
    patch = patch_map("exact", CASE.contact, COULOMB, 20.0, Creepage(0.002, 0.0, 0.3), cells=24)
    with write_map(patch, tmp_path / "map.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == MAP_COLUMNS
    assert len(rows) == patch.is_inside.sum()
    area = (patch.x[0, 1] - patch.x[0, 0]) * (patch.y[1, 0] - patch.y[0, 0])
    load = sum(float(row["pressure_Pa"]) for row in rows) * area
    assert load == pytest.approx(100e3, rel=1e-6)
