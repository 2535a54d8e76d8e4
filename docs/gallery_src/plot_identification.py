"""
A pad found in measured stops
=============================

Eighty stops of a known pad, measured badly: noise of 3 % that is correlated within a stop, an
offset of 3 % per stop, a temperature sensor that lags by 2 s, outliers. The line is what
identification finds, the dashes are the truth.
"""

# %%
import matplotlib.pyplot as plt
import numpy as np

from railgrip.laboratory.pad_fit import identify_pad
from railgrip.laboratory.pad_fit.synthetic import (
    ORGANIC_POINTS,
    Programme,
    organic,
    synthetic_stops,
)

found = identify_pad(synthetic_stops(organic, Programme(stops=80), seed=1))
labels = {"temperature": "Disc temperature, °C", "speed": "Rubbing speed, m/s",
          "clamp_force": "Clamp force, kN"}  # fmt: skip
figure, panels = plt.subplots(1, 3, figsize=(10, 3.4), sharey=True, layout="constrained")
for axes, (name, words) in zip(panels, labels.items(), strict=True):
    scale = 1e-3 if name == "clamp_force" else 1.0
    reference = found.plan.reference[name]
    placed = found.fit.law.functions[name]
    x = np.linspace(placed.low, placed.high, 300)
    true = np.interp(x, *zip(*ORGANIC_POINTS[name], strict=True))
    true /= np.interp(reference, *zip(*ORGANIC_POINTS[name], strict=True))
    curve = np.interp(x, *zip(*found.points[name], strict=True))
    axes.plot(x * scale, curve, lw=2, label="found")
    axes.plot(x * scale, true, "k--", lw=1, label="truth")
    axes.set_xlabel(words)
    assert np.abs(curve - true).max() < 0.02
panels[0].set_ylabel("Factor, 1 at the reference")
panels[0].legend()

# %%
# Nowhere do the functions miss the truth by more than 0.02. The interval of the reference friction
# is about twice as wide as one that ignores how samples of a stop hang together:

clustered, naive = found.parameters[0], found.naive[0]
print(f"{clustered.value:.4f}: {clustered.low:.4f} to {clustered.high:.4f}")
print(f"as if independent: {naive.low:.4f} to {naive.high:.4f}")
assert clustered.high - clustered.low > 1.5 * (naive.high - naive.low)
assert abs(found["temperature_lag"].value - 2.0) < 1.0
