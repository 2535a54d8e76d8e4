"""The two forms of the contract say the same."""

import numpy as np

from railgrip.control import contract as ctl
from railgrip.control.conventional_wsp import ConventionalWSP
from railgrip.control.no_protection import NoProtection


def test_columns_are_a_complete_numbering():
    measured = {
        ctl.WHEEL_SPEED, ctl.CYLINDER_PRESSURE, ctl.DYNAMIC_FORCE, ctl.BRAKE_DEMAND, ctl.EMERGENCY,
        ctl.DRIVE_DEMAND,
    }  # fmt: skip
    command = {
        ctl.DUMP_VALVE, ctl.DYNAMIC_SHARE, ctl.SANDING, ctl.REFERENCE_SPEED, ctl.IS_SLIDING,
        ctl.ALARM, ctl.SLIP_RANGE, ctl.WSP_STATE, ctl.FRICTION_SHARE,
    }  # fmt: skip
    assert measured == set(range(ctl.N_MEASURED))
    assert command == set(range(ctl.N_COMMAND))
    setup = {
        ctl.BELIEVED_RADIUS, ctl.MOTORED, ctl.BRAKED, ctl.AXLE_LOAD, ctl.ROTATING_MASS,
        ctl.FULL_FORCE, ctl.FULL_PRESSURE, ctl.FIRST_PRESSURE, ctl.CONTINUOUS, ctl.BRAKING_EFFORT,
        ctl.BRAKING_POWER, ctl.TRACTIVE_EFFORT, ctl.TRACTIVE_POWER, ctl.BOGIE, ctl.VEHICLE,
    }  # fmt: skip
    assert setup == set(range(ctl.N_SETUP))


def test_setup_and_measured_reach_their_columns():
    setup = ctl.Setup(
        2, 0.01, np.array([0.46, 0.45]), np.array([True, False]), np.array([False, True])
    )
    columns = ctl.setup_array(setup)
    known, places = ctl.ROTATING_MASS, ctl.BOGIE
    assert columns[:, :known].tolist() == [[0.46, 1.0, 0.0, 1.0], [0.45, 0.0, 1.0, 1.0]]
    assert not columns[:, known:places].any()
    axles = ctl.AxleData(*(np.full(2, 10.0 + i) for i in range(len(ctl.AxleData._fields))))
    told = ctl.setup_array(setup._replace(axles=axles))
    assert told[1, known:places].tolist() == list(range(10, 19))
    coaches = setup._replace(bogie=np.array([0, 1]), vehicle=np.array([3, 4]))
    assert ctl.setup_array(coaches)[:, places:].tolist() == [[0.0, 3.0], [1.0, 4.0]]
    weighed = setup._replace(axle_load=np.array([1e5, 2e5]))
    assert ctl.setup_array(weighed)[:, ctl.AXLE_LOAD].tolist() == [1e5, 2e5]
    measured = ctl.Measured(
        np.array([20.0, 19.0]), np.array([1e5, 2e5]), np.zeros(2), 0.5, 1.0, 0.7
    )
    assert ctl.measured_array(measured)[1].tolist() == [19.0, 2e5, 0.0, 0.5, 1.0, 0.7]


def test_command_from_array_is_a_copy():
    array = ctl.command_array(3)
    command = ctl.command_from_array(array)
    array[:, ctl.DUMP_VALVE] = ctl.VENT
    assert command.dump_valve.tolist() == [0.0, 0.0, 0.0]
    assert command.dynamic_share.tolist() == [1.0, 1.0, 1.0]


def test_shipped_controllers_have_the_shape_of_the_contract():
    for controller in (ConventionalWSP(), NoProtection()):
        assert isinstance(controller, ctl.CompiledController)
