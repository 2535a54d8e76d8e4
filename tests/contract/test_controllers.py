"""Every registered controller and every example keeps the contract: what `railgrip check` asks."""

from pathlib import Path

import pytest

from railgrip.campaign.controller_check import check_controller
from railgrip.control.no_protection import NoProtection
from railgrip.core import registry

EXAMPLES = sorted((Path(__file__).parents[2] / "docs/examples/controllers").glob("*.py"))


def all_passed(results):
    failed = [f"{result.name}: {result.sentence}" for result in results if not result.passed]
    assert not failed, "\n".join(failed)
    assert results[-1].name == "compiled form"


@pytest.mark.parametrize("name", registry.names("railgrip.controllers"))
def test_registered_controller(name):
    all_passed(check_controller(registry.resolve("railgrip.controllers", name)))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_example(path):
    all_passed(check_controller(path))


def test_there_is_an_example_of_fifteen_lines():
    text = (EXAMPLES[0].parent / "my_wsp.py").read_text()
    body = text[text.index("    def reset") :]
    lines = [line for line in body.splitlines() if line.strip()]
    assert len(lines) <= 15


def test_no_protection_is_no_protection():
    """The contract is about protecting: a controller that never releases must fail it."""
    failed = {result.name for result in check_controller(NoProtection) if not result.passed}
    assert failed == {"locking axle"}
