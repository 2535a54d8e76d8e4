"""Each axle finds the rail as the axles before it left it: cleaned, sanded, or not."""

from __future__ import annotations

import numpy as np
from tests.conftest import Coach, Shipped

import railgrip as rg
from railgrip.track.cleaning import left_contaminant


def while_fast(result: rg.Result, name: str, low: float = 20.0, high: float = 35.0) -> np.ndarray:
    """Mean of a trace of each axle while the train runs between two speeds."""
    speed = result["train_speed"].values[0]
    within = (speed > low) & (speed < high)
    return np.asarray(result[name].values[0][:, within].mean(axis=1))


def test_following_axles_find_detergent_cleaned(shipped: Shipped) -> None:
    """From axle to axle more is gone, and the friction found rises from 0.06 towards 0.28."""
    result = shipped("detergent_160")
    cleaning = while_fast(result, "cleaning")
    friction = while_fast(result, "rail_friction")
    assert cleaning[0] == 0.0
    assert (np.diff(cleaning) > 0.0).all()
    assert (np.diff(friction) > 0.0).all()
    assert friction[0] < 0.0601
    assert 0.12 < friction[-1] < 0.28


def test_leaves_stay(shipped: Shipped) -> None:
    """A coach without sanders: every axle finds what the first one found."""
    result = shipped("coach_leaves")
    assert float(result["energy_contact"].values[0]) > 1e6
    assert np.nanmax(result["cleaning"].values) == 0.0
    friction = result["rail_friction"].values[0][:, 1:-1]
    np.testing.assert_allclose(friction, 0.05, rtol=1e-12)
    np.testing.assert_allclose(result["rail_friction_after"].values, 0.05, rtol=1e-12)


def test_traces_begin_on_the_rail(shipped: Shipped) -> None:
    """Already the first point, before anything moves, tells what the wheels stand on."""
    result = shipped("coach_leaves")
    np.testing.assert_allclose(result["rail_friction"].values[0][:, 0], 0.05)
    assert (result["adhesion_available"].values[0][:, 0] > 0.02).all()


def test_what_the_rail_is_afterwards_follows_from_its_energy(shipped: Shipped) -> None:
    """0.28 − (0.28 − 0.06) exp(−1.9e-4 m/J · W) in every cell, to 1e-12."""
    result = shipped("detergent_160")
    energy = result["rail_energy"].values[0]
    left = np.array([left_contaminant(each, 1.9e-4) for each in energy])
    after = 0.28 + left * (0.06 - 0.28)
    np.testing.assert_allclose(result["rail_friction_after"].values[0], after, atol=1e-12)
    assert energy.max() > 1000.0


def test_the_last_axle_finds_what_the_axles_before_gave(shipped: Shipped) -> None:
    """The cleaning that the last axle meets is that of all energy but its own, within 2 %.

    Cell by cell the energy of the 16th axle alone is not known; the rail's final energy bounds
    from above what it found, and that less its greatest share from below.
    """
    result = shipped("detergent_160")
    speed = result["train_speed"].values[0]
    moment = int(np.argmin(np.abs(speed - 30.0)))
    axle = result.scenario.train.axles()[-1]
    place = result["train_position"].values[0][moment] - axle.behind_front
    cells = result.data["cell"].values
    near = np.abs(cells - place) < 2.0
    final = result["rail_energy"].values[0][near].mean()
    found = -np.log(1 - result["cleaning"].values[0][-1, moment]) / 1.9e-4
    assert 0.7 * final < found < 1.02 * final


def test_the_first_axle_cleans_for_itself_by_half(coach: Coach) -> None:
    """With cleaning the very first axle has more grip than without, though it finds the same."""
    scenario = coach(0.06, speed=25.0, brake={"rigging_ratio": 15.0})
    table = scenario.rail.condition.model_dump()
    table["clean"]["static_friction"] = 0.28
    first = {}
    for cleaning in (0.0, 1.9e-4):
        table["cleaning"] = cleaning
        result = rg.simulate(scenario.with_(rail={"condition": table}))
        speed = result["train_speed"].values[0]
        locked = (result["wheel_speed"].values[0][0] == 0.0) & (speed > 5.0) & (speed < 15.0)
        first[cleaning] = result["adhesion_used"].values[0][0][locked].mean()
        assert result["rail_friction"].values[0][0][locked].max() < 0.0600001
    assert first[1.9e-4] > 1.2 * first[0.0]


def test_sand_lies_behind_the_sander_and_helps(shipped: Shipped) -> None:
    """Axles ahead of the sander (the third axle's) find bare leaves, those behind find sand."""
    result = shipped("sanded_leaves")
    friction = while_fast(result, "rail_friction", 10.0, 25.0)
    np.testing.assert_allclose(friction[:2], 0.05)
    assert (friction[2:] > 0.06).all()
    assert result["rail_sand"].values.max() > 0.0
    bare = rg.simulate(result.scenario.with_({"train.sander.flow": 0.0}), traces=False)
    distance = float(result["stopping_distance"].values[0])
    assert distance < 0.95 * float(bare["stopping_distance"].values[0])


def test_sand_waits_for_the_sander(shipped: Shipped) -> None:
    """No sand before the delay has passed since the first brake command."""
    slow = rg.load("sanded_leaves").with_({"train.sander.delay": 5.0})
    early, late = shipped("sanded_leaves"), rg.simulate(slow)

    def first_sand(result: rg.Result) -> float:
        sand = result["rail_sand"].values[0]
        return float(result.data["cell"].values[np.argmax(sand > 0.0)])

    # at no more than 120 km/h 4.5 s more of delay are at most 150 m, and at least half of it
    assert 75.0 < first_sand(late) - first_sand(early) < 150.0
