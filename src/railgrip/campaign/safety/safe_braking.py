"""What the correction factors mean for a train: safe decelerations and stopping distances."""

from __future__ import annotations

from typing import Any

import numpy as np

from railgrip.campaign.rare.levels import EBCL
from railgrip.campaign.safety.factors import SafetyFactors


def safe_deceleration(found: SafetyFactors, level: int) -> list[float]:
    """Return A_brake_safe of each step at a level, m/s².

    Parameters
    ----------
    found : SafetyFactors
        From `safety_factors`.
    level : int
        EBCL, 0 … 9.

    Notes
    -----
    K_dry (K_wet + M_NVAVADH (1 − K_wet)) A_brake_emergency, at most A_NVMAXREDADH if it is given.
    """
    weight, cap = found.case.available_adhesion_weight, found.case.greatest_deceleration
    rows = []
    for step in found.steps:
        wet = step.wet.value if step.wet is not None else 1.0
        safe = step.dry.quantile[level].value * (wet + weight * (1.0 - wet))
        safe *= step.emergency_deceleration
        rows.append(min(safe, cap) if cap is not None else safe)
    return rows


def safe_distance(found: SafetyFactors, level: int) -> list[float]:
    """Return the stopping distance from each step's speed at a level, m.

    The nominal build-up time at full speed, then the safe decelerations of the steps below.
    """
    rows, braking, before = [], 0.0, 0.0
    for step, safe in zip(found.steps, safe_deceleration(found, level), strict=True):
        braking += (step.speed**2 - before**2) / (2.0 * safe) if safe > 0.0 else np.inf
        before = step.speed
        rows.append(step.speed * step.build_up_time + braking)
    return rows


def warnings(found: SafetyFactors) -> list[str]:
    """Return what a reader must know of the samples, each with its speed."""
    told = [
        f"{step.speed * 3.6:.4g} km/h: {one}" for step in found.steps for one in step.dry.warnings
    ]
    if found.without is not None:
        told += [f"without brake control, {one}" for one in warnings(found.without)]
    return told


def as_table(found: SafetyFactors) -> list[dict[str, Any]]:
    """Return one row for each step and level, SI; what JSON and CSV hold.

    With brake control, columns that begin with ``without_control_`` say the same without it.
    """
    rows = _rows(found)
    if found.without is not None:
        for row, bare in zip(rows, _rows(found.without), strict=True):
            row |= {f"without_control_{name}": bare[name] for name in list(bare)[2:]}
    return rows


def _rows(found: SafetyFactors) -> list[dict[str, Any]]:
    decelerations = [safe_deceleration(found, level) for level in EBCL]
    distances = [safe_distance(found, level) for level in EBCL]
    rows = []
    for number, step in enumerate(found.steps):
        for level in EBCL:
            k = step.dry.quantile[level]
            rows.append(
                {
                    "speed": step.speed,
                    "ebcl": level,
                    "k_dry": k.value,
                    "k_dry_low": k.low,
                    "k_dry_high": k.high,
                    "k_dry_low_simultaneous": k.low_all,
                    "k_dry_high_simultaneous": k.high_all,
                    "effective_runs": k.effective,
                    "k_wet": None if step.wet is None else step.wet.value,
                    "k_wet_low": None if step.wet is None else step.wet.low,
                    "k_wet_high": None if step.wet is None else step.wet.high,
                    "a_brake_emergency": step.emergency_deceleration,
                    "build_up_time": step.build_up_time,
                    "a_brake_safe": decelerations[level][number],
                    "stopping_distance_safe": distances[level][number],
                }
            )
    return rows
