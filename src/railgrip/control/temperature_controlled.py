"""Temperature-controlled adhesion: slip that heats wheel and rail by a chosen, admissible amount.

Friction heats, cleans and dries the contact, and so raises the adhesion; the admissible rises
protect wheel and rail. Each axle's adhesion is observed (`adhesion_window`), the friction power
that the rises admit becomes a slip and a force (`temperature_targets`), and the driver's demand is
limited to that force (`temperature_axle`), by motor, electro-mechanical brake or dump valve.

After EP 2 231 448 (Knorr-Bremse); its owner's consent may be needed to use it in a vehicle.
"""

from __future__ import annotations

from railgrip.control.adhesion_window import observe_friction
from railgrip.control.axle_forces import applied_force, force_per_pressure, pressures
from railgrip.control.axle_signals import take_measured
from railgrip.control.contract import (
    AXLE_LOAD,
    BRAKE_DEMAND,
    BRAKING_EFFORT,
    BRAKING_POWER,
    CONTINUOUS,
    EMERGENCY,
    FULL_FORCE,
    ROTATING_MASS,
    FloatArray,
)
from railgrip.control.conventional_parameters import ROTATING_SHARE
from railgrip.control.conventional_state import DECELERATION
from railgrip.control.conventional_wsp import conventional_initial
from railgrip.control.diameter_compensation import learn_diameters
from railgrip.control.driven_faults import drive_as_neighbours, watch_driven_sensors
from railgrip.control.driving_reference import follow_trailing_wheels, is_driving
from railgrip.control.faulty_axle import follow_neighbours
from railgrip.control.force_reckoning import reckon_with_forces
from railgrip.control.plain_form import KernelController
from railgrip.control.state_layout import axle_base, n_places, state_size
from railgrip.control.temperature_axle import brake_axles, drive_axle
from railgrip.control.temperature_limit import limit_factor
from railgrip.control.temperature_parameters import (
    ACCURACY,
    COURSE,
    GREATEST_SLIP,
    NOMINAL_DECELERATION,
    OBSERVER_WINDOW,
    PATCH_LOAD,
    SEMI_AXIS_ACROSS,
    SEMI_AXIS_ALONG,
    TemperatureParameters,
)
from railgrip.control.temperature_state import (
    BRAKE_FORCE,
    CLOCK,
    CONTINUOUS_BRAKE,
    EFFORT_OF_MOTOR,
    FACTOR,
    FIRST,
    FORCE_BEFORE,
    FORCE_PER_PRESSURE,
    FULL,
    LOAD,
    MASS,
    MOVING,
    N_WINDOW,
    POWER_OF_MOTOR,
    PRESSURE_PER_FORCE,
    SAMPLE,
    SLIP_LIMIT,
    STILL,
    TRAIN_ACCELERATION,
)
from railgrip.control.train_observer import look_at_wheels
from railgrip.core.constants import GRAVITY
from railgrip.core.errors import Problem, RailgripError
from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, flash_conductance


def temperature_initial(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray
) -> None:
    """Fill the state at the start: masses, loads, and what heat the contacts take up."""
    conventional_initial(parameters, axle_setup, state, measured)
    n_axles = measured.shape[0]
    state[FACTOR] = 1.0
    along, across = parameters[SEMI_AXIS_ALONG], parameters[SEMI_AXIS_ACROSS]
    still = flash_conductance(STEEL_ERTZ_2002, along, across, 0.0)
    moving = flash_conductance(STEEL_ERTZ_2002, along, across, 1.0)
    state[STILL] = still * still
    # a patch grows with the load^(1/3), so what moving steel takes up grows with its root
    state[MOVING] = (moving * moving - still * still) / parameters[PATCH_LOAD]
    for axle in range(n_axles):
        base = axle_base(axle)
        load = axle_setup[axle, AXLE_LOAD]
        load = load if load > 1.0e3 else parameters[PATCH_LOAD]
        mass = axle_setup[axle, ROTATING_MASS]
        force = axle_setup[axle, FULL_FORCE]
        state[base + LOAD] = load
        state[base + MASS] = mass if mass > 0.0 else parameters[ROTATING_SHARE] * load / GRAVITY
        if mass <= 0.0:
            force = parameters[NOMINAL_DECELERATION] * load / GRAVITY
        state[base + BRAKE_FORCE] = force
        per_pressure = force_per_pressure(axle_setup, axle, force)
        state[base + FORCE_PER_PRESSURE] = per_pressure
        state[base + PRESSURE_PER_FORCE] = 1.0 / per_pressure if per_pressure > 0.0 else 0.0
        state[base + FIRST], state[base + FULL] = pressures(axle_setup, axle)
        state[base + CONTINUOUS_BRAKE] = axle_setup[axle, CONTINUOUS]
        state[base + EFFORT_OF_MOTOR] = axle_setup[axle, BRAKING_EFFORT]
        state[base + POWER_OF_MOTOR] = axle_setup[axle, BRAKING_POWER]
        state[base + SLIP_LIMIT] = parameters[GREATEST_SLIP]
    for place in range(n_axles, n_places(n_axles)):
        state[axle_base(place) + LOAD] = 1.0  # what is divided by it stays a number
    take_measured(state, measured)
    for axle in range(n_axles):
        state[axle_base(axle) + FORCE_BEFORE] = applied_force(state, axle_base(axle))


