"""The brake of every axle over one tick: demand → air → clamp → pad, and the dynamic brake.

The brake feels the wheel only through its speed, slowly; so it advances once a tick (midpoint
rule) and hands the wheels the force that acts in the middle of the tick. Both are of second order.
"""

from __future__ import annotations

from typing import Any

from railgrip.brake.constant_friction import ConstantFriction, constant_friction
from railgrip.brake.dynamic_brake import DynamicBrake, dynamic_brake_limit
from railgrip.brake.filling import Distributor, LinearFilling, distributor_rate, linear_fill_rate
from railgrip.brake.karwatzki_1950 import KarwatzkiParameters, karwatzki_1950
from railgrip.brake.orifice import orifice_flow
from railgrip.brake.piecewise_friction import PiecewiseFriction, piecewise_friction
from railgrip.brake.rigging import hysteresis
from railgrip.compiler import inlined
from railgrip.core.formulas.elementary import exp_decay
from railgrip.core.formulas.piecewise_linear import Hinges
from railgrip.core.formulas.two_node_heat import DiscHeat, two_node_heat_rates
from railgrip.engine import layout
from railgrip.engine import offsets as at
from railgrip.engine.offsets import width

LEAST_POWER_SPEED = 0.1
"""Below it power no longer bounds the tractive effort, m/s."""
CUT_OFF = 4.0
"""A converter cuts its torque off so many times faster than it builds it up; illustrative."""

_orifice_flow = inlined(orifice_flow)
_hysteresis = inlined(hysteresis)
_dynamic_limit = inlined(dynamic_brake_limit)
_linear_fill_rate = inlined(linear_fill_rate)
_distributor_rate = inlined(distributor_rate)
_constant = inlined(constant_friction)
_karwatzki = inlined(karwatzki_1950)
_piecewise = inlined(piecewise_friction)
_heat_rates = inlined(two_node_heat_rates)
_exp_decay = inlined(exp_decay)


@inlined
def demand_pass(lanes: Any, S: Any, b: int, tick: float, demand_tick: Any, level: Any) -> None:
    """Let the driver's demand reach the axle after the delay of pipe and distributor."""
    L = width(lanes)
    for i in range(demand_tick.shape[0]):
        from_time = (float(demand_tick[i]) - 0.5) * tick
        demanded = level[i]
        known = 0.0 if i == 0 else 1.0
        for k in range(L):
            since = S[b + at.HERE_TICK * L + k] * tick - S[b + at.DEMAND_DELAY * L + k]
            before = known * S[b + at.DEMAND * L + k]
            S[b + at.DEMAND * L + k] = demanded if since >= from_time else before


