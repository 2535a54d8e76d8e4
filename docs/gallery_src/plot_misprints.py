"""
How misprints show
==================

Čáp's paper of 2000 is worth building on, and its printed form has slips. A reader who copies a
number from it gets a wheel of another shape or a slope a thousand times too small. Each line of the
table below is computed on this page; the page would not build if one were wrong.
"""

# %%
# The profile
# -----------
#
# Two coefficients of the printed polynomial are wrong, 1.565·10⁻² y² and 2.646·10⁻³ y⁸. With the
# first alone the tread would rise by a millimetre and a half in ten; with the second it would rise
# by 44 m in eight millimetres.

import math

import matplotlib.pyplot as plt
import numpy as np

from railgrip.contact.cap_2000 import cap_2000_slope
from railgrip.contact.contact_pressure import elliptic_pressure
from railgrip.contact.freibauer_curve import freibauer_adhesion, freibauer_slope
from railgrip.contact.kalker_slope import kalker_1967_simple_slope, kalker_1967_slope
from railgrip.contact.s1002 import s1002
from railgrip.contact.surface_stiffness import rectangular_stiffness_slope, stiffness_slope
from railgrip.contact.yawed_patch import printed_turn, yawed_patch
from railgrip.core.formulas.patch import hertz_1882

PRINTED = [0, -3.358e-2, 1.565e-2, -2.810e-5, 5.84e-8, -1.562e-8, 5.309e-15, -5.957e-12, 2.646e-3]
SQUARE_PUT_RIGHT = [*PRINTED[:2], 1.565e-3, *PRINTED[3:]]
EIGHTH_PUT_RIGHT = [*PRINTED[:8], 2.646e-13]
BOTH_PUT_RIGHT = [*SQUARE_PUT_RIGHT[:8], 2.646e-13]

y = np.linspace(-12.0, 12.0, 241)
points = [s1002(1e-3 * place) for place in y]
height = np.array([1e3 * point.height for point in points])
slope = np.array([point.slope for point in points])
bend = np.array([1e-3 * point.second_derivative for point in points])
true_radius = np.array([-1e3 * point.transverse_radius for point in points])
mistaken_radius = (1.0 + slope) ** 1.5 / bend
shown = y < 10.0

figure, (left, right) = plt.subplots(1, 2, figsize=(9.5, 4.2), layout="constrained")
left.plot(y, height, color="C0", label="S1002")
left.plot(y, np.polynomial.Polynomial(EIGHTH_PUT_RIGHT)(y), "C1--", label="y² as printed")
left.plot(y, np.polynomial.Polynomial(SQUARE_PUT_RIGHT)(y), "C3:", label="y⁸ as printed")
left.set(xlabel="Place on the tread y, mm", ylabel="Height z, mm", ylim=(-0.5, 3.0))
left.legend()
right.plot(y[shown], true_radius[shown], "C0", label="(1 + z'²)^(3/2)/z''")
right.plot(y[shown], mistaken_radius[shown], "C1--", label="(1 + z')^(3/2)/z''")
right.plot([-8, 0, 8], [192.6, 303.4, 588.6], "ko", label="printed")
right.set(xlabel="Place on the tread y, mm", ylabel="Radius of the hollow, mm", ylim=(0, None))
right.legend()
for axes in (left, right):
    axes.grid(alpha=0.3)
plt.show()

# %%
# The printed radii of the tread lie on the dashed line: the square in 1 + z'² was left out. The
# radius is that of a hollow, so it enters Hertz with a negative sign, which the paper's absolute
# value hides.
#
# The turn of the ellipse
# -----------------------
#
# The paper finds the turn of the ellipse under yaw small enough to neglect. Its formula (1.15)
# lacks the factor 1/cos ϑ, which is 4 for the usual radii; with it, it is the turn from the rail,
# not from the planes of the wheel that the text names.

ANGLES = np.linspace(0.0, 20e-3, 41)
CONE = (0.5, math.inf, 0.3)
turned = [yawed_patch(100e3, *CONE, 210e9, 0.3, float(yaw)) for yaw in ANGLES]

figure, axes = plt.subplots(figsize=(7, 4.2), layout="constrained")
axes.plot(1e3 * ANGLES, [-1e3 * each.turn_from_wheel for each in turned], label="from the wheel")
axes.plot(1e3 * ANGLES, [-1e3 * each.turn_from_rail for each in turned], label="from the rail")
axes.plot(1e3 * ANGLES, 0.5e3 * ANGLES, "C3:", label="text of the paper, α/2")
axes.plot(
    1e3 * ANGLES, [1e3 * printed_turn(*CONE, float(yaw)) for yaw in ANGLES], "C3--", label="(1.15)"
)
axes.set(xlabel="Yaw α, mrad", ylabel="Turn of the ellipse against the yaw, mrad")
axes.set(xlim=(0, 20), ylim=(0, None))
axes.grid(alpha=0.3)
axes.legend()
plt.show()

