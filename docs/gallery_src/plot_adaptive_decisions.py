"""
Macro or micro: how the adaptive protection decides
===================================================

The source draws two figures of force over slip. In 3a sliding cleans the rail, and the mean force
in macro-slip, Fm_mac, rises above the force F0 at which the wheel broke away. In 3b it does not,
and the system goes to micro-slip. Here is each from a run of its own, under the rule of the source
("forces"), and then a stop over rail that changes under way, under the lookout.
"""

# %%

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

import railgrip as rg

FORCES = {"rule": 0, "lead_axles": 0, "start": 2}
AXLE = 1  # the second axle: in front of the sander, behind one axle that cleans


def stop(rail, parameters, speed="140 km/h"):
    wsp = {"controller": "adaptive", "parameters": parameters}
    scenario = rg.load("leaves_160").with_({"run.speed": speed, "rail": rail, "wsp": wsp})
    return rg.simulate(scenario).data.isel(run=0)


# %%
# One axle: its slip, the force of the rail in kN, the way it has slid. F0 is the force when slip
# first passes 1.5 %; the mean forces begin when the first slide has come to its range.


def course(data):
    axle = data.isel(axle=AXLE)
    step = float(axle["time"][1] - axle["time"][0])
    slip = -axle["creepage"].values
    force = -axle["contact_force"].values / 1e3
    slid = np.cumsum(np.nan_to_num(slip * axle["train_speed"].values)) * step
    state = axle["wsp_state"].values
    begin = int(np.argmax(slip > 0.015))
    micro = int(np.argmax(state == 307)) if (state == 307).any() else None
    return slip, force, slid, step, begin, micro


def means(data, seconds=4.0):
    _, force, _, step, begin, micro = course(data)
    settle, span = round(1.5 / step), round(seconds / step)
    macro_end = micro if micro is not None else begin + settle + span
    found = {
        "F0": force[begin],
        "Fm_mac": force[min(begin + settle, macro_end - 5) : macro_end].mean(),
    }
    if micro is not None:
        # a test axle is in macro again for a while: only its micro phases count
        held = data["slip_range"].isel(axle=AXLE).values == 1
        held[: micro + settle] = False
        found["Fm_mic"] = force[np.flatnonzero(held)[:span]].mean()
    return found


def figure_3(axes, data, title, end=None):
    slip, force, slid, step, begin, _ = course(data)
    end = (begin + round(6.0 / step)) if end is None else end
    rows = slice(0, end)
    points = np.column_stack([slip[rows] * 100, force[rows]])[:, None]
    line = LineCollection(np.concatenate([points[:-1], points[1:]], axis=1), cmap="viridis", lw=1.4)
    line.set_array(slid[rows])
    axes.add_collection(line)
    for name, value in means(data).items():
        axes.axhline(value, color="0.4", lw=0.8, ls="--")
        axes.text(24.8, value, name, va="bottom", ha="right", fontsize=9)
    # the arrow: at one slip, from the first pass to the last, as the slid distance grows
    passes = np.flatnonzero(np.abs(slip[begin:end] - 0.08) < 0.01) + begin
    first, last = force[passes[0]], force[passes[-1]]
    arrow = {"arrowstyle": "-|>", "color": "crimson", "lw": 2, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", (8, last), (8, first), arrowprops=arrow)
    axes.text(8.4, min(first, last) - 0.12 * last, "$s_{RB}$ grows", color="crimson", va="top")
    axes.set(
        xlim=(0, 25), ylim=(0, None), xlabel="Slip, %", ylabel="Force of the rail, kN", title=title
    )
    return line


recovers = stop({"condition": "water_detergent"}, FORCES)
does_not = stop({"condition": "leaves"}, FORCES)

figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
figure_3(left, recovers, "3a  water and detergent")
end = course(does_not)[-1] + 300
line = figure_3(right, does_not, "3b  leaves", end)
figure.colorbar(line, ax=right, label="Slid distance in 3b, m")
plt.show()

# %%
# What the figures say, in numbers:

a, b = means(recovers), means(does_not)
for name, found in {"3a": a, "3b": b}.items():
    print(name, ", ".join(f"{key} {value:.1f} kN" for key, value in found.items()))

assert a["Fm_mac"] > 1.2 * a["F0"]  # macro-slip is kept ...
assert not (recovers["wsp_state"] == 307).any()
assert b["Fm_mac"] < 0.9 * b["F0"]  # ... and left
assert (does_not["wsp_state"] == 307).any()
assert b["Fm_mic"] > b["Fm_mac"]

# %%
# Rail that changes: leaves, 300 m of detergent, leaves again. Two leading axles stay in macro-slip
# all the way. Where the second reaches clearly more force than the first, sliding cleans.

patch = {"from": "600 m", "to": "900 m", "condition": "water_detergent"}
changing = stop({"condition": "leaves", "patch": [patch]}, {}, "160 km/h")
place = changing["train_position"].values
force = -changing["contact_force"].values / 1e3
smooth = np.ones(60) / 60

figure, (top, bottom) = plt.subplots(2, 1, figsize=(9, 5.5), sharex=True, layout="constrained")
for axle, name in ((0, "leader"), (1, "follower")):
    top.plot(place, np.convolve(force[axle], smooth, "same"), label=name)
top.set(ylabel="Force, mean of 1.2 s, kN", ylim=(0, None))
bottom.plot(place, (changing["slip_range"].values[2:] == 2).sum(axis=0), drawstyle="steps-post")
bottom.set(xlabel="Position of the train's front, m", ylabel="Other axles in macro-slip")
for axes in (top, bottom):
    axes.axvspan(600, 900, color="tab:cyan", alpha=0.15, label="detergent")
top.legend()
plt.show()

fast = changing["train_speed"].values > 5
inside = (place > 700) & (place < 890) & fast
outside = (place > 1050) & fast
assert (changing["slip_range"].values[:2, 1:] == 2).all()
assert (changing["slip_range"].values[2:, inside] == 2).mean() > 0.9
assert (changing["slip_range"].values[2:, outside] == 1).mean() > 0.9