@inlined
def dynamic_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Motor of one axle: of the brake demand it takes what it can, and it drives (negative)."""
    L = width(lanes)
    for k in range(L):
        brake = DynamicBrake(
            S[b + at.DYNAMIC_MAX * L + k], S[b + at.DYNAMIC_POWER * L + k],
            S[b + at.FADE_START * L + k], S[b + at.FADE_END * L + k],
        )  # fmt: skip
        # the speed at the end of the tick, where the new force will stand
        end = max(2.0 * S[b + at.WHEEL_SPEED * L + k] - S[b + at.SPEED_BEFORE * L + k], 0.0)
        limit = _dynamic_limit(brake, end)
        asked = S[b + at.DEMAND * L + k] * S[b + at.FORCE_FACTOR * L + k]
        asked = asked * S[b + at.FULL_FORCE * L + k]
        permitted = S[b + at.DYNAMIC_SHARE * L + k] * S[b + at.HERE_DYNAMIC * L + k]
        by_power = S[b + at.TRACTION_POWER * L + k] / max(end, LEAST_POWER_SPEED)
        effort = min(S[b + at.TRACTION_MAX * L + k], by_power) * S[b + at.HERE_DRIVE * L + k]
        wanted = min(limit, asked) * permitted - effort * S[b + at.DYNAMIC_SHARE * L + k]
        force = S[b + at.DYNAMIC_FORCE * L + k]
        braking = S[b + at.DYNAMIC_RATE * L + k] * h
        driving = S[b + at.TRACTION_RATE * L + k] * h
        lowest = force - (CUT_OFF * braking if force > 0.0 else driving)
        highest = force + (CUT_OFF * driving if force < 0.0 else braking)
        after = max(lowest, min(highest, wanted))
        S[b + at.DYNAMIC_FORCE * L + k] = after
        acting = 0.5 * (force + after)
        S[b + at.DYNAMIC_ACTING * L + k] = acting
        S[b + at.TURNING_FORCE * L + k] = acting
        S[b + at.WHOLE_TURNING_FORCE * L + k] = acting


@inlined
def _target(L: int, S: Any, b: int, k: int) -> float:
    """Return the pressure for what the dynamic brake leaves over, as brake control bends it."""
    taken = max(S[b + at.DYNAMIC_ACTING * L + k], 0.0) * S[b + at.PER_FULL_FORCE * L + k]
    left = S[b + at.DEMAND * L + k] * S[b + at.FORCE_FACTOR * L + k] - taken
    wanted = S[b + at.FULL_PRESSURE * L + k] * max(left, 0.0) * S[b + at.PRESSURE_FACTOR * L + k]
    return float(min(wanted, S[b + at.PRESSURE_LIMIT * L + k]))


@inlined
def supply_pass(lanes: Any, S: Any, b: int, filling: float, h: float) -> None:
    """Pressure that distributor or electro-pneumatic valve offers; the reservoir bounds it."""
    L = width(lanes)
    if filling == layout.FILL_LINEAR:
        for k in range(L):
            ramps = LinearFilling(S[b + at.FILL_RATE * L + k], S[b + at.RELEASE_RATE * L + k])
            supply = S[b + at.SUPPLY_PRESSURE * L + k]
            supply = supply + h * _linear_fill_rate(ramps, supply, _target(L, S, b, k), h)
            S[b + at.SUPPLY_AFTER * L + k] = min(supply, S[b + at.RESERVOIR_PRESSURE * L + k])
    else:
        for k in range(L):
            orifices = Distributor(
                S[b + at.FILL_RATE * L + k], S[b + at.INSHOT_RATE * L + k],
                S[b + at.INSHOT_PRESSURE * L + k], S[b + at.RELEASE_RATE * L + k],
            )  # fmt: skip
            supply = S[b + at.SUPPLY_PRESSURE * L + k]
            target = _target(L, S, b, k)
            middle = supply + 0.5 * h * _distributor_rate(orifices, supply, target)
            supply = supply + h * _distributor_rate(orifices, middle, target)
            S[b + at.SUPPLY_AFTER * L + k] = min(supply, S[b + at.RESERVOIR_PRESSURE * L + k])


@inlined
def cylinder_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Brake cylinder behind its dump valve, and the force on pads or blocks."""
    L = width(lanes)
    for k in range(L):
        supply = S[b + at.SUPPLY_PRESSURE * L + k]
        after = S[b + at.SUPPLY_AFTER * L + k]
        pressure = S[b + at.CYLINDER_PRESSURE * L + k]
        # a valve fills from the supply, vents into the open, or holds: one orifice at a time
        is_fill = S[b + at.IS_FILL * L + k]
        opening = is_fill * S[b + at.VALVE_FILL * L + k]
        opening += S[b + at.IS_VENT * L + k] * S[b + at.VALVE_VENT * L + k]
        rate = opening * _orifice_flow(is_fill * supply, pressure)
        middle = max(pressure + 0.5 * h * rate, 0.0)
        rate = opening * _orifice_flow(is_fill * 0.5 * (supply + after), middle)
        has_valve = S[b + at.HAS_VALVE * L + k]
        pressure_after = has_valve * (pressure + h * rate) + (1.0 - has_valve) * after
        pressure_after = max(pressure_after, 0.0)
        slope = S[b + at.CLAMP_PER_PRESSURE * L + k]
        offset = S[b + at.CLAMP_OFFSET * L + k]
        lag = S[b + at.HYSTERESIS * L + k]
        clamp = S[b + at.CLAMP_FORCE * L + k]
        clamp_after = _hysteresis(clamp, max(slope * pressure_after + offset, 0.0), lag)
        S[b + at.PRESSURE_BEFORE * L + k] = pressure
        S[b + at.SUPPLY_PRESSURE * L + k] = after
        S[b + at.CYLINDER_PRESSURE * L + k] = pressure_after
        S[b + at.CLAMP_ACTING * L + k] = 0.5 * (clamp + clamp_after)
        S[b + at.CLAMP_FORCE * L + k] = clamp_after


