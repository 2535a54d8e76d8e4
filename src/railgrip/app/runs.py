"""Several runs of one command: which scenarios, and their results by name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from railgrip.app.inputs import Named
from railgrip.app.screen import working

if TYPE_CHECKING:
    from railgrip.engine.result import Result


def variants(named: list[Named], controllers: list[str]) -> list[Named]:
    """Return each scenario, once for every controller if there are any."""
    if not controllers:
        return named
    found = []
    for name, scenario in named:
        for word in controllers:
            label = Path(word).stem if len(named) == 1 else f"{name}, {Path(word).stem}"
            place = str(Path(word).resolve()) if word.endswith(".py") else word
            found.append(Named(label, scenario.with_({"wsp.controller": place})))
    return found


def simulate_all(named: list[Named]) -> dict[str, Result]:
    """Run every scenario; return the results by name, in order.

    Runs of one seed have one random rail, whatever protects the wheels on it.
    """
    import railgrip

    runs: dict[str, Result] = {}
    for number, (name, scenario) in enumerate(named, 1):
        with working(f"braking {number} of {len(named)}: {name}"):
            label = name if name not in runs else f"{name} ({number})"
            runs[label] = railgrip.simulate(scenario)
    return runs
