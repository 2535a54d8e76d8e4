"""
Five slopes of the creep curve
==============================

How steeply adhesion rises with the first creepage tells a controller how much slip a force will
cost. Čáp (2000) compares five formulas for one wheel: 100 kN on a cone of 0.5 m, on a rail head of
0.3 m. His printed figures are not all what his formulas give, so both stand here side by side.
"""

# %%
# The shipped pair ``cap_2000`` holds the radii and the material of that comparison.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.contact.cap_2000 import cap_2000_simple_slope, cap_2000_slope
from railgrip.contact.carter_slope import carter_1926_slope
from railgrip.contact.kalker_slope import kalker_1967_simple_slope, kalker_1967_slope
from railgrip.contact.surface_stiffness import SURFACE_STIFFNESS, stiffness_slope
from railgrip.laboratory.slope_band import slope_band
from railgrip.laboratory.slope_over_shift import slope_over_shift
from railgrip.scenario.contact_pair import contact_of_pair, contact_pair

LOAD = 100e3
pair = contact_pair("cap_2000")
contact = contact_of_pair(pair, LOAD)
wheel, head = pair.wheel.radius, pair.rail.head_radius

formulas = ["Čáp (2.12a)", "Čáp (2.12b)", "Carter (2.13)", "Kalker (2.14a)", "Kalker (2.14b)"]
printed = np.array([17_500, 16_600, 10_300, 15_500, 16_400])
recomputed = 1e-3 * np.array(
    [
        cap_2000_slope(LOAD, wheel, head),
        cap_2000_simple_slope(LOAD, wheel),
        carter_1926_slope(LOAD, wheel),
        kalker_1967_slope(contact.a, contact.b, pair.young),
        kalker_1967_simple_slope(LOAD),
    ]
)
by_stiffness = 1e-3 * stiffness_slope(contact.a, contact.b, SURFACE_STIFFNESS)
by_theory = 1e-3 * contact.shear_modulus * contact.a * contact.b * contact.c11

print(f"{'':15} {'printed':>9} {'recomputed':>11}   kN per unit creepage")
for name, old, new in zip(formulas, printed, recomputed, strict=True):
    print(f"{name:15} {old:9.0f} {new:11.1f}")
print(f"{'(8/3)a²bK':15} {'':9} {by_stiffness:11.1f}")
print(f"{'Kalker, table':15} {'':9} {by_theory:11.1f}")

figure, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
places = np.arange(len(formulas))
axes.bar(places - 0.2, printed / 1e3, 0.38, label="printed", color="silver")
axes.bar(places + 0.2, recomputed / 1e3, 0.38, label="recomputed", color="C0")
axes.axhline(by_stiffness / 1e3, color="C1", linestyle="--", label="(8/3) a² b K, K = 20·10¹² N/m³")
axes.axhline(by_theory / 1e3, color="C2", linestyle=":", label="Kalker's table, G a b C11")
axes.set_xticks(places, formulas)
axes.set(ylabel="Slope dT/ds, MN", ylim=(0, 24))
axes.legend(ncols=2, loc="upper center")
plt.show()

# %%
# All but Carter's agree within 11 %. Carter takes wheel and rail for cylinders.
#
# How much the surface leaves open
# --------------------------------
#
# The stiffness of the surface is measured, not known: figure 2.2 of the paper holds measurements
# against a band from 15 to 25·10¹² N/m³ (it prints 10⁹, meaning kN/m³). The slope begins in
# proportion to it and does not depend on friction. A stiff surface slides sooner, so further on the
# order turns round.

creepage = np.linspace(0.0, 0.006, 301)
band = slope_band(creepage, LOAD, contact.a, contact.b, friction=0.3)
stiffness = [f"K = {value / 1e12:g}·10¹² N/m³" for value in band.stiffness]

figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4.2), layout="constrained")
for row, name in enumerate(stiffness):
    left.plot(100 * creepage, band.adhesion[row], label=name)
    right.plot(100 * creepage, 1e-6 * LOAD * band.slope[row])
left.fill_between(100 * creepage, band.adhesion[0], band.adhesion[-1], alpha=0.15)
right.fill_between(
    100 * creepage, 1e-6 * LOAD * band.slope.min(0), 1e-6 * LOAD * band.slope.max(0), alpha=0.15
)
left.set(xlabel="Creepage, %", ylabel="Adhesion used", xlim=(0, 0.6), ylim=(0, 0.32))
right.set(xlabel="Creepage, %", ylabel="Slope dT/ds, MN", xlim=(0, 0.6), ylim=(0, None))
left.legend()
for axes in (left, right):
    axes.grid(alpha=0.3)
plt.show()

# %%
# What the worn profile does
# --------------------------
#
# The paper works with a cone and says that the profile UIC-ORE (today S1002) would give a similar,
# longer formula. Here it is computed: as the place of contact moves over the tread, the tread's
# hollow closes on the head, the ellipse widens, and the slope rises. From −1.23 mm towards the
# flange the hollow is rounder than a head of 0.3 m, and Hertz has no solution. Near that place the
# ellipse would be wider than the head, and no formula for an ellipse means anything.

places = np.linspace(-0.012, 0.040, 1041)
shift = slope_over_shift(places, LOAD, wheel, head, pair.young, pair.poisson)

figure, (upper, lower) = plt.subplots(
    2, 1, figsize=(8, 6.5), sharex=True, layout="constrained", height_ratios=(3, 2)
)
upper.plot(1e3 * places, 1e-6 * shift.slope_by_kalker, label="Kalker's table, G a b C11")
upper.plot(1e3 * places, 1e-6 * shift.slope_by_stiffness, label="(8/3) a² b K")
upper.set(ylabel="Slope dT/ds, MN", ylim=(0, 30))
lower.plot(1e3 * places, 1e3 * shift.a, color="C2", label="a, along the track")
lower.plot(1e3 * places, 1e3 * shift.b, color="C3", label="b, across")
lower.set(
    xlabel="Place of contact on the tread, mm (flange to the left)",
    ylabel="Semi-axis, mm",
    xlim=(-12, 40),
    ylim=(0, 30),
)
for axes in (upper, lower):
    axes.axvspan(-12, -1.23, color="0.9")
    axes.axvline(32.158, color="0.7", linewidth=0.8)
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right")
upper.text(-6.6, 15, "no solution\n(hollow rounder\nthan the head)", ha="center", va="center")
upper.text(32.6, 4, "cone\n1:15")
plt.show()

solved = np.isfinite(shift.a)
print(f"first place with a solution: {1e3 * places[solved][0]:.2f} mm")
for place in (0.0, 3.0, 8.0, 20.0):
    at = int(np.argmin(abs(places - 1e-3 * place)))
    radius = 1e3 * shift.transverse_radius[at]
    print(
        f"y = {place:4.0f} mm: tread {radius:7.1f} mm, "
        f"a = {1e3 * shift.a[at]:.2f} mm, b = {1e3 * shift.b[at]:5.2f} mm, "
        f"slope {1e-6 * shift.slope_by_kalker[at]:.2f} MN"
    )
