"""K_dry_rst and K_wet_rst that `railgrip campaign safety` found, for the ETCS supervision."""

from __future__ import annotations

import json
import math
import os
from pathlib import Path
from typing import Any, TypeVar

from pydantic import ValidationError

from railgrip.core.errors import Problem, RailgripError
from railgrip.scenario.explain import problems_of
from railgrip.scenario.journey_supervision import JourneySupervision
from railgrip.scenario.supervision import SupervisionCase

Case = TypeVar("Case", SupervisionCase, JourneySupervision)
NEEDED = ("speed", "ebcl", "k_dry_low", "a_brake_emergency", "build_up_time")


def with_factors(case: Case, path: str | os.PathLike[str]) -> Case:
    """Return a supervision with the brake that a safety case has shown.

    Parameters
    ----------
    case : SupervisionCase or JourneySupervision
        A gamma train; its emergency deceleration, build-up time, Kdry and Kwet are replaced.
    path : path
        ``factors.json`` of `railgrip campaign safety`.

    Raises
    ------
    RailgripError
        ``factors.json: is no table of railgrip campaign safety``; a level that is not resolved;
        what the supervision refuses.

    Notes
    -----
    Each speed step of the safety case holds from the step below upwards, the last one beyond too.
    Of each interval the lower end counts, and of the build-up times the longest.
    """
    rows = _rows(Path(path))
    open_levels = sorted({row["ebcl"] for row in rows if not _is_number(row["k_dry_low"])})
    wanted = case.national.confidence_level
    if wanted in open_levels:
        raise RailgripError(
            Problem(
                str(path), f"EBCL {wanted} is not resolved", cure="more runs of the safety case"
            )
        )
    levels = [level for level in sorted({row["ebcl"] for row in rows}) if level not in open_levels]
    has_wet = _is_number(rows[0].get("k_wet_low"))
    train = case.train.model_dump(by_alias=True) | {
        "emergency": _steps(rows, levels[0], "a_brake_emergency"),
        "emergency_time": max(row["build_up_time"] for row in rows),
        "kdry": [{"confidence_level": n, "steps": _steps(rows, n, "k_dry_low")} for n in levels],
        "kwet": _steps(rows, levels[0], "k_wet_low") if has_wet else [],
    }
    try:
        return type(case).model_validate({**case.model_dump(by_alias=True), "train": train})
    except ValidationError as error:
        raise RailgripError(problems_of(error, type(case))) from None


def _steps(rows: list[dict[str, Any]], level: int, name: str) -> list[dict[str, float]]:
    """Return a column as steps over the speed."""
    speeds = sorted({row["speed"] for row in rows})
    begins = dict(zip(speeds, [0.0, *speeds[:-1]], strict=True))
    return [
        {"from": begins[row["speed"]], "value": row[name]}
        for row in sorted(rows, key=lambda row: float(row["speed"]))
        if row["ebcl"] == level
    ]


def _rows(path: Path) -> list[dict[str, Any]]:
    what, cure = "is no table of railgrip campaign safety", "its factors.json"
    try:
        rows = json.loads(path.read_text(encoding="utf-8"))["rows"]
        assert rows
        assert all(name in row for row in rows for name in NEEDED)
    except OSError as error:
        raise RailgripError(Problem(str(path), "cannot be read", str(error.strerror))) from None
    except (ValueError, KeyError, TypeError, AssertionError):
        raise RailgripError(Problem(str(path), what, cure=cure)) from None
    return list(rows)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and math.isfinite(value)
