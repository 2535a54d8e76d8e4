"""
A fast train behind a slow one
==============================

The patent's own example: a train with much traction runs after a slower one, accelerates whenever
its authority is renewed and brakes when it ends. Coasting smooths that; how much depends on the
curve and on how often the authority is renewed.
"""

# %%
# The leader runs at 80 km/h; the follower may run at 140 km/h. Its authority ends 100 m behind the
# leader's rear and is renewed every 10 s.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.control.coasting.coasting_law import CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.control.coasting.moving_authority import moving_authority
from railgrip.control.etcs.steps import constant
from railgrip.laboratory.coasting_run import Driver
from railgrip.laboratory.point_train import PointTrain

FAST = PointTrain(200e3, 0.06, 150e3, 2.5e6, (2.5e3, 30.0, 6.0), 0.7)
SLOW = PointTrain(800e3, 0.04, 200e3, 2.5e6, (10e3, 80.0, 14.0), 0.3)
kwh = 1.0 / 3.6e6

idle = CoastingLaw(CoastingParameters(0.5))
leader = Driver(SLOW, idle, constant(80 / 3.6), 20000.0, with_coasting=False).run(2000.0)
time, kept = np.unique(leader.time, return_index=True)
position = leader.position[kept]


def follow(period, coasting_deceleration, with_coasting=True):
    law = CoastingLaw(CoastingParameters(0.7, coasting_deceleration=coasting_deceleration))
    authority = moving_authority(time, position, length=500.0, margin=100.0, period=period)
    driver = Driver(
        FAST, law, constant(140 / 3.6), 18500.0, authority=authority, with_coasting=with_coasting
    )
    return driver.run(spacing=1.0)


flat, coasting = follow(10.0, 0.4, with_coasting=False), follow(10.0, 0.4)
figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.2), layout="constrained")
left.plot(1e-3 * flat.position, 3.6 * flat.speed, "0.6", lw=0.9, label="accelerates and brakes")
left.plot(1e-3 * coasting.position, 3.6 * coasting.speed, "C0", label="coasts, b_ALK = 0.4 m/s²")
left.plot(1e-3 * leader.position, 3.6 * leader.speed, "k--", lw=0.9, label="leader")
left.set(xlabel="Position, km", ylabel="Speed, km/h", title="Renewed every 10 s")
left.legend(loc="lower center", fontsize=8)

# %%
# The trade-off, as the coasting-initiation curve is laid lower and lower (b_ALK from 0.65 down to
# 0.1 m/s²). Time and energy jump a little: a switching more or less is a matter of chance.

shares = (0.65, 0.5, 0.4, 0.3, 0.2, 0.1)
for number, period in enumerate((10.0, 30.0, 0.0)):
    runs = [follow(period, 0.1, with_coasting=False), *(follow(period, b) for b in shares)]
    words = f"renewed every {period:g} s" if period else "renewed all the time"
    times = [run.changes[-1].time for run in runs]
    right.plot(times, [kwh * run.energy for run in runs], f"C{number}.-", label=words)
    right.plot(times[0], kwh * runs[0].energy, f"C{number}s")
    best = min(runs[1:], key=lambda run: run.energy)
    print(
        f"{words}: {kwh * runs[0].energy:.0f} kWh, {runs[0].switchings} switchings; coasting down "
        f"to {kwh * best.energy:.0f} kWh, {best.switchings} switchings, "
        f"{best.changes[-1].time - times[0]:+.0f} s"
    )
right.set(xlabel="Running time, s", ylabel="Energy of traction, kWh", yscale="log")
right.set_title("Squares: without coasting")
right.set_yticks([40, 60, 100, 200, 300], labels=["40", "60", "100", "200", "300"])
right.minorticks_off()
right.legend(fontsize=8)

print(f"b_ALK = 0.4: {kwh * coasting.energy:.0f} instead of {kwh * flat.energy:.0f} kWh")
assert abs(1.0 - coasting.energy / flat.energy - 0.84) < 0.01
assert abs(1.0 - coasting.brake_work / flat.brake_work - 0.93) < 0.01
assert abs(coasting.changes[-1].time / flat.changes[-1].time - 1.007) < 0.002
assert coasting.switchings <= flat.switchings
