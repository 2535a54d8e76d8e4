"""
ETCS supervision against ERA's tool
===================================

When ETCS tells the driver to brake, warns, and brakes itself: curves of two trains before a stop at
7 km, with points stored in ERA's braking curves tool v3.0 (published by the openETCS project).
"""

# %%
# The left train is described by its decelerations (gamma): 1 m/s² on a line with gentle gradients.
# The right one, a freight train, is described by its braked weight of 150 %, from which the
# conversion of SUBSET-026 makes steps of deceleration. The emergency brake's curve is multiplied by
# a factor below 1, and its slow brake (10.6 s) puts the interventions far ahead of the curve.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.control.etcs.supervision import supervision_limits
from railgrip.report.supervision_figure import LOOKS
from railgrip.scenario.supervision import SupervisionCase

GAMMA = {
    "train": {"length": "600 m", "emergency": [{"value": 1.0}], "service": [{"value": 1.0}],
              "emergency_time": "2.5 s", "service_time": "2.5 s"},
    "gradient": [{"at": 0, "value": 0}, {"at": "4 km", "value": "2 ‰"},
                 {"at": "6 km", "value": "-1 ‰"}, {"at": "6.5 km", "value": "-2 ‰"}],
}  # fmt: skip
LAMBDA = {
    "train": {"length": "700 m", "braked_weight": 150, "position": "freight P"},
    "national": {"kv_freight": [{"value": 0.97}], "kr": [{"value": 1.0}], "kt": 1.0},
}
CURVES = ("ebd", "sbd", "ebi", "sbi1", "sbi2", "warning", "permitted", "indication")
PUBLISHED = {
    "gamma": [1002.073, 1002.073, 1113.184, 1002.073, 1113.184, 1202.073, 1290.962, 1513.184],
    "lambda": [898.816, 983.736, 1371.260, 983.736, 1371.260, 1460.149, 1549.038, 2345.127],
}

speeds = np.linspace(30.0, 160.0, 131) / 3.6
figure, panels = plt.subplots(1, 2, figsize=(12, 4.6), layout="constrained", sharey=True)
for axes, (name, described) in zip(panels, {"gamma": GAMMA, "lambda": LAMBDA}.items(), strict=True):
    case = SupervisionCase.model_validate({**described, "target": {"at": "7 km"}})
    limits = supervision_limits(
        case.supervised_train(), case.supervised_track(), case.supervised_target(), speeds
    )
    found = [float(getattr(limits, curve)[-1]) for curve in CURVES]
    worst = np.max(np.abs(np.array(found) - PUBLISHED[name]))
    print(f"{name}: at 160 km/h within {100 * worst:.0f} cm of ERA's tool")
    assert worst < 0.25
    for curve, (colour, line, words) in LOOKS.items():
        if np.isfinite(getattr(limits, curve)).any():
            axes.plot(-getattr(limits, curve), 3.6 * speeds, line, color=colour, label=words)
    axes.plot(-np.array(PUBLISHED[name]), [160.0] * 8, "k.", ms=7, label="ERA's tool, 160 km/h")
    axes.set(xlabel="Distance to the target, m", title=f"{name}, {case.train.length:g} m")
panels[0].set_ylabel("Speed, km/h")
panels[0].legend(loc="lower left", fontsize=7.5)

# %%
# How much the supervision costs can be read off: where the driver must have begun to brake
# (permitted speed) against where the brake itself needs to begin (EBD).

assert found[CURVES.index("permitted")] / found[0] > 1.7
begin, needed = found[CURVES.index("permitted")], found[0]
print(
    f"The freight train must brake {begin:.0f} m before the stop; its brake needs {needed:.0f} m."
)
