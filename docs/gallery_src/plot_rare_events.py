"""
One sample, ten confidence levels
=================================

Sixteen equal brakes, each failed once in a thousand stops, each force with a spread of 5 %: how
much of the nominal force is there with 99.9999999 % confidence? The distribution has a mode for
each number of failed brakes, and a closed form to compare with.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np
from scipy.special import comb, ndtr

from railgrip.campaign.rare.estimate import rare_quantiles
from railgrip.campaign.rare.failures import failure_states

N, Q, SPREAD = 16, 1e-3, 0.05


def force(normals, failed):
    """Mean force of the brakes that work; the nominal one is 1."""
    return ((1.0 + SPREAD * normals) * ~failed).mean(axis=1)


found = rare_quantiles(force, N, failure_states([Q] * N, ["brake"] * N), owner=range(N))

# %%
# The closed form sums over the number of failed brakes.

k = np.linspace(0.7, 1.06, 400)
j = np.arange(N)[:, None]
weight = comb(N, j) * Q**j * (1 - Q) ** (N - j)
exact = (weight * ndtr((k - (N - j) / N) / (SPREAD * np.sqrt(N - j) / N))).sum(axis=0)

curve = found.curve
figure, axes = plt.subplots(figsize=(7, 4.8), layout="constrained")
axes.semilogy(curve.bound, curve.probability, label=f"{found.runs} runs, pilots included")
axes.semilogy(k, exact, "k:", label="closed form")
values = np.array([q.value for q in found.quantile])
reach = np.abs([[q.low_all, q.high_all] for q in found.quantile] - values[:, None]).T
axes.errorbar(values, found.probability, xerr=reach, fmt="o", color="C0", markersize=4, capsize=3,
              label="95 %, all ten levels at once")  # fmt: skip
for level, (p, q) in enumerate(zip(found.probability, found.quantile, strict=True)):
    axes.annotate(f"EBCL {level}", (q.value, p), xytext=(-6, 4), textcoords="offset points",
                  ha="right", fontsize=8)  # fmt: skip
axes.set(
    xlim=(0.7, 1.06), ylim=(2e-10, 2), xlabel="Force over nominal force",
    ylabel="Probability of less",
)  # fmt: skip
axes.grid(alpha=0.3)
axes.legend(loc="lower right")
plt.show()

# %%
# What the page states, asserted: all ten closed values lie within the simultaneous intervals, and
# EBCL 9 is known to one thousandth.

CLOSED = [
    0.99975, 0.98289, 0.94141, 0.91825, 0.88657, 0.85856, 0.84376, 0.80208, 0.78800, 0.75146,
]  # fmt: skip
for quantile, value in zip(found.quantile, CLOSED, strict=True):
    assert quantile.low_all <= value <= quantile.high_all
last = found.quantile[9]
assert 0.5 * (last.high - last.low) < 1e-3
print(f"EBCL 9: {last.value:.4f}, 95 % between {last.low:.4f} and {last.high:.4f}")
