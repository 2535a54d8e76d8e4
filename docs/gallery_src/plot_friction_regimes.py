"""
Friction laws, and one creep curve in four forms
================================================

Friction is the ceiling of adhesion. What it does as the wheel slides faster, or gets hotter, makes
the falling branch of the creep curve. And that curve is drawn in four ways, which are easily mixed
up: force or adhesion, over slip speed or creepage.
"""

# %%
# Friction over slip speed. Čáp (2000, figure 1.1) sketches three regimes: static friction, kinetic
# friction that falls with the slip speed, and a renewed rise as the asperities begin to vibrate. He
# gives no numbers, so those of the three regimes here are illustrative, and so is the line.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.contact.exponential_friction import exponential_friction
from railgrip.contact.half_value_friction import half_value_friction, half_value_from_polach
from railgrip.contact.linear_friction import LinearFriction, linear_friction
from railgrip.contact.rail_friction import DRY_POLACH_2005, WET_POLACH_2005
from railgrip.contact.thermal_friction import (
    CONTACT_EXAMPLE_LOWER,
    CONTACT_EXAMPLE_OVER_400,
    CONTACT_EXAMPLE_OVER_1200,
    thermal_friction,
)
from railgrip.contact.three_regime_friction import (
    ILLUSTRATIVE_THREE_REGIMES,
    three_regime_friction,
)
from railgrip.laboratory.friction_curve import friction_curve

slip_speed = np.linspace(0, 40, 801)
temperature = np.linspace(0, 1400, 701)
step = ILLUSTRATIVE_THREE_REGIMES._replace(falling_speed=0.0, vibration_rise=0.0)
line = LinearFriction(0.55, 0.22, 1 / 0.6)

figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
for law, parameters, label, style in (
    (exponential_friction, DRY_POLACH_2005, "exponential, dry", "-"),
    (linear_friction, line, "linear, same tangent and floor", "--"),
    (exponential_friction, WET_POLACH_2005, "exponential, wet", "-"),
    (three_regime_friction, ILLUSTRATIVE_THREE_REGIMES, "three regimes", "-"),
    (three_regime_friction, step, "the same, idealised", ":"),
):
    left.plot(slip_speed, friction_curve(law, parameters, slip_speed), style, label=label)
left.set(xlabel="Slip speed, m/s", ylabel="Friction coefficient", ylim=(0, 0.6), xlim=(-0.5, 40))
for parameters, label in (
    (CONTACT_EXAMPLE_OVER_1200, "0.33 → 0.14 over 0–1200 °C"),
    (CONTACT_EXAMPLE_OVER_400, "0.33 → 0.14 over 0–400 °C"),
    (CONTACT_EXAMPLE_LOWER, "0.30 → 0.12 over 0–400 °C"),
):
    right.plot(
        temperature, friction_curve(thermal_friction, parameters, 0.0, temperature), label=label
    )
right.set(xlabel="Temperature of the contact, °C", ylabel="Friction coefficient", ylim=(0, 0.6))
for axes in (left, right):
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
plt.show()

# %%
# Polach writes the exponential fall with a rate B, the program CONTACT with the slip speed at which
# half of it is gone. It is one curve:

half_value = half_value_from_polach(DRY_POLACH_2005)
print("dry in CONTACT's form: μ_kin {:.2f}, μ_1 {:.2f}, s_h {:.4f} m/s".format(*half_value))
parting = friction_curve(half_value_friction, half_value, slip_speed) - friction_curve(
    exponential_friction, DRY_POLACH_2005, slip_speed
)
assert abs(parting).max() < 1e-12

# %%
# The four forms (Čáp 2000, eqs 1.16 and 1.17): T(w), T(s), μ(w), μ(s), with w = s·v and T = μ·Q.
# One wheel on dry rail, at two speeds and two loads. Over creepage the rising branches of both
# speeds fall together, because the patch gives way with creepage; over slip speed the falling
# branches do, because friction falls with slip speed. So a curve can be redrawn from one form into
# another at its own speed, but not carried over to another speed.

from railgrip.contact.kalker_1990 import kalker_slope
from railgrip.contact.polach_2005 import polach_2005
from railgrip.laboratory.curve_of_law import curve_of_plant_law

cases = [(40, 50e3), (160, 50e3), (160, 100e3)]
curves = {
    f"{speed} km/h, {load / 1e3:.0f} kN": curve_of_plant_law(
        polach_2005,
        DRY_POLACH_2005,
        load=load,
        slope=kalker_slope(load, 0.46, np.inf, 0.3, 210e9, 0.28),
        speed=speed / 3.6,
    )
    for speed, load in cases
}

figure, panels = plt.subplots(2, 2, figsize=(10, 6.5), layout="constrained", sharey="row")
for label, curve in curves.items():
    peak = curve.peak
    for row, (values, top) in enumerate(
        ((curve.force / 1e3, peak.force / 1e3), (curve.adhesion, peak.adhesion))
    ):
        (drawn,) = panels[row, 0].plot(curve.slip_speed, values, label=label)
        panels[row, 0].plot(peak.slip_speed, top, "o", color=drawn.get_color())
        panels[row, 1].plot(100 * curve.creepage, values, label=label)
        panels[row, 1].plot(100 * peak.creepage, top, "o", color=drawn.get_color())
for (row, column), name in np.ndenumerate([["T(w)", "T(s)"], ["μ(w)", "μ(s)"]]):
    axes = panels[row, column]
    axes.set_title(name, loc="left")
    axes.set_xlabel(("Slip speed w, m/s", "Creepage s, %")[column])
    axes.set(xlim=(0, (4, 20)[column]), ylim=(0, None))
    axes.grid(alpha=0.3)
panels[0, 0].set_ylabel("Force T, kN")
panels[1, 0].set_ylabel("Adhesion used μ")
panels[0, 1].legend(fontsize=8)
plt.show()

for label, curve in curves.items():
    peak = curve.peak
    print(
        f"{label:17} peak {peak.adhesion:.3f} at {100 * peak.creepage:.2f} % = "
        f"{peak.slip_speed:.2f} m/s, initial slope {curve.initial_slope / 1e6:.2f} MN"
    )

# %%
# Any friction law can stand behind a creep law. Were the renewed rise as large as drawn here, a
# wheel that slides fast would find a second, slower maximum. `CreepCurve.to_csv` writes all four
# columns.

renewed = curve_of_plant_law(
    polach_2005,
    DRY_POLACH_2005,
    load=50e3,
    slope=kalker_slope(50e3, 0.46, np.inf, 0.3, 210e9, 0.28),
    speed=160 / 3.6,
    friction=lambda w: three_regime_friction(ILLUSTRATIVE_THREE_REGIMES, w, 20.0),
)
falling = renewed.ineffective_branch
least = int(np.argmin(falling.adhesion))
print(
    f"three regimes: peak {renewed.peak.adhesion:.3f}, "
    f"least {falling.adhesion[least]:.3f} at {falling.slip_speed[least]:.1f} m/s, "
    f"locked {falling.adhesion[-1]:.3f}"
)
assert falling.adhesion[-1] > falling.adhesion[least]
