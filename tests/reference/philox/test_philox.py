"""Philox4x32-10 gives the words that its authors published."""

from __future__ import annotations

import numba
import pytest

from railgrip.compiler import inlined
from railgrip.track.random_field import philox_4x32

VECTORS = [
    ("00000000" * 6, "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
    ("ffffffff" * 6, "408f276d 41c83b0e a20bc7c6 6d5451fd"),
    (
        "243f6a88 85a308d3 13198a2e 03707344 a4093822 299f31d0",
        "d16cfe09 94fdcceb 5001e420 24126ea1",
    ),
]


def words(text: str) -> tuple[int, ...]:
    digits = text.replace(" ", "")
    return tuple(int(digits[i : i + 8], 16) for i in range(0, len(digits), 8))


@pytest.mark.parametrize(("given", "expected"), VECTORS, ids=["zeros", "ones", "pi"])
def test_known_answers(given: str, expected: str) -> None:
    assert philox_4x32(*words(given)) == words(expected)


@pytest.mark.parametrize(("given", "expected"), VECTORS, ids=["zeros", "ones", "pi"])
def test_known_answers_of_the_compiled_form(given: str, expected: str) -> None:
    """64-bit integers of the machine wrap where Python's grow: the masks must hold."""
    compiled = inlined(philox_4x32)
    driver = numba.njit(lambda a, b, c, d, e, f: compiled(a, b, c, d, e, f))
    assert tuple(int(word) for word in driver(*words(given))) == words(expected)
