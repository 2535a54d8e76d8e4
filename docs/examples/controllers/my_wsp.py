"""A wheel-slide protection in fifteen lines. Copy it, change it, then: railgrip check my_wsp.py."""

import numpy as np

from railgrip.control.contract import FILL, HOLD, VENT, Command


class MyWSP:
    """Vent above 15 % slip, hold above 5 %, fill below; never keep an axle released for long."""

    period = 0.01  # s

    def reset(self, setup):
        none = np.zeros(setup.n_axles)
        return {"reference": 0.0, "valve": none, "released": none}

    def step(self, state, measured, dt):
        fall = 1.5 if (state["valve"] == FILL).any() else 0.1  # all slide: the train hardly brakes
        speed = np.nan_to_num(measured.wheel_speed, nan=state["reference"])  # lost sensor: brake on
        reference = max(0.0, speed.max(), state["reference"] - fall * dt)
        slip = (reference - speed) / max(reference, 1.5)  # below 1.5 m/s it counts for little
        valve = np.where(slip > 0.15, VENT, np.where(slip > 0.05, HOLD, FILL))
        released = np.where(valve == VENT, state["released"] + dt, 0.0)
        valve[(released > 8.0) | (reference < 1.5)] = FILL
        state.update(reference=reference, valve=valve, released=released)
        filling = np.where(valve == FILL, 1.0, 0.0)  # a sliding axle brakes without its motor
        return Command(valve, filling, sanding=0.0 * valve, reference_speed=reference)
