"""A scenario in a few lines, for people."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from railgrip.scenario.scenario import Scenario


def describe(scenario: Scenario) -> str:
    """Return what is run, one line a part.

    Examples
    --------
    >>> from railgrip.scenario import Scenario
    >>> print(describe(Scenario(train="emu_en14531", run={"speed": "100 km/h"})).splitlines()[-2])
    run    from 100 km/h, emergency at 0 s
    """
    parts = {
        "train": _train(scenario),
        "line": _line(scenario),
        "rail": _rail(scenario),
        "run": _run(scenario),
        "wsp": str(scenario.wsp),
    }
    parts |= {f"fault {i + 1}": str(fault) for i, fault in enumerate(scenario.fault)}
    title = [scenario.title] if scenario.title else []
    return "\n".join(title + [f"{word:6} {text}" for word, text in parts.items()])


def _train(scenario: Scenario) -> str:
    train = scenario.train
    return (
        f"{train.title or 'without a title'}: {len(train.vehicle)} vehicles, {train.n_axles} axles,"
        f" {train.length:g} m, {scenario.mass / 1e3:.1f} t"
    )


def _line(scenario: Scenario) -> str:
    line, start = scenario.line.use, scenario.line.start
    return f"{line.title or 'without a title'}: {line.length / 1e3:g} km, from {start:g} m"


def _rail(scenario: Scenario) -> str:
    rail = scenario.rail
    text = (
        f"{rail.condition.title or 'without a title'},"
        f" friction {rail.condition.contaminated.static_friction:g}"
    )
    if rail.patch:
        text += f", {len(rail.patch)} patches"
    return text + (", varying at random" if rail.random else "")


def _run(scenario: Scenario) -> str:
    words = [
        f"{'emergency' if point.emergency else f'demand {point.level:g}'} at {point.at:g} s"
        for point in scenario.run.demand
    ]
    if len(words) > 4:
        words = [*words[:3], f"and {len(words) - 3} more"]
    drive = [f"drive {point.level:g} at {point.at:g} s" for point in scenario.run.drive[:4]]
    return ", ".join([f"from {scenario.run.speed * 3.6:.4g} km/h", *words, *drive])
