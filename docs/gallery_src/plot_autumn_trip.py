"""
A trip in autumn
================

The same four-car unit from stop to stop on the plant: on dry rail, and with leaves at the stops,
with and without traction control.
"""

# %%
# An automatic driver pulls to the permitted speed, holds it, and brakes on the curve; beneath it
# are axles, contacts, brakes and protection of the plant. On dry rail it is the journey without
# slip. Leaves lie over 750 m before and behind the stops.

import matplotlib.pyplot as plt
import numpy as np

import railgrip as rg
from railgrip.engine.trip import drive_trip
from railgrip.report.trip_page import slip_speeds, ways

STOPS = [{"at": 0}, {"at": 8000}]
leaves = [
    {"from": 0, "to": 750, "condition": "leaves"},
    {"from": 7250, "to": 8750, "condition": "leaves"},
]
base = rg.load("dry_emergency").with_(
    {"line.use": "st_gallen_wil", "trip": {"stop": STOPS, "braking": 0.5, "supplement": 0.07}}
)
wet = base.with_({"rail": {"condition": "dry", "patch": leaves}})
runs = {
    "dry": drive_trip(base),
    "leaves, brakes protected": drive_trip(wet.with_({"wsp.controller": "conventional"})),
    "leaves, motors too": drive_trip(wet.with_({"wsp.controller": "peak_seeking_traction"})),
}

figure, (above, below) = plt.subplots(
    2, 1, figsize=(10, 6.4), sharex=True, height_ratios=(3, 2), layout="constrained"
)
fast = ways(runs["dry"])["without slip"]
above.plot(fast[0] / 1e3, 3.6 * fast[1], "k--", lw=1.0, label="without slip")
for name, run in runs.items():
    place, speed = ways(run)["on the plant"]
    above.plot(place / 1e3, 3.6 * speed, label=f"{name}: {run.running_time:.0f} s")
    where, slow, quick = slip_speeds(run.legs[0].run.data)
    below.fill_between(where / 1e3, 3.6 * slow, 3.6 * quick, alpha=0.5)
above.set(ylabel="Speed, km/h")
above.legend(frameon=False)
below.set(xlabel="Position, km", ylabel="Wheels faster than the train, km/h")
for name, run in runs.items():
    print(f"{name}: {run.running_time:.1f} s, {run.legs[0].past_stop:+.1f} m past the stop")

# %%
# Protected brakes alone let the motors spin the wheels, and time is lost at the start. With
# traction control the leaves cost half of that, and the stop is kept in both.

dry, brakes, both = runs.values()
assert abs(dry.running_time - dry.fast.running_time) < 2.0
assert brakes.running_time > both.running_time + 20.0
assert both.running_time > dry.running_time + 5.0
assert np.max([abs(run.legs[0].past_stop) for run in runs.values()]) < 40.0
