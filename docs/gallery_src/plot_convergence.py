"""
The order of the integration
============================

Each tick is integrated with one full and two half steps of a linearly implicit method, combined to
second order: half the step, a quarter of the error. Here is the error of the stopping distance of a
train over the step, on a dry rail, where wheels roll, and on a slippery one without protection,
where they slide and lock.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg

STEPS = np.array([0.010, 0.005, 0.002, 0.001])


def distance(condition, step):
    """Stopping distance with this step."""
    changes = {"rail.condition": condition, "run.step": float(step), "wsp.controller": "none"}
    result = rg.simulate(rg.load("en14531_100").with_(changes))
    return float(result.data["stopping_distance"][0])


def errors(condition):
    """Relative errors, against the value that the two finest steps extrapolate to."""
    distances = np.array([distance(condition, step) for step in STEPS])
    limit = distances[-1] + (distances[-1] - distances[-2]) / 3
    return np.abs(distances - limit) / limit


figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
for condition in ("dry", "low"):
    found = errors(condition)
    order = np.polyfit(np.log(STEPS), np.log(found), 1)[0]
    axes.loglog(1e3 * STEPS, found, "o-", label=f"{condition}, order {order:.1f}")
    print(f"{condition:4} order {order:.2f}, error at 10 ms {found[0]:.1e}")
axes.loglog(1e3 * STEPS, found[0] * (STEPS / STEPS[0]) ** 2, "k:", label="second order")
axes.set(xlabel="Step, ms", ylabel="Relative error of the stopping distance")
axes.grid(alpha=0.3, which="both")
axes.legend()
plt.show()
