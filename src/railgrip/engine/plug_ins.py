"""What the kernel takes in from outside: controllers and creep laws as first-class functions."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numba import types as nbt

from railgrip.compiler import inlined, numba, with_compiled_callees
from railgrip.contact.rail_friction import RailFriction

FLAT, TABLE = nbt.float64[::1], nbt.float64[::1, :]
"""In a table the axles' values of one column lie side by side: loops over them become packed."""
CONTROLLER_KERNEL = nbt.void(FLAT, TABLE, FLAT, TABLE, TABLE, nbt.float64)
"""Signature of a compiled controller: parameters, axle_setup, state, measured, command, dt."""
CONTROLLER_INITIAL = nbt.void(FLAT, TABLE, FLAT, TABLE)
"""Signature of what fills a controller's state: parameters, axle_setup, state, measured."""
CREEP_LAW = nbt.float64(*[nbt.float64] * 9)
"""Signature of a creep law from outside: friction state (5), load, slope, slip speed, creepage."""

_first_class: dict[Callable[..., Any], Any] = {}


def first_class(function: Callable[..., Any], signature: Any) -> Any:
    """Compile a plain function to a first-class one: the kernel that calls it stays as it is."""
    if function not in _first_class:
        # the cache on disk is bound to our own sources, so only they may use it
        is_ours = function.__module__.startswith("railgrip.")
        make = numba.cfunc(signature, error_model="numpy", cache=is_ours, _nrt=False)
        _first_class[function] = make(with_compiled_callees(function))
    return _first_class[function]


def creep_law(law: Callable[..., float]) -> Any:
    """Compile somebody's creep law; it runs unpacked, lane by lane."""
    compiled = inlined(law)
    rail_friction = RailFriction

    def called(
        static: float, ratio: float, decay: float, adhesion: float, slip: float,
        load: float, slope: float, slip_speed: float, creepage: float,
    ) -> Any:  # fmt: skip
        rail = rail_friction(static, ratio, decay, adhesion, slip)
        return compiled(rail, load, slope, slip_speed, creepage)

    return numba.cfunc(CREEP_LAW, error_model="numpy")(called)
