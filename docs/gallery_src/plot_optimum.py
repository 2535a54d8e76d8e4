"""
The least energy for a time
===========================

A train that has a few seconds to spare can save a great deal. Here is a real line, driven flat out
and with the least energy that a supplement of time allows.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

from railgrip.campaign.optimum.timetable import optimum
from railgrip.campaign.optimum.trade_off import capped_curve, optimal_curve
from railgrip.engine.journey.drive import drive
from railgrip.report.plots.journey import draw_speeds, draw_trade_off
from railgrip.scenario.journey import Journey

journey = Journey(train="flirt_tpf", line="fribourg_bern")
fast = drive(journey)
best = optimum(journey, 1.05 * fast.running_time)

# %%
# Fribourg–Bern with a FLIRT, under the speed limits and over the altitude. With 5 % more time the
# optimum cruises lower where the limit is high, and coasts before each lower limit and the stop.

figure, axes = plt.subplots(figsize=(10, 4.8), layout="constrained")
runs = {
    "flat out": (fast.trace["position"], fast.trace["speed"]),
    "optimum, +5 %": (best.position, best.speed),
}
draw_speeds(axes, journey, runs)
plt.show()

saved = 1 - best.energy / fast.energy["pantograph"]
print(f"flat out {fast.running_time:.1f} s, {fast.energy['pantograph'] / 3.6e6:.1f} kWh")
print(f"optimum  {best.running_time:.1f} s, {best.energy / 3.6e6:.1f} kWh, {saved:.1%} less")
assert 0.22 < saved < 0.27

# %%
# Energy over time. The first seconds save most: at the least time the slope is without bound. The
# other curve is the simplest way of being slower, full power up to a lower top speed; for the same
# time it takes more at every point.

curve = optimal_curve(journey)
capped = capped_curve(journey, curve[0].max())
figure, axes = plt.subplots(figsize=(7, 4.4), layout="constrained")
draw_trade_off(axes, {"optimum": curve, "full power to a lower top speed": capped})
plt.show()

at_same_time = np.interp(capped[0][1:-1], curve[0], curve[1])
assert (at_same_time < capped[1][1:-1]).all()
first_percent = 1 - curve[1][1] / curve[1][0]
last_five = (curve[1][-2] - curve[1][-1]) / curve[1][0]
print(f"the first 1 % of time saves {first_percent:.1%}, the last 5 % {last_five:.1%}")
assert first_percent > 0.09
