"""Figures 1 and 2 of ES 100 730 with their points K1 to K9, against formulas worked out by hand.

A train of constant acceleration a and constant resistance r makes every arc a parabola (in v² over
the distance a straight line), so each point is where two lines meet. Tolerance 1 mm and 0.01 mm/s.
"""

from __future__ import annotations

from math import sqrt

import pytest

from railgrip.control.coasting.coasting_law import CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.control.etcs.steps import Steps, constant
from railgrip.laboratory.coasting_run import Change, CoastingRun, Driver
from railgrip.laboratory.point_train import PointTrain

A, R, B = 0.5, 0.05, 0.8
MASS = 100e3
TRAIN = PointTrain(MASS, 0.0, 1e9, 1e12, (R * MASS, 0.0, 0.0), A)
LAST = 5000.0


def meet(first: tuple[float, float], second: tuple[float, float]) -> tuple[float, float]:
    """Where two lines v² = p + q x meet: position and speed."""
    x = (second[0] - first[0]) / (first[1] - second[1])
    return x, sqrt(first[0] + first[1] * x)


def falls(point: tuple[float, float]) -> tuple[float, float]:
    """The line of a train that coasts from a point."""
    return point[1] ** 2 + 2 * R * point[0], -2 * R


def at(change: Change) -> tuple[float, float]:
    return change.position, change.speed


def close(point: tuple[float, float]) -> object:
    return pytest.approx(point, abs=1e-3, rel=1e-7)


def run(law: CoastingLaw, limits: Steps, with_coasting: bool = True) -> CoastingRun:
    return Driver(TRAIN, law, limits, LAST, with_coasting=with_coasting).run()


def test_figure_1() -> None:
    """K1: F meets the ALK; K2: F would meet B; K3: coasting meets B; P2: stop."""
    b_alk = 0.15
    law = CoastingLaw(CoastingParameters(B, coasting_deceleration=b_alk))
    pulled, brake, alk = (0.0, 2 * A), (2 * B * LAST, -2 * B), (2 * b_alk * LAST, -2 * b_alk)
    k1, k2 = meet(pulled, alk), meet(pulled, brake)
    k3 = meet(falls(k1), brake)
    free = constant(1000.0)
    with_law, without = run(law, free), run(law, free, with_coasting=False)
    assert at(with_law.at("coasting")) == close(k1)
    assert at(without.at("braking")) == close(k2)
    assert at(with_law.at("braking")) == close(k3)
    assert with_law.position[-1] == pytest.approx(LAST, abs=0.01)
    # the braking curve is met later and slower, with less energy and a little later at P2
    assert k3[0] > k2[0]
    assert k3[1] < k2[1]
    assert with_law.energy == pytest.approx(MASS * (A + R) * k1[0], rel=1e-6)
    assert without.energy == pytest.approx(MASS * (A + R) * k2[0], rel=1e-6)
    assert with_law.brake_work < without.brake_work
    assert with_law.changes[-1].time > without.changes[-1].time


def test_figure_2() -> None:
    """K4 to K6 before the lower speed at P4, K7 to K9 before the stop at P6; straight ALK."""
    k, fast, slow, p4 = 0.02, 30.0, 15.0, 3000.0
    law = CoastingLaw(CoastingParameters(B, shape="straight", distance_gain=k))
    limits = Steps((0.0, p4), (fast, slow))
    brake_1 = (slow**2 + 2 * B * p4, -2 * B)
    brake_2 = (2 * B * LAST, -2 * B)
    k4 = (p4 - (fast - slow) / k, fast)
    k5 = (p4 - (fast**2 - slow**2) / (2 * B), fast)
    k6 = meet(falls(k4), brake_1)
    k7 = (LAST - slow / k, slow)
    k8 = (LAST - slow**2 / (2 * B), slow)
    k9 = meet(falls(k7), brake_2)
    with_law, without = run(law, limits), run(law, limits, with_coasting=False)
    assert at(with_law.at("coasting")) == close(k4)
    assert at(without.at("braking")) == close(k5)
    assert at(with_law.at("braking")) == close(k6)
    assert at(with_law.at("target")) == close((p4, slow))
    assert at(with_law.at("coasting", 1)) == close(k7)
    assert at(without.at("braking", 1)) == close(k8)
    assert at(with_law.at("braking", 1)) == close(k9)
    assert with_law.position[-1] == pytest.approx(LAST, abs=0.01)
    # between P4 and K7 the train runs on under traction at the lower speed
    target = with_law.at("target")
    assert (target.mode, target.is_acting) == ("cruise", False)
    assert with_law.energy < without.energy
    assert [c.is_acting for c in with_law.changes if c.event == "coasting"] == [True, True]
