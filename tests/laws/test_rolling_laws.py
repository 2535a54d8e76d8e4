"""What every law of rolling contact must obey, with creepages and spin together."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.kalker_1990 import kalker_coefficients
from railgrip.contact.kalker_linear import kalker_linear
from railgrip.contact.modified_fastsim_2013 import EUROSPRINTER_2013
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import (
    Creepage,
    CreepForce,
    RollingContact,
    rolling_contact,
)
from railgrip.contact.validity import Validity, is_within, validity_of
from railgrip.core import registry

Law = Callable[[RollingContact, RailFriction, float, Creepage], CreepForce]
GROUP = "railgrip.rolling_laws"
LAWS: dict[str, Law] = {name: registry.resolve(GROUP, name) for name in registry.names(GROUP)}
OURS = {name for name, law in LAWS.items() if law.__module__.startswith("railgrip.")}
every_law = pytest.mark.parametrize("name", sorted(OURS))
BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
WITHOUT_MOMENT = {"carter_1926", "polach_2005"}
GRIDS = {"fastsim_1982", "fastsim_elliptic_1982", "modified_fastsim_2013"}

few = settings(max_examples=40)


@st.composite
def contacts(draw: st.DrawFn) -> RollingContact:
    size, ratio = draw(st.floats(2e-3, 1e-2)), 2.0 ** draw(st.floats(-2.0, 2.0))
    a, b, poisson = size * math.sqrt(ratio), size / math.sqrt(ratio), draw(st.floats(0.2, 0.35))
    # a pressure between 0.3 and 1.5 GPa
    load = draw(st.floats(0.3e9, 1.5e9)) * 2.0 * math.pi * a * b / 3.0
    shear = 210e9 / (2.0 * (1.0 + poisson))
    return RollingContact(load, a, b, shear, poisson, *kalker_coefficients(a, b, poisson))


@st.composite
def rails(draw: st.DrawFn) -> RailFriction:
    adhesion = draw(st.floats(0.1, 1.0))
    return RailFriction(
        draw(st.floats(0.02, 0.8)),
        draw(st.floats(0.2, 1.0)),
        draw(st.floats(0.0, 1.0)),
        adhesion,
        adhesion * draw(st.floats(0.1, 1.0)),
    )


def signed(least: float, greatest: float) -> st.SearchStrategy[float]:
    """Zero, or a size between the two in even decades, with either sign."""
    size = st.floats(math.log10(least), math.log10(greatest)).map(lambda power: 10.0**power)
    return st.just(0.0) | st.builds(lambda s, sign: s * sign, size, st.sampled_from((-1.0, 1.0)))


CREEPAGES = st.builds(Creepage, signed(1e-6, 1.0), signed(1e-6, 0.1), signed(1e-4, 3.0))
SPEEDS = st.floats(1.0, 80.0)


def size_of(force: CreepForce) -> float:
    return math.hypot(force.longitudinal, force.lateral)


def limit_of(
    contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> float:
    slip = speed * math.hypot(creepage.longitudinal, creepage.lateral)
    return contact.load * falling_friction(rail, slip)


def close(one: CreepForce, other: CreepForce, scale: float, contact: RollingContact) -> None:
    """Equal but for rounding, against the greatest force there is."""
    arm = math.sqrt(contact.a * contact.b)
    size = max(scale, size_of(one), abs(one.spin_moment) / arm)
    assert one.longitudinal == pytest.approx(other.longitudinal, abs=1e-10 * size)
    assert one.lateral == pytest.approx(other.lateral, abs=1e-10 * size)
    assert one.spin_moment == pytest.approx(other.spin_moment, abs=1e-10 * size * arm)


@every_law
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS, creepage=CREEPAGES)
def test_odd_in_the_creepages(
    name: str, contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    there = LAWS[name](contact, rail, speed, creepage)
    back = LAWS[name](contact, rail, speed, Creepage(*(-each for each in creepage)))
    assert back == CreepForce(*(-each for each in there))


@every_law
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS, creepage=CREEPAGES)
def test_mirrored_in_y(
    name: str, contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    here = LAWS[name](contact, rail, speed, creepage)
    seen = LAWS[name](
        contact, rail, speed, Creepage(creepage.longitudinal, -creepage.lateral, -creepage.spin)
    )
    mirrored = CreepForce(seen.longitudinal, -seen.lateral, -seen.spin_moment)
    close(here, mirrored, limit_of(contact, rail, speed, creepage), contact)


@pytest.mark.parametrize("name", sorted(OURS - {"kalker_linear"}))
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS, creepage=CREEPAGES)
def test_friction_bounds_the_force(
    name: str, contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    force = LAWS[name](contact, rail, speed, creepage)
    limit = limit_of(contact, rail, speed, creepage)
    assert size_of(force) <= limit * (1.0 + 1e-12)
    if is_within(validity_of(LAWS[name]), contact, rail, speed, creepage):
        assert abs(force.spin_moment) <= limit * max(contact.a, contact.b)


def test_friction_bounds_polach_where_spin_outweighs_the_reduced_curve() -> None:
    soft = COULOMB._replace(adhesion_reduction=0.1, slip_reduction=0.05)
    long = rolling_contact(100e3, 0.46, math.inf, 0.05, 210e9, 0.28)
    spins = [0.3 * step for step in range(1, 20)]
    forces = [
        size_of(LAWS["polach_2005"](long, soft, 20.0, Creepage(0.0, -0.5 * long.a * spin, spin)))
        for spin in spins
    ]
    assert max(forces) <= 30e3 * (1.0 + 1e-12)


@every_law
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS, creepage=CREEPAGES)
def test_passive_the_contact_takes_power(
    name: str, contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    """With the spin moment, where a law gives one; else without spin."""
    if name in WITHOUT_MOMENT:
        creepage = creepage._replace(spin=0.0)
    force = LAWS[name](contact, rail, speed, creepage)
    parts = [one * other for one, other in zip(force, creepage, strict=True)]
    assert sum(parts) >= -1e-10 * sum(abs(part) for part in parts)


@every_law
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS, creepage=CREEPAGES)
def test_continuous(
    name: str, contact: RollingContact, rail: RailFriction, speed: float, creepage: Creepage
) -> None:
    """A step of a millionth of μQ by linear theory moves no force by more than a few of these."""
    limit = limit_of(contact, rail, speed, creepage)
    area = contact.a * contact.b
    step = 1e-6 * limit / (contact.shear_modulus * area * contact.c11)
    spin_step = step / math.sqrt(area)
    before = LAWS[name](contact, rail, speed, creepage)
    after = LAWS[name](
        contact,
        rail,
        speed,
        Creepage(creepage.longitudinal + step, creepage.lateral - step, creepage.spin + spin_step),
    )
    # friction falls with the slip speed at most by B μ0 a m/s
    falls = rail.friction_decay * speed * 2.0 * step * contact.load * rail.static_friction
    moved = math.hypot(after.longitudinal - before.longitudinal, after.lateral - before.lateral)
    assert moved <= 20e-6 * limit + falls


SHARES: dict[str, tuple[float, float, float]] = {
    "carter_1926": (1.0, 0.0, 0.0),
    "modified_fastsim_2013": (EUROSPRINTER_2013.initial,) * 3,
}
"""Initial slope over Kalker's, by longitudinal creepage, lateral creepage, spin; 1 elsewhere."""


