"""Passes go over whole groups of sixteen: the places behind the last axle must count nowhere."""

import numpy as np
import pytest

from railgrip.control import contract as ctl
from railgrip.control import conventional_state as st
from railgrip.control.contract_signals import bench_setup
from railgrip.control.faulty_axle import count_faulty
from railgrip.control.state_layout import axle_base, n_places
from railgrip.control.train_observer import look_at_wheels
from railgrip.core import registry

NAMES = registry.names("railgrip.controllers")


@pytest.mark.parametrize("name", NAMES)
def test_an_empty_place_never_becomes_a_believed_wheel(name: str) -> None:
    """A slide, a stop and a stand: the places behind the axles stay what they are."""
    controller = registry.resolve("railgrip.controllers", name)()
    n_axles = 6
    setup = ctl.setup_array(bench_setup(n_axles, 0.01))
    state = np.zeros(controller.state_size(n_axles))
    measured, command = np.zeros((n_axles, ctl.N_MEASURED)), ctl.command_array(n_axles)
    parameters = np.array(tuple(controller.parameters))
    measured[:, ctl.WHEEL_SPEED] = 20.0
    controller.initial(parameters, setup, state, measured)
    for step in range(300):
        measured[:, ctl.WHEEL_SPEED] = max(20.0 - 0.1 * step, 0.0) * np.linspace(0.7, 1.0, n_axles)
        measured[:, ctl.CYLINDER_PRESSURE] = 2e5 if step < 250 else 0.0
        measured[:, ctl.BRAKE_DEMAND] = 1.0 if step < 250 else 0.0
        controller.kernel(parameters, setup, state, measured, command, 0.01)
    places = [axle_base(place) for place in range(n_axles, n_places(n_axles))]
    assert all(state[base + st.IS_FAULTY] == 1.0 for base in places)
    assert all(state[base + st.COUNTED_SPEED] == 0.0 for base in places)
    assert np.isfinite(state).all()
    assert count_faulty(state, n_axles) <= n_axles


def test_what_six_axles_show_is_the_mean_of_six() -> None:
    controller = registry.resolve("railgrip.controllers", "conventional")()
    parameters = np.array(tuple(controller.parameters))
    setup = ctl.setup_array(bench_setup(6, 0.01))
    state, measured = np.zeros(controller.state_size(6)), np.zeros((6, ctl.N_MEASURED))
    measured[:, ctl.WHEEL_SPEED] = 20.0
    measured[:, ctl.CYLINDER_PRESSURE] = 1e5 * np.arange(1, 7)
    controller.initial(parameters, setup, state, measured)
    wheels = look_at_wheels(parameters, state, measured, 0.01, 0.01)
    assert wheels.effort == pytest.approx(3.5e5)
    assert wheels.fastest == 20.0
