"""
The order of the integration
============================

Each tick is integrated with one full and two half steps of a linearly implicit method, combined to
second order. Here is what halving the step changes in the stopping distance of a train, on a dry
rail, where wheels roll, and on a slippery one without protection, where they slide and lock. Each
halving should change a quarter of what the one before changed; no exact distance has to be known
or assumed for that. On slippery rail the order rises towards two; on dry rail the changes are a
tenth of a millimetre, and irregular.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg

STEPS = np.array([20.0, 10.0, 5.0, 2.5, 1.25])  # ms


def distance(condition, step):
    """Stopping distance with this step in ms."""
    changes = {
        "rail.condition": condition,
        "run.step": step / 1e3,
        "wsp.controller": "none",
    }
    result = rg.simulate(rg.load("en14531_100").with_(changes))
    return float(result.data["stopping_distance"][0])


figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
for condition in ("dry", "low"):
    distances = np.array([distance(condition, step) for step in STEPS])
    changes = np.abs(np.diff(distances)) / distances[-1]
    orders = np.log2(changes[:-1] / changes[1:])
    axes.loglog(STEPS[:-1], changes, "o-", label=f"{condition}, mean order {orders.mean():.1f}")
    pairs = ", ".join(f"{order:.2f}" for order in orders)
    print(f"{condition:4} orders {pairs}; halving 10 ms changes {changes[1]:.1e}")
axes.loglog(STEPS[:-1], changes[0] * (STEPS[:-1] / STEPS[0]) ** 2, "k:", label="second order")
axes.set(xlabel="Step that is halved, ms", ylabel="Relative change of the stopping distance")
axes.set_xticks(STEPS[:-1], [f"{step:g}" for step in STEPS[:-1]])
axes.minorticks_off()
axes.grid(alpha=0.3)
axes.legend()
plt.show()
