"""What moves sixteen axles at one blow does, compiled, to the bit what it does in Python."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numba.core.errors import TypingError

from railgrip.compiler import entry
from railgrip.control.side_by_side import (
    count_above,
    count_equal,
    give,
    give_all,
    greatest,
    move,
    take,
    total,
)
from railgrip.control.state_layout import GROUP

COLUMNS = 3


def columns_there_and_back(state: Any, table: Any, other: Any) -> None:
    for group in range((table.shape[0] + 15) // 16):
        take(state, 16 * group, table, 16 * group, 1)
        give(other, 16 * group, 2, state, 16 * group)
        give_all(other, 16 * group, 0, state[16 * group])


def numbers(state: Any, found: Any) -> None:
    found[0] = total(state, 5)
    found[1] = greatest(state, 5)
    found[2] = count_equal(state, 5, state[7])
    found[3] = count_above(state, 5, 0.0, 22)
    move(state, 30, 5)


@pytest.mark.parametrize("n_axles", [2, 7, 8, 15, 16, 17, 33])
def test_columns_go_there_and_back_and_no_further(n_axles: int) -> None:
    random = np.random.default_rng(n_axles)
    table = np.asfortranarray(random.normal(size=(n_axles, COLUMNS)))
    found = []
    for function in (columns_there_and_back, entry(columns_there_and_back)):
        # one more column behind the table tells whether anything was written there
        room = np.full((n_axles, COLUMNS + 1), 7.0, order="F")
        state = np.full(GROUP * 3 + 1, 9.0)
        function(state, table, room[:, :COLUMNS])
        places = GROUP * -(-n_axles // GROUP)
        np.testing.assert_array_equal(state[:n_axles], table[:, 1])
        assert not state[n_axles:places].any()
        assert (state[places:] == 9.0).all()
        np.testing.assert_array_equal(room[:, 2], table[:, 1])
        np.testing.assert_array_equal(room[:, 0], np.repeat(table[::16, 1], 16)[:n_axles])
        assert (room[:, [1, 3]] == 7.0).all()
        found.append((state, room))
    np.testing.assert_array_equal(found[0][0], found[1][0])


@pytest.mark.parametrize("seed", range(20))
def test_sums_and_counts_have_the_same_bits(seed: int) -> None:
    random = np.random.default_rng(seed)
    values = random.normal(size=60) * 10.0 ** random.integers(-8, 8, size=60)
    values[8] = values[7]
    values[22:30] = 0.0
    found = []
    for function in (numbers, entry(numbers)):
        state, result = values.copy(), np.zeros(4)
        function(state, result)
        found.append(np.concatenate([result, state]))
    assert found[0].tobytes() == found[1].tobytes()
    assert found[0][0] == pytest.approx(values[5:21].sum(), abs=1e-9 * abs(values).max())
    assert found[0][1] == values[5:21].max()
    assert found[0][2] == 2
    assert found[0][3] == (values[5:13] > 0.0).sum()


def test_a_table_that_lies_row_by_row_is_refused() -> None:
    table = np.zeros((4, COLUMNS))
    with pytest.raises(TypingError, match="a table must lie column by column"):
        entry(columns_there_and_back)(np.zeros(GROUP), table, table)
