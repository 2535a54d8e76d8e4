import math

import pytest

from railgrip.core.errors import RailgripError
from railgrip.scenario import Scenario


def problems(table):
    with pytest.raises(RailgripError) as caught:
        Scenario(**table)
    return str(caught.value).splitlines()


def test_places_of_axles(table):
    train = Scenario(**table).train
    # Middle of the 26.4 m coach 13.2 m; pivots ± 9.5 m; axles ± 1.25 m from them.
    first = [place.behind_front for place in train.axles()[:4]]
    assert first == pytest.approx([2.45, 4.95, 21.45, 23.95])
    assert train.axles()[-1].behind_front == pytest.approx(2 * 26.4 + 23.95)
    assert train.length == pytest.approx(3 * 26.4)
    assert [place.label for place in train.axles()[3:5]] == ["C1-V1-B2-A2", "C1-V2-B1-A1"]
    assert train.n_axles == len(train.axles()) == 12
    assert [place.behind_front for place in train.bogies()[:2]] == pytest.approx([3.7, 22.7])


def test_single_axles_stand_at_the_pivots(table):
    axle = {"rotating_mass": 800, "wheel_radius": 0.46}
    table["train"]["vehicle"] = [
        {
            "length": 14,
            "tare": "12 t",
            "pivot_distance": 9,
            "bogie": [{"count": 2, "mass": "1.5 t", "axle": [axle]}],
        }
    ]
    assert Scenario(**table).train.vehicle[0].axle_offsets() == pytest.approx((2.5, 11.5))


def test_count_is_spread_out_and_places_stay_those_of_the_file(table):
    table["train"]["vehicle"][1]["bogie"][0]["axle"][0]["brake"] = "disk"
    table["train"]["vehicle"][0]["bogie"] = [
        {**table["train"]["vehicle"][0]["bogie"][0], "axle": [{"count": 2, **_bare_axle()}]}
    ]
    # Vehicle 1 of the file stands for two, and its bogie and axle for two each: told once.
    assert problems(table) == [
        "train.vehicle[1].bogie[0].axle[0].brake: brake 'disk' unknown; known: disc; "
        "did you mean 'disc'?"
    ]


def _bare_axle():
    return {"rotating_mass": 700, "wheel_radius": 0.445}


def test_wheels_of_different_size(table):
    axle = table["train"]["vehicle"][0]["bogie"][0]["axle"][0]
    table["train"]["vehicle"][0]["bogie"][0]["axle"] = [
        {**axle, "count": 1, "wheel_radius": "0.46 m", "believed_radius": "0.44 m"},
        {**axle, "count": 1, "wheel_radius": "0.43 m"},
    ]
    axles = Scenario(**table).train.vehicle[0].bogie[0].axle
    assert [(a.wheel_radius, a.believed_radius) for a in axles] == [(0.46, 0.44), (0.43, 0.43)]


def test_load(table):
    scenario = Scenario(**table)
    assert scenario.payloads() == (0.0, 6000.0, 6000.0)
    assert scenario.mass == 3 * 44000 + 2 * 6000
    assert scenario.with_(load="laden").payloads() == (0.0, 10000.0, 10000.0)
    assert scenario.with_(load={"share": "25 %"}).payloads() == (0.0, 2500.0, 2500.0)


def test_load_dependent_brake(table):
    vehicle = table["train"]["vehicle"][1]
    vehicle.update(load_braking="continuous", payload_max="44 t", payload=0)
    continuous = Scenario(**table).train.vehicle[1]
    assert continuous.brake_factor(0.0) == pytest.approx(0.5)  # 44 t of 88 t
    assert continuous.brake_factor(22e3) == pytest.approx(0.75)
    vehicle.update(load_braking="changeover", changeover_mass="60 t", empty_factor=0.4)
    changeover = Scenario(**table).train.vehicle[1]
    assert [changeover.brake_factor(load) for load in (15.9e3, 16e3)] == [0.4, 1.0]


