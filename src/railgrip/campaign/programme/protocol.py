"""What a programme gave, as one table: the protocol's truth, from which every form is made."""

from __future__ import annotations

import hashlib
import inspect
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

import railgrip
from railgrip.campaign.programme.perform import Programme
from railgrip.campaign.programme.records import LimitRecord, RunRecord, TestRecord
from railgrip.campaign.programme.verdict import KEPT, MISSED, NOT_APPLICABLE, mean_interval
from railgrip.scenario import Scenario

NEAREST = 0.02
"""Share of the runs that are listed as nearest to a limit."""
FORM = 1
"""Number of the form of the table; another form is refused in comparisons."""

Table = dict[str, Any]


def protocol(programme: Programme, records: Sequence[TestRecord], profile_name: str) -> Table:
    """Return the protocol's table, the same for the same inputs.

    Parameters
    ----------
    programme : Programme
        As it ran.
    records : sequence of TestRecord
        What became of its tests.
    profile_name : str
        As the user called it.

    Returns
    -------
    dict
        ``identification``, ``train``, ``tests``, ``nearest``, ``summary``; plain values only,
        figures in the units that stand beside them.
    """
    tests = [_test(programme, record) for record in records]
    verdicts = [limit["verdict"] for test in tests for limit in test["limits"]]
    return {
        "form": FORM,
        "identification": {
            "railgrip": railgrip.__version__,
            "controller": programme.controller_name,
            "controller_hash": controller_hash(programme),
            "parameters": _parameters(programme.controller),
            "profile": profile_name,
            "profile_title": programme.profile.title,
            "profile_source": programme.profile.source,
            "profile_hash": _hash(programme.profile.model_dump_json(by_alias=True).encode()),
            "seed": programme.profile.seed,
            "repetitions": programme.profile.repetitions,
        },
        "train": _train(programme),
        "tests": tests,
        "nearest": _nearest(programme, records),
        "summary": {
            "tests": len(tests),
            "runs": sum(len(record.runs) for record in records),
            "invalid_runs": sum(len(one.runs) - len(one.valid) for one in records),
            "kept": verdicts.count(KEPT),
            "missed": verdicts.count(MISSED),
            "not_applicable": verdicts.count(NOT_APPLICABLE),
            "not_run": sum(bool(one.problem) and not one.valid for one in records),
            "incomplete": sum(bool(one.problem) and not _is_not_for(one) for one in records),
        },
    }


def controller_hash(programme: Programme) -> str:
    """Return a hash of the controller's sources: of its file, or of all that railgrip controls by.

    The parameters stand beside it in the protocol.
    """
    name = programme.controller_name
    if name.endswith(".py"):
        return _hash(Path(name).read_bytes())
    digest = hashlib.sha256()
    folder = Path(inspect.getfile(railgrip)).parent / "control"
    for path in sorted(folder.glob("*.py")):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:16]


def _parameters(controller: Any) -> dict[str, float]:
    given: Any = getattr(controller, "parameters", None)
    return dict(given._asdict()) if hasattr(given, "_asdict") else {}


def _train(programme: Programme) -> Table:
    scenario = Scenario.model_validate(programme.base)
    train = scenario.train
    return {
        "name": str(programme.train),
        "title": train.title,
        "source": train.source,
        "axles": train.n_axles,
        "mass_t": round(scenario.mass / 1e3, 3),
        "length_m": round(train.length, 2),
        "v_max_kmh": round(train.max_speed * 3.6, 1) if train.max_speed else None,
        "sensor_teeth": train.sensor.teeth,
        "valve_delays_ms": (
            [round(train.dump_valve.vent_delay * 1e3), round(train.dump_valve.fill_delay * 1e3)]
            if train.dump_valve
            else None
        ),
    }


def _test(programme: Programme, record: TestRecord) -> Table:
    test, scenario = record.test, record.scenario
    return {
        "name": record.name,
        "title": test.title,
        "title_de": test.title_de or test.title,
        "problem": record.problem,
        "is_for_this_train": not _is_not_for(record),
        "against": test.against,
        "speed_kmh": round(scenario.run.speed * 3.6, 1) if scenario else None,
        "rail": _rail(scenario),
        "faults": [str(fault) for fault in scenario.fault] if scenario else [],
        "wanted": test.repetitions or programme.profile.repetitions,
        "tried": len(record.runs),
        "valid_runs": len(record.valid),
        "validity": [
            {
                "metric": key,
                "label": programme.metrics[key].label,
                "label_de": programme.metrics[key].label_de,
                "least": window.least,
                "greatest": window.greatest,
                "source": window.source,
            }
            for key, window in test.valid.items()
        ],
        "limits": [_limit(record, one) for one in record.limits],
        "figures": [_figure(programme, record, key) for key in _shown(record)],
        "runs": [_run(programme, run) for run in record.runs],
    }


