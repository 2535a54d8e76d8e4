"""
Coasting against the optimum
============================

How much of what a little more time can save does a rule of 1976 save, on a real line?
"""

# %%
# Fribourg to Bern with a FLIRT, without slip. Flat out; the coasting-initiation rule with flatter
# and flatter curves; the rule tuned to 5 % more time; and the optimum. Left: speed over distance.
# Right: energy over time.

import matplotlib.pyplot as plt

from railgrip.campaign.driving import driven
from railgrip.report.plots.journey import draw_speeds, draw_trade_off
from railgrip.scenario.journey import Journey

journey = Journey(
    train="flirt_tpf",
    line="fribourg_bern",
    supplement=0.05,
    coasting={"coasting_deceleration": 0.1},
)
found = driven(journey, tune=True)

figure, (left, right) = plt.subplots(
    1, 2, figsize=(12, 4.6), width_ratios=(3, 2), layout="constrained"
)
draw_speeds(left, journey, {way.name: (way.position, way.speed) for way in found.ways})
draw_trade_off(right, found.curves)
tuned = found.ways[2]
right.plot(tuned.running_time / 60, tuned.energy["pantograph"] / 3.6e6, "k*", ms=12, label="tuned")
right.legend(frameon=False)

for row in found.summary():
    print("  ".join(f"{cell:>18}" for cell in row))

# %%
# The rule saves where it begins to coast before a lower limit and before the stop; it cannot choose
# a lower cruising speed, and does not know the gradient. Tuned, it still makes nine tenths of the
# saving here. No rule may lie below the optimum of its own time.

assert 0.85 < tuned.share < 1.0
assert all(way.share <= 1.0005 for way in found.ways[1:])
assert tuned.energy["pantograph"] < 0.8 * found.ways[0].energy["pantograph"]
