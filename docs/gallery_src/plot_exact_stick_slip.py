"""
Stick and slip in the patch
===========================

A wheel that drives or brakes slips in one part of its contact patch and sticks in the other. As
creepage rises, the slip zone grows from the trailing edge, until nothing sticks. The exact solver
(Kalker's half-space theory) shows it cell by cell.
"""

# %%
# One wheel with 100 kN on it, friction 0.3: first longitudinal creepage alone, then with spin, as
# on the inclined tread of a wheel near its flange.

import math

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

from railgrip.contact.rail_friction import RailFriction
from railgrip.contact.rolling_contact import Creepage, rolling_contact
from railgrip.laboratory.exact import solve_exact
from railgrip.laboratory.exact_march import march_exact

contact = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
rail = RailFriction(0.3, 1.0, 0.0, 1.0, 1.0)
LIMIT = 0.3 * contact.load

rising = (0.0005, 0.0015, 0.0030, 0.0045)
rows = [[Creepage(s, 0.0, 0.0) for s in rising], [Creepage(s, 0.0, 0.5) for s in rising]]
cases = [[solve_exact(contact, rail, 20.0, each, grid=(60, 60)) for each in row] for row in rows]
assert all(case.is_converged for row in cases for case in row)

zones = ListedColormap(["white", "#7fb2d9", "#f2b8a0"])


def draw(axes, case):
    """Zones as colours, tractions as arrows; lengths in millimetres, rolling to the right."""
    zone = np.where(case.is_slipping, 2, np.where(case.is_inside, 1, 0))
    x, y = 1e3 * case.x, 1e3 * case.y
    axes.pcolormesh(x, y, zone, cmap=zones, vmin=0, vmax=2, rasterized=True)
    some = (slice(2, None, 5), slice(2, None, 5))
    shown = np.where(case.is_inside[some], 1e-6, np.nan)
    axes.quiver(
        x[some[1]],
        y[some[0]],
        shown * case.traction_x[some],
        shown * case.traction_y[some],
        scale=3200,
        width=0.006,
    )
    axes.set_aspect("equal")


figure, grid = plt.subplots(2, 4, figsize=(11, 5.4), sharex=True, sharey=True, layout="constrained")
for row, spin in enumerate(("no spin", "spin 0.5 /m")):
    for column, s in enumerate(rising):
        axes, case = grid[row, column], cases[row][column]
        draw(axes, case)
        used = math.hypot(case.force.longitudinal, case.force.lateral) / LIMIT
        axes.set_title(
            f"{100 * s:.2f} %, {spin}\n{100 * used:.0f} % of the friction used", fontsize=9
        )
    grid[row, 0].set_ylabel("Across, mm")
for axes in grid[1]:
    axes.set_xlabel("Along, mm (rolling →)")
figure.suptitle("Stick (blue), slip (red), and the traction on the wheel")
plt.show()

# %%
# Without spin the stick zone shrinks towards the leading edge as creepage rises; with spin it moves
# to one side. The share of the patch that slips:

for row, name in zip(cases, ("no spin", "spin"), strict=True):
    share = [float(case.is_slipping.sum() / case.is_inside.sum()) for case in row]
    print(f"{name:8}", ", ".join(f"{100 * each:3.0f} %" for each in share))
    assert share == sorted(share)

# %%
# Along the middle of the patch, the traction rises from the leading edge with no slip, meets the
# friction bound, and follows it to the trailing edge.

figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
middle = cases[0][0].y.size // 2
for s, case in zip(rising, cases[0], strict=True):
    inside = case.is_inside[middle]
    axes.plot(1e3 * case.x[inside], case.traction_x[middle, inside] / 1e6, label=f"{100 * s:.2f} %")
bound = 0.3 * case.pressure[middle, inside] / 1e6
axes.plot(1e3 * case.x[inside], bound, "k--", lw=1, label="friction bound")
assert np.all(case.traction_x[middle, inside] / 1e6 <= bound * (1 + 1e-6))
axes.set(xlabel="Along, mm (rolling →)", ylabel="Traction, MPa", ylim=(0, None))
axes.grid(alpha=0.3)
axes.legend(title="Creepage")
plt.show()

# %%
# From rest, the force needs a rolled distance of the order of the patch to build up. The relaxation
# law that the train model uses, with σ = 8a/(3π), is quicker than the exact theory where little
# slips: it takes the patch for twice as stiff as a half-space is.

figure, axes = plt.subplots(figsize=(8, 4.2), layout="constrained")
lead = {}
for s in (1e-6, 1e-3, 3e-3):
    creepage = Creepage(s, 0.0, 0.0)
    march = march_exact(contact, rail, 20.0, [creepage] * 84, grid=(32, 32))
    steady = solve_exact(contact, rail, 20.0, creepage, grid=(32, 32)).force.longitudinal
    force = np.array([each.longitudinal for each in march.forces]) / steady
    law = 1.0 - np.exp(-march.distance / (8.0 * contact.a / (3.0 * math.pi)))
    lead[s] = float((law - force).max())
    axes.plot(march.distance / contact.a, force, label=f"exact, {100 * s:g} %")
axes.plot(march.distance / contact.a, law, "k--", lw=1, label="relaxation law")
axes.set(xlabel="Rolled distance over the semi-axis a", ylabel="Force over the steady force")
axes.set(xlim=(0, 6), ylim=(0, 1.05))
axes.grid(alpha=0.3)
axes.legend()
plt.show()

for s, most in lead.items():
    print(f"creepage {100 * s:g} %: the law leads by up to {most:.2f} of the steady force")
assert 0.15 < lead[1e-6] < 0.25
