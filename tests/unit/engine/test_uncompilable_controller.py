"""A kernel that cannot be compiled is refused with the reason, not with Numba's first line."""

import pytest

from railgrip.control import conventional_wsp
from railgrip.core.errors import RailgripError
from railgrip.engine.controllers import compiled


def asks_for_the_unknown(parameters, axle_setup, state, measured, command, dt):
    command[0, 0] = measured.no_such_thing


def test_the_reason_is_told() -> None:
    class Broken(conventional_wsp.ConventionalWSP):
        kernel = staticmethod(asks_for_the_unknown)

    with pytest.raises(RailgripError, match="cannot be compiled; got Unknown attribute 'no_such"):
        compiled(Broken(), 4)
