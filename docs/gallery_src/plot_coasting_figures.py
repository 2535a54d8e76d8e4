"""
Coasting-initiation curves: figures 1 and 2 of the source
=========================================================

Helmut Übel's patent of 1976 (ES 100 730) draws what a curve below the braking curve does. Here its
two figures, driven by a train, with the points K1 to K9. The law can be had as formulas or as the
circuit of figure 3.
"""

# %%
# **Figure 1.** A train accelerates from P1 (F). Without the law it would pull up to the braking
# curve B at K2. With it, traction ends where F meets the coasting-initiation curve (ALK) at K1; the
# train meets B later and slower, at K3. **Figure 2.** Two targets follow one another, with straight
# curves: a lower speed from P4 on, a stop at P6.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.control.coasting.coasting_circuit import CoastingCircuit
from railgrip.control.coasting.coasting_law import AnnouncedTarget, CoastingLaw
from railgrip.control.coasting.coasting_parameters import CoastingParameters
from railgrip.control.etcs.steps import Steps, constant
from railgrip.laboratory.coasting_run import Driver
from railgrip.laboratory.point_train import PointTrain

TRAIN = PointTrain(200e3, 0.06, 150e3, 2.5e6, (3e3, 40.0, 7.0), 0.6)
LAST = 5000.0
CIRCUIT = CoastingCircuit(
    r1=80e3, r2=10e3, r3=10e3, r4=1e3, r9=150e3, distance_scale=0.01, speed_scale=0.1, supply=15.0
)


def drive(law, limits):
    return [
        Driver(TRAIN, law, limits, LAST, with_coasting=on).run(spacing=1.0) for on in (True, False)
    ]


def curves(axes, law, targets, begin):
    for target in targets:
        at = np.linspace(begin, target.position, 400)
        axes.plot(at, [3.6 * law.braking_speed(x, [target]) for x in at], "C3", lw=0.9)
        axes.plot(at, [3.6 * law.coasting_speed(x, [target]) for x in at], "C0--", lw=0.9)


def mark(axes, points):
    for name, change in points.items():
        axes.plot(change.position, 3.6 * change.speed, "ko", ms=4)
        axes.annotate(
            name, (change.position, 3.6 * change.speed), (4, 5), textcoords="offset points"
        )


parabola = CoastingLaw(CoastingParameters(0.7, coasting_deceleration=0.18))
straight = CoastingLaw(
    CoastingParameters(
        0.7, shape="straight", distance_gain=CIRCUIT.distance_gain, hysteresis=CIRCUIT.hysteresis
    )
)
print(f"The circuit: k1 = {CIRCUIT.distance_gain:.3f} 1/s, Δ = {CIRCUIT.hysteresis:.1f} m/s")

figure, (one, two) = plt.subplots(1, 2, figsize=(12, 4.4), layout="constrained", sharey=True)
first, flat_1 = drive(parabola, constant(60.0))
curves(one, parabola, [AnnouncedTarget(LAST)], 0.0)
one.plot(flat_1.position, 3.6 * flat_1.speed, "0.6", lw=1, label="without the law")
one.plot(first.position, 3.6 * first.speed, "k", label="F, with the law")
mark(one, {"K1": first.at("coasting"), "K2": flat_1.at("braking"), "K3": first.at("braking")})

limits = Steps((0.0, 3000.0), (120 / 3.6, 60 / 3.6))
second, flat_2 = drive(straight, limits)
targets = [AnnouncedTarget(3000.0, 60 / 3.6), AnnouncedTarget(LAST)]
curves(two, straight, targets, 1000.0)
two.plot(flat_2.position, 3.6 * flat_2.speed, "0.6", lw=1, label="without the law")
two.plot(second.position, 3.6 * second.speed, "k", label="F, with the law")
mark(two, {
    "K4": second.at("coasting"), "K5": flat_2.at("braking"), "K6": second.at("braking"),
    "P4": second.at("target"), "K7": second.at("coasting", 1),
    "K8": flat_2.at("braking", 1), "K9": second.at("braking", 1),
})  # fmt: skip
for axes, title in ((one, "Figure 1: parabolic ALK"), (two, "Figure 2: straight ALK, two targets")):
    axes.plot([], [], "C3", lw=0.9, label="B, braking curve")
    axes.plot([], [], "C0--", lw=0.9, label="ALK")
    axes.set(xlabel="Distance, m", title=title, ylim=(0, 190), xlim=(0, 5100))
one.set_ylabel("Speed, km/h")
one.legend(loc="upper right", fontsize=8)

# %%
# Each K lies on its curve, and the points come in the source's order.

for run, law, names in ((first, parabola, ("coasting", "braking")),):
    k1, k3 = (run.at(name) for name in names)
    assert abs(law.above_coasting(k1.position, k1.speed, [AnnouncedTarget(LAST)])) < 1e-6
    assert abs(law.above_braking(k3.position, k3.speed, [AnnouncedTarget(LAST)])) < 1e-6
k1, k2, k3 = first.at("coasting"), flat_1.at("braking"), first.at("braking")
assert k1.position < k2.position < k3.position
assert k3.speed < k2.speed
k4, k5, k6 = second.at("coasting"), flat_2.at("braking"), second.at("braking")
k7, k8, k9 = second.at("coasting", 1), flat_2.at("braking", 1), second.at("braking", 1)
assert k4.position < k5.position < k6.position < second.at("target").position
assert second.at("target").position < k7.position < k8.position < k9.position
assert abs(k4.speed - 120 / 3.6) < 1e-6
assert abs(k7.speed - 60 / 3.6) < 1e-6
for target, k in zip(targets, (k4, k7), strict=True):
    assert abs(k.speed - CIRCUIT.curve(target.position - k.position, target.speed)) < 1e-6

told = {"1": (0.45, 0.54, 0.08), "2": (0.10, 0.13, 0.02)}
for name, run, flat in (("1", first, flat_1), ("2", second, flat_2)):
    saved = 1.0 - run.energy / flat.energy
    later = run.changes[-1].time / flat.changes[-1].time - 1.0
    braked = 1.0 - run.brake_work / flat.brake_work
    print(f"Figure {name}: energy −{saved:.0%}, brake work −{braked:.0%}, time +{later:.0%}")
    assert np.allclose((saved, braked, later), told[name], atol=0.006)
