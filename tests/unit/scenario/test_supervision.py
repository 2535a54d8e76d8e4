"""From the words of a case to what the supervision works with."""

from __future__ import annotations

from typing import Any

import pytest

from railgrip.control.etcs.train_data import Brakes
from railgrip.scenario.supervision import SupervisionCase

LAMBDA = {"length": 500, "braked_weight": 110}


def brakes(national: dict[str, Any], **train: Any) -> Brakes:
    case = {"train": LAMBDA | train, "target": {"at": 5000}, "national": national}
    return SupervisionCase.model_validate(case).supervised_train().brakes


def test_factors_of_a_braked_weight() -> None:
    """A = Kv Kr A_basic; passenger Kv lies between its tables by the greatest deceleration."""
    basic = 0.0075 * 110 + 0.076
    found = brakes({
        "kv_passenger": [{"weak": 0.6, "strong": 0.8}], "a_nvp12": 0.8, "a_nvp23": 1.0,
        "kr": [{"value": 1.0}, {"over": 400, "value": 0.9}], "kt": 1.2,
    })  # fmt: skip
    kv = 0.6 + (basic - 0.8) / 0.2 * 0.2
    assert found.safe.at(10.0) == pytest.approx(kv * 0.9 * basic)
    assert found.service.at(10.0) == pytest.approx(basic)
    assert found.emergency_time == pytest.approx(1.2 * (2.3 + 0.17 * 25))
    assert found.service_time == pytest.approx(3 + 1.5 * 5 + 0.1 * 25)


def test_a_length_step_holds_beyond_its_length() -> None:
    kr = [{"value": 1.0}, {"over": 500, "value": 0.9}]
    short, long = brakes({"kr": kr}), brakes({"kr": kr}, length=500.1)
    assert long.safe.at(10.0) == pytest.approx(0.9 * short.safe.at(10.0))


def test_kv_steps_cut_the_decelerations_steps() -> None:
    kv = [{"weak": 1.0, "strong": 1.0}, {"from": "50 km/h", "weak": 0.5, "strong": 0.5}]
    found = brakes({"kv_passenger": kv, "kr": [{"value": 1.0}]})
    assert found.safe.at(14.0) == pytest.approx(0.5 * found.safe.at(13.0))


def test_reduced_adhesion_by_kind_of_train() -> None:
    caps = []
    for train in ({}, {"adhesion_independent_brake": True}, {"position": "freight G"}):
        case = {"train": LAMBDA | train, "target": {"at": 5000},
                "national": {"reduced_adhesion": [1.0, 0.8, 0.6]},
                "reduced_adhesion": [{"from": 1000, "to": 2000}]}  # fmt: skip
        cap = SupervisionCase.model_validate(case).supervised_track().cap
        assert cap.at(999.0) == cap.at(2500.1) == float("inf")
        caps.append(cap.at(2400.0))  # the rear of 500 m is still inside
    assert caps == [0.8, 1.0, 0.6]


def test_the_service_brake_needs_interface_and_permission() -> None:
    for interface, allowed in ((True, True), (True, False), (False, True)):
        case = {"train": LAMBDA | {"service_brake_interface": interface},
                "target": {"at": 5000}, "national": {"service_brake": allowed}}  # fmt: skip
        train = SupervisionCase.model_validate(case).supervised_train()
        assert train.commands_service_brake == (interface and allowed)
