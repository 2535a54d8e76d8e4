"""Figures of the run that was worked out by hand: 20 m/s, 1 m/s², 200 m, two axles."""

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.report.energy import energy_table
from railgrip.report.limits import check_limits
from railgrip.report.metrics import axle_table, metrics, status_sentence


def by_name(dataset):
    return {figure.name: figure for figure in metrics(dataset)}


@pytest.mark.parametrize(
    ("name", "value", "unit", "text"),
    [
        ("initial_speed", 72.0, "km/h", "72.0 km/h"),
        ("stopping_distance", 200.0, "m", "200.0 m"),
        ("mean_deceleration", 1.0, "m/s²", "1.00 m/s²"),
        ("adhesion_utilisation", 200 / 3, "%", "66.7 %"),
        ("slide_activity", 25.0, "%", "25.0 %"),
        ("air_used", 48.0, "Nl", "48 Nl"),
        ("locked_time", 0.7, "s", "0.70 s (C1-V1-B1-A2)"),
        ("locked_time_total", 1.5, "s", "1.50 s (C1-V1-B1-A2)"),
        ("slid_energy", 400.0, "kJ", "400 kJ (C1-V1-B1-A2)"),
        ("flat_length", 12.0, "mm", "12.0 mm (C1-V1-B1-A2)"),
        ("disc_temperature", 120.0, "°C", "120 °C (C1-V1-B1-A1)"),
        ("valve_cycles", 7.0, "", "7"),
    ],
)
def test_figures_in_the_engineers_units(hand, name, value, unit, text):
    figure = by_name(hand)[name]
    assert figure.value == pytest.approx(value)
    assert (figure.unit, figure.text) == (unit, text)


def test_a_figure_without_value_is_a_dash(hand):
    hand["stopping_distance"][:] = np.nan
    assert by_name(hand)["stopping_distance"].text == "–"


def test_missing_outcomes_are_left_out(hand):
    assert "air_used" not in by_name(hand.drop_vars("air_used"))


def test_a_result_is_as_good_as_its_dataset(hand):
    class Result:
        data = hand

    assert metrics(Result()) == metrics(hand)


def test_status_sentence(hand):
    assert status_sentence(hand) == "The train came to a stand."
    hand["status"][:] = 5
    assert "time limit" in status_sentence(hand)


def test_axle_table(hand):
    table = axle_table(hand)
    energy = table.heads.index("Slid energy")
    assert table.units[energy] == "kJ"
    assert table.rows[1][0] == "C1-V1-B1-A2"
    assert table.rows[1][1][energy] == pytest.approx(400.0)
    assert table.texts[1][energy] == "400"


def test_there_is_no_run_3(hand):
    with pytest.raises(RailgripError, match="no run 3; allowed: 0 to 0"):
        metrics(hand, 3)


def test_energy_table_adds_up(hand):
    rows = {row.name: row for row in energy_table(hand)}
    assert rows["energy_brake"].share == pytest.approx(0.8)
    assert rows["energy_gradient"].energy == pytest.approx(0.2e6)
    assert rows["unexplained"].share == pytest.approx(0.0, abs=1e-12)
    assert "energy_rail" not in rows  # what the rail receives is the sliding work, not more of it


def test_a_hole_in_the_balance_shows(hand):
    hand["energy_brake"][:] = 7.9e6
    assert energy_table(hand)[-1].share == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("limit", "value", "passed"),
    [
        ("stopping_distance", 200.0, True),
        ("stopping_distance", 199.9, False),
        ("stopping_distance_least", 150.0, True),
        ("stopping_distance_least", 250.0, False),
        ("mean_deceleration", 0.9, True),
        ("mean_deceleration", 1.1, False),
        ("mean_deceleration_greatest", 0.9, False),
        ("locked_time", 0.4, False),
        ("disc_temperature", 350.0, True),
        ("flat_length", 0.012, True),
    ],
)
def test_limits(hand, limit, value, passed):
    assert [verdict.passed for verdict in check_limits(hand, {limit: value})] == [passed]


def test_a_limit_is_told_in_words(hand):
    (verdict,) = check_limits(hand, {"locked_time": 0.4})
    assert verdict.text == "Longest lock: 0.70 s, limit at most 0.40 s, missed"


def test_a_value_that_is_missing_never_passes(hand):
    hand["stopping_distance"][:] = np.nan
    assert not check_limits(hand, {"stopping_distance": 1e6})[0].passed
    assert not check_limits(hand, {"stopping_distance_least": 0.0})[0].passed


def test_a_limit_that_is_none_is_no_limit(hand):
    assert check_limits(hand, {"stopping_distance": None}) == []


def test_every_limit_that_a_scenario_can_state_is_known(hand):
    limits = pytest.importorskip("railgrip.scenario.limits").Limits
    stated = dict.fromkeys(limits.model_fields, 1.0)
    assert len(check_limits(hand, stated)) == len(stated)


def test_unknown_limit(hand):
    with pytest.raises(RailgripError, match="did you mean 'stopping_distance'"):
        check_limits(hand, {"stoping_distance": 1.0})
