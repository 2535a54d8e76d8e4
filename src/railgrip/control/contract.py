"""What a controller is: what it is told, what it measures, what it commands.

A controller comes in two forms with one meaning.

*Plain form*: any Python class with ``period``, ``reset(setup) -> state`` and
``step(state, measured, dt) -> Command``. The engine calls it once every period.

*Compiled form*: the same class also carries plain functions on flat arrays, which the engine
compiles (see `CompiledController`). Numbers then travel in the columns named below, one row an
axle, so that a kernel reads ``measured[axle, WHEEL_SPEED]`` and never a bare index.

A controller sits in the cab: it sees measured signals only, never the train's true speed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final, NamedTuple, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

Kernel = Callable[[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray, float], None]
"""``kernel(parameters, axle_setup, state, measured, command, dt)``; writes state and command."""

Initial = Callable[[FloatArray, FloatArray, FloatArray, FloatArray], None]
"""``initial(parameters, axle_setup, state, measured)``; writes the state, zero before it."""

# Codes of the dump valve.
FILL: Final = 0.0
HOLD: Final = 1.0
VENT: Final = 2.0

# Codes of the slip range that an axle is held in; 0 where a controller has no ranges.
MICRO: Final = 1.0
MIDDLE: Final = 1.5
MACRO: Final = 2.0

# Columns of measured[axle, column].
WHEEL_SPEED: Final = 0
CYLINDER_PRESSURE: Final = 1
DYNAMIC_FORCE: Final = 2
BRAKE_DEMAND: Final = 3
EMERGENCY: Final = 4
DRIVE_DEMAND: Final = 5
N_MEASURED: Final = 6

# Columns of axle_setup[axle, column].
BELIEVED_RADIUS: Final = 0
MOTORED: Final = 1
BRAKED: Final = 2
AXLE_LOAD: Final = 3
ROTATING_MASS: Final = 4
FULL_FORCE: Final = 5
FULL_PRESSURE: Final = 6
FIRST_PRESSURE: Final = 7
CONTINUOUS: Final = 8
BRAKING_EFFORT: Final = 9
BRAKING_POWER: Final = 10
TRACTIVE_EFFORT: Final = 11
TRACTIVE_POWER: Final = 12
BOGIE: Final = 13
VEHICLE: Final = 14
N_SETUP: Final = 15

# Columns of command[axle, column]; the content of the last call is still there in the next.
DUMP_VALVE: Final = 0
DYNAMIC_SHARE: Final = 1
SANDING: Final = 2
REFERENCE_SPEED: Final = 3
IS_SLIDING: Final = 4
ALARM: Final = 5
SLIP_RANGE: Final = 6
WSP_STATE: Final = 7
FRICTION_SHARE: Final = 8
N_COMMAND: Final = 9


class AxleData(NamedTuple):
    """What a vehicle knows of its axles and brakes, for controllers that reckon in forces.

    Parameters
    ----------
    rotating_mass : ndarray (axle)
        Rotating mass reduced to the tread, [kg].
    full_force, full_pressure, first_pressure : ndarray (axle)
        Nominal friction brake force at the tread at full demand [N], the cylinder pressure that
        gives it, and the one at which the force begins, [Pa]; 0 without a friction brake.
    continuous : ndarray of bool (axle)
        Whether the friction brake follows `Command.friction_share`.
    braking_effort, braking_power, tractive_effort, tractive_power : ndarray (axle)
        Greatest force [N] and power [W] at the tread of the axle's motor, braking and driving.
    """

    rotating_mass: FloatArray
    full_force: FloatArray
    full_pressure: FloatArray
    first_pressure: FloatArray
    continuous: NDArray[np.bool_]
    braking_effort: FloatArray
    braking_power: FloatArray
    tractive_effort: FloatArray
    tractive_power: FloatArray


class Setup(NamedTuple):
    """What a controller is told once, before the first step.

    Parameters
    ----------
    n_axles : int
        Number of axles, counted from the front of the train.
    period : float
        Time between two calls of ``step``, [s].
    wheel_radius : ndarray (axle)
        Rolling radius as the controller believes it, [m]; the wheel may be worn.
    motored, braked : ndarray of bool (axle)
        Whether the axle has a motor (dynamic brake or traction), whether it has a friction brake
        that a controller can release (a dump valve, or an electro-mechanical brake).
    axle_load : ndarray (axle), optional
        Load of the axle as the vehicle weighs it, [N].
    axles : AxleData, optional
        More of its axles, where the vehicle knows it.
    bogie, vehicle : ndarray (axle), optional
        Number of the axle's bogie and vehicle, each counted from the front of the train; absent:
        two axles a bogie, two bogies a vehicle.
    """

    n_axles: int
    period: float
    wheel_radius: FloatArray
    motored: NDArray[np.bool_]
    braked: NDArray[np.bool_]
    axle_load: FloatArray | None = None
    axles: AxleData | None = None
    bogie: FloatArray | None = None
    vehicle: FloatArray | None = None


class Measured(NamedTuple):
    """What a controller sees at one tick. Read it, do not write into it.

    Parameters
    ----------
    wheel_speed : ndarray (axle)
        Speed at the tread from the toothed wheel, quantised, delayed, by the believed radius,
        [m/s]; NaN where the sensor is known to have failed.
    brake_cylinder_pressure : ndarray (axle)
        Gauge pressure in the brake cylinder, [Pa]; of an electro-mechanical brake the pressure
        that would clamp as much.
    dynamic_force : ndarray (axle)
        Motor force achieved at the tread, dynamic brake positive, traction negative, [N].
    brake_demand : float
        What the driver asks for, 0 (none) to 1 (full).
    emergency : float
        1 in an emergency brake application, else 0.
    drive_demand : float
        What the driver asks of the motors, 0 (none) to 1 (full tractive effort).
    """

    wheel_speed: FloatArray
    brake_cylinder_pressure: FloatArray
    dynamic_force: FloatArray
    brake_demand: float
    emergency: float
    drive_demand: float = 0.0


class Command(NamedTuple):
    """What a controller commands until its next step.

    Parameters
    ----------
    dump_valve : ndarray (axle)
        FILL (0), HOLD (1) or VENT (2).
    dynamic_share : ndarray (axle)
        Share of the demanded motor force (dynamic brake or traction) that is permitted, 0..1.
    sanding : ndarray (axle)
        1 where sand is wanted, else 0.
    reference_speed : float
        The train's speed as the controller believes it, [m/s].
    is_sliding, alarm : ndarray (axle), optional
        1 where the controller sees a slide; its code of a fault. For the record only.
    slip_range : ndarray (axle), optional
        MICRO (1), MIDDLE (1.5) or MACRO (2): the range of slip that the axle is held in. For the
        record only.
    wsp_state : float, optional
        Number of the state that the controller is in, if it numbers them. For the record only.
    friction_share : ndarray (axle), optional
        Share of the demanded friction brake force that is permitted, 0..1; absent: 1. Only
        electro-mechanical brakes (``fill = "lag"``) follow it.
    """

    dump_valve: FloatArray
    dynamic_share: FloatArray
    sanding: FloatArray
    reference_speed: float
    is_sliding: FloatArray | None = None
    alarm: FloatArray | None = None
    slip_range: FloatArray | None = None
    wsp_state: float = 0.0
    friction_share: FloatArray | None = None


@runtime_checkable
class Controller(Protocol):
    """A controller in its plain form; the example in docs/examples/controllers is fifteen lines."""

    period: float

    def reset(self, setup: Setup) -> Any:
        """Return a new state; two states never share anything."""

    def step(self, state: Any, measured: Measured, dt: float) -> Command:
        """Return the command for the next period; the state may be changed in place."""


@runtime_checkable
class CompiledController(Controller, Protocol):
    """A controller that the engine can also compile.

    ``kernel`` and ``state_size`` are plain functions (static methods): ``kernel`` in the subset of
    Python that Numba compiles without objects (scalars, `math`, indexing; no allocation; calls of
    other such functions), ``state_size(n_axles)`` in any Python. ``parameters`` is a NamedTuple
    of floats; a kernel receives it as a one-dimensional array in the order of its fields. The
    state is zero at the start; a class that also has ``initial`` (an `Initial`) then fills it in.
    """

    parameters: Any
    kernel: Kernel

    @staticmethod
    def state_size(n_axles: int) -> int:
        """Return the length of the state array for so many axles."""


def setup_array(setup: Setup) -> FloatArray:
    """Return the setup in the compiled form, [axle, column].

    Examples
    --------
    >>> yes = np.array([True, False])
    >>> setup = Setup(2, 0.01, np.array([0.46, 0.45]), yes, np.array([True, True]))
    >>> float(setup_array(setup)[1, BELIEVED_RADIUS])
    0.45
    """
    array = np.empty((setup.n_axles, N_SETUP), order="F")
    array[:, BELIEVED_RADIUS] = setup.wheel_radius
    array[:, MOTORED] = setup.motored
    array[:, BRAKED] = setup.braked
    array[:, AXLE_LOAD] = 1.0 if setup.axle_load is None else setup.axle_load
    array[:, ROTATING_MASS:BOGIE] = 0.0
    if setup.axles is not None:
        array[:, ROTATING_MASS:BOGIE] = np.stack(setup.axles, axis=1)
    row = np.arange(setup.n_axles)
    array[:, BOGIE] = row // 2 if setup.bogie is None else setup.bogie
    array[:, VEHICLE] = row // 4 if setup.vehicle is None else setup.vehicle
    return array


def measured_array(measured: Measured) -> FloatArray:
    """Return what was measured in the compiled form, [axle, column].

    Examples
    --------
    >>> one = np.array([20.0])
    >>> float(measured_array(Measured(one, one, one, 0.8, 0.0))[0, BRAKE_DEMAND])
    0.8
    """
    array = np.empty((len(measured.wheel_speed), N_MEASURED), order="F")
    array[:, WHEEL_SPEED] = measured.wheel_speed
    array[:, CYLINDER_PRESSURE] = measured.brake_cylinder_pressure
    array[:, DYNAMIC_FORCE] = measured.dynamic_force
    array[:, BRAKE_DEMAND] = measured.brake_demand
    array[:, EMERGENCY] = measured.emergency
    array[:, DRIVE_DEMAND] = measured.drive_demand
    return array


def command_array(n_axles: int) -> FloatArray:
    """Return the command that stands before the first step: valves filling, nothing reduced.

    Examples
    --------
    >>> command = command_array(4)
    >>> float(command[3, DUMP_VALVE]), float(command[3, DYNAMIC_SHARE])
    (0.0, 1.0)
    """
    array = np.zeros((n_axles, N_COMMAND), order="F")
    array[:, DUMP_VALVE] = FILL
    array[:, DYNAMIC_SHARE] = 1.0
    array[:, FRICTION_SHARE] = 1.0
    return array


def command_from_array(array: FloatArray) -> Command:
    """Return a command of the compiled form as the plain form has it (a copy).

    Examples
    --------
    >>> command_from_array(command_array(2)).dump_valve.tolist()
    [0.0, 0.0]
    """
    return Command(
        dump_valve=array[:, DUMP_VALVE].copy(),
        dynamic_share=array[:, DYNAMIC_SHARE].copy(),
        sanding=array[:, SANDING].copy(),
        reference_speed=float(array[0, REFERENCE_SPEED]),
        is_sliding=array[:, IS_SLIDING].copy(),
        alarm=array[:, ALARM].copy(),
        slip_range=array[:, SLIP_RANGE].copy(),
        wsp_state=float(array[0, WSP_STATE]),
        friction_share=array[:, FRICTION_SHARE].copy(),
    )
