"""The physics step of sixteen lanes is packed arithmetic: an edit could lose that in silence.

Divisions are what to count: every pass over the lanes has some, and they are dear. Within the loop
over the axles none may be scalar. Each built-in creep law is compiled alone, since the step for
somebody's own law calls it lane by lane.
"""

from __future__ import annotations

import platform
import re
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numba import types

from railgrip.compiler import inlined
from railgrip.engine import kernel
from railgrip.engine import layout as at
from railgrip.engine.creep_laws import LAWS
from railgrip.engine.offsets import SIXTEEN_LANES, width
from railgrip.engine.plan import CreepTables
from railgrip.engine.plug_ins import CREEP_LAW, first_class

CODES = {**LAWS, "table of one curve": at.LAW_TABLE, "table of several": at.LAW_GRID}

pytestmark = pytest.mark.skipif(
    platform.machine().lower() not in ("x86_64", "amd64"),
    reason="instruction names of x86 are looked for",
)


def nothing(
    a: float, b: float, c: float, d: float, e: float, f: float, g: float, h: float, i: float
) -> float:
    """Stand in for a creep law from outside."""
    return 0.0


class Loop(NamedTuple):
    """A loop that lies in no other: its packed and scalar divisions, and whether it holds loops."""

    packed: int
    scalar: int
    is_nest: bool


def loops(asm: str) -> list[Loop]:
    """Find the outermost loops: from a label to the jump back to it."""
    lines = asm.splitlines()
    labels = {line.split(":")[0]: i for i, line in enumerate(lines) if re.match(r"\.L\w+:", line)}
    jumps = ((i, re.match(r"\s+j\w+\s+(\.L\w+)", line)) for i, line in enumerate(lines))
    spans = [(labels[jump[1]], i) for i, jump in jumps if jump and labels.get(jump[1], i) < i]

    def within(span: tuple[int, int], other: tuple[int, int]) -> bool:
        return other != span and other[0] <= span[0] and span[1] <= other[1]

    found = []
    for span in spans:
        if any(within(span, other) for other in spans):
            continue
        text = "\n".join(lines[slice(*span)])
        packed = len(re.findall(r"^\s+v?divpd\s", text, re.MULTILINE))
        scalar = len(re.findall(r"^\s+v?divsd\s", text, re.MULTILINE))
        # a comparison that heeds NaN jumps twice to one label: that is one loop
        inner = [other for other in spans if within(other, span) and other[0] != span[0]]
        found.append(Loop(packed, scalar, bool(inner)))
    return found


def assert_packed(asm: str) -> None:
    """No loop over axles divides lane by lane.

    A pass over the train's own lanes may come twice, packed and, should blocks overlap, scalar:
    short loops by themselves, or both between one label and the jump back to it.
    """
    found = [loop for loop in loops(asm) if loop.packed or loop.scalar]
    assert sum(loop.packed for loop in found) >= 20, found
    for loop in found:
        if loop.scalar:
            assert not loop.is_nest, found
            assert loop.scalar <= 4, found
            assert loop.packed <= 4, found


def assembly(function: Any, *signature: Any) -> str:
    compiled = numba.njit(error_model="numpy", _nrt=False)(function)
    compiled.compile((types.float64[::1], types.uint64, *signature))
    return str(compiled.inspect_asm(compiled.signatures[0]))


@pytest.fixture(scope="module")
def step() -> Any:
    return inlined(kernel.step_lanes.py_func)


@pytest.fixture(scope="module")
def custom_type() -> Any:
    return numba.typeof(first_class(nothing, CREEP_LAW))


@pytest.fixture(scope="module")
def tables_type() -> Any:
    return numba.typeof(CreepTables(np.zeros((4, 2, 8)), np.zeros((4, 5)), 0.0))


@pytest.mark.parametrize("law", CODES)
def test_no_scalar_division_in_the_step_of_a_law(
    step: Any, tables_type: Any, custom_type: Any, law: str
) -> None:
    code = CODES[law]

    def one_law(S: Any, n_axles: Any, tables: Any, custom: Any, h: float) -> None:
        step(S, n_axles, code, tables, custom, h)

    asm = assembly(one_law, tables_type, custom_type, types.float64)
    assert_packed(asm)
    # places in a table are found several at a time, too
    assert not re.search(r"^\s+v?cvttsd2si\s", asm, re.MULTILINE)


def test_the_search_notices_a_loop_that_is_not_packed() -> None:
    """A lane that depends on the one before cannot be packed; the same without it can."""

    def chained(S: Any, n: Any) -> None:
        L = width(SIXTEEN_LANES)
        for axle in range(np.uint64(1), n):
            b, front = axle * L, (axle - np.uint64(1)) * L
            for k in range(L):
                S[b + k] = S[b + k] / (1.0 + S[b + k - np.uint64(1)])
                S[b + k] += S[front + k] / 3.0

    assert any(loop.scalar for loop in loops(assembly(chained)))
    with pytest.raises(AssertionError):
        assert_packed(assembly(chained))
