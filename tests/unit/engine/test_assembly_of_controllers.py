"""The controllers' passes over the axles are packed arithmetic: an edit could lose that in silence.

What is counted are packed comparisons: a pass that branches has none. Stores to computed places
(scatters) appear where branches on like conditions have been merged, and cost as much as the pass.
"""

from __future__ import annotations

import platform
import re

import pytest
from numba import types

from railgrip.compiler import numba, with_compiled_callees
from railgrip.control.adaptive_forces import weigh_axles
from railgrip.control.axle_protection import protect_axles
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.temperature_axle import brake_axles
from railgrip.core.formulas.choosing import choose
from railgrip.engine.plug_ins import FLAT, TABLE

pytestmark = pytest.mark.skipif(
    platform.machine().lower() not in ("x86_64", "amd64"),
    reason="instruction names of x86 are looked for",
)

NUMBER, COUNT = types.float64, types.int64
KERNEL = types.void(FLAT, TABLE, FLAT, TABLE, TABLE, NUMBER)
PASSES = {
    "look at the wheels and protect": (ConventionalWSP.kernel, KERNEL),
    "protect": (protect_axles, types.void(FLAT, FLAT, TABLE, NUMBER)),
    "weigh": (weigh_axles, types.void(FLAT, FLAT, COUNT, NUMBER)),
    "temperature": (brake_axles, types.void(FLAT, FLAT, TABLE, NUMBER, NUMBER)),
}
LEAST = {"look at the wheels and protect": 40, "protect": 24, "weigh": 6, "temperature": 22}
"""Packed comparisons of each: about two thirds of what there are."""


def packed_comparisons(function: object, signature: object) -> int:
    return len(re.findall(r"^\s+v?cmp\w*pd\s", assembly(function, signature), re.MULTILINE))


def assembly(function: object, signature: object) -> str:
    made = numba.cfunc(signature, error_model="numpy", _nrt=False)
    return str(made(with_compiled_callees(function))._library.get_asm_str())


@pytest.mark.parametrize("name", PASSES)
def test_a_pass_over_the_axles_compares_several_at_a_time(name: str) -> None:
    assert packed_comparisons(*PASSES[name]) >= LEAST[name]


@pytest.mark.parametrize("name", PASSES)
def test_a_pass_stores_nothing_to_computed_places(name: str) -> None:
    assert "scatter" not in assembly(*PASSES[name])


def test_a_choice_is_one_selection() -> None:
    def chosen(state: object) -> None:
        is_small = (state[0] < 1.0) & (state[1] < 1.0)  # type: ignore[index]
        state[2] = choose(is_small, state[0], state[1])  # type: ignore[index]

    signature = types.void(FLAT)
    made = numba.cfunc(signature, error_model="numpy", _nrt=False)
    ir = made(with_compiled_callees(chosen))._library.get_llvm_str()
    body = ir[ir.index("define") :].partition("\n}")[0]
    assert " select " in body
    assert " br i1 " not in body


def test_a_loop_that_is_left_early_has_none() -> None:
    def branching(state: object, n_axles: int) -> None:
        for axle in range(n_axles):
            if state[axle] > 0.0:  # type: ignore[index]
                return

    assert packed_comparisons(branching, types.void(FLAT, COUNT)) == 0
