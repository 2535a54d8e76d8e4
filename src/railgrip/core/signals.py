"""The one catalogue of what railgrip can tell: name, symbol, unit, dimensions, meaning.

Glossary, result attributes, plot axes and file channels are all made from it.
"""

from __future__ import annotations

from typing import NamedTuple


class Signal(NamedTuple):
    """One quantity of a result.

    Attributes
    ----------
    name, symbol : str
        Name in code and files; symbol in text and on axes.
    unit : str
        SI unit (°C for temperatures), ``"1"`` for ratios, as UDUNITS writes it.
    dims : tuple of str
        Dimensions beside ``run``: some of ``axle``, ``vehicle``, ``time``, ``cell``.
    meaning : str
        One sentence.
    """

    name: str
    symbol: str
    unit: str
    dims: tuple[str, ...]
    meaning: str


_TRAIN = ("time",)
_AXLE = ("axle", "time")
_VEHICLE = ("vehicle", "time")
_CELL = ("cell",)
_RUN: tuple[str, ...] = ()
_PER_AXLE = ("axle",)

_CATALOGUE = (
    # the train over time
    Signal("train_speed", "v", "m/s", _TRAIN, "True speed of the train."),
    Signal("train_position", "x", "m", _TRAIN, "Position of the train's front on the line."),
    Signal("acceleration", "a", "m/s^2", _TRAIN, "Acceleration of the train, driving positive."),
    Signal("reference_speed", "v_ref", "m/s", _TRAIN, "Train speed as the WSP believes it."),
    Signal("brake_demand", "d", "1", _TRAIN, "Driver's demand as a share of full braking."),
    Signal("drive_demand", "d_D", "1", _TRAIN, "Driver's demand as a share of full traction."),
    Signal(
        "wsp_state",
        "",
        "1",
        _TRAIN,
        "Number of the state that the controller is in; 0: unnumbered.",
    ),
    Signal(
        "brake_correction",
        "u",
        "1",
        _TRAIN,
        "Correction of the deceleration controller, over what is asked.",
    ),
    # each axle over time
    Signal("wheel_speed", "w", "m/s", _AXLE, "True peripheral speed of the wheel at the tread."),
    Signal("measured_speed", "w_m", "m/s", _AXLE, "Wheel speed as the controller measures it."),
    Signal(
        "unit_reference_speed",
        "v_ref",
        "m/s",
        _AXLE,
        "Train speed as the axle's own unit believes it, where there are several.",
    ),
    Signal(
        "unit_state",
        "",
        "1",
        _AXLE,
        "Number of the state that the axle's own unit is in, where there are several.",
    ),
    Signal(
        "creepage",
        "s",
        "1",
        _AXLE,
        "(wheel_speed - train_speed)/train_speed, signed, contact side; undefined at a stand.",
    ),
    Signal(
        "slip_speed",
        "w_s",
        "m/s",
        _AXLE,
        "reference_speed - measured_speed, control side, positive when braking.",
    ),
    Signal("wheel_load", "Q", "N", _AXLE, "Vertical load of the axle (both wheels)."),
    Signal("contact_force", "T", "N", _AXLE, "Force of the rail on the axle, driving positive."),
    Signal(
        "adhesion_available",
        "tau_a",
        "1",
        _AXLE,
        "Greatest force the contact could transmit now at any slip, over wheel load.",
    ),
    Signal("adhesion_used", "tau_u", "1", _AXLE, "Force the contact transmits, over wheel load."),
    Signal(
        "adhesion_asked",
        "tau_q",
        "1",
        _AXLE,
        "Force that driver, brake and motor ask for at the tread, before any slide protection, "
        "over wheel load.",
    ),
    Signal(
        "brake_cylinder_pressure",
        "p_C",
        "Pa",
        _AXLE,
        "Pressure in the brake cylinder, gauge.",
    ),
    Signal("dump_valve", "z", "1", _AXLE, "Dump valve as it stands: 0 FILL, 1 HOLD, 2 VENT."),
    Signal("clamp_force", "F_b", "N", _AXLE, "Force of pads or blocks, all units of the axle."),
    Signal("pad_friction", "mu_p", "1", _AXLE, "Friction coefficient of pads or blocks."),
    Signal(
        "estimated_friction",
        "mu_S",
        "1",
        _AXLE,
        "Friction of pads or blocks that brake control reckons with.",
    ),
    Signal("brake_force", "F_B", "N", _AXLE, "Friction brake force acting at the tread."),
    Signal("motor_speed", "w_m", "m/s", _AXLE, "Speed of the motor, referred to the tread."),
    Signal(
        "driveline_torque",
        "M_s",
        "N m",
        _AXLE,
        "Torque of the shaft on the wheelset, driving positive.",
    ),
    Signal(
        "dynamic_force",
        "F_D",
        "N",
        _AXLE,
        "Force of the motor at the tread: dynamic brake positive, traction negative.",
    ),
    Signal("disc_temperature", "T_1", "degC", _AXLE, "Friction ring (or tread) temperature."),
    Signal(
        "flash_temperature",
        "dT",
        "K",
        _AXLE,
        "Greatest rise of the surfaces of wheel and rail in the contact, over where they enter it.",
    ),
    Signal("hub_temperature", "T_2", "degC", _AXLE, "Temperature of the disc's hub."),
    Signal(
        "rail_friction",
        "mu_0",
        "1",
        _AXLE,
        "Static friction of the rail under the axle as it finds it.",
    ),
    Signal(
        "cleaning",
        "lambda",
        "1",
        _AXLE,
        "Share of the contaminant that axles before this one have removed.",
    ),
    Signal("is_sliding", "", "1", _AXLE, "1 while the controller counts the axle as sliding."),
    Signal("alarm", "", "1", _AXLE, "1 while wheel rotation monitoring reports the axle."),
    Signal(
        "wsp_alarm",
        "",
        "1",
        _AXLE,
        "What the protection reports of the axle: 1 sensor not believed, 2 safety timer, 3 wheel "
        "diameter not as believed.",
    ),
    Signal(
        "slip_range",
        "",
        "1",
        _AXLE,
        "Range of slip that the controller holds the axle in: 1 micro, 1.5 middle, 2 macro, "
        "0 unnamed.",
    ),
    # each vehicle over time
    Signal("reservoir_pressure", "p_R", "Pa", _VEHICLE, "Pressure in the brake reservoir, gauge."),
    Signal("track_brake_force", "F_M", "N", _VEHICLE, "Force of the magnetic track brakes."),
    # the rail after the run
    Signal("rail_energy", "W", "J/m", _CELL, "Friction energy received per metre of line."),
    Signal(
        "rail_friction_before",
        "mu_0",
        "1",
        _CELL,
        "Static friction of the rail before the train.",
    ),
    Signal("rail_friction_after", "mu_0", "1", _CELL, "Static friction of the rail after it."),
    Signal("rail_sand", "q_s", "kg/m", _CELL, "Sand laid per metre of line."),
    # outcomes
    Signal("covered_distance", "x", "m", _RUN, "Distance from start to end of the run."),
    Signal("final_speed", "v_1", "m/s", _RUN, "Speed of the train at the end of the run."),
    Signal("status", "", "1", _RUN, "How the run ended (RunStatus)."),
    Signal("initial_speed", "v_0", "m/s", _RUN, "Speed at the first brake command."),
    Signal(
        "stopping_distance",
        "s",
        "m",
        _RUN,
        "Distance from the first brake command to the stand.",
    ),
    Signal("stopping_time", "t", "s", _RUN, "Time from the first brake command to the stand."),
    Signal(
        "correction_effort",
        "",
        "1",
        _RUN,
        "Mean of |brake_correction| from 2 s after the command to the stop.",
    ),
    Signal(
        "build_up_time",
        "t_e",
        "s",
        _RUN,
        "Equivalent build-up time: train speed is held for it, then the full deceleration acts.",
    ),
    Signal(
        "deceleration_distance",
        "s_d",
        "m",
        _RUN,
        "Stopping distance less the distance run during the equivalent build-up time.",
    ),
    Signal(
        "mean_deceleration",
        "a_m",
        "m/s^2",
        _RUN,
        "v_0^2 over twice the deceleration distance.",
    ),
    Signal(
        "adhesion_utilisation",
        "eta",
        "1",
        _RUN,
        "Adhesion used over adhesion available, summed over distance and load, while sliding.",
    ),
    Signal(
        "slide_activity",
        "",
        "1",
        _RUN,
        "Share of the time above 60 km/h in which half the wheels run below 0.9 train speed.",
    ),
    Signal("air_used", "V_n", "m^3", _RUN, "Air taken from the reservoirs, at 1 bar."),
    Signal("energy_kinetic_initial", "E_0", "J", _RUN, "Kinetic energy at the start."),
    Signal("energy_kinetic_final", "E_1", "J", _RUN, "Kinetic energy at the end."),
    Signal("energy_contact", "E_c", "J", _RUN, "Friction work between wheel and rail."),
    Signal("energy_brake", "E_b", "J", _RUN, "Work of the friction brakes."),
    Signal("energy_dynamic", "E_d", "J", _RUN, "Work of the dynamic brake."),
    Signal("energy_traction", "E_t", "J", _RUN, "Work of the motors that drive."),
    Signal("energy_driveline", "E_s", "J", _RUN, "Work that shafts stored and their dampers took."),
    Signal("energy_track_brake", "E_m", "J", _RUN, "Work of the magnetic track brakes."),
    Signal("energy_resistance", "E_r", "J", _RUN, "Work of running and curve resistance."),
    Signal("energy_gradient", "E_g", "J", _RUN, "Work against gravity, uphill positive."),
    Signal("energy_rail", "E_W", "J", _RUN, "Friction energy that the rail cells received."),
    Signal(
        "energy_balance",
        "",
        "1",
        _RUN,
        "What the terms leave unexplained, over the initial kinetic energy.",
    ),
    Signal("axle_slid_distance", "s_s", "m", _PER_AXLE, "Slid distance of the wheel."),
    Signal("axle_slid_energy", "E_s", "J", _PER_AXLE, "Friction work in the contact."),
    Signal("axle_locked_time", "t_l", "s", _PER_AXLE, "Time below 5 % of train speed."),
    Signal("axle_longest_lock", "", "s", _PER_AXLE, "Longest single time of locking."),
    Signal(
        "axle_longest_fast_lock",
        "",
        "s",
        _PER_AXLE,
        "Longest single time of locking above 30 km/h train speed.",
    ),
    Signal(
        "axle_mean_adhesion",
        "tau_m",
        "1",
        _PER_AXLE,
        "Contact force over static load, mean from 2 s after the command to the stop.",
    ),
    Signal("axle_greatest_flash", "", "K", _PER_AXLE, "Greatest flash temperature rise."),
    Signal("axle_greatest_slip", "", "1", _PER_AXLE, "Greatest slip above 3 m/s train speed."),
    Signal("axle_slide_time", "", "s", _PER_AXLE, "Time with a creepage beyond 5 %."),
    Signal(
        "axle_greatest_spin",
        "",
        "1",
        _PER_AXLE,
        "Greatest (wheel_speed - train_speed)/wheel_speed while the wheel turns above 3 m/s.",
    ),
    Signal("axle_spin_time", "", "s", _PER_AXLE, "Time spinning by more than 5 %."),
    Signal("axle_greatest_disc_temperature", "", "degC", _PER_AXLE, "Greatest disc temperature."),
    Signal(
        "axle_flat_length",
        "l_f",
        "m",
        _PER_AXLE,
        "Estimated length of a wheel flat ground by locked sliding (illustrative wear rate).",
    ),
    Signal("axle_valve_cycles", "", "1", _PER_AXLE, "Number of times the dump valve vented."),
)

SIGNALS: dict[str, Signal] = {signal.name: signal for signal in _CATALOGUE}
"""Every signal by its name."""


def attributes(name: str) -> dict[str, str]:
    """Return the attributes that a variable of this name carries in a file.

    Parameters
    ----------
    name : str
        A key of `SIGNALS`.

    Returns
    -------
    dict of str
        ``long_name``, ``units``, ``symbol``.

    Examples
    --------
    >>> attributes("train_speed")["units"]
    'm/s'
    """
    signal = SIGNALS[name]
    return {"long_name": signal.meaning, "units": signal.unit, "symbol": signal.symbol}
