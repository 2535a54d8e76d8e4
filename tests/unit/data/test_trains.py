"""The shipped trains are what they claim to be."""

import pytest

from railgrip import data
from railgrip.core.constants import GRAVITY
from railgrip.scenario import library
from railgrip.scenario.train import Train

TONNE = 1e3
KMH = 1 / 3.6


def train_of(name):
    return Train.model_validate(library.fetch("train", name))


def axle_masses(train, laden=False):
    """Mass on each axle at rest, in normal service or laden."""
    masses = []
    for place in train.axles():
        vehicle = train.vehicle[place.vehicle]
        axles = sum(len(bogie.axle) for bogie in vehicle.bogie)
        share = place.axle.load_share or 1 / axles
        payload = vehicle.payload_max if laden else vehicle.payload
        masses.append(share * (vehicle.tare + payload))
    return masses


@pytest.mark.parametrize("name", data.names("trains"))
def test_axle_loads_and_rotating_masses_are_possible(name):
    train = train_of(name)
    for laden in (False, True):
        for place, mass in zip(train.axles(), axle_masses(train, laden), strict=True):
            # 22.5 t is the usual limit of European lines.
            assert 5 * TONNE < mass < 22.6 * TONNE, place.label
            assert 0.03 < place.axle.rotating_mass / mass < 0.20, place.label
            assert place.axle.brake is not None


@pytest.mark.parametrize("name", data.names("trains"))
def test_an_emergency_asks_for_no_more_adhesion_than_braking_may(name):
    # 0.15 is the design ceiling of the interoperability rules (LOC&PAS TSI 4.2.4.6.1);
    # the locomotive and pads at their best may touch it.
    train = train_of(name)
    masses = axle_masses(train)
    for place, mass in zip(train.axles(), masses, strict=True):
        vehicle = train.vehicle[place.vehicle]
        brake = train.brakes[place.axle.brake]
        clamp = brake.units * brake.greatest_clamp_force * vehicle.brake_factor(vehicle.payload)
        lever = (brake.friction_radius or place.axle.wheel_radius) / place.axle.wheel_radius
        friction = {
            "constant": lambda pad: pad.friction,
            "piecewise": lambda pad: pad.reference_friction,
            "karwatzki_1950": lambda pad: 0.24,  # near 70 km/h at 14 kN a block
        }[brake.pad.law](brake.pad)
        assert 0.05 < clamp * friction * lever / (mass * GRAVITY) < 0.165, place.label


def test_en14531_unit_is_the_example():
    train = train_of("emu_en14531")
    kinds = [train.brakes[place.axle.brake].kind for place in train.axles()]
    assert kinds == ["block", "block", "disc", "disc", "disc", "disc", "block", "block"]
    expected = [15e3, 15e3, 14.5e3, 14.5e3, 14.5e3, 14.5e3, 15e3, 15e3]
    assert axle_masses(train) == pytest.approx(expected, rel=1e-6)
    rotating = sum(place.axle.rotating_mass for place in train.axles())
    assert train.tare + rotating == pytest.approx(126.8e3)


def test_four_car_unit():
    train = train_of("emu_four_car")
    motored = [place.axle.motor for place in train.axles()]
    assert motored == [True, True, *[False] * 12, True, True]
    masses = axle_masses(train)
    assert sum(masses) == pytest.approx(220e3)
    assert all(12.5e3 <= mass <= 16.1e3 for mass in masses)
    assert train.max_speed == pytest.approx(160 * KMH)


def test_locomotive_is_of_its_class():
    train = train_of("locomotive_bobo")
    assert (train.tare, train.n_axles) == (86e3, 4)
    assert (train.traction.force, train.traction.power) == (300e3, 6.4e6)
    assert train.max_speed == pytest.approx(220 * KMH)
    assert 4 * train.dynamic_brake.power == train.traction.power


def test_wagon_is_the_published_one():
    train = train_of("wagon_block")
    brake = train.brakes["block"]
    assert sum(axle_masses(train)) == pytest.approx(90e3)
    # 3.8 bar on 0.406 m, less 1500 N, times 5.65 · 0.83, less 2000 N, by hand: 221.7 kN.
    assert brake.greatest_clamp_force == pytest.approx(221.7e3, rel=1e-3)
    assert brake.units * train.n_axles == 1.0
    # Its plate is what its measured stop gives (UIC 544-1, single vehicle, 100 km/h).
    assert train.braked_weight == pytest.approx((52_840 / 596 - 10) / 100 * 90e3, rel=5e-3)


def test_freight_train_is_made_of_the_single_vehicles():
    train = train_of("freight_20")
    locomotive, wagon = train_of("locomotive_bobo"), train_of("wagon_block")
    assert len(train.vehicle) == 21
    assert sum(axle_masses(train)) == pytest.approx(86e3 + 20 * 90e3)
    assert train.brakes["locomotive"] == locomotive.brakes["disc"]
    assert train.brakes["wagon"] == wagon.brakes["block"]
    assert train.vehicle[0].resistance == locomotive.resistance
    assert train.vehicle[20].resistance == wagon.resistance
    same = ("length", "tare", "payload", "pivot_distance", "changeover_mass", "empty_factor")
    for key in same:
        assert getattr(train.vehicle[7], key) == getattr(wagon.vehicle[0], key)


def test_position_g_fills_slowly_and_is_else_the_same():
    slow, fast = train_of("freight_20_g"), train_of("freight_20")
    for name in ("locomotive", "wagon"):
        assert slow.brakes[name].fill_time == 24.0
        assert slow.brakes[name].inshot == 0.1
        same = {"fill_time": 4.0, "inshot": 0.0, "release_time": 15.0}
        assert slow.brakes[name].model_copy(update=same) == fast.brakes[name]


def test_wsp_variant_differs_only_by_its_protection():
    plain, fitted = train_of("emu_en14531"), train_of("emu_en14531_wsp")
    assert plain.dump_valve is None
    assert fitted.dump_valve is not None
    assert fitted.vehicle == plain.vehicle
    assert fitted.brakes == plain.brakes


def test_worn_wheels_are_believed_new():
    axles = [place.axle for place in train_of("coach_worn_wheels").axles()]
    assert len({axle.wheel_radius for axle in axles}) == 4
    assert {axle.believed_radius for axle in axles} == {0.46}
