"""From the options of `railgrip contact` to a pair, a rail, laws, and the points to compute."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from railgrip.core.errors import Problem, RailgripError, unknown_name

if TYPE_CHECKING:
    from railgrip.app.contact_options import Geometry, Motion, Range
    from railgrip.contact.rail_friction import RailFriction
    from railgrip.scenario.contact_pair import ContactPair
    from railgrip.scenario.contact_state import ContactState

MOST_POINTS = 100_000
RANGES = {
    "creepage": ("0", "2 %"),
    "lateral": ("0", "1 %"),
    "spin": ("0", "2 1/m"),
    "speed": ("10 km/h", "200 km/h"),
    "load": ("20 kN", "150 kN"),
}
"""What can be swept, and from where to where if nothing is said."""

_KEYS = {
    "wheel_radius": "wheel.radius",
    "wheel_transverse_radius": "wheel.transverse_radius",
    "position": "wheel.s1002_position",
    "rail_transverse_radius": "rail.head_radius",
    "young": "young",
    "poisson": "poisson",
}
_EXCLUDED = {
    "wheel_transverse_radius": "wheel.s1002_position",
    "position": "wheel.transverse_radius",
    "rail_transverse_radius": "rail.worn_width",
}
"""What an option takes the place of."""


def pair_from(geometry: Geometry) -> ContactPair:
    """Return the pair of this name or file, changed by what the options say.

    Raises
    ------
    RailgripError
        ``--pair: contact pair 'cone' unknown; …``; ``--wheel-radius: is out of range; …``
    """
    from railgrip.scenario.changed_pair import changed_pair
    from railgrip.scenario.contact_pair import contact_pair

    with told_as({"": "--pair"}):
        pair = contact_pair(geometry.pair)
    changes: dict[str, Any] = {}
    for option, key in _KEYS.items():
        word = getattr(geometry, option)
        if word:
            changes[key] = quantity(word)
            if option in _EXCLUDED:
                changes.setdefault(_EXCLUDED[option], None)
    with told_as({key: f"--{option.replace('_', '-')}" for option, key in _KEYS.items()}):
        return changed_pair(pair, changes) if changes else pair


def rail_from(geometry: Geometry) -> RailFriction:
    """Return the friction of a rail condition, or a constant one."""
    from railgrip.scenario.contact_state import constant_friction_rail, rail_friction

    if geometry.friction:
        with told_as({"static_friction": "--friction"}):
            return constant_friction_rail(quantity(geometry.friction))
    with told_as({"": "--rail"}):
        return rail_friction(geometry.rail)


def state_from(motion: Motion, swept: str) -> ContactState:
    """Return load, speed and creepages of a wheel; a little creepage if the user names none.

    Raises
    ------
    RailgripError
        ``--load: is out of range; got 0 N; allowed: more than 0 N and at most 1e+06 N``
    """
    from railgrip.scenario.contact_state import contact_state

    creeps = (
        swept in ("creepage", "lateral", "spin") or motion.creepage or motion.lateral or motion.spin
    )
    words = {
        "load": motion.load,
        "speed": motion.speed,
        "longitudinal": motion.creepage or ("0" if creeps else "0.2 %"),
        "lateral": motion.lateral or "0",
        "spin": motion.spin or "0",
        "wheel_temperature": motion.wheel_temperature,
        "rail_temperature": motion.rail_temperature,
    }
    with told_as({name: _option(name) for name in words}):
        return contact_state({name: quantity(word) for name, word in words.items()})


def laws_from(laws: str, reference: str) -> tuple[list[str], str]:
    """Return the laws that ``--laws a,b`` or ``--laws all`` names, and the one to compare with.

    Raises
    ------
    RailgripError
        ``--laws: law of rolling contact 'polach' unknown; known: …; did you mean 'polach_2005'?``
    """
    from railgrip.laboratory.law_comparison import EXACT, law_names

    known = law_names()
    names = [part.strip() for part in laws.split(",") if part.strip()]
    if names == ["all"]:
        names, reference = known, reference or EXACT
    if not names:
        cure = f"all, or one of {', '.join(known)}"
        raise RailgripError(Problem("--laws", "no law is given", cure=cure))
    reference = reference or names[0]
    for option, name in (*(("--laws", name) for name in names), ("--reference", reference)):
        if name not in known:
            raise RailgripError(unknown_name(option, "law of rolling contact", name, known))
    return list(dict.fromkeys([*names, reference])), reference


class Sweep(NamedTuple):
    """What is varied (a name of `ContactState`), between two values in SI."""

    variable: str
    begin: float
    end: float
    points: int


def sweep_from(wanted: Range) -> Sweep | None:
    """Return the sweep that the options ask for, or None for a single case.

    Raises
    ------
    RailgripError
        ``--sweep: variable 'slip' unknown; known: …``; ``--points: is out of range; got 1; …``;
        ``--to: must be above --from; got …``
    """
    from railgrip.scenario.contact_state import contact_state

    if not wanted.sweep:
        for option, word in (("--from", wanted.begin), ("--to", wanted.end)):
            if word:
                raise RailgripError(Problem(option, "needs --sweep", cure="--sweep creepage"))
        return None
    if wanted.sweep not in RANGES:
        raise RailgripError(unknown_name("--sweep", "variable", wanted.sweep, RANGES))
    if not 2 <= wanted.points <= MOST_POINTS:
        allowed = f"2 … {MOST_POINTS}"
        raise RailgripError(Problem("--points", "is out of range", f"{wanted.points}", allowed))
    variable = "longitudinal" if wanted.sweep == "creepage" else wanted.sweep
    usual = RANGES[wanted.sweep]
    begin, end = wanted.begin or usual[0], wanted.end or usual[1]
    with told_as({variable: "--from"}):
        first = float(getattr(contact_state({variable: quantity(begin)}), variable))
    with told_as({variable: "--to"}):
        last = float(getattr(contact_state({variable: quantity(end)}), variable))
    if not first < last:
        got = f"from {begin} to {end}"
        raise RailgripError(Problem("--to", "must be above --from", got=got))
    return Sweep(variable, first, last, wanted.points)


def quantity(word: str) -> Any:
    """Return a bare number as a number in SI, anything else as it stands.

    Examples
    --------
    >>> quantity("100 kN"), quantity("-0.002")
    ('100 kN', -0.002)
    """
    try:
        return float(word)
    except ValueError:
        return word


@contextmanager
def told_as(options: Mapping[str, str]) -> Iterator[None]:
    """Tell problems by the option that the user wrote, not by the key it stands for."""
    try:
        yield
    except RailgripError as error:
        raise RailgripError(
            [replace(p, where=options.get(p.where, p.where)) for p in error.problems]
        ) from None


def _option(name: str) -> str:
    return "--creepage" if name == "longitudinal" else f"--{name.replace('_', '-')}"
