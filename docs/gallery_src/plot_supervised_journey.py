"""
A driver who brakes late, under ETCS
====================================

A regional train drives from St Gallen to Wil. Its driver brakes at 0.9 m/s², which the train can
do; ETCS counts on less, since rail may be wet. It would have told the driver earlier, and where the
limits are passed it brakes by itself.

Three ways of living with it: the supervision only says what it would have done, the train is driven
below the permitted speed, or the driver goes on as he does and the supervision intervenes.
"""

import matplotlib.pyplot as plt
import numpy as np

from railgrip.control.etcs.limit_table import EBI, PERMITTED, SBI
from railgrip.control.etcs.supervised_way import excess
from railgrip.engine.journey.drive import drive
from railgrip.engine.journey.supervision import Onboard
from railgrip.engine.journey.watching import watched
from railgrip.report.supervised_journey import LINES, WORDS
from railgrip.scenario.journey import Journey

TRAIN = {
    "length": 75.0,
    "emergency": [{"value": 1.1}],
    "service": [{"value": 0.8}],
    "emergency_time": 2.0,
    "service_time": 2.5,
    "service_brake_interface": True,
    "kdry": [{"confidence_level": 9, "steps": [{"value": 0.85}]}],
    "kwet": [{"value": 0.9}],
}


def driven(mode, **own):
    """Return the run of the late driver."""
    supervision = {"mode": mode, "train": TRAIN, **own}
    return drive(
        Journey(train="flirt_tpf", line="st_gallen_wil", braking=0.9, supervision=supervision)
    )


runs = {mode: driven(mode) for mode in ("report", "drive", "intervene")}
found = {
    mode: watched(
        run.journey, run.trace["time"], run.trace["position"], run.trace["speed"], run.told
    )
    for mode, run in runs.items()
}

# %%
# What it costs, and how near each run came to the brakes (the least way left over all targets):

print("              time     energy   braked   to permitted   to SBI     to EBI")
for mode, run in runs.items():
    least = np.min([one.margin for one in found[mode].approaches], axis=0)
    print(
        f"{mode:10s} {run.running_time:7.1f} s {run.energy['pantograph'] / 3.6e6:6.1f} kWh "
        f"{len(run.interventions):5d} x {least[PERMITTED]:10.1f} m {least[SBI]:9.1f} m "
        f"{least[EBI]:7.1f} m"
    )

times = {mode: run.running_time for mode, run in runs.items()}
assert times["report"] < times["intervene"] < times["drive"] < 1.02 * times["report"]
assert len(runs["intervene"].interventions) == 7
assert {one.brake for one in runs["intervene"].interventions} == {"service"}

way = Onboard(runs["report"].journey).way(np.inf, 29_556.1)
over = {mode: excess(way, r.trace["position"], r.trace["speed"]) for mode, r in runs.items()}
assert over["drive"][PERMITTED].max() < 1e-6
assert over["intervene"][EBI].max() < 1e-6 < over["report"][EBI].max()

# %%
# The last restriction but three, and the station: thin lines are the limits, from the outside
# inwards indication, permitted, warning, service and emergency brake.

figure, both = plt.subplots(2, 1, figsize=(9, 7.5), layout="constrained")
colours = {"report": "0.45", "drive": "#009E73", "intervene": "k"}
names = {
    "report": "late driver, alone",
    "drive": "below the permitted speed",
    "intervene": "late driver, braked by ETCS",
}
for axes, (begin, end) in zip(both, ((18.0, 18.75), (28.85, 29.62)), strict=True):
    places = np.linspace(1e3 * begin, 1e3 * end, 1500)
    limits = way.speeds(places)
    for name, limit in zip(LINES, limits, strict=True):
        colour, style, _ = LINES[name]
        axes.plot(places / 1e3, 3.6 * limit, color=colour, ls=style, lw=1.0, label=WORDS[name])
    for mode, run in runs.items():
        trace = run.trace
        axes.plot(
            trace["position"] / 1e3, 3.6 * trace["speed"], color=colours[mode], lw=2.0,
            ls=":" if mode == "report" else "-", label=names[mode],
        )  # fmt: skip
    axes.set(xlabel="Position, km", ylabel="Speed, km/h", xlim=(begin, end))
both[0].set_ylim(80, 122)
both[1].set_ylim(0, 95)
both[0].legend(loc="lower center", ncols=4, frameon=False, bbox_to_anchor=(0.5, 1.0))

# %%
# On rail that gives just what the supervision counts on, the service brake is not always enough:
# the emergency brake follows, and the train stands. It never passes the end of authority, 50 m
# behind the stop.

assumed = driven("intervene", rail="assumed")
for one in assumed.interventions:
    print(f"{one.brake:20s} {one.begin[1] / 1e3:7.3f} to {one.end[1] / 1e3:7.3f} km, "
          f"{3.6 * one.begin[2]:5.1f} to {3.6 * one.end[2]:5.1f} km/h")  # fmt: skip
assert assumed.trace["position"].max() < 29_556.1 + 50.0
assert sum(one.brake == "service, emergency" for one in assumed.interventions) == 3

# %%
# A stricter wet factor makes every indication earlier, where the emergency brake decides.

strict = Journey.model_validate(
    runs["report"].journey.model_dump(by_alias=True)
    | {"supervision": {"train": TRAIN | {"kwet": [{"value": 0.75}]}}}
)
run = drive(strict)
stricter = watched(strict, *(run.trace[n] for n in ("time", "position", "speed")), run.told)
for plain, wet in zip(found["report"].approaches, stricter.approaches, strict=True):
    print(f"{plain.target / 1e3:7.3f} km: indicated {plain.passed[0]:6.1f} m before it, "
          f"with Kwet 0.75 {wet.passed[0]:6.1f} m")  # fmt: skip
    assert wet.passed[0] >= plain.passed[0]
