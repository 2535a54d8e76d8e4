"""Every example in a docstring prints what it says it prints."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest

import railgrip

MODULES = [
    module.name
    for module in pkgutil.walk_packages(railgrip.__path__, "railgrip.")
    if not module.name.endswith("__main__")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings(name: str) -> None:
    module = importlib.import_module(name)
    failed, _ = doctest.testmod(module, optionflags=doctest.IGNORE_EXCEPTION_DETAIL)
    assert failed == 0


def test_most_formulas_have_an_example() -> None:
    finder = doctest.DocTestFinder(exclude_empty=True)
    with_examples = [
        name
        for name in MODULES
        if any(test.examples for test in finder.find(importlib.import_module(name)))
    ]
    assert len(with_examples) > 20