@inlined
def lag_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Electro-mechanical brake: the clamp follows the permitted demand with a first-order lag.

    It is told in the pressure that would clamp as much. Its drive obeys a dump valve's words too:
    HOLD keeps the clamp, VENT opens it.
    """
    L = width(lanes)
    for k in range(L):
        kept = _exp_decay(h * S[b + at.FILL_RATE * L + k])
        target = _target(L, S, b, k)
        supply = S[b + at.SUPPLY_PRESSURE * L + k]
        pressure = S[b + at.CYLINDER_PRESSURE * L + k]
        fills, vents = S[b + at.IS_FILL * L + k], S[b + at.IS_VENT * L + k]
        wanted = fills * target * S[b + at.FRICTION_SHARE * L + k]
        wanted += (1.0 - fills - vents) * pressure
        after = wanted + (pressure - wanted) * kept
        clamp = S[b + at.CLAMP_FORCE * L + k]
        nominal = S[b + at.CLAMP_PER_PRESSURE * L + k] * after + S[b + at.CLAMP_OFFSET * L + k]
        clamp_after = _hysteresis(clamp, max(nominal, 0.0), S[b + at.HYSTERESIS * L + k])
        S[b + at.SUPPLY_PRESSURE * L + k] = target + (supply - target) * kept
        S[b + at.PRESSURE_BEFORE * L + k] = pressure
        S[b + at.CYLINDER_PRESSURE * L + k] = after
        S[b + at.CLAMP_ACTING * L + k] = 0.5 * (clamp + clamp_after)
        S[b + at.CLAMP_FORCE * L + k] = clamp_after


@inlined
def _pad_inputs(L: int, S: Any, b: int, k: int) -> tuple[float, float, float]:
    """Return force per block, rubbing speed in the middle of the tick, and temperature."""
    speed = S[b + at.WHEEL_SPEED * L + k]
    middle = abs(1.5 * speed - 0.5 * S[b + at.SPEED_BEFORE * L + k])
    return (
        S[b + at.CLAMP_ACTING * L + k] * S[b + at.CLAMP_PER_BLOCK * L + k],
        middle * S[b + at.RUBBING_RATIO * L + k],
        S[b + at.RING_MIDDLE * L + k],
    )


@inlined
def pad_pass(lanes: Any, S: Any, b: int, brake: Any) -> None:
    """Friction of the pads by the law that this axle's pad names, and the brake force."""
    L = width(lanes)
    law = brake[1]
    if law == layout.PAD_CONSTANT:
        for k in range(L):
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _constant(
                ConstantFriction(S[b + at.PAD_LEVEL * L + k]), clamp, rubbing, hot
            )
    elif law == layout.PAD_KARWATZKI:
        for k in range(L):
            level = S[b + at.PAD_LEVEL * L + k]
            block = KarwatzkiParameters(level, brake[2], brake[3], brake[4], brake[5])
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _karwatzki(block, clamp, rubbing, hot)
    elif law == layout.PAD_PIECEWISE:
        warmth, speed, force = _hinges(brake, 2), _hinges(brake, 11), _hinges(brake, 20)
        for k in range(L):
            pad = PiecewiseFriction(S[b + at.PAD_LEVEL * L + k], warmth, speed, force)
            clamp, rubbing, hot = _pad_inputs(L, S, b, k)
            S[b + at.PAD_FRICTION * L + k] = _piecewise(pad, clamp, rubbing, hot)
    for k in range(L):
        S[b + at.PAD_FRICTION * L + k] *= S[b + at.PAD_FACTOR * L + k]
        S[b + at.BRAKE_LIMIT * L + k] = (
            S[b + at.PAD_FRICTION * L + k]
            * S[b + at.CLAMP_ACTING * L + k]
            * S[b + at.TREAD_PER_CLAMP * L + k]
        )


@inlined
def _hinges(brake: Any, i: int) -> Hinges:
    return Hinges(
        brake[i], brake[i + 1], brake[i + 2], brake[i + 3], brake[i + 4],
        brake[i + 5], brake[i + 6], brake[i + 7], brake[i + 8],
    )  # fmt: skip


@inlined
def heat_pass(lanes: Any, S: Any, b: int, h: float) -> None:
    """Heat of the tick into the disc: the mean power of brake impulse and mean speed."""
    L = width(lanes)
    per_tick = 1.0 / h
    for k in range(L):
        disc = DiscHeat(
            S[b + at.RING_MASS * L + k], S[b + at.HUB_MASS * L + k],
            S[b + at.CONDUCTANCE * L + k], S[b + at.DISC_SURFACE * L + k],
            S[b + at.HEAT_SHARE * L + k], S[b + at.FILM_STILL * L + k],
            S[b + at.FILM_WIND * L + k], S[b + at.EMISSIVITY * L + k],
            S[b + at.AMBIENT * L + k],
        )  # fmt: skip
        mean_speed = 0.5 * (S[b + at.SPEED_BEFORE * L + k] + S[b + at.WHEEL_SPEED * L + k])
        power = S[b + at.BRAKE_IMPULSE * L + k] * mean_speed * per_tick
        still, wind = S[b + at.FILM_STILL * L + k], S[b + at.FILM_WIND * L + k]
        film = still + wind * S[b + at.HERE_FILM * L + k]
        ring_rate, hub_rate = _heat_rates(
            disc, S[b + at.RING_MIDDLE * L + k], S[b + at.HUB_MIDDLE * L + k], power, film
        )
        ring = S[b + at.RING_TEMPERATURE * L + k] + h * ring_rate
        hub = S[b + at.HUB_TEMPERATURE * L + k] + h * hub_rate
        S[b + at.RING_TEMPERATURE * L + k] = ring
        S[b + at.HUB_TEMPERATURE * L + k] = hub
        # where the next tick's middle will be, if it heats as this one did
        S[b + at.RING_MIDDLE * L + k] = ring + 0.5 * h * ring_rate
        S[b + at.HUB_MIDDLE * L + k] = hub + 0.5 * h * hub_rate


@inlined
def brake_pass(
    lanes: Any, S: Any, b: int, brake: Any, demand_tick: Any, level: Any, h: float
) -> None:
    """Advance the brake of one axle by one tick."""
    demand_pass(lanes, S, b, h, demand_tick, level)
    dynamic_pass(lanes, S, b, h)
    if brake[0] == layout.FILL_LAG:
        lag_pass(lanes, S, b, h)
    else:
        supply_pass(lanes, S, b, brake[0], h)
        cylinder_pass(lanes, S, b, h)
    pad_pass(lanes, S, b, brake)