def observe_forces(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    accuracy: float, dt: float,
) -> None:  # fmt: skip
    """Update wheels, forces of the rails, reference speed and admissible rise in the state.

    Parameters
    ----------
    parameters, axle_setup, state, measured : ndarray
        As in the controller contract.
    accuracy : float
        How exactly the train speed must be known, as a slip.
    dt : float
        Period, [s].
    """
    n_axles = measured.shape[0]
    wheels = look_at_wheels(parameters, state, measured, accuracy, dt)
    sample = int(state[SAMPLE])
    window = int(parameters[OBSERVER_WINDOW] / dt + 0.5)
    if is_driving(measured):
        watch_driven_sensors(parameters, axle_setup, state, measured, dt)
    observe_friction(state, n_axles, sample, window, dt)
    if is_driving(measured):
        follow_trailing_wheels(parameters, axle_setup, state, n_axles, dt)
    else:
        reckon_with_forces(parameters, state, wheels, n_axles, accuracy, dt)
        learn_diameters(parameters, state, measured, dt)
    state[TRAIN_ACCELERATION] = -state[DECELERATION]
    state[FACTOR] = limit_factor(parameters, state[CLOCK], measured[0, EMERGENCY])
    state[SAMPLE] += 1.0
    state[CLOCK] += dt


def lead_axles(
    parameters: FloatArray, axle_setup: FloatArray, state: FloatArray, measured: FloatArray,
    command: FloatArray, dt: float,
) -> None:  # fmt: skip
    """Write the command of every axle, driving or braking; slip limits are in the state."""
    if is_driving(measured):
        for axle in range(measured.shape[0]):
            drive_axle(parameters, axle_setup, state, measured, command, axle, dt)
    else:
        brake_axles(parameters, state, command, measured[0, BRAKE_DEMAND], dt)


def follow_believed(
    axle_setup: FloatArray, state: FloatArray, measured: FloatArray, command: FloatArray
) -> None:
    """Let axles whose sensors are not believed follow the others, driving or braking."""
    if is_driving(measured):
        drive_as_neighbours(axle_setup, state, command, measured.shape[0])
    else:
        follow_neighbours(axle_setup, state, measured, command)


def temperature_kernel(
    parameters: FloatArray,
    axle_setup: FloatArray,
    state: FloatArray,
    measured: FloatArray,
    command: FloatArray,
    dt: float,
) -> None:
    """Advance temperature control by one period; arguments as in the controller contract."""
    observe_forces(parameters, axle_setup, state, measured, parameters[ACCURACY], dt)
    lead_axles(parameters, axle_setup, state, measured, command, dt)
    follow_believed(axle_setup, state, measured, command)


class TemperatureControlled(KernelController):
    """Temperature-controlled adhesion as a controller, in the plain and in the compiled form.

    Parameters
    ----------
    parameters : TemperatureParameters, optional
        The ordinary protection's (`ConventionalParameters`) and its own (`TemperatureOnly`).
    period : float
        Time between two steps, [s].

    Raises
    ------
    RailgripError
        "set_point: must lie above 0 and up to 1 …", and the like.

    Examples
    --------
    >>> TemperatureControlled().parameters.rise_wheel
    200.0
    """

    kernel = staticmethod(temperature_kernel)
    initial = staticmethod(temperature_initial)
    state_size = staticmethod(state_size)

    def __init__(
        self, parameters: TemperatureParameters | None = None, *, period: float = 0.01
    ) -> None:
        parameters = TemperatureParameters() if parameters is None else parameters
        check_temperature(parameters, period)
        super().__init__(parameters, period)


def check_temperature(parameters: TemperatureParameters, period: float) -> None:
    """Refuse what no vehicle can mean."""
    times = [parameters[COURSE + 2 * i] for i in range(3)]
    span = parameters.observer_window / period
    rises = min(parameters.rise_wheel, parameters.rise_rail)
    demands = {
        "set_point": (0.0 < parameters.set_point <= 1.0, "must lie above 0 and up to 1"),
        "rise_wheel": (rises >= 0.0, "must not be negative; 0 means no limit"),
        "course_1": (times == sorted(times), "the times of the course must ascend"),
        "observer_window": (0.99 < span < N_WINDOW, f"must be 1 to {N_WINDOW - 1} periods"),
        "slip_scale": (parameters.slip_scale > 0.0, "must be positive"),
        "gain_speed": (parameters.gain_speed > 0.0, "must be positive"),
        "greatest_slip": (0.0 < parameters.greatest_slip < 1.0, "must lie between 0 and 1"),
        "semi_axis_across": (
            min(parameters.semi_axis_along, parameters.semi_axis_across) > 0.0,
            "the contact patch must have a size",
        ),
        "heat_law": (parameters.heat_law in (0.0, 1.0), "must be 0 (physical) or 1 (linear)"),
    }
    wrong = [
        Problem(name, what, got=f"{getattr(parameters, name):g}")
        for name, (is_right, what) in demands.items()
        if not is_right
    ]
    if wrong:
        raise RailgripError(wrong)
