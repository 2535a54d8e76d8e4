"""
Two observers of the force between wheel and rail
=================================================

A controller cannot measure what the rail gives; it sees what motor and brake apply and how the
wheel's speed changes. The window of f8 takes the momentum balance over 100 ms; the Kalman filter
weighs each new speed against a model in which the force walks at random. Here both watch a motored
axle that pulls away from 60 km/h on leaves of changing friction, under the peak-seeking control.
The plant tells the truth.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg
from railgrip.control.adhesion_kalman import kalata_gains, observe_by_kalman
from railgrip.control.adhesion_window import observe_friction
from railgrip.control.conventional_state import DYNAMIC, SPEED
from railgrip.control.state_layout import axle_base, state_size
from railgrip.control.temperature_state import FRICTION, MASS

DT = 0.01
AXLE = 0

field = {"mean": 0.05, "spread": 0.02, "correlation_length": "8 m", "seed": 4}
start = rg.load("start_leaves").with_(
    {
        "run.trace": DT,
        "run.speed": "60 km/h",
        "run.demand": "none",
        "rail.random": field,
        "wsp.controller": "peak_seeking_traction",
    }
)
run = rg.simulate(start).data.isel(run=0)
mass = start.train.axles()[AXLE].axle.rotating_mass
time = run.time.values
speed = run.measured_speed.values[AXLE]
applied = -run.dynamic_force.values[AXLE]
truth = run.contact_force.values[AXLE]

# %%
# Both get the same: the measured speed and the motor's force. The effort has built up after 5 s.

begin = int(5.0 / DT)
window = np.zeros(len(time))
kalman = np.zeros(len(time))
state = np.zeros(state_size(1))
first = axle_base(0)
state[first + MASS] = mass
index = 60e3 / mass * DT**2 / 0.02  # the shipped drift of the force and noise of the speed
believed = (speed[begin], applied[begin])
for i in range(begin, len(time)):
    state[first + SPEED], state[first + DYNAMIC] = speed[i], -applied[i]
    observe_friction(state, 1, i - begin, 10, DT)
    window[i] = state[first + FRICTION]
    believed = observe_by_kalman(speed[i], *believed, applied[i - 1], mass, index, DT)
    kalman[i] = believed[1]

# %%
# How late they are: the shift at which each looks most like the truth, and the error that is left.


def lag_and_error(found):
    late = slice(begin + 200, len(time) - 50)
    errors = []
    for shift in range(30):
        moved = truth[late.start - shift : late.stop - shift]
        errors.append(np.sqrt(np.mean((found[late] - moved) ** 2)))
    return DT * int(np.argmin(errors)), errors[0]


lags = {"window (f8)": lag_and_error(window), "Kalman": lag_and_error(kalman)}
alpha, beta = kalata_gains(index)
for name, (lag, error) in lags.items():
    print(f"{name:12} lag {1e3 * lag:3.0f} ms, rms error {error:4.0f} N")
print(f"theory of the filter on a steady rise: {1e3 * (alpha / beta - 0.5) * DT:.0f} ms")

# Half the window, or the lag of theory; to that come 10 ms of the sensor and up to 20 ms of its
# counting and of the period. Most of the error is lag, and the filter has less of both.
assert 0.05 <= lags["window (f8)"][0] <= 0.08
assert (alpha / beta - 0.5) * DT <= lags["Kalman"][0] <= 0.07
assert lags["Kalman"][1] < lags["window (f8)"][1] < 1300.0

# %%

figure, axes = plt.subplots(figsize=(9, 4))
shown = (time > 20.0) & (time < 26.0)
axes.plot(time[shown], truth[shown] / 1e3, color="black", label="truth (plant)")
axes.plot(time[shown], window[shown] / 1e3, lw=0.9, label="window (f8), 100 ms")
axes.plot(time[shown], kalman[shown] / 1e3, lw=0.9, label="Kalman")
axes.set(xlabel="time, s", ylabel="force of the rail on the axle, kN")
axes.legend()
figure.tight_layout()
