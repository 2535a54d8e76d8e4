"""An axle that others have outvoted stays so while the brake is on, and is forgiven afterwards."""

import numpy as np
import pytest

from railgrip.control import conventional_state as st
from railgrip.control.conventional_parameters import ConventionalParameters
from railgrip.control.lone_leader import OUTVOTED_AFTER, keep_dropped
from railgrip.control.state_layout import axle_base, state_size

PARAMETERS = np.array(ConventionalParameters())
DEAD_TIME = ConventionalParameters().dead_time
N_AXLES, DT = 3, 0.01


def outvoted(clock: float, reading: float = 20.0) -> tuple[np.ndarray, int]:
    """Return the state of a train whose second axle has led for so long, and its place."""
    state = np.zeros(state_size(N_AXLES))
    base = axle_base(1)
    state[base + st.LEAD_CLOCK] = clock
    state[base + st.CORRECTIONS] = 2.0
    state[base + st.READING] = reading
    return state, base


def test_it_is_not_believed_while_the_brake_is_on() -> None:
    state, base = outvoted(OUTVOTED_AFTER + 0.1)
    keep_dropped(PARAMETERS, state, N_AXLES, True, DT)
    assert state[base + st.IS_FAULTY] == 1.0
    assert state[base + st.DEAD_CLOCK] == DEAD_TIME
    assert state[base + st.LEAD_CLOCK] == pytest.approx(OUTVOTED_AFTER + 0.1 + DT)
    assert state[base + st.CORRECTIONS] == 2.0
    assert [state[axle_base(axle) + st.IS_FAULTY] for axle in (0, 2)] == [0.0, 0.0]


def test_one_that_has_led_for_a_short_time_only_is_still_believed() -> None:
    state, base = outvoted(OUTVOTED_AFTER - 0.1)
    keep_dropped(PARAMETERS, state, N_AXLES, True, DT)
    assert state[base + st.IS_FAULTY] == 0.0
    assert state[base + st.LEAD_CLOCK] == OUTVOTED_AFTER - 0.1


def test_a_released_brake_forgives() -> None:
    state, base = outvoted(OUTVOTED_AFTER + 0.1)
    keep_dropped(PARAMETERS, state, N_AXLES, False, DT)
    assert state[base + st.LEAD_CLOCK] == state[base + st.CORRECTIONS] == 0.0
    assert state[base + st.IS_FAULTY] == 0.0


@pytest.mark.parametrize("reading", [np.nan, 1e6])
def test_a_reading_that_is_none_changes_nothing(reading: float) -> None:
    state, base = outvoted(OUTVOTED_AFTER + 0.1, reading)
    for is_braking in (True, False):
        keep_dropped(PARAMETERS, state, N_AXLES, is_braking, DT)
    assert state[base + st.LEAD_CLOCK] == OUTVOTED_AFTER + 0.1
    assert state[base + st.CORRECTIONS] == 2.0
