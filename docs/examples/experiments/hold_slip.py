"""Holds driven wheels at a slip speed, and does nothing else: for experiments, not for service."""

import numpy as np

from railgrip.control.contract import Command


class HoldSlip:
    """A slow proportional and integral control of the spin; it doubts no sensor, eases no brake."""

    period = 0.01
    aim, gain, rate, lag = 1.0, 30e3, 0.5, 0.08  # m/s, N/(m/s), 1/s, s

    def reset(self, setup):
        return {"setup": setup, "spin": np.zeros(setup.n_axles), "sum": np.zeros(setup.n_axles)}

    def step(self, state, measured, dt):
        setup, speed = state["setup"], np.nan_to_num(measured.wheel_speed)
        rolls_freely = ~setup.motored if not setup.motored.all() else setup.motored
        reference = float(speed[rolls_freely].min())
        spin, total = state["spin"], state["sum"]
        spin += dt / (self.lag + dt) * (speed - reference - spin)
        total += dt * self.rate * self.gain * (self.aim - spin)
        np.clip(total, 0.0, 1e6, out=total)
        share = np.ones(setup.n_axles)
        if measured.drive_demand > 0.0 and setup.axles is not None:
            power = setup.axles.tractive_power / np.maximum(speed, 0.1)
            full = np.minimum(setup.axles.tractive_effort, power)
            force = total + self.gain * (self.aim - spin)
            share = np.where(full > 0.0, np.clip(force / np.maximum(full, 1.0), 0.0, 1.0), 1.0)
        nothing = np.zeros(setup.n_axles)
        return Command(nothing, share, nothing, reference)
