"""Train and track of a description, as the supervision computes with them."""

from __future__ import annotations

from collections.abc import Sequence

from railgrip.control.etcs import train_data
from railgrip.control.etcs.braked_weight import (
    build_up_times,
    deceleration_of,
    service_deceleration_of,
)
from railgrip.control.etcs.deceleration_field import NO_CAP
from railgrip.control.etcs.steps import Steps, combined, constant
from railgrip.core.errors import Problem
from railgrip.scenario.supervised_train import SupervisedTrain
from railgrip.scenario.supervision_values import Area, NationalValues, steps_of


def train_before(
    one: SupervisedTrain, national: NationalValues, target_speed: float, as_era_tool: bool = False
) -> train_data.SupervisedTrain:
    """Return the train as the supervision sees it before a target, national values included.

    Parameters
    ----------
    one, national : SupervisedTrain, NationalValues
        As the file says.
    target_speed : float
        Brakes of trains known by their braked weight build up later to speeds above 0, [m/s].
    as_era_tool : bool
        Service brake above 180 km/h as ERA's tool v3.0.
    """
    return train_data.SupervisedTrain(
        length=one.length, brakes=_brakes(one, national, target_speed, as_era_tool),
        rotating_mass=one.rotating_mass,
        commands_service_brake=one.service_brake_interface and national.service_brake,
        cuts_traction=one.traction_cut_off_interface,
        traction_cut_off_time=one.traction_cut_off_time, acceleration=one.acceleration,
        compensates_speed=national.compensate_speed,
    )  # fmt: skip


def track_under(
    one: SupervisedTrain, national: NationalValues, gradient: Steps, areas: Sequence[Area]
) -> train_data.Track:
    """Return gradient and reduced adhesion as they count for a train."""
    if not areas:
        return train_data.Track(gradient, NO_CAP)
    with_magnets, passenger, freight = national.reduced_adhesion
    cap = freight
    if one.position == "passenger P":
        cap = with_magnets if one.adhesion_independent_brake else passenger
    stretches = tuple((area.begin, area.end) for area in areas)
    return train_data.Track(gradient, train_data.reduced_adhesion(stretches, one.length, cap))


def emergency_of(one: SupervisedTrain) -> Steps:
    """Return A_brake_emergency over the speed, without any factor, [m/s²]."""
    if one.braked_weight is None:
        return steps_of(one.emergency)
    return deceleration_of(one.braked_weight)


def turned_areas(areas: Sequence[Area]) -> list[Problem]:
    """Return what is wrong with stretches of reduced adhesion."""
    return [
        Problem(f"reduced_adhesion[{i}].to", "must lie beyond 'from'",
                got=f"from {area.begin:g} m to {area.end:g} m")
        for i, area in enumerate(areas) if area.end <= area.begin
    ]  # fmt: skip


def missing_level(one: SupervisedTrain, national: NationalValues) -> list[Problem]:
    """Return the problem that Kdry is not given for the confidence level asked, if it is one."""
    levels = [row.confidence_level for row in one.kdry]
    if not levels or national.confidence_level in levels:
        return []
    return [Problem("train.kdry", "has no steps for national.confidence_level",
                    got=", ".join(map(str, levels)),
                    allowed=str(national.confidence_level))]  # fmt: skip


def _brakes(
    one: SupervisedTrain, national: NationalValues, target_speed: float, as_era_tool: bool
) -> train_data.Brakes:
    normal = steps_of(one.normal_service) if one.normal_service and national.guidance else None
    kn = [steps_of(steps) if steps else constant(0.0)
          for steps in (one.kn_uphill, one.kn_downhill)]  # fmt: skip
    emergency = emergency_of(one)
    if one.braked_weight is None:
        level = national.confidence_level
        dry = [steps_of(row.steps) for row in one.kdry if row.confidence_level == level]
        safe = train_data.safe_deceleration(
            emergency, dry[0] if dry else constant(1.0),
            steps_of(one.kwet) if one.kwet else constant(1.0), national.available_adhesion,
        )  # fmt: skip
        times = (one.emergency_time or 0.0, one.service_time or 0.0)
        return train_data.Brakes(safe, steps_of(one.service), *times, normal, *kn)
    service = service_deceleration_of(one.braked_weight, as_era_tool)
    safe = combined(lambda a, k: a * k, emergency, _kv(one, national, emergency))
    longer = [step.value for step in national.kr if one.length > step.begin]
    safe = safe.scaled(longer[-1] if longer else national.kr[0].value)
    times = build_up_times(one.position, one.length, target_speed)
    return train_data.Brakes(safe, service, national.kt * times[0], times[1], normal, *kn)


def _kv(one: SupervisedTrain, national: NationalValues, emergency: Steps) -> Steps:
    if one.position != "passenger P":
        return steps_of(national.kv_freight)
    begins = tuple(step.begin for step in national.kv_passenger)
    weak = Steps(begins, tuple(step.weak for step in national.kv_passenger))
    strong = Steps(begins, tuple(step.strong for step in national.kv_passenger))
    reached = [value for begin, value in zip(*emergency, strict=True)
               if begin <= one.top_speed]  # fmt: skip
    pivots = (national.a_nvp12, national.a_nvp23)
    return train_data.passenger_factor(weak, strong, max(reached), pivots)
