"""Laws over arrays: the bits of plain Python, shapes, loads, flags, and words for bad input."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from railgrip.contact.rail_friction import WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import (
    Creepage,
    CreepForce,
    RollingContact,
    rolling_contact,
)
from railgrip.core import registry
from railgrip.core.errors import RailgripError
from railgrip.laboratory.laws_over_arrays import creep_forces, rescaled

BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
GROUP = "railgrip.rolling_laws"
COUNT = 40


def points() -> tuple[np.ndarray, ...]:
    """Speed, creepages and spin, load; some zero, some far beyond saturation."""
    generator = np.random.default_rng(1926)
    signs = generator.choice([-1.0, 0.0, 1.0], (3, COUNT))
    sizes = 10.0 ** generator.uniform([[-6], [-6], [-3]], [[0], [-1], [0.5]], (3, COUNT))
    speed = generator.uniform(1.0, 80.0, COUNT)
    load = generator.uniform(1e3, 2e5, COUNT)
    return (speed, *(signs * sizes), load)


@pytest.mark.parametrize("name", registry.names(GROUP))
def test_the_same_bits_as_plain_python(name: str) -> None:
    speed, along, across, spin, load = points()
    law = registry.resolve(GROUP, name)
    forces = creep_forces(name, BASE, WET_POLACH_2005, speed, along, across, spin, load=load)
    plain = [
        law(rescaled(BASE, q), WET_POLACH_2005, v, Creepage(*creepage))
        for v, *creepage, q in np.column_stack([speed, along, across, spin, load]).tolist()
    ]
    assert np.stack(forces[:3], axis=1).tobytes() == np.array(plain).tobytes()


def test_shapes_broadcast() -> None:
    along = np.linspace(-0.01, 0.01, 5)
    forces = creep_forces("polach_2005", BASE, WET_POLACH_2005, [[10.0], [20.0], [30.0]], along)
    assert [each.shape for each in forces] == [(3, 5)] * 4
    one = creep_forces("polach_2005", BASE, WET_POLACH_2005, 20.0, 0.01)
    assert one.longitudinal.shape == ()
    assert one.longitudinal == forces.longitudinal[1, -1]


def test_a_patch_grows_with_the_cube_root_of_its_load() -> None:
    light = rolling_contact(20e3, 0.46, math.inf, 0.3, 210e9, 0.28)
    here = rescaled(BASE, 20e3)
    assert (here.a, here.b) == pytest.approx((light.a, light.b), rel=1e-12)
    assert here.load == light.load
    assert here[3:] == pytest.approx(light[3:], rel=1e-9)


def spring(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> CreepForce:
    return CreepForce(contact.load * creepage.longitudinal, 0.0, 0.0)


def test_a_law_of_ones_own() -> None:
    forces = creep_forces(spring, BASE, WET_POLACH_2005, 20.0, [0.5, 2.0], load=10.0)
    assert forces.longitudinal.tolist() == [5.0, 20.0]
    assert forces.is_valid.tolist() == [True, False]


def test_beyond_its_validity_a_law_is_flagged_not_refused() -> None:
    linear = creep_forces("kalker_linear", BASE, WET_POLACH_2005, 20.0, [1e-4, 1e-2])
    assert linear.is_valid.tolist() == [True, False]
    carter = creep_forces("carter_1926", BASE, WET_POLACH_2005, 20.0, 1e-3, [0.0, 1e-4])
    assert carter.is_valid.tolist() == [True, False]


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"load": 0.0}, "the load must be positive and finite; got 0 N"),
        ({"load": [1e5, -5.0]}, "the load must be positive and finite; got -5 N"),
        ({"speed": 0.0}, "the speed must be positive and finite; got 0 m/s"),
        ({"speed": -3.0}, "the speed must be positive and finite; got -3 m/s"),
        ({"longitudinal": [0.0, math.nan]}, "the longitudinal creepage must be finite; got nan"),
        ({"lateral": math.inf}, "the lateral creepage must be finite; got inf"),
        ({"spin": math.nan}, "the spin must be finite; got nan 1/m"),
        ({"law": "polach"}, "law of rolling contact 'polach' unknown; .*mean 'polach_2005'"),
        ({"law": 5}, "a law must be a plain Python function; got int"),
        ({"speed": [1.0, 2.0], "spin": [0.0, 0.0, 0.0]}, r"do not fit together; got speed \(2,\)"),
        ({"spin": "fast"}, "the spin must be a number or an array of numbers; got 'fast'"),
    ],
)
def test_bad_input_gets_a_sentence(changed: dict[str, Any], words: str) -> None:
    given: dict[str, Any] = {
        "law": "polach_2005",
        "contact": BASE,
        "rail": WET_POLACH_2005,
        "speed": 20.0,
        "longitudinal": 0.01,
    }
    with pytest.raises(RailgripError, match=words):
        creep_forces(**{**given, **changed})


def test_no_load_to_rescale_to() -> None:
    with pytest.raises(RailgripError, match="the load must be positive and finite; got -1 N"):
        rescaled(BASE, -1.0)