# %%
# The table
# ---------

patch = hertz_1882(100e3, *CONE, 210e9, 0.3)
small = yawed_patch(100e3, *CONE, 210e9, 0.3, 1e-4)
inner, middle, outer = (s1002(1e-3 * place) for place in (-8, 0, 8))
grid = np.linspace(-1.0, 1.0, 201)
pressure = [[elliptic_pressure(patch, patch.a * u, patch.b * v) for u in grid] for v in grid]
mean_over_ellipse = np.sum(pressure) / np.count_nonzero(pressure)

# place, printed, right, what it is computed to, unit, relative tolerance of the right figure
rows = [
    ("K: slope (8/3)a²bK", "15.7", 15744.6, 1e-3 * stiffness_slope(*patch[:2], 20e12), "kN", 1e-5),
    ("(2.12a) with r1x/r1y", "25830", 16605, 1e-3 * cap_2000_slope(100e3, 0.5, 0.3), "kN", 1e-5),
    ("table, (2.12a)", "17500", 16605, 1e-3 * cap_2000_slope(100e3, 0.5, 0.3), "kN", 1e-5),
    (
        "table, (2.14a)",
        "15500",
        15062.8,
        1e-3 * kalker_1967_slope(*patch[:2], 210e9),
        "kN",
        1e-5,
    ),
    ("table, (2.14b)", "16400", 16244.4, 1e-3 * kalker_1967_simple_slope(100e3), "kN", 1e-5),
    ("r1y at -8 mm", "192.6", -214.216, 1e3 * inner.transverse_radius, "mm", 3e-6),
    ("r1y at 0 mm", "303.4", -319.890, 1e3 * middle.transverse_radius, "mm", 3e-6),
    ("r1y at +8 mm", "588.6", -601.525, 1e3 * outer.transverse_radius, "mm", 3e-6),
    ("z at +8 mm", "0.183", -0.183, 1e3 * outer.height, "mm", 2e-3),
    ("z' at +8 mm", "-0.01141", -0.01414, outer.slope, "", 1e-3),
    (
        "(2.11c), l = 2b not 2",
        "l = 2",
        4.0,
        rectangular_stiffness_slope(patch.a, 2.0 * patch.b, 20e12) / (20e12 * patch.a**2 * patch.b),
        "a²bK",
        1e-12,
    ),
    ("ξ1 from the rail", "0.5", 1.5, -small.turn_from_rail / 1e-4, "α", 1e-4),
    ("ξ1 from the wheel", "0.5", 2.5, -small.turn_from_wheel / 1e-4, "α", 1e-4),
    ("ξ1 by (1.15)", "0.5", 0.375, printed_turn(*CONE, 1e-4) / 1e-4, "α", 1e-4),
    ("2/δ: T/φQ at ε → ∞", "2/δ", 1.0, freibauer_adhesion(1.0, 1.0, 1e9), "", 1e-8),
    ("4/δ: dμ/dε / φ", "4/δ", 4.0 / math.pi, freibauer_slope(1.0, 1.0, 0.0), "", 1e-12),
    ("δ/4: where it is 1", "δ/4", math.pi / 4.0, 1.0 / freibauer_slope(1.0, 1.0, 0.0), "", 1e-12),
    (
        "δ in (1.9): Q/100 kN",
        "3Q/2δab",
        1.0,
        mean_over_ellipse * math.pi * patch.a * patch.b / 100e3,
        "",
        2e-3,
    ),
]
print(f"{'place':24} {'printed':>9} {'right':>11}")
for place, misprint, right, computed, unit, tolerance in rows:
    assert math.isclose(computed, right, rel_tol=tolerance), (place, right, computed)
    print(f"{place:24} {misprint:>9} {computed:11.5g} {unit}")

# %%
# And the misprints themselves come out where the slip is made on purpose:

as_printed = np.polynomial.Polynomial(PRINTED)
mended = np.polynomial.Polynomial(BOTH_PUT_RIGHT)
assert 1e-3 * stiffness_slope(*patch[:2], 20e9) < 16  # K with 10⁹ N/m³: a thousandth
assert math.isclose(cap_2000_slope(100e3, 0.5, 1e12), 25_830e3, rel_tol=1e-4)  # r1x/r1y of a cone
assert as_printed(8.0) > 44_000  # mm
assert np.allclose(mended(y), height, atol=2e-4)  # mm: the printed digits but for the two
for place, misprint in ((-8, 192.6), (0, 303.4), (8, 588.6)):
    at = int(np.argmin(abs(y - place)))
    assert math.isclose(mistaken_radius[at], misprint, rel_tol=1e-3)
print(f"height at 8 mm with the printed polynomial: {as_printed(8.0) / 1e3:.1f} m")

# %%
# Two slips are of words: the sentence before (2.10) calls the patch of (8/3) a² b K rectangular,
# and it is elliptic; and Z is the normal force in (1.11) and the spin moment in (2.9). The number
# 1.12 stands for two equations.
