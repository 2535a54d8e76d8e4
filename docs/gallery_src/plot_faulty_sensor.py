"""
A speed sensor that reads too fast
==================================

The reference speed is never below the fastest believable wheel, so a sensor that reads 5 % too
fast leads it: against that reference all sound wheels slide, and their brakes are released. But
released wheels soon turn with the train. Two of them that agree outvote the leader, and its wheel's
factor is corrected.
"""

# %%
# A stop from 140 km/h on adhesion 0.06 under micro-slip, the narrowest band; the fifth axle's
# sensor begins to read too much after 3 s.

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg

AXLE = 4
scenario = rg.load("leaves_160").with_(
    {
        "rail.condition": "low",
        "run.speed": "140 km/h",
        "run.trace": "10 ms",
        "wsp.controller": "micro_slip",
    }
)
label = scenario.train.axles()[AXLE].label
fault = {"axle": label, "kind": "sensor_scaled", "factor": 1.05, "from": "3 s"}
sound = rg.simulate(scenario)
faulty = rg.simulate(scenario.with_({"fault": [fault]}))
for name, run in (("sound", sound), ("5 % too fast", faulty)):
    print(f"{name:13} {float(run['stopping_distance'][0]):6.0f} m")

# %%
# What the protection believes, and how many of the sixteen brakes stand released for it:

time = faulty["time"].values
reference = faulty["reference_speed"].values[0]
train = faulty["train_speed"].values[0]
told = faulty["measured_speed"].values[0, AXLE]
released = (faulty["brake_cylinder_pressure"].values[0] < 2e4).sum(axis=0)

figure, (speeds, brakes) = plt.subplots(2, 1, sharex=True, figsize=(8, 6), layout="constrained")
speeds.plot(time, 3.6 * told, color="tab:orange", label="as the sensor tells it")
speeds.plot(time, 3.6 * reference, color="tab:blue", label="reference speed")
speeds.plot(time, 3.6 * train, color="black", label="train")
speeds.set(ylabel="Speed, km/h", xlim=(2, 12), ylim=(105, 145))
speeds.legend()
brakes.step(time, released, color="tab:red")
brakes.set(ylabel="Axles without brake", xlabel="Time, s", ylim=(0, 16.5))

# %%
# For about a second all other brakes are released; then the vote is taken, and from there on the
# reference speed is near the train's again. The protection reports the wheel.

after = (time > 15.0) & (train > 5.0)
error = np.abs(reference - train)[after]
report = faulty["wsp_alarm"].values[0, AXLE]
before = np.abs(reference - train)[time < 15.0].max()
print(f"greatest error before {before:.2f} m/s, after {error.max():.2f} m/s")
print(f"reported from {time[np.flatnonzero(report)[0]]:.1f} s on")

assert before > 1.0
assert released[time < 15.0].max() >= 15
assert error.max() < 1.0
assert report[-1] == 3.0
longer = float(faulty["stopping_distance"][0]) / float(sound["stopping_distance"][0])
assert longer < 1.3  # without the vote: a stop several times as long
