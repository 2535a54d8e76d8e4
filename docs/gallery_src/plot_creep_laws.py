"""
How adhesion depends on creepage
================================

The force between wheel and rail rises steeply with the first per mille of creepage, has a maximum,
and falls behind it. Where the maximum lies, and how far it falls, decides whether wheel-slide
protection should permit a little slip or a lot of it.
"""

# %%
# One wheel with 50 kN on it, at 100 km/h, on the three rails that Polach's parameters describe:
# dry, wet, and covered with leaves.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005, RailFriction

LEAVES = RailFriction(0.05, 0.40, 0.20, 1.00, 0.40)
LOAD, SLOPE, TRAIN_SPEED = 50e3, 9.1e6, 100 / 3.6

creepage = np.geomspace(1e-4, 1.0, 300)
rails = {"dry": DRY_POLACH_2005, "wet": WET_POLACH_2005, "leaves": LEAVES}
adhesion = {
    name: np.array([polach_2005(rail, LOAD, SLOPE, s * TRAIN_SPEED, s) / LOAD for s in creepage])
    for name, rail in rails.items()
}

figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
for name, curve in adhesion.items():
    peak = int(np.argmax(curve))
    (line,) = axes.semilogx(100 * creepage, curve, label=name)
    axes.plot(100 * creepage[peak], curve[peak], "o", color=line.get_color())
axes.set(xlabel="Creepage, %", ylabel="Adhesion used", ylim=(0, None))
axes.grid(alpha=0.3)
axes.legend()
plt.show()

# %%
# The maxima, and what is left of them when the wheel is locked:

for name, curve in adhesion.items():
    peak = int(np.argmax(curve))
    print(f"{name:7} {curve[peak]:.3f} at {100 * creepage[peak]:5.2f} %, locked {curve[-1]:.3f}")
