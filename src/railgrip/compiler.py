"""Plain Python functions, compiled as they stand.

A law is a plain scalar function; it is compiled with everything plain that it calls, so that the
law's file knows nothing of Numba and Python and kernel give the same bits.
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
from numba.core.compiler import Compiler as _Compiler

import railgrip
from railgrip.intrinsics import FORMS

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


class _Apart(_Compiler):
    """Compiles a function whose arrays do not overlap, and tells LLVM so."""

    def define_pipelines(self) -> Any:
        """Set the flag that Numba has and no option of it sets."""
        self.state.flags.noalias = True
        return super().define_pipelines()  # type: ignore[no-untyped-call]


_compiled: dict[Callable[..., Any], Any] = dict(FORMS)


def with_compiled_callees(function: Callable[..., Any]) -> Callable[..., Any]:
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
    return numba.njit(with_compiled_callees(function), error_model="numpy", _nrt=False, **options)


def inlined(function: Callable[..., Any]) -> Any:
    """Return the compiled form of a plain function, to be inlined where it is called."""
    if function not in _compiled:
        _compiled[function] = _njit(function, forceinline=True)
    return _compiled[function]


def inlined_apart(function: Callable[..., Any]) -> Any:
    """Return the same of a function that reads one array at places found in the other.

    The caller promises that the arrays it passes do not overlap. LLVM cannot see it where places
    are computed, and would go lane by lane.
    """
    return _njit(function, forceinline=True, pipeline_class=_Apart)


def compiled(function: Callable[..., Any]) -> Any:
    """Return the compiled form of a plain function that stays a function of its own."""
    return _njit(function)


def entry(function: Callable[..., Any]) -> Any:
    """Return a kernel that Python calls: free of the interpreter lock, kept on disk."""
    return _njit(function, nogil=True, cache=True)
