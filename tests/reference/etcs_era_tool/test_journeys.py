"""A run that goes on at 160 km/h passes each limit where ERA's tool has it.

Source: values stored in ERA's braking curves tool v3.0, as published by the openETCS project
(ERTMSFormalSpecs), before a stop at 7 000 m. Tolerance 0.25 m: the tool integrates in steps.
"""

from __future__ import annotations

import numpy as np
import pytest

from railgrip.control.etcs.limit_table import LIMITS
from railgrip.control.etcs.supervision import supervision_limits
from railgrip.control.etcs.train_data import Target
from railgrip.engine.journey.drive import drive
from railgrip.engine.journey.supervision import Onboard
from railgrip.engine.journey.watching import watched
from railgrip.scenario.journey import Journey

KMH = 1.0 / 3.6
HILLS = [(0.0, 0.0), (4000.0, 2e-3), (6000.0, -1e-3), (6500.0, -2e-3)]
GAMMA = {"length": 600.0, "emergency": [{"value": 1.0}], "service": [{"value": 1.0}],
         "emergency_time": 2.5, "service_time": 2.5}  # fmt: skip
LAMBDA = {"length": 700.0, "braked_weight": 150, "position": "freight P"}
NATIONAL = {"kv_freight": [{"value": 0.97}], "kr": [{"value": 1.0}], "kt": 1.0}
PUBLISHED = {
    "gamma": (1513.184, 1290.962, 1202.073, 1113.184, 1113.184),
    "lambda": (2345.127, 1549.038, 1460.149, 1371.260, 1371.260),
}


def cruising(case: str) -> Journey:
    """A driver at 160 km/h who would brake at 5 m/s² only."""
    train, hills, national = (
        (GAMMA, HILLS, {}) if case == "gamma" else (LAMBDA, HILLS[:1], NATIONAL)
    )
    return Journey(
        train={
            "mass": 400e3,
            "max_speed": 160 * KMH,
            "effort": {"force": 4e5, "power": 2e7},
            "max_deceleration": 5.0,
        },
        line={
            "length": 8e3,
            "speed_limit": [{"at": 0.0, "value": 160 * KMH}],
            "gradient": [{"at": at, "value": value} for at, value in hills],
        },
        stop=[{"at": 0.0}, {"at": 7000.0}],
        braking=5.0,
        supervision={"train": train, "national": national, "past_stop": 0.0,
                     "release_speed": 30 * KMH},
    )  # fmt: skip


@pytest.mark.parametrize("case", PUBLISHED)
def test_the_limits_are_passed_where_the_tool_has_them(case: str) -> None:
    run = drive(cruising(case))
    trace = (run.trace[name] for name in ("time", "position", "speed"))
    found = watched(run.journey, *trace, run.told)
    (approach,) = found.approaches
    assert approach.passed == pytest.approx(PUBLISHED[case], abs=0.25)
    names = ("indication", "overspeed", "warning", "emergency brake")
    places = {one.status: 7000.0 - one.position for one in reversed(found.log)}
    expected = [PUBLISHED[case][k] for k in (0, 1, 2, 4)]
    assert [places[name] for name in names] == pytest.approx(expected, abs=0.25)


@pytest.mark.parametrize("case", PUBLISHED)
def test_the_limits_are_those_of_railgrip_etcs_at_all_speeds(case: str) -> None:
    """Tables of 0.02 m/s against the curves themselves, 3 cm."""
    onboard = Onboard(cruising(case))
    table = onboard.way(np.inf, 7000.0).tables[0]
    speeds = np.linspace(31.0, 160.0, 130) * KMH
    limits = supervision_limits(
        onboard.own.train_before(0.0), onboard.track, Target(7000.0), speeds,
        release_speed=30 * KMH,
    )  # fmt: skip
    rows = dict(zip(LIMITS, table.distance_at(speeds), strict=True))
    for name in ("indication", "permitted", "warning", "ebi"):
        assert rows[name] == pytest.approx(getattr(limits, name), abs=0.03)
    assert rows["sbi"] == pytest.approx(np.fmax(limits.sbi1, limits.sbi2), abs=0.03)
