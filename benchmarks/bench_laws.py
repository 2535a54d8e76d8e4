"""What one evaluation of a law of contact costs: in the engine's loop, over arrays, on a patch.

Polach's law is measured in the form that the engine's inner loop has: blocks of sixteen lanes in a
flat array, the state of the rail, load, slope, slip speed and creepage read from it and the force
written back, packed by LLVM. The engine's own pass, which also forms load, slip and creepage and
keeps the chord, is measured beside it, and so is the same pass with a law that stands in a table,
of one curve (longitudinal creepage alone) and of several (with an angle of attack). FASTSIM is
measured on a patch of 50 x 50 cells with creepages and spin: with strips abreast, as the laboratory
takes it over arrays, and strip by strip, as the law is written down.

    python benchmarks/bench_laws.py [--quick] [--out FILE]
"""

from __future__ import annotations

import math

import numpy as np
from _common import best_of, options, report

from railgrip.compiler import compiled, entry, inlined
from railgrip.contact.fastsim_1982 import fastsim_1982
from railgrip.contact.freibauer_1983 import freibauer_1983
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.contact.shen_hedrick_elkins_1983 import shen_hedrick_elkins_1983
from railgrip.core import registry
from railgrip.engine import offsets as at
from railgrip.engine.contact_pass import grid_pass, law_pass, table_pass
from railgrip.engine.offsets import SIXTEEN_LANES, width
from railgrip.laboratory.fastsim_map import fastsim_map
from railgrip.laboratory.fastsim_strips import ABREAST, work_space
from railgrip.laboratory.laws_over_arrays import creep_forces
from railgrip.laboratory.tabulate import tabulate

LANES, BLOCKS = len(SIXTEEN_LANES), 16
MU, RATIO, DECAY, STICK, SLIDE, LOAD, SLOPE, SLIP, CREEPAGE, FORCE, N_VARS = map(
    np.uint64, range(11)
)
BASE = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
COULOMB = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
COMBINED = Creepage(0.002, -0.001, 0.4)
DEMANDED_RATE, DEMANDED_PATCH, DEMANDED_RATIO = 100.0, 100.0, 2.0


@inlined
def _lane_pass(lanes, S, b, law):
    """One block of lanes, laid out and read as the engine's."""
    L = width(lanes)
    for k in range(L):
        rail = RailFriction(
            S[b + MU * L + k], S[b + RATIO * L + k], S[b + DECAY * L + k],
            S[b + STICK * L + k], S[b + SLIDE * L + k],
        )  # fmt: skip
        S[b + FORCE * L + k] = law(
            rail, S[b + LOAD * L + k], S[b + SLOPE * L + k],
            S[b + SLIP * L + k], S[b + CREEPAGE * L + k],
        )  # fmt: skip


def lane_loop(law):
    """Compile the loop over blocks around one law."""
    inner = inlined(law)

    def loop(lanes, S, times):
        block = N_VARS * width(lanes)
        for _ in range(times):
            for axle in range(BLOCKS):
                _lane_pass(lanes, S, np.uint64(axle) * block, inner)

    return compiled(loop)


_polach = inlined(polach_2005)


@entry
def _engine_loop(lanes, S, times):
    block = at.N_VARS * width(lanes)
    for _ in range(times):
        for axle in range(BLOCKS):
            law_pass(lanes, S, np.uint64(axle + 1) * block, _polach)


@entry
def _table_loop(lanes, S, table, times):
    block = at.N_VARS * width(lanes)
    for _ in range(times):
        for axle in range(BLOCKS):
            table_pass(lanes, S, np.uint64(axle + 1) * block, table)


@entry
def _grid_loop(lanes, S, grid, axis, times):
    block = at.N_VARS * width(lanes)
    for _ in range(times):
        for axle in range(BLOCKS):
            grid_pass(lanes, S, np.uint64(axle + 1) * block, grid, axis)


def table_rows(evaluations, times, repeats):
    """FASTSIM from tables in the engine's law pass, beside Polach computed there."""
    curve = tabulate("fastsim_1982", BASE, COULOMB).curves[0]
    grid = tabulate("fastsim_1982", BASE, COULOMB, lateral=0.003)
    axis, S = np.array(grid.axis), engine_state()
    calls = {
        "Polach": lambda n: _engine_loop(SIXTEEN_LANES, S, n),
        "table of one curve": lambda n: _table_loop(SIXTEEN_LANES, S, curve, n),
        "table of several": lambda n: _grid_loop(SIXTEEN_LANES, S, grid.curves, axis, n),
    }
    rows, seconds = [], {}
    for name, call in calls.items():
        call(1)
        seconds[name] = best_of(repeats, lambda: call(times)).cpu  # noqa: B023
        rate = evaluations / seconds[name] / 1e6
        rows.append((f"the engine's law pass, {name}", rate, "million/s", ""))
    asked = f"demanded: at most {DEMANDED_RATIO:.0f}"
    ratio = seconds["table of one curve"] / seconds["Polach"]
    rows.append(("table of one curve over Polach", ratio, "", asked))
    ratio = seconds["table of several"] / seconds["Polach"]
    rows.append(("table of several over Polach", ratio, "", ""))
    made = best_of(repeats, lambda: tabulate("fastsim_1982", BASE, COULOMB)).cpu
    rows.append(("FASTSIM tabulated, one curve", made * 1e3, "ms", ""))
    return rows


