"""
Rails that sliding cleans, and rails that it does not
=====================================================

On a rail washed with water and detergent each wheel that slides rubs some of the film off, so the
wheels behind find a better rail. On leaves they do not. The same train at the same speed shows the
difference along the train.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg

scenario = rg.load("leaves_160")
runs = {
    name: rg.simulate(scenario.with_({"rail.condition": condition}))
    for name, condition in {"leaves": "leaves", "detergent": "water_detergent"}.items()
}

# %%
# Adhesion used by each axle, averaged over the time above 30 km/h:

figure, axes = plt.subplots(figsize=(8, 4), layout="constrained")
for name, run in runs.items():
    fast = run.data["train_speed"] > 30 / 3.6
    used = run.data["adhesion_used"].where(fast).mean("time").isel(run=0)
    axes.plot(np.arange(1, used.size + 1), used, "o-", label=name)
axes.set(xlabel="Axle, counted from the front", ylabel="Mean adhesion used", ylim=(0, None))
axes.grid(alpha=0.3)
axes.legend()
plt.show()

# %%
# What the train leaves behind on the rail:

for name, run in runs.items():
    cells = run.data.isel(run=0)
    ran_over = cells["rail_energy"] > 0
    before = float(cells["rail_friction_before"].where(ran_over).mean())
    after = float(cells["rail_friction_after"].where(ran_over).mean())
    print(f"{name:10} friction {before:.3f} before, {after:.3f} behind the train")