def _is_not_for(record: TestRecord) -> bool:
    return record.problem.startswith("does not apply")


def _rail(scenario: Scenario | None) -> str:
    if scenario is None:
        return ""
    rail = scenario.rail
    words = rail.condition.title or "as given"
    friction = rail.condition.contaminated.static_friction
    if rail.patch:
        titles = dict.fromkeys(patch.condition.title for patch in rail.patch)
        return f"{', '.join(titles)} in {len(rail.patch)} stretches"
    if rail.random is not None:
        field = rail.random
        return (
            f"{words}, random: friction {field.mean:g} ± {field.spread:g} over "
            f"{field.correlation_length:g} m"
        )
    return f"{words}, friction {friction:g}"


def _limit(record: TestRecord, one: LimitRecord) -> Table:
    unit, held = one.metric.unit, one.held
    worst = record.valid[held.worst].number if held.worst >= 0 else None
    return {
        "metric": one.metric.name,
        "label": one.metric.label,
        "label_de": one.metric.label_de,
        "unit": unit.spoken,
        "least": _spoken(one.bounds.least, unit.factor),
        "greatest": _spoken(one.bounds.greatest, unit.factor),
        "source": one.limit.source,
        "judged": one.limit.judged,
        "verdict": held.verdict,
        "value": _spoken(held.value, unit.factor),
        "margin": _spoken(held.margin, 1.0),
        "worst_run": worst,
        "sure": _spoken(held.share_least, 1.0),
    }


def _shown(record: TestRecord) -> list[str]:
    return list(dict.fromkeys([*record.test.valid, *record.test.limit, *record.test.report]))


def _figure(programme: Programme, record: TestRecord, key: str) -> Table:
    judge = programme.metrics[key]
    factor = judge.unit.factor
    values = record.figures(key) * factor if record.valid else np.empty(0)
    known = values[~np.isnan(values)]
    low, high = mean_interval(known)
    return {
        "metric": key,
        "label": judge.label,
        "label_de": judge.label_de,
        "unit": judge.unit.spoken,
        "mean": _spoken(float(known.mean()) if len(known) else math.nan, 1.0),
        "mean_low": _spoken(low, 1.0),
        "mean_high": _spoken(high, 1.0),
        "least": _spoken(float(known.min()) if len(known) else math.nan, 1.0),
        "greatest": _spoken(float(known.max()) if len(known) else math.nan, 1.0),
    }


def _run(programme: Programme, run: RunRecord) -> Table:
    factors = {key: programme.metrics[key].unit.factor for key in run.figures}
    return {
        "number": run.number,
        "seed": run.seed,
        "index": run.index,
        "status": run.status,
        "invalid": run.invalid,
        "margin": _spoken(run.margin, 1.0),
        "figures": {key: _spoken(value, factors[key]) for key, value in run.figures.items()},
        "curves": run.curves._asdict(),
    }


def _nearest(programme: Programme, records: Sequence[TestRecord]) -> list[Table]:
    """Return the runs nearest to a limit, on either side of it."""
    runs = [(abs(run.margin), record, run) for record in records for run in record.valid
            if not math.isnan(run.margin)]  # fmt: skip
    runs.sort(key=lambda item: item[0])
    total = sum(len(record.runs) for record in records)
    return [
        {
            "test": record.name,
            "number": run.number,
            "seed": run.seed,
            "index": run.index,
            "margin": _spoken(run.margin, 1.0),
        }
        for _, record, run in runs[: math.ceil(NEAREST * total)]
    ]


def _spoken(value: float | None, factor: float) -> float | str | None:
    """Return a figure as JSON can say it: six digits, 'infinite', or nothing."""
    if value is None or math.isnan(value):
        return None
    if math.isinf(value):
        return "infinite"
    return float(f"{value * factor:.6g}")