_abreast = inlined(ABREAST[fastsim_1982])
_by_strip = inlined(fastsim_1982)


@entry
def _patches_abreast(contact, rail, work, times):
    total = 0.0
    for i in range(times):
        here = Creepage(0.002, -0.001, 0.4 + 1e-9 * i)
        total += _abreast(contact, rail, 20.0, here, work).longitudinal
    return total


@entry
def _patches_by_strip(contact, rail, times):
    total = 0.0
    for i in range(times):
        here = Creepage(0.002, -0.001, 0.4 + 1e-9 * i)
        total += _by_strip(contact, rail, 20.0, here).longitudinal
    return total


def lanes_full_of_wheels():
    """Wheels on dry and wet rail, each at its own load and creepage, in the layout above."""
    draw = np.random.default_rng(2005)
    table = np.empty((BLOCKS, int(N_VARS), LANES))
    table[:, :5] = np.where(
        draw.random((BLOCKS, 1, LANES)) < 0.5,
        np.array(DRY_POLACH_2005)[None, :, None],
        np.array(WET_POLACH_2005)[None, :, None],
    )
    table[:, int(LOAD)] = draw.uniform(4e4, 1e5, (BLOCKS, LANES))
    table[:, int(SLOPE)] = draw.uniform(8e6, 1.5e7, (BLOCKS, LANES))
    table[:, int(CREEPAGE)] = 10.0 ** draw.uniform(-4, -0.5, (BLOCKS, LANES))
    table[:, int(SLIP)] = 30.0 * table[:, int(CREEPAGE)]
    return table.ravel()


def engine_state():
    """The engine's own lanes, as far as its law pass reads them."""
    wheels = lanes_full_of_wheels().reshape(BLOCKS, int(N_VARS), LANES)
    table = np.zeros((BLOCKS + 1, int(at.N_VARS), LANES))
    table[:, int(at.HERE_SPEED)] = 30.0
    rail = (at.RAIL_FRICTION, at.RAIL_RATIO, at.RAIL_DECAY, at.RAIL_ADHESION, at.RAIL_SLIP)
    for offset, ours in zip(rail, range(5), strict=True):
        table[1:, int(offset)] = wheels[:, ours]
    table[1:, int(at.STATIC_LOAD)] = wheels[:, int(LOAD)]
    table[1:, int(at.SLOPE)] = wheels[:, int(SLOPE)]
    table[1:, int(at.WHEEL_SPEED)] = 30.0 * (1.0 - wheels[:, int(CREEPAGE)])
    return table.ravel()


def main() -> None:
    chosen = options(__doc__)
    times, patches, repeats = (4_000, 300, 3) if chosen.quick else (40_000, 3_000, 9)
    evaluations = times * BLOCKS * LANES
    rows = []
    for law in (polach_2005, freibauer_1983, shen_hedrick_elkins_1983):
        loop, S = lane_loop(law), lanes_full_of_wheels()
        loop(SIXTEEN_LANES, S, 1)
        seconds = best_of(repeats, lambda: loop(SIXTEEN_LANES, S, times)).cpu  # noqa: B023
        is_asked = law is polach_2005
        demand = f"demanded: {DEMANDED_RATE:.0f} million" if is_asked else ""
        rows.append((f"{law.__name__}, in lanes", evaluations / seconds / 1e6, "million/s", demand))
    rows += table_rows(evaluations, times, repeats)

    points = 2_000
    along = np.geomspace(1e-4, 0.3, points)
    for name in registry.names("railgrip.rolling_laws"):
        creep_forces(name, BASE, COULOMB, 20.0, along, 1e-4, 0.1)
        call = lambda: creep_forces(name, BASE, COULOMB, 20.0, along, 1e-4, 0.1)  # noqa: B023, E731
        rows.append((f"{name}, over arrays", best_of(repeats, call).cpu / points * 1e9, "ns", ""))

    work = work_space(50)
    _patches_abreast(BASE, COULOMB, work, 1)
    _patches_by_strip(BASE, COULOMB, 1)
    fast = best_of(repeats, lambda: _patches_abreast(BASE, COULOMB, work, patches)).cpu / patches
    slow = best_of(repeats, lambda: _patches_by_strip(BASE, COULOMB, patches // 4)).cpu
    slow /= patches // 4
    fastsim_map(BASE, COULOMB, 20.0, COMBINED)
    drawn = best_of(repeats, lambda: fastsim_map(BASE, COULOMB, 20.0, COMBINED)).cpu
    asked = f"demanded: under {DEMANDED_PATCH:.0f} µs"
    rows += [
        ("FASTSIM 50 x 50, strips abreast", fast * 1e6, "µs", asked),
        ("FASTSIM 50 x 50, strip by strip", slow * 1e6, "µs", asked),
        ("strip by strip over abreast", slow / fast, "", ""),
        ("FASTSIM 50 x 50 with its maps", drawn * 1e6, "µs", ""),
    ]
    report("Laws of contact, one core", rows, chosen.out)


if __name__ == "__main__":
    main()
