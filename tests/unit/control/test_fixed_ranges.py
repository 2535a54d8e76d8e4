"""Fixed strategies: who is held in which range, and that macro-slip is the conventional WSP."""

import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control.contract_signals import bench_setup, drive, faults, locking
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.fixed_ranges import (
    ALTERNATING,
    FRONT_MACRO,
    REAR_MACRO,
    FixedParameters,
    FixedRanges,
    MacroSlip,
    MicroSlip,
    MixedSlip,
)
from railgrip.core.errors import RailgripError


def ranges(controller, n_axles):
    state = controller.reset(bench_setup(n_axles, 0.01))
    still = ctl.Measured(np.full(n_axles, 30.0), np.zeros(n_axles), np.zeros(n_axles), 0.0, 0.0)
    return controller.step(state, still, 0.01).slip_range.tolist()


@pytest.mark.parametrize("signals", [locking(4, 0.01, 6.0), faults(4, 0.01)])
def test_macro_slip_commands_what_the_conventional_commands(signals):
    for ours, theirs in zip(
        drive(MacroSlip(), signals), drive(ConventionalWSP(), signals), strict=True
    ):
        assert np.array_equal(ours, theirs)


def test_micro_slip_commands_what_the_conventional_commands_in_its_micro_band():
    signals = locking(4, 0.01, 6.0)
    one, other = drive(MicroSlip(), signals), drive(ConventionalWSP(band="micro"), signals)
    assert all(np.array_equal(*pair) for pair in zip(one, other, strict=True))


@pytest.mark.parametrize(
    ("arrangement", "expected"),
    [
        (ALTERNATING, [2.0, 1.0, 2.0, 1.0, 2.0]),
        (FRONT_MACRO, [2.0, 2.0, 2.0, 1.0, 1.0]),
        (REAR_MACRO, [1.0, 1.0, 1.0, 2.0, 2.0]),
    ],
)
def test_half_and_half(arrangement, expected):
    assert ranges(MixedSlip(FixedParameters(arrangement=arrangement)), 5) == expected


def test_the_two_pure_ones():
    assert ranges(MacroSlip(), 3) == [ctl.MACRO] * 3
    assert ranges(MicroSlip(), 3) == [ctl.MICRO] * 3
    assert ranges(MixedSlip(), 2) == [ctl.MACRO, ctl.MICRO]


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"arrangement": 7.0}, "arrangement.*0, 1, 2, 3, 4"),
        ({"micro_lower": 0.03}, "micro_lower"),
        ({"slip_upper": 0.05}, "slip_lower"),
    ],
)
def test_wrong_parameters_are_refused(wrong, words):
    with pytest.raises(RailgripError, match=words):
        FixedRanges(FixedParameters(**wrong))
