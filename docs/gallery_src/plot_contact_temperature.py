"""
How hot a sliding contact gets
==============================

Friction heat arises in a patch of two square centimetres and both surfaces pass it within a
millisecond. This page shows where they are hottest, what a locked wheel changes, and what a warm
wheel gives to a cold rail without any friction.
"""

# %%
# A wheel of 100 kN slides by 1 m/s at 30 m/s, friction 0.3: pressure and temperature over the
# patch. The surfaces enter on the left. The hottest point lies behind the middle, at two thirds of
# the way from the centre to the exit.

import matplotlib.pyplot as plt
import numpy as np

from railgrip.core.formulas.flash_temperature import STEEL_ERTZ_2002, effusivity, fast_rise
from railgrip.laboratory.contact_temperature import surface_temperatures
from railgrip.laboratory.sliding_contact import SlidingContact
from railgrip.laboratory.temperature_limits import passed_limits

A, B = 5.88e-3, 10.54e-3


def sliding(wheel, train, wheel_temperature=20.0):
    return SlidingContact(100e3, A, B, 0.3, wheel, train, wheel_temperature, 20.0)


x, y = np.linspace(-1.3, 2.0, 331) * A, np.linspace(-1.15, 1.15, 231) * B
contact = sliding(29.5, 30.5)
field = surface_temperatures(contact, x[None, :], y[:, None])
pressure = 1.5 * contact.load / (np.pi * A * B) * field.heat_flux / contact.heat_flux

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
for axes, values, name, words in (
    (left, pressure / 1e6, "viridis", "Pressure, MPa"),
    (right, field.rail, "inferno", "Rail surface, °C"),
):
    shade = axes.pcolormesh(1e3 * x, 1e3 * y, values, cmap=name, shading="auto")
    figure.colorbar(shade, ax=axes, label=words)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    axes.plot(1e3 * A * np.cos(angle), 1e3 * B * np.sin(angle), color="white", lw=1)
    axes.set(xlabel="Behind the centre, mm", ylabel="Beside the centre, mm", aspect="equal")

row, column = np.unravel_index(field.rail.argmax(), field.rail.shape)
print(f"greatest {field.rail.max():.1f} °C, {x[column] / A:.2f} of the semi-axis behind the centre")
assert abs(field.rail.max() - 20.0 - 150.3) < 0.3
assert abs(x[column] / A - 0.652) < 0.02

# %%
# Along the middle strip, for a wheel that rolls, one that is half as fast as the train, and one
# that is locked, all with the same friction power. The rolling wheel and the rail share the heat
# and are equally hot at every point. The locked wheel takes a hundredth of it, so the rail gets
# nearly twice as hot, and the wheel is hottest where the heat cannot leave it: near its middle.

POWER = 30e3
cases = {"rolling, 30 m/s": 29.5, "15 m/s": 15.0, "locked": 0.0}
places = np.linspace(-1.5, 3.0, 181) * A
figure, panels = plt.subplots(1, 3, figsize=(12, 4), sharey=True, layout="constrained")
greatest = {}
for axes, (words, wheel) in zip(panels, cases.items(), strict=True):
    slip = 30.0 - wheel
    case = SlidingContact(100e3, A, B, POWER / (100e3 * slip), wheel, 30.0)
    found = surface_temperatures(case, places)
    axes.plot(places / A, found.rail, color="tab:blue", label="rail")
    axes.plot(places / A, found.wheel, color="tab:red", ls="--", label="wheel")
    axes.axvspan(-1, 1, color="0.9", zorder=0)
    axes.set(xlabel="Behind the centre / semi-axis", title=words)
    greatest[words] = (found.wheel.max(), found.rail.max())
panels[0].set_ylabel("Temperature, °C")
panels[0].legend()
for words, (wheel, rail) in greatest.items():
    print(f"{words:16} wheel {wheel:6.1f} °C, rail {rail:6.1f} °C")
assert greatest["locked"][1] > 1.8 * greatest["rolling, 30 m/s"][1] - 20.0

# %%
# A braked wheel is warmer than the rail. Where they touch both jump to one temperature between the
# two, and behind the patch they return slowly: the rail carries heat away. The flash comes on top.

warm = sliding(29.5, 30.5, wheel_temperature=150.0)
still = SlidingContact(100e3, A, B, 0.0, 30.0, 30.0, 150.0, 20.0)
places = np.linspace(-1.5, 8.0, 381) * A
figure, axes = plt.subplots(figsize=(8, 4), layout="constrained")
for case, style, words in ((warm, "-", "sliding 1 m/s"), (still, ":", "rolling freely")):
    found = surface_temperatures(case, places)
    axes.plot(places / A, found.wheel, color="tab:red", ls=style, label=f"wheel, {words}")
    axes.plot(places / A, found.rail, color="tab:blue", ls=style, label=f"rail, {words}")
axes.axvspan(-1, 1, color="0.9", zorder=0)
axes.set(xlabel="Behind the centre / semi-axis", ylabel="Temperature, °C")
axes.legend()
assert abs(still.touch_temperature() - 85.0) < 1e-9

# %%
# How much slip does steel bear? The greatest rise over the slip speed at 10, 20 and 40 m/s, with
# the temperatures from which steel suffers: a locked wheel reaches them at once.

speeds = (10.0, 20.0, 40.0)
slip = np.linspace(0.0, 1.0, 101)
figure, axes = plt.subplots(figsize=(8, 4.4), layout="constrained")
for speed in speeds:
    rises = [sliding((1.0 - part) * speed, speed).flash().rise for part in slip]
    axes.plot(100 * slip, rises, label=f"{speed:.0f} m/s")
for limit in (one.limit for one in passed_limits(1e4)):
    axes.axhline(limit.temperature - 20.0, color="0.5", ls="--", lw=1)
    axes.text(99, limit.temperature - 15.0, limit.name, ha="right", va="bottom", fontsize=8)
axes.set(xlabel="Slip, %", ylabel="Flash temperature rise, K", ylim=(0, 2000))
axes.legend(title="train speed", loc="upper left")
small = sliding(0.99 * 30.0, 30.0)
by_hand = fast_rise(0.5, small.heat_flux, A, 30.0, effusivity(STEEL_ERTZ_2002))
assert abs(small.flash().rise / by_hand - 1.0) < 0.01
plt.show()
