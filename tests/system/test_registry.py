"""Plug-ins by name: every one that is registered can be had, and only those."""

from __future__ import annotations

from importlib.metadata import EntryPoint

import pytest

from railgrip.core import registry
from railgrip.core.errors import RailgripError


def test_names_are_sorted_and_hold_the_default_law() -> None:
    laws = registry.names("railgrip.laws")
    assert "polach_2005" in laws
    assert laws == sorted(laws)


@pytest.mark.parametrize(
    ("group", "name"),
    [(group, name) for group in registry.GROUPS for name in registry.names(group)],
)
def test_every_registered_plug_in_resolves(group: str, name: str) -> None:
    assert callable(registry.resolve(group, name))


def test_an_unknown_name_gets_the_nearest_one() -> None:
    with pytest.raises(RailgripError, match="did you mean 'polach_2005'") as caught:
        registry.resolve("railgrip.laws", "polach_2006", where="run.creep_law")
    assert str(caught.value).startswith("run.creep_law: law 'polach_2006' unknown; known: ")


def test_an_unknown_group_is_refused() -> None:
    with pytest.raises(RailgripError, match=r"did you mean 'railgrip\.laws'"):
        registry.names("railgrip.lawz")


def test_a_plug_in_that_cannot_be_imported_says_who_registered_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    broken = EntryPoint("gone", "no_such_package.wsp:WSP", "railgrip.controllers")
    monkeypatch.setattr(registry, "_entries", lambda group: {"gone": broken})
    with pytest.raises(RailgripError, match=r"no_such_package\.wsp:WSP.*cannot be loaded"):
        registry.resolve("railgrip.controllers", "gone")
