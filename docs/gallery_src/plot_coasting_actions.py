"""
Three actions, claim 3, and the two indicators
==============================================

What the coasting-initiation law can do above its curve, and when it is off.
"""

# %%
# Left: from one stop to the next, 6 km, with each action. Below 40 km/h the law is off, and within
# 1200 m of the station too; there the train pulls again up to the braking curve. Right: where the
# brake is weak the braking curve is flat, and the curve is raised at its high-speed end (claim 3)
# so that a fast train is not slowed too early.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.control.coasting.coasting_law import AnnouncedTarget, CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.control.etcs.steps import constant
from railgrip.laboratory.coasting_run import Driver
from railgrip.laboratory.point_train import PointTrain

TRAIN = PointTrain(200e3, 0.06, 150e3, 2.5e6, (3e3, 40.0, 7.0), 0.6)
BASE = CoastingParameters(
    0.7, coasting_deceleration=0.12, hysteresis=1.5, reduced_share=0.15, light_deceleration=0.05
)
RULES = BASE._replace(least_speed=40 / 3.6, station_distance=1200.0)


def drive(parameters, with_coasting=True):
    driver = Driver(
        TRAIN, CoastingLaw(parameters), constant(140 / 3.6), 6000.0, with_coasting=with_coasting
    )
    return driver.run(spacing=1.0)


runs = {"flat out": drive(RULES, with_coasting=False)}
runs |= {a: drive(RULES._replace(action=a)) for a in ("cut", "reduced", "light braking")}

figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.4), layout="constrained")
for name, run in runs.items():
    left.plot(run.position, 3.6 * run.speed, label=name)
    print(
        f"{name:14} {run.energy / 3.6e6:5.1f} kWh, {run.brake_work / 3.6e6:5.1f} kWh braked, "
        f"{run.changes[-1].time:5.1f} s, {run.switchings} switchings"
    )
left.axvspan(4800.0, 6000.0, color="0.92", zorder=0, label="station near: off")
left.axhspan(0.0, 40.0, color="0.96", zorder=0, label="slow: off")
left.set(xlabel="Distance, m", ylabel="Speed, km/h", title="Three actions", xlim=(0, 6100))
left.legend(loc="lower center", fontsize=8)

weak = CoastingParameters(0.25, coasting_deceleration=0.1, flat_braking=0.4, knee_speed=20.0)
stop = [AnnouncedTarget(6000.0)]
at = np.linspace(0.0, 6000.0, 400)
law = CoastingLaw(weak)
right.plot(at, [3.6 * law.braking_speed(x, stop) for x in at], "C3", label="braking curve")
for lift, line in ((0.0, "C0--"), (0.3, "C0-."), (0.6, "C0-")):
    raised = CoastingLaw(weak._replace(lift=lift))
    right.plot(
        at, [3.6 * raised.coasting_speed(x, stop) for x in at], line, label=f"k_h = {lift:g}"
    )
    assert all(raised.coasting_speed(x, stop) <= law.braking_speed(x, stop) for x in at)
right.axhline(72.0, color="0.7", lw=0.8)
right.set(xlabel="Distance, m", ylabel="Speed, km/h", title="Claim 3: raised above 72 km/h")
right.legend(fontsize=8)

energy = {name: run.energy for name, run in runs.items()}
time = {name: run.changes[-1].time for name, run in runs.items()}
assert energy["cut"] < energy["reduced"] < energy["flat out"]
assert time["flat out"] < time["reduced"] < time["cut"] < time["light braking"]

# %%
# Light braking takes longer than cutting, and here it costs energy too: what it brakes away must be
# bought again at the end.

assert energy["light braking"] > energy["cut"]

# %%
# The station rule, with the train cutting: it gives time back for energy.

rule = {}
for name, parameters in {
    "no rule": BASE,
    "pulls again": RULES,
    "holds its speed": RULES._replace(at_station="hold"),
}.items():
    run = drive(parameters)
    rule[name] = np.array([run.energy / 3.6e6, run.changes[-1].time])
    print(f"{name:16} {rule[name][0]:5.2f} kWh, {rule[name][1]:6.1f} s")
assert np.allclose(rule["pulls again"] - rule["no rule"], [10.0, -2.4], atol=0.1)
assert np.allclose(rule["holds its speed"] - rule["no rule"], [1.7, -0.5], atol=0.1)

# %%
# The log has every change with the two indicators: R, the law is ready; A, it acts.

for change in runs["light braking"].changes:
    lamps = ("R" if change.is_ready else "-") + ("A" if change.is_acting else "-")
    print(
        f"{change.time:6.1f} s {change.position:7.1f} m {3.6 * change.speed:6.1f} km/h {lamps} "
        f"{change.event} → {change.mode}"
    )
