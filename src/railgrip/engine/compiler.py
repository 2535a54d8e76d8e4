"""Plain Python laws and controllers, compiled as they stand.

A law is a plain scalar function; the engine compiles it and everything plain that it calls, so
that the law's file knows nothing of Numba and Python and kernel give the same bits.
The cache on disk is bound to the sources: Numba alone would not notice a changed law behind an
unchanged kernel.
"""

from __future__ import annotations

import hashlib
import os
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import llvmlite.binding as llvm
import numba as _numba
import platformdirs
from numba import types as nbt

import railgrip
from railgrip.contact.rail_friction import RailFriction

# Numba's own type hints lack options that we need.
numba: Any = _numba


def _source_hash() -> str:
    digest = hashlib.sha256(numba.__version__.encode())
    for path in sorted(Path(railgrip.__file__).parent.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _bind_cache() -> None:
    """Give the compiled kernels a folder of their own for exactly these sources."""
    if "NUMBA_CACHE_DIR" in os.environ:
        base = Path(os.environ["NUMBA_CACHE_DIR"])
    else:
        base = Path(platformdirs.user_cache_dir("railgrip")) / "kernels"
    numba.config.CACHE_DIR = str(base / _source_hash())


_bind_cache()


def _prefer_wide_vectors() -> None:
    """Let LLVM use 512-bit vectors where the processor has them; by itself it takes half."""
    features = llvm.get_host_cpu_features()
    if features.get("avx512f") and not numba.config.CPU_FEATURES:
        numba.config.CPU_NAME = llvm.get_host_cpu_name()
        numba.config.CPU_FEATURES = f"{features.flatten()},-prefer-256-bit"


_prefer_wide_vectors()

_compiled: dict[Callable[..., Any], Any] = {}


def _with_compiled_callees(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the function with every plain function that it names replaced by its compiled form."""
    code, known = function.__code__, function.__globals__
    plain = [name for name in code.co_names if isinstance(known.get(name), types.FunctionType)]
    if not plain:
        return function
    scope = {**known, **{name: inlined(known[name]) for name in plain}}
    bound = types.FunctionType(
        code, scope, function.__name__, function.__defaults__, function.__closure__
    )
    bound.__module__ = function.__module__
    bound.__qualname__ = function.__qualname__
    return bound


def _njit(function: Callable[..., Any], **options: Any) -> Any:
    """Compile reproducibly (no fastmath: no sum is reordered) and without reference counting.

    Nothing here allocates; counting references of the arrays that are passed down would cost
    more than the work.
    """
    return numba.njit(_with_compiled_callees(function), error_model="numpy", _nrt=False, **options)


def inlined(function: Callable[..., Any]) -> Any:
    """Return the compiled form of a plain function, to be inlined where it is called."""
    if function not in _compiled:
        _compiled[function] = _njit(function, forceinline=True)
    return _compiled[function]


def compiled(function: Callable[..., Any]) -> Any:
    """Return the compiled form of a plain function that stays a function of its own."""
    return _njit(function)


def entry(function: Callable[..., Any]) -> Any:
    """Return a kernel that Python calls: free of the interpreter lock, kept on disk."""
    return _njit(function, nogil=True, cache=True)


CONTROLLER_KERNEL = nbt.void(
    nbt.float64[::1], nbt.float64[:, ::1], nbt.float64[::1],
    nbt.float64[:, ::1], nbt.float64[:, ::1], nbt.float64,
)  # fmt: skip
"""Signature of a compiled controller: parameters, axle_setup, state, measured, command, dt."""
CONTROLLER_INITIAL = nbt.void(
    nbt.float64[::1], nbt.float64[:, ::1], nbt.float64[::1], nbt.float64[:, ::1]
)
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
        _first_class[function] = make(_with_compiled_callees(function))
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
