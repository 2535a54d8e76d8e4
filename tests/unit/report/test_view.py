"""One run as plain arrays; slip, thresholds and thinning."""

import json

import numpy as np
import pytest

from railgrip.core.errors import RailgripError
from railgrip.core.signals import SIGNALS
from railgrip.report.thin import Thinner
from railgrip.report.thresholds import thresholds
from railgrip.report.units import shown
from railgrip.report.view import View


def test_the_tail_after_the_stop_is_cut(hand):
    cut = hand.copy(deep=True)
    for name in ("train_speed", "wheel_speed"):
        cut[name][..., 30:] = np.nan
    view = View(cut)
    assert view.time[-1] == 14.5
    assert view.get("wheel_speed").shape == (2, 30)


def test_slip_of_an_axle_a_tenth_too_slow(hand):
    slip = View(hand).slip
    fast = View(hand).time < 19  # below 3 km/h it is not defined
    assert slip[0][fast] == pytest.approx(0.0)
    assert slip[1][fast] == pytest.approx(0.1)
    assert np.isnan(slip[:, -1]).all()


def test_distance_starts_at_the_record(hand):
    view = View(hand)
    assert view.start == 1000.0
    assert (view.distance[0], view.distance[-1]) == (0.0, pytest.approx(200.0))


def test_vehicles_come_from_the_labels(stop):
    view = View(stop)
    assert view.vehicle_of == [0] * 4 + [1] * 4 + [2] * 4 + [3] * 4
    assert view.vehicles == ["V1", "V2", "V3", "V4"]
    assert view.places[4:6] == ["B1-A1", "B1-A2"]


def test_two_units_coupled(hand):
    coupled = hand.assign_coords(axle=["C1-V1-B1-A1", "C2-V1-B1-A1"])
    assert View(coupled).vehicle_of == [0, 1]
    assert View(coupled).vehicles == ["C1-V1", "C2-V1"]


def test_a_signal_that_is_not_there(hand):
    with pytest.raises(RailgripError, match="the result has no 'clamp_force'; it has: "):
        View(hand).get("clamp_force")


def test_no_reference_speed_without_a_controller(unprotected):
    assert not View(unprotected).has_reference


def test_thresholds_are_shares_with_a_floor_in_speed(hand):
    hand.attrs["wsp_parameters"] = json.dumps(
        {"slip_upper": 0.16, "slip_speed_upper_floor": 2.0, "slip_speed_alarm": 5.0, "period": 0.01}
    )
    drawn = thresholds(View(hand))
    assert set(drawn) == {"slip upper", "slip speed alarm"}
    assert drawn["slip upper"][0] == pytest.approx(0.16)  # 2 m/s at 20 m/s are only 10 %
    assert drawn["slip upper"][20] == pytest.approx(0.2)  # at 10 m/s they are more
    assert drawn["slip speed alarm"][0] == pytest.approx(0.25)


def test_thresholds_of_the_scenario(hand):
    hand.attrs["scenario_json"] = json.dumps({"wsp": {"parameters": {"slip_lower": 0.08}}})
    assert list(thresholds(View(hand))) == ["slip lower"]
    assert thresholds(View(hand), {}) == {}


def test_thinning_keeps_every_peak():
    values = np.zeros((2, 1000))
    values[0, 333], values[1, 777] = 5.0, -7.0
    thin = Thinner(1000, 100)
    few = thin(values)
    assert few.shape == (2, 100)
    assert (few[0].max(), few[1].min()) == (5.0, -7.0)
    assert len(thin.axis(np.arange(1000.0))) == 100


def test_thinning_leaves_gaps_and_short_traces():
    gap = np.array([1.0, np.nan, np.nan, np.nan])
    assert np.isnan(Thinner(4, 2)(np.full(4, np.nan))).all()
    assert Thinner(4, 4)(gap) is gap


@pytest.mark.parametrize("name", SIGNALS)
def test_every_signal_has_a_way_to_be_shown(name):
    how = shown(name)
    assert how.factor > 0
    assert how.unit in (
        "",
        "km/h",
        "m",
        "s",
        "bar",
        "m/s²",
        "kN",
        "kN m",
        "kJ",
        "kJ/m",
        "g/m",
        "Nl",
        "°C",
        "K",
        "%",
        "mm",
    )
