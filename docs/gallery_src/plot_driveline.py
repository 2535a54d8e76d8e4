"""
A shaft that swings by itself
=============================

Between motor and wheelset lies a shaft. Where adhesion falls with slip, a spinning wheelset that
slows down is braked more, and one that gains speed less: the rail feeds the torsional oscillation.
The shaft's damping must be more than the fall of the adhesion curve times the share of the motor in
the rotating mass, squared. The values of the shaft are illustrative.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import RailFriction

STIFFNESS, SHARE, RADIUS, ROTATING, LOAD = 5e6, 0.7, 0.425, 2.4e3, 157.0e3
DRY = RailFriction(0.55, 0.4, 0.6, 1.0, 0.4)
SLIP = 1.0  # m/s, at which the wheels are held

# %%
# The least damping at each slip speed, at 7.5 m/s of the train: slope of Polach's law, times the
# share of the motor squared, at the wheelset. It is needed right behind the peak.


def least_damping(slip, speed=7.5, slope=23.7e6, step=0.01):
    def force(w):
        return polach_2005(DRY, LOAD, slope, w, w / (speed + w))

    fall = (force(slip - step) - force(slip + step)) / (2 * step)
    return max(fall, 0.0) * SHARE**2 * RADIUS**2


slips = np.linspace(0.05, 5.0, 200)
least = np.array([least_damping(w) for w in slips])


# %%
# A start on dry rail, whose wheels an experiment's controller holds at 1 m/s of slip
# (`docs/examples/experiments/hold_slip.py`, which doubts no sensor), with a shaft of enough and one
# of too little damping. The swing grows below the limit drawn above and dies above it; far below it
# grows until the wheelset sticks at every swing.


def start(damping):
    unit = rg.load("start_leaves").with_({"train": "emu_four_car", "rail": {"condition": "dry"}})
    described = unit.with_(
        {
            "train.traction.driveline": {
                "stiffness": STIFFNESS,
                "damping": damping,
                "motor_share": SHARE,
            },
            "train.traction.force": 900e3,
            "train.traction.power": 40e6,
            "wsp": {"controller": "../examples/experiments/hold_slip.py"},
            "run": {
                "speed": 0.0,
                "demand": "none",
                "drive": 1.0,
                "duration": 9.0,
                "step": 0.002,
                "trace": 0.002,
            },
        }
    )
    return rg.simulate(described).data.isel(run=0, axle=-1)


enough, too_little = start(2.5e3), start(0.2e3)

# %%
figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(8, 9), layout="constrained")
top.plot(slips, least / 1e3)
top.set(xlabel="slip speed, m/s", ylabel="least damping, kN·m·s/rad")
for data, colour, name in (
    (too_little, "tab:red", "0.2 kN·m·s/rad"),
    (enough, "tab:blue", "2.5 kN·m·s/rad"),
):
    time = data["time"]
    middle.plot(time, data["driveline_torque"] / 1e3, color=colour, lw=0.8, label=name)
    spin = data["wheel_speed"] - data["train_speed"]
    bottom.plot(time, spin, color=colour, lw=0.8, label=name)
middle.set(xlim=(4.0, 9.0), ylabel="torque of the shaft, kN·m")
bottom.set(xlim=(4.0, 9.0), ylim=(-0.5, 4.0), xlabel="time, s", ylabel="spin of the wheelset, m/s")
middle.legend(loc="upper left")
for axes in (top, middle, bottom):
    axes.grid(alpha=0.3)

# %%
# Both shafts have the same natural frequencies: the motor on an adhering wheelset, and motor
# against a wheelset that spins.

motor, wheelset = SHARE * ROTATING, (1 - SHARE) * ROTATING
stiff = STIFFNESS / RADIUS**2
adhering = np.sqrt(stiff / motor) / (2 * np.pi)
spinning = np.sqrt(stiff * (1 / motor + 1 / wheelset)) / (2 * np.pi)
print(f"adhering {adhering:.1f} Hz, spinning {spinning:.1f} Hz")
late = enough["time"].values > 7.0
swings = [float(np.std(one["driveline_torque"].values[late])) for one in (enough, too_little)]
print(f"standard deviation of the torque {swings[0] / 1e3:.2f} and {swings[1] / 1e3:.1f} kN·m")

assert round(adhering, 1) == 20.4
assert round(spinning, 1) == 37.3
assert round(least_damping(SLIP) / 1e3, 1) == 1.3
assert swings[1] > 10 * swings[0]
plt.show()
