"""
What deforms the creep curve
============================

A creep curve is measured on a wheel that runs straight under an even load. On a track the wheelset
yaws, and the load swings. Čáp (2000, figures 2.3–2.5) found on a roller rig that both make the
rising branch lower and broader, and more so together. This page computes it.
"""

# %%
# One wheel with 100 kN on it, on dry rail at 72 km/h. Polach's law gives the force along the
# resultant of both creepages. `constant_stiffness` takes the patch as a spring that follows a
# swinging load the sooner, the more it slides.

import math

import matplotlib.pyplot as plt
import numpy as np

from railgrip.contact.angle_of_attack import WheelAttitude
from railgrip.contact.polach_2005 import polach_2005
from railgrip.contact.rail_friction import DRY_POLACH_2005
from railgrip.contact.relaxation import relaxation_length
from railgrip.contact.rolling_contact import rolling_contact
from railgrip.laboratory.deformed_curve import deformed_curve
from railgrip.laboratory.resultant import along_the_resultant

SPEED = 20.0
base = rolling_contact(100e3, 0.46, math.inf, 0.3, 210e9, 0.28)
polach = along_the_resultant(polach_2005)


def curve(milliradians=0.0, amplitude=0.0, wavelength=math.inf, relaxation="constant_stiffness"):
    """Creep curve under a yaw in mrad and a load that swings once in a wavelength in m."""
    return deformed_curve(
        polach,
        base,
        DRY_POLACH_2005,
        speed=SPEED,
        attitude=WheelAttitude(1e-3 * milliradians, 0.0, 0.46),
        amplitude=amplitude,
        frequency=SPEED / wavelength,
        relaxation=relaxation,
    )


still = curve()
by_angle = {f"{angle} mrad": curve(angle) for angle in (2, 5, 10, 20)}
by_load = {
    "slow, ±50 %": curve(amplitude=0.5),
    "5 cm (400 Hz), ±50 %": curve(amplitude=0.5, wavelength=0.05),
    "5 cm (400 Hz), ±100 %": curve(amplitude=1.0, wavelength=0.05),
    "2 cm (1 kHz), ±100 %": curve(amplitude=1.0, wavelength=0.02),
    "2 cm, lifting off (±200 %)": curve(amplitude=2.0, wavelength=0.02),
}
together = {
    "5 mrad": by_angle["5 mrad"],
    "2 cm, ±100 %": by_load["2 cm (1 kHz), ±100 %"],
    "both": curve(5, 1.0, 0.02),
}

figure, panels = plt.subplots(1, 3, figsize=(12, 4.2), layout="constrained", sharey=True)
for axes, title, curves in zip(
    panels,
    ("Angle of attack", "Swinging wheel load", "Both together"),
    (by_angle, by_load, together),
    strict=True,
):
    axes.plot(100 * still.creepage, still.adhesion, "k", lw=2, label="undisturbed")
    for label, each in curves.items():
        (drawn,) = axes.plot(100 * each.creepage, each.adhesion, label=label)
        axes.plot(100 * each.peak.creepage, each.peak.adhesion, "o", ms=4, color=drawn.get_color())
    axes.set_title(title, loc="left")
    axes.set(xlabel="Longitudinal creepage, %", xlim=(0, 8), ylim=(0, 0.42))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="lower right")
panels[0].set_ylabel("Adhesion used, mean over the load")
plt.show()

# %%
# Peak and initial slope, in per cent of the undisturbed curve, where the peak lies, and where the
# rising branch reaches half of the undisturbed peak:


def against_still(each):
    """Peak and slope over those of the undisturbed curve."""
    return (
        each.peak.adhesion / still.peak.adhesion,
        each.initial_slope / still.initial_slope,
    )


half = 0.5 * still.peak.adhesion
print(f"{'':27} peak   slope  peak at  half at")
for label, each in {"undisturbed": still, **by_angle, **by_load, "both": together["both"]}.items():
    peak, slope = against_still(each)
    print(
        f"{label:27}{100 * peak:5.1f} % {100 * slope:5.1f} % "
        f"{100 * each.peak.creepage:5.2f} % {100 * each.creepage_at(half):6.2f} %"
    )
    assert label == "undisturbed" or (peak < 1 and slope < 1)
    assert label == "undisturbed" or each.creepage_at(half) > still.creepage_at(half)
for each in ("5 mrad", "2 cm, ±100 %"):
    assert together["both"].peak.adhesion < together[each].peak.adhesion
    assert together["both"].initial_slope < together[each].initial_slope

# %%
# Why the angle of attack works so strongly: a yaw of α is a lateral creepage of α, and a few
# milliradians use up a good part of the friction before the wheel is braked at all. The
# longitudinal force is what is left of the resultant.
#
# Why a swinging load works so weakly, unless its wave is short: friction is linear in the load, so
# what the wheel loses while it is light it gains while it is heavy. Only the slope, which grows
# with the load to the power ⅔, does not get all of it back: A²/18 are lost, 1.5 % at ±50 %. More is
# lost only when the force cannot follow. It follows over the relaxation length of the patch:

length = relaxation_length(base.a)
print(f"relaxation length {1e3 * length:.1f} mm, patch {2e3 * base.a:.1f} mm long")

# %%
# So it is the wavelength on the rail that counts, speed over frequency, and not the frequency
# alone: at 72 km/h a load below 100 Hz is nearly a slow one. Waves as short as the patch are
# beyond this model, because the patch itself averages over them.
#
# The two ways for the force to follow agree on the slope. They part on the peak: the plant's
# relaxation, with one length at any creepage, remembers too long in a sliding patch, cuts the peak
# off and moves it inwards; the spring moves it outwards, which is the broader branch that the
# roller rig showed.

wavelengths = np.geomspace(2 * base.a, 10, 25)
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained", sharey=True)
for amplitude, colour in ((0.5, "C0"), (1.0, "C1"), (1.5, "C2")):
    for relaxation, style in (("constant_stiffness", "-"), ("constant_length", "--")):
        ratios = [against_still(curve(0.0, amplitude, each, relaxation)) for each in wavelengths]
        label = f"±{100 * amplitude:.0f} %, {relaxation.replace('_', ' ')}"
        for axes, values in zip((left, right), np.transpose(ratios), strict=True):
            axes.semilogx(wavelengths, 100 * values, style, color=colour, label=label)
            # the longer the wave, the less is lost
            assert (np.diff(values) > -1e-5).all()
for axes, title in ((left, "Peak"), (right, "Initial slope")):
    axes.set_title(title, loc="left")
    axes.set(xlabel="Wavelength of the load, m", ylim=(0, 105))
    axes.grid(alpha=0.3)
left.set_ylabel("Per cent of the undisturbed curve")
right.legend(fontsize=8, loc="lower right")
plt.show()
