"""The contact of one axle in a step: slip, chord of the creep curve, limit of friction, all lanes.

The law is chosen outside the loops over the lanes; each pass is packed arithmetic (see `step`).
"""

from __future__ import annotations

from typing import Any

from railgrip.compiler import inlined, inlined_apart
from railgrip.contact.falling_friction import falling_friction
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.engine import layout
from railgrip.engine import offsets as at
from railgrip.engine.offsets import width
from railgrip.laboratory.creep_grid import chord_by_grid
from railgrip.laboratory.creep_spline import chord_by_table

LEAST_ROLLING_SPEED = 1e-3
"""Floor of the speed that creepage is formed with, m/s: at a stand every creepage is small."""
LEAST_CREEPAGE = 1e-7
"""Floor of the creepage, so that the chord T/s is defined; far below any that matters."""
CREEPING_SPEED = 0.5
"""Rolling speed at which the contact may pass the friction limit by as much again, m/s.

At a stand the contact is a spring that only the limit bounds, and a wheel that spins up at the
start outruns its chord. A rolling wheel is bounded by the law itself; a limit that now and then
cut its chord off would spoil the order of the integration. So the limit fades, with the fourth
power.
"""
STANDING_SPEED = 0.05
"""Below this rolling speed the contact turns into the elastic spring that it is at a stand, m/s."""
LEAST_LOAD = 0.05
"""A wheel keeps at least this share of its static load."""

_falling = inlined(falling_friction)
_polach = inlined(polach_2005)
_freibauer = inlined(freibauer_1983)
_shen = inlined(shen_hedrick_elkins_1983)
_by_table = inlined(chord_by_table)
_by_grid = inlined(chord_by_grid)


@inlined
def _rail(L: int, S: Any, b: int, k: int) -> RailFriction:
    return RailFriction(
        S[b + at.RAIL_FRICTION * L + k],
        S[b + at.RAIL_RATIO * L + k],
        S[b + at.RAIL_DECAY * L + k],
        S[b + at.RAIL_ADHESION * L + k],
        S[b + at.RAIL_SLIP * L + k],
    )


@inlined
def _hand_down(L: int, S: Any, b: int, k: int) -> tuple[float, float]:
    """Take train speed and pitching from the block in front; return speed and wheel load."""
    front = b - at.N_VARS * L
    train_speed = S[front + at.HERE_SPEED * L + k]
    pitch = S[front + at.HERE_PITCH * L + k]
    S[b + at.HERE_SPEED * L + k] = train_speed
    S[b + at.HERE_PITCH * L + k] = pitch
    static = S[b + at.STATIC_LOAD * L + k]
    load = max(static + S[b + at.LOAD_TRANSFER * L + k] * pitch, LEAST_LOAD * static)
    return train_speed, load


@inlined
def _standing(slope: float, rolling: float) -> float:
    """Return what the chord gains near a stand: there the contact sticks, whatever the creepage."""
    return slope * max(1.0 - rolling / STANDING_SPEED, 0.0)


@inlined
def _slip(L: int, S: Any, b: int, k: int) -> tuple[float, float, float, float]:
    """Return load, slip speed, rolling speed and creepage of one axle in one lane."""
    train_speed, load = _hand_down(L, S, b, k)
    wheel_speed = S[b + at.WHEEL_SPEED * L + k]
    slip_speed = abs(wheel_speed - train_speed)
    rolling = max(abs(train_speed), abs(wheel_speed))
    creepage = max(slip_speed / max(rolling, LEAST_ROLLING_SPEED), LEAST_CREEPAGE)
    return load, slip_speed, rolling, creepage


@inlined
def _keep_contact(
    L: int, S: Any, b: int, k: int, chord: float, limit: float, rolling: float
) -> None:
    S[b + at.CHORD * L + k] = chord + _standing(S[b + at.SLOPE * L + k], rolling)
    S[b + at.ROLLING * L + k] = rolling
    faded = rolling * (1.0 / CREEPING_SPEED)
    faded = faded * faded
    S[b + at.FRICTION_LIMIT * L + k] = limit * (1.0 + faded * faded)


@inlined
def law_pass(lanes: Any, S: Any, b: int, law: Any) -> None:
    """Chord of the creep curve, T/s, at the present slip, and the limit of friction."""
    L = width(lanes)
    for k in range(L):
        load, slip_speed, rolling, creepage = _slip(L, S, b, k)
        rail = _rail(L, S, b, k)
        force = law(rail, load, S[b + at.SLOPE * L + k], slip_speed, creepage)
        limit = _falling(rail, slip_speed) * load
        _keep_contact(L, S, b, k, force / creepage, limit, rolling)


@inlined_apart
def table_pass(lanes: Any, S: Any, b: int, table: Any) -> None:
    """The same with a law whose one curve stands in a table."""
    L = width(lanes)
    for k in range(L):
        load, slip_speed, rolling, creepage = _slip(L, S, b, k)
        limit = _falling(_rail(L, S, b, k), slip_speed) * load
        chord = _by_table(table, limit, S[b + at.SLOPE * L + k], creepage)
        _keep_contact(L, S, b, k, chord, limit, rolling)


@inlined_apart
def grid_pass(lanes: Any, S: Any, b: int, grid: Any, axis: Any) -> None:
    """The same with a law whose curve depends on more than the creepage."""
    L = width(lanes)
    for k in range(L):
        load, slip_speed, rolling, creepage = _slip(L, S, b, k)
        rail = _rail(L, S, b, k)
        limit = _falling(rail, slip_speed) * load
        chord = _by_grid(grid, axis, rail, load, S[b + at.SLOPE * L + k], rolling, creepage)
        _keep_contact(L, S, b, k, chord, limit, rolling)


@inlined
def _custom_pass(lanes: Any, S: Any, b: int, custom: Any) -> None:
    """The same with somebody's own law, lane by lane."""
    L = width(lanes)
    for k in range(L):
        load, slip_speed, rolling, creepage = _slip(L, S, b, k)
        rail = _rail(L, S, b, k)
        force = custom(
            rail.static_friction, rail.friction_ratio, rail.friction_decay,
            rail.adhesion_reduction, rail.slip_reduction,
            load, S[b + at.SLOPE * L + k], slip_speed, creepage,
        )  # fmt: skip
        limit = _falling(rail, slip_speed) * load
        _keep_contact(L, S, b, k, force / creepage, limit, rolling)


@inlined
def contact_pass(lanes: Any, S: Any, axle: int, creep_law: int, tables: Any, custom: Any) -> None:
    """Contact by the law that the scenario names."""
    b = (axle + at.AXLE_BLOCK) * at.N_VARS * width(lanes)
    if creep_law == layout.LAW_POLACH:
        law_pass(lanes, S, b, _polach)
    elif creep_law == layout.LAW_FREIBAUER:
        law_pass(lanes, S, b, _freibauer)
    elif creep_law == layout.LAW_SHEN:
        law_pass(lanes, S, b, _shen)
    elif creep_law == layout.LAW_TABLE:
        table_pass(lanes, S, b, tables.curves[axle, 0])
    elif creep_law == layout.LAW_GRID:
        grid_pass(lanes, S, b, tables.curves[axle], tables.axes[axle])
    else:
        _custom_pass(lanes, S, b, custom)
