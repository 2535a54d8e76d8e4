"""railgrip: what happens between wheel and rail when a train brakes and drives.

``import railgrip as rg``; then ``rg.load("leaves_160")`` describes, ``rg.simulate(scenario)``
works, its `Result` remembers, ``rg.compare([...])`` lays scenarios side by side.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

__version__ = "0.1.0"

_FACADE = {
    "load": "railgrip.io.toml_file",
    "Scenario": "railgrip.scenario.scenario",
    "simulate": "railgrip.engine.simulate",
    "Result": "railgrip.engine.result",
    "compare": "railgrip.report.comparison",
    "RailgripError": "railgrip.core.errors",
}

__all__ = ["RailgripError", "Result", "Scenario", "__version__", "compare", "load", "simulate"]


def __getattr__(name: str) -> Any:
    """Import what is asked for only now: `railgrip --help` must not wait for a compiler."""
    if name in _FACADE:
        return getattr(import_module(_FACADE[name]), name)
    raise AttributeError(f"module 'railgrip' has no attribute '{name}'")
