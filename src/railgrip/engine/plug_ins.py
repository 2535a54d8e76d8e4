"""What the kernel takes in from outside: controllers and creep laws as first-class functions."""

from __future__ import annotations

import types
from collections.abc import Callable
from functools import cache
from typing import Any

from numba import types as nbt

from railgrip import intrinsics
from railgrip.compiler import inlined, numba, with_compiled_callees
from railgrip.contact.rail_friction import RailFriction
from railgrip.control import contract as ctl

FLAT, TABLE = nbt.float64[::1], nbt.float64[::1, :]
"""In a table the axles' values of one column lie side by side: loops over them become packed."""
PLACE: Any = nbt.CPointer(nbt.float64)  # type: ignore[no-untyped-call]
COUNT = nbt.int64
CONTROLLER_STEP = nbt.void(PLACE, COUNT, PLACE, PLACE, COUNT, PLACE, PLACE, COUNT, nbt.float64)
"""Signature of a compiled controller's step: see `call_step`."""
CONTROLLER_INITIAL = nbt.void(FLAT, TABLE, FLAT, TABLE)
"""Signature of what fills a controller's state: parameters, axle_setup, state, measured."""
CREEP_LAW = nbt.float64(*[nbt.float64] * 9)
"""Signature of a creep law from outside: friction state (5), load, slope, slip speed, creepage."""

# Numba adds the first argument, which its type hints do not know.
address: Any = intrinsics.address
table_at: Any = intrinsics.table_at
values_at: Any = intrinsics.values_at

_first_class: dict[Callable[..., Any], Any] = {}


def first_class(function: Callable[..., Any], signature: Any) -> Any:
    """Compile a plain function to a first-class one: the kernel that calls it stays as it is."""
    if function not in _first_class:
        # the cache on disk is bound to our own sources, so only they may use it
        is_ours = function.__module__.startswith("railgrip.")
        make = numba.cfunc(signature, error_model="numpy", cache=is_ours, _nrt=False)
        _first_class[function] = make(with_compiled_callees(function))
    return _first_class[function]


def _no_kernel(
    parameters: Any, axle_setup: Any, state: Any, measured: Any, command: Any, dt: float
) -> None:
    """Stand for the kernel in `_step`."""


def _step(
    parameters: Any, n_parameters: int, axle_setup: Any, state: Any, n_state: int,
    measured: Any, command: Any, n_axles: int, dt: float,
) -> None:  # fmt: skip
    _no_kernel(
        values_at(parameters, n_parameters),
        table_at(axle_setup, n_axles, ctl.N_SETUP),
        values_at(state, n_state),
        table_at(measured, n_axles, ctl.N_MEASURED),
        table_at(command, n_axles, ctl.N_COMMAND),
        dt,
    )


@cache
def controller_step(kernel: Callable[..., Any]) -> Callable[..., Any]:
    """Return the step of a controller as a plain function of addresses, for `CONTROLLER_STEP`.

    Five arrays with their lengths and strides are copied twice on their way through a function
    pointer, which costs the shortest controllers 5 % of their time.
    """
    scope = {**_step.__globals__, _no_kernel.__name__: kernel}
    step = types.FunctionType(_step.__code__, scope, kernel.__name__)
    step.__module__, step.__qualname__ = kernel.__module__, kernel.__qualname__
    return step


def call_step(
    step: Any, parameters: Any, axle_setup: Any, state: Any, measured: Any, command: Any, dt: float
) -> None:
    """Call a compiled step from within a kernel; arguments as in the controller contract."""
    step(
        address(parameters), parameters.size, address(axle_setup), address(state), state.size,
        address(measured), address(command), measured.shape[0], dt,
    )  # fmt: skip


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