def test_load_shares_are_normalised(table):
    axle = {**_bare_axle(), "count": 2}
    bogie = {"wheelbase": 2.5, "mass": "6 t"}
    table["train"]["vehicle"][0]["bogie"] = [
        {**bogie, "axle": [{**axle, "load_share": 0.2542}]},
        {**bogie, "axle": [{**axle, "load_share": 0.2458}]},
    ]
    shares = Scenario(**table).train.vehicle[0].load_shares()
    assert math.isclose(sum(shares), 1.0)
    assert shares[0] / shares[3] == pytest.approx(0.2542 / 0.2458)


def test_clamp_force_of_the_en_14531_disc(table):
    table["train"]["brakes"]["disc"].update(cylinder_efficiency=0.98, rigging_efficiency=0.95)
    brake = Scenario(**table).train.brakes["disc"]
    # (3 bar · 324 cm² · 0.98 − 500 N) · 5 · 0.95 = 42 872.2 N; F_B = F_b · 0.35 · 2·0.27/0.89
    force = brake.greatest_clamp_force * 0.35 * 2 * 0.27 / 0.89
    assert force == pytest.approx(9104.2, abs=0.05)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tare": "10 t"}, "train.vehicle[0].tare: must be more than the bogies alone"),
        ({"length": "20 m"}, "train.vehicle[0].length: is shorter than the wheel base"),
        ({"pivot_distance": "2 m"}, "train.vehicle[0].pivot_distance: is so short that"),
        ({"pivot_distance": 0}, "train.vehicle[0].pivot_distance: is needed with more"),
        ({"payload": "5 t", "payload_max": "4 t"}, "train.vehicle[0].payload: is more than"),
        ({"load_braking": "changeover"}, "train.vehicle[0].changeover_mass: is needed"),
        ({"load_braking": "continous"}, "did you mean 'continuous'?"),
        ({"bogie": []}, "train.vehicle[0].bogie: must not be empty"),
        ({"count": 0}, "train.vehicle[0].count: is out of range; got 0; allowed: at least 1"),
    ],
)
def test_vehicle_that_cannot_be(table, change, message):
    table["train"]["vehicle"][0].update(change)
    assert any(message in line for line in problems(table))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"dynamic_brake": {"force": "30 kN", "power": "400 kW"}}, "needs an axle with motor"),
        ({"sander": {}}, "train.sander: needs an axle with sander = true"),
        (
            {"dynamic_brake": {"force": 3e4, "power": 4e5, "fade_end": "20 km/h"}},
            "train.dynamic_brake.fade_end: must be below fade_start",
        ),
        ({"vehicle": []}, "train.vehicle: must not be empty"),
        ({"brakes": {}}, "train.vehicle[0].bogie[0].axle[0].brake: brake 'disc' unknown"),
    ],
)
def test_train_that_cannot_be(table, change, message):
    table["train"].update(change)
    assert any(message in line for line in problems(table))


def test_train_of_a_million_axles_is_refused_at_once(table):
    vehicle = table["train"]["vehicle"][0]
    vehicle["count"] = 1000
    vehicle["bogie"][0].update(count=20)
    vehicle["bogie"][0]["axle"][0].update(count=12)
    assert problems(table)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"kind": "block"}, "contradicts kind 'block'"),
        ({"friction_radius": None}, "is needed for kind 'disc'"),
        ({"cylinder_efficiency": 1.2}, "is out of range; got 1.2; allowed: more than 0"),
        ({"cylinder_pressure": "3 kN"}, "does not fit: 'kN'; got '3 kN'; allowed: a number in Pa"),
        ({"pad": {"law": "constnt"}}, "did you mean 'constant'?"),
        ({"pad": {"friction": 0.3}}, "brakes.disc.pad: has no 'law'"),
        ({"pad": {"law": "constant", "frction": 0.3}}, "pad.frction: unknown key; did you mean"),
        ({"pad": "orgnic"}, "train.brakes.disc.pad: pad 'orgnic' unknown"),
        (
            {"pad": {"law": "piecewise", "reference_friction": 0.4, "speed": [[9, 1], [5, 1]]}},
            "pad.speed: must ascend",
        ),
    ],
)
def test_brake_that_cannot_be(table, change, message):
    table["train"]["brakes"]["disc"].update(change)
    assert any(message in line for line in problems(table))