@every_law
@pytest.mark.parametrize("by", [0, 1, 2])
@few
@given(contact=contacts(), rail=rails(), speed=SPEEDS)
def test_initial_slope(
    name: str, by: int, contact: RollingContact, rail: RailFriction, speed: float
) -> None:
    """All laws have Kalker's tangent: force along the track, across it, and by spin across it."""
    limit = contact.load * rail.static_friction
    unit = [0.0, 0.0, 0.0]
    unit[by] = 1.0
    slope = size_of(kalker_linear(contact, rail, speed, Creepage(*unit)))
    # so little that the falling friction has not begun and nothing slides
    little = 1e-6 * limit / slope
    unit[by] = little
    force = LAWS[name](contact, rail, speed, Creepage(*unit))
    share = SHARES.get(name, (1.0, 1.0, 1.0))[by]
    if name == "polach_2005" and by < 2:
        share = 0.5 * (rail.adhesion_reduction + rail.slip_reduction)
    wanted = share * slope * little
    along, across = (wanted, 0.0) if by == 0 else (0.0, wanted)
    # 50 cells add up the parabola that spin makes of the traction to (π/50)²/24 of it
    tolerance = (2e-4 if name in GRIDS and by == 2 else 5e-6) * slope * little
    assert force.longitudinal == pytest.approx(along, abs=tolerance)
    assert force.lateral == pytest.approx(across, abs=tolerance)


@every_law
def test_nothing_divides_by_zero(name: str) -> None:
    for friction in (0.0, 0.3):
        rail = COULOMB._replace(static_friction=friction)
        for creepage in (
            Creepage(0.0, 0.0, 0.0),
            Creepage(1e-12, 0.0, 0.0),
            Creepage(0.0, 0.0, 1e-9),
            Creepage(1e-300, 1e-300, 1e-300),
            Creepage(-1.0, 0.5, 30.0),
            Creepage(0.0, -0.01, 0.01 / BASE.a),
        ):
            force = LAWS[name](BASE, rail, 20.0, creepage)
            assert all(math.isfinite(each) for each in force)
            if name != "kalker_linear":
                assert size_of(force) <= friction * BASE.load * (1.0 + 1e-12)


@every_law
def test_the_moment_where_the_forces_cancel(name: str) -> None:
    """Where forces of linear theory cancel, the moment stays the one of linear theory."""
    spin = 1e-4
    lateral = -math.sqrt(BASE.a * BASE.b) * BASE.c23 / BASE.c22 * spin
    creepage = Creepage(0.0, lateral, spin)
    moment = LAWS[name](BASE, COULOMB, 20.0, creepage).spin_moment
    if name in WITHOUT_MOMENT:
        assert moment == 0.0
    elif name not in GRIDS:
        assert moment == pytest.approx(kalker_linear(BASE, COULOMB, 20.0, creepage).spin_moment)


def test_what_a_law_declares() -> None:
    assert validity_of(LAWS["kalker_linear"]) == Validity(total_share=0.3)
    assert validity_of(LAWS["fastsim_1982"]) == Validity()
    carter = validity_of(LAWS["carter_1926"])
    assert is_within(carter, BASE, COULOMB, 20.0, Creepage(0.01, 0.0, 0.0))
    assert not is_within(carter, BASE, COULOMB, 20.0, Creepage(0.01, 1e-5, 0.0))
    assert not is_within(carter, BASE, COULOMB, 20.0, Creepage(0.01, 0.0, 1e-3))
    assert not is_within(Validity(), BASE, COULOMB, 20.0, Creepage(-1.1, 0.0, 0.0))


def test_linear_theory_is_a_tenth_too_large_where_its_validity_ends() -> None:
    creepage = Creepage(0.3 * 30e3 / (BASE.shear_modulus * BASE.a * BASE.b * BASE.c11), 0.0, 0.0)
    linear = kalker_linear(BASE, COULOMB, 20.0, creepage).longitudinal
    exact = LAWS["fastsim_1982"](BASE, COULOMB, 20.0, creepage).longitudinal
    assert linear / exact == pytest.approx(1.1, abs=0.02)
