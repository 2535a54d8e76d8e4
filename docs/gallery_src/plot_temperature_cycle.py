"""
Saw-tooth of the wheel, pulses of the rail
==========================================

A point of the tread is heated once per revolution, a point of the rail once per passing wheel:
figures 2 and 3 of the patent on temperature-controlled adhesion (EP 2 231 448), here with numbers.
"""

# %%
# A wheel of 0.92 m brakes from 40 m/s with a slip that gives it 15 kW of friction heat. Each
# passage through the contact lasts a third of a millisecond and adds a tooth of some ninety kelvin;
# between them the surface cools, and a mean grows that the next tooth stands on.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.core.formulas.flash_temperature import (
    STEEL_ERTZ_2002,
    effusivity,
    flash_conductance,
    flash_temperature,
)
from railgrip.core.formulas.linear_temperature_rise import linear_factor, linear_rise
from railgrip.core.formulas.wheel_heat import ILLUSTRATIVE_WHEEL
from railgrip.laboratory.heat_pulses import rail_pulses, wheel_pulses
from railgrip.laboratory.temperature_cycle import pulse_rises
from railgrip.laboratory.wheel_bulk import wheel_bulk

BETA = effusivity(STEEL_ERTZ_2002)
LENGTH, WIDTH = 11.8e-3, 21.1e-3

time = np.linspace(0.0, 20.0, 2001)
speed = 40.0 - 1.5 * time
heat = 15e3 * speed / 40.0
pulses = wheel_pulses(time, speed, heat, np.pi * 0.92, LENGTH, WIDTH)
long = np.unique(np.concatenate([pulses.start, pulses.end, np.linspace(0.0, 20.0, 4001)]))
close = np.linspace(0.0, 0.5, 20001)

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4), layout="constrained")
left.plot(close, pulse_rises(pulses, BETA, close), lw=0.8)
left.set(xlabel="Time, s", ylabel="Rise of a point of the tread, K", title="The first revolutions")
rise = pulse_rises(pulses, BETA, long)
peaks = pulse_rises(pulses, BETA, pulses.end[:-1])
valleys = pulse_rises(pulses, BETA, pulses.start[1:])
right.fill_between(pulses.end[:-1], valleys, peaks, alpha=0.4, label="saw-tooth")
right.plot(pulses.start[1:], valleys, label="before each contact")
bulk = wheel_bulk(ILLUSTRATIVE_WHEEL, time, contact_heat=heat, chill=82.0)
right.plot(time, bulk.rim - 20.0, "k--", label="mean of the rim (two nodes)")
right.set(xlabel="Time, s", ylabel="Rise, K", title="The whole stop")
right.legend()

period = np.diff(pulses.start[:2])[0]
print(
    f"{pulses.start.size} revolutions; the first takes {1e3 * period:.1f} ms, "
    f"of which {1e3 * pulses.duration[0]:.2f} ms are contact; tooth {peaks[0]:.0f} K"
)
assert abs(period - np.pi * 0.92 / 40.0) < 2e-3 * period
assert valleys.max() < 0.8 * peaks.max()

# %%
# A point of the rail under a four-car train, sixteen wheels at 25 m/s, each leaving 10 kW in the
# rail: sharp pulses on a remainder that the length of a train hardly lets fade. The second wheel of
# a bogie finds the rail warmer than the first.

bogies = np.array([3.0, 21.0, 29.0, 46.0, 54.0, 71.0, 79.0, 97.0])
places = np.sort(np.concatenate([bogies - 1.25, bogies + 1.25]))
under = rail_pulses(places - places[0], 25.0, 10e3, LENGTH, WIDTH)
instants = np.unique(np.concatenate([under.start, under.end, np.linspace(0.0, 6.0, 6001)]))
figure, axes = plt.subplots(figsize=(9, 3.6), layout="constrained")
axes.plot(instants, pulse_rises(under, BETA, instants), lw=0.9)
axes.set(xlabel="Time since the first wheel, s", ylabel="Rise of a point of the rail, K")
after = pulse_rises(under, BETA, under.end)
assert (after[1::2] > after[::2]).all()
assert under.start.size == 16

# %%
# The patent's law dT = k_T P t/A is linear in the time of contact; a half-space warms with its
# square root. Matched at 20 m/s, the law is right there only: it permits too little power at lower
# speeds and too much at higher ones.

speeds = np.linspace(2.0, 60.0, 117)
a, b = LENGTH / 2, WIDTH / 2
limit = 100.0
physical, linear = [], []
matched = flash_temperature(*(flash_conductance(STEEL_ERTZ_2002, a, b, 20.0),) * 2, 1.0).rise
uniform = linear_rise(
    linear_factor(0.5, BETA, LENGTH / 20.0), 1.0, LENGTH * WIDTH, LENGTH / 20.0
)  # fmt: skip
factor = linear_factor(0.5, BETA, LENGTH / 20.0) * matched / uniform
for v in speeds:
    conductance = flash_conductance(STEEL_ERTZ_2002, a, b, v)
    physical.append(limit * 2.0 * conductance)
    linear.append(limit / linear_rise(factor, 1.0, LENGTH * WIDTH, LENGTH / v))
physical, linear = np.array(physical), np.array(linear)
figure, axes = plt.subplots(figsize=(8, 4), layout="constrained")
axes.plot(speeds, physical / 1e3, label="half-space")
axes.plot(speeds, linear / 1e3, "--", label="linear law, matched at 20 m/s")
axes.set(xlabel="Speed, m/s", ylabel="Friction power for a rise of 100 K, kW")
axes.legend()
ratio = linear / physical
assert abs(np.interp(20.0, speeds, ratio) - 1.0) < 1e-3
assert abs(np.interp(45.0, speeds, ratio) - np.sqrt(45.0 / 20.0)) < 0.01
plt.show()
